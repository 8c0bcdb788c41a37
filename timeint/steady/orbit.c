/* orbit.c - see orbit.h. */
#include "timeint/steady/orbit.h"

#include <string.h>

#include "timeint/steady/timeint_private.h"

/* [size] A state that returns as near is the same but for integration errors. */
static const double same_state = 1e-6;

double orbit_goal(const timeint *ti) { return fmax(ti->how.tolerance * timeint_scaled_size(ti), 100 * ti->tolerance); }

hc_status orbit_find(timeint *ti, int k, double reach, const hc_monitor *monitor, timeint_method *method,
                     shoot_report *found)
{
  *method = TIMEINT_BY_SHOOTING;
  hc_status st = shoot_newton(ti->shoot, k, reach, orbit_goal(ti), monitor, found);
  if (!shoot_found_no_orbit(st)) return st;
  *method = TIMEINT_BY_ANDERSON;
  hc_status second = shoot_anderson(ti->shoot, k, orbit_goal(ti), monitor, found);
  return second == HC_OK || second == HC_INTERRUPTED ? second : st;
}

/* The number of periods after which an orbit of k repeats itself: the smallest divisor d of k with returned[d] =
 * |F^d(z) - z| as small as integration errors leave it. */
static int shortest_period(int k, double size, const double *returned)
{
  for (int d = 1; d < k; ++d)
    if (k % d == 0 && returned[d] <= same_state * size) return d;
  return k;
}

static double relative_closure(const timeint *ti, double distance, double amplitude)
{
  if (amplitude > 0) return distance * timeint_response_unit(ti, 0) / amplitude;
  return distance > 0 ? INFINITY : 0;
}

/* True if ti->y lies on the orbit of k periods that was measured last: the motion is then where these ended. */
static bool is_measured(timeint *ti, int k)
{
  double apart = 0;
  if (ti->last.k != k || ti->last.omega != ti->omega) return false;
  for (int i = 0; i < ti->n; ++i) {
    const double there = ti->last.end[i] * ti->last.length / ti->length;
    apart = fmax(apart, fabs(ti->y[i] - there) / ti->sizes.of[i]);
  }
  if (!(apart <= orbit_goal(ti))) return false;
  timeint_use_length(ti, ti->last.length);
  memcpy(ti->y, ti->last.end, sizeof *ti->y * (size_t)ti->n);
  return true;
}

static void report_measured(timeint *ti, timeint_result *r)
{
  timeint_report(ti, 0, r);
  r->free_sliders = measure_resting_sliders(&ti->measure);
  ti->measured = true;
}

hc_status orbit_measure(timeint *ti, int k, timeint_result *r)
{
  double returned[SETTLE_MAX_MULTIPLE + 1];
  if (is_measured(ti, k)) {
    report_measured(ti, r);
    r->switches = ti->last.switches;
    r->period_multiple = ti->last.returns;
    return HC_OK;
  }
  const long transitions = integrate_transitions(ti->in);
  const size_t moving = 2 * (size_t)ti->n_dof;
  double *began = ti->began;
  memcpy(began, ti->y, moving * sizeof *began);
  measure_begin(&ti->measure, &ti->scaled);
  for (int i = 0; i < k; ++i) {
    hc_status st = timeint_period(ti, true);
    if (st != HC_OK) return st;
    returned[i + 1] = 0;
    for (size_t c = 0; c < moving; ++c)
      returned[i + 1] = fmax(returned[i + 1], fabs(ti->y[c] - began[c]) / ti->sizes.of[c]);
  }
  report_measured(ti, r);
  r->switches = (int)(integrate_transitions(ti->in) - transitions);
  r->period_multiple = shortest_period(k, timeint_size(ti) / ti->length, returned);
  if (ti->slowed) timeint_note_measured(ti, k, ti->y, r->switches, r->period_multiple);
  return HC_OK;
}

void orbit_fill(const timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r)
{
  r->method = method;
  r->closure = relative_closure(ti, found->distance, r->amplitude);
  r->attainable = relative_closure(ti, found->attainable, r->amplitude);
  r->multiplier = cabs(found->multiplier);
  r->multiplier_re = creal(found->multiplier);
  r->multiplier_im = cimag(found->multiplier);
  r->contraction = pow(r->multiplier, 1.0 / k);
  if (found->free_sliders > r->free_sliders) r->free_sliders = found->free_sliders;
}

hc_status orbit_report(timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r)
{
  hc_status st = orbit_measure(ti, k, r);
  if (st == HC_OK) orbit_fill(ti, k, method, found, r);
  return st;
}

hc_status orbit_watch(timeint *ti)
{
  enum { PERIODS = 64 }; /* of a motion near a torus or in chaos some tenths of the range are missing after ten */
  const int before = ti->periods;
  hc_status st = HC_OK;
  timeint_save(ti);
  for (int k = 0; k < PERIODS && st == HC_OK; ++k) {
    measure_begin(&ti->measure, &ti->scaled);
    st = timeint_period(ti, true);
    for (int i = 0; i < ti->base->n_responses && st == HC_OK; ++i) {
      const response_measure *of = &ti->measure.response[i];
      const double amplitude = motion_amplitude(of->max, of->min) * ti->length;
      ti->window.low[i] = k ? fmin(ti->window.low[i], amplitude) : amplitude;
      ti->window.high[i] = k ? fmax(ti->window.high[i], amplitude) : amplitude;
    }
  }
  ti->window.periods = st == HC_OK ? PERIODS : 0;
  ti->periods = before;
  timeint_restore(ti);
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK; /* what the motion is does not depend on it */
}

hc_status orbit_report_none(timeint *ti, hc_status why, timeint_result *r)
{
  const shoot_report none = {.distance = INFINITY, .attainable = INFINITY, .multiplier = NAN};
  hc_status st = why == HC_APERIODIC ? orbit_watch(ti) : HC_OK;
  if (st == HC_OK) st = orbit_report(ti, 1, TIMEINT_BY_MARCHING, &none, r);
  r->period_multiple = 0;
  return st == HC_OK ? why : st;
}
