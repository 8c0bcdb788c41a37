/* test_command.c - hbmcheck verify as people use it: the shipped example, exit codes, columns, messages. */
#include "tests/folder.h"
#include "tests/program.h"

#define EXAMPLE "verify cases/verify/case2.yaml --against cases/verify/no_static.csv --columns omega=1,harmonic_1=2 "

static void the_shipped_example_is_named(CHECK_STATE)
{
  expect(EXAMPLE, 1, "suspected cause: harmonic 0 is missing (hbm.static: false, ");
  expect(EXAMPLE "-q --format csv", 1, "omega,value,nearest,branch,stable,error,verdict,line\n");
  expect(EXAMPLE "-q --format csv", 1, "# cause: no_static_harmonic\n");
  expect(EXAMPLE "-q --format json", 1, "\"cause\": \"no_static_harmonic\"");
  expect(EXAMPLE "-q --format csv --set sweep.frequency=0.5,3", 1,
         "omega,frequency,value,nearest,branch,stable,error,verdict,line\n4,0.63661977236758138,");
  run(EXAMPLE "-q");
  const char *held = strstr(out, "truth held against time integration");
  assert_non_null(held);
  assert_null(strstr(held, " 0.0e+00 off")); /* truncated series are off by something */
}

/* Our own curve, as frf writes it: branches, unstable points and remarks included. */
static void our_own_curve_matches(CHECK_STATE)
{
#define OURS "verify cases/paper/case2.yaml -q --against $D/ours.csv --columns "
  expect("frf cases/paper/case2.yaml -q --format csv --set hbm.harmonics=20 -o $D/ours.csv", 0, "");
  expect(OURS "omega=omega,amplitude=amplitude", 0, "no cause to suspect");
  expect(OURS "frequency=omega,value=amplitude --quantity amplitude", 1, "cause: frequency_unit");
  expect(OURS "omega=1,amplitude=8", 1, "cause: other_quantity");
}

static void mistakes_are_named(CHECK_STATE)
{
  expect("verify cases/verify/case2.yaml 2>&1", 64, "--against");
  expect("verify cases/verify/case2.yaml --against LICENSE 2>&1", 2, "--columns");
  expect("verify cases/verify/case2.yaml --against cases/verify/no_static.csv --columns omega=1,amplitud=2 2>&1", 64,
         "did you mean amplitude");
  expect("verify cases/verify/case2.yaml --against cases/verify/no_static.csv --columns omega=1,value=2 2>&1", 64,
         "--quantity");
  expect("verify cases/verify/case2.yaml --against cases/verify/no_static.csv --columns omega=1,amplitude=9 2>&1", 2,
         "no_static.csv:4:1: no column 9");
  expect("verify cases/verify/case2.yaml --against /dev/null --columns omega=1,amplitude=2 2>&1", 2,
         "/dev/null:1:1: 0 points");
  expect("verify cases/verify/case2.yaml --against /nonexistent.csv --columns omega=1,amplitude=2 2>&1", 2,
         "/nonexistent.csv: ");
  expect("verify /nonexistent.yaml --against /dev/null --columns omega=1,amplitude=2 2>&1", 2, "/nonexistent.yaml: ");
  expect(EXAMPLE "--noise 2 2>&1", 64, "--noise: '2' is no scatter, expected a number from 0 to 1");
  expect(EXAMPLE "--noise -1 2>&1", 64, "is no scatter");
  expect("verify --help", 0, "example");
  expect("--help", 0, "verify");
}

/* Up to omega 12 the slider of case 1 never slips (tests/reference, a10), and its mean is a matter of history. */
static void a_free_mean_is_skipped(CHECK_STATE)
{
#define CASE1 "verify cases/paper/case1.yaml -q --against /dev/stdin --quantity mean "
  expect(CASE1 "<<'END'\nomega,mean\n10,7\n11,0\n12,-7\n13,-0.11747504\nEND\n", 0,
         "3 points not compared: the mean is free");
  expect(CASE1 "<<'END'\nomega,mean\n10,7\n11,0\n12,-7\n13,-0.1\nEND\n", 1, "1 differs");
  expect(CASE1 "--format json <<'END'\nomega,mean\n10,7\n11,0\n12,-7\n13,-0.11747504\nEND\n", 0, "\"skipped\": 3");
  expect(CASE1 "2>&1 <<'END'\nomega,mean\n10,7\n11,0\n12,-7\nEND\n", 3, "no point could be compared: the mean is free");
}

/* Far from the sweep nothing is known, and that is not a match. */
static void what_cannot_be_judged_is_said(CHECK_STATE)
{
  expect(
      "verify cases/verify/case2.yaml -q --against /dev/stdin --columns omega=1,amplitude=2 2>&1 <<'END'\n1e6 1\n2e6 "
      "1\n3e6 1\nEND\n",
      3, "solver_failed");
}

CHECK_TESTS_WITH("verify.command", 300, folder_make, folder_remove, the_shipped_example_is_named, our_own_curve_matches,
                 mistakes_are_named, a_free_mean_is_skipped, what_cannot_be_judged_is_said)
