/* predict.c - see predict.h. Proof: tests/hbm/test_predict.c. */
#include "hbm/curve/predict.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/solver/hbm_solver_impl.h"
#include "numerics/norm.h"
#include "numerics/series.h"

enum {
  MOST_FINER = 100,     /* some milliseconds of an oscillator */
  MOST_UNKNOWNS = 1500, /* of the finer equations of many coordinates: about a second a step */
  STRIDE = 20,          /* harmonics between two sizes of the workspace, which is remade with each */
  MOST_STEPS = 10       /* of Newton: one or two but near turning points and for stiff contacts */
};

static const double converged = 0.02; /* a step this small beside what all came to changes the error by as little */
/* [1] in the metric at X. Newton that has not converged after steps as long has no such solution to come to; one that
 * far away is another: beyond a fold of theirs the finer equations have none next to X, and no number bounds what X is
 * off. */
static const double lost = 0.1, another = 0.3;
static const double roundings = 4; /* a motion and its measures take a few */

/* Twice the harmonics, and more where these do not reach the natural frequency of the mass on its stuck contacts, at
 * which it swings after each impact: up to there errors hardly fall with the harmonics, and twice as many say
 * nothing. Of many coordinates no more than MOST_UNKNOWNS allow, or twice as many. */
static int finer_harmonics(double highest, int n_harm, int dim, double omega)
{
  if (n_harm > HBM_MAX_HARMONICS / 2) return n_harm / 2;
  const int twice = 2 * n_harm > REFINE_FEWEST_HARMONICS ? 2 * n_harm : REFINE_FEWEST_HARMONICS;
  const double own = ceil(highest / (STRIDE * omega)) * STRIDE;
  const int affordable = (MOST_UNKNOWNS / (dim > 0 ? dim : 1) - 1) / 2;
  const int most = affordable < MOST_FINER ? affordable : MOST_FINER;
  return own > twice ? (int)fmin(own, fmax(most, twice)) : twice;
}

/* What is made at the first call; freed with the equations. */
static hc_status need_finer(hbm_solver *s, double omega)
{
  const int n_harm = finer_harmonics(s->sys.scales.highest, s->sys.n_harm, s->sys.dim, omega);
  if (s->exact_finer && refinement_harmonics(s->exact_finer) == n_harm) return HC_OK;
  refinement_free(s->exact_finer);
  free(s->improved);
  s->exact_finer = NULL;
  hbm_settings how = s->how;
  how.force = HBM_FORCE_EXACT;
  how.keep_mean = true;
  s->n_improved = hbm_system_length(&s->sys, n_harm > s->sys.n_harm ? n_harm : s->sys.n_harm);
  s->improved = calloc(2 * (size_t)s->n_improved, sizeof *s->improved);
  s->asked = s->improved ? s->improved + s->n_improved : NULL;
  return s->improved ? refinement_new(&s->sys, &how, n_harm, 0, &s->exact_finer) : HC_NO_MEMORY;
}

/* [1] How far s->improved is from X. */
static double improvement(const hbm_solver *s)
{
  const metric_at at = {s->sys.metric, s->n_improved, s->asked, NULL};
  return metric_distance(&at, s->improved, s->asked);
}

/* Newton on the finer equations from s->improved. *least [1] is added to the error: some roundings; where Newton does
 * not converge, also its longest step; INFINITY where it ends too far from X, or takes steps as long without
 * converging: no solution is next to X. */
static hc_status improve(hbm_solver *s, double omega, double *least)
{
  double last, longest = 0;
  *least = 0;
  bool found = false;
  for (int k = 0; k < MOST_STEPS && !found; ++k) {
    const hc_status st = refinement_step(s->exact_finer, omega, s->improved, &last);
    if (st != HC_OK && k == 0) return st;
    if (st != HC_OK) break;
    if (k == 0) *least = roundings * refinement_rounding(s->exact_finer, omega);
    longest = fmax(longest, last);
    found = last <= *least || (k > 0 && last <= converged * improvement(s));
  }
  if (!found) *least += longest;
  const double far = fmax(found ? 0 : longest, improvement(s));
  if (!(far <= (found ? another : lost))) *least = INFINITY;
  return HC_OK;
}

static periodic_motion motion_of(int n_harm, const double *x)
{
  double max, min;
  series_extrema(n_harm, x, &max, &min);
  return motion_of_series(n_harm, x, max, min);
}

/* The first response's motion; x[2 n_harm + 1] is room. */
static periodic_motion measured(const hbm_solver *s, int n_harm, const double *X, double *x)
{
  hbm_system_response(&s->sys, n_harm, X, x);
  return motion_of(n_harm, x);
}

/* What n harmonics leave out is added. Of sampled forces and n < H all of the distance may be aliasing, which more
 * harmonics do not mend. */
static double extrapolation(const hbm_solver *s, int n)
{
  const double ratio = fmax((double)s->sys.n_harm / n, n > s->sys.n_harm ? 0.5 : 0);
  return s->how.force == HBM_FORCE_SAMPLED && ratio > 1 ? 1 : 1 / fabs(1 - ratio * ratio * ratio);
}

/* From the two motions of one response. All of *out is NaN unless HC_OK. */
static hc_status error_between(const hbm_solver *s, const periodic_motion *ours, const periodic_motion *better,
                               motion_error *out)
{
  const motion_distance d = motion_between(ours, better);
  const double factor = extrapolation(s, refinement_harmonics(s->exact_finer)), waveform = factor * d.waveform;
  const double least = s->improved_least * ours->amplitude;
  *out = (motion_error){.amplitude = fmax(factor * d.amplitude, MOTION_LEAST_SHARE * waveform) + least,
                        .harmonic_1 = fmax(factor * d.harmonic_1, MOTION_LEAST_SHARE * waveform) + least,
                        .waveform = waveform + least};
  const double sum = out->amplitude + out->harmonic_1 + out->waveform;
  if (isnan(sum)) *out = (motion_error){NAN, NAN, NAN};
  return isnan(sum) ? HC_NOT_FINITE : HC_OK;
}

hc_status hbm_predict(hbm_solver *s, double omega, const double *X, motion_error *out)
{
  *out = (motion_error){NAN, NAN, NAN};
  hc_status st = need_finer(s, omega);
  if (st != HC_OK) return st;
  const int n_harm = s->sys.n_harm, n = refinement_harmonics(s->exact_finer);
  memset(s->improved, 0, 2 * (size_t)s->n_improved * sizeof *s->improved);
  memcpy(s->asked, X, (size_t)s->sys.n_coef * sizeof *s->asked);
  memcpy(s->improved, X, (size_t)hbm_system_length(&s->sys, n < n_harm ? n : n_harm) * sizeof *s->improved);
  st = improve(s, omega, &s->improved_least);
  if (st != HC_OK) return st;
  const periodic_motion ours = measured(s, n_harm, X, s->x), better = measured(s, n, s->improved, s->x);
  return error_between(s, &ours, &better, out);
}

hc_status hbm_predict_response(hbm_solver *s, double omega, const double *X, int r, motion_error *out)
{
  *out = (motion_error){NAN, NAN, NAN};
  hc_status st = hbm_response(s, omega, X, r, s->x);
  if (st != HC_OK) return st;
  const periodic_motion ours = motion_of(s->sys.n_harm, s->x);
  if ((st = refinement_response(s->exact_finer, omega, s->improved, r, s->x)) != HC_OK) return st;
  const periodic_motion better = motion_of(refinement_harmonics(s->exact_finer), s->x);
  return error_between(s, &ours, &better, out);
}

hc_status hbm_predict_reduction(hbm_solver *s, double omega, const double *X, double error, double *moved)
{
  const hbm_system *sys = &s->sys;
  s->omega = s->z[sys->n] = omega;
  memcpy(s->z, X + sys->first, (size_t)sys->n * sizeof *s->z);
  hc_status st = newton_factor_at(s->fixed, s->z);
  for (int turned = 0; turned < 2 && st == HC_OK; ++turned, moved += sys->n_coef) {
    hbm_system_linear(&s->sys, X, turned, s->z);
    st = newton_backsolve(s->fixed, s->z);
    memcpy(moved, X, (size_t)sys->n_coef * sizeof *moved);
    for (int i = 0; i < sys->n; ++i) moved[sys->first + i] += error * s->z[i];
  }
  return st;
}
