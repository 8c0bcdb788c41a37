/* safe_step.h - how far a function surely stays positive, from its value, slope and a bound of its second
 * derivative. */
#ifndef HC_SAFE_STEP_H
#define HC_SAFE_STEP_H

#include <math.h>

/* The tau up to which f + slope tau - bound tau^2/2 >= 0; f, bound >= 0. INFINITY: for ever. */
static inline double safe_step(double f, double slope, double bound)
{
  const double root = sqrt(slope * slope + 2 * bound * f);
  if (slope < 0) return 2 * f / (root - slope); /* without cancellation */
  return bound > 0 ? (slope + root) / bound : INFINITY;
}

#endif
