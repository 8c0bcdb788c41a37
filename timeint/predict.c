/* predict.c - timeint_predict of steady.h. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "timeint/confirm.h"
#include "timeint/linear_regime.h"
#include "timeint/orbit.h"
#include "timeint/scout.h"
#include "timeint/timeint_private.h"

static const double rounding = 16 * DBL_EPSILON; /* [amplitude] of a closed form */
static const double enough = 1e-3;   /* [change] to which half the regularisation's orbit need be known: a second-order
                                       error of the amplitude is far smaller than the sliders' first-order change */
static const double coarsest = 1e-8; /* CVODE's tolerance for it */
static const double per_change = 1e-6; /* that tolerance, relative to the change: it scatters by 250 times itself */

/* Of the waveform's change: amplitude and first harmonic may agree by chance. */
static const double least_share = 0.04;

static periodic_motion motion_of(const timeint_result *r)
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

static motion_error all(double e) { return (motion_error){e, e, e}; }

/* The orbit with half the regularisation, from the state on the orbit with all of it: half way to the scout's, which
 * has none. *r: of the orbit so far, then of that one. */
static hc_status halve(timeint *ti, int k, const hc_monitor *monitor, timeint_result *r)
{
  shoot_report found = {.distance = INFINITY, .multiplier = NAN};
  double goal = orbit_goal(ti);
  if (ti->scout) {
    timeint_result unused;
    double change = 0;
    timeint_get_state(ti, ti->scout_state);
    hc_status st = timeint_orbit(ti->scout, ti->omega, k, ti->scout_state, monitor, &unused);
    if (st != HC_OK) return st;
    timeint_take_state(ti, ti->scout_state, ti->point[0]);
    for (int i = 0; i < ti->n; ++i) {
      const double apart = ti->point[0][i] - ti->y[i];
      change = fmax(change, fabs(apart));
      ti->y[i] += 0.5 * apart;
    }
    goal = fmax(goal, enough * change);
    st = timeint_set_tolerance(ti, fmin(fmax(per_change * change, timeint_final_tolerance(ti)), coarsest));
    if (st == HC_OK) st = confirm_orbit(ti->confirm, k, goal, monitor, &found, r);
    if (!shoot_found_no_orbit(st)) return st;
  }
  hc_status st = shoot_newton(ti->shoot, k, timeint_size(ti) / ti->length, goal, monitor, &found);
  return st == HC_OK ? orbit_report(ti, k, TIMEINT_BY_SHOOTING, &found, r) : st;
}

/* Twice the change by half the regularisation; NaN if there is no such orbit. */
static hc_status regularisation(timeint *ti, const double *state, const hc_monitor *monitor, const timeint_result *r,
                                motion_error *out)
{
  const double rho = ti->how.regularisation;
  timeint_result half = *r;
  *out = all(NAN);
  hc_status st = timeint_begin(ti, r->omega, state);
  if (st != HC_OK) return st;
  ti->how.regularisation = 0.5 * rho;
  scaled_make(&ti->scaled, ti->model, &ti->how, ti->omega, ti->length);
  st = halve(ti, r->period_multiple, monitor, &half);
  ti->how.regularisation = rho;
  scaled_make(&ti->scaled, ti->model, &ti->how, ti->omega, ti->length);
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
  if (st != HC_OK) return HC_OK;
  const periodic_motion whole = motion_of(r), less = motion_of(&half);
  const motion_distance d = motion_between(&whole, &less);
  const double least = least_share * d.waveform;
  *out = (motion_error){2 * fmax(d.amplitude, least), 2 * fmax(d.harmonic_1, least), 2 * d.waveform};
  return HC_OK;
}

hc_status timeint_predict(timeint *ti, const double *state, const hc_monitor *monitor, timeint_result *r)
{
  if (r->period_multiple < 1) return HC_OK;
  const double integration = (r->closure + r->attainable + rounding) * r->amplitude;
  r->predicted = all(integration);
  if (r->method == TIMEINT_BY_CLOSED_FORM || ti->how.law == TRANSIENT_LAW_EXACT) return HC_OK;
  motion_error more = all(r->regularisation_error * r->amplitude), *known = NULL;
  hc_status st = HC_OK;
  if (!ti->how.richardson) {
    if (ti->scout) known = scout_prediction(ti, state);
    if (known && known->amplitude >= 0) return r->predicted = *known, HC_OK;
    st = regularisation(ti, state, monitor, r, &more);
  }
  r->predicted.amplitude += more.amplitude;
  r->predicted.harmonic_1 += more.harmonic_1;
  r->predicted.waveform += more.waveform;
  if (known) *known = r->predicted;
  return st;
}
