/* test_rescue.c - `compare` or `transient` is stopped inside a period of time integration that never ends,
 * timeint_steady being wrapped by the linker: the rows that were found before are written as in a run that is not
 * stopped, the first table says that it is not whole, the exit code is 3; however many signals come. Where no row was
 * found yet, it ends as everything does. */
#include <jansson.h>

#include "tests/faults/child.h"
#include "tests/faults/small.h"
#include "tests/wrap.h"
#include "timeint/steady/steady.h"

enum { HANGS = 600 /* [s] of a child, to end hangs */ };

static double stalls_at; /* from this omega on timeint_steady does not come back */
static int stop_by = SIGINT;
static int signals = 1; /* how many are sent there */

WRAP(hc_status, timeint_steady,
     (timeint * ti, double omega, double *state, const hc_monitor *monitor, timeint_result *r))
{
  if (!(omega >= stalls_at)) return __real_timeint_steady(ti, omega, state, monitor, r);
  for (int i = 0; i < signals; ++i) raise(stop_by);
  for (;;) pause();
}

static int obey(void *self)
{
  signal(SIGINT, SIG_DFL); /* who started the tests may ignore it */
  return child_command(self);
}

static outcome whole, stopped;

static void run(const char *line, double omega, outcome *o)
{
  char own[256];
  snprintf(own, sizeof own, "%s", line);
  snprintf(small_doing, sizeof small_doing, "stalled at %g: hbmcheck %s\n", omega, line);
  stalls_at = omega;
  child_run(obey, own, HANGS, o);
}

#define LINE "compare small.yaml -q --format csv --set compare.omega=6.2,6.4,6.6"

/* From the header of the csv on, without its notes. */
static const char *rows_of(const char *text)
{
  const char *header = strstr(text, "omega,branch");
  if (!header) header = strstr(text, "omega,verdict");
  return header ? header : "";
}

/* The length of the header and rows, without the notes behind them. */
static size_t length_of(const char *rows)
{
  const char *note = strstr(rows, "\n#");
  return note ? (size_t)(note + 1 - rows) : strlen(rows);
}

static int lines_of(const char *rows)
{
  int n = 0;
  for (size_t i = 0; i < length_of(rows); ++i) n += rows[i] == '\n';
  return n;
}

/* The header and the rows before the stalled one are those of the whole table. */
static void rows_found_before_are_written(CHECK_STATE)
{
  run(LINE, INFINITY, &whole);
  assert_int_equal(whole.code, 0);
  assert_int_equal(lines_of(rows_of(whole.out)), 1 + 3);
  for (int found = 1; found <= 2; ++found) {
    run(LINE, 6.1 + 0.2 * found, &stopped);
    const char *rows = rows_of(stopped.out);
    const int lines = lines_of(rows);
    if (stopped.code == 3 && lines == found + 1 && !strncmp(rows, rows_of(whole.out), length_of(rows)) &&
        strstr(stopped.out, "INCOMPLETE: stopped on request") && strstr(stopped.err, "what was found is kept"))
      continue;
    child_show(&stopped, LINE);
    fail_msg("%d lines where %d rows were found", lines, found);
  }
}

#define STATES "transient small.yaml -q --format csv --set compare.omega=6.2,6.4,6.6"

static void steady_states_are_kept_too(CHECK_STATE)
{
  run(STATES, INFINITY, &whole);
  assert_int_equal(whole.code, 0);
  assert_int_equal(lines_of(rows_of(whole.out)), 1 + 3);
  run(STATES, 6.5, &stopped);
  const char *rows = rows_of(stopped.out);
  if (stopped.code != 3 || lines_of(rows) != 1 + 2 || strncmp(rows, rows_of(whole.out), length_of(rows)) != 0 ||
      !strstr(stopped.out, "INCOMPLETE: stopped on request"))
    child_show(&stopped, STATES), fail();
}

/* Without rows to keep it would kill: tests/output/test_progress.c. */
static void a_second_signal_loses_none_of_them(CHECK_STATE)
{
  signals = 3;
  rows_found_before_are_written(state);
  steady_states_are_kept_too(state);
  signals = 1;
}

/* SIGKILL leaves no time to write what was found before: in csv and json it has been written, into a pipe, too. */
static void rows_appear_when_they_are_found(CHECK_STATE)
{
  static const char *const commands[] = {"compare", "transient"}, *const formats[] = {"csv", "json"},
                           *const contacts[] = {"", "--contacts"};
  static const struct {
    const char *found[2], *not_yet;
  } expected[] = {{{"\n6.2", "\n6.4"}, "\n6.6"}, {{"{\"omega\": 6.2", "{\"omega\": 6.4"}, "{\"omega\": 6.6"}};
  stop_by = SIGKILL;
  for (int i = 0; i < 8; ++i) {
    char line[128];
    const int f = i / 2 % 2;
    snprintf(line, sizeof line, "%s small.yaml -q --format %s %s --set compare.omega=6.2,6.4,6.6", commands[i % 2],
             formats[f], contacts[i / 4]);
    run(line, 6.5, &stopped);
    if (stopped.signal == SIGKILL && strstr(stopped.out, expected[f].found[0]) &&
        strstr(stopped.out, expected[f].found[1]) && !strstr(stopped.out, expected[f].not_yet))
      continue;
    child_show(&stopped, line);
    fail();
  }
  /* not in a file, which is written whole or not at all */
  run(LINE " -o killed", 6.5, &stopped);
  assert_int_equal(access("killed", F_OK), -1);
  stop_by = SIGINT;
}

/* What was shown at once and what is written after the signal are one document. */
static void json_is_closed(CHECK_STATE)
{
  run("compare small.yaml -q --format json --contacts --set compare.omega=6.2,6.4,6.6", 6.5, &stopped);
  assert_int_equal(stopped.code, 3);
  json_t *root = json_loads(stopped.out, JSON_REJECT_DUPLICATES, NULL);
  assert_non_null(root);
  assert_int_equal(json_array_size(json_object_get(root, "HBM against time integration")), 2);
  assert_int_equal(json_array_size(json_object_get(root, "Contacts")), 2 * 2); /* each has two */
  json_decref(root);
}

static void the_table_says_that_it_is_not_whole(CHECK_STATE)
{
  run("compare small.yaml -q --contacts -o result --set compare.omega=6.2,6.4,6.6", 6.3, &stopped);
  static char text[1 << 14];
  FILE *from = fopen("result", "r");
  assert_non_null(from);
  text[fread(text, 1, sizeof text - 1, from)] = 0;
  fclose(from);
  assert_int_equal(stopped.code, 3);
  assert_non_null(strstr(text, "INCOMPLETE: stopped on request"));
  assert_non_null(strstr(text, "Contacts"));
}

static void nothing_found_yet(CHECK_STATE)
{
  run(LINE, 6, &stopped);
  assert_int_equal(stopped.code, 3);
  assert_int_equal(strlen(stopped.out), 0);
  assert_non_null(strstr(stopped.err, "stopped on request; what was under way is lost"));
}

int main(void)
{
  return SMALL_MAIN("rescue", 600, rows_found_before_are_written, steady_states_are_kept_too,
                    a_second_signal_loses_none_of_them, rows_appear_when_they_are_found, json_is_closed,
                    the_table_says_that_it_is_not_whole, nothing_found_yet);
}
