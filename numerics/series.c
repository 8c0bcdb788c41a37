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
  series_vector m = {n_harm, 1, {X}};
  guard rising = guard_make(&m, 1, &one, 0), falling = guard_negative(&rising);
  series_node here = series_vector_at(&m, 0), root;
  *max = *min = here.d[0][0];
  for (int i = 1; i <= SERIES_GRID; ++i) {
    series_node next = series_vector_at(&m, TWO_PI * i / SERIES_GRID);
    /* between grid angles x' changes sign any number of times; every change is an extremum */
    for (bool up = here.d[1][0] > 0; crossing_first(&m, up ? &rising : &falling, &here, &next, &root); up = !up) {
      double x = root.d[0][0];
      if (x > *max) *max = x;
      if (x < *min) *min = x;
      if (!(root.th > here.th)) break; /* x' is 0 to rounding */
      here = root;
    }
    here = next;
    if (here.d[0][0] > *max) *max = here.d[0][0];
    if (here.d[0][0] < *min) *min = here.d[0][0];
  }
}

double series_rms(int n_harm, const double *X)
{
  double sum = 0;
  for (int i = 1; i < series_length(n_harm); ++i) sum += X[i] * X[i];
  return sqrt(X[0] * X[0] + 0.5 * sum);
}

double series_harmonic_1(int n_harm, const double *X) { return n_harm > 0 ? hypot(X[1], X[2]) : 0; }
