/* test_force_jacobian.c - the Toeplitz + Hankel Jacobian against numerical quadrature of k(th) phi_p phi_q, and the
 * rank-1 update. */
#include "hbm/contact/force_jacobian.h"
#include "tests/hbm/scenes.h"

enum { MAX_H = 25, MAX_N = 2 * MAX_H + 1, MAX_SYMBOL = 4 * MAX_H + 1 };

/* phi_0 = 1, phi_{2h-1} = cos h th, phi_{2h} = sin h th. */
static double basis(int i, double th) { return i == 0 ? 1 : i % 2 ? cos((i + 1) / 2 * th) : sin(i / 2 * th); }

/* F = k x has the coefficients F_p = (2 - [p = 0]) mean(F phi_p), so dF_p/dX_q = (2 - [p = 0]) mean(k phi_p phi_q).
 * The integrand is a trigonometric polynomial of degree 4H, which n = 4H + 1 equidistant points integrate exactly:
 * only rounding is left. Each point adds at most |k| <= sum |symbol| =: K, with an error of a few eps in k (its own
 * sum: as many eps as it has terms) and in the angles h th (up to H eps each): (4H + 1) + 2 (2H) + 2 H + 4 eps, all
 * times 2K; the mean of n sums n eps/2 more. 20 (H + 1) eps K holds them all. */
static void matrix_equals_quadrature(CHECK_STATE)
{
  static const int orders[] = {1, 2, 3, 7, 25};
  static double symbol[MAX_SYMBOL], jac[(MAX_N + 3) * MAX_N], k[4 * MAX_H + 1], phi[MAX_N][4 * MAX_H + 1];
  uint64_t seed = 4;
  for (size_t o = 0; o < sizeof orders / sizeof *orders; ++o) {
    int H = orders[o], n = 2 * H + 1, ld = n + 3 * (o % 2), points = 4 * H + 1;
    assert_int_equal(force_jacobian_symbol_length(H), 2 * (2 * H) + 1);
    random_motion(&seed, 2 * H, 1, 0, symbol);
    double size = sum_abs(4 * H + 1, symbol);
    for (int t = 0; t < points; ++t) {
      double th = 2 * PI * (t + 0.3) / points;
      k[t] = 0;
      for (int i = 0; i < 4 * H + 1; ++i) k[t] += symbol[i] * basis(i, th);
      for (int i = 0; i < n; ++i) phi[i][t] = basis(i, th);
    }
    for (int i = 0; i < ld * n; ++i) jac[i] = 10 + i % 7; /* it adds */
    force_jacobian_add(H, symbol, ld, jac);
    for (int q = 0; q < n; ++q)
      for (int p = 0; p < n; ++p) {
        double sum = 0;
        for (int t = 0; t < points; ++t) sum += k[t] * phi[p][t] * phi[q][t];
        double expected = (p ? 2 : 1) * sum / points, got = jac[p + ld * q] - (10 + (p + ld * q) % 7);
        CHECK_NEAR(got, expected, 20 * (H + 1) * DBL_EPSILON * (size + 17), "H=%d row %d column %d", H, p, q);
      }
    for (int q = 0; q < n; ++q) /* between the columns: not ours */
      for (int p = n; p < ld; ++p) assert_true(jac[p + ld * q] == 10 + (p + ld * q) % 7);
  }
}

CHECK_TESTS("hbm.force_jacobian", 60, matrix_equals_quadrature)
