/* structure_referee.c - a structure's HBM solution against time integration: the orbit of the exact law next to it, in
 * closed form, and its multiplier.
 *
 * The first check leaves the orbit and the finest HBM solution it needed (solved_structure.path, .fine) to those after
 * it. What differs by more than 1e-6 of the largest response must come nearer with twice the harmonics, or lie within
 * what doubling them changes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/motion.h"
#include "model/modes.h"
#include "numerics/series.h"
#include "stress/outcomes.h"
#include "stress/structure_path.h"

static const double close_enough = 1e-6, same_orbit = 1e-3;
enum { MOST_HARMONICS = 160, MOST_UNKNOWNS = 1500 };

/* ---- the orbit ---------------------------------------------------------------------------------------- */

/* s with other harmonics: for stress_motion_solve and what reads its motions. */
static solved_structure with_harmonics(const solved_structure *s, int n_harm)
{
  solved_structure other = *s;
  other.how.harmonics = n_harm;
  other.n_coef = series_length(n_harm);
  return other;
}

/* HBM of m with n_harm harmonics from guess[n_coef][n]. */
static void solve_model_with(solved_structure *s, const model *m, int n_harm, int n_coef, const double *guess,
                             stress_motion *out)
{
  solved_structure other = with_harmonics(s, n_harm);
  const size_t most = (size_t)other.n_coef * (size_t)s->n, given = (size_t)n_coef * (size_t)s->n;
  double *padded = calloc(most, sizeof *padded);
  if (!padded) s->fatal = HC_NO_MEMORY;
  else memcpy(padded, guess, (given < most ? given : most) * sizeof *padded);
  stress_motion_solve(&other, m, &other.how, s->omega, padded, 1, out);
  if (other.fatal != HC_OK) s->fatal = other.fatal;
  free(padded);
}

static void solve_with(solved_structure *s, int n_harm, int n_coef, const double *guess, stress_motion *out)
{
  solve_model_with(s, s->model, n_harm, n_coef, guess, out);
}

/* The orbit next to that solution, into *path, and how far apart they are; NaN without one. */
static double shoot_from(solved_structure *s, const stress_motion *from, int n_harm, stress_path *path)
{
  const transient_settings how = stress_path_settings();
  stress_path_make(s, s->model, from->start, path);
  if (from->status != HC_OK || from->start_status != HC_OK) return NAN;
  stress_path_follow(s, s->model, &how, s->omega, PATH_ORBIT, 1, path);
  return path->status == HC_OK ? stress_path_off(s, series_length(n_harm), from->x, path) : NAN;
}

/* A bound of the change by doubling the harmonics, of any degree of freedom, over the orbit's amplitude. */
static double moved(const solved_structure *s, const stress_motion *coarse, int n_coef, const stress_motion *fine,
                    int n_fine, double amplitude)
{
  double most = 0;
  for (int i = 0; i < s->n; ++i) {
    double sum = 0;
    for (int c = 0; c < n_fine; ++c) sum += fabs(fine->x[c * s->n + i] - (c < n_coef ? coarse->x[c * s->n + i] : 0));
    most = fmax(most, sum);
  }
  return most / amplitude;
}

/* HBM of m from the orbit's own harmonics. */
void stress_motion_beside(solved_structure *s, const model *m, const stress_path *path, int shift, int n_harm,
                          stress_motion *out)
{
  const int n_coef = series_length(n_harm);
  double *guess = calloc((size_t)n_coef * (size_t)s->n, sizeof *guess), *one = calloc((size_t)n_coef, sizeof *one);
  *out = (stress_motion){.status = HC_NO_MEMORY};
  if (!guess || !one) s->fatal = HC_NO_MEMORY;
  for (int i = 0; guess && one && i < s->n; ++i) {
    periodic_motion motion = {.amplitude = 1};
    for (int k = 0; k < TIMEINT_WAVE; ++k)
      motion.samples[k] = path->wave[i * TIMEINT_WAVE + (k + shift) % TIMEINT_WAVE];
    motion_harmonics(&motion, n_harm, one);
    for (int c = 0; c < n_coef; ++c) guess[c * s->n + i] = one[c];
  }
  if (s->fatal == HC_OK) solve_model_with(s, m, n_harm, n_coef, guess, out);
  free(guess);
  free(one);
}

/* Does HBM, from the orbit's own harmonics, end on that orbit? How far off. */
static double confirmed(solved_structure *s, const stress_path *path, int n_harm)
{
  stress_motion h;
  stress_motion_beside(s, s->model, path, 0, n_harm, &h);
  const double off = h.status == HC_OK ? stress_path_off(s, series_length(n_harm), h.x, path) : NAN;
  stress_motion_free(&h);
  return off;
}

/* Is the highest frequency of the stuck structure above a tenth of the n-th harmonic's? After each transition it rings
 * at that frequency. */
static bool beyond_harmonics(solved_structure *s, int n_harm)
{
  model_scales scales;
  hc_status st = model_find_scales(s->model, &scales);
  if (st == HC_NO_MEMORY) s->fatal = st;
  return st == HC_OK && scales.highest > 0.1 * n_harm * s->omega;
}

/* What the orbit's own errors alone may set apart. */
static double sensitive(const stress_path *p) { return 3 * p->errors; }
static double tolerance_of(const stress_path *p) { return fmax(close_enough, sensitive(p)); }

static bool may_double(const solved_structure *s, int n_harm)
{
  const int coordinates = 2 * s->model->n_contacts < s->n ? 2 * s->model->n_contacts : s->n;
  return 2 * n_harm <= MOST_HARMONICS && coordinates * series_length(2 * n_harm) <= MOST_UNKNOWNS;
}

/* s->fine and s->path become those of twice the harmonics, if there are. *step: the change. */
static bool refine(solved_structure *s, double *error, double *step)
{
  stress_motion finer;
  stress_path path;
  const int n_harm = 2 * s->fine_harmonics;
  solve_with(s, n_harm, series_length(s->fine_harmonics), s->fine.x, &finer);
  const bool solved = finer.status == HC_OK;
  if (!solved) {
    stress_motion_free(&finer);
    return false;
  }
  *error = shoot_from(s, &finer, n_harm, &path);
  *step = moved(s, &s->fine, series_length(s->fine_harmonics), &finer, series_length(n_harm),
                path.status == HC_OK ? path.amplitude : finer.m.amplitude);
  stress_motion_free(&s->fine);
  stress_path_free(s->path);
  s->fine = finer;
  *s->path = path;
  s->fine_harmonics = n_harm;
  return true;
}

/* Beyond the bound with as many harmonics as may be. */
static stress_check explain(solved_structure *s, double before, double error, double step)
{
  if (s->path->status != HC_OK) return stress_motion_refuse(s, s->path->status);
  if (error <= before / 2 || error <= 3 * step) return stress_explain(STRESS_TRUNCATED, error, 3 * step);
  if (beyond_harmonics(s, s->fine_harmonics)) return stress_explain(STRESS_UNRESOLVED, error, NAN);
  const double other = confirmed(s, s->path, s->fine_harmonics);
  if (other <= fmin(error / 10, same_orbit)) return stress_explain(STRESS_OTHER_ORBIT, error, other);
  solved_structure_condition(s);
  if (error <= s->solution_errs) return stress_explain(STRESS_ILL_CONDITIONED, error, s->solution_errs);
  return stress_find(STRESS_DISAGREES, error, tolerance_of(s->path));
}

/* Without harmonic 0, means and static loads are left out. */
static bool other_equation(const solved_structure *s)
{
  if (s->how.keep_mean) return false;
  for (int l = 0; l < s->model->n_loads; ++l)
    if (s->model->loads[l].harmonic == 0) return true;
  return s->base.m.contact.regime != CONTACT_LINEAR;
}

/* Harmonics are doubled until HBM and the orbit next to it meet. */
stress_check stress_structure_orbit(solved_structure *s)
{
  solve_with(s, s->how.harmonics, s->n_coef, s->base.x, &s->fine);
  s->fine_harmonics = s->how.harmonics;
  if (s->fine.status != HC_OK) return stress_motion_refuse(s, s->fine.status);
  double error = shoot_from(s, &s->fine, s->fine_harmonics, s->path), before = NAN, step = NAN;
  if (other_equation(s)) return stress_skip(STRESS_NOT_APPLICABLE);
  const double coarse = error;
  if (s->path->status == HC_OK && error <= tolerance_of(s->path))
    return stress_agree_within(error, close_enough, sensitive(s->path));
  while (s->fatal == HC_OK && may_double(s, s->fine_harmonics)) {
    before = error;
    if (!refine(s, &error, &step)) break;
    if (s->path->status == HC_INTERRUPTED) return stress_motion_refuse(s, s->path->status);
    if (s->path->status == HC_OK && error <= tolerance_of(s->path))
      return stress_explain(STRESS_TRUNCATED, coarse, NAN);
  }
  return explain(s, before, error, step);
}

/* ---- its multiplier ----------------------------------------------------------------------------------- */

static double multipliers_apart(const stress_motion *h, const stress_path *p)
{
  if (h->stability_status != HC_OK) return NAN;
  return fabs(h->stability.multiplier - p->r.multiplier) / fmax(1, p->r.multiplier);
}

/* As of oscillators (limits.c): a multiplier jumps where a transition appears or disappears. */
stress_check stress_structure_floquet(solved_structure *s)
{
  const double bound = 1e-3;
  if (s->path->status != HC_OK || isnan(s->path->r.multiplier) || s->fine.stability_status != HC_OK)
    return stress_skip(STRESS_NO_ORBIT);
  const double far = stress_path_off(s, series_length(s->fine_harmonics), s->fine.x, s->path);
  if (!(far <= same_orbit)) return stress_skip(STRESS_NO_ORBIT);
  const double error = multipliers_apart(&s->fine, s->path);
  if (error <= bound) return stress_agree(error, bound);
  stress_motion finer;
  const int n_harm = 2 * s->fine_harmonics < HBM_MAX_HARMONICS ? 2 * s->fine_harmonics : HBM_MAX_HARMONICS;
  solve_with(s, n_harm, series_length(s->fine_harmonics), s->fine.x, &finer);
  const double better = finer.status == HC_OK ? multipliers_apart(&finer, s->path) : NAN;
  stress_motion_free(&finer);
  if (better <= fmax(bound, 0.8 * error)) return stress_explain(STRESS_TRUNCATED, error, better);
  if (s->fine.m.contact.transitions != s->path->r.switches) return stress_explain(STRESS_OTHER_EVENTS, error, better);
  if (far > close_enough && beyond_harmonics(s, n_harm)) return stress_explain(STRESS_UNRESOLVED, error, better);
  solved_structure_condition(s);
  if (error <= s->multiplier_errs) return stress_explain(STRESS_ILL_CONDITIONED, error, s->multiplier_errs);
  return stress_find(STRESS_DISAGREES, error, bound);
}
