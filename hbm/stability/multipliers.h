/* multipliers.h - the Floquet multipliers of a solution, in numbers. What predicts their error is
 * hbm/curve/predict.h. */
#pragma once

#include <stdbool.h>

typedef struct hbm_stability {
  double multiplier;  /* modulus of the largest Floquet multiplier */
  double re, im;      /* that multiplier */
  double flip;        /* product of (1 + multiplier): changes sign at a period doubling */
  double fold;        /* product of (1 - multiplier): changes sign at a turning point */
  double determinant; /* product of all multipliers; 0 where a structure loses motions to rounding in a period */
  int pairs_outside;  /* complex pairs outside the unit circle, by more than 1e-10 */
  double pair;        /* modulus of the complex pair nearest to the circle, NaN without one */
  bool agrees;        /* det dR/dX has the sign of `fold`; it need not where few harmonics move the turning point */
  bool of_motion;     /* the multipliers depend on the motion, and so are off by what it is off */
  bool predicted;     /* their error was asked for (hbm_stability_with_error); else low = high = multiplier */
  bool as_row_before; /* it was not, since that of a row before was enough */
  double low, high;   /* what the largest modulus is between; 0 and INFINITY: nobody knows */
} hbm_stability;
