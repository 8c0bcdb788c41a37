/* planar_slider.h - the slider of a contact with two tangents under the law of the circle (planar_slip.h), from
 * one sample of the motion to the next. With r = mu N/kt [length] the law is: the slider w stays within r of u, moves
 * only if it must, and then straight towards u,
 *
 *     |u - w| <= r,      T = kt (u - w),      separated where r <= 0: w = u, T = 0
 *
 * r is computed with N as if in contact, so it becomes negative where contact is lost. Two rules:
 *     along the line   between samples u and r vary linearly, and the law is integrated exactly: as the restart
 *                      `interpolated` does with one tangent. Error of order 2 in the step.
 *     radial return    the slider stays, or moves straight onto the circle about the next sample: with the restart
 *                      `sample`, and as other programs do. Error of order 1 where the direction of slip turns, since
 *                      each step uses the direction at its end.
 * On a straight motion both equal the law of one tangent. libm only, nothing is allocated, cannot fail. */
#pragma once

#include "hbm/contact/slider.h"

/* A sample of the motion: u [length], r [length] as above. */
typedef struct planar_sample {
  double u[2], r;
} planar_sample;

typedef enum planar_move {
  PLANAR_APART,  /* no contact at the end of the step */
  PLANAR_HELD,   /* it sticks, w unchanged */
  PLANAR_PLACED, /* contact was made in the step; it sticks at a new w */
  PLANAR_SLIPPED /* it slips; w is on the circle */
} planar_move;

/* Derivatives of w at the end of a step: dw = from d(u_1, u_2, r) at the first sample + to d(u_1, u_2, r) at the second
 * + w dw before the step. Not set with PLANAR_HELD and PLANAR_APART. */
typedef struct planar_slope {
  double from[2][3], to[2][3], w[2][2];
} planar_slope;

/* One step from sample `from` to `to`; w [length] becomes the slider at `to`. slope may be NULL. */
planar_move planar_slider_step(hbm_restart restart, const planar_sample *from, const planar_sample *to, double w[2],
                               planar_slope *slope);

/* The same as it is plugged in. */
typedef struct planar_rule {
  planar_move (*step)(const planar_sample *from, const planar_sample *to, double w[2], planar_slope *slope);
} planar_rule;

/* Moves w into the circle about `to`: start of the first period. */
planar_move planar_slider_enter(const planar_sample *to, double w[2], planar_slope *slope);
