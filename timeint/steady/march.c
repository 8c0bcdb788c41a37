/* march.c - see march.h. The first period is integrated with the finest tolerance of CVODE
 * (timeint_final_tolerance), to see how much the state moves; the next ones with a tolerance as coarse as that
 * allows, and a finer one as the state moves less. Only with the finest is the orbit judged (settle.h), and its
 * period or k periods measured. */
#include "timeint/steady/march.h"

#include <math.h>

#include "timeint/steady/timeint_private.h"

/* Coarse steps cost a third to a fifth, and lose nothing while the state is farther from the orbit than their error
 * puts it: up to 250 times the tolerance a period, which adds up over 1/(1 - rho) periods to at least 1/sqrt(1 -
 * rho) times that. Hence drift sqrt(1 - rho)/1000: a start on the orbit keeps the finest tolerance and stays on it. */
static const double coarsest = 1e-8, drift_over_tolerance = 1e3, refine_by = 0.1;
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

/* How a march is going. */
typedef struct march {
  int periods;        /* at this tolerance */
  double contraction; /* measured while the drift was last far above the scatter, NaN before */
  double amplitude;   /* of the last measurement, INFINITY before; the size of the state also counts its mean */
} march;

/* The coarsest steps that a state moving as this one does allows. */
static double coarsest_allowed(const timeint *ti)
{
  double moves = settle_drift(ti->settle) / timeint_size(ti) * sqrt(1 - ti->contraction);
  return fmax(fmin(moves / drift_over_tolerance, coarsest), timeint_final_tolerance(ti));
}

static hc_status use_tolerance(timeint *ti, march *m, double tolerance)
{
  m->periods = 0;
  settle_restart(ti->settle); /* another tolerance has another fixed point */
  return timeint_set_tolerance(ti, tolerance);
}

static hc_status start(timeint *ti, march *m)
{
  *m = (march){.contraction = NAN, .amplitude = INFINITY};
  settle_start(ti->settle, ti->contraction);
  push(ti);
  return use_tolerance(ti, m, timeint_final_tolerance(ti));
}

/* After each period: a coarser tolerance after the first, a finer one once the state moves too little for the
 * present. */
static hc_status adapt_tolerance(timeint *ti, march *m)
{
  const double allowed = coarsest_allowed(ti), finest = timeint_final_tolerance(ti);
  if (ti->periods == 1) return allowed > finest ? use_tolerance(ti, m, allowed) : HC_OK;
  bool far = allowed >= ti->tolerance && allowed > finest;
  if (far) m->contraction = settle_rate(ti->settle);
  if (ti->tolerance <= finest || (far && ++m->periods < MOST_BASELINES * settle_baseline(ti->settle))) return HC_OK;
  return use_tolerance(ti, m, fmax(finest, refine_by * ti->tolerance));
}

/* The next k periods into *r, and how near the orbit they are. */
static hc_status measure_orbit(timeint *ti, int k, march *m, timeint_result *r)
{
  measure_begin(&ti->measure, &ti->scaled);
  for (int i = 0; i < k; ++i) {
    hc_status st = one_period(ti, true);
    if (st != HC_OK) return st;
  }
  measure_report(&ti->measure, ti->model, 0, ti->length, r);
  r->free_sliders = measure_resting_sliders(&ti->measure);
  ti->measured = true;
  settle_estimate e = settle_judge(ti->settle, ti->how.tolerance * r->amplitude);
  r->closure = e.distance / r->amplitude;
  r->contraction = isnan(e.contraction) ? m->contraction : e.contraction;
  r->period_multiple = e.multiple;
  m->amplitude = r->amplitude;
  return HC_OK;
}

/* k if the states seem to have settled to a cycle of k periods, to be measured; else 0. `amplitude`: the best known; an
 * estimate suffices, since measure_orbit judges by the measured one. */
static int seems_settled(const timeint *ti, double amplitude)
{
  if (ti->tolerance > timeint_final_tolerance(ti)) return 0;
  const double goal = ti->how.tolerance * amplitude;
  if (!(settle_drift(ti->settle) <= 2 * goal)) return 0; /* a necessary condition that costs little */
  return settle_judge(ti->settle, goal).multiple;
}

hc_status march_to_steady_state(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  const int most = ti->how.max_periods;
  march m;
  hc_status st = start(ti, &m);
  r->method = TIMEINT_BY_MARCHING;
  while (st == HC_OK && ti->periods < most - 1) {
    if (!hc_monitor_tick(monitor, (double)ti->periods / most)) return HC_INTERRUPTED;
    if ((st = one_period(ti, false)) != HC_OK || (st = adapt_tolerance(ti, &m)) != HC_OK) return st;
    int k = seems_settled(ti, fmin(m.amplitude, timeint_size(ti)));
    if (k == 0 || ti->periods + k > most) continue;
    if ((st = measure_orbit(ti, k, &m, r)) != HC_OK || r->period_multiple > 0) return st;
  }
  if (st == HC_OK && ti->periods < most) st = measure_orbit(ti, 1, &m, r);
  return st == HC_OK && r->period_multiple == 0 ? HC_NOT_SETTLED : st;
}
