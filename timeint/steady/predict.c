/* predict.c - timeint_predict of steady.h. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "timeint/steady/closed_form_start.h"
#include "timeint/steady/confirm.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/timeint_private.h"

static const double rounding = 16 * DBL_EPSILON; /* [amplitude] of a closed form */
static const double enough = 1e-4; /* [change] to which half the regularisation's orbit need be known: a second-order
                                       error of the amplitude is far smaller than the sliders' first-order change */
static const double rough = 0.25;  /* [change] to which it may be known where steps contract no more */
static const double per_change = 1e-7; /* that tolerance, relative to the change: it scatters by 250 times itself */

static periodic_motion predict_motion(const timeint_result *r)
{
  periodic_motion m = {.amplitude = r->amplitude,
                       .max = r->max,
                       .min = r->min,
                       .mean = r->mean,
                       .harmonic_1 = r->harmonic_1,
                       .mean_free = r->free_sliders > 0};
  memcpy(m.samples, r->wave, sizeof m.samples);
  return m;
}

/* The distance between the measures of two results, as an error of one of them [length]. */
static motion_error predict_change(const timeint_result *one, const timeint_result *other)
{
  const periodic_motion a = predict_motion(one), b = predict_motion(other);
  const motion_distance d = motion_between(&a, &b);
  const double least = MOTION_LEAST_SHARE * d.waveform;
  return (motion_error){fmax(d.amplitude, least), fmax(d.harmonic_1, least), d.waveform};
}

static motion_error all(double e) { return (motion_error){e, e, e}; }

/* ti->closed_form_state becomes a point on the closed form's orbit next to `state` [model], if it is not remembered. */
static hc_status find_closed_form(timeint *ti, double omega, int k, const double *state, const hc_monitor *monitor)
{
  const double *start = NULL;
  timeint_result unused;
  closed_start_predictions(ti, state, &start);
  memcpy(ti->closed_form_state, start ? start : state, (size_t)ti->n * sizeof *state);
  return start ? HC_OK : timeint_orbit(ti->closed_form, omega, k, ti->closed_form_state, monitor, &unused);
}

/* The orbit with half the regularisation, from `state`, where the motion is, on the orbit with all of it: half way to
 * the exact law's, which has none. *r: of the orbit so far, then of that one. */
static hc_status predict_halved(timeint *ti, const double *state, int k, const hc_monitor *monitor, timeint_result *r)
{
  shoot_report found = {.distance = INFINITY, .multiplier = NAN};
  double goal = orbit_goal(ti);
  if (ti->closed_form) {
    hc_status st = find_closed_form(ti, ti->omega, k, state, monitor);
    if (st != HC_OK) return st;
    timeint_take_state(ti, ti->closed_form_state, ti->point[0]);
    const double change = timeint_farthest(ti, ti->point[0], ti->y);
    for (int i = 0; i < ti->n; ++i) {
      const double apart = ti->point[0][i] - ti->y[i];
      ti->y[i] += 0.5 * apart;
    }
    goal = fmax(goal, enough * change);
    st = timeint_set_tolerance(ti, fmin(fmax(per_change * change, timeint_final_tolerance(ti)), CONFIRM_COARSEST));
    if (st == HC_OK) st = confirm_orbit(ti, k, goal, 0, monitor, &found, r);
    if (st == HC_NOT_CONVERGED && found.distance <= rough * change) /* a matrix by CVODES costs some 50 periods */
      st = confirm_orbit(ti, k, rough * change, 0, monitor, &found, r);
    if (!shoot_found_no_orbit(st)) return st;
  }
  hc_status st = shoot_newton(ti->shoot, k, timeint_size(ti) / ti->length, goal, monitor, &found);
  return st == HC_OK ? orbit_report(ti, k, TIMEINT_BY_SHOOTING, &found, r) : st;
}

/* out[n]: twice the change of each response by half the regularisation; untouched if there is no such orbit. */
static hc_status regularisation(timeint *ti, const double *state, const hc_monitor *monitor, int n,
                                const timeint_result *r, motion_error *out)
{
  const double rho = ti->how.regularisation;
  timeint_result half = *r;
  hc_status st = timeint_begin(ti, r->omega, state);
  if (st != HC_OK) return st;
  timeint_regularise(ti, 0.5 * rho);
  st = predict_halved(ti, state, r->period_multiple, monitor, &half);
  for (int i = 0; i < n && st == HC_OK; ++i) {
    if (i > 0) st = timeint_response(ti, i, &half);
    const motion_error e = predict_change(&r[i], &half);
    if (st == HC_OK) out[i] = (motion_error){2 * e.amplitude, 2 * e.harmonic_1, 2 * e.waveform};
  }
  timeint_regularise(ti, rho);
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK;
}

/* The part by the regularisation, out[n]; NaN: not known. */
static hc_status regularised_part(timeint *ti, const double *state, const hc_monitor *monitor, int n,
                                  const timeint_result *r, motion_error *out)
{
  const double *start;
  motion_error *known = ti->closed_form ? closed_start_predictions(ti, state, &start) : NULL;
  for (int i = 0; i < n; ++i) out[i] = known ? known[i] : all(NAN);
  if (out[n - 1].amplitude >= 0) return HC_OK;
  hc_status st = regularisation(ti, state, monitor, n, r, out);
  for (int i = 0; i < n && known; ++i) known[i] = out[i];
  return st;
}

/* Errors of slowed modes and the regularisation, out[n]: by the closed form's orbits without and with slowed modes. */
static hc_status slowed_part(timeint *ti, const double *state, const hc_monitor *monitor, int n,
                             const timeint_result *r, motion_error *out)
{
  timeint *closed = ti->closed_form;
  for (int i = 0; i < n; ++i) out[i] = all(NAN);
  if (!closed || !closed->slowed) return HC_OK;
  hc_status st = find_closed_form(ti, r->omega, r->period_multiple, state, monitor);
  if (st == HC_OK) st = timeint_begin(closed, r->omega, ti->closed_form_state);
  /* What r[n], CVODE's results of the first n responses with slowed modes, are off by: the distance of the orbit of k
   * periods through closed->y, which has none, from that with slowed modes, closed->slowed, and that one's from r: what
   * integration and the regularisation cost. out[n]. Errors of orbits. */
  if (st == HC_OK) {
    const int k = r->period_multiple;
    timeint *slowed = closed->slowed;
    timeint_result here, there;
    timeint_get_state(closed, closed->point[0]);
    st = orbit_measure(closed, k, &here);
    if (st == HC_OK) st = timeint_begin(slowed, closed->omega, closed->point[0]);
    if (st == HC_OK) st = confirm_slowed(closed, k, monitor);
    if (st == HC_OK) st = orbit_measure(slowed, k, &there);
    for (int i = 0; i < n && st == HC_OK; ++i) {
      st = timeint_response(closed, i, &here);
      if (st == HC_OK) st = timeint_response(slowed, i, &there);
      if (st != HC_OK) break;
      const motion_error slowed_by = predict_change(&here, &there), rest = predict_change(&there, &r[i]);
      out[i] = (motion_error){slowed_by.amplitude + rest.amplitude, slowed_by.harmonic_1 + rest.harmonic_1,
                              slowed_by.waveform + rest.waveform};
    }
  }
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK;
}

hc_status timeint_predict(timeint *ti, const double *state, const hc_monitor *monitor, int n, timeint_result *r)
{
  if (r->period_multiple < 1) return HC_OK;
  for (int i = 0; i < n; ++i) r[i].predicted = all((r[i].closure + r[i].attainable + rounding) * r[i].amplitude);
  if (r->method == TIMEINT_BY_CLOSED_FORM) return HC_OK;
  const bool slows = isfinite(ti->fastest);
  if (!slows && ti->how.law == TRANSIENT_LAW_EXACT) return HC_OK;
  motion_error *more = calloc((size_t)n, sizeof *more);
  if (!more) return HC_NO_MEMORY;
  const hc_monitor *before = timeint_hear(ti, monitor);
  hc_status st = (slows ? slowed_part : regularised_part)(ti, state, monitor, n, r, more);
  timeint_hear(ti, before);
  for (int i = 0; i < n; ++i) {
    r[i].predicted.amplitude += more[i].amplitude;
    r[i].predicted.harmonic_1 += more[i].harmonic_1;
    r[i].predicted.waveform += more[i].waveform;
  }
  free(more);
  return st;
}
