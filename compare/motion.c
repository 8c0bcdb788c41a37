/* motion.c - see motion.h. */
#include "compare/motion.h"

#include <string.h>

_Static_assert((int)TIMEINT_WAVE == (int)MOTION_SAMPLES, "a transient's wave is taken as it is");

hc_status motion_of_response(hbm_solver *s, double omega, const double *X, int r, hbm_measures *m, periodic_motion *out)
{
  hbm_measures unused;
  double x[2 * HBM_MAX_HARMONICS + 1];
  if (!m) m = &unused;
  hc_status st = hbm_measure_response(s, omega, X, r, m);
  if (st == HC_OK) st = hbm_response(s, omega, X, r, x);
  if (st == HC_OK) *out = motion_of_series(hbm_n_harmonics(s), x, m->max, m->min);
  return st;
}

bool motion_mean_is_free(const timeint_result *r) { return r->free_sliders > 0; }

periodic_motion motion_of_transient(const timeint_result *r)
{
  periodic_motion m = {.amplitude = r->amplitude,
                       .max = r->max,
                       .min = r->min,
                       .rms = r->rms,
                       .mean = r->mean,
                       .a1 = r->a1,
                       .b1 = r->b1,
                       .harmonic_1 = r->harmonic_1,
                       .mean_free = motion_mean_is_free(r)};
  memcpy(m.samples, r->wave, sizeof m.samples);
  return m;
}

discrepancy motion_discrepancy(const periodic_motion *a, const periodic_motion *b)
{
  const motion_distance d = motion_between(a, b);
  return (discrepancy){.amplitude = discrepancy_relative(d.amplitude, b->amplitude),
                       .harmonic_1 = discrepancy_relative(d.harmonic_1, b->amplitude),
                       .mean = a->mean_free || b->mean_free ? NAN : discrepancy_relative(d.mean, b->amplitude),
                       .waveform = discrepancy_relative(d.waveform, b->amplitude)};
}
