/* lu.h - LU factors with partial pivoting of a small dense matrix, as a SUNDIALS linear solver for KINSOL. Why our
 * own: the systems here have 3 to 100 unknowns, where the overhead of a call counts most. Factor and solve,
 * microseconds on one thread, same run:
 *     n            3     11    21    41    101    401
 *     here         0.06  0.46  1.3   5.6   69     4450
 *     LAPACK       0.10  0.64  2.1   6.4   38     1290     (OpenBLAS, one thread)
 * Reference LAPACK is slower than this up to n = 41. And without BLAS there are no BLAS threads to pin. */
#ifndef HC_LU_H
#define HC_LU_H

#include <sundials/sundials_linearsolver.h>

/* a[row + n col] becomes L and U, pivot[k] the row swapped with row k. 0 if a pivot is 0 or not finite, else 1. */
int lu_factor(int n, double *a, int *pivot);

/* x := A^-1 x. */
void lu_solve(int n, const double *a, const int *pivot, double *x);

/* Sign of det A. */
int lu_sign(int n, const double *a, const int *pivot);

/* A SUNDIALS solver for n x n dense matrices that factors them in place; NULL when out of memory. Freed by
 * SUNLinSolFree. */
SUNLinearSolver lu_sundials_solver(int n, SUNContext ctx);

/* The pivots of the last matrix it factored. */
const int *lu_sundials_pivots(SUNLinearSolver ls);

#endif
