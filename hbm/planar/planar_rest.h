/* planar_rest.h - where a slider that is always held can rest. It stays at w where w lies in the friction discs of all
 * instants, h(w, th) = |u(th) - w| - R(th) <= 0: in the convex set A that they have in common. Convention of HBM: it
 * rests at the point of A nearest to w = 0,
 *
 *     min |w|^2,    h(w, th) <= 0 for all th,
 *
 * held there by no disc (w = 0), by one, or by two that have a corner there. (Of one tangent A is an interval, and
 * marching from w = 0 comes to the same point. In a plane marching comes to A in the limit only, and to any point of
 * it.) Where A is empty the slider slips for ever.
 *
 * By exchange: of the discs that hold w and the one that excludes it most, those that hold the nearest point that all of
 * them have; until none excludes it by more than rounding, or three have no point in common, which by Helly's theorem
 * is what an empty A comes to. The distance from 0 grows with each exchange. libm only, nothing is allocated. */
#pragma once

#include <stdbool.h>

#include "hbm/contact/contact_evaluator.h"
#include "hbm/planar/planar_motion.h"
#include "numerics/base/status.h"

typedef struct planar_rest {
  bool exists;        /* else w is a point between the discs that have none in common */
  double w[2];        /* [length] */
  int n;              /* discs that hold it, 0 to 2 */
  planar_point at[2]; /* their instants; of an instant among samples its rates are 0 */
  double e[2][2];     /* direction of u - w there */
} planar_rest;

/* The disc that excludes w most, into *out, of all or, unless NULL, of those near that one; h [length] there. */
typedef double planar_farthest(void *self, const double w[2], const planar_point *near, planar_point *out);

/* noise [length]: an h that is not told from 0. HC_NOT_CONVERGED: after 100 exchanges there is no answer. */
hc_status planar_rest_find(planar_farthest *farthest, void *self, double noise, planar_rest *out);

/* How the disc at a fixed instant moves: away from w, du.e - dR; across that, du.e_perp; and the rate of the former by
 * th, du'.e - dR'. */
typedef struct planar_disc_change {
  double away, across, rate;
} planar_disc_change;

/* dw of the place of rest; change[n]. */
void planar_rest_move(const planar_rest *r, const planar_disc_change *change, double dw[2]);

extern const slip_edges planar_edges; /* where slip all round begins */
