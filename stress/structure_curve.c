/* structure_curve.c - checks of a structure's solution against samples, and against the response curve through it. */
#include <math.h>
#include <stdlib.h>

#include "stress/outcomes.h"
#include "stress/solved_structure.h"

static const double near = 1e-6;

/* As of oscillators (limits.c): of second order; of first where a slider's rest hangs on one sample. */
stress_check stress_structure_sampled(solved_structure *s)
{
  const int n_harm = s->how.harmonics;
  hbm_settings how = s->how;
  double worst = 0, before = 0, error = 0;
  int solved = 0;
  hc_status failed = HC_OK;
  if (s->base.m.contact.regime == CONTACT_LINEAR) return stress_skip(STRESS_NOT_APPLICABLE);
  how.force = HBM_FORCE_SAMPLED;
  how.tolerance = 1e-11;
  for (how.samples = 256 + 2 * n_harm; how.samples <= 32768 && s->fatal == HC_OK; how.samples *= 4) {
    stress_motion sampled;
    stress_motion_solve(s, s->model, &how, s->omega, s->base.x, 1, &sampled);
    if (sampled.status != HC_OK) failed = sampled.status;
    else {
      before = error;
      /* sliders that never slip rest where they like */
      error = stress_motion_distance(s, sampled.x, s->base.x, s->base.m.contact.free_sliders > 0);
      worst = fmax(worst, error);
      ++solved;
    }
    stress_motion_free(&sampled);
    if (solved > 0 && error <= near) return stress_agree(error, near);
  }
  if (solved < 2) return stress_motion_refuse(s, failed);
  const double bound = fmax(worst / 8, before / 2);
  solved_structure_condition(s);
  if (error > bound && error <= s->solution_errs)
    return stress_explain(STRESS_ILL_CONDITIONED, error, s->solution_errs);
  return error <= bound ? stress_explain(STRESS_ALIASED, error, bound) : stress_find(STRESS_DISAGREES, error, bound);
}

/* ---- the curve ------------------------------------------------------------------------------------------ */

/* The solutions found at omega: each in balance; *nearest is the least distance to the one that is known. */
static stress_check hold_found(solved_structure *s, hbm_solver *h, const hbm_curve *found, double *nearest)
{
  double worst = 0, *x = malloc((size_t)s->n * (size_t)s->n_coef * sizeof *x);
  hc_status st = x ? HC_OK : HC_NO_MEMORY;
  *nearest = INFINITY;
  for (int k = 0; k < found->n && st == HC_OK; ++k) {
    hbm_stability stability;
    st = stress_motion_read(s, h, s->omega, hbm_curve_X(found, k), x);
    if (st != HC_OK) break;
    const double off = stress_imbalance(s, x);
    if (!(off <= worst)) worst = off;
    *nearest = fmin(*nearest, stress_motion_distance(s, x, s->base.x, s->base.m.contact.free_sliders > 0));
    st = hbm_stability_at(h, s->omega, hbm_curve_X(found, k), &stability);
    if (st == HC_OK && !(stability.multiplier >= 0)) worst = NAN;
  }
  free(x);
  return st == HC_OK ? stress_agree(worst, stress_balanced(s)) : stress_motion_refuse(s, st);
}

/* Another solution than the known one is no mistake where both are in balance: the curve is another branch. */
stress_check stress_structure_curve(solved_structure *s)
{
  hbm_solver *h = NULL;
  hbm_curve curve = {0}, found = {0};
  stress_check result;
  double nearest = INFINITY;
  hc_status st = hbm_solver_new(s->model, &s->how, &h);
  if (st == HC_OK) st = hbm_trace(h, s->from, s->to, &s->monitor, &curve);
  if (st == HC_OK) st = hbm_curve_at(h, &curve, s->omega, &found);
  if (st != HC_OK) result = stress_motion_refuse(s, st);
  else result = hold_found(s, h, &found, &nearest);
  const bool good = result.outcome == STRESS_AGREED;
  if (good && found.n == 0 && !curve.left_at_start) result = stress_find(STRESS_DISAGREES, NAN, near);
  else if (good && !(nearest <= near)) result = stress_explain(STRESS_OTHER_ORBIT, nearest, near);
  hbm_curve_free(&found);
  hbm_curve_free(&curve);
  hbm_solver_free(h);
  return result;
}
