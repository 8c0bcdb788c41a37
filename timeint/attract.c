/* attract.c - where a motion goes: waiting in stretches, each twice as long as the last, and after each a look for
 * the orbit it is on.
 *
 * A stretch is marched in coarse steps: Newton does the fine work. Then, if the last state came back to an earlier
 * one, k periods ago, to within `near`, the k-orbit next to it is computed (shoot.h). It is where the motion goes if
 * it is stable, next to the state, and the map between the two is linear enough for what is left to shrink: |F(z) -
 * z* - Phi (z - z*)| <= (1 - rho)/2 |z - z*|. Otherwise on.
 *
 * A motion that shows no such orbit is tested for chaos: the mean rate at which two neighbours drift apart, drawn
 * together again after each period, over BATCHES times BATCH periods, against its own scatter over the batches. Not
 * before FOLDS times what damping forgets in: next to a saddle neighbours drift apart as well, for a while. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "timeint/internal.h"
#include "timeint/linear_forever.h"

static const double coarse = 1e-9;        /* CVODE's tolerance while waiting, if the final one is not coarser */
static const double near = 0.02;          /* [size] of a return that is worth a Newton solve */
static const double slowest_chaos = 1e-3; /* [1/period] neighbours part in a thousand periods: any slower and it
                                             cannot be told from none */
static const double shortest_leap = 0.1;  /* [size] from period to period, now and then: what only crawls is leaving a
                                            saddle, or settling */
static const double apart = 1e-5; /* [L] of the two: far above what a period scatters by at the final tolerance, far
                                     below the motion */
enum {
  LYAPUNOV_AFTER = 500,
  FOLDS = 6,
  BATCHES = 16,
  BATCH = 40,
  LYAPUNOV_PERIODS = 2 * (BATCHES + 1) * BATCH,
  LAST_RESORT = 6
};

/* How the waiting goes. */
typedef struct wait {
  timeint *ti;
  const hc_monitor *monitor;
  double past[SETTLE_MAX_MULTIPLE][SCALED_MAX_STATES]; /* [length] a ring of the latest states */
  int n;                                               /* of them seen */
  int failed;                                          /* Newton solves that found nothing */
} wait;

static double size_of(const timeint *ti) { return fmax(timeint_size(ti), ti->least_length); }

/* Largest difference to the state k periods ago [length]. */
static double returned(const wait *w, int k)
{
  double z[SCALED_MAX_STATES], most = 0;
  const double *before = w->past[(w->n - k) % SETTLE_MAX_MULTIPLE];
  timeint_point(w->ti, z);
  for (int i = 0; i < w->ti->scaled.n_states; ++i) {
    double d = fabs(z[i] - before[i]);
    if (!(d <= most)) most = d;
  }
  return most;
}

static void remember(wait *w) { timeint_point(w->ti, w->past[w->n++ % SETTLE_MAX_MULTIPLE]); }

/* The next k > `after` whose return is nearer than half of `within`; 0: none up to 16. */
static int next_return(const wait *w, int after, double within)
{
  for (int k = after + 1; k <= SETTLE_MAX_MULTIPLE && k <= w->n; ++k)
    if (returned(w, k) < 0.5 * within) return k;
  return 0;
}

/* Some periods; true in *linear if from there on the closed form holds. */
static hc_status pass(wait *w, int periods, bool *linear)
{
  timeint *ti = w->ti;
  const int most = ti->how.max_periods;
  hc_status st = timeint_set_tolerance(ti, fmax(coarse, timeint_final_tolerance(ti)));
  *linear = false;
  for (int i = 0; i < periods && st == HC_OK && ti->periods < most - 1; ++i) {
    if ((*linear = linear_forever(ti))) return HC_OK;
    if (!hc_monitor_tick(w->monitor, (double)ti->periods / most)) return HC_INTERRUPTED;
    remember(w);
    st = timeint_period(ti, false);
  }
  if (st == HC_OK) *linear = linear_forever(ti);
  hc_status back = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  return st == HC_OK ? back : st;
}

/* Is the motion, at ti->y when the solve began, on its way to this orbit? A sweep has left it next to its orbit, if
 * that is stable. */
static bool goes_there(const wait *w, const shoot_report *found, double size)
{
  const double rho = cabs(found->multiplier);
  if (w->n == 0) return rho < 1 && found->moved <= near * size;
  return rho < 1 && found->moved <= 5 * near * size && found->nonlinear <= 0.5 * (1 - rho);
}

/* Is the orbit of k periods next to ti->y where the motion goes? Then it is reported. */
static hc_status look(wait *w, int k, bool *found_it, timeint_result *r)
{
  timeint *ti = w->ti;
  double began[SCALED_MAX_STATES];
  shoot_report found;
  const double size = size_of(ti) / ti->length;
  memcpy(began, ti->y, sizeof began);
  *found_it = false;
  hc_status st = shoot_newton(ti->shoot, k, near * size, timeint_goal(ti), w->monitor, &found);
  if (timeint_no_orbit(st)) {
    ++w->failed;
    return HC_OK;
  }
  if (st != HC_OK) return st;
  *found_it = goes_there(w, &found, size);
  if (*found_it) return timeint_report(ti, k, TIMEINT_BY_SHOOTING, &found, r);
  memcpy(ti->y, began, sizeof began);
  return HC_OK;
}

/* Of each k in turn whose return is clearly nearer than those of all before: multiples of a cycle return as well as
 * the cycle itself, and near a period doubling both the lost orbit and the new one are at hand. */
static hc_status look_around(wait *w, bool *found_it, timeint_result *r)
{
  double within = 2 * near * size_of(w->ti);
  hc_status st = HC_OK;
  *found_it = false;
  for (int k = next_return(w, 0, within); k > 0 && st == HC_OK && !*found_it; k = next_return(w, k, within)) {
    within = returned(w, k);
    st = look(w, k, found_it, r);
  }
  return st;
}

/* One period of the motion and of a neighbour at ti->y + d; d becomes their difference afterwards, drawn in to its
 * old length again, and the log of how it grew is returned. */
static hc_status grow(timeint *ti, double *d, double *log_growth)
{
  const int n = ti->scaled.n_states;
  double other[SCALED_MAX_STATES], size = 0;
  for (int i = 0; i < n; ++i) other[i] = ti->y[i] + d[i];
  hc_status st = integrate_period(ti->in, &ti->scaled, ti->y, NULL, NULL);
  if (st == HC_OK) st = integrate_period(ti->in, &ti->scaled, other, NULL, NULL);
  if (st != HC_OK) return st;
  ti->periods += 2;
  for (int i = 0; i < n; ++i) size += (other[i] - ti->y[i]) * (other[i] - ti->y[i]);
  size = sqrt(size);
  *log_growth = log(fmax(size / apart, DBL_EPSILON)); /* two that met drift apart no more */
  for (int i = 0; i < n && size > 0; ++i) d[i] = (other[i] - ti->y[i]) * (apart / size);
  return isfinite(size) && isfinite(*log_growth) ? HC_OK : HC_NOT_FINITE;
}

/* Do neighbours drift apart, by more than the scatter of the batches' means (three standard errors)? */
static hc_status drifts_apart(timeint *ti, const hc_monitor *monitor, bool *yes, double *rate)
{
  double d[SCALED_MAX_STATES] = {apart}, mean = 0, square = 0, leap = 0, one;
  for (int b = -1; b < BATCHES; ++b) { /* the first one only turns d into the direction of growth */
    double sum = 0;
    for (int i = 0; i < BATCH; ++i) {
      if (!hc_monitor_tick(monitor, (double)ti->periods / ti->how.max_periods)) return HC_INTERRUPTED;
      const double x = ti->y[SCALED_X], p = ti->y[SCALED_P];
      hc_status st = grow(ti, d, &one);
      if (st != HC_OK) return st;
      leap = fmax(leap, hypot(ti->y[SCALED_X] - x, ti->y[SCALED_P] - p) / hypot(x, p));
      sum += one / BATCH;
    }
    if (b < 0) continue;
    mean += sum / BATCHES;
    square += sum * sum / BATCHES;
  }
  *rate = mean;
  *yes = leap > shortest_leap && mean > slowest_chaos && mean > 3 * sqrt(fmax(square - mean * mean, 0) / (BATCHES - 1));
  return HC_OK;
}

static hc_status aperiodic(wait *w, timeint_result *r)
{
  const shoot_report none = {.distance = INFINITY, .multiplier = NAN};
  const double rate = r->lyapunov;
  hc_status st = timeint_report(w->ti, 1, TIMEINT_BY_MARCHING, &none, r);
  r->period_multiple = 0;
  r->lyapunov = rate;
  return st == HC_OK ? HC_APERIODIC : st;
}

hc_status timeint_attract(timeint *ti, int first, const hc_monitor *monitor, timeint_result *r)
{
  wait w = {.ti = ti, .monitor = monitor};
  const int start = ti->how.start;
  if (start == TRANSIENT_START_UP || start == TRANSIENT_START_DOWN) { /* the sweep has probably left it on its orbit */
    bool there;
    hc_status st = look(&w, 1, &there, r);
    if (st != HC_OK || there) return st;
  }
  for (int stretch = first; ti->periods < ti->how.max_periods - 1; stretch *= 2) {
    bool done, chaos = false;
    hc_status st = pass(&w, stretch, &done);
    if (st != HC_OK) return st;
    if (done) {
      linear_steady(ti, r);
      return HC_OK;
    }
    if ((st = look_around(&w, &done, r)) != HC_OK || done) return st;
    if (ti->periods > fmax(LYAPUNOV_AFTER, FOLDS / (1 - ti->contraction)) &&
        ti->periods + LYAPUNOV_PERIODS < ti->how.max_periods) {
      if ((st = drifts_apart(ti, monitor, &chaos, &r->lyapunov)) != HC_OK) return st;
      if (chaos) return aperiodic(&w, r);
    }
    if (w.failed >= LAST_RESORT) break;
  }
  return timeint_march(ti, monitor, r);
}
