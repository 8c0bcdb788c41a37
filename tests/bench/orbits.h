/* orbits.h - what the benchmarks of steady states share beside bench.h: scenes with their sweeps, the start on the HBM
 * orbit, the reference orbit. */
#pragma once

#include "compare/comparison.h"
#include "tests/bench/bench.h"
#include "tests/timeint/scenes.h"

/* With harmonic balance over from..to: H harmonics, harmonic 0, exact forces. */
static inline scene with_hbm(scene sc, int harmonics, double from, double to)
{
  sc.hbm = (hbm_settings){.harmonics = harmonics,
                          .keep_mean = true,
                          .force = HBM_FORCE_EXACT,
                          .samples = 1024,
                          .tolerance = 1e-12,
                          .accuracy = 1e-4,
                          .skip_linear = true};
  sc.omega_from = from;
  sc.omega_to = to;
  return sc;
}

/* The HBM solution of largest amplitude at omega, into X[2H+1]; *start: x, v and sliders there at t = 0. */
static inline void largest_solution(const scene *sc, double omega, double *X, hbm_measures *best, scene_state *start)
{
  hbm_solver *s = NULL;
  hbm_curve curve = {0}, at = {0};
  hbm_measures m;
  must(scene_hbm_solver(sc, &s), "harmonic balance");
  must(hbm_trace(s, sc->omega_from, sc->omega_to, NULL, &curve), "response curve");
  must(hbm_curve_at(s, &curve, omega, &at), "response curve");
  best->amplitude = -1;
  for (int k = 0; k < at.n; ++k) {
    must(hbm_measure(s, at.X + (size_t)k * at.n_coef, &m), "HBM solution");
    if (m.amplitude <= best->amplitude) continue;
    *best = m;
    memcpy(X, at.X + (size_t)k * at.n_coef, (size_t)at.n_coef * sizeof *X);
  }
  if (best->amplitude < 0) must(HC_NOT_CONVERGED, "no HBM solution");
  must(comparison_orbit_start(s, X, omega, start->all), "HBM solution");
  hbm_curve_free(&at);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
}

/* x, v and sliders at t = 0 of that solution. */
static inline scene_state hbm_start(const scene *sc, double omega)
{
  double X[2 * HBM_MAX_HARMONICS + 1];
  hbm_measures m;
  scene_state start;
  largest_solution(sc, omega, X, &m, &start);
  return start;
}

/* With tolerance `tolerance` and the exact law, from *state, which becomes a point on the orbit. */
static inline hc_status exact_orbit(scene sc, double omega, int steady, double tolerance, scene_state *state,
                                    timeint_result *r)
{
  timeint *ti = NULL;
  sc.transient = (transient_settings){.law = TRANSIENT_LAW_EXACT,
                                      .steady = steady,
                                      .tolerance = tolerance,
                                      .regularisation = 1e-4,
                                      .max_periods = 200000};
  must(scene_timeint(&sc, &ti), "reference");
  hc_status st = timeint_steady(ti, omega, state->all, NULL, r);
  timeint_free(ti);
  return st;
}

/* The exact law's orbit next to `start`, by shooting at tolerance 1e-13. Where rounding does not allow that, at the
 * tightest decade it does; and if that is coarser than 1e-11, by waiting from there, to 1e-12. */
static inline timeint_result reference_orbit(scene sc, double omega, scene_state start)
{
  hc_status st = HC_NOT_CONVERGED;
  timeint_result r;
  int decade = -14;
  while (st == HC_NOT_CONVERGED && decade < -6) {
    scene_state y = start;
    st = exact_orbit(sc, omega, TRANSIENT_STEADY_SHOOTING, pow(10, ++decade), &y, &r);
    if (st == HC_OK) start = y;
  }
  must(st, "reference");
  if (decade > -11) must(exact_orbit(sc, omega, TRANSIENT_STEADY_MARCH, 1e-12, &start, &r), "reference");
  if (decade > -13)
    fprintf(stderr, "omega = %g: reference by shooting at 1e%d%s\n", omega, decade,
            decade > -11 ? ", then by waiting to 1e-12" : "");
  return r;
}
