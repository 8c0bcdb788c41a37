/* motion.h - a periodic motion by what it is compared in, whether it comes from harmonics or from time integration. */
#ifndef HC_MOTION_H
#define HC_MOTION_H

#include "compare/discrepancy.h"
#include "hbm/hbm.h"
#include "timeint/steady.h"

typedef struct periodic_motion {
  double amplitude, harmonic_1, mean; /* [length] */
  bool free_mean;                     /* where it rests is a matter of history: means are not compared */
  double wave[TIMEINT_WAVE];          /* [length] x at t = i T / TIMEINT_WAVE */
} periodic_motion;

periodic_motion motion_of_series(const hbm_measures *m, int n_harm, const double *X);
periodic_motion motion_of_transient(const timeint_result *r);

/* Distances [length] of a and b by the measures of discrepancy.h. For the waveform the means are set equal where one
 * of them is free. NaN where something is not a number. */
typedef struct motion_distance {
  double amplitude, harmonic_1, mean, waveform;
} motion_distance;
motion_distance motion_between(const periodic_motion *a, const periodic_motion *b);

/* The same relative to b's amplitude. */
discrepancy motion_discrepancy(const periodic_motion *a, const periodic_motion *b);

/* X[2 n_harm + 1] of the wave, n_harm < TIMEINT_WAVE/2; exact for a wave without higher harmonics. */
void motion_series(const periodic_motion *m, int n_harm, double *X);

#endif
