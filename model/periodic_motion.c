/* periodic_motion.c - see periodic_motion.h. Proof: tests/model/test_periodic_motion.c. */
#include "model/periodic_motion.h"

#include <math.h>

#include "numerics/base/constants.h"
#include "numerics/series.h"

periodic_motion motion_of_series(int n_harm, const double *X, double max, double min)
{
  periodic_motion m = {.amplitude = motion_amplitude(max, min),
                       .max = max,
                       .min = min,
                       .rms = series_rms(n_harm, X),
                       .mean = X[0],
                       .a1 = n_harm > 0 ? X[1] : 0,
                       .b1 = n_harm > 0 ? X[2] : 0,
                       .harmonic_1 = series_harmonic_1(n_harm, X)};
  for (int i = 0; i < MOTION_SAMPLES; ++i) {
    const double th = TWO_PI * i / MOTION_SAMPLES;
    m.samples[i] = series_at(n_harm, X, cos(th), sin(th)).x;
  }
  return m;
}

void motion_harmonics(const periodic_motion *m, int n_harm, double *X)
{
  for (int k = 0; k < 2 * n_harm + 1; ++k) X[k] = 0;
  for (int i = 0; i < MOTION_SAMPLES; ++i) X[0] += m->samples[i] / MOTION_SAMPLES;
  for (int h = 1; h <= n_harm; ++h)
    for (int i = 0; i < MOTION_SAMPLES; ++i) {
      /* h i is reduced to one period before the cosine: a large angle would lose digits */
      const double th = TWO_PI * (double)((long)h * i % MOTION_SAMPLES) / MOTION_SAMPLES;
      X[2 * h - 1] += 2.0 / MOTION_SAMPLES * m->samples[i] * cos(th);
      X[2 * h] += 2.0 / MOTION_SAMPLES * m->samples[i] * sin(th);
    }
}

motion_distance motion_between(const periodic_motion *a, const periodic_motion *b)
{
  const double shift = a->mean_free || b->mean_free ? a->mean - b->mean : 0;
  motion_distance distance = {.amplitude = fabs(a->amplitude - b->amplitude),
                              .harmonic_1 = fabs(a->harmonic_1 - b->harmonic_1),
                              .mean = fabs(a->mean - b->mean)};
  for (int i = 0; i < MOTION_SAMPLES; ++i) {
    const double d = fabs(a->samples[i] - b->samples[i] - shift);
    if (isnan(d)) {
      distance.waveform = NAN;
      break;
    }
    if (d > distance.waveform) distance.waveform = d;
  }
  return distance;
}
