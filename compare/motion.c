/* motion.c - see motion.h. */
#include "compare/motion.h"

#include <math.h>

#include "base/constants.h"
#include "numerics/series.h"

steady_motion motion_of_series(const hbm_measures *m, int n_harm, const double *X)
{
  steady_motion out = {.amplitude = m->amplitude, .harmonic_1 = m->harmonic_1, .mean = X[0]};
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double th = TWO_PI * i / TIMEINT_WAVE;
    out.wave[i] = series_at(n_harm, X, cos(th), sin(th)).x;
  }
  return out;
}

steady_motion motion_of_transient(const timeint_result *r)
{
  steady_motion out = {
      .amplitude = r->amplitude, .harmonic_1 = r->harmonic_1, .mean = r->mean, .free_mean = r->free_sliders > 0};
  for (int i = 0; i < TIMEINT_WAVE; ++i) out.wave[i] = r->wave[i];
  return out;
}

motion_gap motion_between(const steady_motion *a, const steady_motion *b)
{
  const double shift = a->free_mean || b->free_mean ? a->mean - b->mean : 0;
  motion_gap gap = {.amplitude = fabs(a->amplitude - b->amplitude), .harmonic_1 = fabs(a->harmonic_1 - b->harmonic_1)};
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double d = fabs(a->wave[i] - b->wave[i] - shift);
    if (!(d >= 0)) {
      gap.waveform = NAN;
      break;
    }
    if (d > gap.waveform) gap.waveform = d;
  }
  return gap;
}

void motion_series(const steady_motion *m, int n_harm, double *X)
{
  for (int k = 0; k < 2 * n_harm + 1; ++k) X[k] = 0;
  for (int i = 0; i < TIMEINT_WAVE; ++i) X[0] += m->wave[i] / TIMEINT_WAVE;
  for (int h = 1; h <= n_harm; ++h)
    for (int i = 0; i < TIMEINT_WAVE; ++i) {
      double th = TWO_PI * (double)((long)h * i % TIMEINT_WAVE) / TIMEINT_WAVE; /* the angle is small: no digits lost */
      X[2 * h - 1] += 2.0 / TIMEINT_WAVE * m->wave[i] * cos(th);
      X[2 * h] += 2.0 / TIMEINT_WAVE * m->wave[i] * sin(th);
    }
}
