/* eigensystem.h - eigenvalues, right and left eigenvectors of a real matrix, with small eigenvalues as accurate as
 * large ones. LAPACK's errors are rounding of the largest eigenvalue, the stiffest mode's; its result starts a Newton
 * iteration for all eigenvectors at once, with residuals in long double:
 *     F = V^-1 (A V - V D),   D += diag F,   V += V E,   E_ij = F_ij/(D_j - D_i)
 * It converges quadratically if the eigenvalues are distinct. Source: Ogita and Aishima, Japan J. Indust. Appl. Math.
 * 35 (2018) 1007, for symmetric matrices; here V^-1 replaces V^T. */
#pragma once

#include <complex.h>

#include "numerics/base/status.h"
#include "numerics/base/workspace.h"

typedef struct wide_complex {
  long double re, im;
} wide_complex;

typedef struct eigensystem {
  int n;
  double complex *lambda; /* [n] conjugate pairs are neighbours */
  double complex *V;      /* [n][n] right eigenvectors of length 1, by columns */
  double complex *W;      /* [n][n] W + k n is row k of V^-1 */
  wide_complex *values;   /* [n] work, as all that follows */
  wide_complex *vectors, *residual;
  double complex *factors, *correction;
  double *narrow;
  int *pivot;
} eigensystem;

hc_status eigensystem_make(eigensystem *e, int n, workspace *memory); /* arrays are memory's; HC_NO_MEMORY */

/* The eigensystem of A[n][n], by columns. HC_SINGULAR: eigenvectors nearly dependent (a double eigenvalue with one
 * eigenvector, a free body), so that more than four digits would be lost, or Newton does not converge; HC_NOT_FINITE: A
 * is not finite; HC_NOT_CONVERGED: LAPACK failed; HC_NO_MEMORY. */
hc_status eigensystem_find(eigensystem *e, const long double *A);
