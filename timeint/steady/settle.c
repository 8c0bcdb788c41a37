/* settle.c - see settle.h. The latest points are in a ring; all quantities are computed from it when asked for. Proof:
 * tests/timeint/test_settle.c. */
#include "timeint/steady/settle.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum {
  MIN_BASELINE = SETTLE_MAX_MULTIPLE,
  MAX_BASELINE = 512,
  CAPACITY = 2 * MAX_BASELINE + 2 * SETTLE_MAX_MULTIPLE,
  RECENT = 16
};

static const double contraction_cap = 0.9995;

struct settle {       /* from settle_new, to settle_free */
  int d;              /* components of a point                                      */
  double *ring;       /* [CAPACITY][d]                                              */
  long n;             /* points pushed since settle_start                           */
  long first;         /* of them, those before settle_restart: not used             */
  double contraction; /* a priori, capped                                           */
  int baseline;       /* B                                                          */
};

hc_status settle_new(int d, settle **out)
{
  *out = NULL;
  settle *s = calloc(1, sizeof *s);
  if (!s) return HC_NO_MEMORY;
  s->d = d;
  s->ring = calloc((size_t)d * CAPACITY, sizeof *s->ring);
  if (!s->ring) {
    settle_free(s);
    return HC_NO_MEMORY;
  }
  settle_start(s, 1);
  *out = s;
  return HC_OK;
}

void settle_free(settle *s)
{
  if (!s) return;
  free(s->ring);
  free(s);
}

void settle_start(settle *s, double contraction)
{
  s->n = s->first = 0;
  s->contraction = fmin(contraction, contraction_cap);
  s->baseline = (int)fmin(fmax(ceil(2 / (1 - s->contraction)), MIN_BASELINE), MAX_BASELINE);
}

void settle_restart(settle *s) { s->first = s->n > 0 ? s->n - 1 : 0; }

void settle_push(settle *s, const double *z)
{
  memcpy(s->ring + (s->n++ % CAPACITY) * s->d, z, sizeof *z * (size_t)s->d);
}

int settle_baseline(const settle *s) { return s->baseline; }

static double larger(double a, double b) { return b > a || isnan(b) ? b : a; } /* NaN if either is */

/* The point `ago` steps before the last. */
static const double *point(const settle *s, int ago) { return s->ring + ((s->n - 1 - ago) % CAPACITY) * s->d; }

/* |z_i - z_{i-m}| (largest component), i `ago` steps before the last, plus the rounding of that difference. */
static double moved(const settle *s, int ago, int m)
{
  const double *z = point(s, ago), *before = point(s, ago + m);
  double most = 0;
  for (int i = 0; i < s->d; ++i) most = larger(most, fabs(z[i] - before[i]) + 2 * DBL_EPSILON * fabs(z[i]));
  return most;
}

/* The largest of these over `count` i's, the last of them `ago` steps before the end. */
static double moved_most(const settle *s, int ago, int count, int m)
{
  double most = 0;
  for (int i = 0; i < count; ++i) most = larger(most, moved(s, ago + i, m));
  return most;
}

double settle_drift(const settle *s)
{
  double least = INFINITY;
  for (int k = 1; k <= SETTLE_MAX_MULTIPLE && k < s->n - s->first; ++k) least = fmin(least, moved(s, 0, k));
  return least;
}

/* Per step, from the largest drifts over k steps of the last b and of the b before. */
static double rate(const settle *s, int b, int k)
{
  return pow(moved_most(s, 0, b, k) / moved_most(s, b, b, k), 1.0 / b);
}

double settle_rate(const settle *s) { return s->n > 2 * s->baseline ? rate(s, s->baseline, 1) : NAN; }

/* Is the drift over b steps nearly the sum of those over k steps, as it is along one direction? */
static bool directed(const settle *s, int b, int k)
{
  const int folds = b / k;
  return moved(s, 0, folds * k) >= 0.4 * folds * moved_most(s, 0, b, k);
}

/* Contraction per step along one direction, over the longest baseline over which the drift keeps one: the nearer to 1
 * the contraction is, the longer the baseline it needs. NaN: there is none. */
static double measured_contraction(const settle *s, int k)
{
  int b = s->baseline;
  if (!directed(s, b, k)) return NAN;
  while (2 * b <= MAX_BASELINE && s->n - s->first > 4 * b + k && directed(s, 2 * b, k)) b *= 2;
  return rate(s, b, k);
}

/* min over strides m = k, 2k, 4k ... of D_m/(1 - rho^m). */
static double bound(const settle *s, int k, double rho)
{
  double least = INFINITY;
  if (!(rho < 1)) return least;
  int recent = s->baseline < RECENT ? s->baseline : RECENT;
  for (int m = k; m <= s->baseline || m == k; m *= 2)
    least = fmin(least, moved_most(s, 0, recent, m) / -expm1(m * log(rho)));
  return least;
}

static settle_estimate estimate_cycle(const settle *s, int k)
{
  settle_estimate e = {.distance = INFINITY, .contraction = measured_contraction(s, k)};
  double rho = fmax(s->contraction, e.contraction); /* fmax ignores a NaN */
  e.distance = bound(s, k, fmax(rho, DBL_MIN));
  return e;
}

/* The k of the shortest cycle that the points follow to within goal; k > 1 only if from one point to the next they
 * change 100 times as much, since close to a fixed point, or to a cycle of k/2, the differences over all strides are
 * small. 0: none. */
static int find_cycle(const settle *s, double goal)
{
  for (int k = 1; k <= SETTLE_MAX_MULTIPLE; ++k) {
    if (moved(s, 0, k) > 100 * goal) continue;
    double drift = moved_most(s, 0, s->baseline, k);
    if (drift <= 2 * goal) return k;
    if (!(drift > 100 * goal)) return 0;
  }
  return 0;
}

settle_estimate settle_judge(const settle *s, double goal)
{
  settle_estimate e = {.distance = INFINITY, .contraction = NAN};
  if (s->n - s->first < 2 * s->baseline + 1 + SETTLE_MAX_MULTIPLE) return e;
  int k = find_cycle(s, goal);
  e = estimate_cycle(s, k > 1 ? k : 1);
  /* |z_n - z_{n-1}| <= |e_n| + |e_{n-1}| */
  if (k == 0) e.distance = fmax(e.distance, moved_most(s, 0, s->baseline, 1) / 2);
  else if (e.distance <= goal) e.multiple = k;
  return e;
}
