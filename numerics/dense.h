/* dense.h - dense linear algebra by LAPACK, matrices by columns. Where LAPACK is not: numerics/lu.h, for the small
 * systems of Newton's method. What LAPACK calls a failure comes back as a status; nothing is printed. */
#ifndef HC_DENSE_H
#define HC_DENSE_H

#include <complex.h>

#include "base/status.h"

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

/* LU factors with partial pivoting of A[n][n], in its place; pivot[n]. HC_SINGULAR for a pivot that is 0 or not
 * finite. */
hc_status dense_factor_complex(int n, double complex *A, int *pivot);

/* B := A^-1 B, or A^-T B where transposed; B[columns][n]. */
void dense_solve_complex(int n, const double complex *A, const int *pivot, bool transposed, int columns,
                         double complex *B);

#endif
