/* timeint.h - the steady state of a scene at one frequency by time integration with CVODE.
 *
 *     x' = v,   M v' = F0 cos(omega t) - C v - K x - sum_j [ T_j cos(alpha_j) + (N_j - N0_j) sin(alpha_j) ]
 *
 * with the contact law of cases/contact_law.h, regularised (law_regularised.h). Phase: t = 0 is the forcing's maximum; every state handed
 * in or out is at a whole number of forcing periods. Handles are opaque, one a thread. Not here: harmonic balance, verdicts. */
#ifndef HC_TIMEINT_H
#define HC_TIMEINT_H

#include "cases/scene.h"
#include "cases/status.h"

enum { TIMEINT_WAVE = 512 };

typedef struct timeint timeint;

/* State at a whole number of periods. w[j]: slider of contact j [length]. */
typedef struct timeint_state {
  double x, v, w[SCENE_MAX_CONTACTS];
} timeint_state;

typedef struct timeint_result {
  double omega;               /* [rad/time] */
  double amplitude, max, min; /* [length] amplitude = (max - min)/2, peaks from dense output */
  double rms, mean;           /* [length] rms of x (mean included) over the reported period */
  double a1, b1, harmonic_1;  /* [length] x ~ a1 cos(omega t) + b1 sin(omega t); harmonic_1 = hypot(a1, b1) */
  double closure; /* [1] estimated distance to the periodic orbit, drift/(1 - contraction), relative to the amplitude; may be INFINITY */
  double contraction; /* [1] measured contraction per period of the drift, or NaN when it could not be measured */
  int periods;        /* forcing periods integrated, all included */
  int period_multiple; /* of the orbit found, 1 unless a sub-harmonic was found (k <= 16: measures cover k periods, wave the last); 0 not settled */
  long steps;          /* CVODE steps, all included */
  long rhs;            /* right-hand side evaluations */
  contact_regime regime;     /* strongest thing that happened in the reported period */
  int cvode_flag;            /* CVODE's own flag when the status is HC_INTEGRATOR */
  double wave[TIMEINT_WAVE]; /* [length] x at t = i T / TIMEINT_WAVE of the reported period */
} timeint_result;

/* A workspace for `sc` (copied). HC_UNSUPPORTED if the scene asks for what this version lacks. */
hc_status timeint_new(const scene *sc, timeint **out);
void timeint_free(timeint *ti);

/* The state of rest in static equilibrium: x = v = w = 0. */
timeint_state timeint_rest(const timeint *ti);

/* From *state at omega to the steady state as the scene's transient options say; *state becomes a point on the orbit, *result its
 * measures.
 * HC_OK settled; HC_NOT_SETTLED after max_periods (result is the last period); HC_INTEGRATOR, HC_NOT_FINITE; HC_INTERRUPTED. */
hc_status timeint_steady(timeint *ti, double omega, timeint_state *state, const hc_monitor *monitor, timeint_result *result);

/* As on a shaker: carry *state from omega_from to omega_to in frequency steps small enough to stay on a branch, partially settling at
 * each; does not settle at omega_to (call timeint_steady for that). */
hc_status timeint_sweep(timeint *ti, double omega_from, double omega_to, timeint_state *state, const hc_monitor *monitor);

#endif
