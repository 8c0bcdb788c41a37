/* lu.h - LU factors with partial pivoting of a dense matrix. Why our own: most systems here have 3 to 100 unknowns,
 * where the overhead of a call counts most, and the reference LAPACK is slower at every size. Factors, microseconds on
 * one thread, the least of several, same run:
 *     n                    11    41    101   201    401    1000     1600
 *     here                 1.0   7.8   91    630    4500   72000    350000
 *     LAPACK, reference    2.0   17    184   1300   9800   167000   844000
 *     LAPACK, OpenBLAS     -     10    91    430    2500   25000    80000
 * newton_linear.c says when which is taken. */
#ifndef HC_LU_H
#define HC_LU_H

/* a[row + n col] becomes L and U, pivot[k] the row swapped with row k. 0 if a pivot is 0 or not finite, else 1. */
int lu_factor(int n, double *a, int *pivot);

/* x := A^-1 x. */
void lu_solve(int n, const double *a, const int *pivot, double *x);

/* Sign of det A. */
int lu_sign(int n, const double *a, const int *pivot);

#endif
