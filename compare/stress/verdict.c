/* verdict.c - the verdicts of `compare`, checked against what the other checks have found of the scene.
 *
 *     match                 all discrepancies are within the gate, and the waveform is within it of the exact law's
 *                           orbit, too, but for the budget's error of the transient
 *     unstable              the orbit next to the HBM solution is unstable by time integration, or at a corner
 *     differs, other_branch some discrepancy is beyond the gate
 *     period_k              k is 2 or more
 * What is true of its verdict ends as agreed (match), explained (these others) or refused (no steady state was found:
 * solver_failed, not_settled, aperiodic, unbounded, creeps). */
#include <math.h>

#include "compare/comparison.h"
#include "compare/motion.h"
#include "compare/stress/solved_scene.h"
#include "numerics/norm.h"

static double known(double part) { return part > 0 ? part : 0; }

double stress_gate_ratio(const comparison_row *r, const discrepancy *g)
{
  double worst = larger(r->errors.amplitude / g->amplitude,
                        larger(r->errors.harmonic_1 / g->harmonic_1, r->errors.waveform / g->waveform));
  return motion_mean_is_free(&r->transient) ? worst : larger(worst, r->errors.mean / g->mean);
}

static bool wrong(const comparison_row *r, const discrepancy *g, double *ratio)
{
  *ratio = stress_gate_ratio(r, g);
  if (r->still) return false; /* not compared */
  bool orbit = r->orbit_status == HC_OK && !r->transient.left_orbit && budget_same_orbit(&r->transient, &r->orbit);
  switch (r->verdict) {
  case VERDICT_MATCH:
  case VERDICT_FAMILY: {
    if (!(*ratio <= 1)) return true;
    double law = known(r->budget.waveform.regularisation) + known(r->budget.waveform.integration) +
                 known(r->budget.waveform.settling);
    return orbit && !(r->orbit_errors.waveform <= 1.01 * g->waveform + 1.01 * law);
  }
  case VERDICT_UNSTABLE:
    if (r->response > 0) return false; /* what is said of the first response is said of the solution */
    if (r->orbit_status == HC_OK && r->orbit.free_sliders > 0 && hbm_stability_verdict(&r->stability) == 0)
      return false; /* multipliers are those of one side (compare/solution.c) */
    return r->orbit_status == HC_OK ? timeint_stability(&r->orbit) > 0 : hbm_stability_verdict(&r->stability) > 0;
  case VERDICT_DIFFERS:
  case VERDICT_OTHER_BRANCH: return !(*ratio > 1);
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
  if (comparison_agrees(r)) return stress_agree(r->still ? 0 : ratio, 1);
  const hc_status failed = r->hbm_status != HC_OK ? r->hbm_status : r->transient_status;
  return failed == HC_OK ? stress_explain(STRESS_SAID_SO, ratio, 1) : stress_refuse(s, failed);
}

/* Amplitude and waveform, as far as both sides said something. Rows in which no contact changes its state are left out:
 * linear motions, rounding against rounding. Predictions know nothing of a family: its members may be as far apart as
 * the budget's two are. */
stress_check stress_hold_prediction(const comparison_row *r)
{
  const discrepancy *hbm = &r->hbm_predicted, *transient = &r->transient_predicted;
  const double said[] = {hbm->amplitude + transient->amplitude, hbm->waveform + transient->waveform};
  const double found[] = {r->errors.amplitude, r->errors.waveform},
               apart[] = {known(r->budget.amplitude.regularisation), known(r->budget.waveform.regularisation)};
  const bool one_orbit = comparison_one_orbit(r);
  stress_check worst = stress_skip(STRESS_NO_ORBIT);
  if (!one_orbit || r->transient.period_multiple != 1) return worst;
  if (r->hbm.contact.regime <= CONTACT_STUCK) return stress_skip(STRESS_NOT_APPLICABLE);
  for (int i = 0; i < 2; ++i) {
    const double ratio = found[i] == 0 ? 0 : found[i] / said[i], bound = COMPARISON_SLACK;
    if (!isfinite(said[i])) continue;
    stress_check c = stress_agree(ratio, bound);
    if (c.outcome == STRESS_FINDING && !isnan(ratio)) c.reason = STRESS_UNEXPECTED;
    if (ratio > bound && r->family && found[i] <= bound * said[i] + apart[i])
      c = stress_explain(STRESS_FAMILY, ratio, bound + apart[i] / said[i]);
    worst = stress_worse(worst, c);
  }
  return worst;
}

hc_status stress_compare(solved_scene *s, const model *m, comparison *out)
{
  enum { MOST_PERIODS = 600, MOST_UNKNOWNS = 400 };
  const double beside = 1e-3;
  const int coordinates = 2 * s->model->n_contacts < s->n ? 2 * s->model->n_contacts : s->n;
  const int most = MOST_UNKNOWNS / (2 * coordinates), given = s->how.harmonics;
  const int enough = s->enough > 0 ? s->enough : s->fine.harmonics;
  scene sc = *s->asked;
  if (sc.hbm.force == HBM_FORCE_EXACT && enough > given)
    sc.hbm.harmonics = enough < most ? enough : given < most ? most : given;
  if (sc.transient.max_periods > MOST_PERIODS) sc.transient.max_periods = MOST_PERIODS;
  sc.omega_from = s->omega * (1 - beside), sc.omega_to = s->omega * (1 + beside);
  *out = (comparison){0};
  compare_setup setup;
  hc_status st = scene_setup(&sc, &setup);
  compare_setup asked = setup;
  if (m) asked.model = m;
  asked.limits = &s->asked->gate;
  asked.spare = true;
  if (st == HC_OK) st = comparison_run(&asked, &s->monitor, out);
  scene_setup_clear(&setup);
  if (st == HC_NO_MEMORY) s->fatal = st;
  return st;
}

/* The worst of all rows; s->predicted: the worst of what their errors are of what both sides said beforehand. */
stress_check stress_check_verdict(solved_scene *s)
{
  comparison c;
  stress_check worst = stress_skip(STRESS_NO_ORBIT);
  hc_status st = stress_compare(s, NULL, &c);
  /* a frequency without an answer */
  if (c.n_rows == 0) worst = st == HC_OK ? stress_find(STRESS_INTERNAL, NAN, NAN) : stress_refuse(s, st);
  for (int i = 0; i < c.n_rows; ++i) {
    stress_check row = row_check(s, &c.rows[i]);
    const stress_check predicted = stress_hold_prediction(&c.rows[i]);
    s->predicted = s->predicted.outcome == STRESS_SKIPPED ? predicted : stress_worse(s->predicted, predicted);
    if (row.outcome > worst.outcome) worst = row;
  }
  comparison_clear(&c);
  return worst;
}

stress_check stress_check_predicted(solved_scene *s) { return s->predicted; }
