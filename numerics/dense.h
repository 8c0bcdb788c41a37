/* dense.h - dense linear algebra by BLAS and LAPACK, matrices by columns. Their failures are returned as a status;
 * nothing is printed. The choice of BLAS affects rounding and time only: OpenBLAS, kept to one thread, takes a fifth of
 * the reference BLAS's time from about 100 unknowns on. */
#pragma once

#include <complex.h>

#include "numerics/base/status.h"

/* Ends the threads that OpenBLAS starts when it is loaded: idle, each spins for some 30 ms before it sleeps, as long as
 * `compare` takes for a case of the paper. For a program that is OpenBLAS's only user, before its first call; OpenBLAS
 * starts them again if it is told to use several. */
void dense_end_idle_threads(void);

/* C = A B; A[m][k], B[k][n], C[m][n] by columns, not overlapping. */
void dense_multiply(int m, int n, int k, const double *A, const double *B, double *C);

/* C := alpha A B + beta C of parts of matrices: an entry (i, j) of each is at [i + ld j]; dgemm. C is not read where
 * beta is 0. */
void dense_add_product(int m, int n, int k, double alpha, const double *A, int lda, const double *B, int ldb,
                       double beta, double *C, int ldc);

/* y := alpha A x + beta y; A[m][n] by columns. y is not read where beta is 0. */
void dense_times_vector(int m, int n, double alpha, const double *A, const double *x, double beta, double *y);

/* y[rows] := A x; A[rows][n] by rows. */
void dense_rows_times_vector(int n, int rows, const double *A, const double *x, double *y);

/* C = A^T B A, C[m][m] of A[n][m] and B[n][n]; work[2 n m]. */
void dense_congruence(int n, int m, const double *A, const double *B, double *work, double *C);

/* B[columns][rows] = A^T of A[rows][columns]. */
void dense_transpose(int rows, int columns, const double *A, double *B);

/* Most unknowns of a real system that is solved by own code, since a call of LAPACK costs more than the work. Factors,
 * microseconds on one thread, OpenBLAS 0.3.21 and reference LAPACK 3.11, the least of 15, same run:
 *     n               3     5     8     11    16    21    24    32    42    64    96    201
 *     here            0.02  0.04  0.10  0.17  0.33  0.65  0.92  1.9   3.9   12.6  40    345
 *     OpenBLAS        0.05  0.10  0.24  0.43  0.87  1.6   2.2   4.0   5.5   13.4  27    157
 *     reference       0.08  0.17  0.37  0.64  1.3   2.4   3.1   6.0   11    33    100   782 */
enum { DENSE_SMALL = 64 };

/* LU factors with partial pivoting of A[n][n], in its place; pivot[k], counted from 1, is the row exchanged with row k.
 * HC_SINGULAR for a pivot that is 0 or not finite. */
hc_status dense_factor(int n, double *A, int *pivot);

/* X := A^-1 X with these factors; X[columns][n]. */
void dense_solve(int n, const double *A, const int *pivot, int columns, double *X);

/* Sign of det A from its factors. */
int dense_sign(int n, const double *A, const int *pivot);

/* True if A[n][n] is symmetric up to rounding of each entry. */
bool dense_is_symmetric(int n, const double *A);

/* True if A[n][n], with leading dimension ld, is diagonal up to rounding of its largest entry. */
bool dense_is_diagonal(int n, const double *A, int ld);

/* Eigenvalues of K phi = lambda M phi, ascending, and eigenvectors with phi^T M phi = 1 in the columns of phi[n][n]:
 * K[n][n] symmetric, M[n][n] symmetric and positive definite, lower halves only. Errors are of the order of rounding of
 * the largest eigenvalue. HC_NO_MEMORY; HC_SINGULAR if M is not positive definite to rounding; HC_NOT_CONVERGED. */
hc_status dense_modes(int n, const double *K, const double *M, double *lambda, double *phi);

/* Selects independent vectors among `rows` vectors row_i[n] by QR with column pivoting: pivot[0..rank-1] are the
 * indices of a subset that spans the same space; basis[n][n] is orthonormal, its first `rank` columns span that space,
 * the others its complement. triangle[rank][rank], upper: the chosen vectors, normalised, are basis triangle. A
 * normalised vector counts as dependent if its new component is not above `tolerance`. row[i] is vector i; the caller's
 * triangle holds [m][m], m = min(rows, n). HC_NO_MEMORY. */
hc_status dense_span(int n, int rows, const double *const *row, double tolerance, int *rank, int *pivot, double *basis,
                     double *triangle);

/* Eigenvalues lambda[n] of the real A[n][n], which is overwritten, eigenvectors in the columns of V[n][n], and left
 * ones, w_k^* A = lambda_k w_k^*, in those of W[n][n]; V and W may be NULL; all have length 1. HC_NO_MEMORY,
 * HC_NOT_CONVERGED. */
hc_status dense_eigen(int n, double *A, double complex *lambda, double complex *V, double complex *W);

/* LU factors with partial pivoting of A[n][n], in its place; pivot[n]. HC_SINGULAR for a pivot that is 0 or not
 * finite. */
hc_status dense_factor_complex(int n, double complex *A, int *pivot);

/* B := A^-1 B, or A^-T B if transposed; B[columns][n]. */
void dense_solve_complex(int n, const double complex *A, const int *pivot, bool transposed, int columns,
                         double complex *B);

/* A := A^-1; pivot[n], work[DENSE_INVERT_WORK n]. HC_SINGULAR as dense_factor_complex. */
enum { DENSE_INVERT_WORK = 32 }; /* columns that zgetri takes at a time */
hc_status dense_invert_complex(int n, double complex *A, int *pivot, double complex *work);
