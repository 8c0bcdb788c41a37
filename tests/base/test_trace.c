/* test_trace.c - which parts a list names, what is said of a word that is none, and that a line is written only where
 * it was asked for. */
#include "tests/check.h"

#include "numerics/base/trace.h"

static hc_status start(const char *list, char text[256])
{
  message msg;
  message_start(&msg, text, 256);
  return trace_start(list, &msg);
}

static void a_list_names_parts(CHECK_STATE)
{
  char text[256];
  assert_int_equal(start("newton,curve", text), HC_OK);
  assert_int_equal(trace_wanted, 1u << TRACE_newton | 1u << TRACE_curve);
  assert_int_equal(start("all", text), HC_OK);
  assert_int_equal(trace_wanted, (1u << TRACE_COUNT) - 1);
  assert_int_equal(start("", text), HC_OK);
  assert_int_equal(trace_wanted, 0);
  assert_int_equal(start(NULL, text), HC_OK);
  assert_int_equal(trace_wanted, 0);
}

static void another_word_is_refused(CHECK_STATE)
{
  char text[256];
  assert_int_equal(start("curve", text), HC_OK);
  assert_int_equal(start("newton,crve", text), HC_BAD_INPUT);
  assert_non_null(strstr(text, "`crve`, did you mean `curve`?"));
  assert_int_equal(start("something", text), HC_BAD_INPUT);
  assert_non_null(strstr(text, "expected a list of curve, newton"));
  assert_int_equal(trace_wanted, 1u << TRACE_curve);
}

static int counted;
static int count(void) { return ++counted; }

/* What stderr gets, by a file in its place. */
static void off_it_costs_nothing_on_it_is_a_line(CHECK_STATE)
{
  char text[256], seen[256] = {0};
  FILE *file = tmpfile();
  const int real = dup(STDERR_FILENO);
  assert_non_null(file);
  assert_true(dup2(fileno(file), STDERR_FILENO) >= 0);
  start("", text);
  TRACE(curve, "%d", count());
  start("curve", text);
  TRACE(newton, "%d", count());
  TRACE(curve, "%d", count());
  dup2(real, STDERR_FILENO);
  close(real);
  rewind(file);
  const size_t n = fread(seen, 1, sizeof seen - 1, file);
  fclose(file);
  assert_int_equal(counted, 1);
  assert_string_equal(seen, "curve   1\n");
  assert_int_equal(n, 10);
  start("", text);
}

CHECK_TESTS("base.trace", 60, a_list_names_parts, another_word_is_refused, off_it_costs_nothing_on_it_is_a_line)
