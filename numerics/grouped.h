/* grouped.h - LU of a matrix most of whose rows tie unknowns of one group alone, as in harmonic balance: groups are
 * harmonics, which only the force of a contact that slips or opens couples. With L the unknowns whose rows stay within
 * their group (and what belongs to no group), R the others,
 *     A_LL x_L + A_LR x_R = b_L,  group by group:   x_L = y - W x_R,  y = A_LL^-1 b_L, W = A_LL^-1 A_LR
 *     A_RL x_L + A_RR x_R = b_R                     (A_RR - A_RL W) x_R = b_R - A_RL y
 * and LU costs what the unknowns of R cost. Which rows are L is read from the matrix itself, each time. */
#pragma once

#include "numerics/base/status.h"

typedef struct grouped grouped;

/* For matrices of n unknowns: the first `first` are a group, then `size` each; the last n - first - k size < size
 * belong to none. HC_NO_MEMORY. */
hc_status grouped_new(int n, int first, int size, grouped **out);
void grouped_free(grouped *g);

/* Factors of A[n][n] by columns, which stays the caller's and must be kept for grouped_solve. False: dense LU costs no
 * more, or is safer (A_LL is nearly singular); A is as it was. *status is HC_SINGULAR for a pivot that is 0 or not
 * finite. */
bool grouped_factor(grouped *g, const double *A, hc_status *status);

/* x := A^-1 x, and the sign of det A, of the last grouped_factor that was true. */
void grouped_solve(grouped *g, const double *A, double *x);
int grouped_sign(const grouped *g);
