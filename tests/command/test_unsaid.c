/* test_unsaid.c - what a comparison must say: means that are a matter of history, nothing nonlinear compared. */
#include "tests/program.h"

#define CASE2 SOURCE_DIR "/cases/paper/case2.yaml "
#define CASE1                                                                                                          \
  SOURCE_DIR "/cases/paper/case1.yaml " /* its slider sticks all the time at omega 12 (tests/reference, a10) */

static void a_free_mean_is_said_and_not_compared(CHECK_STATE)
{
  expect("frf " CASE1 "--at 12 --format json -q", 0, "\"mean_free\": \"yes\"");
  expect("frf " CASE1 "--at 12 --format json -q --set hbm.force=sampled", 0, "\"mean_free\": \"yes\"");
  expect("transient " CASE1 "--at 12 --format json -q", 0, "\"mean_free\": \"yes\"");
  expect("compare " CASE1 "--at 12 --format json -q", 0, "\"mean_free\": \"yes\"");
  expect("compare " CASE1 "--at 12 --format json -q", 0, "\"mean_error\": null");
  expect("compare " CASE1 "--at 12 -q", 0, "1 row without a mean to compare");
  expect("gate " CASE1 "--at 12 -q --format csv", 0, "not applicable: a slider never slips");
  expect("gate " CASE1 "--at 12 -q", 0, "4 checks, 3 passed, 0 failed, 0 could not be made, 1 not applicable");
  expect("gate " CASE1 "--at 12 -q --junit /dev/stdout -o /dev/null", 0, "<skipped message=\"not applicable:");
  assert_non_null(strstr(out, "skipped=\"1\""));
}

/* Where it slips or opens the mean is determined, and without friction there is no slider. */
static void a_determined_mean_is_compared(CHECK_STATE)
{
  expect("frf " CASE2 "--at 6 --format json -q", 0, "\"mean_free\": \"no\"");
  expect("frf " CASE2 "--at 6 --format json -q --set hbm.force=sampled", 0, "\"mean_free\": \"no\"");
  expect("frf " CASE1 "--at 12 --format json -q --set contacts[0].friction=0", 0, "\"mean_free\": \"no\"");
  expect("frf " CASE1 "--at 12 --format json -q --set contacts[0].angle_deg=90", 0, "\"mean_free\": \"no\"");
  expect("transient " CASE2 "--at 6 --format json -q", 0, "\"mean_free\": \"no\"");
  expect("compare " CASE2 "--at 6 --format json -q", 0, "\"mean_free\": \"no\"");
  assert_null(strstr(out, "\"mean_error\": null"));
  expect("compare " CASE2 "--at 6 -q", 0, "match");
  assert_null(strstr(out, "mean_free"));
}

/* An angle in radians is one of 0.785 degrees: the contact of case 2 is never touched. */
static void nothing_nonlinear_is_said(CHECK_STATE)
{
#define RADIANS "--set contacts[0].angle_deg=0.785 "
  expect("compare " CASE2 RADIANS "-q", 0,
         "nothing nonlinear was compared: no contact changes its state in any of the 6");
  expect("compare " CASE2 RADIANS "2>&1 >/dev/null", 0, "compare: nothing nonlinear was compared");
  expect("compare " CASE2 RADIANS "--format json -q", 0, "nothing nonlinear was compared");
  expect("gate " CASE2 RADIANS "-q", 0, "nothing nonlinear was compared");
  expect("gate " CASE2 RADIANS "-q --set gate.nonlinear=required", 1, "25 checks, 24 passed, 1 failed");
  expect("gate " CASE2 "-q --set gate.nonlinear=required", 0, "0 failed");
  assert_null(strstr(out, "nothing nonlinear"));
  expect("compare " CASE1 "--at 12 -q", 0, "nothing nonlinear was compared"); /* stuck all the time is linear, too */
  expect("compare " CASE2 "--at 4,6 -q", 0, "match");
  assert_null(strstr(out, "nothing nonlinear"));
}

/* A mass without a spring, its contact apart at rest: anywhere apart is as good a place for it. */
static void an_undetermined_mean_is_said(CHECK_STATE)
{
#define FREE_MASS "--set oscillator.stiffness=0 --set forcing.amplitude=10 "
#define ADRIFT    "the mean is undetermined while nothing touches: oscillator.stiffness is 0"
  expect("frf " CASE2 FREE_MASS "--at 6 2>&1 >/dev/null", 3, "the Jacobian is singular; " ADRIFT);
  expect("frf " CASE2 FREE_MASS "--at 6 -q --format json 2>/dev/null", 3, ADRIFT);
  expect("compare " CASE2 FREE_MASS "--at 6 -q 2>/dev/null", 3, ADRIFT);
  expect("transient " CASE2 FREE_MASS "--at 6 --set transient.max_periods=50 2>&1 >/dev/null", 3, ADRIFT);
  expect("frf " CASE2 FREE_MASS "--at 6 -q --set hbm.static=false 2>&1", 0, "6 ");
  assert_null(strstr(out, "undetermined"));
  expect("frf " CASE2 FREE_MASS "--at 6 -q --set contacts[0].gap=5 2>&1", 0, "6 ");
  assert_null(strstr(out, "undetermined"));
}

CHECK_TESTS("command.unsaid", 300, a_free_mean_is_said_and_not_compared, a_determined_mean_is_compared,
            nothing_nonlinear_is_said, an_undetermined_mean_is_said)
