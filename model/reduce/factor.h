/* factor.h - a symmetric positive definite sparse matrix, factored by CHOLMOD: its supernodal L L^T, rows ordered for
 * few entries. Memory is that of the factor's entries. */
#pragma once

#include "numerics/sparse.h"

typedef struct factor factor;

/* held[i] = true for each row without an entry but 0 in K and M: no part of the structure. */
void factor_hold_empty(const sparse *K, const sparse *M, bool *held);

/* Factors of K + shift M with the rows and columns that are held[n] replaced by those of the identity. HC_SINGULAR if
 * that is not positive definite beyond rounding; HC_NO_MEMORY: *out is NULL. */
hc_status factor_new(const sparse *K, const sparse *M, double shift, const bool *held, factor **out);
void factor_free(factor *f);

/* X := A^-1 X, rows that are held set to 0; X[columns][n]. HC_NO_MEMORY. */
hc_status factor_solve(factor *f, int columns, double *X);

/* For the structure K and M with these rows held: *shift = 0 where K holds the rest alone; else, where it
 * floats, a shift of the order of `shift_floating` with which K + shift M can be factored. HC_SINGULAR: no mass. */
hc_status factor_shifted(const sparse *K, const sparse *M, const bool *held, double shift_floating, double *shift,
                         factor **out);
