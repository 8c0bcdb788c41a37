/* steady.c - the steady state of a model at one frequency: which way to it, in the order of what they cost.
 *
 *     1. nothing happens at the contacts from here on: the closed form (linear_forever.h)
 *     2. Newton on the period map (shoot.h); where it fails, Anderson's acceleration of it
 *     3. a stretch of waiting, longer each time, and again from 1 (attract.c)
 *     4. waiting to the end (march.c), which is also what transient.steady_state: march asks for */
#include <math.h>
#include <string.h>

#include "timeint/internal.h"
#include "timeint/linear_forever.h"

/* An HBM orbit may be off by some ten percent of the motion with one harmonic; farther away it is another orbit.
 * [size] */
static const double reach_from_hbm = 0.3;
static const double next_to = 0.5; /* [size] what shooting calls the orbit next to its start */
static const double nudge = 1e-3;  /* [size] off an unstable orbit, along its own direction */

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
  r->amplitude = r->max = r->min = r->rms = r->mean = r->a1 = r->b1 = r->harmonic_1 = r->closure = r->contraction = NAN;
  r->multiplier = r->multiplier_re = r->multiplier_im = r->lyapunov = r->regularisation_error = NAN;
  for (int i = 0; i < TIMEINT_WAVE; ++i) r->wave[i] = NAN;
}

static void fill_counts(const timeint *ti, timeint_result *r)
{
  r->periods = ti->periods;
  r->steps = integrate_steps(ti->in) - ti->steps0;
  r->rhs = integrate_rhs(ti->in) - ti->rhs0;
  r->cvode_flag = integrate_flag(ti->in);
}

double timeint_goal(const timeint *ti)
{
  const double size = fmax(timeint_size(ti), ti->least_length) / ti->length;
  return fmax(ti->how.tolerance * size, 100 * ti->tolerance);
}

/* Is z_0 -> z_k on a shorter cycle: the smallest divisor d of k with |F^d(z) - z| as small as errors leave it. */
static int primitive(int k, double size, const double *returned)
{
  for (int d = 1; d < k; ++d)
    if (k % d == 0 && returned[d] <= 1e-6 * size) return d;
  return k;
}

hc_status timeint_report(timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r)
{
  double start[SCALED_MAX_STATES], returned[SETTLE_MAX_MULTIPLE + 1];
  const long switches = integrate_switches(ti->in);
  memcpy(start, ti->y, sizeof start);
  measure_begin(&ti->measure, &ti->scaled);
  for (int i = 0; i < k; ++i) {
    hc_status st = timeint_period(ti, true);
    if (st != HC_OK) return st;
    returned[i + 1] = fmax(fabs(ti->y[SCALED_X] - start[SCALED_X]), fabs(ti->y[SCALED_P] - start[SCALED_P]));
  }
  measure_report(&ti->measure, ti->model, ti->length, r);
  r->method = method;
  r->switches = (int)(integrate_switches(ti->in) - switches);
  r->period_multiple = primitive(k, timeint_size(ti) / ti->length, returned);
  r->closure = r->amplitude > 0 ? found->distance * ti->length / r->amplitude : found->distance > 0 ? INFINITY : 0;
  r->multiplier = cabs(found->multiplier);
  r->multiplier_re = creal(found->multiplier);
  r->multiplier_im = cimag(found->multiplier);
  r->contraction = pow(r->multiplier, 1.0 / k);
  r->free_sliders = found->free_sliders;
  return HC_OK;
}

bool timeint_no_orbit(hc_status st)
{
  return st == HC_SINGULAR || st == HC_STALLED || st == HC_NOT_CONVERGED || st == HC_CHATTER || st == HC_NOT_SETTLED;
}

/* The orbit of k periods next to ti->y: Newton, else Anderson. */
static hc_status next_orbit(timeint *ti, int k, const hc_monitor *monitor, timeint_method *method, shoot_report *found)
{
  const double size = fmax(timeint_size(ti), ti->least_length) / ti->length;
  *method = TIMEINT_BY_SHOOTING;
  hc_status st = shoot_newton(ti->shoot, k, reach_from_hbm * size, timeint_goal(ti), monitor, found);
  if (!timeint_no_orbit(st)) return st;
  *method = TIMEINT_BY_ANDERSON;
  hc_status second = shoot_anderson(ti->shoot, k, timeint_goal(ti), monitor, found);
  return second == HC_OK || second == HC_INTERRUPTED ? second : st;
}

static hc_status shoot_here(timeint *ti, int k, const hc_monitor *monitor, timeint_result *r)
{
  timeint_method method;
  shoot_report found;
  if (linear_forever(ti)) {
    linear_steady(ti, r);
    return HC_OK;
  }
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  const double size = fmax(timeint_size(ti), ti->least_length) / ti->length;
  if (st == HC_OK) st = next_orbit(ti, k, monitor, &method, &found);
  /* an orbit, but not the one next to the start */
  if (st == HC_OK && !(found.moved <= next_to * size)) st = HC_NOT_CONVERGED;
  return st == HC_OK ? timeint_report(ti, k, method, &found, r) : st;
}

/* Off the unstable orbit that was found next to where the motion began: back to there, and a nudge in the direction
 * in which it leaves. */
static void leave(timeint *ti, const double *began)
{
  double direction[SCALED_MAX_STATES], along = 0;
  const double size = timeint_size(ti) / ti->length;
  shoot_direction(ti->shoot, direction);
  for (int i = 0; i < ti->scaled.n_states; ++i) along += direction[i] * (began[i] - ti->y[i]);
  const double step = (along < 0 ? -nudge : nudge) * size;
  for (int i = 0; i < ti->scaled.n_states; ++i) ti->y[i] = began[i] + step * direction[i];
}

/* From next to an orbit: that one, if it is stable, else where the motion goes from there. */
static hc_status from_orbit(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  double began[SCALED_MAX_STATES];
  timeint_method method;
  shoot_report found;
  memcpy(began, ti->y, sizeof began);
  const double size = fmax(timeint_size(ti), ti->least_length) / ti->length;
  hc_status st = next_orbit(ti, 1, monitor, &method, &found);
  if (timeint_no_orbit(st)) return timeint_attract(ti, 8, monitor, r);
  if (st != HC_OK) return st;
  if (!(found.moved <= reach_from_hbm * size)) { /* another orbit: see whether the motion goes there */
    memcpy(ti->y, began, sizeof began);
    return timeint_attract(ti, 8, monitor, r);
  }
  if (cabs(found.multiplier) < 1) return timeint_report(ti, 1, method, &found, r);
  leave(ti, began);
  r->left_orbit = true;
  return timeint_attract(ti, 32, monitor, r);
}

static hc_status automatic(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  if (linear_forever(ti)) {
    linear_steady(ti, r);
    return HC_OK;
  }
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  if (st != HC_OK) return st;
  return ti->how.start == TRANSIENT_START_HBM ? from_orbit(ti, monitor, r) : timeint_attract(ti, 8, monitor, r);
}

hc_status timeint_steady(timeint *ti, double omega, timeint_state *state, const hc_monitor *monitor,
                         timeint_result *result)
{
  clear_result(result, omega);
  hc_status st = timeint_begin(ti, omega, state);
  if (st != HC_OK) return st;
  switch (ti->how.steady) {
  case TRANSIENT_STEADY_MARCH: st = timeint_march(ti, monitor, result); break;
  case TRANSIENT_STEADY_SHOOTING: st = shoot_here(ti, 1, monitor, result); break;
  default: st = automatic(ti, monitor, result);
  }
  if (st == HC_OK) st = timeint_extrapolate(ti, monitor, result);
  *state = timeint_now(ti); /* on failure, the last one that was reached */
  fill_counts(ti, result);
  return st;
}

hc_status timeint_orbit(timeint *ti, double omega, int k, timeint_state *state, const hc_monitor *monitor,
                        timeint_result *result)
{
  clear_result(result, omega);
  if (k < 1 || k > SETTLE_MAX_MULTIPLE) return HC_BAD_INPUT;
  hc_status st = timeint_begin(ti, omega, state);
  if (st != HC_OK) return st;
  st = shoot_here(ti, k, monitor, result);
  *state = timeint_now(ti);
  fill_counts(ti, result);
  return st;
}
