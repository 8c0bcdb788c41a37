/* grouped.h - LU of a matrix most of whose rows couple unknowns of one group only, as in harmonic balance: groups are
 * harmonics, coupled only by contacts that slip or open. With L the unknowns whose rows have entries only within their
 * group (and in unknowns of no group), R the others,
 *     A_LL x_L + A_LR x_R = b_L,  group by group:   x_L = y - W x_R,  y = A_LL^-1 b_L, W = A_LL^-1 A_LR
 *     A_RL x_L + A_RR x_R = b_R                     (A_RR - A_RL W) x_R = b_R - A_RL y
 * so that the work is that of an LU for the unknowns of R. L is determined from the matrix at each factorisation. */
#pragma once

#include "numerics/base/status.h"

typedef struct grouped grouped;

/* For matrices of n unknowns: the first `first` form a group, then `size` each; the last (n - first) mod size belong to
 * none. HC_NO_MEMORY. */
hc_status grouped_new(int n, int first, int size, grouped **out);
void grouped_free(grouped *g);

/* Factors A[n][n], by columns, which is unchanged and must be kept for grouped_solve. False: dense LU is no more work,
 * or safer (A_LL nearly singular), and must be used. *status is HC_SINGULAR for a pivot that is 0 or not finite. */
bool grouped_factor(grouped *g, const double *A, hc_status *status);

/* x := A^-1 x; sign of det A. Both after a grouped_factor that returned true. */
void grouped_solve(grouped *g, const double *A, double *x);
int grouped_sign(const grouped *g);
