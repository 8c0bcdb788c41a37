/* motion.c - see motion.h. */
#include "compare/motion.h"

#include <math.h>

#include "base/constants.h"
#include "numerics/series.h"

periodic_motion motion_of_series(const hbm_measures *m, int n_harm, const double *X)
{
  periodic_motion out = {.amplitude = m->amplitude, .harmonic_1 = m->harmonic_1, .mean = X[0]};
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double th = TWO_PI * i / TIMEINT_WAVE;
    out.wave[i] = series_at(n_harm, X, cos(th), sin(th)).x;
  }
  return out;
}

periodic_motion motion_of_transient(const timeint_result *r)
{
  periodic_motion out = {
      .amplitude = r->amplitude, .harmonic_1 = r->harmonic_1, .mean = r->mean, .free_mean = r->free_sliders > 0};
  for (int i = 0; i < TIMEINT_WAVE; ++i) out.wave[i] = r->wave[i];
  return out;
}

motion_distance motion_between(const periodic_motion *a, const periodic_motion *b)
{
  const double shift = a->free_mean || b->free_mean ? a->mean - b->mean : 0;
  motion_distance distance = {.amplitude = fabs(a->amplitude - b->amplitude),
                              .harmonic_1 = fabs(a->harmonic_1 - b->harmonic_1),
                              .mean = fabs(a->mean - b->mean)};
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double d = fabs(a->wave[i] - b->wave[i] - shift);
    if (!(d >= 0)) {
      distance.waveform = NAN;
      break;
    }
    if (d > distance.waveform) distance.waveform = d;
  }
  return distance;
}

discrepancy motion_discrepancy(const periodic_motion *a, const periodic_motion *b)
{
  const motion_distance d = motion_between(a, b);
  return (discrepancy){.amplitude = discrepancy_relative(d.amplitude, b->amplitude),
                       .harmonic_1 = discrepancy_relative(d.harmonic_1, b->amplitude),
                       .mean = discrepancy_relative(d.mean, b->amplitude),
                       .waveform = discrepancy_relative(d.waveform, b->amplitude)};
}

void motion_series(const periodic_motion *m, int n_harm, double *X)
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
