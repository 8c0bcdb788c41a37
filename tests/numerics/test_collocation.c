/* test_collocation.c - collocation at Radau's points: its sums on polynomials, and the order of its panels' ends. */
#include <float.h>

#include "numerics/collocation.h"
#include "tests/check.h"

enum { N = COLLOCATION_POINTS };

/* Integrals of x^k from 0 to x_i are exact for k < N, from 0 to 1 for k <= 2 N - 2; coefficients are those of a
 * polynomial. 200 roundings: of the table's recurrences, of degree 10. */
static void sums_are_exact_on_polynomials(CHECK_STATE)
{
  collocation c;
  collocation_fill(&c);
  assert_true(c.x[N - 1] == 1);
  for (int i = 1; i < N; ++i) assert_true(c.x[i - 1] > 0 && c.x[i] > c.x[i - 1]);
  for (int k = 0; k <= 2 * N - 2; ++k)
    for (int i = k < N ? 0 : N - 1; i < N; ++i) {
      double sum = 0, slope[N];
      for (int j = 0; j < N; ++j) slope[j] = pow(c.x[j], k), sum += c.a[i][j] * slope[j];
      CHECK_NEAR(sum, pow(c.x[i], k + 1) / (k + 1), 200 * DBL_EPSILON, "x^%d to point %d", k, i);
      if (k < N) CHECK_NEAR(collocation_rise(&c, slope, 0.3), pow(0.3, k + 1) / (k + 1), 200 * DBL_EPSILON, "x^%d", k);
    }
}

/* The modes of Legendre's polynomial P_3(2 x - 1) are those of P_3 alone. */
static void modes_are_legendres(CHECK_STATE)
{
  collocation c;
  collocation_fill(&c);
  for (int n = 0; n < N; ++n) {
    double sum = 0;
    for (int j = 0; j < N; ++j) {
      const double t = 2 * c.x[j] - 1;
      sum += c.mode[n][j] * 0.5 * (5 * t * t * t - 3 * t);
    }
    CHECK_NEAR(sum, n == 3, 200 * DBL_EPSILON, "mode %d", n);
  }
}

/* Slopes of x^k are those of x^k elsewhere, too: inside the panel, and beyond it, where rounding grows like the last
 * Legendre polynomial there, 4e6 at 4. */
static void slopes_are_continued(CHECK_STATE)
{
  static const struct {
    double start, part, roundings;
  } parts[] = {{0, 0.4, 200}, {0.3, 0.5, 200}, {1, 1, 1e9}};
  collocation c;
  collocation_fill(&c);
  for (int m = 0; m < 3; ++m)
    for (int k = 0; k < N; ++k) {
      double slope[N], there[N];
      for (int j = 0; j < N; ++j) slope[j] = pow(c.x[j], k);
      collocation_slopes(&c, slope, parts[m].start, parts[m].part, there);
      for (int i = 0; i < N; ++i)
        CHECK_NEAR(there[i], pow(parts[m].start + parts[m].part * c.x[i], k), parts[m].roundings * DBL_EPSILON,
                   "x^%d from %g, point %d", k, parts[m].start, i);
    }
}

/* What is stiff decays in one panel: y' = -z y, solved by collocation, ends at about 1/z of its start for large z. */
static void what_is_stiff_decays(CHECK_STATE)
{
  collocation c;
  collocation_fill(&c);
  for (int power = 6; power <= 12; power += 3) {
    const double z = pow(10, power);
    /* slopes k = -z (1 + a k): one sweep of Gauss's elimination without exchanges, the matrix being nearly z a */
    double A[N][N], k[N], end = 1;
    for (int i = 0; i < N; ++i) {
      k[i] = -z;
      for (int j = 0; j < N; ++j) A[i][j] = z * c.a[i][j] + (i == j);
    }
    for (int p = 0; p < N; ++p)
      for (int i = 0; i < N; ++i) {
        const double factor = A[i][p] / A[p][p];
        for (int j = 0; j < N && i != p; ++j) A[i][j] -= factor * A[p][j];
        if (i != p) k[i] -= factor * k[p];
      }
    for (int j = 0; j < N; ++j) end += c.a[N - 1][j] * k[j] / A[j][j];
    CHECK_LE(fabs(end), 1000 / z + 1e-9, "z = %g", z);
  }
}

CHECK_TESTS("numerics.collocation", 30, sums_are_exact_on_polynomials, modes_are_legendres, slopes_are_continued,
            what_is_stiff_decays)
