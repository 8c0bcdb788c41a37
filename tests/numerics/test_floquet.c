/* test_floquet.c - multipliers of a matrix whose states are of different units. */
#include "numerics/floquet.h"

#include <float.h>

#include "numerics/base/constants.h"
#include "tests/check.h"

/* phi = D P diag(lambda) P^-1 D^-1, P and its inverse of small integers, D of powers of two as lengths, velocities and
 * forces differ by: exact but for the last place. Of P diag(lambda) P^-1 itself, entries up to 20, the eigenvalues are
 * good to rounding times the product of the norms of P and P^-1, below 1e4; D must make no difference. */
static void units_of_states_make_no_difference(CHECK_STATE)
{
  enum { N = 4 };
  static const double lambda[N] = {0.9375, 0.5, -0.25, 0.125};
  static const double P[N][N] = {{1, 0, 0, 0}, {2, 1, 0, 0}, {-1, 3, 1, 0}, {1, -1, 2, 1}};
  static const double inverse[N][N] = {{1, 0, 0, 0}, {-2, 1, 0, 0}, {7, -3, 1, 0}, {-17, 7, -2, 1}};
  static const int unit[N] = {0, 17, 27, -10}, active[N] = {0, 1, 2, 3};
  double phi[N * N];
  double complex found[N];
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      double sum = 0;
      for (int k = 0; k < N; ++k) sum += P[i][k] * lambda[k] * inverse[k][j];
      phi[i * N + j] = ldexp(sum, unit[i] - unit[j]);
    }
  CHECK_MADE(floquet, f, floquet_new(N, &f));
  assert_int_equal(floquet_multipliers(f, phi, N, 1, N, active, found), HC_OK);
  for (int k = 0; k < N; ++k) {
    double nearest = INFINITY;
    for (int i = 0; i < N; ++i) nearest = fmin(nearest, cabs(found[i] - lambda[k]));
    CHECK_LE(nearest, 1e4 * DBL_EPSILON, "multiplier %g", lambda[k]);
  }
  floquet_free(f);
}

/* Rotations by k degrees that grow or decay, k = 1, 2, ..., in pairs of rows; GSL up to 64 rows, LAPACK beyond. */
static void every_size_has_its_method(CHECK_STATE)
{
  enum { MOST = 66 };
  static double phi[MOST * MOST];
  double complex found[MOST];
  int active[MOST];
  CHECK_MADE(floquet, f, floquet_new(MOST, &f));
  for (int m = 62; m <= MOST; m += 2) {
    memset(phi, 0, sizeof phi);
    for (int i = 0; i < m; ++i) active[i] = i;
    for (int i = 0; i < m; i += 2) {
      const double complex z = (0.2 + 0.01 * i) * cexp(I * (i + 2) * TWO_PI / 720);
      phi[i * MOST + i] = phi[(i + 1) * MOST + i + 1] = creal(z);
      phi[i * MOST + i + 1] = cimag(z);
      phi[(i + 1) * MOST + i] = -cimag(z);
    }
    assert_int_equal(floquet_multipliers(f, phi, MOST, 1, m, active, found), HC_OK);
    CHECK_NEAR(cabs(floquet_largest(m, found)), 0.2 + 0.01 * (m - 2), 1e-14, "%d rows", m);
  }
  floquet_free(f);
}

CHECK_TESTS("numerics.floquet", 60, units_of_states_make_no_difference, every_size_has_its_method)
