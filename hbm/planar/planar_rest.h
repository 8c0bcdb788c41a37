/* planar_rest.h - rest position of a slider that sticks all period. It can stay at w if w lies in the friction discs of
 * all instants, h(w, th) = |u(th) - w| - R(th) <= 0: in their convex intersection A. The largest disc in A has the
 * centre c and the radius `room` of
 *
 *     -room = min over c of max over th of h(c, th);
 *
 * where room < 0, A is empty, and the slider slips in every period. Convention of HBM: it rests at the point of that
 * largest disc nearest to w = 0,
 *
 *     w = 0 where |c| <= room, else c (1 - room/|c|).
 *
 * With one tangent, time integration from w = 0 ends there, too. In a plane it approaches A, and ends at some point of
 * its border. The point of A nearest to 0 is no good convention: where A is small it is a corner of the lens of two
 * discs, which moves like the square root of the lens's width, so that branches would fold by that choice alone. A rest
 * that was asked for (contact_evaluator.h: start) is 0 of the motion here, and the slider stays there wherever it can,
 * in all of A.
 *
 * c is determined by the two or three discs with the largest h there (or by one that lies inside all others). Method of
 * exchange: the disc with the largest h at c is added, and the one, two or three discs that determine the minimum for
 * all of these are kept; until no disc exceeds -room by more than rounding. libm only, nothing is allocated. */
#pragma once

#include <stdbool.h>

#include "hbm/contact/contact_evaluator.h"
#include "hbm/planar/planar_motion.h"
#include "numerics/base/status.h"

typedef struct planar_rest {
  bool exists;               /* room >= 0 to rounding: rest is possible */
  bool asked;                /* it stays at w = 0, which was asked for: it does not move with the motion */
  double w[2];               /* [length] rest position; c if none exists */
  double centre[2], room;    /* [length] c; radius of the largest disc in A, negative if A is empty */
  int n;                     /* number of discs that determine c, 1 to 3 */
  planar_point at[3];        /* the motion at their instants */
  double e[3][2], length[3]; /* direction and length [length] of u - c there */
} planar_rest;

/* First angle in (from, to] where a slider at w begins to slip, |u - w| > R by more than rounding; false if there is
 * none. 0 <= from < to <= from + 2 pi, from <= 2 pi; |u - w| <= R at `from` to rounding. grid: of
 * planar_motion_grid. */
bool planar_stick_ends(const planar_motion *m, const planar_point *grid, const double w[2], const planar_point *from,
                       double to, planar_point *root);

/* The rest position of a contact that never opens; asked: w = 0 was asked for. HC_NOT_CONVERGED: more than 100
 * exchanges. */
hc_status planar_rest_find(const planar_motion *m, const planar_point *grid, bool asked, planar_rest *out);

/* Change of the disc at a fixed instant: away = du.e - dR. Used only if one or two discs determine c: across =
 * du.e_perp; one disc only: radius = dR; two discs only: rate = du'.e - dR', derivative of `away` by th. */
typedef struct planar_disc_change {
  double away, across, radius, rate;
} planar_disc_change;

/* dw of the rest position; change[3], of which the first r->n are used. */
void planar_rest_move(const planar_rest *r, const planar_disc_change *change, double dw[2]);

extern const slip_edges planar_edges; /* where slip in every period begins */
