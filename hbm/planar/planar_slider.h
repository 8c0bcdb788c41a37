/* planar_slider.h - the slider of a contact with two tangents under the law of the circle (planar_slip.h), from
 * one sample of the motion to the next. With r = mu N/kt [length] the law is: the slider w stays within r of u, moves
 * only where it must, and then straight towards u,
 *
 *     |u - w| <= r,      T = kt (u - w),      apart where r <= 0: w = u, T = 0
 *
 * r is taken without a bound on N, so that it falls through 0 where contact is lost. Two rules:
 *     along the line   between samples u and r change evenly, and the law is followed exactly: as the restart
 *                      `interpolated` does with one tangent. Error of order 2 in the step.
 *     radial return    the slider stays or goes straight to the circle about the next sample: with the restart
 *                      `sample`, and as other programs do. Order 1 where the direction of slip turns, as each step
 *                      takes the direction that it ends with.
 * On a straight motion both are the law of one tangent. libm only, nothing is allocated, cannot fail. */
#pragma once

#include "hbm/contact/slider.h"

/* A sample of the motion: u [length], r [length] as above. */
typedef struct planar_sample {
  double u[2], r;
} planar_sample;

typedef enum planar_move {
  PLANAR_APART,  /* no contact at the end of the step */
  PLANAR_HELD,   /* it sticks, w is as it was */
  PLANAR_PLACED, /* contact was made in the step, w was put somewhere, where it sticks */
  PLANAR_SLIPPED /* it slips, w is on the circle */
} planar_move;

/* What w at the end of a step depends on: dw = from d(u_1, u_2, r) + to d(u_1, u_2, r) + w dw, of the sample that the
 * step starts from, of that where it ends, and of w before. Left alone by PLANAR_HELD and PLANAR_APART. */
typedef struct planar_slope {
  double from[2][3], to[2][3], w[2][2];
} planar_slope;

/* One step. w [length] becomes the slider at `to`. slope may be NULL. */
planar_move planar_slider_step(hbm_restart restart, const planar_sample *from, const planar_sample *to, double w[2],
                               planar_slope *slope);

/* The same as it is plugged in. */
typedef struct planar_rule {
  planar_move (*step)(const planar_sample *from, const planar_sample *to, double w[2], planar_slope *slope);
} planar_rule;

/* w put into the circle about `to`, at once: how the first of all periods begins. */
planar_move planar_slider_enter(const planar_sample *to, double w[2], planar_slope *slope);
