/* test_inverse.c - the inverse of complex matrices: what it leaves of A X - 1, and what must be refused. */
#include <complex.h>
#include <float.h>

#include "numerics/inverse.h"
#include "tests/hbm/scenes.h"

enum { MOST = 70 };

static double size(int n, const double complex *A)
{
  double most = 0;
  for (int i = 0; i < n * n; ++i) most = fmax(most, cabs(A[i]));
  return most;
}

/* Each column of X solves (A + E) x = e with |E| of a few n u |A| growth: |A X - 1| <= c n u n |A| |X| where the
 * largest entries stand for norms. c = 10 allows for the growth. One panel, several, and a last one that is not
 * full. */
static void inverts_random_matrices(void **state)
{
  (void)state;
  static double complex A[MOST * MOST], X[MOST * MOST];
  uint64_t seed = 3;
  int pivot[MOST];
  double *work = calloc(inverse_room(MOST), sizeof *work), worst = 0;
  for (int n = 1; n <= MOST; n += n < 36 ? 1 : 17) {
    for (int i = 0; i < n * n; ++i) A[i] = random_signed(&seed) + I * random_signed(&seed);
    assert_int_equal(inverse_complex(n, A, pivot, work, X), HC_OK);
    const double bound = 10 * n * DBL_EPSILON * n * size(n, A) * size(n, X);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        double complex sum = i == j ? -1 : 0;
        for (int k = 0; k < n; ++k) sum += A[i + n * k] * X[k + n * j];
        CHECK_LE(cabs(sum), bound, "n=%d entry %d, %d", n, i, j);
        worst = fmax(worst, cabs(sum) / bound);
      }
  }
  assert_true(worst > 1e-3);
  free(work);
}

/* i at (k, to(k)): the inverse has -i at (to(k), k), and nothing rounds. Pivots are never on the diagonal. */
static void inverts_a_permutation_exactly(void **state)
{
  (void)state;
  enum { N = 37 };
  static double complex A[N * N], X[N * N];
  int pivot[N];
  double *work = calloc(inverse_room(N), sizeof *work);
  for (int k = 0; k < N; ++k) A[k + N * ((k + 5) % N)] = I;
  assert_int_equal(inverse_complex(N, A, pivot, work, X), HC_OK);
  for (int j = 0; j < N; ++j)
    for (int i = 0; i < N; ++i) assert_true(X[i + N * j] == (i == (j + 5) % N ? -I : 0));
  free(work);
}

static void singular_matrices_are_refused(void **state)
{
  (void)state;
  enum { N = 20 };
  static double complex A[N * N], X[N * N];
  int pivot[N];
  double *work = calloc(inverse_room(N), sizeof *work);
  for (int k = 0; k < N - 1; ++k) A[k + N * k] = 1;
  assert_int_equal(inverse_complex(N, A, pivot, work, X), HC_SINGULAR);
  A[N * N - 1] = NAN;
  assert_int_equal(inverse_complex(N, A, pivot, work, X), HC_SINGULAR);
  A[N * N - 1] = 1;
  assert_int_equal(inverse_complex(N, A, pivot, work, X), HC_OK);
  free(work);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(inverts_random_matrices),
    cmocka_unit_test(inverts_a_permutation_exactly),
    cmocka_unit_test(singular_matrices_are_refused),
};

CHECK_MAIN("numerics.inverse", tests, 60)
