/* steady.c - see steady.h. With a scout (scout.h) the way is its own, and CVODE confirms where it leads. Without, or
 * where that fails, in the order of what they cost:
 *     1. no contact changes its state from here on: the closed form (linear_regime.h)
 *     2. Newton on the period map, or where it fails Anderson's acceleration of it (orbit.h)
 *     3. a stretch of periods, longer each time, and again from 1 (attract.h)
 *     4. period after period to the end (march.h), which is also what transient.steady_state: march asks for */
#include "timeint/steady/steady.h"

#include <math.h>
#include <string.h>

#include "timeint/steady/attract.h"
#include "timeint/steady/linear_regime.h"
#include "timeint/steady/march.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/richardson.h"
#include "timeint/steady/scout.h"
#include "timeint/steady/timeint_private.h"

/* [size] With one harmonic an HBM orbit is some ten percent of the motion off; an orbit farther away is another. */
static const double reach_from_hbm = 0.3;
static const double next_to = 0.5;       /* [size] shooting: an orbit farther from its start is not next to it */
static const double perturbation = 1e-3; /* [size] off an unstable orbit, in the direction in which it is left */
enum { FIRST_STRETCH = 8, STRETCH_FROM_UNSTABLE = 32 }; /* periods before the first look for an orbit (attract.h) */

const char *timeint_method_name(timeint_method method)
{
  switch (method) {
  case TIMEINT_BY_CLOSED_FORM: return "closed_form";
  case TIMEINT_BY_SHOOTING: return "shooting";
  case TIMEINT_BY_ANDERSON: return "anderson";
  case TIMEINT_BY_MARCHING: return "march";
  }
  return "unknown";
}

int timeint_stability(const timeint_result *r)
{
  const double border = 1e-9;
  if (r->multiplier < 1 - border) return 1;
  return r->multiplier > 1 + border ? -1 : 0;
}

static void clear_result(timeint_result *r, double omega)
{
  memset(r, 0, sizeof *r);
  r->omega = omega;
  r->scout_switches = -1;
  r->amplitude = r->max = r->min = r->rms = r->mean = r->a1 = r->b1 = r->harmonic_1 = r->closure = r->attainable =
      r->contraction = NAN;
  r->multiplier = r->multiplier_re = r->multiplier_im = r->lyapunov = r->second_frequency = r->regularisation_error =
      NAN;
  r->predicted = (motion_error){NAN, NAN, NAN};
  for (int i = 0; i < TIMEINT_WAVE; ++i) r->wave[i] = NAN;
}

static void fill_counts(const timeint *ti, timeint_result *r)
{
  r->periods = ti->periods;
  r->steps = integrate_steps(ti->in) - ti->steps0;
  r->rhs = integrate_rhs(ti->in) - ti->rhs0;
  r->cvode_flag = integrate_flag(ti->in);
}

/* In units of length. */
static double scaled_size(const timeint *ti) { return timeint_motion_size(ti) / ti->length; }

/* The orbit of k periods next to the state, stable or not. */
static hc_status to_nearest_orbit(timeint *ti, int k, const hc_monitor *monitor, timeint_result *r)
{
  timeint_method method;
  shoot_report found;
  if (linear_regime_is_final(ti)) {
    linear_regime_steady(ti, r);
    return HC_OK;
  }
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  const double size = scaled_size(ti);
  if (st == HC_OK) st = orbit_find(ti, k, reach_from_hbm * size, monitor, &method, &found);
  /* an orbit, but not the one next to the start */
  if (st == HC_OK && !(found.moved <= next_to * size)) st = HC_NOT_CONVERGED;
  return st == HC_OK ? orbit_report(ti, k, method, &found, r) : st;
}

/* From an unstable orbit at ti->y, found next to the saved state, where the motion began: back to that state, and a
 * small step in the direction in which neighbours leave the orbit, to the side the state is on. */
static void leave_unstable_orbit(timeint *ti)
{
  const double size = timeint_size(ti) / ti->length, *began = ti->saved, *direction = ti->direction;
  double along = 0;
  shoot_direction(ti->shoot, ti->direction);
  for (int i = 0; i < ti->n; ++i) along += direction[i] * (began[i] - ti->y[i]);
  const double step = (along < 0 ? -perturbation : perturbation) * size;
  for (int i = 0; i < ti->n; ++i) ti->y[i] = began[i] + step * direction[i];
}

/* From next to an orbit: that one, if it is stable, else where the motion goes from there. */
static hc_status from_orbit(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  timeint_method method;
  shoot_report found;
  const double size = scaled_size(ti);
  timeint_save(ti);
  hc_status st = orbit_find(ti, 1, reach_from_hbm * size, monitor, &method, &found);
  if (shoot_found_no_orbit(st)) return attract(ti, FIRST_STRETCH, monitor, r);
  if (st != HC_OK) return st;
  if (!(found.moved <= reach_from_hbm * size)) { /* another orbit: the motion decides whether it goes there */
    timeint_restore(ti);
    return attract(ti, FIRST_STRETCH, monitor, r);
  }
  if (cabs(found.multiplier) < 1) return orbit_report(ti, 1, method, &found, r);
  leave_unstable_orbit(ti);
  r->left_orbit = true;
  return attract(ti, STRETCH_FROM_UNSTABLE, monitor, r);
}

static hc_status to_attractor(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  if (linear_regime_is_final(ti)) {
    linear_regime_steady(ti, r);
    return HC_OK;
  }
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  if (st != HC_OK) return st;
  return ti->how.start == TRANSIENT_START_HBM ? from_orbit(ti, monitor, r) : attract(ti, FIRST_STRETCH, monitor, r);
}

static hc_status by_itself(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  switch (ti->how.steady) {
  case TRANSIENT_STEADY_MARCH: return march_to_steady_state(ti, monitor, r);
  case TRANSIENT_STEADY_SHOOTING: return to_nearest_orbit(ti, 1, monitor, r);
  default: return to_attractor(ti, monitor, r);
  }
}

hc_status timeint_steady(timeint *ti, double omega, double *state, const hc_monitor *monitor, timeint_result *result)
{
  bool done = false;
  clear_result(result, omega);
  hc_status st = timeint_begin(ti, omega, state);
  if (st != HC_OK) return st;
  const hc_monitor *before = timeint_hear(ti, monitor);
  if (ti->scout && ti->how.steady != TRANSIENT_STEADY_MARCH) st = scout_steady(ti, 0, state, monitor, result, &done);
  if (st == HC_OK && !done) st = by_itself(ti, monitor, result);
  if (st == HC_OK) st = richardson_extrapolate(ti, monitor, result);
  timeint_get_state(ti, state); /* on failure, the last one that was reached */
  timeint_hear(ti, before);
  fill_counts(ti, result);
  return st;
}

hc_status timeint_orbit(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                        timeint_result *result)
{
  clear_result(result, omega);
  if (k < 1 || k > SETTLE_MAX_MULTIPLE) return HC_BAD_INPUT;
  hc_status st = timeint_begin(ti, omega, state);
  if (st != HC_OK) return st;
  const hc_monitor *before = timeint_hear(ti, monitor);
  bool done = false;
  if (ti->scout) st = scout_steady(ti, k, state, monitor, result, &done);
  if (st == HC_OK && !done) st = to_nearest_orbit(ti, k, monitor, result);
  timeint_get_state(ti, state);
  timeint_hear(ti, before);
  fill_counts(ti, result);
  return st;
}

hc_status timeint_again(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                        timeint_result *result)
{
  bool done = false;
  clear_result(result, omega);
  if (k < 1 || k > SETTLE_MAX_MULTIPLE) return HC_BAD_INPUT;
  hc_status st = timeint_begin(ti, omega, state);
  if (st != HC_OK) return st;
  const hc_monitor *before = timeint_hear(ti, monitor);
  if (ti->scout) st = scout_confirm(ti, k, monitor, result, &done);
  if (st == HC_OK && !done) st = to_nearest_orbit(ti, k, monitor, result);
  if (st == HC_OK) st = richardson_extrapolate(ti, monitor, result);
  timeint_get_state(ti, state);
  timeint_hear(ti, before);
  fill_counts(ti, result);
  return st;
}
