/* planar_motion.h - the motion of a contact of two tangents with one limit, as lengths: u(th) in the plane and the
 * radius R(th) = mu N/kt of the circle about u in which the slider stays (planar_slip.h). In contact R is linear in v,
 * so it is a trigonometric polynomial like u. libm only, nothing is allocated. */
#pragma once

#include "model/contact_law.h"
#include "numerics/collocation.h"
#include "numerics/series.h"

typedef struct planar_motion {
  int n_harm;
  const double *u[2]; /* [2 n_harm + 1] [length] */
  const double *v;    /* [2 n_harm + 1] [length]; NULL if N is constant */
  double per_v, rest; /* [1], [length] R = per_v v + rest */
  double of_u[4];     /* [length] bounds of |u|, |u'|, |u''|, |u'''| */
  double of_R[4];     /* [length] the same for R */
} planar_motion;

/* The motion at one angle, with derivatives by th. */
typedef struct planar_point {
  double th, u[2], du[2], ddu[2]; /* [rad], [length] */
  double R, dR, ddR;              /* [length] */
} planar_point;

/* The motion under a law with kt > 0. Series are not copied. */
planar_motion planar_motion_make(const contact *law, int n_harm, const double *u1, const double *u2, const double *v);

planar_point planar_motion_at(const planar_motion *m, double th);

/* Angles [rad], rates and R [length] at the points of a panel. */
typedef struct planar_rates {
  double th[COLLOCATION_POINTS], du[2][COLLOCATION_POINTS], R[COLLOCATION_POINTS], dR[COLLOCATION_POINTS];
} planar_rates;

/* On [from, to], to <= from + 3; th[last] is `to` itself. */
void planar_motion_rates(const planar_motion *m, const collocation *c, double from, double to, planar_rates *r);

/* The motion at the angles 2 pi i/SERIES_GRID of two periods, so that a period may start anywhere in the first. table:
 * of series_grid_table_fill. */
enum { PLANAR_GRID = 2 * SERIES_GRID + 1 };
void planar_motion_grid(const planar_motion *m, const double *table, planar_point grid[PLANAR_GRID]);

/* [length] Rounding error of u and R. */
double planar_motion_noise(const planar_motion *m);
