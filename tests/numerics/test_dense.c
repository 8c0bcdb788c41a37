/* test_dense.c - LU factors: residuals against the bound of rounding theory, signs of determinants, and what must be
 * refused. */

#include <float.h>

#include "numerics/dense.h"
#include "numerics/norm.h"
#include "numerics/random.h"
#include "tests/hbm/scenes.h"

enum { MAX_N = 140, SMALL = 60 };

static void random_matrix(uint64_t *seed, int n, double *a)
{
  for (int i = 0; i < n * n; ++i) a[i] = random_signed(seed);
}

/* The computed x solves (A + E) x = b with |E| <= gamma_3n |L||U| (Higham, Accuracy and Stability, theorem 9.4),
 * gamma_m = m u/(1 - m u), u = eps/2. Multiplying by the pivot's reciprocal rounds each entry of L once more and the
 * reciprocal itself: 3n + 2. With partial pivoting |L| <= 1, so the right-hand side is at most n growth eps max|A|
 * |x|_1 times 3/2: the second check makes sure that the bound is not vacuous; the growth of random matrices is about
 * n^(2/3), never n. b - A x is formed in long double, 2^-11 of what is tested. */
static void solves_within_the_bound_of_rounding_theory(CHECK_STATE)
{
  static double a[MAX_N * MAX_N], f[MAX_N * MAX_N], b[MAX_N], x[MAX_N], bound[MAX_N];
  int pivot[MAX_N];
  uint64_t seed = 1;
  double worst = 0;
  for (int n = 1; n <= MAX_N; n += n < SMALL ? 1 : n < 70 ? 3 : 7) /* by LAPACK above DENSE_SMALL */
    for (int trial = 0; trial < (n < SMALL ? 20 : 2); ++trial) {
      double biggest = 0, growth = 0;
      random_matrix(&seed, n, a);
      for (int i = 0; i < n; ++i) x[i] = b[i] = random_signed(&seed);
      memcpy(f, a, sizeof f);
      assert_int_equal(dense_factor(n, f, pivot), HC_OK);
      dense_solve(n, f, pivot, 1, x);
      /* Row i of P^-1 L U is row i of A: the rows of |L||U| in the order of A, times |x|, into bound[n]. */
      for (int i = 0; i < n; ++i) {
        bound[i] = 0;
        for (int j = 0; j < n; ++j) {
          double sum = 0;
          for (int k = 0; k <= (i < j ? i : j); ++k) sum += (k == i ? 1 : fabs(f[i + n * k])) * fabs(f[k + n * j]);
          bound[i] += sum * fabs(x[j]);
        }
      }
      for (int k = n - 1; k >= 0; --k) {
        double swap = bound[k];
        bound[k] = bound[pivot[k] - 1];
        bound[pivot[k] - 1] = swap;
      }
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          biggest = fmax(biggest, fabs(a[i + n * j]));
          if (i <= j) growth = fmax(growth, fabs(f[i + n * j]));
          else CHECK_LE(fabs(f[i + n * j]), 1 + DBL_EPSILON, "n=%d: a multiplier, so the pivot was not the largest", n);
        }
      CHECK_LE(growth, n * biggest, "n=%d: growth", n);
      double gamma = (3 * n + 2) * 0.5 * DBL_EPSILON / (1 - (3 * n + 2) * 0.5 * DBL_EPSILON);
      for (int i = 0; i < n; ++i) {
        long double r = b[i];
        for (int j = 0; j < n; ++j) r -= (long double)a[i + n * j] * x[j];
        CHECK_LE(fabs((double)r), gamma * bound[i], "n=%d trial=%d row=%d", n, trial, i);
        worst = fmax(worst, fabs((double)r) / (gamma * bound[i]));
      }
    }
  assert_true(worst > 1e-3); /* the bound is within reach: a residual a thousand times larger would be seen */
}

/* det of a permutation with the signs d_i is (-1)^(n - cycles) prod d_i; nothing rounds. */
static void the_sign_of_signed_permutations(CHECK_STATE)
{
  static double a[MAX_N * MAX_N];
  int pivot[MAX_N], to[MAX_N], seen_plus = 0, seen_minus = 0;
  uint64_t seed = 7;
  for (int trial = 0; trial < 600; ++trial) {
    int n = 1 + trial % MAX_N, sign = 1;
    bool seen[MAX_N] = {false};
    for (int i = 0; i < n; ++i) to[i] = i;
    for (int i = n - 1; i > 0; --i) {
      int j = (int)(0.5 * (1 + random_signed(&seed)) * (i + 1)), t = to[i];
      to[i] = to[j];
      to[j] = t;
    }
    memset(a, 0, sizeof a);
    for (int i = 0; i < n; ++i) {
      double d = random_signed(&seed);
      if (d < 0) sign = -sign;
      a[to[i] + n * i] = d;
    }
    for (int i = 0; i < n; ++i)
      for (int j = i, length = 0; !seen[j]; j = to[j], ++length) {
        seen[j] = true;
        if (length) sign = -sign;
      }
    assert_int_equal(dense_factor(n, a, pivot), HC_OK);
    assert_int_equal(dense_sign(n, a, pivot), sign);
    ++*(sign > 0 ? &seen_plus : &seen_minus);
  }
  assert_true(seen_plus > 100 && seen_minus > 100);
}

/* A zero row or column, two equal rows of small integers (their difference is exactly 0 where nothing rounds:
 * multiplier 1), and a NaN or infinity anywhere. */
static void singular_and_not_finite_are_refused(CHECK_STATE)
{
  static double a[MAX_N * MAX_N];
  int pivot[MAX_N];
  uint64_t seed = 3;
  static const int sizes[] = {1, 2, 3, 11, 60};
  const double poison[] = {NAN, -NAN, INFINITY, -INFINITY};
  for (size_t q = 0; q < sizeof sizes / sizeof *sizes; ++q) {
    int n = sizes[q];
    for (int at = 0; at < n; ++at) {
      random_matrix(&seed, n, a);
      for (int i = 0; i < n; ++i) a[i + n * at] = 0;
      assert_int_equal(dense_factor(n, a, pivot), HC_SINGULAR);
      random_matrix(&seed, n, a);
      for (int i = 0; i < n; ++i) a[at + n * i] = 0;
      assert_int_equal(dense_factor(n, a, pivot), HC_SINGULAR);
    }
    for (int at = 0; at < n * n; at += n < 20 ? 1 : 37)
      for (int p = 0; p < 4; ++p) {
        random_matrix(&seed, n, a);
        a[at] = poison[p];
        assert_int_equal(dense_factor(n, a, pivot), HC_SINGULAR);
      }
  }
  double equal_rows[] = {2, 2, 1, 3, 3, 5, -4, -4, 7};
  assert_int_equal(dense_factor(3, equal_rows, pivot), HC_SINGULAR);
  double nearly[] = {1, 1, 1, 1 + DBL_EPSILON};
  assert_int_equal(dense_factor(2, nearly, pivot), HC_OK); /* singular is 0 exactly, nothing else */
}

/* ---- inverses ------------------------------------------------------------------------------------------- */

static double size(int n, const double complex *A)
{
  double most = 0;
  for (int i = 0; i < n * n; ++i) most = fmax(most, cabs(A[i]));
  return most;
}

static hc_status inverse(int n, const double complex *A, int *pivot, double complex *work, double complex *X)
{
  memcpy(X, A, (size_t)n * (size_t)n * sizeof *X);
  return dense_invert_complex(n, X, pivot, work);
}

/* Each column of X solves (A + E) x = e with |E| of a few n u |A| growth: |A X - 1| <= c n u n |A| |X| where the
 * largest entries stand for norms. c = 10 allows for the growth. */
static void inverts_random_matrices(CHECK_STATE)
{
  static double complex A[MAX_N * MAX_N], X[MAX_N * MAX_N];
  uint64_t seed = 3;
  int pivot[MAX_N];
  double complex *work = calloc(DENSE_INVERT_WORK * MAX_N, sizeof *work);
  double worst = 0;
  for (int n = 1; n <= 70; n += n < 36 ? 1 : 17) {
    for (int i = 0; i < n * n; ++i) A[i] = random_signed(&seed) + I * random_signed(&seed);
    assert_int_equal(inverse(n, A, pivot, work, X), HC_OK);
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

static void singular_matrices_are_refused(CHECK_STATE)
{
  enum { N = 20 };
  static double complex A[N * N], X[N * N];
  int pivot[N];
  double complex *work = calloc(DENSE_INVERT_WORK * N, sizeof *work);
  for (int k = 0; k < N - 1; ++k) A[k + N * k] = 1;
  assert_int_equal(inverse(N, A, pivot, work, X), HC_SINGULAR);
  A[N * N - 1] = NAN;
  assert_int_equal(inverse(N, A, pivot, work, X), HC_SINGULAR);
  A[N * N - 1] = 1;
  assert_int_equal(inverse(N, A, pivot, work, X), HC_OK);
  free(work);
}

/* Factors, each of another matrix, by one of several threads: those that are wrong. Matrices are dominated by their
 * diagonal, growth is none, and b - A x is some n units of rounding. */
enum { ASKED = 8000, THREADS = 4, ROWS = 30 };

static void *factor_many(void *seed)
{
  double a[ROWS * ROWS], f[ROWS * ROWS], b[ROWS], x[ROWS];
  int pivot[ROWS];
  uintptr_t wrong = 0;
  for (int trial = 0; trial < ASKED; ++trial) {
    double worst = 0;
    random_matrix(seed, ROWS, a);
    for (int i = 0; i < ROWS; ++i) a[i * (ROWS + 1)] += ROWS, x[i] = b[i] = random_signed(seed);
    memcpy(f, a, sizeof f);
    const bool factored = dense_factor(ROWS, f, pivot) == HC_OK;
    dense_solve(ROWS, f, pivot, 1, x);
    for (int i = 0; i < ROWS; ++i) {
      for (int j = 0; j < ROWS; ++j) b[i] -= a[i + ROWS * j] * x[j];
      worst = larger(worst, fabs(b[i]));
    }
    wrong += !(factored && worst <= 10 * ROWS * DBL_EPSILON);
  }
  return (void *)wrong;
}

/* Fails with Debian's OpenBLAS without threads where its calls take no turns: some 2 of 1000 are wrong. */
static void threads_may_ask_at_once(CHECK_STATE)
{
  pthread_t thread[THREADS];
  uint64_t seed[THREADS];
  for (int i = 0; i < THREADS; ++i) {
    seed[i] = 7 + (uint64_t)i;
    assert_int_equal(pthread_create(&thread[i], NULL, factor_many, &seed[i]), 0);
  }
  for (int i = 0; i < THREADS; ++i) {
    void *wrong = NULL;
    assert_int_equal(pthread_join(thread[i], &wrong), 0);
    assert_null(wrong);
  }
}

/* alpha A x + beta y, and A x of the same numbers by rows: n products and as many sums. With beta = 0 what y was is not
 * read. */
static void matrices_times_vectors(CHECK_STATE)
{
  enum { MOST = 96 };
  static const int size[][2] = {{1, 1}, {3, 5}, {31, 33}, {32, 32}, {36, 84}, {84, 36}, {1, MOST}, {MOST, MOST}};
  static const double alphas[] = {1, -0.75}, betas[] = {0, 1, -0.5};
  static double A[MOST * MOST];
  uint64_t seed = 3;
  for (size_t k = 0; k < sizeof size / sizeof *size; ++k)
    for (int trial = 0; trial < 6; ++trial) {
      const int m = size[k][0], n = size[k][1];
      const double alpha = alphas[trial % 2], beta = betas[trial / 2];
      double x[MOST], y[MOST], begun[MOST];
      for (int i = 0; i < m * n; ++i) A[i] = random_signed(&seed);
      for (int i = 0; i < n; ++i) x[i] = random_signed(&seed);
      for (int i = 0; i < m; ++i) begun[i] = random_signed(&seed), y[i] = beta == 0 ? NAN : begun[i];
      dense_times_vector(m, n, alpha, A, x, beta, y);
      for (int i = 0; i < m; ++i) {
        double sum = beta * begun[i], terms = fabs(sum);
        for (int j = 0; j < n; ++j) sum += alpha * A[i + m * j] * x[j], terms += fabs(alpha * A[i + m * j] * x[j]);
        CHECK_NEAR(y[i], sum, (n + 3) * DBL_EPSILON * terms, "%d x %d, alpha %g, beta %g: [%d]", m, n, alpha, beta, i);
      }
      dense_rows_times_vector(n, m, A, x, y);
      for (int i = 0; i < m; ++i) {
        double sum = 0, terms = 0;
        for (int j = 0; j < n; ++j) sum += A[n * i + j] * x[j], terms += fabs(A[n * i + j] * x[j]);
        CHECK_NEAR(y[i], sum, (n + 3) * DBL_EPSILON * terms, "%d x %d by rows: [%d]", m, n, i);
      }
    }
}

static void modes_without_mass_are_refused(CHECK_STATE)
{
  static const double K[4] = {2, -1, -1, 2}, M[4] = {1, 0, 0, 0};
  double lambda[2], phi[4];
  for (int n = 1; n <= 2; ++n) assert_int_not_equal(dense_modes(n, K, n == 1 ? &M[1] : M, lambda, phi), HC_OK);
}

/* Products within larger matrices, by loops and by BLAS; with beta = 0 what C was does not matter. Entries are at most
 * 1: rounding of k terms. */
static void products_are_sums(CHECK_STATE)
{
  enum { LD = 70, MOST = 24 };
  static const int shape[][3] = {{5, 2, 2}, {64, 4, 4}, {65, 4, 4}, {3, 17, 1}, {7, 1, 16}, {20, 8, 9}, {4, 2, 0}};
  static const double betas[] = {0, 1, -0.5};
  static double A[LD * MOST], B[LD * MOST], C[LD * MOST], before[LD * MOST];
  uint64_t seed = 5;
  for (size_t c = 0; c < sizeof shape / sizeof *shape; ++c)
    for (int b = 0; b < 3; ++b) {
      const int m = shape[c][0], n = shape[c][1], k = shape[c][2];
      for (int i = 0; i < LD * MOST; ++i) {
        A[i] = random_signed(&seed), B[i] = random_signed(&seed);
        before[i] = C[i] = betas[b] == 0 ? NAN : random_signed(&seed);
      }
      dense_add_product(m, n, k, -2, A, LD, B, LD, betas[b], C, LD);
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < m; ++i) {
          double sum = betas[b] == 0 ? 0 : betas[b] * before[i + LD * j];
          for (int l = 0; l < k; ++l) sum -= 2 * A[i + LD * l] * B[l + LD * j];
          CHECK_NEAR(C[i + LD * j], sum, 2 * (k + 2) * (2 * k + 1) * DBL_EPSILON, "%d %d %d: %d, %d", m, n, k, i, j);
        }
    }
}

/* Also where finite numbers follow. */
static void a_nan_is_the_largest(CHECK_STATE)
{
  const double v[] = {1, NAN, 2}, ones[] = {1, 1, 1};
  assert_true(isnan(larger(NAN, 1)) && isnan(larger(1, NAN)) && larger(1, 2) == 2 && larger(2, 1) == 2);
  assert_true(isnan(norm_max(3, v)) && isnan(norm_weighted_max(3, ones, v)));
}

CHECK_TESTS("numerics.dense", 60, solves_within_the_bound_of_rounding_theory, the_sign_of_signed_permutations,
            singular_and_not_finite_are_refused, inverts_random_matrices, singular_matrices_are_refused,
            matrices_times_vectors, modes_without_mass_are_refused, threads_may_ask_at_once, products_are_sums,
            a_nan_is_the_largest)
