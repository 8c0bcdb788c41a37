/* scout.c - see scout.h. */
#include "timeint/scout.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "timeint/confirm.h"
#include "timeint/linear_regime.h"
#include "timeint/orbit.h"
#include "timeint/timeint_private.h"

static const double scout_tolerance = 1e-12;
static const double near = 0.02; /* [size] of the scout's orbit from the one CVODE finds by itself */

hc_status scout_new(timeint *ti)
{
  if (!ti->how.scout || ti->how.method == TRANSIENT_METHOD_CLOSED_FORM) return HC_OK;
  transient_settings how = ti->how;
  how.law = TRANSIENT_LAW_EXACT;
  how.method = TRANSIENT_METHOD_CLOSED_FORM;
  how.scout = how.richardson = false;
  how.tolerance = fmin(how.tolerance, scout_tolerance);
  hc_status st = timeint_new(ti->model, &how, &ti->scout);
  return st == HC_OK ? confirm_new(ti, &ti->confirm) : st;
}

/* What a result says of its orbit. */
static shoot_report report_of(const timeint_result *r)
{
  return (shoot_report){
      .distance = INFINITY, .multiplier = r->multiplier_re + I * r->multiplier_im, .free_sliders = r->free_sliders};
}

/* By CVODE alone, next to the scout's orbit at ti->y; stable, unless an orbit was asked for whatever its stability. */
static hc_status shoot_beside(timeint *ti, int k, bool stable, const hc_monitor *monitor, timeint_result *r)
{
  shoot_report found;
  const double size = timeint_motion_size(ti) / ti->length;
  hc_status st = shoot_newton(ti->shoot, k, near * size, orbit_goal(ti), monitor, &found);
  if (st == HC_OK && (!(found.moved <= near * size) || (stable && !(cabs(found.multiplier) < 1))))
    st = HC_NOT_CONVERGED;
  return st == HC_OK ? orbit_report(ti, k, TIMEINT_BY_SHOOTING, &found, r) : st;
}

static hc_status confirm_scouted(timeint *ti, const timeint_result *scouted, bool stable, const hc_monitor *monitor,
                                 timeint_result *r)
{
  const int k = scouted->period_multiple;
  shoot_report found = report_of(scouted);
  if (linear_regime_is_final(ti)) {
    linear_regime_steady(ti, r);
    return HC_OK;
  }
  hc_status st = confirm_orbit(ti->confirm, k, monitor, &found, r);
  if (shoot_found_no_orbit(st)) st = shoot_beside(ti, k, stable, monitor, r);
  return st;
}

/* One period of CVODE's where the scout found none that repeats. */
static hc_status report_unsettled(timeint *ti, const timeint_result *scouted, hc_status why, timeint_result *r)
{
  const shoot_report none = {.distance = INFINITY, .multiplier = NAN};
  hc_status st = orbit_report(ti, 1, TIMEINT_BY_MARCHING, &none, r);
  r->period_multiple = 0;
  r->lyapunov = scouted->lyapunov;
  r->closure = scouted->closure;
  return st == HC_OK ? why : st;
}

hc_status scout_steady(timeint *ti, int orbit_of, const double *state, const hc_monitor *monitor, timeint_result *r,
                       bool *done)
{
  timeint_result scouted;
  double *seen = ti->scout_state;
  *done = true;
  memcpy(seen, state, sizeof *seen * (size_t)ti->n);
  hc_status st = orbit_of > 0 ? timeint_orbit(ti->scout, ti->omega, orbit_of, seen, monitor, &scouted)
                              : timeint_steady(ti->scout, ti->omega, seen, monitor, &scouted);
  r->scouted = scouted.periods;
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return st;
  if (st == HC_OK || st == HC_NOT_SETTLED || st == HC_APERIODIC) {
    const hc_status why = st;
    st = timeint_begin(ti, ti->omega, seen);
    if (st == HC_OK) st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
    r->left_orbit = scouted.left_orbit;
    if (st == HC_OK && why == HC_OK) st = confirm_scouted(ti, &scouted, orbit_of == 0, monitor, r);
    else if (st == HC_OK) st = report_unsettled(ti, &scouted, why, r);
    if (!shoot_found_no_orbit(st) || why != HC_OK) return st;
  }
  *done = false;
  r->left_orbit = false;
  return timeint_begin(ti, ti->omega, state);
}
