/* periodic_motion.h - one period of a motion by its measures and samples, its harmonics, and how far apart two are.
 *
 *     x(th) = X[0] + sum_{h=1..H} X[2h-1] cos(h th) + X[2h] sin(h th)          (numerics/series.h), th = omega t [rad]
 *     samples[i] = x(2 pi i / MOTION_SAMPLES)
 *
 * Harmonic balance fills it from a series (motion_of_series), time integration from its dense output
 * (compare/motion.h). Nothing is allocated, nothing can fail; NaN in gives NaN out. */
#pragma once

#include <stdbool.h>

enum { MOTION_SAMPLES = 512 };

typedef struct periodic_motion {
  double amplitude, max, min; /* [length] amplitude = (max - min)/2 */
  double rms, mean;           /* [length] rms: mean included */
  double a1, b1, harmonic_1;  /* [length] x ~ a1 cos(th) + b1 sin(th); harmonic_1 = |a1 + i b1| */
  bool mean_free;             /* a slider never slips: the mean depends on the history, not on the equations alone */
  double samples[MOTION_SAMPLES]; /* [length] */
} periodic_motion;

static inline double motion_amplitude(double max, double min) { return 0.5 * (max - min); }

/* How far off a motion is by the reckoning of whoever computed it, before it is held against another; NaN: not
 * known. */
typedef struct motion_error {
  double amplitude, harmonic_1, waveform; /* [length] as in motion_distance */
} motion_error;

/* [waveform] Amplitude and first harmonic are expected to be off by this at least. Of two motions they may agree by
 * chance, where an error passes through 0 as omega or a setting changes; what they are off by is then of the size of
 * what the finer equations leave out, an eighth of the waveform's error or less. The worst seen is 0.03 of it, along
 * c2. */
#define MOTION_LEAST_SHARE 0.04

/* The motion of the series X[2 n_harm + 1], whose extrema the caller has from series_extrema. */
periodic_motion motion_of_series(int n_harm, const double *X, double max, double min);

/* X[2 n_harm + 1] of the samples, n_harm < MOTION_SAMPLES/2; exact where x has no harmonics above
 * MOTION_SAMPLES - 1 - n_harm. */
void motion_harmonics(const periodic_motion *m, int n_harm, double *X);

/* Distances of a and b [length]; phases are not aligned, since the forcing fixes them. */
typedef struct motion_distance {
  double amplitude, harmonic_1, mean; /* |difference| of these */
  double waveform; /* largest |difference| of the samples, the means made equal where one of them is free */
} motion_distance;
motion_distance motion_between(const periodic_motion *a, const periodic_motion *b);
