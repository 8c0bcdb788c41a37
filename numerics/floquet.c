/* floquet.c - see floquet.h. 2 x 2 matrices by the quadratic formula without cancellation, larger ones by GSL's Francis
 * QR, large ones by LAPACK's, whose reduction to Hessenberg form is by blocks. */
#include "numerics/floquet.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>

#include "numerics/dense.h"

enum { LARGE = 64 };

struct floquet { /* a workspace of GSL is for one size of matrix: one for each size 3..LARGE */
  int n;
  gsl_eigen_nonsymm_workspace **work; /* [n + 1] */
  gsl_vector_complex **values;        /* [n + 1] */
  double *matrix; /* [n][n] for all sizes; gsl_matrix_alloc would leak where its second half fails */
};

static hc_status make_sizes(floquet *f)
{
  f->work = calloc((size_t)f->n + 1, sizeof *f->work);
  f->matrix = calloc((size_t)f->n * (size_t)f->n, sizeof *f->matrix);
  f->values = calloc((size_t)f->n + 1, sizeof *f->values);
  if (!f->work || !f->matrix || !f->values) return HC_NO_MEMORY;
  for (int m = 3; m <= f->n && m <= LARGE; ++m) {
    f->work[m] = gsl_eigen_nonsymm_alloc((size_t)m);
    f->values[m] = gsl_vector_complex_alloc((size_t)m);
    if (!f->work[m] || !f->values[m]) return HC_NO_MEMORY;
    gsl_eigen_nonsymm_params(0, 1, f->work[m]); /* balanced: states are lengths, velocities and forces */
  }
  return HC_OK;
}

hc_status floquet_new(int n, floquet **out)
{
  *out = NULL;
  floquet *f = calloc(1, sizeof *f); /* zeroed, so free works half-built */
  if (!f) return HC_NO_MEMORY;
  f->n = n;
  if (make_sizes(f) == HC_OK) {
    *out = f;
    return HC_OK;
  }
  floquet_free(f);
  return HC_NO_MEMORY;
}

void floquet_free(floquet *f)
{
  if (!f) return;
  for (int m = 3; m <= f->n && m <= LARGE; ++m) {
    if (f->work && f->work[m]) gsl_eigen_nonsymm_free(f->work[m]);
    if (f->values && f->values[m]) gsl_vector_complex_free(f->values[m]);
  }
  free(f->work);
  free(f->matrix);
  free(f->values);
  free(f);
}

static void two_by_two(double a, double b, double c, double d, double complex *lambda)
{
  double half = 0.5 * (a + d), det = a * d - b * c;
  double complex root = csqrt(half * half - det);
  lambda[0] = half + (half < 0 ? -root : root);
  lambda[1] = cabs(lambda[0]) > 0 ? det / lambda[0] : 0;
}

static hc_status by_iteration(floquet *f, const double *phi, int row, int column, int m, const int *active,
                              double complex *lambda)
{
  gsl_matrix_view matrix = gsl_matrix_view_array(f->matrix, (size_t)m, (size_t)m);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      gsl_matrix_set(&matrix.matrix, (size_t)i, (size_t)j, phi[active[i] * row + active[j] * column]);
  if (m > LARGE)
    return dense_eigen(m, f->matrix, lambda, NULL, NULL); /* of the transpose, which has the same eigenvalues */
  if (gsl_eigen_nonsymm(&matrix.matrix, f->values[m], f->work[m])) return HC_NOT_CONVERGED;
  for (int i = 0; i < m; ++i) {
    gsl_complex z = gsl_vector_complex_get(f->values[m], (size_t)i);
    lambda[i] = GSL_REAL(z) + I * GSL_IMAG(z);
  }
  return HC_OK;
}

hc_status floquet_multipliers(floquet *f, const double *phi, int row, int column, int m, const int *active,
                              double complex *lambda)
{
  double size = 0;
  if (m > f->n) return HC_BAD_INPUT;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) size += fabs(phi[active[i] * row + active[j] * column]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  if (m > 2) return by_iteration(f, phi, row, column, m, active, lambda);
  const int a = active[0], b = m == 2 ? active[1] : a;
  if (m == 2)
    two_by_two(phi[a * row + a * column], phi[a * row + b * column], phi[b * row + a * column],
               phi[b * row + b * column], lambda);
  else if (m == 1) lambda[0] = phi[a * row + a * column];
  return HC_OK;
}

double complex floquet_largest(int m, const double complex *lambda)
{
  double complex largest = 0;
  for (int i = 0; i < m; ++i)
    if (!(cabs(lambda[i]) <= cabs(largest))) largest = lambda[i]; /* NaN counts as larger */
  return largest;
}
