/* bench_start.c - see bench_start.h. */
#include "compare/accuracy/bench_start.h"

#include <string.h>

#include "compare/comparison.h"

hc_status bench_start_new(const model *m, const hbm_solver *s, bench_start *at)
{
  const int width = hbm_n_coefficients(s) / (2 * hbm_n_harmonics(s) + 1);
  *at = (bench_start){.most_coef = width * (2 * HBM_MAX_HARMONICS + 1),
                      .n_states = 2 * m->n + m->n_contacts,
                      .n_responses = m->n_responses};
  at->X = workspace_doubles(&at->memory, (size_t)at->most_coef);
  at->state = workspace_doubles(&at->memory, (size_t)at->n_states);
  at->reference = workspace_array(&at->memory, (size_t)at->n_responses, sizeof *at->reference);
  return at->memory.failed ? HC_NO_MEMORY : HC_OK;
}

void bench_start_free(bench_start *at)
{
  workspace_free(&at->memory);
  *at = (bench_start){0};
}

enum { CURVE_HARMONICS = 20, TRIES = 8, COARSEST_DECADE = -6 };
static const double best_floor = 1e-12; /* [1] error of the amplitude by rounding of a period's integration */
static const double marching = 1e-12;   /* transient.tolerance of marching, if shooting's reference is coarser than
                                           5e-10 */
static const double first_distance = 1e-3, nearby = 0.3; /* [omega] first distance of the neighbour; [amplitude] largest
                                                            distance of neighbouring motions */

hc_status finder_start(const compare_setup *setup, const number_list *at, const hc_monitor *monitor, finder *f)
{
  *f = (finder){.setup = method_setup(setup, BENCH_HBM_EXACT, CURVE_HARMONICS, 0, NAN, NAN)};
  if (at->n) f->setup.compare.omega = *at;
  comparison_sweep(setup->omega_from, setup->omega_to, &f->setup.compare.omega, &f->setup.omega_from,
                   &f->setup.omega_to);
  hc_status st = response_trace(&f->setup, &f->setup.compare.omega, monitor, &f->response);
  if (st == HC_OK && f->response.curve.n == 0) st = f->response.status;
  if (st != HC_OK) return st;
  const model *m = f->setup.model;
  const size_t n_states = (size_t)(f->n_states = 2 * m->n + m->n_contacts);
  f->X = workspace_doubles(&f->memory, (size_t)hbm_n_coefficients(f->response.hbm));
  f->state = workspace_doubles(&f->memory, n_states);
  f->other = workspace_doubles(&f->memory, n_states);
  f->trial = workspace_doubles(&f->memory, n_states);
  f->motion = workspace_array(&f->memory, (size_t)m->n_responses, sizeof *f->motion);
  return f->memory.failed ? HC_NO_MEMORY : HC_OK;
}

void finder_free(finder *f)
{
  response_curve_free(&f->response);
  workspace_free(&f->memory);
  *f = (finder){0};
}

hc_status finder_default(finder *f, double *omega)
{
  number_list all;
  double most = -1;
  hc_status st =
      comparison_frequencies(&f->setup.compare, f->setup.omega_from, f->response.hbm, &f->response.curve, &all);
  for (int i = 0; i < all.n && st == HC_OK; ++i) {
    hbm_curve at = {0};
    hbm_measures m;
    st = hbm_curve_at(f->response.hbm, &f->response.curve, all.v[i], &at) == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
    for (int k = 0; k < at.n; ++k)
      if (hbm_measure(f->response.hbm, at.X + (size_t)k * at.n_coef, &m) == HC_OK && m.amplitude > most)
        most = m.amplitude, *omega = all.v[i];
    hbm_curve_free(&at);
  }
  return st == HC_OK && most < 0 ? HC_NOT_CONVERGED : st;
}

/* The exact law's orbit next to state, which becomes one on it; f->motion: its responses. */
static hc_status exact_orbit(finder *f, double omega, transient_steady steady, double tolerance,
                             const hc_monitor *monitor, double *state, timeint_result *r)
{
  transient_settings how = f->setup.transient;
  timeint *ti = NULL;
  const size_t bytes = (size_t)f->n_states * sizeof *state;
  how.law = TRANSIENT_LAW_EXACT;
  how.tolerance = tolerance;
  how.steady = steady;
  hc_status st = timeint_new(f->setup.model, &how, &ti);
  memcpy(f->trial, state, bytes);
  if (st == HC_OK) st = timeint_steady(ti, omega, f->trial, monitor, r);
  for (int i = f->setup.model->n_responses; i-- > 0 && st == HC_OK;) { /* *r is finally that of the first response */
    if (f->setup.model->n_responses > 1) st = timeint_response(ti, i, r);
    f->motion[i] = motion_of_transient(r);
  }
  timeint_free(ti);
  if (st == HC_OK) memcpy(state, f->trial, bytes);
  return st;
}

/* By shooting, with the smallest power of ten as tolerance at which it converges. */
static hc_status tightest_orbit(finder *f, double omega, const hc_monitor *monitor, double *state, timeint_result *r,
                                double *floor)
{
  hc_status st = HC_NOT_CONVERGED;
  int decade = -14;
  while (st != HC_OK && st != HC_INTERRUPTED && st != HC_NO_MEMORY && decade < COARSEST_DECADE)
    st = exact_orbit(f, omega, TRANSIENT_STEADY_SHOOTING, pow(10, ++decade), monitor, state, r);
  *floor = fmax(best_floor, pow(10, decade));
  return st;
}

/* Takes f->motion as the reference. */
static void take_reference(const finder *f, bench_start *start)
{
  start->size = 0;
  for (int i = 0; i < start->n_responses; ++i) {
    start->reference[i] = f->motion[i];
    start->size = fmax(start->size, f->motion[i].amplitude);
  }
}

/* If shooting converged at a coarse tolerance only: the orbit by marching from there. */
static hc_status march_for(finder *f, double omega, const hc_monitor *monitor, bench_start *start, timeint_result *r,
                           double *floor)
{
  timeint_result marched;
  if (*floor < 5e-10) return HC_OK;
  hc_status st = exact_orbit(f, omega, TRANSIENT_STEADY_MARCH, marching, monitor, f->state, &marched);
  if (st != HC_OK)
    return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK; /* the reference keeps the floor of shooting */
  take_reference(f, start);
  marched.multiplier = r->multiplier;
  *r = marched;
  *floor = 10 * marching;
  return HC_OK;
}

/* The largest solution at omega whose orbit is stable, into f->X and f->state. */
static hc_status largest_stable(finder *f, double omega, const hc_monitor *monitor, bench_start *start,
                                timeint_result *best, double *floor)
{
  hbm_curve at = {0};
  hbm_measures m;
  hc_status st = hbm_curve_at(f->response.hbm, &f->response.curve, omega, &at);
  *best = (timeint_result){.amplitude = -1};
  if (st != HC_NO_MEMORY) st = HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    const double *Xk = at.X + (size_t)k * at.n_coef;
    timeint_result r;
    double floor_k = 0;
    if (hbm_measure(f->response.hbm, Xk, &m) != HC_OK || m.amplitude < 0.9 * best->amplitude) continue;
    hc_status found = comparison_orbit_start(f->response.hbm, Xk, omega, f->other);
    if (found == HC_OK) found = tightest_orbit(f, omega, monitor, f->other, &r, &floor_k);
    if (found == HC_INTERRUPTED || found == HC_NO_MEMORY) st = found;
    if (found != HC_OK || timeint_stability(&r) <= 0 || r.amplitude <= best->amplitude) continue;
    *best = r;
    *floor = floor_k;
    take_reference(f, start);
    memcpy(f->state, f->other, (size_t)f->n_states * sizeof *f->state);
    memcpy(f->X, Xk, (size_t)at.n_coef * sizeof *f->X);
  }
  hbm_curve_free(&at);
  return st == HC_OK && best->amplitude < 0 ? HC_NOT_CONVERGED : st;
}

/* True if every response of a is within `nearby` of b's. */
static bool are_near(int n, const periodic_motion *a, const periodic_motion *b, double size)
{
  for (int i = 0; i < n; ++i)
    if (!(motion_between(&a[i], &b[i]).waveform <= nearby * size)) return false;
  return true;
}

/* Solves the same branch at omega, by HBM and by the exact law; false if they fail or are too far apart. */
static bool try_neighbour(finder *f, double omega, const hc_monitor *monitor, bench_start *start)
{
  hbm_point point;
  timeint_result r;
  periodic_motion by_hbm;
  start->neighbour = omega;
  memset(start->X, 0, (size_t)start->most_coef * sizeof *start->X);
  memcpy(start->X, f->X, (size_t)hbm_n_coefficients(f->response.hbm) * sizeof *f->X);
  memcpy(start->state, f->state, (size_t)f->n_states * sizeof *f->state);
  if (hbm_solve(f->response.hbm, omega, start->X, &point) != HC_OK) return false;
  if (exact_orbit(f, omega, TRANSIENT_STEADY_SHOOTING, 1e-9, monitor, start->state, &r) != HC_OK) return false;
  for (int i = 0; i < start->n_responses; ++i)
    if (motion_of_response(f->response.hbm, omega, start->X, i, NULL, &by_hbm) != HC_OK ||
        !are_near(1, &by_hbm, &f->motion[i], start->size))
      return false;
  return are_near(start->n_responses, f->motion, start->reference, start->size);
}

hc_status finder_frequency(finder *f, double omega, const hc_monitor *monitor, bench_frequency *at, bench_start *start)
{
  double distance = first_distance;
  timeint_result r;
  *at = (bench_frequency){.omega = omega};
  start->omega = omega;
  hc_status st = largest_stable(f, omega, monitor, start, &r, &at->floor);
  if (st == HC_OK) st = march_for(f, omega, monitor, start, &r, &at->floor);
  if (st != HC_OK) return st;
  at->amplitude = r.amplitude;
  at->multiplier = r.multiplier;
  /* towards the middle of the sweep first */
  if (omega > 0.5 * (f->setup.omega_from + f->setup.omega_to)) distance = -distance;
  for (int i = 0; i < TRIES; ++i) {
    if (!hc_monitor_tick(monitor, -1)) return HC_INTERRUPTED;
    if (try_neighbour(f, omega * (1 + distance), monitor, start)) {
      at->neighbour = start->neighbour;
      return HC_OK;
    }
    distance *= i % 2 ? -0.25 : -1;
  }
  return HC_NOT_CONVERGED;
}
