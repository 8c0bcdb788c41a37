/* test_eigensystem.c - eigenvalues of very different sizes, from matrices that have them by construction. */
#include "numerics/eigensystem.h"

#include <float.h>

#include "numerics/random.h"
#include "tests/check.h"

enum { N = 12 };

/* A = P D P^-1 in long double, D of blocks (a b; -b a), P = 1 + a strictly lower triangle of random numbers below 1/4,
 * whose inverse is found by substitution. */
static void draw(uint64_t *seed, const double complex *lambda, long double *A)
{
  long double P[N][N] = {{0}}, inverse[N][N] = {{0}}, D[N][N] = {{0}}, half[N][N] = {{0}};
  for (int i = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j) P[i][j] = i == j ? 1 : 0.25L * random_signed(seed);
  for (int c = 0; c < N; ++c)
    for (int i = c; i < N; ++i) {
      long double sum = i == c;
      for (int j = c; j < i; ++j) sum -= P[i][j] * inverse[j][c];
      inverse[i][c] = sum;
    }
  for (int k = 0; k < N; k += 2) {
    D[k][k] = D[k + 1][k + 1] = creal(lambda[k]);
    D[k][k + 1] = cimag(lambda[k]);
    D[k + 1][k] = -cimag(lambda[k]);
  }
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j)
      for (int k = 0; k < N; ++k) half[i][j] += P[i][k] * D[k][j];
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      A[j * N + i] = 0;
      for (int k = 0; k < N; ++k) A[j * N + i] += half[i][k] * inverse[k][j];
    }
}

/* Distance of z from the nearest of the eigenvalues found. */
static double nearest(const eigensystem *e, double complex z)
{
  double least = INFINITY;
  for (int k = 0; k < N; ++k) least = fmin(least, cabs(e->lambda[k] - z));
  return least;
}

/* Eigenvalues of the sizes 1 to 1e8: rounding of A, whose entries are as large, in long double leaves 64 6e-20 1e8 =
 * 4e-10 in any of them; LAPACK's errors are some 1e-8. */
static void small_ones_are_as_good_as_large(CHECK_STATE)
{
  uint64_t seed = 2;
  workspace memory = {0};
  CHECK_FILLED(eigensystem, e, eigensystem_make(&e, N, &memory));
  for (int trial = 0; trial < 50; ++trial) {
    double complex lambda[N];
    long double A[N * N];
    for (int k = 0; k < N; k += 2) {
      const double size = pow(10, 8.0 * k / (N - 2));
      lambda[k] = size * (-0.1 - 0.9 * random_unit(&seed) + I * (0.1 + random_unit(&seed)));
    }
    draw(&seed, lambda, A);
    assert_int_equal(eigensystem_find(&e, A), HC_OK);
    for (int k = 0; k < N; k += 2)
      CHECK_LE(nearest(&e, lambda[k]), 4e-10 + 4 * DBL_EPSILON * cabs(lambda[k]), "trial %d: %d", trial, k);
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) {
        double complex one = 0;
        for (int k = 0; k < N; ++k) one += e.W[i * N + k] * e.V[j * N + k];
        CHECK_LE(cabs(one - (i == j)), 1e-13, "trial %d: left and right [%d, %d]", trial, i, j);
      }
  }
  workspace_free(&memory);
}

/* Equal eigenvalues with as many eigenvectors are one space, which any basis spans. */
static void equal_ones(CHECK_STATE)
{
  uint64_t seed = 3;
  workspace memory = {0};
  double complex lambda[N];
  long double A[N * N];
  for (int k = 0; k < N; k += 2) lambda[k] = k < 6 ? -1 + 3 * I : -1e5 - k;
  draw(&seed, lambda, A);
  CHECK_FILLED(eigensystem, e, eigensystem_make(&e, N, &memory));
  assert_int_equal(eigensystem_find(&e, A), HC_OK);
  for (int k = 0; k < N; k += 2) CHECK_LE(nearest(&e, lambda[k]), 1e-10 * cabs(lambda[k]), "%d", k);
  workspace_free(&memory);
}

/* 1 and 1 + 3 d beside 1e8, d = 2^-34 + 2^-54: the first step does not turn vectors of values that are nearer to each
 * other than LAPACK's error of the largest, and its vectors of the two are off by some 2^-20, of the bits of d that A
 * has not in double. They are (1, -2) and (1, 1), but for some roundings of A V in long double, over d. */
static void near_ones_beside_a_large_one(CHECK_STATE)
{
  const long double d = 0x1p-34L + 0x1p-54L;
  const long double A[9] = {1 + 2 * d, 2 * d, 0, d, 1 + d, 0, 0, 0, -1e8};
  workspace memory = {0};
  CHECK_FILLED(eigensystem, e, eigensystem_make(&e, 3, &memory));
  assert_int_equal(eigensystem_find(&e, A), HC_OK);
  for (int k = 0; k < 3; ++k) {
    const double complex *v = e.V + 3 * k, ratio = v[1] / v[0];
    if (creal(e.lambda[k]) < 0) continue;
    const double expected = creal(e.lambda[k]) > 1 + (double)d ? 1 : -2;
    CHECK_NEAR(creal(ratio), expected, (double)(4 * LDBL_EPSILON / d), "vector of 1 + %g", creal(e.lambda[k]) - 1);
  }
  workspace_free(&memory);
}

/* A double eigenvalue with one eigenvector, exactly and nearly. */
static void defective_ones_are_refused(CHECK_STATE)
{
  const double nearly[] = {0, 1e-14, 1e-10};
  workspace memory = {0};
  CHECK_FILLED(eigensystem, e, eigensystem_make(&e, 3, &memory));
  for (size_t i = 0; i < sizeof nearly / sizeof *nearly; ++i) {
    const long double A[9] = {0, nearly[i], 0, 1, 0, 0, 0, 0, -1e6};
    assert_int_equal(eigensystem_find(&e, A), HC_SINGULAR);
  }
  const long double free_of_it[9] = {0, -4, 0, 1, 0, 0, 0, 0, -1e6};
  assert_int_equal(eigensystem_find(&e, free_of_it), HC_OK);
  const long double nonsense[9] = {0, NAN, 0, 1, 0, 0, 0, 0, -1e6};
  assert_int_equal(eigensystem_find(&e, nonsense), HC_NOT_FINITE);
  workspace_free(&memory);
}

CHECK_TESTS("numerics.eigensystem", 600, small_ones_are_as_good_as_large, equal_ones, near_ones_beside_a_large_one,
            defective_ones_are_refused)
