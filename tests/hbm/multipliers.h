/* multipliers.h - Floquet multipliers that a test has found by itself, from the derivative of a period map, and what
 * hbm/solver/stability.h says held against them. */
#pragma once

#include <complex.h>
#include <gsl/gsl_eigen.h>

#include "hbm/hbm.h"
#include "tests/check.h"

/* lambda[n]: eigenvalues of A[n][n], which is overwritten. */
static inline void eigenvalues_of(int n, double *A, double complex *lambda)
{
  gsl_matrix_view view = gsl_matrix_view_array(A, (size_t)n, (size_t)n);
  gsl_vector_complex *values = gsl_vector_complex_alloc((size_t)n);
  gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc((size_t)n);
  assert_int_equal(gsl_eigen_nonsymm(&view.matrix, values, work), 0);
  for (int i = 0; i < n; ++i) {
    const gsl_complex z = gsl_vector_complex_get(values, (size_t)i);
    lambda[i] = GSL_REAL(z) + I * GSL_IMAG(z);
  }
  gsl_eigen_nonsymm_free(work);
  gsl_vector_complex_free(values);
}

/* Largest multiplier, and the products of 1 - and 1 + multiplier, of the solution X: to 1e-7 of it, and of the
 * products' factors, each of which is off by that. */
static inline void check_multipliers(const char *name, hbm_solver *s, double omega, const double *X, int n,
                                     const double complex *lambda)
{
  const double tolerance = 1e-7;
  double complex flip = 1, fold = 1;
  double most = 0, factors = 1;
  for (int i = 0; i < n; ++i) {
    most = fmax(most, cabs(lambda[i]));
    factors *= 1 + cabs(lambda[i]);
    flip *= 1 + lambda[i];
    fold *= 1 - lambda[i];
  }
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, omega, X, &st));
  CHECK_NEAR(st.multiplier, most, tolerance * fmax(1, most), "%s at %g, largest", name, omega);
  CHECK_NEAR(st.flip, creal(flip), n * tolerance * factors, "%s at %g, flip", name, omega);
  CHECK_NEAR(st.fold, creal(fold), n * tolerance * factors, "%s at %g, fold", name, omega);
}
