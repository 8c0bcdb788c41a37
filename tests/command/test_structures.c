/* test_structures.c - the commands on structures, and what they say of single contacts and responses. */
#include <string.h>

#include "tests/shell.h"

#define CHAIN "cases/structures/chain3.yaml "
#define CASE2 "cases/paper/case2.yaml "

static char out[1 << 20];

static int run(const char *args)
{
  char line[2048];
  snprintf(line, sizeof line, "%s %s", HBMCHECK_COMMAND, args);
  return shell_read(line, out, sizeof out);
}

static void expect(const char *args, int code, const char *fragment)
{
  shell_check(args, run(args), out, code, fragment);
}

static int count(const char *fragment)
{
  int n = 0;
  for (const char *at = out; (at = strstr(at, fragment)) != NULL; ++at) ++n;
  return n;
}

/* ---- frf ------------------------------------------------------------------------------------------- */

static void one_response_is_kept(void **state)
{
  (void)state;
  expect("frf " CHAIN "--at 1.2 --format csv -q", 0, "omega,branch,response,amplitude,");
  assert_int_equal(count("\n1.2,"), 3);
  expect("frf " CHAIN "--at 1.2 --format csv -q --response 3", 0, "\n1.2,0,3,");
  assert_int_equal(count("\n1.2,"), 1);
  expect("frf " CHAIN "--at 1.2 --format csv -q --response 2-1 --set 'response=[1, {2: 1, 1: -1}]'", 0,
         "\n1.2,0,-1+2,");
  assert_int_equal(count("\n1.2,"), 1);
  expect("frf " CASE2 "--at 5 --format csv -q --response x", 0, "\n5,0,");
  expect("frf " CHAIN "--at 1.2 --response 4 2>&1", 64,
         "hbmcheck frf: --response: the case has no `4`; expected one of 1, 2, 3\n");
  expect("frf " CASE2 "--at 5 --response y 2>&1", 64, "--response: the case has no `y`; expected x\n");
}

/* Number `column`, from 0, of the first line of `out` after `table` that begins with `start`. */
static double cell(const char *table, const char *start, int column)
{
  const char *line = strstr(out, table);
  assert_non_null(line);
  line = strstr(line, start);
  assert_non_null(line);
  for (++line; column > 0; --column) line = strchr(line, ',') + 1;
  return strtod(line, NULL);
}

/* The stop touches DOF 3 alone, N = 1 (x3 - 0.25); the sliders have mu N = 1, so their work is their path. */
static void every_contact_of_every_solution_has_a_row(void **state)
{
  (void)state;
  expect("frf " CHAIN "--at 1.25 --contacts --format csv -q", 0,
         "\n\n# Contacts\n"
         "omega,branch,contact,name,regime,normal_min,normal_max,traction_max,slip_distance,work\n"
         "1.25,0,0,ground,slip,1,1,1,");
  assert_int_equal(3 * count(",stop,separation,0,"), count("\n1.25,") - 3 * count(",stop,"));
  const double touching = cell("# Response", "\n1.25,0,3,", 4) - 0.25;
  CHECK_NEAR(cell("# Contacts", "\n1.25,0,2,stop", 6), touching, 1e-15, "N of the stop");
  const double path = cell("# Contacts", "\n1.25,0,0,ground", 8);
  assert_true(path > 0 && path == cell("# Contacts", "\n1.25,0,0,ground", 9));
  expect("frf " CASE2 "--at 8 --contacts --format csv -q", 0, "\nomega,branch,contact,regime,normal_min,");
  expect("frf " CHAIN "--at 1.25 --contacts --set hbm.force=sampled", 0, "contacts by the exact law along the motion");
  expect("frf " CASE2 "--contacts --format json -q --set sweep.omega=19,20", 0, "\"Contacts\": [");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_response_is_kept),
      cmocka_unit_test(every_contact_of_every_solution_has_a_row),
  };
  check_watchdog(60);
  return cmocka_run_group_tests_name("command.structures", tests, NULL, NULL);
}
