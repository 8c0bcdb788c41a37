/* sweep.c - see sweep.h.
 *
 * Frequency advances in relative steps of at most 1 %. At each the state moves to the stable orbit next to it, by
 * Newton on the period map or by the closed form: in a slow sweep it would be on that orbit all the time. Where
 * there is none, the branch has ended or become unstable, and the state is integrated until it has settled to a
 * percent of its size, or for MAX_FOLDS e-folds. The distance it moved is that by which its orbit moved: the
 * frequency step grows while that is little and shrinks when it is much (where the curve is steep: near resonance,
 * towards a fold), to no less than a tenth of the half width of a resonance. All this with the exact law, whatever
 * the settings' law: the branches of the two differ by the regularisation only, the exact law costs a tenth, and the
 * steady state reported at the end of a sweep is solved with the settings' own. An aperiodic state changes from
 * period to period at one frequency too; the sweep then goes on in small steps. That a branch has ended is not
 * detected: the state leaves it, as on the shaker. */
#include "timeint/steady/sweep.h"

#include <complex.h>

#include "numerics/base/constants.h"
#include "timeint/steady/linear_regime.h"
#include "timeint/steady/shoot.h"
#include "timeint/steady/timeint_private.h"

/* Steps, relative to omega. */
static const double largest_step = 1e-2;
static const double first_step = 2e-3;    /* before it is known how far orbits move: a fifth of the largest */
static const double smallest_step = 1e-4; /* the shortest branch seen, period 8 of case 2, is ten of it long */
static const double step_of_width = 0.1;  /* [half width] across a resonance in some twenty steps */
static const double no_damping = 1e-6;    /* [omega] the half width of a resonance without damping */
static const double grow = 1.5, shrink = 0.5, retry = 0.25;
static const double last_step = 1.2;        /* [step] to the end, rather than leave a remainder */
static const double aperiodic_step = 5e-4;  /* among sub-harmonics and chaos: case 2 has period 8 over 1e-3 of omega,
                                               and a longer step would miss it */
static const double sweep_tolerance = 1e-8; /* of CVODE: periods scatter by 1e-6 of the motion */
static const double settled_within = 1e-2;  /* of the motion: the distance from the orbit, when marching */
static const double orbit_within = 1e-5;    /* the same, by Newton */
static const double moved_little = 0.03, moved_much = 0.1; /* of the motion, from one frequency to the next */
static const double slowest = 1e-3; /* [1/period] damping of 1 - contraction, at least, when distances are estimated */
enum {
  MIN_PERIODS = 4, /* in a row: one may look settled in passing */
  MAX_FOLDS = 5    /* exp(-5) = 0.7 %, below settled_within */
};

/* max |a - b| of two points, relative to the motion. */
static double relative_distance(const timeint *ti, const double *a, const double *b)
{
  double most = 0;
  for (int i = 0; i < ti->n; ++i) most = fmax(most, fabs(a[i] - b[i]));
  return most / timeint_motion_size(ti);
}

/* Estimated distance of the state from its orbit, from its changes over the last two periods. Multipliers come as a
 * complex pair lambda, so the difference to the orbit in (x, v/omega), read as a complex number, is multiplied by
 * lambda each period: moves[1]/moves[0] = lambda, and |moves[1]/(1 - lambda)| is left. (settle.h has a bound.) */
static double distance_left(const double complex moves[2], double move, double slow)
{
  double turn = cabs(1 - moves[1] / moves[0]);
  return move / (turn > slow ? fmin(turn, 1) : slow); /* so also where moves[0] = 0 */
}

/* To the stable orbit next to the state. *there: there is one no farther than a sweep may move at a time. */
static hc_status follow_branch(timeint *ti, const hc_monitor *monitor, bool *there, double *moved)
{
  double *before = ti->point[0], *after = ti->point[1];
  const double size = timeint_scaled_size(ti);
  shoot_report found = {0};
  timeint_result unused;
  timeint_point(ti, before);
  timeint_save(ti);
  hc_status st = HC_OK;
  *there = linear_regime_steady(ti, &unused);
  if (!*there) st = shoot_newton(ti->shoot, 1, moved_much * size, orbit_within * size, monitor, &found);
  timeint_point(ti, after);
  *moved = relative_distance(ti, after, before);
  if (st == HC_OK && !*there) *there = cabs(found.multiplier) < 1 && *moved <= 2 * moved_much;
  if (!*there) timeint_restore(ti);
  return shoot_found_no_orbit(st) ? HC_OK : st;
}

/* A single mass's change of state as a complex number; of more coordinates only how far. */
static double complex move_of(const timeint *ti, const double *from, const double *to)
{
  double sum = 0;
  if (ti->n_dof == 1) return to[0] - from[0] + I * (to[1] - from[1]);
  for (int i = 0; i < 2 * ti->n_dof; ++i) sum = hypot(sum, to[i] - from[i]);
  return sum;
}

/* Half the width of a linear resonance at half its power, relative to omega: of the least damped mode that has damping.
 * One without, as of a wedge between its contacts, is damped by these, or has no width to go by. */
static double half_width(const timeint *ti)
{
  const modal_base *b = ti->base;
  double least = INFINITY;
  for (int i = 0; i < b->n; ++i) {
    const double decay = 0.5 * b->C[b->diagonal_C ? i : i * (b->n + 1)];
    if (decay > no_damping * ti->omega) least = fmin(least, decay);
  }
  return isfinite(least) ? least / ti->omega : no_damping;
}

/* Periods at one frequency until the state has settled. *moved: how far it went; NaN if it did not settle. */
static hc_status settle_by_marching(timeint *ti, const hc_monitor *monitor, double done, double *moved)
{
  const double slow = fmax(1 - exp(-TWO_PI * half_width(ti)), slowest);
  const int most = (int)ceil(MAX_FOLDS / slow);
  double *const *z = ti->point; /* before the first period; before and after the last */
  double complex moves[2] = {0, 0};
  timeint_point(ti, z[0]);
  *moved = 0;
  for (int i = 0, settled = 0; i < most; ++i) {
    if (!hc_monitor_tick(monitor, done)) return HC_INTERRUPTED;
    timeint_point(ti, z[1]);
    hc_status st = timeint_period(ti, false);
    if (st != HC_OK) return st;
    timeint_point(ti, z[2]);
    *moved = fmax(*moved, relative_distance(ti, z[2], z[0]));
    moves[0] = moves[1];
    moves[1] = move_of(ti, z[1], z[2]);
    settled = distance_left(moves, relative_distance(ti, z[2], z[1]), slow) <= settled_within ? settled + 1 : 0;
    if (settled == MIN_PERIODS) return HC_OK;
  }
  *moved = NAN;
  return HC_OK;
}

static double least_step(const timeint *ti) { return fmin(smallest_step, step_of_width * half_width(ti)); }

static double next_step(const timeint *ti, double step, double moved)
{
  if (isnan(moved)) return fmin(aperiodic_step, half_width(ti));
  if (moved > moved_much) step *= shrink;
  if (moved < moved_little) step *= grow;
  return fmin(fmax(step, least_step(ti)), largest_step);
}

/* Where the sweep stands. */
typedef struct sweep {
  timeint *ti;
  const hc_monitor *monitor;
  double from, to, omega;
  double step;   /* relative, > 0 */
  double moved;  /* of the motion, at the last frequency */
  bool computed; /* the state there is on an orbit that Newton or the closed form found, not marching */
  bool settled;  /* the state there is next to an orbit, so that one can be computed at the next frequency */
} sweep;

/* The next frequency: the same one at the very start. */
static double next_omega(const sweep *s, bool begun)
{
  const double left = fabs(log(s->to / s->omega)), sign = s->to > s->omega ? 1 : -1;
  if (!begun) return s->omega;
  return left <= last_step * s->step ? s->to : s->omega * exp(sign * s->step);
}

/* The state at omega from the one where the sweep stands. !*arrived: the step was too long for the branch to be
 * followed, and is shorter now. */
static hc_status advance_to(sweep *s, double omega, double *state, bool *arrived)
{
  const double span = fabs(log(s->to / s->from)), done = span > 0 ? fabs(log(omega / s->from)) / span : 1;
  bool there = false;
  *arrived = true;
  hc_status st = timeint_begin(s->ti, omega, state);
  if (st == HC_OK && s->settled) st = follow_branch(s->ti, s->monitor, &there, &s->moved);
  if (st != HC_OK) return st;
  if (!hc_monitor_tick(s->monitor, done)) return HC_INTERRUPTED;
  if (!there && s->computed && s->step > least_step(s->ti)) { /* the orbit may only have moved far */
    s->step = fmax(retry * s->step, least_step(s->ti));
    *arrived = false;
    return HC_OK;
  }
  if (!there) st = settle_by_marching(s->ti, s->monitor, done, &s->moved);
  s->computed = there;
  s->settled = !isnan(s->moved);
  s->omega = omega;
  timeint_get_state(s->ti, state);
  return st;
}

/* The other integrator, and its law in the settings; the equations follow in timeint_begin. */
static void swap_law(timeint *ti, transient_law law)
{
  integrator *in = ti->in;
  ti->in = ti->exact;
  ti->exact = in;
  ti->how.law = law;
}

hc_status timeint_sweep(timeint *ti, double omega_from, double omega_to, double *state, const hc_monitor *monitor)
{
  const transient_law law = ti->how.law;
  if (ti->closed_form) return timeint_sweep(ti->closed_form, omega_from, omega_to, state, monitor);
  const hc_monitor *before = timeint_hear(ti, monitor);
  if (law != TRANSIENT_LAW_EXACT) swap_law(ti, TRANSIENT_LAW_EXACT);
  hc_status st = timeint_begin(ti, omega_from, state);
  if (st == HC_OK && !(omega_to > 0 && isfinite(omega_to))) st = HC_BAD_INPUT;
  if (st == HC_OK) st = timeint_set_tolerance(ti, fmax(sweep_tolerance, timeint_final_tolerance(ti)));
  sweep s = {.ti = ti,
             .monitor = monitor,
             .from = omega_from,
             .to = omega_to,
             .omega = omega_from,
             .step = fmin(first_step, half_width(ti))};
  s.settled = linear_regime_is_final(ti);
  for (bool begun = false, arrived; st == HC_OK;) {
    st = advance_to(&s, next_omega(&s, begun), state, &arrived);
    if (st != HC_OK || !arrived) continue;
    if (s.omega == omega_to) break;
    if (begun) s.step = next_step(ti, s.step, s.moved);
    begun = true;
  }
  if (law != TRANSIENT_LAW_EXACT) swap_law(ti, law);
  timeint_hear(ti, before);
  return st;
}
