/* series.c - see series.h. */
#include "hbm/series.h"

#include <float.h>
#include <math.h>

static const double TWO_PI = 6.283185307179586476925;

series_jet series_at(int n_harm, const double *X, double c, double s)
{
  series_jet j = {X[0], 0, 0};
  double ch = 1, sh = 0;
  for (int h = 1; h <= n_harm; ++h) {
    double next = ch * c - sh * s; /* cos(h th), sin(h th) by rotation */
    sh = ch * s + sh * c;
    ch = next;
    double even = X[2 * h - 1] * ch + X[2 * h] * sh, odd = X[2 * h] * ch - X[2 * h - 1] * sh;
    j.x += even;
    j.d1 += h * odd;
    j.d2 -= (double)h * h * even;
  }
  return j;
}

/* The value at the extremum inside (a, b), where x' changes sign from da to -da: Newton on x', kept inside by bisection. */
static double extremum_between(int n_harm, const double *X, double a, double b, double da)
{
  double th = 0.5 * (a + b);
  series_jet j = {0, 0, 0};
  for (int it = 0; it < 60; ++it) {
    j = series_at(n_harm, X, cos(th), sin(th));
    if ((j.d1 > 0) == (da > 0)) a = th; else b = th;
    double next = th - j.d1 / j.d2;
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    /* x is stationary here: an error e in th costs x'' e^2/2, so 1e-9 rad is already rounding */
    if (fabs(next - th) < 1e-9) return series_at(n_harm, X, cos(next), sin(next)).x;
    th = next;
  }
  return j.x;
}

void series_extrema(int n_harm, const double *X, double *max, double *min)
{
  int n = 8 * n_harm + 16;
  double step = TWO_PI / n, dc = cos(step), ds = sin(step), c = 1, s = 0;
  series_jet here = series_at(n_harm, X, c, s);
  *max = *min = here.x;
  for (int i = 1; i <= n; ++i) {
    double next = c * dc - s * ds;
    s = c * ds + s * dc;
    c = next;
    series_jet then = series_at(n_harm, X, c, s);
    double x = then.x;
    if ((here.d1 > 0) != (then.d1 > 0)) x = extremum_between(n_harm, X, (i - 1) * step, i * step, here.d1);
    if (x > *max) *max = x;
    if (x < *min) *min = x;
    if (then.x > *max) *max = then.x;
    if (then.x < *min) *min = then.x;
    here = then;
  }
}

double series_rms(int n_harm, const double *X)
{
  double sum = 0;
  for (int i = 1; i < series_length(n_harm); ++i) sum += X[i] * X[i];
  return sqrt(X[0] * X[0] + 0.5 * sum);
}

double series_harmonic_1(int n_harm, const double *X) { return n_harm > 0 ? hypot(X[1], X[2]) : 0; }
