/* steady.c - see steady.h. With transient.scout the closed form goes first (closed_form_start.h), and CVODE confirms
 * where it leads. Without, or where that fails, in the order of what they cost:
 *     1. no contact changes its state from here on: the closed form (linear_regime.h)
 *     2. Newton on the period map, or where it fails Anderson's acceleration of it (shoot.h)
 *     3. a stretch of periods, longer each time, and again from 1
 *     4. period after period to the end (settle.h), which is also what transient.steady_state: march asks for */
#include "timeint/steady/steady.h"

#include <string.h>

#include "numerics/norm.h"
#include "timeint/steady/aperiodic.h"
#include "timeint/steady/closed_form_start.h"
#include "timeint/steady/escape.h"
#include "timeint/steady/linear_regime.h"
#include "timeint/steady/mass_scaling.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/regularised.h"
#include "timeint/steady/settle.h"
#include "timeint/steady/timeint_private.h"

/* ---- the approach to an attractor --------------------------------------------------------------------
 *
 * The motion is integrated in stretches, each twice as long as the last; after each the orbit is looked for to which it
 * converges.
 *
 * A stretch is integrated with a coarse tolerance, since Newton makes the orbit accurate. Then, if the last state is
 * within ORBIT_NEXT_TO of the state k periods ago, the orbit of k periods next to it is computed (shoot.h). The motion
 * goes to that orbit if it is stable, next to the state, and the map between the two is linear enough for the distance
 * to shrink: |F(z) - z* - Phi (z - z*)| <= (1 - rho)/2 |z - z*|. Otherwise another stretch follows.
 *
 * A motion next to no such orbit is tested for chaos and for a torus (aperiodic.h). Chaos may be a transient on
 * its way to an orbit: it has to be found after two stretches in a row, the second twice as long as the first, and no
 * orbit after either of them or at the end. */
static const double coarse = 1e-9;     /* CVODE's tolerance in a stretch, if the final one is not coarser */
static const double along_the_way = 5; /* [ORBIT_NEXT_TO] a return is (1 - rho) of the distance: rho up to 0.8 */
static const double on_a_torus = 0.05; /* [1/period] neighbours there part in proportion to time: log(680)/640 = 0.01 */
enum {
  MOST_FAILURES = 6,                  /* of Newton; then period after period decides */
  TIMES_CHAOTIC = 2,                  /* in a row, before it is said */
  LAST_LOOK = 2 * SETTLE_MAX_MULTIPLE /* periods, before it is said: the ring is of these again */
};

/* The motion on its way; the ring of its latest states is ti->past. */
typedef struct approach {
  timeint *ti;
  const hc_monitor *monitor;
  int n_past;   /* states seen */
  int failures; /* Newton solves that found no orbit */
  int chaotic;  /* stretches in a row after which neighbours drifted apart */
} approach;

static double *past_state(const approach *a, int i) { return a->ti->past + i % SETTLE_MAX_MULTIPLE * a->ti->n; }

/* Largest difference to the state k periods ago [length]. */
static double distance_to_past(const approach *a, int k)
{
  double *z = a->ti->point[0], most = 0;
  const double *before = past_state(a, a->n_past - k);
  timeint_point(a->ti, z);
  for (int i = 0; i < a->ti->n; ++i) most = larger(most, fabs(z[i] - before[i]));
  return most;
}

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
    timeint_point(a->ti, past_state(a, a->n_past++));
    st = timeint_period(ti, false);
    if (st == HC_OK) st = escape_size(ti);
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
  if (a->n_past == 0) return rho < 1 && found->moved <= ORBIT_NEXT_TO * size;
  return rho < 1 && found->moved <= along_the_way * ORBIT_NEXT_TO * size && found->nonlinear <= 0.5 * (1 - rho);
}

/* *found_it: the motion converges to the orbit of k periods next to ti->y, which is then reported. */
static hc_status try_orbit(approach *a, int k, bool *found_it, timeint_result *r)
{
  timeint *ti = a->ti;
  shoot_report found;
  const double size = timeint_scaled_size(ti);
  timeint_save(ti);
  *found_it = false;
  hc_status st = shoot_newton(ti->shoot, k, ORBIT_NEXT_TO * size, orbit_goal(ti), a->monitor, &found);
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
  double within = 2 * ORBIT_NEXT_TO * timeint_motion_size(a->ti);
  hc_status st = HC_OK;
  *found_it = false;
  for (int k = next_return(a, 0, within); k > 0 && st == HC_OK && !*found_it; k = next_return(a, k, within)) {
    within = distance_to_past(a, k);
    st = try_orbit(a, k, found_it, r);
  }
  return st;
}

/* The closed form, or the orbit next to the state. */
static hc_status try_to_end(approach *a, bool linear, bool *done, timeint_result *r)
{
  if (!linear) return try_orbits(a, done, r);
  linear_regime_steady(a->ti, r);
  *done = true;
  return HC_OK;
}

/* Chaotic after so many stretches in a row: is it still, or has it come to an orbit meanwhile? */
static hc_status conclude_chaos(approach *a, bool *done, timeint_result *r)
{
  bool linear;
  hc_status st = integrate_stretch(a, LAST_LOOK, &linear);
  if (st == HC_OK) st = try_to_end(a, linear, done, r);
  return st == HC_OK && !*done ? orbit_report_none(a->ti, HC_APERIODIC, r) : st;
}

/* Next to no orbit: does the motion run on a torus, or is it chaotic? Then it is reported. Both wait until the
 * transient has died out. */
static hc_status try_aperiodic(approach *a, bool *done, timeint_result *r)
{
  timeint *ti = a->ti;
  bool chaos;
  double nu;
  *done = false;
  hc_status st = chaos_test(ti, a->monitor, &chaos, &r->lyapunov);
  if (st != HC_OK || isnan(r->lyapunov)) return st;
  a->chaotic = chaos ? a->chaotic + 1 : 0;
  if (!(r->lyapunov > on_a_torus)) {
    if ((st = torus_test(ti, a->monitor, &nu)) != HC_OK) return st;
    r->second_frequency = nu * ti->omega;
    if (!isnan(nu)) return orbit_report_none(ti, HC_APERIODIC, r);
  }
  return a->chaotic == TIMES_CHAOTIC ? conclude_chaos(a, done, r) : HC_OK;
}

/* From stretch to stretch. */
static hc_status by_stretches(approach *a, int first, timeint_result *r)
{
  timeint *ti = a->ti;
  const transient_start start = ti->how.start;
  bool done;
  if (start == TRANSIENT_START_UP || start == TRANSIENT_START_DOWN) { /* the sweep has probably left it on its orbit */
    hc_status st = try_orbit(a, 1, &done, r);
    if (st != HC_OK || done) return st;
  }
  for (int stretch = first; ti->periods < ti->how.max_periods - 1; stretch *= 2) {
    bool creeps;
    hc_status st = integrate_stretch(a, stretch, &done);
    escape_note(ti);
    if (st == HC_OK && !done && (st = escape_look_for_creep(ti, &creeps)) == HC_OK && creeps)
      return orbit_report_none(ti, HC_CREEPS, r);
    if (st == HC_OK) st = try_to_end(a, done, &done, r);
    if (st != HC_OK || done) return st;
    if ((st = try_aperiodic(a, &done, r)) != HC_OK || done) return st;
    if (a->failures >= MOST_FAILURES) break;
  }
  return settle_by_integration(ti, a->monitor, r);
}

/* From ti->y, next to no known stable orbit, to the attractor, its measures into *r. first: periods of the first
 * integration. HC_APERIODIC: *r is the last period; else as timeint_steady. Contacts that change their states ever more
 * often are how some motions without bound end. */
static hc_status approach_attractor(timeint *ti, int first, const hc_monitor *monitor, timeint_result *r)
{
  approach a = {.ti = ti, .monitor = monitor};
  hc_status st = by_stretches(&a, first, r);
  const hc_status size = escape_size(ti);
  return st == HC_CHATTER && size != HC_OK ? size : st;
}

/* ---- the ways to the steady state ---------------------------------------------------------------------- */

/* [size] With one harmonic an HBM orbit is some ten percent of the motion off; an orbit farther away is another. */
static const double reach_from_hbm = 0.3;
static const double next_to = 0.5;       /* [size] shooting: an orbit farther from its start is not next to it */
static const double perturbation = 1e-3; /* [size] off an unstable orbit, in the direction in which it is left */
enum { FIRST_STRETCH = 8, STRETCH_FROM_UNSTABLE = 32 }; /* periods before the first look for an orbit */

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
  const double border = 1e-9; /* transient.tolerance by default: multipliers are known no better */
  if (r->multiplier < 1 - border) return 1;
  return r->multiplier > 1 + border ? -1 : 0;
}

static void clear_result(timeint_result *r, double omega)
{
  memset(r, 0, sizeof *r);
  r->omega = omega;
  r->amplitude = r->max = r->min = r->rms = r->mean = r->a1 = r->b1 = r->harmonic_1 = r->closure = r->attainable =
      r->contraction = NAN;
  r->multiplier = r->multiplier_re = r->multiplier_im = r->lyapunov = r->second_frequency = r->drift = NAN;
  r->window_low = r->window_high = NAN;
  r->predicted = (motion_error){NAN, NAN, NAN};
  for (int i = 0; i < TIMEINT_WAVE; ++i) r->wave[i] = NAN;
}

/* The orbit of k periods next to the state, stable or not. */
static hc_status to_nearest_orbit(timeint *ti, int k, const hc_monitor *monitor, timeint_result *r)
{
  timeint_method method;
  shoot_report found;
  if (linear_regime_steady(ti, r)) return HC_OK;
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  const double size = timeint_scaled_size(ti);
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
  const double *own = ti->sizes.of;
  double along = 0;
  shoot_direction(ti->shoot, ti->direction);
  for (int i = 0; i < ti->n; ++i) along += direction[i] / own[i] * (began[i] - ti->y[i]) / own[i];
  const double step = (along < 0 ? -perturbation : perturbation) * size;
  for (int i = 0; i < ti->n; ++i) ti->y[i] = began[i] + step * direction[i];
}

/* From next to an orbit: that one, if it is stable, else where the motion goes from there. */
static hc_status from_orbit(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  timeint_method method;
  shoot_report found;
  const double size = timeint_scaled_size(ti);
  timeint_save(ti);
  hc_status st = orbit_find(ti, 1, reach_from_hbm * size, monitor, &method, &found);
  if (shoot_found_no_orbit(st)) return approach_attractor(ti, FIRST_STRETCH, monitor, r);
  if (st != HC_OK) return st;
  if (!(found.moved <= reach_from_hbm * size)) { /* another orbit: the motion decides whether it goes there */
    timeint_restore(ti);
    return approach_attractor(ti, FIRST_STRETCH, monitor, r);
  }
  if (cabs(found.multiplier) < 1) return orbit_report(ti, 1, method, &found, r);
  leave_unstable_orbit(ti);
  r->left_orbit = true;
  return approach_attractor(ti, STRETCH_FROM_UNSTABLE, monitor, r);
}

/* For a large structure in closed form the copy with slowed modes, whose periods take a fifth, goes ahead: is the
 * motion next to where that has come to now, an orbit of one period? */
static bool follows_slowed(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  double *state = ti->past;
  if (!ti->slowed || !isfinite(mass_scaling_fastest(ti->whole, ti->omega))) return false;
  timeint_get_state(ti, state);
  hc_status st = timeint_steady(ti->slowed, ti->omega, state, monitor, r);
  const bool arrived = st == HC_OK && r->period_multiple == 1;
  clear_result(r, ti->omega);
  return arrived && timeint_begin(ti, ti->omega, state) == HC_OK;
}

static hc_status to_attractor(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  if (linear_regime_steady(ti, r)) return HC_OK;
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  if (st != HC_OK) return st;
  const bool near = ti->how.start == TRANSIENT_START_HBM || follows_slowed(ti, monitor, r);
  return near ? from_orbit(ti, monitor, r) : approach_attractor(ti, FIRST_STRETCH, monitor, r);
}

static hc_status by_itself(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  switch (ti->how.steady) {
  case TRANSIENT_STEADY_MARCH: return settle_by_integration(ti, monitor, r);
  case TRANSIENT_STEADY_SHOOTING: return to_nearest_orbit(ti, 1, monitor, r);
  default: return to_attractor(ti, monitor, r);
  }
}

/* The steady state (k = 0), or the orbit of k periods next to `state`; at_state: the state is on it, but for the
 * errors of another integration. */
static hc_status reach(timeint *ti, double omega, int k, bool at_state, double *state, const hc_monitor *monitor,
                       timeint_result *result)
{
  bool done = false;
  clear_result(result, omega);
  if (k < 0 || k > SETTLE_MAX_MULTIPLE) return HC_BAD_INPUT;
  hc_status st = timeint_begin(ti, omega, state);
  if (st != HC_OK) return st;
  ti->start_size = timeint_size(ti);
  const hc_monitor *before = timeint_hear(ti, monitor);
  const bool closed_first = ti->closed_form && (k > 0 || ti->how.steady != TRANSIENT_STEADY_MARCH);
  if (closed_first && at_state) st = closed_start_confirm(ti, k, monitor, result, &done);
  else if (closed_first) st = closed_start_steady(ti, k, state, monitor, result, &done);
  if (st == HC_OK && !done) st = k > 0 ? to_nearest_orbit(ti, k, monitor, result) : by_itself(ti, monitor, result);
  if (st == HC_OK) st = regularised_check(ti, monitor, result);
  timeint_get_state(ti, state); /* on failure, the last one that was reached */
  if (st == HC_OK) timeint_remember(ti, state);
  if (st == HC_OK && done && !at_state) closed_start_remember(ti, state, result);
  timeint_hear(ti, before);
  result->periods = ti->periods;
  result->steps = integrate_steps(ti->in) - ti->steps0;
  result->rhs = integrate_rhs(ti->in) - ti->rhs0;
  result->cvode_flag = integrate_flag(ti->in);
  return st;
}

hc_status timeint_steady(timeint *ti, double omega, double *state, const hc_monitor *monitor, timeint_result *result)
{
  return reach(ti, omega, 0, false, state, monitor, result);
}

hc_status timeint_orbit(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                        timeint_result *result)
{
  return reach(ti, omega, k < 1 ? -1 : k, false, state, monitor, result);
}

hc_status timeint_again(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                        timeint_result *result)
{
  return reach(ti, omega, k < 1 ? -1 : k, true, state, monitor, result);
}

hc_status timeint_response(timeint *ti, int i, timeint_result *r)
{
  if (i < 0 || i >= scaled_n_responses(&ti->scaled)) return HC_BAD_INPUT;
  const double one = r->amplitude / timeint_response_unit(ti, 0);
  if (!ti->measured && linear_regime_response(ti, i, r)) return HC_OK;
  if (!ti->measured) {
    timeint_result again = *r;
    hc_status st = orbit_measure(ti, r->period_multiple > 0 ? r->period_multiple : 1, &again);
    if (st != HC_OK) return st;
  }
  timeint_report(ti, i, r);
  const double other = r->amplitude / timeint_response_unit(ti, i); /* closure and attainable are relative to it */
  r->closure *= one / other;
  r->attainable *= one / other;
  return HC_OK;
}
