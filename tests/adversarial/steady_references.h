/* steady_references.h - the reference scenes with everything both solvers need, and the steady states they are known to
 * have. */
#pragma once

#include "hbm/hbm.h"
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

/* A row of transient_exact.csv: period 1, stable, swept up or down. */
typedef struct steady_reference {
  char name[16], sweep[8];
  double omega, amplitude, max, min, harmonic_1;
} steady_reference;

enum { N_STEADY_REFERENCES = 134 };

static inline void read_steady_references(steady_reference *row)
{
  char line[256];
  FILE *f = open_reference(SOURCE_DIR "/tests/reference/transient_exact.csv",
                           "case,sweep,omega,amplitude,max,min,harmonic_1,mean,events_per_period,period_closure");
  int n = 0;
  while (fgets(line, sizeof line, f)) {
    assert_true(n < N_STEADY_REFERENCES);
    steady_reference *r = &row[n++];
    int got = sscanf(line, "%15[^,],%7[^,],%lf,%lf,%lf,%lf,%lf", r->name, r->sweep, &r->omega, &r->amplitude, &r->max,
                     &r->min, &r->harmonic_1);
    if (got != 7) fail_msg("transient_exact.csv, row %d: %s", n, line);
  }
  fclose(f);
  assert_int_equal(n, N_STEADY_REFERENCES);
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
