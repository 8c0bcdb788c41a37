/* dense.h - dense linear algebra by LAPACK, matrices by columns. Where LAPACK is not: numerics/lu.h, for the systems of
 * Newton's method. What LAPACK calls a failure comes back as a status; nothing is printed. */
#ifndef HC_DENSE_H
#define HC_DENSE_H

#include <complex.h>

#include "base/status.h"

/* Is the BLAS that this program was started with OpenBLAS, several times as fast as what is here (product.h, lu.h)? The
 * reference BLAS is slower. */
bool dense_blas_is_fast(void);

/* C = A B; A[m][k], B[k][n], C[m][n] by columns, apart from each other. */
void dense_multiply(int m, int n, int k, const double *A, const double *B, double *C);

/* C = A^T B A, C[m][m] of A[n][m] and B[n][n]; work[2 n m]. */
void dense_congruence(int n, int m, const double *A, const double *B, double *work, double *C);

/* B[columns][rows] = A^T of A[rows][columns]. */
void dense_transpose(int rows, int columns, const double *A, double *B);

/* LU factors of A[n][n] by LAPACK, in its place, pivot[n] counted from 1. HC_SINGULAR as dense_factor_complex. */
hc_status dense_factor(int n, double *A, int *pivot);

/* x := A^-1 x with these. */
void dense_solve(int n, const double *A, const int *pivot, double *x);

/* Is A[n][n] symmetric but for rounding of each entry? */
bool dense_is_symmetric(int n, const double *A);

/* Eigenvalues of K phi = lambda M phi, ascending, and eigenvectors with phi^T M phi = 1 in the columns of phi[n][n]:
 * K[n][n] symmetric, M[n][n] symmetric and positive definite; both are only read, their lower halves. Errors are of
 * the order of rounding relative to the largest eigenvalue. HC_NO_MEMORY; HC_SINGULAR if M is not positive definite to
 * rounding; HC_NOT_CONVERGED. */
hc_status dense_modes(int n, const double *K, const double *M, double *lambda, double *phi);

/* Which of `rows` vectors row_i[n] span what all of them span, and what they leave out: pivot[0..rank-1] are their
 * numbers, a choice that is as independent as it easily can be; basis[n][n] is orthonormal, its first `rank` columns
 * span the same as the vectors, the others what is orthogonal to them all. triangle[rank][rank], upper: the chosen
 * vectors, made as long as 1, are basis triangle. One counts as dependent where no more than `tolerance` of it is new.
 * row[i] is vector i; triangle has room for [rows][rows], at most n wide. HC_NO_MEMORY. */
hc_status dense_span(int n, int rows, const double *const *row, double tolerance, int *rank, int *pivot, double *basis,
                     double *triangle);

/* Eigenvalues lambda[n] and eigenvectors, the columns of V[n][n], of the real A[n][n], which is overwritten.
 * HC_NO_MEMORY, HC_NOT_CONVERGED. */
hc_status dense_eigen(int n, double *A, double complex *lambda, double complex *V);

/* The same with left eigenvectors, w_k^* A = lambda_k w_k^*, in the columns of W[n][n]; all as long as 1. */
hc_status dense_eigen_both(int n, double *A, double complex *lambda, double complex *V, double complex *W);

/* LU factors with partial pivoting of A[n][n], in its place; pivot[n]. HC_SINGULAR for a pivot that is 0 or not
 * finite. */
hc_status dense_factor_complex(int n, double complex *A, int *pivot);

/* B := A^-1 B, or A^-T B where transposed; B[columns][n]. */
void dense_solve_complex(int n, const double complex *A, const int *pivot, bool transposed, int columns,
                         double complex *B);

#endif
