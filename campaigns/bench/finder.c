/* finder.c - see finder.h. */
#include "campaigns/bench/finder.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "campaigns/scene_solvers.h"
#include "compare/comparison.h"
#include "compare/frequencies.h"

enum { CURVE_HARMONICS = 20, TRIES = 8, NO_DECADE = -6 };
static const double best_floor = 1e-12; /* [1] rounding of a period's integration, seen from its amplitude */
static const double waiting = 1e-12;    /* transient.tolerance of a reference that shooting did not bring below 1e-10 */
static const double first_distance = 1e-3, next_door = 0.3; /* [omega] of the neighbour; [amplitude] how far apart
                                                               two neighbours may be */

hc_status finder_start(const scene *sc, const number_list *at, const hc_monitor *monitor, finder *f)
{
  double from, to;
  *f = (finder){.sc = *sc};
  f->sc.hbm.harmonics = CURVE_HARMONICS;
  f->sc.hbm.force = HBM_FORCE_EXACT;
  comparison_sweep(sc->omega_from, sc->omega_to, at->n ? at : &sc->compare.omega, &from, &to);
  f->sc.omega_from = from;
  f->sc.omega_to = to;
  hc_status st = scene_hbm_solver(&f->sc, &f->hbm);
  if (st == HC_OK) st = hbm_trace(f->hbm, from, to, monitor, &f->curve);
  return st == HC_INTERRUPTED || st == HC_NO_MEMORY || f->curve.n == 0 ? st : HC_OK; /* as far as the curve goes */
}

void finder_free(finder *f)
{
  hbm_curve_free(&f->curve);
  hbm_solver_free(f->hbm);
  *f = (finder){0};
}

hc_status finder_default(finder *f, double *omega)
{
  number_list all;
  double most = -1;
  hc_status st = comparison_frequencies(&f->sc.compare, f->sc.omega_from, f->hbm, &f->curve, &all);
  for (int i = 0; i < all.n && st == HC_OK; ++i) {
    hbm_curve at = {0};
    hbm_measures m;
    st = hbm_curve_at(f->hbm, &f->curve, all.v[i], &at) == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
    for (int k = 0; k < at.n; ++k)
      if (hbm_measure(f->hbm, at.X + (size_t)k * at.n_coef, &m) == HC_OK && m.amplitude > most)
        most = m.amplitude, *omega = all.v[i];
    hbm_curve_free(&at);
  }
  return st == HC_OK && most < 0 ? HC_NOT_CONVERGED : st;
}

/* The exact law's orbit next to *state, which moves there. */
static hc_status exact_orbit(const scene *sc, double omega, transient_steady steady, double tolerance,
                             const hc_monitor *monitor, scene_state *state, timeint_result *r)
{
  scene own = *sc;
  timeint *ti = NULL;
  scene_state y = *state;
  own.transient.law = TRANSIENT_LAW_EXACT;
  own.transient.tolerance = tolerance;
  own.transient.steady = steady;
  hc_status st = scene_timeint(&own, &ti);
  if (st == HC_OK) st = timeint_steady(ti, omega, y.all, monitor, r);
  timeint_free(ti);
  if (st == HC_OK) *state = y;
  return st;
}

/* By shooting, at the smallest power of ten as tolerance at which it converges in spite of rounding. */
static hc_status tightest_orbit(const scene *sc, double omega, const hc_monitor *monitor, scene_state *state,
                                timeint_result *r, double *floor)
{
  hc_status st = HC_NOT_CONVERGED;
  int decade = -14;
  while (st != HC_OK && st != HC_INTERRUPTED && st != HC_NO_MEMORY && decade < NO_DECADE)
    st = exact_orbit(sc, omega, TRANSIENT_STEADY_SHOOTING, pow(10, ++decade), monitor, state, r);
  *floor = fmax(best_floor, pow(10, decade));
  return st;
}

/* Where shooting stopped at a coarse tolerance: the orbit by marching, from there. */
static hc_status wait_for(const scene *sc, double omega, const hc_monitor *monitor, scene_state *state,
                          timeint_result *r, double *floor)
{
  timeint_result waited;
  if (*floor < 5e-10) return HC_OK;
  hc_status st = exact_orbit(sc, omega, TRANSIENT_STEADY_MARCH, waiting, monitor, state, &waited);
  if (st != HC_OK) return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK; /* the floor says how good it is */
  waited.multiplier = r->multiplier;
  *r = waited;
  *floor = 10 * waiting;
  return HC_OK;
}

/* Of the curve's solutions at omega, by size: the largest whose orbit is stable. */
static hc_status largest_stable(finder *f, double omega, const hc_monitor *monitor, double *X, scene_state *state,
                                timeint_result *best, double *floor)
{
  hbm_curve at = {0};
  hbm_measures m;
  hc_status st = hbm_curve_at(f->hbm, &f->curve, omega, &at);
  *best = (timeint_result){.amplitude = -1};
  if (st != HC_NO_MEMORY) st = HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    const double *Xk = at.X + (size_t)k * at.n_coef;
    timeint_result r;
    double floor_k;
    if (hbm_measure(f->hbm, Xk, &m) != HC_OK || m.amplitude < 0.9 * best->amplitude) continue;
    scene_state y = {.x = 0};
    hc_status found = comparison_orbit_start(f->hbm, Xk, omega, y.all);
    if (found == HC_OK) found = tightest_orbit(&f->sc, omega, monitor, &y, &r, &floor_k);
    if (found == HC_INTERRUPTED || found == HC_NO_MEMORY) st = found;
    if (found != HC_OK || timeint_stability(&r) <= 0 || r.amplitude <= best->amplitude) continue;
    *best = r;
    *state = y;
    *floor = floor_k;
    memcpy(X, Xk, (size_t)at.n_coef * sizeof *X);
  }
  hbm_curve_free(&at);
  return st == HC_OK && best->amplitude < 0 ? HC_NOT_CONVERGED : st;
}

static bool near(const periodic_motion *a, const periodic_motion *b)
{
  return motion_between(a, b).waveform <= next_door * b->amplitude;
}

/* The same branch at omega: both sides of it. */
static bool try_neighbour(finder *f, double omega, const double *X, const scene_state *state, const hc_monitor *monitor,
                          bench_start *start)
{
  hbm_point point;
  hbm_measures m;
  timeint_result r;
  start->neighbour = omega;
  start->state = *state;
  memset(start->X, 0, sizeof start->X);
  memcpy(start->X, X, (size_t)(2 * CURVE_HARMONICS + 1) * sizeof *X);
  if (hbm_solve(f->hbm, omega, start->X, &point) != HC_OK || hbm_measure(f->hbm, start->X, &m) != HC_OK) return false;
  if (exact_orbit(&f->sc, omega, TRANSIENT_STEADY_SHOOTING, 1e-9, monitor, &start->state, &r) != HC_OK) return false;
  periodic_motion by_hbm = motion_of_solution(&m, CURVE_HARMONICS, start->X), by_time = motion_of_transient(&r);
  return near(&by_hbm, &by_time) && near(&by_time, &start->reference);
}

hc_status finder_frequency(finder *f, double omega, const hc_monitor *monitor, bench_frequency *at, bench_start *start)
{
  double X[BENCH_MOST_COEF], distance = first_distance;
  timeint_result r;
  scene_state state = {.x = 0};
  *at = (bench_frequency){.omega = omega};
  *start = (bench_start){.omega = omega};
  hc_status st = largest_stable(f, omega, monitor, X, &state, &r, &at->floor);
  if (st == HC_OK) st = wait_for(&f->sc, omega, monitor, &state, &r, &at->floor);
  if (st != HC_OK) return st;
  start->reference = motion_of_transient(&r);
  at->amplitude = r.amplitude;
  at->multiplier = r.multiplier;
  /* towards the middle of the sweep first */
  if (omega > 0.5 * (f->sc.omega_from + f->sc.omega_to)) distance = -distance;
  for (int i = 0; i < TRIES; ++i) {
    if (!hc_monitor_tick(monitor, -1)) return HC_INTERRUPTED;
    if (try_neighbour(f, omega * (1 + distance), X, &state, monitor, start)) {
      at->neighbour = start->neighbour;
      return HC_OK;
    }
    distance *= i % 2 ? -0.25 : -1;
  }
  return HC_NOT_CONVERGED;
}
