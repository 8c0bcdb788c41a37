/* steady_references.h - the reference scenes with everything both solvers need. */
#pragma once

#include "hbm/hbm.h"
#include "tests/hbm/scenes.h"
#include "timeint/timeint.h"

/* The motion the solution X has at t = 0. */
static inline scene_state orbit_start(hbm_solver *s, int n_harm, const double *X, double omega)
{
  scene_state state = {.x = X[0]};
  CHECK_FILLED(hbm_measures, m, hbm_measure(s, X, &m));
  for (int h = 1; h <= n_harm; ++h) {
    state.x += X[2 * h - 1];
    state.v += h * omega * X[2 * h];
  }
  assert_int_equal(hbm_sliders(s, X, state.w), HC_OK);
  return state;
}
