/* torus.c - see torus.h. Two things are seen after each period: the first response, and the size of the whole state.
 * Proof: tests/timeint/test_torus.c. */
#include "timeint/steady/torus.h"

#include <complex.h>
#include <math.h>

#include "base/constants.h"
#include "timeint/steady/timeint_private.h"

/* In chaos an average over 1024 periods scatters by some 5 % of the deviation; on a torus it is off by what lines that
 * alias to less than a few bins leave, at most 1e-4 of it on curves with corners. */
static const double same_average = 1e-3;
static const double same_line =
    1e-5; /* [turns a period] of its frequency in the two windows; a tenth of a bin is 1e-4 */
static const double same_height = 1e-2;
static const double stands_still = 1e-6; /* [1] a deviation that small, of the size, is no motion */
enum { WINDOW = 1024, REFINEMENTS = 60, MOST_LOCKED = 64 };

/* Sum to 1 over i = 0 .. n-1. */
static double weight(int n, int i)
{
  const double t = (i + 1.0) / (n + 1.0);
  return exp(-1 / (t * (1 - t)));
}

/* Average of x[n], and how far it deviates from that. */
typedef struct average {
  double mean, deviation;
} average;

static average average_of(int n, const double *x)
{
  double sum = 0, square = 0, weights = 0;
  for (int i = 0; i < n; ++i) sum += weight(n, i) * x[i], weights += weight(n, i);
  const double mean = sum / weights;
  for (int i = 0; i < n; ++i) square += weight(n, i) * (x[i] - mean) * (x[i] - mean);
  return (average){mean, sqrt(square / weights)};
}

/* Height of the line of x - mean at nu. */
static double line_height(int n, const double *x, double mean, double nu)
{
  const double complex turn = cexp(-I * TWO_PI * nu);
  double complex phase = 1, sum = 0;
  for (int i = 0; i < n; ++i, phase *= turn) sum += weight(n, i) * (x[i] - mean) * phase;
  return cabs(sum);
}

/* The frequency of the highest line in [low, high]: the highest of some points, half a bin apart at most, then by
 * golden sections. */
static double highest_line(int n, const double *x, double low, double high)
{
  const double mean = average_of(n, x).mean, ratio = 0.5 * (sqrt(5) - 1), half_bin = 0.5 / n;
  const int points = (int)ceil((high - low) / half_bin);
  double best = low, height = -1;
  for (int i = 0; i <= points; ++i) {
    const double nu = low + (high - low) * i / points, here = line_height(n, x, mean, nu);
    if (here > height) best = nu, height = here;
  }
  double a = best - half_bin, b = best + half_bin;
  for (int i = 0; i < REFINEMENTS; ++i) {
    const double left = b - ratio * (b - a), right = a + ratio * (b - a);
    if (line_height(n, x, mean, left) > line_height(n, x, mean, right)) b = right;
    else a = left;
  }
  return 0.5 * (a + b);
}

/* Within what the two windows tell apart of j/k, for a small k: a cycle of k periods, or that many bands of chaos. */
static bool is_locked(double nu)
{
  for (int k = 1; k <= MOST_LOCKED; ++k)
    if (fabs(k * nu - round(k * nu)) <= k * same_line) return true;
  return false;
}

static bool averages_agree(int n, const double *x, double size)
{
  const average a = average_of(n, x), b = average_of(n, x + n);
  return fabs(a.mean - b.mean) <= same_average * fmax(b.deviation, stands_still * size);
}

double torus_rotation(int n, const double *seen, const double *size)
{
  const average s = average_of(n, size), x = average_of(n, seen);
  const double *of = x.deviation > stands_still * s.mean ? seen : size;
  const double deviation = of == seen ? x.deviation : s.deviation;
  if (!averages_agree(n, seen, s.mean) || !averages_agree(n, size, s.mean)) return NAN;
  if (!(deviation > stands_still * s.mean)) return NAN;
  const double bin = 1.0 / n, nu = highest_line(n, of, bin, 0.5 - bin),
               later = highest_line(n, of + n, nu - bin, nu + bin);
  const double height = line_height(n, of, average_of(n, of).mean, nu),
               height_later = line_height(n, of + n, average_of(n, of + n).mean, later);
  if (!(fabs(nu - later) <= same_line) || !(fabs(height - height_later) <= same_height * height)) return NAN;
  return is_locked(nu) ? NAN : nu;
}

hc_status torus_test(timeint *ti, const hc_monitor *monitor, double *nu)
{
  double seen[2 * WINDOW], size[2 * WINDOW];
  const int most = ti->how.max_periods;
  *nu = NAN;
  if (!ti->base || !(ti->periods + 2 * WINDOW < most)) return HC_OK;
  for (int i = 0; i < 2 * WINDOW; ++i) {
    if (!hc_monitor_tick(monitor, (double)ti->periods / most)) return HC_INTERRUPTED;
    hc_status st = timeint_period(ti, false);
    if (st != HC_OK) return st;
    seen[i] = scaled_response(&ti->scaled, 0, ti->y) * ti->length;
    size[i] = timeint_size(ti);
  }
  *nu = torus_rotation(WINDOW, seen, size);
  return HC_OK;
}
