/* planar_corner.h - where a slider comes to rest that marching drags for ever, less and less. The friction circles of
 * all instants, |u(th) - w| <= R(th), contain that place; two of them, at th_1 and th_2, have only a thin lens in
 * common. They drag the slider in turn towards a corner of the lens,
 *
 *     h_i = |u(th_i) - w| - R(th_i) = 0,      dh_i/dth = u'.e_i - R' = 0,      e_i = (u - w)/|u - w|,      i = 1, 2
 *
 * A period shrinks the slip only by a part of about (the lens's half angle)^2: passes, and Newton on passes, are off by
 * rounding over that square, these equations by rounding over the angle. libm only, nothing is allocated. */
#pragma once

#include <stdbool.h>

#include "hbm/contact/contact_evaluator.h"
#include "hbm/planar/planar_motion.h"

typedef struct planar_corner {
  double w[2];        /* [length] */
  planar_point at[2]; /* where it touches */
  double e[2][2];     /* direction of u - w there */
} planar_corner;

/* Newton from w, outside both circles or one of them, and th [rad] near which |u - w| - R is largest. False: the two
 * have no corner on that side. Other instants' circles are not looked at. */
bool planar_corner_find(const planar_motion *m, const double w[2], const double th[2], planar_corner *out);

/* dw = what the corner moves by where h_1 and h_2 grow by these at a fixed w: e_i.dw = grows_i, grows = e.du - dR. */
void planar_corner_move(const planar_corner *c, const double grows[2], double dw[2]);

extern const slip_edges planar_edges; /* where the corner's lens closes, or slip all round begins */
