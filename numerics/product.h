/* product.h - products of dense matrices by columns, in C: for LU of more than a few unknowns (lu.h), and wherever the
 * BLAS at hand is the reference one, which it outruns two to five times on one thread. */
#ifndef HC_PRODUCT_H
#define HC_PRODUCT_H

/* C[m][n] -= A[m][k] B[k][n]; an entry (i, j) of each is at [i + ld j]. C overlaps neither of the others. */
void product_subtract(int m, int n, int k, const double *A, int lda, const double *B, int ldb, double *C, int ldc);

#endif
