/* chaos.c - see chaos.h. Neighbours are drawn along for a round of batches. It is chaos if they drift apart at a mean
 * rate of more than three standard errors of the batches' means, and by more folds than leaving an orbit can explain.
 * Where they drift apart too slowly for that, another round is added as long as the latest one does not take it back.
 * Proof: tests/timeint/test_chaos.c. */
#include "timeint/steady/chaos.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "timeint/steady/timeint_private.h"

/* [1] e-folds beyond those of leaving an orbit, which are counted as if growth were that of small distances up to the
 * size of the motion: 5 is a factor 150 of what that neglects. */
static const double beyond = 5;
static const double separation = 1e-5; /* [L] of the two neighbours: far above the scatter of a period at the final
                                          tolerance, far below the motion */
static const double narrowest = 10; /* [separation] neighbours in narrower bands are too far apart to say anything, and
                                          a motion that returns nearer may be held on an unstable orbit */
enum {
  AFTER = 500, /* periods */
  FOLDS = 6,   /* of what damping takes away */
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
  for (int i = 0; i < n; ++i)
    if (!(fabs(a[i] - b[i]) <= most)) most = fabs(a[i] - b[i]);
  return most;
}

/* The state now joins the ring. */
static void note_returns(measurement *m)
{
  timeint *ti = m->ti;
  const int now = m->n_past++;
  double *point = ti->point[0];
  timeint_point(ti, point);
  for (int k = 1; k <= SETTLE_MAX_MULTIPLE && k <= now; ++k) {
    const double *before = ti->past + (now - k) % SETTLE_MAX_MULTIPLE * ti->n;
    m->returned[k - 1] = fmax(m->returned[k - 1], distance(ti->n, point, before));
  }
  memcpy(ti->past + now % SETTLE_MAX_MULTIPLE * ti->n, point, sizeof *point * (size_t)ti->n);
}

/* One period of the motion and of a neighbour at ti->y + d, d = ti->separation; d becomes their difference afterwards,
 * scaled to its old length, and *log_growth the log of the factor by which it grew, no less than log(DBL_EPSILON):
 * the two may have met. */
static hc_status integrate_neighbours(timeint *ti, double *log_growth)
{
  const int n = ti->n;
  double *d = ti->separation, *other = ti->neighbour, size = 0;
  for (int i = 0; i < n; ++i) other[i] = ti->y[i] + d[i];
  hc_status st = integrate_period(ti->in, &ti->scaled, ti->y, NULL, NULL);
  if (st == HC_OK) st = integrate_period(ti->in, &ti->scaled, other, NULL, NULL);
  if (st != HC_OK) return st;
  ti->periods += 2;
  for (int i = 0; i < n; ++i) size += (other[i] - ti->y[i]) * (other[i] - ti->y[i]);
  size = sqrt(size);
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
    if (first) note_returns(m);
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

static bool rate_is_positive(const measurement *m)
{
  const double n = m->batches, mean = m->sum / n;
  return mean > 3 * sqrt(fmax(m->square / n - mean * mean, 0) / (n - 1));
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
  for (int i = 0; i < ti->n; ++i) ti->separation[i] = i < ti->n_dof ? separation / sqrt(ti->n_dof) : 0;
  hc_status st = integrate_batch(&m, true, rate);
  if (st != HC_OK) return st;
  const double enough = folds_of_leaving(&m) + beyond;
  for (double latest = 1; !*chaos && latest > 0 && isfinite(enough) && periods_left(ti, BATCHES);) {
    if ((st = integrate_round(&m, &latest)) != HC_OK) return st;
    *rate = m.sum / m.batches;
    if (!rate_is_positive(&m)) return HC_OK;
    *chaos = m.sum * BATCH >= enough;
  }
  return HC_OK;
}
