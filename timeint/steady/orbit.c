/* orbit.c - see orbit.h. */
#include "timeint/steady/orbit.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "timeint/steady/timeint_private.h"

static const double same_state = 1e-6; /* [size] a state that returns as near is the same, but for integration errors */

double orbit_goal(const timeint *ti)
{
  return fmax(ti->how.tolerance * (timeint_motion_size(ti) / ti->length), 100 * ti->tolerance);
}

/* CVODE's, and the rounding of some thousand steps; in closed form of some ten. */
double orbit_scatter(const timeint *ti, int k)
{
  if (ti->how.method == TRANSIENT_METHOD_CLOSED_FORM) return k * 200 * DBL_EPSILON;
  return k * fmax(integrate_scatter(ti->in) * ti->tolerance, 2e4 * DBL_EPSILON);
}

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
  if (amplitude > 0) return distance * ti->length / amplitude;
  return distance > 0 ? INFINITY : 0;
}

hc_status orbit_measure(timeint *ti, int k, timeint_result *r)
{
  double returned[SETTLE_MAX_MULTIPLE + 1];
  const long transitions = integrate_transitions(ti->in);
  const size_t moving = 2 * (size_t)ti->n_dof;
  double *began = ti->began;
  memcpy(began, ti->y, moving * sizeof *began);
  measure_begin(&ti->measure, &ti->scaled);
  for (int i = 0; i < k; ++i) {
    hc_status st = timeint_period(ti, true);
    if (st != HC_OK) return st;
    returned[i + 1] = 0;
    for (size_t c = 0; c < moving; ++c) returned[i + 1] = fmax(returned[i + 1], fabs(ti->y[c] - began[c]));
  }
  measure_report(&ti->measure, ti->model, 0, ti->length, r);
  r->free_sliders = measure_resting_sliders(&ti->measure);
  ti->measured = true;
  r->switches = (int)(integrate_transitions(ti->in) - transitions);
  r->period_multiple = shortest_period(k, timeint_size(ti) / ti->length, returned);
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

hc_status timeint_response(timeint *ti, int i, timeint_result *r)
{
  if (i < 0 || i >= scaled_n_responses(&ti->scaled)) return HC_BAD_INPUT;
  const double amplitude = r->amplitude;
  if (!ti->measured) {
    timeint_result again = *r;
    hc_status st = orbit_measure(ti, r->period_multiple > 0 ? r->period_multiple : 1, &again);
    if (st != HC_OK) return st;
  }
  measure_report(&ti->measure, ti->model, i, ti->length, r);
  r->closure *= amplitude / r->amplitude; /* they are relative to it */
  r->attainable *= amplitude / r->amplitude;
  return HC_OK;
}
