/* reference.c - see reference.h. The tables' peak is that of the exact law's orbits, by shooting: three frequencies
 * that enclose it, from the peak of the curve by harmonic balance, then a minimum search between them. By harmonic
 * balance alone it would take 160 harmonics to know it to 1e-8. */
#include "compare/accuracy/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/growing.h"
#include "compare/response.h"
#include "model/modes.h"
#include "numerics/roots.h"

enum { PEAK_LEVELS = 6 };

static const double reusable = 0.01; /* [amplitude] an orbit within this of a solution of the fine curve is taken as
                                        the one next to it */

static hc_status add_target(reference *r, double omega, const periodic_motion *orbit)
{
  target *grown = growing(r->targets, r->n, sizeof *grown);
  if (!grown) return HC_NO_MEMORY;
  r->targets = grown;
  r->targets[r->n++] = (target){omega, *orbit};
  return HC_OK;
}

static bool is_known(const reference *r, double omega, const periodic_motion *orbit)
{
  for (int i = 0; i < r->n; ++i)
    if (r->targets[i].omega == omega && motion_between(&r->targets[i].orbit, orbit).waveform <= 1e-6 * orbit->amplitude)
      return true;
  return false;
}

/* The orbit next to a solution: of the comparison's rows, else by shooting. False: none. */
static bool orbit_next_to(const comparison *c, timeint *ti, double *state, hbm_solver *hbm, const double *X,
                          double omega, const hc_monitor *monitor, periodic_motion *out)
{
  hbm_measures m;
  periodic_motion here;
  if (motion_of_response(hbm, omega, X, 0, &m, &here) != HC_OK) return false;
  for (int i = 0; i < c->n_rows; ++i) {
    if (c->rows[i].response != 0 || c->rows[i].omega != omega || c->rows[i].orbit_status != HC_OK) continue;
    *out = motion_of_transient(&c->rows[i].orbit);
    if (motion_between(&here, out).waveform <= reusable * out->amplitude) return true;
  }
  timeint_result r;
  if (comparison_orbit_start(hbm, X, omega, state) != HC_OK || timeint_orbit(ti, omega, 1, state, monitor, &r) != HC_OK)
    return false;
  *out = motion_of_transient(&r);
  return true;
}

static hc_status targets_at(const comparison *c, timeint *ti, double *state, hbm_solver *hbm, const hbm_curve *curve,
                            double omega, const hc_monitor *monitor, reference *r)
{
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(hbm, curve, omega, &at) == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    const double *X = at.X + (size_t)k * at.n_coef;
    periodic_motion orbit;
    if (!orbit_next_to(c, ti, state, hbm, X, omega, monitor, &orbit)) continue;
    if (!is_known(r, omega, &orbit)) st = add_target(r, omega, &orbit);
  }
  hbm_curve_free(&at);
  return st;
}

typedef struct climber {
  timeint *ti;
  const double *state; /* [n_states] next to an orbit */
  double *here;        /* [n_states] on it */
} climber;

/* *value = -amplitude of the orbit at omega next to the climber's state; NaN where there is none. */
static hc_status minus_amplitude(void *self, double omega, double *value)
{
  const climber *c = self;
  timeint_result r;
  memcpy(c->here, c->state, (size_t)timeint_n_states(c->ti) * sizeof *c->here);
  hc_status st = timeint_orbit(c->ti, omega, 1, c->here, NULL, &r);
  *value = st == HC_OK ? -r.amplitude : NAN;
  return st;
}

/* Three frequencies d apart, the one in the middle no lower than the others: from *omega uphill, closer together where
 * an orbit is missing or is no part of a hill. False: not within PEAK_LEVELS, or not within the sweep, at whose ends a
 * peak is where the sweep ends. *omega and f[1] are then the last middle, f[1] NaN if it has no orbit. f: minus the
 * amplitudes. */
static bool enclose_peak(climber *c, double low, double high, double *omega, double *d, double f[3])
{
  for (int level = 0; level < PEAK_LEVELS; ++level) {
    if (*omega - *d < low || *omega + *d > high) return false;
    bool both = minus_amplitude(c, *omega - *d, &f[0]) == HC_OK && minus_amplitude(c, *omega + *d, &f[2]) == HC_OK;
    if (both && f[1] <= f[0] && f[1] <= f[2]) return true;
    double bend = both ? f[0] - 2 * f[1] + f[2] : NAN;
    if (!(bend > 0)) {
      *d /= 4;
      continue;
    }
    *omega += fmax(fmin(0.5 * *d * (f[0] - f[2]) / bend, 2 * *d), -2 * *d);
    if (minus_amplitude(c, *omega, &f[1]) != HC_OK) return false;
  }
  return false;
}

/* From omega on, where c->state is next to an orbit. False: *out is untouched. */
static bool climb(const compare_setup *setup, climber *c, double omega, reference *out)
{
  const double low = fmin(setup->omega_from, setup->omega_to), high = fmax(setup->omega_from, setup->omega_to);
  model_scales scales;
  const bool damped = model_find_scales(setup->model, &scales) == HC_OK && scales.half_width > 0;
  const double width = fmin(damped ? scales.half_width : omega, 0.1 * omega);
  double d = 0.02 * width, f[3] = {NAN, NAN, NAN};
  if (minus_amplitude(c, omega, &f[1]) != HC_OK) return false;
  root_point peak;
  if (enclose_peak(c, low, high, &omega, &d, f)) /* flat: 2e-5 of the width are 2e-10 of the amplitude */
    root_minimum(minus_amplitude, c, omega - d, f[0], omega, f[1], omega + d, f[2], 2e-5 * width, &peak);
  else peak = (root_point){.x = omega, .f = f[1]};
  if (isnan(peak.f)) return false;
  out->peak_amplitude = -peak.f; /* the highest found, also where an orbit in between is missing */
  out->peak_omega = peak.x;
  return out->peak_by_orbit = true;
}

static void find_peak(const compare_setup *setup, timeint *ti, double *states, hbm_solver *hbm, const hbm_curve *curve,
                      reference *out)
{
  hbm_curve peak = {0};
  hbm_measures m;
  out->peak_amplitude = out->peak_omega = NAN;
  if (curve->n > 0 && hbm_curve_peak(hbm, curve, &peak) == HC_OK && peak.n > 0 &&
      hbm_measure(hbm, peak.X, &m) == HC_OK) {
    double omega = peak.points[0].omega;
    climber c = {ti, states, states + timeint_n_states(ti)};
    if (comparison_orbit_start(hbm, peak.X, omega, states) != HC_OK || !climb(setup, &c, omega, out))
      out->peak_amplitude = m.amplitude, out->peak_omega = omega;
  }
  hbm_curve_free(&peak);
}

hc_status reference_make(const compare_setup *setup, const comparison *c, hbm_solver *hbm, const hbm_curve *curve,
                         const hc_monitor *monitor, reference *out)
{
  timeint *ti = NULL;
  double *states = NULL; /* [2][n_states] */
  *out = (reference){.harmonics = hbm_n_harmonics(hbm)};
  hc_status st = comparison_referee(setup, &ti);
  if (st == HC_OK && !(states = calloc(2 * (size_t)timeint_n_states(ti), sizeof *states))) st = HC_NO_MEMORY;
  for (int i = 0; i < c->n_rows && st == HC_OK; ++i) {
    if (i > 0 && c->rows[i].omega == c->rows[i - 1].omega) continue;
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
    else st = targets_at(c, ti, states, hbm, curve, c->rows[i].omega, monitor, out);
  }
  if (st == HC_OK) find_peak(setup, ti, states, hbm, curve, out);
  free(states);
  timeint_free(ti);
  return st;
}

void reference_clear(reference *r)
{
  free(r->targets);
  *r = (reference){0};
}

/* ---- at one frequency ------------------------------------------------------------------------- */

enum { CURVE_HARMONICS = 20, TRIES = 8, COARSEST_DECADE = -6 };
static const double best_floor = 1e-12; /* [1] rounding of a period's integration, seen from its amplitude */
static const double marching = 1e-12;   /* transient.tolerance of a reference that shooting did not bring below 1e-10 */
static const double first_distance = 1e-3, nearby = 0.3; /* [omega] of the neighbour; [amplitude] how far apart
                                                               two neighbours may be */

static hc_status make_workspace(finder *f)
{
  const model *m = f->setup.model;
  const int n_coef = hbm_n_coefficients(f->response.hbm);
  f->n_states = 2 * m->n + m->n_contacts;
  f->X = calloc((size_t)n_coef + 3 * (size_t)f->n_states, sizeof *f->X);
  f->motion = calloc((size_t)m->n_responses, sizeof *f->motion);
  if (!f->X || !f->motion) return HC_NO_MEMORY;
  f->state = f->X + n_coef;
  f->other = f->state + f->n_states;
  f->trial = f->other + f->n_states;
  return HC_OK;
}

hc_status finder_start(const compare_setup *setup, const number_list *at, const hc_monitor *monitor, finder *f)
{
  *f = (finder){.setup = method_setup(setup, BENCH_HBM_EXACT, CURVE_HARMONICS, 0, NAN, NAN)};
  if (at->n) f->setup.compare.omega = *at;
  comparison_sweep(setup->omega_from, setup->omega_to, &f->setup.compare.omega, &f->setup.omega_from,
                   &f->setup.omega_to);
  hc_status st = method_curve_trace(&f->setup, monitor, &f->response);
  if (st == HC_OK && f->response.curve.n == 0) st = f->response.status;
  return st == HC_OK ? make_workspace(f) : st;
}

void finder_free(finder *f)
{
  method_curve_free(&f->response);
  free(f->X);
  free(f->motion);
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

/* The exact law's orbit next to state, which moves there; f->motion: every response of it. */
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
  for (int i = f->setup.model->n_responses; i-- > 0 && st == HC_OK;) { /* *r ends as the first one's */
    if (f->setup.model->n_responses > 1) st = timeint_response(ti, i, r);
    f->motion[i] = motion_of_transient(r);
  }
  timeint_free(ti);
  if (st == HC_OK) memcpy(state, f->trial, bytes);
  return st;
}

/* By shooting, at the smallest power of ten as tolerance at which it converges in spite of rounding. */
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

/* The motions that f->motion has become what errors are measured against. */
static void take_reference(const finder *f, bench_start *start)
{
  start->size = 0;
  for (int i = 0; i < start->n_responses; ++i) {
    start->reference[i] = f->motion[i];
    start->size = fmax(start->size, f->motion[i].amplitude);
  }
}

/* Where shooting stopped at a coarse tolerance: the orbit by marching, from there. */
static hc_status march_for(finder *f, double omega, const hc_monitor *monitor, bench_start *start, timeint_result *r,
                           double *floor)
{
  timeint_result marched;
  if (*floor < 5e-10) return HC_OK;
  hc_status st = exact_orbit(f, omega, TRANSIENT_STEADY_MARCH, marching, monitor, f->state, &marched);
  if (st != HC_OK) return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK; /* the floor says how good it is */
  take_reference(f, start);
  marched.multiplier = r->multiplier;
  *r = marched;
  *floor = 10 * marching;
  return HC_OK;
}

/* The largest of the curve's solutions at omega (by its first response) whose orbit is stable, into f->X and
 * f->state. */
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

/* Is every response of a within nearby of b's? */
static bool are_near(int n, const periodic_motion *a, const periodic_motion *b, double size)
{
  for (int i = 0; i < n; ++i)
    if (!(motion_between(&a[i], &b[i]).waveform <= nearby * size)) return false;
  return true;
}

/* The same branch at omega: both sides of it. */
static bool try_neighbour(finder *f, double omega, const hc_monitor *monitor, bench_start *start)
{
  hbm_point point;
  hbm_measures m;
  timeint_result r;
  periodic_motion by_hbm;
  start->neighbour = omega;
  memset(start->X, 0, (size_t)start->most_coef * sizeof *start->X);
  memcpy(start->X, f->X, (size_t)hbm_n_coefficients(f->response.hbm) * sizeof *f->X);
  memcpy(start->state, f->state, (size_t)f->n_states * sizeof *f->state);
  if (hbm_solve(f->response.hbm, omega, start->X, &point) != HC_OK) return false;
  if (exact_orbit(f, omega, TRANSIENT_STEADY_SHOOTING, 1e-9, monitor, start->state, &r) != HC_OK) return false;
  for (int i = 0; i < start->n_responses; ++i)
    if (motion_of_response(f->response.hbm, omega, start->X, i, &m, &by_hbm) != HC_OK ||
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
