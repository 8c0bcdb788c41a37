/* discrepancy.h - how far a harmonic-balance solution is from a motion, by the four measures that are compared. */
#pragma once

#include <math.h>

/* [1] relative to the motion's amplitude; NaN where there is nothing to compare. */
typedef struct discrepancy {
  double amplitude;  /* |difference of (max - min)/2| */
  double harmonic_1; /* |difference of |a1 + i b1|| */
  double mean;       /* |difference of the means| */
  double waveform;   /* largest |difference of x| over the period, at equal phase */
} discrepancy;

/* |difference|/amplitude; no difference is no discrepancy, also where nothing moves (no forcing). */
static inline double discrepancy_relative(double difference, double amplitude)
{
  return difference == 0 ? 0 : fabs(difference) / amplitude;
}
