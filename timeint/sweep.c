/* sweep.c - from one frequency to another as on a shaker, so that the state stays on the branch it is on.
 *
 * Frequency goes in relative steps of at most 1 %. At each the state settles to a percent of its size, or for MAX_FOLDS e-folds. How
 * far it has gone meanwhile is how far its orbit has moved: the step grows while that is little and
 * shrinks when it is much (where the curve is steep: near resonance, towards a fold), to a tenth of the half width of a resonance at
 * least.
 * A state that is not periodic moves of itself: it goes on, too, in steps no smaller than the first. Not here: knowing that a branch has
 * ended. The state falls off it by itself, as on the shaker. */
#include <complex.h>
#include <math.h>

#include "timeint/internal.h"

static const double largest_step = 1e-2, first_step = 2e-3, smallest_step = 1e-4;
static const double sweep_tolerance = 1e-8;                /* of CVODE: scatters by 1e-6 of the motion */
static const double settled_enough = 1e-2;                 /* of the motion */
static const double moved_little = 0.03, moved_much = 0.1; /* of the motion, from one frequency to the next */
enum { MIN_PERIODS = 4, MAX_FOLDS = 5 };

/* max |a - b| relative to the motion. */
static double apart(const timeint *ti, const double *a, const double *b)
{
  double most = 0;
  for (int i = 0; i < ti->model.n_states; ++i) most = fmax(most, fabs(a[i] - b[i]));
  return most / fmax(timeint_size(ti), ti->least_length);
}

/* How far from rest the state is, from its last two moves: multipliers come as a complex pair, so (x, v/omega) turns by their angle
 * and shrinks; read
 * as complex numbers moves[0], moves[1] have the ratio lambda, and |moves[1]/(1 - lambda)| is left. An estimate (settle.h has the
 * bound). */
static double left_to_go(const double complex moves[2], double move, double slow)
{
  double turn = cabs(1 - moves[1] / moves[0]);
  return move / (turn > slow ? fmin(turn, 1) : slow); /* moves[0] = 0, too */
}

/* Some periods at one frequency. *moved: how far the state went; NaN if it never came to rest. */
static hc_status dwell(timeint *ti, const hc_monitor *monitor, double done, double *moved)
{
  const double slow = fmax(1 - ti->contraction, 1e-3);
  const int most = (int)ceil(MAX_FOLDS / slow);
  double z[3][MODEL_MAX_STATES]; /* before the first period; before and after the last */
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
    moves[1] = z[2][MODEL_X] - z[1][MODEL_X] + I * (z[2][MODEL_P] - z[1][MODEL_P]);
    calm = left_to_go(moves, apart(ti, z[2], z[1]), slow) <= settled_enough ? calm + 1 : 0;
    if (calm == MIN_PERIODS) return HC_OK;
  }
  *moved = NAN;
  return HC_OK;
}

/* Half the width of a linear resonance at half its power, relative to omega. */
static double half_width(const timeint *ti) { return fmax(0.5 * ti->sc.damping / (ti->sc.mass * ti->omega), 1e-6); }

static double next_step(const timeint *ti, double step, double moved)
{
  if (isnan(moved)) return fmax(step, fmin(first_step, half_width(ti)));
  if (moved > moved_much) step *= 0.5;
  if (moved < moved_little) step *= 1.5;
  return fmin(fmax(step, fmin(smallest_step, 0.1 * half_width(ti))), largest_step);
}

hc_status timeint_sweep(timeint *ti, double omega_from, double omega_to, timeint_state *state, const hc_monitor *monitor)
{
  double omega = omega_from, moved = 0;
  hc_status st = timeint_begin(ti, omega, state);
  if (st == HC_OK && !(omega_to > 0 && isfinite(omega_to))) st = HC_BAD_INPUT;
  if (st == HC_OK) st = timeint_set_tolerance(ti, fmax(sweep_tolerance, timeint_final_tolerance(ti)));
  double step = fmin(first_step, half_width(ti));
  const double span = fabs(log(omega_to / omega_from)), sign = omega_to > omega_from ? 1 : -1;
  while (st == HC_OK) {
    double left = fabs(log(omega_to / omega));
    st = dwell(ti, monitor, span > 0 ? 1 - left / span : 1, &moved);
    *state = timeint_now(ti);
    if (st != HC_OK || omega == omega_to) break;
    step = next_step(ti, step, moved);
    omega = left <= 1.2 * step ? omega_to : omega * exp(sign * step);
    st = timeint_begin(ti, omega, state);
  }
  return st;
}
