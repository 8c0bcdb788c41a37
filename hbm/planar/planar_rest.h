/* planar_rest.h - where a slider that is always held can rest. It stays at w where w lies in the friction discs of all
 * instants, h(w, th) = |u(th) - w| - R(th) <= 0: in the convex set A that they have in common. The largest disc in A
 * has the centre c and the radius `room` of
 *
 *     -room = min over c of max over th of h(c, th);
 *
 * where room < 0, A is empty, and the slider slips for ever. Convention of HBM: it rests at the point of that largest
 * disc nearest to w = 0,
 *
 *     w = 0 where |c| <= room, else c (1 - room/|c|).
 *
 * With one tangent, marching from w = 0 ends there, too. In a plane marching approaches A without reaching it, and ends
 * at any point of its border. The point of A nearest to 0 would be a corner of the lens of two discs where A is small,
 * which moves like the root of the lens's width: branches would fold by that choice alone.
 *
 * c is held by two discs or three (one, where the others have it inside). By exchange: of these and the disc that c is
 * farthest out of, those that hold the best point for all of them; until none is farther out than by rounding. libm
 * only, nothing is allocated. */
#pragma once

#include <stdbool.h>

#include "hbm/contact/contact_evaluator.h"
#include "hbm/planar/planar_motion.h"
#include "numerics/base/status.h"

typedef struct planar_rest {
  bool exists;               /* room >= 0, to rounding */
  double w[2];               /* [length] where it rests; else c */
  double centre[2], room;    /* [length] c */
  int n;                     /* discs that hold c, 1 to 3 */
  planar_point at[3];        /* their instants */
  double e[3][2], length[3]; /* direction and length of u - c there */
} planar_rest;

/* Where a slider at w begins to slip: the first angle in (from, to] where |u - w| exceeds R, 0 <= from < to <= from +
 * 2 pi and from <= 2 pi; false if there is none. It does not at `from`, to rounding; excursions by no more than
 * rounding do not count. grid: of planar_motion_grid. */
bool planar_stick_ends(const planar_motion *m, const planar_point *grid, const double w[2], const planar_point *from,
                       double to, planar_point *root);

/* In contact all the time. HC_NOT_CONVERGED: after 100 exchanges there is no answer. */
hc_status planar_rest_find(const planar_motion *m, const planar_point *grid, planar_rest *out);

/* How the disc at a fixed instant moves: away from c, du.e - dR; where one or two hold c, across that, too, du.e_perp;
 * and dR of the one, of the two the rate of `away` by th, du'.e - dR'. */
typedef struct planar_disc_change {
  double away, across, radius, rate;
} planar_disc_change;

/* dw of the place of rest; change[3], of which n are looked at. */
void planar_rest_move(const planar_rest *r, const planar_disc_change *change, double dw[2]);

extern const slip_edges planar_edges; /* where slip all round begins */
