/* sweep.c - from one frequency to another as on a shaker, so that the state stays on the branch it is on.
 *
 * Frequency goes in relative steps of at most 1 %. At each the stable orbit next to the state is taken, by Newton on
 * the period map or from the closed form: a slow sweep is on it all the time. Where there is none, the branch has
 * ended or become unstable, and the state is marched until it has settled to a percent of its size, or for MAX_FOLDS
 * e-folds. How far it has gone meanwhile is how far its orbit has moved: the step grows while that is little and
 * shrinks when it is much (where the curve is steep: near resonance, towards a fold), to a tenth of the half width
 * of a resonance at least. All this with the exact law, whatever the settings': a branch is the same for both to
 * within the regularisation, a tenth of the cost decides, and what is reported at the end of a sweep is solved with
 * the settings' own. A state that is not periodic moves of itself: it goes on, too, in small steps. Not here: knowing
 * that a branch has ended. The state falls off it by itself, as on the shaker. */
#include <complex.h>
#include <math.h>
#include <string.h>

#include "timeint/internal.h"
#include "timeint/linear_forever.h"

static const double largest_step = 1e-2, first_step = 2e-3, smallest_step = 1e-4;
static const double restless_step = 5e-4;   /* among sub-harmonics and chaos: case 2 has period 8 over 1e-3 of omega,
                                             and jumps lose the way */
static const double sweep_tolerance = 1e-8; /* of CVODE: scatters by 1e-6 of the motion */
static const double settled_enough = 1e-2, followed_enough = 1e-5; /* of the motion, by marching and by Newton */
static const double moved_little = 0.03, moved_much = 0.1;         /* of the motion, from one frequency to the next */
enum { MIN_PERIODS = 4, MAX_FOLDS = 5 };

/* max |a - b| relative to the motion. */
static double apart(const timeint *ti, const double *a, const double *b)
{
  double most = 0;
  for (int i = 0; i < ti->scaled.n_states; ++i) most = fmax(most, fabs(a[i] - b[i]));
  return most / fmax(timeint_size(ti), ti->least_length);
}

/* How far from rest the state is, from its last two moves: multipliers come as a complex pair, so (x, v/omega) turns
 * by their angle and shrinks; read as complex numbers moves[0], moves[1] have the ratio lambda, and |moves[1]/(1 -
 * lambda)| is left. An estimate (settle.h has the bound). */
static double left_to_go(const double complex moves[2], double move, double slow)
{
  double turn = cabs(1 - moves[1] / moves[0]);
  return move / (turn > slow ? fmin(turn, 1) : slow); /* moves[0] = 0, too */
}

/* The stable orbit next to the state, if there is one no farther than a sweep may move at a time. */
static hc_status follow(timeint *ti, const hc_monitor *monitor, bool *there, double *moved)
{
  double before[SCALED_MAX_STATES], after[SCALED_MAX_STATES], y[SCALED_MAX_STATES];
  const double size = fmax(timeint_size(ti), ti->least_length) / ti->length;
  shoot_report found = {0};
  timeint_result unused;
  timeint_point(ti, before);
  memcpy(y, ti->y, sizeof y);
  hc_status st = HC_OK;
  if ((*there = linear_forever(ti))) linear_steady(ti, &unused);
  else st = shoot_newton(ti->shoot, 1, moved_much * size, followed_enough * size, monitor, &found);
  timeint_point(ti, after);
  *moved = apart(ti, after, before);
  if (st == HC_OK && !*there) *there = cabs(found.multiplier) < 1 && *moved <= 2 * moved_much;
  if (!*there) memcpy(ti->y, y, sizeof y);
  return timeint_no_orbit(st) ? HC_OK : st;
}

/* Some periods at one frequency. *moved: how far the state went; NaN if it never came to rest. */
static hc_status wait_here(timeint *ti, const hc_monitor *monitor, double done, double *moved)
{
  const double slow = fmax(1 - ti->contraction, 1e-3);
  const int most = (int)ceil(MAX_FOLDS / slow);
  double z[3][SCALED_MAX_STATES]; /* before the first period; before and after the last */
  double complex moves[2] = {0, 0};
  timeint_point(ti, z[0]);
  *moved = 0;
  for (int i = 0, calm = 0; i < most; ++i) {
    if (!hc_monitor_tick(monitor, done)) return HC_INTERRUPTED;
    timeint_point(ti, z[1]);
    hc_status st = timeint_period(ti, false);
    if (st != HC_OK) return st;
    timeint_point(ti, z[2]);
    *moved = fmax(*moved, apart(ti, z[2], z[0]));
    moves[0] = moves[1];
    moves[1] = z[2][SCALED_X] - z[1][SCALED_X] + I * (z[2][SCALED_P] - z[1][SCALED_P]);
    calm = left_to_go(moves, apart(ti, z[2], z[1]), slow) <= settled_enough ? calm + 1 : 0;
    if (calm == MIN_PERIODS) return HC_OK;
  }
  *moved = NAN;
  return HC_OK;
}

/* Half the width of a linear resonance at half its power, relative to omega. */
static double half_width(const timeint *ti)
{
  return fmax(0.5 * ti->model->damping / (ti->model->mass * ti->omega), 1e-6);
}

static double least_step(const timeint *ti) { return fmin(smallest_step, 0.1 * half_width(ti)); }

static double next_step(const timeint *ti, double step, double moved)
{
  if (isnan(moved)) return fmin(restless_step, half_width(ti));
  if (moved > moved_much) step *= 0.5;
  if (moved < moved_little) step *= 1.5;
  return fmin(fmax(step, least_step(ti)), largest_step);
}

/* Where the sweep stands. */
typedef struct sweep {
  timeint *ti;
  const hc_monitor *monitor;
  double from, to, omega;
  double step;   /* relative, > 0 */
  double moved;  /* of the motion, at the last frequency */
  bool followed; /* the state there is on an orbit that was computed, not waited for */
  bool calm;     /* it came to rest there: next to an orbit, which is worth computing at the next frequency */
} sweep;

/* The next frequency: the same one at the very start. */
static double next_omega(const sweep *s, bool begun)
{
  const double left = fabs(log(s->to / s->omega)), sign = s->to > s->omega ? 1 : -1;
  if (!begun) return s->omega;
  return left <= 1.2 * s->step ? s->to : s->omega * exp(sign * s->step);
}

/* At omega, from the state where the sweep stands. *arrived says no if the step was too long for the orbit to be
 * followed: it is shorter now. */
static hc_status arrive(sweep *s, double omega, timeint_state *state, bool *arrived)
{
  const double span = fabs(log(s->to / s->from)), done = span > 0 ? fabs(log(omega / s->from)) / span : 1;
  bool there = false;
  *arrived = true;
  hc_status st = timeint_begin(s->ti, omega, state);
  if (st == HC_OK && s->calm) st = follow(s->ti, s->monitor, &there, &s->moved);
  if (st != HC_OK) return st;
  if (!hc_monitor_tick(s->monitor, done)) return HC_INTERRUPTED;
  if (!there && s->followed && s->step > least_step(s->ti)) { /* the orbit may only have moved far */
    s->step = fmax(0.25 * s->step, least_step(s->ti));
    *arrived = false;
    return HC_OK;
  }
  if (!there) st = wait_here(s->ti, s->monitor, done, &s->moved);
  s->followed = there;
  s->calm = !isnan(s->moved);
  s->omega = omega;
  *state = timeint_now(s->ti);
  return st;
}

static hc_status sweep_with_this_law(timeint *ti, double omega_from, double omega_to, timeint_state *state,
                                     const hc_monitor *monitor)
{
  hc_status st = timeint_begin(ti, omega_from, state);
  if (st == HC_OK && !(omega_to > 0 && isfinite(omega_to))) st = HC_BAD_INPUT;
  if (st == HC_OK) st = timeint_set_tolerance(ti, fmax(sweep_tolerance, timeint_final_tolerance(ti)));
  sweep s = {.ti = ti,
             .monitor = monitor,
             .from = omega_from,
             .to = omega_to,
             .omega = omega_from,
             .step = fmin(first_step, half_width(ti))};
  s.calm = linear_forever(ti);
  for (bool begun = false, arrived; st == HC_OK;) {
    st = arrive(&s, next_omega(&s, begun), state, &arrived);
    if (st != HC_OK || !arrived) continue;
    if (s.omega == omega_to) break;
    if (begun) s.step = next_step(ti, s.step, s.moved);
    begun = true;
  }
  return st;
}

/* The other law's integrator and equations in the place of the settings', or back. */
static void swap_law(timeint *ti, int law)
{
  integrator *in = ti->in;
  ti->in = ti->sweeper;
  ti->sweeper = in;
  ti->how.law = law;
}

hc_status timeint_sweep(timeint *ti, double omega_from, double omega_to, timeint_state *state,
                        const hc_monitor *monitor)
{
  const int law = ti->how.law;
  if (law == TRANSIENT_LAW_EXACT) return sweep_with_this_law(ti, omega_from, omega_to, state, monitor);
  swap_law(ti, TRANSIENT_LAW_EXACT);
  hc_status st = sweep_with_this_law(ti, omega_from, omega_to, state, monitor);
  swap_law(ti, law);
  return st;
}
