/* motion.h - a periodic motion by what it is compared in, whether it comes from harmonics or from time integration. */
#ifndef HC_MOTION_H
#define HC_MOTION_H

#include "hbm/hbm.h"
#include "timeint/timeint.h"

typedef struct steady_motion {
  double amplitude, harmonic_1, mean; /* [length] */
  bool free_mean;                     /* where it rests is a matter of history */
  double wave[TIMEINT_WAVE];          /* [length] x at t = i T / TIMEINT_WAVE */
} steady_motion;

steady_motion motion_of_series(const hbm_measures *m, int n_harm, const double *X);
steady_motion motion_of_transient(const timeint_result *r);

/* Distances of a and b, [length]. */
typedef struct motion_gap {
  double amplitude, harmonic_1, waveform;
} motion_gap;
motion_gap motion_between(const steady_motion *a, const steady_motion *b);

/* X[2 n_harm + 1] of the wave, n_harm < TIMEINT_WAVE/2; exact for a wave without higher harmonics. */
void motion_series(const steady_motion *m, int n_harm, double *X);

#endif
