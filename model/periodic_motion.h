/* periodic_motion.h - one period of a motion: measures, samples, harmonics; distance of two motions.
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
  double amplitude, max, min;     /* [length] amplitude = (max - min)/2 */
  double rms, mean;               /* [length] rms: mean included */
  double a1, b1, harmonic_1;      /* [length] x ~ a1 cos(th) + b1 sin(th); harmonic_1 = |a1 + i b1| */
  bool mean_free;                 /* a slider never slips, so that the mean depends on the history */
  double samples[MOTION_SAMPLES]; /* [length] */
} periodic_motion;

static inline double motion_amplitude(double max, double min) { return 0.5 * (max - min); }

/* Error estimate of a motion by its own solver, made before any comparison; NaN: unknown. */
typedef struct motion_error {
  double amplitude, harmonic_1, waveform; /* [length] as in motion_distance */
} motion_error;

/* [waveform] Least estimated error of amplitude and first harmonic. Two motions may agree in these by chance, where an
 * error changes sign as omega or a setting varies; the true error is then that of the finer equations, at most an
 * eighth of the waveform's error. Largest seen: 0.03 of it, along c2. */
#define MOTION_LEAST_SHARE 0.04

/* The motion of the series X[2 n_harm + 1]; max, min: from series_extrema. */
periodic_motion motion_of_series(int n_harm, const double *X, double max, double min);

/* Harmonics X[2 n_harm + 1] from the samples, n_harm < MOTION_SAMPLES/2; exact if x has no harmonics above
 * MOTION_SAMPLES - 1 - n_harm. */
void motion_harmonics(const periodic_motion *m, int n_harm, double *X);

/* Distances of two motions [length]; phases are not aligned, since the forcing fixes them. */
typedef struct motion_distance {
  double amplitude, harmonic_1, mean; /* |difference| of the measures */
  double waveform;                    /* largest |difference| of the samples; with equal means if mean_free in either */
} motion_distance;
motion_distance motion_between(const periodic_motion *a, const periodic_motion *b);
