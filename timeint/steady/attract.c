/* attract.c - see attract.h. The motion is integrated in stretches, each twice as long as the last; after each the
 * orbit is looked for to which it converges.
 *
 * A stretch is integrated with a coarse tolerance, since Newton makes the orbit accurate. Then, if the last state is
 * within `near` of the state k periods ago, the orbit of k periods next to it is computed (shoot.h). The motion goes to
 * that orbit if it is stable, next to the state, and the map between the two is linear enough for the distance to
 * shrink: |F(z) - z* - Phi (z - z*)| <= (1 - rho)/2 |z - z*|. Otherwise another stretch follows.
 *
 * A motion next to no such orbit is tested for chaos (chaos.h) and for a torus (torus.h). Chaos may be a transient on
 * its way to an orbit: it has to be found after two stretches in a row, the second twice as long as the first, and no
 * orbit after either of them or at the end. */
#include "timeint/steady/attract.h"

#include <math.h>
#include <stddef.h>

#include "timeint/steady/chaos.h"
#include "timeint/steady/linear_regime.h"
#include "timeint/steady/march.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/timeint_private.h"
#include "timeint/steady/torus.h"

static const double coarse = 1e-9; /* CVODE's tolerance in a stretch, if the final one is not coarser */
static const double near = 0.02;   /* [size] between a state and its return: the orbit is then looked for */
static const double unbounded =
    1e9; /* [least_length] no resonance with damping is as high: the motion grows for ever */
static const double on_a_torus = 0.05; /* [1/period] neighbours there part in proportion to time: log(680)/640 = 0.01 */
enum {
  MOST_FAILURES = 6,                  /* of Newton; then marching decides */
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
  for (int i = 0; i < a->ti->n; ++i) {
    double d = fabs(z[i] - before[i]);
    if (!(d <= most)) most = d;
  }
  return most;
}

static void remember(approach *a) { timeint_point(a->ti, past_state(a, a->n_past++)); }

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
    remember(a);
    st = timeint_period(ti, false);
    if (st == HC_OK && !(timeint_size(ti) <= unbounded * ti->least_length)) st = HC_NOT_FINITE;
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
  if (a->n_past == 0) return rho < 1 && found->moved <= near * size;
  return rho < 1 && found->moved <= 5 * near * size && found->nonlinear <= 0.5 * (1 - rho);
}

/* *found_it: the motion converges to the orbit of k periods next to ti->y, which is then reported. */
static hc_status try_orbit(approach *a, int k, bool *found_it, timeint_result *r)
{
  timeint *ti = a->ti;
  shoot_report found;
  const double size = timeint_motion_size(ti) / ti->length;
  timeint_save(ti);
  *found_it = false;
  hc_status st = shoot_newton(ti->shoot, k, near * size, orbit_goal(ti), a->monitor, &found);
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
  double within = 2 * near * timeint_motion_size(a->ti);
  hc_status st = HC_OK;
  *found_it = false;
  for (int k = next_return(a, 0, within); k > 0 && st == HC_OK && !*found_it; k = next_return(a, k, within)) {
    within = distance_to_past(a, k);
    st = try_orbit(a, k, found_it, r);
  }
  return st;
}

static hc_status report_aperiodic(timeint *ti, timeint_result *r)
{
  const shoot_report none = {.distance = INFINITY, .attainable = INFINITY, .multiplier = NAN};
  const double rate = r->lyapunov, second = r->second_frequency;
  hc_status st = orbit_report(ti, 1, TIMEINT_BY_MARCHING, &none, r);
  r->period_multiple = 0;
  r->lyapunov = rate;
  r->second_frequency = second;
  return st == HC_OK ? HC_APERIODIC : st;
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
  return st == HC_OK && !*done ? report_aperiodic(a->ti, r) : st;
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
    if (!isnan(nu)) return report_aperiodic(ti, r);
  }
  return a->chaotic == TIMES_CHAOTIC ? conclude_chaos(a, done, r) : HC_OK;
}

/* From stretch to stretch; see attract.h. */
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
    hc_status st = integrate_stretch(a, stretch, &done);
    if (st == HC_OK) st = try_to_end(a, done, &done, r);
    if (st != HC_OK || done) return st;
    if ((st = try_aperiodic(a, &done, r)) != HC_OK || done) return st;
    if (a->failures >= MOST_FAILURES) break;
  }
  return march_to_steady_state(ti, a->monitor, r);
}

/* Contacts that change their states ever more often are how some motions without bound end. */
hc_status attract(timeint *ti, int first, const hc_monitor *monitor, timeint_result *r)
{
  approach a = {.ti = ti, .monitor = monitor};
  hc_status st = by_stretches(&a, first, r);
  return st == HC_CHATTER && !(timeint_size(ti) <= unbounded * ti->least_length) ? HC_NOT_FINITE : st;
}
