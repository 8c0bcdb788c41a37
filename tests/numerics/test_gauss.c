/* test_gauss.c - Gauss's rule of sixteen points: its nodes and weights, and its panels. */
#include "numerics/gauss.h"

#include <float.h>

#include "tests/check.h"

/* Exact for x^k, k < 2 points: the integral over [-1, 1] is 2/(k + 1) or 0. The table has 17 digits, the sum at most 16
 * terms: 8 roundings of 1. The rule of n points is not exact for x^2n: off by 2^(2n + 1) (n!)^4 / ((2n + 1) (2n)!^2),
 * 7e-10 for 16 points, 1e-2 for 4. */
static void nodes_and_weights_are_the_rules(CHECK_STATE)
{
  for (int points = GAUSS_FEW; points <= GAUSS_POINTS; points *= 4) {
    for (int i = 1; i < points; ++i) assert_true(gauss_node(points, i) > gauss_node(points, i - 1));
    for (int k = 0; k <= 2 * points; ++k) {
      const double exact = k % 2 ? 0 : 2.0 / (k + 1);
      double sum = 0;
      for (int i = 0; i < points; ++i) sum += gauss_weight(points, i) * pow(gauss_node(points, i), k);
      if (k < 2 * points) CHECK_NEAR(sum, exact, 8 * DBL_EPSILON, "x^%d", k);
      else CHECK_LE(1e-10, fabs(sum - exact), "x^%d", k);
    }
  }
}

static void two_powers(const void *self, double x, double value[2])
{
  const int *k = self;
  for (int i = 0; i < 2; ++i) value[i] = pow(x, k[i]);
}

/* Over [0, 2] on 1 and on 7 panels: 2^(k + 1)/(k + 1), to the roundings of 112 terms. */
static void panels_add_up(CHECK_STATE)
{
  static const int k[2] = {4, 15};
  for (int panels = 1; panels <= 7; panels += 6) {
    double sum[2];
    gauss_integrals(two_powers, k, 0, 2, panels, sum);
    for (int i = 0; i < 2; ++i) {
      const double exact = ldexp(1, k[i] + 1) / (k[i] + 1);
      CHECK_NEAR(sum[i], exact, 112 * DBL_EPSILON * exact, "x^%d, %d panels", k[i], panels);
    }
  }
}

CHECK_TESTS("numerics.gauss", 30, nodes_and_weights_are_the_rules, panels_add_up)
