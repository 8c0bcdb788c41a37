/* test_frequency.c - frequencies in the unit of the sweep everywhere, and a word where they lie outside it. */
#include "tests/program.h"

#define CASE2  SOURCE_DIR "/cases/paper/case2.yaml "
#define CYCLES "--set sweep.frequency=0.5,3.2 "

/* Column `index` of the first row of csv after its header, in out[]. */
static double cell(int index)
{
  const char *at = out;
  while (*at == '#') at = strchr(at, '\n') + 1;
  at = strchr(at, '\n') + 1;
  for (int i = 0; i < index; ++i) at = strchr(at, ',') + 1;
  return strtod(at, NULL);
}

static void at_is_in_cycles_where_the_sweep_is(CHECK_STATE)
{
  expect("frf " CASE2 CYCLES "--at 1 --format csv -q", 0, "omega,frequency,branch,amplitude");
  assert_true(cell(0) == TWO_PI && cell(1) == 1);
  double amplitude = cell(3);
  expect("frf " CASE2 "--at 6.28318530717958647693 --format csv -q", 0, "omega,branch,amplitude");
  CHECK_LE(fabs(cell(2) - amplitude), 1e-8 * amplitude, "solved from neighbours of two sweeps, to hbm.tolerance");
  expect("transient " CASE2 CYCLES "--at 1 --format csv -q", 0, "omega,frequency,verdict");
  assert_true(cell(0) == TWO_PI && cell(1) == 1);
  expect("compare " CASE2 CYCLES "--at 1 --format csv -q", 0, "omega,frequency,branch,verdict");
  assert_true(cell(0) == TWO_PI && cell(1) == 1);
  expect("gate " CASE2 CYCLES "--at 1 --format csv -q", 0, "case,omega,frequency,branch");
  assert_true(cell(1) == TWO_PI && cell(2) == 1);
  expect("gate " CASE2 CYCLES "--at 1 -q -o /dev/null --junit /dev/stdout", 0, "name=\"frequency 1 branch 0: mean\"");
  expect("compare " CASE2 CYCLES "--at 1 --tables --harmonics 5 --samples 64 --format csv -q", 0, ",peak_frequency,");
}

/* The paper's blade between 250 and 500 cycles: 345 is a frequency there, not 345 rad per time. */
static void cycles_are_not_taken_for_radians(CHECK_STATE)
{
  expect("frf " SOURCE_DIR "/cases/paper/table10_case2.yaml --set sweep.frequency=250,500 --at 345 --format csv -q", 0,
         "omega,frequency");
  CHECK_LE(fabs(cell(0) - 2167.69893097696), 1e-11, "2 pi 345"); /* half a digit of what is written here */
}

static void compare_takes_frequencies_too(CHECK_STATE)
{
  expect("compare " CASE2 "--set compare.frequency=1 --format csv -q", 0, "omega,branch");
  assert_true(cell(0) == 8 * atan(1));
  expect("frf " CASE2 "--set compare.frequency=1 --set compare.omega=5 --at 6 --format csv -q", 0, "\n6,");
  expect("compare " CASE2 "--set compare.frequency=0 2>&1", 2, "compare.frequency has the entry `0`, expected");
}

/* A limit of 1e-9 in a range that holds omega 6.28 = frequency 1 only if it is read in cycles. */
static void the_gates_ranges_are_in_the_sweeps_unit(CHECK_STATE)
{
#define TIGHT "--set gate.ranges=0.9,1.1 --set gate.range_amplitude=1e-9 "
  expect("gate " CASE2 CYCLES TIGHT "--at 1 -q", 1, "fail");
  expect("gate " CASE2 TIGHT "--at 6.28318530717958647693 -q", 0, "pass");
}

static void what_is_said_is_in_cycles(CHECK_STATE)
{
  /* grazing at omega 5.0995831509 (closed form): 5.0995831509/(2 pi) */
  expect("frf " CASE2 CYCLES "-q", 0, "frequency = 0.8116238662 (omega = 5.0995831509)");
  expect("frf " CASE2 CYCLES "-q --set hbm.continuation=natural 2>&1 >/dev/null", 3, "stopped at frequency = 1.46");
  expect("frf " CASE2 CYCLES "--at 1 -q --plot - ", 0, "frequency [cycles/s]");
}

static void outside_the_sweep_is_warned_of(CHECK_STATE)
{
  expect("frf " CASE2 "--at 25 2>&1 >/dev/null", 0, "omega = 25: outside the sweep from 3 to 20, which is widened");
  expect("compare " CASE2 "--at 5,25,2.5 2>&1 >/dev/null", 0, "omega = 25 and 1 more: outside the sweep");
  expect("frf " CASE2 "--at 1.2 2>&1 >/dev/null", 0, "frequencies here are in rad per s");
  expect("frf " CASE2 "--set sweep.frequency=1,3 --at 6.5 2>&1 >/dev/null", 0, "frequencies here are in cycles per s");
  expect("frf " CASE2 "--at 3,20 2>&1 >/dev/null", 0, "");
  assert_string_equal(out, ""); /* the ends belong to the sweep */
  expect("frf " CASE2 CYCLES "--at 0.5,3.2 2>&1 >/dev/null", 0, "");
  assert_string_equal(out, "");
}

/* 0.6 rad: 3.77 if it is in cycles, in the sweep from 3 to 20; 18.5 is 8 times below the bladed disk's sweep as 116. */
static void the_other_unit_is_refused_far_outside(CHECK_STATE)
{
#define FAR_BELOW "omega = 0.6: far outside the sweep from 3 to 20, did you mean 3.77 (rad per s)?"
  expect("frf " CASE2 "--at 0.6 2>&1", 2, FAR_BELOW);
  expect("compare " CASE2 "--at 6,0.6 -q 2>&1", 2, FAR_BELOW);
  expect("compare " CASE2 "--set compare.omega=0.6 2>&1", 2, FAR_BELOW);
  expect("transient " CASE2 "--at 0.6 --set transient.start=rest 2>&1", 2, FAR_BELOW);
  expect("bench " CASE2 "--at 0.6 2>&1", 2, FAR_BELOW);
  expect("gate " CASE2 SOURCE_DIR "/cases/paper/case1.yaml --at 0.6 2>&1", 2, "case1.yaml: " FAR_BELOW);
  expect("gate " CASE2 "--at 0.6 --junit /dev/stdout 2>/dev/null", 2, "<error message=\"" FAR_BELOW);
  expect("frf " CASE2 CYCLES "--at 30 2>&1", 2, "from 0.5 to 3.2 cycles, did you mean 4.77 (cycles per s)?");
  expect("compare " CASE2 CYCLES "--set compare.omega=0.6 2>&1", 2, "did you mean 3.77 (rad per s)?");
  expect("compare " SOURCE_DIR "/cases/structures/bladed_disk.yaml --at 18.5 2>&1", 2, "did you mean 116 (rad per s)?");
  /* the way out that the message names */
  expect("compare " CASE2 "--at 0.6 2>&1", 2, "--set sweep.omega=0.6,0.606");
  expect("frf " CASE2 "--at 0.6 --set sweep.omega=0.6,0.606 -q", 0, "\n  0.6       0");
}

/* Above every resonance and far below the gap the motion is linear: F0/|k - m omega^2 + i c omega| at omega = 100. */
static void far_outside_is_solved_without_the_curve(CHECK_STATE)
{
  const double expected = 100 / hypot(40 - 1e4, 0.4 * 100);
  const char *const alone = "omega = 100: far outside the sweep from 3 to 20, solved for without the response curve";
  expect("frf " CASE2 "--at 100 --format csv 2>/dev/null", 0, "reached the end of the sweep, omega = 100.1");
  CHECK_LE(fabs(cell(2) - expected), 1e-10 * expected, "hbm.tolerance");
  expect("frf " CASE2 "--at 100 2>&1 >/dev/null", 0, alone);
  expect("compare " CASE2 "--set sweep.omega=20,3 --at 100 2>&1 >/dev/null", 0, alone);
  expect("compare " CASE2 "--at 100,120 --format csv -q", 0, "\n120,0,match");
  expect("transient " CASE2 "--at 100 --format csv -q", 0, "hbm branch 0");
  /* some near and some far: the curve would be followed over all that lies between, but for a start at rest */
  expect("compare " CASE2 "--at 5,100 2>&1", 2, "expected all frequencies within a factor 4 of it; give it a run");
  expect("compare " CASE2 "--at 81,400 2>&1", 2, "omega = 81: far outside");
  expect("transient " CASE2 "--at 5,100 --set transient.start=rest --format csv -q", 0, "\n100,settled");
  expect("transient " CASE2 "--at 100 --set transient.start=up --format csv -q", 0, "\n100,settled");
  /* factor 4 itself: as if it were near */
  expect("frf " CASE2 "--at 80 2>&1 >/dev/null", 0, "omega = 80: outside the sweep from 3 to 20, which is widened");
  expect("frf " CASE2 "--at 0.75 2>&1 >/dev/null", 0, "omega = 0.75: outside the sweep from 3 to 20, which is widened");
}

CHECK_TESTS("command.frequency", 300, at_is_in_cycles_where_the_sweep_is, cycles_are_not_taken_for_radians,
            compare_takes_frequencies_too, the_gates_ranges_are_in_the_sweeps_unit, what_is_said_is_in_cycles,
            outside_the_sweep_is_warned_of, the_other_unit_is_refused_far_outside,
            far_outside_is_solved_without_the_curve)
