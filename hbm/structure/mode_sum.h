/* mode_sum.h - a structure's compliance between a few directions, as the sum over its modes, for s = i omega:
 *
 *     G_ab(s) = sum_i  x_a(i) x_b(i) / (k_i + (c_i + d) s + s^2)                           modes that damping leaves
 *     G_ab(s) = sum_i  l_a(i) r_b(i) / (s - lambda_i) + the same conjugate where Im lambda_i > 0      any damping
 *
 * Modes far above s come in by the power series of their sum in s: its coefficients are real, and made once for a range
 * of s. A value then costs what the few modes near s cost, whatever n is. d = 0 in the second form. Frequencies in
 * [rad/time]; an entry is a direction's motion in a mode of unit mass. */
#ifndef HC_HBM_MODE_SUM_H
#define HC_HBM_MODE_SUM_H

#include <complex.h>
#include <stdbool.h>

#include "base/status.h"

typedef struct mode_sum mode_sum;

/* Real modes: k[n] and c[n], both only read here, x[rows][n]; for a < dim and all b < rows. HC_NO_MEMORY. */
hc_status mode_sum_of_modes(int n, const double *k, const double *c, int dim, int rows, const double *x,
                            mode_sum **out);

/* Poles: lambda[n], one of each pair; left[rows][n], right[rows][n]. */
hc_status mode_sum_of_poles(int n, const double complex *lambda, int dim, int rows, const double complex *left,
                            const double complex *right, mode_sum **out);
void mode_sum_free(mode_sum *m); /* NULL is allowed */

/* Is it a sum over real modes, so that d may be other than 0? */
bool mode_sum_takes_damping(const mode_sum *m);

/* G[from <= b < to][dim], if not NULL, at s = i w. by_s, if not NULL, gets dG/ds, and by_d dG/dd (of real modes). The
 * largest w to be expected soon is `reach`: the power series is for up to there. HC_NOT_FINITE: an undamped mode
 * resonates at w. */
hc_status mode_sum_at(mode_sum *m, double w, double reach, double d, int from, int to, double complex *G,
                      double complex *by_s, double complex *by_d);

#endif
