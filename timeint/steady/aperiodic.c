/* aperiodic.c - see aperiodic.h. Proof: tests/timeint/test_chaos.c, test_torus.c. */
#include "timeint/steady/aperiodic.h"

#include <complex.h>
#include <float.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/norm.h"
#include "timeint/steady/timeint_private.h"

/* ---- chaos ----
 *
 * A neighbouring motion is integrated beside the first for a round of batches. It is chaos if they drift apart at a
 * mean rate of more than three standard errors of the batches' means, and by more folds than leaving an orbit can
 * explain. Where they drift apart too slowly for that, another round is added as long as the latest one does not take
 * it back. */

/* [1] e-folds beyond those of leaving an orbit, which are counted as if growth were that of small distances up to the
 * size of the motion: 5 is a factor 150 of what that neglects. */
static const double beyond = 5;
static const double separation = 1e-5; /* [L] of the two neighbours: far above the scatter of a period at the final
                                          tolerance, far below the motion */
static const double narrowest = 10; /* [separation] neighbours in narrower bands are too far apart to say anything, and
                                          a motion that returns nearer may be held on an unstable orbit */
enum {
  AFTER = 500,         /* periods */
  FOLDS = 6,           /* of what damping takes away: exp(-6) = 0.25 % of the transient is left */
  STANDARD_ERRORS = 3, /* by chance once in 700 */
  BATCHES = 16,
  BATCH = 40 /* periods; the first batch only turns the neighbours' difference into the direction of growth */
};

typedef struct measurement {
  timeint *ti;
  const hc_monitor *monitor;
  int n_past; /* states in the ring ti->past */
  int batches;
  double sum, square;                   /* of the batches' mean rates */
  double returned[SETTLE_MAX_MULTIPLE]; /* [length] the largest return after k + 1 periods in the first batch */
} measurement;

static double distance(int n, const double *a, const double *b)
{
  double most = 0;
  for (int i = 0; i < n; ++i) most = larger(most, fabs(a[i] - b[i]));
  return most;
}

/* One period of the motion and of a neighbour at ti->y + d, d = ti->separation; d becomes their difference afterwards,
 * scaled to its old length, and *log_growth the log of the factor by which it grew, no less than log(DBL_EPSILON):
 * the two may have met. */
static hc_status integrate_neighbours(timeint *ti, double *log_growth)
{
  const int n = ti->n;
  double *d = ti->separation, *other = ti->neighbour;
  for (int i = 0; i < n; ++i) other[i] = ti->y[i] + d[i];
  hc_status st = integrate_period(ti->in, &ti->scaled, ti->y, NULL, NULL);
  if (st == HC_OK) st = integrate_period(ti->in, &ti->scaled, other, NULL, NULL);
  if (st != HC_OK) return st;
  ti->periods += 2;
  const double size = timeint_distance(ti, other, ti->y);
  *log_growth = log(fmax(size / separation, DBL_EPSILON));
  for (int i = 0; i < n && size > 0; ++i) d[i] = (other[i] - ti->y[i]) * (separation / size);
  return isfinite(size) && isfinite(*log_growth) ? HC_OK : HC_NOT_FINITE;
}

/* *rate: the mean over the batch. */
static hc_status integrate_batch(measurement *m, bool first, double *rate)
{
  timeint *ti = m->ti;
  double one;
  *rate = 0;
  for (int i = 0; i < BATCH; ++i) {
    if (!hc_monitor_tick(m->monitor, (double)ti->periods / ti->how.max_periods)) return HC_INTERRUPTED;
    hc_status st = integrate_neighbours(ti, &one);
    if (st != HC_OK) return st;
    *rate += one / BATCH;
    /* The state now joins the ring. */
    if (first) {
      const int now = m->n_past++;
      double *point = ti->point[0];
      timeint_point(ti, point);
      for (int k = 1; k <= SETTLE_MAX_MULTIPLE && k <= now; ++k) {
        const double *before = ti->past + (now - k) % SETTLE_MAX_MULTIPLE * ti->n;
        m->returned[k - 1] = fmax(m->returned[k - 1], distance(ti->n, point, before));
      }
      memcpy(ti->past + now % SETTLE_MAX_MULTIPLE * ti->n, point, sizeof *point * (size_t)ti->n);
    }
  }
  return HC_OK;
}

/* *rate: the mean over the round. */
static hc_status integrate_round(measurement *m, double *rate)
{
  double one;
  *rate = 0;
  for (int b = 0; b < BATCHES; ++b) {
    hc_status st = integrate_batch(m, false, &one);
    if (st != HC_OK) return st;
    *rate += one / BATCHES;
    m->sum += one;
    m->square += one * one;
    ++m->batches;
  }
  return HC_OK;
}

/* The folds by which neighbours grow at most while the motion leaves an orbit that it was next to in the first batch;
 * INFINITY: it returned too near to say. */
static double folds_of_leaving(const measurement *m)
{
  double nearest = INFINITY;
  for (int k = 0; k < SETTLE_MAX_MULTIPLE; ++k) nearest = fmin(nearest, m->returned[k]);
  if (!(nearest > narrowest * separation * m->ti->length)) return INFINITY;
  return log(2 * timeint_motion_size(m->ti) / nearest);
}

static bool periods_left(const timeint *ti, int batches)
{
  return ti->periods + 2 * batches * BATCH < ti->how.max_periods;
}

hc_status chaos_test(timeint *ti, const hc_monitor *monitor, bool *chaos, double *rate)
{
  measurement m = {.ti = ti, .monitor = monitor};
  *chaos = false;
  if (!(ti->periods > fmax(AFTER, FOLDS / (1 - ti->contraction))) || !periods_left(ti, BATCHES + 1)) return HC_OK;
  for (int i = 0; i < ti->n; ++i)
    ti->separation[i] = i < ti->n_dof ? separation / sqrt(ti->n_dof) * ti->sizes.of[i] : 0;
  hc_status st = integrate_batch(&m, true, rate);
  if (st != HC_OK) return st;
  const double enough = folds_of_leaving(&m) + beyond;
  for (double latest = 1; !*chaos && latest > 0 && isfinite(enough) && periods_left(ti, BATCHES);) {
    if ((st = integrate_round(&m, &latest)) != HC_OK) return st;
    *rate = m.sum / m.batches;
    const double n = m.batches, mean = m.sum / n;
    if (!(mean > STANDARD_ERRORS * sqrt(fmax(m.square / n - mean * mean, 0) / (n - 1)))) return HC_OK;
    *chaos = m.sum * BATCH >= enough;
  }
  return HC_OK;
}

/* ---- a torus: two things are seen after each period, the first response, and the size of the whole state ---- */

/* In chaos an average over 1024 periods scatters by some 5 % of the deviation; on a torus it is off by what lines that
 * alias to less than a few bins leave, at most 1e-4 of it on curves with corners. */
static const double same_average = 1e-3;
static const double same_line = 1e-5;    /* [turns a period] of a line in the two windows; a tenth of a bin is 1e-4 */
static const double same_height = 1e-2;  /* ten times same_average: a height is found with its frequency */
static const double stands_still = 1e-6; /* [1] a deviation that small, of the size, is no motion */
enum {
  WINDOW = 1024,                        /* periods: see same_average */
  REFINEMENTS = 60,                     /* golden sections: 0.618^60 = 3e-13 of a bin */
  MOST_LOCKED = 4 * SETTLE_MAX_MULTIPLE /* a cycle, or bands, beyond those looked for */
};

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
