/* test_verdict.c - what a check says of numbers that it is given. */
#include "compare/comparison.h"
#include "compare/stress/solved_scene.h"
#include "tests/check.h"

/* A prediction of infinity says nothing; an error that is no number is a finding, whatever else is; members of a family
 * may be as far apart as two of them were measured to be, and no farther. */
static void a_prediction_is_held_by_numbers(CHECK_STATE)
{
  static const struct {
    double error, said;
    bool family;
    double apart;
    stress_outcome outcome;
    stress_reason reason;
  } rows[] = {{0.01, 0.004, false, 0, STRESS_AGREED, STRESS_NO_REASON},
              {0.01, 0.003, false, 0, STRESS_FINDING, STRESS_UNEXPECTED},
              {0.01, 0, false, 0, STRESS_FINDING, STRESS_UNEXPECTED},
              {NAN, 0.004, false, 0, STRESS_FINDING, STRESS_INTERNAL},
              {0.01, INFINITY, false, 0, STRESS_SKIPPED, STRESS_NO_ORBIT},
              {0.01, NAN, false, 0, STRESS_SKIPPED, STRESS_NO_ORBIT},
              {0.01, 0.003, false, 0.002, STRESS_FINDING, STRESS_UNEXPECTED},
              {0.01, 0.003, true, 0.002, STRESS_EXPLAINED, STRESS_FAMILY},
              {0.01, 0.003, true, 0.0005, STRESS_FINDING, STRESS_UNEXPECTED},
              {0.01, 0.003, true, NAN, STRESS_FINDING, STRESS_UNEXPECTED}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
    comparison_row r = {.verdict = VERDICT_MATCH, .family = rows[i].family};
    r.transient.period_multiple = 1;
    r.hbm.contact.regime = CONTACT_SLIPS;
    r.errors.amplitude = rows[i].error;
    r.hbm_predicted.amplitude = r.transient_predicted.amplitude = rows[i].said / 2;
    r.hbm_predicted.waveform = NAN;
    r.budget.amplitude.regularisation = rows[i].apart;
    const stress_check c = stress_hold_prediction(&r);
    if (c.outcome != rows[i].outcome || c.reason != rows[i].reason)
      fail_msg("row %zu: %s %s", i, stress_outcome_name(c.outcome), stress_reason_name(c.reason));
  }
}

/* Two motions that are both infinite, or a multiplier that nobody knows, are not near each other. */
static void infinite_distances_are_no_numbers(CHECK_STATE)
{
  const solved_scene s = {.n = 1, .n_coef = 3};
  const double x[] = {0, 1, INFINITY}, y[] = {0, 1, 2};
  const stress_motion known = {.stability.multiplier = 0.5}, unknown = {.stability_status = HC_NOT_CONVERGED};
  assert_true(isnan(stress_motion_distance(&s, x, x, false)) && isnan(stress_motion_distance(&s, x, y, false)));
  assert_true(isnan(stress_multipliers_apart(&known, &unknown)) && isnan(stress_multipliers_apart(&unknown, &known)));
}

CHECK_TESTS("stress.verdict", 60, a_prediction_is_held_by_numbers, infinite_distances_are_no_numbers)
