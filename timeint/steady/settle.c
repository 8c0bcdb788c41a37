/* settle.c - see settle.h. The latest points are in a ring; all quantities are computed from it when asked for. Proof:
 * tests/timeint/test_settle.c. */
#include "timeint/steady/settle.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/trace.h"
#include "timeint/steady/escape.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/timeint_private.h"

enum {
  MIN_BASELINE = SETTLE_MAX_MULTIPLE, /* the longest cycle once */
  MAX_BASELINE = 512,                 /* for memory: the ring holds two */
  CAPACITY = 2 * MAX_BASELINE + 2 * SETTLE_MAX_MULTIPLE,
  RECENT = 16 /* differences of which the largest counts */
};

static const double contraction_cap = 0.9995; /* e-folds of 2000 periods: two baselines cannot tell more from 1 */
static const double least_directed = 0.4; /* along one direction a drift that falls by two e-folds over the baseline is
                                                 (1 - exp(-2))/2 = 0.43 of the largest times their number */
static const double far_apart = 100;      /* [goal] states of a cycle, see find_cycle */

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

/* Contraction per step over the last 2 B: (largest drift of the last B)/(of the B before), to the power 1/B; 1 or more
 * where the drift does not fall, NaN before 2 B + 1 points. Meaningful while the drift is far above the noise. */
static double recent_contraction(const settle *s) { return s->n > 2 * s->baseline ? rate(s, s->baseline, 1) : NAN; }

/* Is the drift over b steps nearly the sum of those over k steps, as it is along one direction? */
static bool directed(const settle *s, int b, int k)
{
  const int folds = b / k;
  return moved(s, 0, folds * k) >= least_directed * folds * moved_most(s, 0, b, k);
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
 * change far_apart times as much, since close to a fixed point, or to a cycle of k/2, the differences over all strides
 * are small. 0: none. */
static int find_cycle(const settle *s, double goal)
{
  for (int k = 1; k <= SETTLE_MAX_MULTIPLE; ++k) {
    if (moved(s, 0, k) > far_apart * goal) continue;
    double drift = moved_most(s, 0, s->baseline, k);
    if (drift <= 2 * goal) return k;
    if (!(drift > far_apart * goal)) return 0;
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

/* ---- period after period ----
 *
 * The first period is integrated with the finest tolerance of CVODE (timeint_final_tolerance), to see how much the
 * state moves; the next ones with a tolerance as coarse as that allows, and a finer one as the state moves less. Only
 * with the finest is the orbit judged, and its period or k periods measured. */

/* Coarse steps cost a third to a fifth, and lose nothing while the state is farther from the orbit than their error
 * puts it: up to 250 times the tolerance a period, which adds up over 1/(1 - rho) periods to at least 1/sqrt(1 -
 * rho) times that. Hence drift sqrt(1 - rho)/1000: a start on the orbit keeps the finest tolerance and stays on it. */
static const double coarsest = 1e-8;
static const double drift_over_tolerance = 1e3, refine_by = 0.1;
enum { MOST_BASELINES = 20 }; /* at one tolerance: if the scatter is larger than expected, drift never falls below it */

static void push(timeint *ti)
{
  timeint_point(ti, ti->point[0]);
  settle_push(ti->settle, ti->point[0]);
}

static hc_status one_period(timeint *ti, bool measured)
{
  hc_status st = timeint_period(ti, measured);
  if (st == HC_OK) push(ti);
  return st;
}

/* How the integration is going. */
typedef struct progress {
  int periods;        /* at this tolerance */
  double contraction; /* measured while the drift was last far above the scatter, NaN before */
  double amplitude;   /* of the last measurement, INFINITY before; the size of the state also counts its mean */
} progress;

/* The coarsest steps that a state moving as this one does allows. */
static double coarsest_allowed(const timeint *ti)
{
  double moves = settle_drift(ti->settle) / timeint_size(ti) * sqrt(1 - ti->contraction);
  return fmax(fmin(moves / drift_over_tolerance, coarsest), timeint_final_tolerance(ti));
}

static hc_status use_tolerance(timeint *ti, progress *p, double tolerance)
{
  p->periods = 0;
  settle_restart(ti->settle); /* another tolerance has another fixed point */
  TRACE(steady, "omega %.9g: marching, steps of %.3g from period %d on", ti->omega, tolerance, ti->periods);
  return timeint_set_tolerance(ti, tolerance);
}

/* After each period: a coarser tolerance after the first, a finer one once the state moves too little for the
 * present. */
static hc_status adapt_tolerance(timeint *ti, progress *p)
{
  const double allowed = coarsest_allowed(ti), finest = timeint_final_tolerance(ti);
  if (ti->periods == 1) return allowed > finest ? use_tolerance(ti, p, allowed) : HC_OK;
  bool far = allowed >= ti->tolerance && allowed > finest;
  if (far) p->contraction = recent_contraction(ti->settle);
  if (ti->tolerance <= finest || (far && ++p->periods < MOST_BASELINES * ti->settle->baseline)) return HC_OK;
  return use_tolerance(ti, p, fmax(finest, refine_by * ti->tolerance));
}

/* The distance [length] between points (timeint_point) that puts a response of that amplitude off by the tolerance. */
static double point_goal(const timeint *ti, double amplitude)
{
  return ti->how.tolerance * amplitude / timeint_response_unit(ti, 0) * ti->length;
}

/* The next k periods into *r, and how near the orbit they are. */
static hc_status measure_orbit(timeint *ti, int k, progress *p, timeint_result *r)
{
  measure_begin(&ti->measure, &ti->scaled);
  for (int i = 0; i < k; ++i) {
    hc_status st = one_period(ti, true);
    if (st != HC_OK) return st;
  }
  timeint_report(ti, 0, r);
  r->free_sliders = measure_resting_sliders(&ti->measure);
  ti->measured = true;
  settle_estimate e = settle_judge(ti->settle, point_goal(ti, r->amplitude));
  r->closure = e.distance / ti->length * timeint_response_unit(ti, 0) / r->amplitude;
  r->contraction = isnan(e.contraction) ? p->contraction : e.contraction;
  r->period_multiple = e.multiple;
  p->amplitude = r->amplitude;
  return HC_OK;
}

/* k if the states seem to have settled to a cycle of k periods, to be measured; else 0. `amplitude`: the best known; an
 * estimate suffices, since measure_orbit judges by the measured one. */
static int seems_settled(const timeint *ti, double amplitude)
{
  if (ti->tolerance > timeint_final_tolerance(ti)) return 0;
  const double goal = point_goal(ti, amplitude);
  if (!(settle_drift(ti->settle) <= 2 * goal)) return 0; /* a necessary condition that costs little */
  return settle_judge(ti->settle, goal).multiple;
}

hc_status settle_by_integration(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  const int most = ti->how.max_periods;
  progress p = {.contraction = NAN, .amplitude = INFINITY};
  bool creeps = false;
  settle_start(ti->settle, ti->contraction);
  push(ti);
  hc_status st = use_tolerance(ti, &p, timeint_final_tolerance(ti));
  r->method = TIMEINT_BY_MARCHING;
  while (st == HC_OK && ti->periods < most - 1) {
    if (!hc_monitor_tick(monitor, (double)ti->periods / most)) return HC_INTERRUPTED;
    if ((st = one_period(ti, false)) != HC_OK || (st = adapt_tolerance(ti, &p)) != HC_OK) return st;
    if ((st = escape_size(ti)) != HC_OK) return st;
    if (escape_note(ti) && timeint_may_creep(ti)) {
      if ((st = escape_look_for_creep(ti, &creeps)) != HC_OK) return st;
      if (creeps) break;
      push(ti);
      settle_restart(ti->settle); /* after periods that it has not seen */
    }
    int k = seems_settled(ti, fmin(p.amplitude, timeint_size(ti)));
    if (k == 0 || ti->periods + k > most) continue;
    if ((st = measure_orbit(ti, k, &p, r)) != HC_OK || r->period_multiple > 0) return st;
  }
  const hc_status why = creeps ? HC_CREEPS : escape_grows(ti) ? HC_UNBOUNDED : HC_NOT_SETTLED;
  const bool measures = creeps || ti->periods < most || isnan(r->amplitude);
  if (st == HC_OK && measures && why == HC_NOT_SETTLED) st = orbit_watch(ti);
  if (st == HC_OK && measures) st = measure_orbit(ti, 1, &p, r);
  if (st == HC_OK && r->period_multiple == 0) st = why;
  TRACE(steady, "omega %.9g: marched %d periods, closure %.3g: %s", ti->omega, ti->periods, r->closure,
        hc_status_text(st));
  return st;
}
