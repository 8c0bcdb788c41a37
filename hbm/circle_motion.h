/* circle_motion.h - what moves a contact of two tangents with one limit, as lengths: u(th) in the plane and the radius
 * R(th) = mu N/kt of the circle that holds the slider (model/circle_law.h). While it is in contact R is linear in v, so
 * it is a trigonometric polynomial like u. libm only, nothing is allocated. */
#ifndef HC_HBM_CIRCLE_MOTION_H
#define HC_HBM_CIRCLE_MOTION_H

#include "model/contact_law.h"
#include "numerics/collocation.h"
#include "numerics/series_grid.h"

typedef struct circle_motion {
  int n_harm;
  const double *u[2]; /* [2 n_harm + 1] [length] */
  const double *v;    /* the same; NULL where N is constant */
  double per_v, rest; /* R = per_v v + rest */
  double of_u[4];     /* bounds of |u|, |u'|, |u''|, |u'''| */
  double of_R[4];     /* the same of R */
} circle_motion;

/* At one angle, derivatives by th. */
typedef struct circle_point {
  double th, u[2], du[2], ddu[2]; /* [rad], [length] */
  double R, dR, ddR;              /* [length] */
} circle_point;

/* The motion under a law with kt > 0. Series are not copied. */
circle_motion circle_motion_make(const contact *law, int n_harm, const double *u1, const double *u2, const double *v);

circle_point circle_motion_at(const circle_motion *m, double th);

/* Rates at the points of a panel, [rad] [length]. */
typedef struct circle_rates {
  double th[COLLOCATION_POINTS], du[2][COLLOCATION_POINTS], R[COLLOCATION_POINTS], dR[COLLOCATION_POINTS];
} circle_rates;

/* On [from, to], to <= from + 3; th[last] is `to` itself. */
void circle_motion_rates(const circle_motion *m, const collocation *c, double from, double to, circle_rates *r);

/* On the angles 2 pi i/SERIES_GRID of two periods: one that starts anywhere in the first lies in them. table: of
 * series_grid_table_fill. */
enum { CIRCLE_GRID = 2 * SERIES_GRID + 1 };
void circle_motion_grid(const circle_motion *m, const double *table, circle_point grid[CIRCLE_GRID]);

/* [length] What u and R are known to, from the rounding of their sums. */
double circle_motion_noise(const circle_motion *m);

#endif
