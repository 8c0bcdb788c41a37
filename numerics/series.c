/* series.c - see series.h. */
#include "numerics/series.h"

#include <math.h>

#include "base/constants.h"
#include "numerics/crossing.h"

series_jet series_at(int n_harm, const double *X, double c, double s)
{
  series_jet j = {X[0], 0, 0};
  double ch = 1, sh = 0;
  for (int h = 1; h <= n_harm; ++h) {
    series_turn(c, s, &ch, &sh);
    double even = X[2 * h - 1] * ch + X[2 * h] * sh, odd = X[2 * h] * ch - X[2 * h - 1] * sh;
    j.x += even;
    j.d1 += h * odd;
    j.d2 -= (double)h * h * even;
  }
  return j;
}

void series_extrema(int n_harm, const double *X, double *max, double *min)
{
  const double one = 1;
  const series_vector m = {n_harm, 1, {X}};
  guard_extrema(&m, &one, 0, TWO_PI, max, min);
}

double series_rms(int n_harm, const double *X)
{
  double sum = 0;
  for (int i = 1; i < series_length(n_harm); ++i) sum += X[i] * X[i];
  return sqrt(X[0] * X[0] + 0.5 * sum);
}

double series_harmonic_1(int n_harm, const double *X) { return n_harm > 0 ? hypot(X[1], X[2]) : 0; }
