/* steady_references.h - the reference scenes with everything both solvers need. */
#pragma once

#include "hbm/hbm.h"
#include "study/scene_solvers.h"
#include "tests/hbm/scenes.h"
#include "timeint/timeint.h"

/* As exact_scene, the exact law, too, solved as far as rounding lets: what is left is what a test is about. */
static inline scene exact_reference_scene(const char *name, int n_harm)
{
  scene sc = exact_scene(name, n_harm, true);
  sc.hbm.tolerance = 1e-12;
  sc.hbm.skip_linear = true;
  sc.transient = (transient_settings){
      .law = TRANSIENT_LAW_EXACT, .regularisation = 1e-4, .tolerance = 1e-10, .max_periods = 20000};
  return sc;
}

/* The motion the solution X has at t = 0. */
static inline scene_state orbit_start(hbm_solver *s, int n_harm, const double *X, double omega)
{
  hbm_measures m;
  scene_state state = {.x = X[0]};
  assert_int_equal(hbm_measure(s, X, &m), HC_OK);
  for (int h = 1; h <= n_harm; ++h) {
    state.x += X[2 * h - 1];
    state.v += h * omega * X[2 * h];
  }
  assert_int_equal(hbm_sliders(s, X, state.w), HC_OK);
  return state;
}
