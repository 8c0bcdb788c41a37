/* attract.c - see attract.h. The motion is integrated in stretches, each twice as long as the last; after each the
 * orbit is looked for to which it converges.
 *
 * A stretch is integrated with a coarse tolerance, since Newton makes the orbit accurate. Then, if the last state is
 * within `near` of the state k periods ago, the orbit of k periods next to it is computed (shoot.h). The motion goes to
 * that orbit if it is stable, next to the state, and the map between the two is linear enough for the distance to
 * shrink: |F(z) - z* - Phi (z - z*)| <= (1 - rho)/2 |z - z*|. Otherwise another stretch follows.
 *
 * A motion next to no such orbit is tested for chaos: the mean rate at which two neighbours drift apart (the largest
 * Lyapunov exponent, the distance reset after each period) over BATCHES times BATCH periods, against its own scatter
 * over the batches. Not before FOLDS times the periods in which damping reduces a difference by e: next to a saddle
 * neighbours drift apart as well, for a while. */
#include "timeint/attract.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#include "timeint/linear_regime.h"
#include "timeint/march.h"
#include "timeint/orbit.h"
#include "timeint/timeint_private.h"

static const double coarse = 1e-9;        /* CVODE's tolerance in a stretch, if the final one is not coarser */
static const double near = 0.02;          /* [size] between a state and its return: the orbit is then looked for */
static const double slowest_chaos = 1e-3; /* [1/period] a rate below 1 in a thousand periods cannot be told from 0 */
static const double shortest_leap = 0.1;  /* [size] the largest change over one period is no less in chaos: a motion
                                             with smaller changes is leaving a saddle, or settling */
static const double separation = 1e-5;    /* [L] of the two neighbours: far above the scatter of a period at the final
                                             tolerance, far below the motion */
enum {
  LYAPUNOV_AFTER = 500, /* periods */
  FOLDS = 6,
  BATCHES = 16,
  BATCH = 40,                                   /* periods */
  LYAPUNOV_PERIODS = 2 * (BATCHES + 1) * BATCH, /* of both neighbours; the first batch only turns their difference */
  MOST_FAILURES = 6                             /* of Newton; then marching decides */
};

/* The motion on its way; the ring of its latest states is ti->past. */
typedef struct approach {
  timeint *ti;
  const hc_monitor *monitor;
  int n_past;   /* states seen */
  int failures; /* Newton solves that found no orbit */
} approach;

static double *past_state(const approach *a, int i) { return a->ti->past + i % SETTLE_MAX_MULTIPLE * a->ti->n; }

/* Largest difference to the state k periods ago [length]. */
static double distance_to_past(const approach *a, int k)
{
  double *z = a->ti->point[0], most = 0;
  const double *before = past_state(a, a->n_past - k);
  timeint_point(a->ti, z);
  for (int i = 0; i < a->ti->n; ++i) {
    double d = fabs(z[i] - before[i]);
    if (!(d <= most)) most = d;
  }
  return most;
}

static void remember(approach *a) { timeint_point(a->ti, past_state(a, a->n_past++)); }

/* The next k > `after` for which the state k periods ago is nearer than half of `within`; 0: none up to 16. */
static int next_return(const approach *a, int after, double within)
{
  for (int k = after + 1; k <= SETTLE_MAX_MULTIPLE && k <= a->n_past; ++k)
    if (distance_to_past(a, k) < 0.5 * within) return k;
  return 0;
}

/* Some periods; true in *linear if from there on the closed form holds. */
static hc_status integrate_stretch(approach *a, int periods, bool *linear)
{
  timeint *ti = a->ti;
  const int most = ti->how.max_periods;
  hc_status st = timeint_set_tolerance(ti, fmax(coarse, timeint_final_tolerance(ti)));
  *linear = false;
  for (int i = 0; i < periods && st == HC_OK && ti->periods < most - 1; ++i) {
    if ((*linear = linear_regime_is_final(ti))) return HC_OK;
    if (!hc_monitor_tick(a->monitor, (double)ti->periods / most)) return HC_INTERRUPTED;
    remember(a);
    st = timeint_period(ti, false);
  }
  if (st == HC_OK) *linear = linear_regime_is_final(ti);
  hc_status back = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  return st == HC_OK ? back : st;
}

/* Does the motion, at ti->y when the solve began, converge to this orbit? Before the first stretch, which is after a
 * sweep, it does if the orbit is stable and next to it. */
static bool converges_to(const approach *a, const shoot_report *found, double size)
{
  const double rho = cabs(found->multiplier);
  if (a->n_past == 0) return rho < 1 && found->moved <= near * size;
  return rho < 1 && found->moved <= 5 * near * size && found->nonlinear <= 0.5 * (1 - rho);
}

/* *found_it: the motion converges to the orbit of k periods next to ti->y, which is then reported. */
static hc_status try_orbit(approach *a, int k, bool *found_it, timeint_result *r)
{
  timeint *ti = a->ti;
  shoot_report found;
  const double size = timeint_motion_size(ti) / ti->length;
  timeint_save(ti);
  *found_it = false;
  hc_status st = shoot_newton(ti->shoot, k, near * size, orbit_goal(ti), a->monitor, &found);
  if (shoot_found_no_orbit(st)) {
    ++a->failures;
    return HC_OK;
  }
  if (st != HC_OK) return st;
  *found_it = converges_to(a, &found, size);
  if (*found_it) return orbit_report(ti, k, TIMEINT_BY_SHOOTING, &found, r);
  timeint_restore(ti);
  return HC_OK;
}

/* The same for each k in turn whose return is less than half as far as those of all before. Not only the nearest: the
 * multiples of a cycle return as near as the cycle itself, and next to a period doubling there is an orbit of k
 * periods, now unstable, and one of 2 k. */
static hc_status try_orbits(approach *a, bool *found_it, timeint_result *r)
{
  double within = 2 * near * timeint_motion_size(a->ti);
  hc_status st = HC_OK;
  *found_it = false;
  for (int k = next_return(a, 0, within); k > 0 && st == HC_OK && !*found_it; k = next_return(a, k, within)) {
    within = distance_to_past(a, k);
    st = try_orbit(a, k, found_it, r);
  }
  return st;
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

/* Do neighbours drift apart, by more than the scatter of the batches' means (three standard errors)? */
static hc_status neighbours_drift_apart(timeint *ti, const hc_monitor *monitor, bool *yes, double *rate)
{
  double mean = 0, square = 0, leap = 0, one;
  for (int i = 0; i < ti->n; ++i) ti->separation[i] = i == SCALED_X ? separation : 0;
  for (int b = -1; b < BATCHES; ++b) { /* the first one only turns d into the direction of growth */
    double sum = 0;
    for (int i = 0; i < BATCH; ++i) {
      if (!hc_monitor_tick(monitor, (double)ti->periods / ti->how.max_periods)) return HC_INTERRUPTED;
      const double x = ti->y[SCALED_X], p = ti->y[SCALED_P];
      hc_status st = integrate_neighbours(ti, &one);
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

static hc_status report_aperiodic(timeint *ti, timeint_result *r)
{
  const shoot_report none = {.distance = INFINITY, .attainable = INFINITY, .multiplier = NAN};
  const double rate = r->lyapunov;
  hc_status st = orbit_report(ti, 1, TIMEINT_BY_MARCHING, &none, r);
  r->period_multiple = 0;
  r->lyapunov = rate;
  return st == HC_OK ? HC_APERIODIC : st;
}

/* Is the motion aperiodic? Asked once the transient has died out, if enough periods are left; then it is reported. */
static hc_status try_chaos(approach *a, bool *chaos, timeint_result *r)
{
  timeint *ti = a->ti;
  const bool died_out = ti->periods > fmax(LYAPUNOV_AFTER, FOLDS / (1 - ti->contraction));
  *chaos = false;
  if (!died_out || ti->periods + LYAPUNOV_PERIODS >= ti->how.max_periods) return HC_OK;
  hc_status st = neighbours_drift_apart(ti, a->monitor, chaos, &r->lyapunov);
  return st == HC_OK && *chaos ? report_aperiodic(ti, r) : st;
}

hc_status attract(timeint *ti, int first, const hc_monitor *monitor, timeint_result *r)
{
  approach a = {.ti = ti, .monitor = monitor};
  const transient_start start = ti->how.start;
  bool done;
  if (start == TRANSIENT_START_UP || start == TRANSIENT_START_DOWN) { /* the sweep has probably left it on its orbit */
    hc_status st = try_orbit(&a, 1, &done, r);
    if (st != HC_OK || done) return st;
  }
  for (int stretch = first; ti->periods < ti->how.max_periods - 1; stretch *= 2) {
    hc_status st = integrate_stretch(&a, stretch, &done);
    if (st != HC_OK) return st;
    if (done) {
      linear_regime_steady(ti, r);
      return HC_OK;
    }
    if ((st = try_orbits(&a, &done, r)) != HC_OK || done) return st;
    if ((st = try_chaos(&a, &done, r)) != HC_OK || done) return st;
    if (a.failures >= MOST_FAILURES) break;
  }
  return march_to_steady_state(ti, monitor, r);
}
