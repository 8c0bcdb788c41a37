/* test_grouped.c - LU by groups: solutions and signs of determinants against the matrix itself and dense LU, and what
 * must be left to dense LU. */
#include "numerics/grouped.h"

#include "numerics/dense.h"
#include "tests/hbm/scenes.h"

enum { FIRST = 4, SIZE = 8, PARTS = 9, MOST = FIRST + SIZE * PARTS + 1 };

static int group_of(int i) { return i < FIRST ? -1 : (i - FIRST) / SIZE; }

static void exchange_rows(int n, double *A, int i, int j)
{
  for (int c = 0; c < n; ++c) {
    const double kept = A[i + n * c];
    A[i + n * c] = A[j + n * c];
    A[j + n * c] = kept;
  }
}

/* Each diagonal entry is twice what its row has beside it; unknowns with local[i] have 1e-14 of the largest outside
 * their group. Then rows of the same kind of a group change places, so that pivots do, too. */
static void make(uint64_t *seed, int n, const bool *local, double *A)
{
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (int j = 0; j < n; ++j) {
      const bool outside = local[i] && group_of(i) != group_of(j) && j < FIRST + SIZE * PARTS;
      sum += fabs(A[i + n * j] = random_signed(seed) * (outside ? 1e-14 : 1));
    }
    A[i + n * i] = random_signed(seed) < 0 ? -2 * sum : 2 * sum;
  }
  for (int trial = 0; trial < 3 * n; ++trial) {
    const int i = (int)(random_unit(seed) * n), j = (int)(random_unit(seed) * n);
    if (i != j && i < n && j < n && group_of(i) == group_of(j) && local[i] == local[j]) exchange_rows(n, A, i, j);
  }
}

/* Twice dominant rows keep what each elimination leaves below twice their sums, so that LU of a block, W, what is left
 * and the two substitutions each err by at most gamma_3n of 2 row sums times max|x|: 5 * 2 * 3n eps. What is dropped is
 * n 1e-14 of max|x|. */
static void solves_as_dense_does(CHECK_STATE)
{
  static double A[MOST * MOST], F[MOST * MOST];
  uint64_t seed = 7;
  int signs[2] = {0};
  for (int trial = 0; trial < 40; ++trial) {
    const int last = trial % 2, n = MOST - 1 + last;
    double x[MOST], b[MOST], most = 0;
    int pivot[MOST];
    bool local[MOST] = {0};
    for (int i = 0; i < n - last; ++i) local[i] = trial == 2 || random_unit(&seed) < 0.3 + 0.1 * (i % 5);
    make(&seed, n, local, A);
    memcpy(F, A, sizeof F);
    for (int i = 0; i < n; ++i) x[i] = b[i] = random_signed(&seed);
    hc_status st = HC_SINGULAR;
    CHECK_MADE(grouped, g, grouped_new(n, FIRST, SIZE, &g));
    assert_true(grouped_factor(g, A, &st));
    assert_int_equal(st, HC_OK);
    grouped_solve(g, A, x);
    assert_int_equal(dense_factor(n, F, pivot), HC_OK);
    assert_int_equal(grouped_sign(g), dense_sign(n, F, pivot));
    ++signs[grouped_sign(g) > 0];
    for (int i = 0; i < n; ++i) most = fmax(most, fabs(x[i]));
    for (int i = 0; i < n; ++i) {
      double r = b[i], sum = 0;
      for (int j = 0; j < n; ++j) r -= A[i + n * j] * x[j], sum += fabs(A[i + n * j]);
      CHECK_LE(fabs(r), (n * 1e-14 + 30 * n * DBL_EPSILON * sum) * most, "trial %d row %d", trial, i);
    }
    grouped_free(g);
  }
  assert_true(signs[0] > 5 && signs[1] > 5);
}

static void leaves_to_dense_what_gains_nothing(CHECK_STATE)
{
  static double A[MOST * MOST];
  uint64_t seed = 8;
  hc_status st;
  bool local[MOST] = {0};
  CHECK_MADE(grouped, g, grouped_new(MOST, FIRST, SIZE, &g));
  make(&seed, MOST, local, A);
  assert_false(grouped_factor(g, A, &st)); /* every row couples the groups */
  for (int i = 0; i < MOST / 2; ++i) local[i] = true;
  make(&seed, MOST, local, A);
  assert_true(grouped_factor(g, A, &st));
  for (int j = MOST / 2 - 2; j < MOST / 2; ++j) /* the only rows of L in their group: A_LL nearly singular, A is not */
    A[MOST / 2 - 1 + MOST * j] = A[MOST / 2 - 2 + MOST * j] * (1 + (j % 2) * 1e-9);
  assert_false(grouped_factor(g, A, &st));
  make(&seed, MOST, local, A);
  A[MOST - 2] = NAN; /* of R, in a column of L */
  assert_true(grouped_factor(g, A, &st));
  assert_int_equal(st, HC_SINGULAR);
  make(&seed, MOST, local, A);
  A[1 + MOST * (MOST - 2)] = NAN; /* of L, outside its group */
  assert_true(!grouped_factor(g, A, &st) || st == HC_SINGULAR);
  grouped_free(g);
}

CHECK_TESTS("numerics.grouped", 20, solves_as_dense_does, leaves_to_dense_what_gains_nothing)
