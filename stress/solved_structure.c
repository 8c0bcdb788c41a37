/* solved_structure.c - see solved_structure.h. */
#include "stress/solved_structure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/thread_clock.h"
#include "compare/comparison.h"
#include "hbm/first_solution.h"
#include "numerics/random.h"
#include "numerics/series.h"
#include "stress/outcomes.h"
#include "stress/structure_path.h"

/* Rounding is seen only if Newton does not stop before. */
static const double tight = 1e-12;

static bool go_on(void *self, double done)
{
  solved_structure *s = self;
  if (!hc_monitor_tick(s->outer, done)) s->fatal = HC_INTERRUPTED;
  return s->fatal == HC_OK && thread_seconds() < s->deadline;
}

void solved_structure_clock(solved_structure *s) { s->deadline = thread_seconds() + s->seconds; }

static hc_status make_model(solved_structure *s, const scene *sc)
{
  model *m;
  hc_status st = scene_model(sc, &m);
  if (st == HC_OK) st = rewritten_with_all_responses(m, &s->model);
  model_free(m);
  return st;
}

hc_status solved_structure_start(solved_structure *s, const scene *sc, double seconds, const hc_monitor *outer)
{
  *s = (solved_structure){.how = sc->hbm, .omega = sc->compare.omega.v[0], .seconds = seconds, .outer = outer};
  s->how.force = HBM_FORCE_EXACT;
  s->how.tolerance = fmin(s->how.tolerance, tight);
  s->from = sc->omega_from, s->to = sc->omega_to;
  s->monitor = (hc_monitor){go_on, s};
  memcpy(&s->random, &s->omega, sizeof s->random); /* the same for the same scene, whatever its number */
  hc_status st = make_model(s, sc);
  if (st != HC_OK) return st;
  s->n = s->model->n;
  s->n_coef = series_length(s->how.harmonics);
  s->asked = sc;
  s->fine.status = HC_NOT_CONVERGED; /* none yet */
  s->predicted = stress_skip(STRESS_NO_ORBIT);
  if (!(s->path = calloc(1, sizeof *s->path))) return HC_NO_MEMORY;
  s->path->status = HC_NOT_CONVERGED;
  solved_structure_clock(s);
  stress_motion_solve(s, s->model, &s->how, s->omega, NULL, 1, &s->base);
  return s->fatal;
}

void solved_structure_clear(solved_structure *s)
{
  model_free(s->model);
  stress_motion_free(&s->base);
  stress_motion_free(&s->fine);
  if (s->path) stress_path_free(s->path);
  free(s->path);
}

/* ---- one solution --------------------------------------------------------------------------------- */

void stress_motion_free(stress_motion *m)
{
  free(m->x);
  free(m->start);
  m->x = m->start = NULL;
}

hc_status stress_motion_read(const solved_structure *s, hbm_solver *h, double omega, const double *X, double *x)
{
  hc_status st = HC_OK;
  double *series = malloc((size_t)s->n_coef * sizeof *series);
  if (!series) return HC_NO_MEMORY;
  for (int i = 0; i < s->n && st == HC_OK; ++i) {
    st = hbm_response(h, omega, X, 1 + i, series);
    for (int c = 0; c < s->n_coef; ++c) x[c * s->n + i] = series[c];
  }
  free(series);
  return st;
}

static hc_status solve(solved_structure *s, hbm_solver *h, double omega, const double *guess, double *X,
                       stress_motion *out)
{
  hbm_point point;
  if (guess) hbm_guess_of(h, guess, X);
  hc_status st = guess ? hbm_solve(h, omega, X, &point) : hbm_first_solution(h, omega, &s->monitor, X, &point);
  if (st == HC_OK) st = hbm_measure(h, X, &out->m);
  if (st == HC_OK) st = stress_motion_read(s, h, omega, X, out->x);
  if (st == HC_OK) out->stability_status = hbm_stability_at(h, omega, X, &out->stability);
  if (st == HC_OK) out->start_status = comparison_orbit_start(h, X, omega, out->start);
  return st;
}

void stress_motion_solve(solved_structure *s, const model *m, const hbm_settings *how, double omega,
                         const double *guess, double length, stress_motion *out)
{
  hbm_solver *h = NULL;
  *out = (stress_motion){.x = calloc((size_t)s->n * (size_t)s->n_coef, sizeof(double)),
                         .start = calloc(2 * (size_t)m->n + (size_t)m->n_contacts, sizeof(double))};
  out->status = out->x && out->start ? hbm_solver_new(m, how, &h) : HC_NO_MEMORY;
  if (out->status == HC_OK) {
    double *X = calloc((size_t)hbm_n_coefficients(h), sizeof *X);
    out->status = X ? solve(s, h, omega, guess, X, out) : HC_NO_MEMORY;
    free(X);
  }
  hbm_solver_free(h);
  for (int i = 0; out->x && i < s->n * s->n_coef; ++i) out->x[i] /= length;
  if (out->status == HC_NO_MEMORY) s->fatal = HC_NO_MEMORY;
}

double stress_motion_distance(const solved_structure *s, const double *x, const double *y, bool means_out)
{
  double apart = 0, size = 0;
  for (int i = means_out ? s->n : 0; i < s->n * s->n_coef; ++i) {
    if (isnan(x[i]) || isnan(y[i])) return NAN;
    apart = fmax(apart, fabs(x[i] - y[i]));
    size = fmax(size, fabs(y[i]));
  }
  return apart == 0 ? 0 : apart / size;
}

double stress_multipliers_apart(const stress_motion *a, const stress_motion *b)
{
  const double x = a->stability.multiplier, y = b->stability.multiplier;
  if (a->stability_status != HC_OK || b->stability_status != HC_OK) return INFINITY;
  return fabs(x - y) / fmax(1, fabs(x));
}

/* m from the base solution, `beside` off. HC_NO_MEMORY goes to s->fatal. */
static void solve_again(solved_structure *s, const model *m, double beside, stress_motion *out)
{
  const int length = s->n * s->n_coef;
  double *guess = malloc((size_t)length * sizeof *guess);
  if (!guess) s->fatal = HC_NO_MEMORY;
  for (int i = 0; guess && i < length; ++i) guess[i] = s->base.x[i] * (1 + beside * random_signed(&s->random));
  stress_motion_solve(s, m, &s->how, s->omega, guess, 1, out);
  free(guess);
}

/* Data changed by `nudge`: how far the solution goes, and *rate, the multiplier for each unit of that. */
static double nudged(solved_structure *s, double nudge, double *rate)
{
  model *m;
  stress_motion moved;
  if ((s->fatal = rewritten_nudged(s->model, nudge, &s->random, &m)) != HC_OK) return INFINITY;
  solve_again(s, m, 0, &moved);
  const double far = moved.status == HC_OK ? stress_motion_distance(s, moved.x, s->base.x, false) : INFINITY;
  if (moved.status == HC_OK && far > 0) *rate = fmax(*rate, stress_multipliers_apart(&moved, &s->base) / far);
  stress_motion_free(&moved);
  model_free(m);
  return far;
}

/* The same equations from another guess; what is found must be a solution. */
static double found_elsewhere(solved_structure *s, double beside)
{
  stress_motion again;
  solve_again(s, s->model, beside, &again);
  double far = INFINITY;
  if (again.status == HC_OK) {
    far = stress_motion_distance(s, again.x, s->base.x, false);
    if (!(stress_imbalance(s, again.x) <= stress_balanced(s))) far = 0;
  }
  stress_motion_free(&again);
  return far;
}

/* Rounding of the data in other coordinates is n^2 units of their largest, 4e-14 for n = 13, times ten as the data here
 * are changed twice only. Newton's scatter is known by three: a hundred times as much is reckoned with. */
void solved_structure_condition(solved_structure *s)
{
  const double nudge = 1e-9, rounding = 4e-13, scatter = 100;
  double rate = 0;
  if (s->conditioned) return;
  for (int i = 0; i < 2 && s->fatal == HC_OK; ++i)
    s->solution_errs = fmax(s->solution_errs, rounding / nudge * nudged(s, nudge, &rate));
  for (int i = 0; i < 3 && s->fatal == HC_OK; ++i)
    s->solution_errs = fmax(s->solution_errs, scatter * found_elsewhere(s, pow(10, -3 - 2 * i)));
  s->multiplier_errs = rate * s->solution_errs;
  s->conditioned = true;
}

stress_check stress_motion_refuse(solved_structure *s, hc_status st)
{
  if (st == HC_NO_MEMORY) s->fatal = st;
  return stress_refusal(st);
}

/* ---- all checks ---- */

static bool is_finite(const solved_structure *s)
{
  for (int i = 0; i < s->n * s->n_coef; ++i)
    if (!isfinite(s->base.x[i])) return false;
  return true;
}

static stress_check check(solved_structure *s, stress_check (*of)(solved_structure *))
{
  if (s->base.status != HC_OK) return stress_motion_refuse(s, s->base.status);
  return is_finite(s) ? of(s) : stress_find(STRESS_INTERNAL, NAN, NAN);
}

hc_status stress_structure(const scene *sc, double seconds, const hc_monitor *monitor, stress_result *out)
{
  static stress_check (*const checks[])(solved_structure *) = {
      stress_structure_force,         stress_structure_balance,  stress_structure_work,
      stress_structure_determinant,   stress_structure_permuted, stress_structure_rotated,
      stress_structure_units,         stress_structure_split,    stress_structure_copies,
      stress_structure_bystander,     stress_structure_delayed,  stress_structure_sampled,
      stress_structure_curve,         stress_structure_orbit,    stress_structure_floquet,
      stress_structure_rewritten,     stress_structure_returns,  stress_structure_cvode,
      stress_structure_regularised,   stress_structure_verdict,  stress_structure_predicted,
      stress_structure_other_tangents};
  _Static_assert(sizeof checks / sizeof *checks == STRESS_N_CHECKS - STRESS_N_OSCILLATOR_CHECKS, "one for each name");
  solved_structure s;
  const double start = thread_seconds();
  hc_status st = solved_structure_start(&s, sc, seconds, monitor);
  for (int k = STRESS_N_OSCILLATOR_CHECKS; k < STRESS_N_CHECKS && st == HC_OK; ++k) {
    solved_structure_clock(&s);
    const double began = thread_seconds();
    out->check[k] = check(&s, checks[k - STRESS_N_OSCILLATOR_CHECKS]);
    out->check[k].seconds = thread_seconds() - began;
    st = s.fatal;
  }
  solved_structure_clear(&s);
  out->seconds = thread_seconds() - start;
  out->there = st == HC_OK;
  return st;
}
