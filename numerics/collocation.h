/* collocation.h - collocation at n Radau points of one panel [0, 1], the right end being the last of them. A polynomial
 * of degree n = COLLOCATION_POINTS whose slope is k_j at the points x_j, from y(0):
 *
 *     y(x_i) = y(0) + sum_j a[i][j] k_j          integral of f over [0, 1] = sum_j a[last][j] f(x_j), degree <= 2 n - 2
 *
 * As an implicit Runge-Kutta method (Radau IIA: Hairer and Wanner, Solving Ordinary Differential Equations II, section
 * IV.5) it has order 2 n - 1 at the panels' ends, and stiff components decay. libm only, nothing is allocated. */
#pragma once

enum { COLLOCATION_POINTS = 10 };

typedef struct collocation {
  double x[COLLOCATION_POINTS];                            /* in (0, 1], ascending, the last one 1 */
  double a[COLLOCATION_POINTS][COLLOCATION_POINTS];        /* as above; last row: weights */
  double by_point[COLLOCATION_POINTS][COLLOCATION_POINTS]; /* a transposed: [j][i] */
  double mode[COLLOCATION_POINTS][COLLOCATION_POINTS];     /* coefficient n of Legendre = sum_j mode[n][j] k_j */
} collocation;

void collocation_fill(collocation *c);

/* The rule of fewer points, 2 .. COLLOCATION_POINTS: x[points], a[points][points] by rows. */
void collocation_radau(int points, double *x, double *a);

/* slopes[i]: slope at start + part x_i, in the panel [0, 1] or beyond it, of the polynomial with slopes k at the
 * points. */
void collocation_slopes(const collocation *c, const double k[COLLOCATION_POINTS], double start, double part,
                        double slopes[COLLOCATION_POINTS]);

/* y(x) - y(0) for any x in [0, 1], from the slopes k at the points, of a panel of width 1. */
double collocation_rise(const collocation *c, const double k[COLLOCATION_POINTS], double x);
