/* predict.c - see predict.h. Proof: tests/hbm/test_predict.c. */
#include "hbm/curve/predict.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/solver/hbm_solver_impl.h"
#include "hbm/solver/stability.h"
#include "numerics/norm.h"
#include "numerics/series.h"

enum {
  MOST_OF_ROWS = 600, /* unknowns with twice the harmonics up to which all rows are examined: tens of milliseconds */
  MOST_FINER = 100,   /* harmonics of the finer equations, when more than twice: some milliseconds for an oscillator */
  MOST_UNKNOWNS = 1500, /* of those finer equations with many coordinates: about a second a step */
  STRIDE = 20,          /* harmonics above twice are a multiple of this: a new number remakes the workspace */
  MOST_STEPS = 10, /* Newton steps for motions: one or two suffice but near turning points and for stiff contacts */
  FEW_STEPS = 5    /* Newton steps for multipliers, where no convergence just means unknown bounds */
};

static const double converged = 0.02; /* [correction] Newton step at which the error is known to 2 % */
/* [1] in the metric at X: no finer solution is next to X if Newton has not converged and moved or stepped by more than
 * `lost`, or converged farther away than `another`. The error is then unbounded: the finer equations may have none
 * beyond a fold. */
static const double lost = 0.1, another = 0.3;
static const double roundings = 4; /* error bound of a motion and its measures, in units of the rounding of a step */

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

/* Prepares finer equations of n_harm harmonics, made again if that number changes and freed with the solver, and X
 * padded with zeros as start. */
static hc_status begin_finer(hbm_solver *s, finer_solution *f, int n_harm, const double *X)
{
  const int ours = s->sys.n_harm;
  hc_status st = HC_OK;
  if (!f->by || refinement_harmonics(f->by) != n_harm) {
    hbm_settings how = s->how;
    how.force = HBM_FORCE_EXACT;
    how.keep_mean = true;
    refinement_free(f->by);
    free(f->improved);
    *f = (finer_solution){.n = hbm_system_length(&s->sys, n_harm > ours ? n_harm : ours)};
    f->improved = calloc(2 * (size_t)f->n, sizeof *f->improved);
    f->asked = f->improved ? f->improved + f->n : NULL;
    st = f->improved ? refinement_new(&s->sys, &how, n_harm, 0, &f->by) : HC_NO_MEMORY;
  }
  if (st != HC_OK) return st;
  memset(f->improved, 0, 2 * (size_t)f->n * sizeof *f->improved);
  memcpy(f->asked, X, (size_t)s->sys.n_coef * sizeof *X);
  memcpy(f->improved, X, (size_t)hbm_system_length(&s->sys, n_harm < ours ? n_harm : ours) * sizeof *X);
  return HC_OK;
}

/* [1] Distance of f->improved from X in the metric. */
static double improvement(const hbm_solver *s, const finer_solution *f)
{
  const metric_at at = {s->sys.metric, f->n, f->asked, NULL};
  return metric_distance(&at, f->improved, f->asked);
}

/* Newton on the finer equations from f->improved. f->least [1] is added to the error: some roundings; where Newton does
 * not converge, also its longest step; INFINITY where it ends too far from X, or takes steps as long without
 * converging: no solution is next to X. */
static hc_status improve(hbm_solver *s, finer_solution *f, double omega, int most)
{
  double last, longest = 0;
  f->least = 0;
  f->found = false;
  for (int k = 0; k < most && !f->found; ++k) {
    const hc_status st = refinement_step(f->by, omega, f->improved, &last);
    if (st != HC_OK && k == 0) return st;
    if (st != HC_OK) break;
    if (k == 0) f->least = roundings * refinement_rounding(f->by, omega);
    longest = fmax(longest, last);
    f->found = last <= f->least || (k > 0 && last <= converged * improvement(s, f));
  }
  if (!f->found) f->least += longest;
  const double far = fmax(f->found ? 0 : longest, improvement(s, f));
  if (!(far <= (f->found ? another : lost))) f->least = INFINITY, f->found = false;
  return HC_OK;
}

static periodic_motion motion_of(int n_harm, const double *x)
{
  double max, min;
  series_extrema(n_harm, x, &max, &min);
  return motion_of_series(n_harm, x, max, min);
}

/* The first response's motion; x[2 n_harm + 1] is work space. */
static periodic_motion measured(const hbm_solver *s, int n_harm, const double *X, double *x)
{
  hbm_system_response(&s->sys, n_harm, X, x);
  return motion_of(n_harm, x);
}

/* The factor 1/|1 - (H/n)^3| of predict.h. With sampled forces and n < H the whole distance may be aliasing, which more
 * harmonics do not reduce: 1. */
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
  const double factor = extrapolation(s, refinement_harmonics(s->exact_finer.by)), waveform = factor * d.waveform;
  const double least = s->exact_finer.least * ours->amplitude;
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
  const int n_harm = s->sys.n_harm, n = finer_harmonics(s->sys.scales.highest, n_harm, s->sys.dim, omega);
  finer_solution *f = &s->exact_finer;
  hc_status st = begin_finer(s, f, n, X);
  if (st == HC_OK) st = improve(s, f, omega, MOST_STEPS);
  if (st != HC_OK) return st;
  const periodic_motion ours = measured(s, n_harm, X, s->x), better = measured(s, n, f->improved, s->x);
  return error_between(s, &ours, &better, out);
}

/* ---- multipliers ---- */

static int n_states(const hbm_solver *s) { return 2 * s->model->n + s->model->n_contacts; }

static bool need_moduli(hbm_solver *s)
{
  if (!s->moduli) s->moduli = calloc(2 * (size_t)n_states(s), sizeof *s->moduli);
  return s->moduli != NULL;
}

/* moduli[n_states] of the solution next to X with twice the harmonics, and the factor from the difference of moduli to
 * the error. While the harmonics do not reach the contacts' own frequency errors do not fall with their number: the
 * finer solution may err as much again, factor 2. */
static hc_status finer_moduli(hbm_solver *s, double omega, const double *X, hbm_stability *finer, double *moduli,
                              double *factor)
{
  const contact_forces *orbit;
  finer_solution *f = &s->twice_finer;
  const int n = finer_harmonics(0, s->sys.n_harm, s->sys.dim, omega);
  hc_status st = begin_finer(s, f, n, X);
  if (st == HC_OK) st = improve(s, f, omega, FEW_STEPS);
  if (st == HC_OK && !f->found) st = HC_NOT_CONVERGED;
  if (st == HC_OK) st = refinement_orbit(f->by, f->improved, &orbit);
  if (st == HC_OK) st = hbm_moduli(s, orbit, omega, finer, moduli);
  *factor = extrapolation(s, n);
  if (s->sys.n_harm * omega < s->sys.scales.highest) *factor = fmax(*factor, 2);
  return st;
}

bool hbm_stability_error_is_costly(const hbm_solver *s)
{
  return hbm_system_length(&s->sys, finer_harmonics(0, s->sys.n_harm, s->sys.dim, 1)) > MOST_OF_ROWS;
}

hc_status hbm_finer_stability(hbm_solver *s, double omega, const double *X, hbm_stability *finer, double *factor)
{
  hc_status st = hbm_stability_at(s, omega, X, finer); /* allocates what hbm_moduli needs */
  if (st == HC_OK && !need_moduli(s)) st = HC_NO_MEMORY;
  return st == HC_OK ? finer_moduli(s, omega, X, finer, s->moduli, factor) : st;
}

/* Bounds of the largest modulus if each errs by between `from` and `to` times its difference from the reference's. All
 * moduli count: the largest now need not be the one that passes 1. */
static void take_range(const hbm_solver *s, double from, double to, hbm_stability *out)
{
  const double *ours = s->moduli, *theirs = ours + n_states(s);
  out->low = out->high = 0;
  for (int i = 0; i < n_states(s); ++i) {
    const double d = theirs[i] - ours[i], a = ours[i] + from * d, b = ours[i] + to * d;
    out->low = fmax(out->low, fmin(a, b));
    out->high = fmax(out->high, fmax(a, b));
  }
}

/* True if the share of X in the upper half of its harmonics is so small that the multiplier's error does not reach 1. X
 * errs by about a seventh of that share where errors fall like H^-3. Where a contact grazes, its transitions move by
 * the root of the error of the motion, and multipliers by these angles times contacts' own frequency/omega.
 * s->truncated becomes X without that half. */
static bool is_plain_by_share(hbm_solver *s, double omega, const double *X, double multiplier)
{
  const metric_at at = hbm_metric_at(s, X);
  memcpy(s->truncated, X, (size_t)s->sys.n_coef * sizeof *X);
  for (int i = hbm_system_length(&s->sys, s->sys.n_harm / 2); i < s->sys.n_coef; ++i) s->truncated[i] = 0;
  const double share = metric_distance(&at, X, s->truncated), own = fmax(s->sys.scales.highest / omega, 1);
  return fmax(multiplier, 1) * own * sqrt(share) <= fabs(multiplier - 1);
}

/* True if the error of the last row examined, on the same side of 1, shows that this row's does not reach 1 either.
 * Where contacts do the same, errors change by less than `margin` over MOST_ROWS rows. */
static bool is_plain_by_rows_before(const hbm_solver *s, const contact_report *now, double multiplier)
{
  enum { MOST_ROWS = 8 };
  const double margin = 4;
  const row_before *b = &s->row_before;
  const bool same =
      b->regime == now->regime && b->transitions == now->transitions && (b->multiplier > 1) == (multiplier > 1);
  return same && b->since < MOST_ROWS && margin * b->error <= fabs(multiplier - 1);
}

/* Takes the multipliers of s->truncated as the reference. True if the bounds of the largest modulus that follow exclude
 * 1. False unless its harmonics reach the contacts' own frequency: below, errors do not fall with their number, and two
 * motions may agree by chance. */
static bool is_plain_by_truncation(hbm_solver *s, double omega, hbm_stability *out)
{
  const contact_forces *orbit;
  contact_report report;
  hbm_stability there;
  const int half = s->sys.n_harm / 2;
  if (!(half * omega >= s->sys.scales.highest)) return false;
  if (hbm_located_orbit(s, s->truncated, &orbit, &report) != HC_OK) return false;
  if (hbm_moduli(s, orbit, omega, &there, s->moduli + n_states(s)) != HC_OK) return false;
  take_range(s, -1, 1, out);
  return out->high < 1 || out->low > 1;
}

hc_status hbm_stability_with_error(hbm_solver *s, double omega, const double *X, bool is_row, hbm_stability *out)
{
  const contact_forces *orbit;
  contact_report report;
  hbm_stability finer;
  double factor = NAN;
  hc_status st = hbm_stability_at(s, omega, X, out);
  if (st != HC_OK || out->predicted || (is_row && out->as_row_before) || !out->of_motion) return st;
  if (is_row && hbm_stability_error_is_costly(s)) return HC_OK;
  if (!need_moduli(s)) return HC_NO_MEMORY;
  s->row_before.since += 1;
  if (is_plain_by_share(s, omega, X, out->multiplier)) return HC_OK;
  if ((st = hbm_located_orbit(s, X, &orbit, &report)) != HC_OK) return st;
  if (is_row && is_plain_by_rows_before(s, &report, out->multiplier)) {
    out->as_row_before = true;
    hbm_keep_stability(s, omega, X, out); /* the same verdict when it is asked for again, for a drawing */
    return HC_OK;
  }
  st = hbm_moduli_of(s, omega, X, s->moduli);
  if (st == HC_OK && !is_plain_by_truncation(s, omega, out)) {
    st = finer_moduli(s, omega, X, &finer, s->moduli + n_states(s), &factor);
    if (st == HC_OK) take_range(s, 0, factor, out);
  }
  if (st == HC_NO_MEMORY) return st;
  if (st != HC_OK) out->low = 0, out->high = INFINITY;
  const double error = fmax(out->high - out->multiplier, out->multiplier - out->low);
  s->row_before = (row_before){report.regime, report.transitions, out->multiplier, error, 0};
  out->predicted = true;
  out->as_row_before = false;
  hbm_keep_stability(s, omega, X, out);
  return HC_OK;
}

hc_status hbm_predict_response(hbm_solver *s, double omega, const double *X, int r, motion_error *out)
{
  *out = (motion_error){NAN, NAN, NAN};
  hc_status st = hbm_response(s, omega, X, r, s->x);
  if (st != HC_OK) return st;
  const periodic_motion ours = motion_of(s->sys.n_harm, s->x);
  if ((st = refinement_response(s->exact_finer.by, omega, s->exact_finer.improved, r, s->x)) != HC_OK) return st;
  const periodic_motion better = motion_of(refinement_harmonics(s->exact_finer.by), s->x);
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
