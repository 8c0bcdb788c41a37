/* verdict.c - the verdicts of `compare`, checked against what the other checks have found of the scene.
 *
 *     match                 all discrepancies are within the gate, and the waveform is within it of the exact law's
 *                           orbit, too, but for the budget's error of the transient
 *     unstable              the orbit next to the HBM solution is unstable by time integration
 *     differs, other_branch some discrepancy is beyond the gate
 *     period_k              k is 2 or more
 * What is true of its verdict ends as agreed (match), refused (solver_failed) or explained (all others). */
#include <math.h>

#include "campaigns/stress/solved_scene.h"
#include "compare/comparison.h"
#include "compare/motion.h"

/* Largest ratio of the gate; above 1: beyond. */
static double gate_ratio(const discrepancy *e, const discrepancy *g, bool free)
{
  double worst = fmax(e->amplitude / g->amplitude, fmax(e->harmonic_1 / g->harmonic_1, e->waveform / g->waveform));
  return free ? worst : fmax(worst, e->mean / g->mean);
}

static double known(double part) { return part > 0 ? part : 0; }

static bool wrong(const comparison_row *r, const discrepancy *g, double *ratio)
{
  *ratio = gate_ratio(&r->errors, g, motion_mean_is_free(&r->transient));
  bool orbit = r->orbit_status == HC_OK && !r->transient.left_orbit && budget_same_orbit(&r->transient, &r->orbit);
  switch (r->verdict) {
  case VERDICT_MATCH: {
    if (!(*ratio <= 1)) return true;
    double law = known(r->budget.waveform.regularisation) + known(r->budget.waveform.integration) +
                 known(r->budget.waveform.settling);
    return orbit && !(r->orbit_errors.waveform <= 1.01 * g->waveform + 1.01 * law);
  }
  case VERDICT_UNSTABLE:
    return r->orbit_status == HC_OK ? timeint_stability(&r->orbit) > 0 : hbm_stability_verdict(&r->stability) > 0;
  case VERDICT_DIFFERS:
  case VERDICT_OTHER_BRANCH: return *ratio <= 1;
  case VERDICT_PERIOD_K: return r->transient.period_multiple < 2;
  default: return false;
  }
}

static stress_check row_check(solved_scene *s, const comparison_row *r)
{
  const discrepancy g = gate_limits_at(&s->asked->gate, r->omega);
  double ratio;
  if (r->hbm_status == HC_BUG || r->transient_status == HC_BUG) return stress_find(STRESS_INTERNAL, NAN, NAN);
  if (wrong(r, &g, &ratio)) return stress_find(STRESS_WRONG_VERDICT, ratio, 1);
  if (r->verdict == VERDICT_MATCH) return stress_agree(ratio, 1);
  if (r->verdict != VERDICT_SOLVER_FAILED) return stress_explain(STRESS_SAID_SO, ratio, 1);
  hc_status st = r->hbm_status != HC_OK ? r->hbm_status : r->transient_status;
  return stress_refuse(s, st);
}

/* The amplitude's discrepancy of a row beside what both sides said it would be, or s->predicted if that is worse. Rows
 * in which no contact changes its state are left out: linear motions, rounding against rounding. */
static void hold_prediction(solved_scene *s, const comparison_row *r)
{
  const double said = r->hbm_predicted.amplitude + r->transient_predicted.amplitude;
  const bool one_orbit = r->verdict == VERDICT_MATCH || r->verdict == VERDICT_DIFFERS;
  if (!one_orbit || r->transient.period_multiple != 1 || isnan(said)) return;
  if (r->hbm.contact.regime <= CONTACT_STUCK) {
    if (s->predicted.outcome == STRESS_SKIPPED) s->predicted = stress_skip(STRESS_NOT_APPLICABLE);
    return;
  }
  const double ratio = r->errors.amplitude == 0 ? 0 : r->errors.amplitude / said, bound = COMPARISON_SLACK;
  if (s->predicted.outcome != STRESS_SKIPPED && !(ratio > s->predicted.error)) return;
  const stress_check agrees = stress_agree(ratio, bound);
  s->predicted =
      agrees.outcome == STRESS_AGREED || !r->unexpected ? agrees : stress_explain(STRESS_UNEXPECTED, ratio, bound);
}

stress_check stress_check_predicted(solved_scene *s) { return s->predicted; }

/* Worse is later in the list of outcomes. */
stress_check stress_check_verdict(solved_scene *s)
{
  comparison c = {0};
  compare_setup setup;
  hc_status st = scene_setup(s->asked, &setup);
  setup.spare = true;
  if (st == HC_OK) st = comparison_run(&setup, &s->monitor, &c);
  scene_setup_clear(&setup);
  stress_check worst = stress_skip(STRESS_NO_ORBIT);
  /* a frequency without an answer */
  if (c.n_rows == 0) worst = st == HC_OK ? stress_find(STRESS_INTERNAL, NAN, NAN) : stress_refuse(s, st);
  for (int i = 0; i < c.n_rows; ++i) {
    stress_check row = row_check(s, &c.rows[i]);
    hold_prediction(s, &c.rows[i]);
    if (row.outcome > worst.outcome) worst = row;
  }
  comparison_clear(&c);
  return worst;
}
