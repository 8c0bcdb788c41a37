/* march.c - the steady state by waiting for it.
 *
 * A period is marched after another: the first in the finest steps of CVODE (timeint_final_tolerance), to see how
 * much the state moves; the next ones in steps as coarse as that allows, and in finer ones as it moves less. Only in
 * the finest is the orbit judged (settle.h), and its period or k periods measured. */
#include <math.h>
#include <string.h>

#include "timeint/internal.h"

/* Coarse steps are 3 to 5 times as cheap, and lose nothing while the state is farther off than they put it: by up to
 * 250 times the tolerance a period, which adds up over 1/(1 - rho) periods to at least 1/sqrt(1 - rho) times that.
 * Hence drift sqrt(1 - rho)/1000. (A start on the orbit must not be thrown off it.) */
static const double coarsest = 1e-8, drift_over_tolerance = 1e3, refine_by = 0.1;
enum { STAY = 20 }; /* baselines at one tolerance at most, lest a scatter larger than thought keep it */

static void push(timeint *ti)
{
  double z[SCALED_MAX_STATES];
  timeint_point(ti, z);
  settle_push(ti->settle, z);
}

static hc_status march_one(timeint *ti, bool measured)
{
  hc_status st = timeint_period(ti, measured);
  if (st == HC_OK) push(ti);
  return st;
}

/* How a march is going. */
typedef struct progress {
  int since;          /* periods at this tolerance */
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
  p->since = 0;
  settle_restart(ti->settle); /* another tolerance has another fixed point */
  return timeint_set_tolerance(ti, tolerance);
}

static hc_status start(timeint *ti, progress *p)
{
  *p = (progress){.contraction = NAN, .amplitude = INFINITY};
  settle_start(ti->settle, ti->contraction);
  push(ti);
  return use_tolerance(ti, p, timeint_final_tolerance(ti));
}

/* After each period: coarser steps after the first, finer ones once the state moves too little for these. */
static hc_status adapt(timeint *ti, progress *p)
{
  const double allowed = coarsest_allowed(ti), finest = timeint_final_tolerance(ti);
  if (ti->periods == 1) return allowed > finest ? use_tolerance(ti, p, allowed) : HC_OK;
  bool far = allowed >= ti->tolerance && allowed > finest;
  if (far) p->contraction = settle_rate(ti->settle);
  if (ti->tolerance <= finest || (far && ++p->since < STAY * settle_baseline(ti->settle))) return HC_OK;
  return use_tolerance(ti, p, fmax(finest, refine_by * ti->tolerance));
}

/* The next k periods into *r, and how near the orbit they are. */
static hc_status measure_orbit(timeint *ti, int k, progress *p, timeint_result *r)
{
  measure_begin(&ti->measure, &ti->scaled);
  for (int i = 0; i < k; ++i) {
    hc_status st = march_one(ti, true);
    if (st != HC_OK) return st;
  }
  measure_report(&ti->measure, ti->model, ti->length, r);
  settle_estimate e = settle_judge(ti->settle, ti->how.tolerance * r->amplitude);
  r->closure = e.distance / r->amplitude;
  r->contraction = isnan(e.contraction) ? p->contraction : e.contraction;
  r->period_multiple = e.multiple;
  p->amplitude = r->amplitude;
  return HC_OK;
}

/* Is it worth measuring? `amplitude`: the best known; a guess will do, as the measured one decides. */
static int seems_settled(const timeint *ti, double amplitude)
{
  if (ti->tolerance > timeint_final_tolerance(ti)) return 0;
  const double goal = ti->how.tolerance * amplitude;
  if (!(settle_drift(ti->settle) <= 2 * goal)) return 0; /* cheap, and necessary */
  return settle_judge(ti->settle, goal).multiple;
}

hc_status timeint_march(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  const int most = ti->how.max_periods;
  progress p;
  hc_status st = start(ti, &p);
  r->method = TIMEINT_BY_MARCHING;
  while (st == HC_OK && ti->periods < most - 1) {
    if (!hc_monitor_tick(monitor, (double)ti->periods / most)) return HC_INTERRUPTED;
    if ((st = march_one(ti, false)) != HC_OK || (st = adapt(ti, &p)) != HC_OK) return st;
    int k = seems_settled(ti, fmin(p.amplitude, timeint_size(ti)));
    if (k == 0 || ti->periods + k > most) continue;
    if ((st = measure_orbit(ti, k, &p, r)) != HC_OK || r->period_multiple > 0) return st;
  }
  if (st == HC_OK && ti->periods < most) st = measure_orbit(ti, 1, &p, r);
  return st == HC_OK && r->period_multiple == 0 ? HC_NOT_SETTLED : st;
}
