/* steady.h - the steady state of a model at one frequency, and the periodic orbit next to a state. */
#ifndef HC_TIMEINT_STEADY_H
#define HC_TIMEINT_STEADY_H

#include "model/periodic_motion.h"
#include "timeint/timeint.h"

enum { TIMEINT_WAVE = 512 };

/* How a steady state was reached. */
typedef enum timeint_method {
  TIMEINT_BY_CLOSED_FORM, /* no contact changes its state any more: nothing to integrate */
  TIMEINT_BY_SHOOTING,    /* Newton on the period map */
  TIMEINT_BY_ANDERSON,    /* accelerated iteration of the period map */
  TIMEINT_BY_MARCHING     /* period after period until the state repeats itself */
} timeint_method;
const char *timeint_method_name(timeint_method method); /* "closed_form", "shooting", "anderson", "march" */

typedef struct timeint_result {
  double omega;               /* [rad/time] */
  double amplitude, max, min; /* [length] amplitude = (max - min)/2, peaks from dense output */
  double rms, mean;           /* [length] rms of x (mean included) over the reported period */
  double a1, b1, harmonic_1;  /* [length] x ~ a1 cos(omega t) + b1 sin(omega t); harmonic_1 = hypot(a1, b1) */
  double closure;             /* [1] estimated distance to the periodic orbit, drift/(1 - contraction), relative to the
                                 amplitude; may be INFINITY, and more than transient.tolerance where the integration's
                                 own errors, times 1/(1 - contraction), allow no less */
  double attainable;          /* [1] the distance that integration errors allow at best, relative to the amplitude; NaN:
                                 not known */
  double contraction;         /* [1] measured contraction per period of the drift; NaN: could not be measured */
  int periods;                /* forcing periods integrated, all included */
  int scouted;                /* forcing periods followed in closed form beforehand (transient.scout) */
  int period_multiple;        /* of the orbit found, 1 unless a sub-harmonic was found (k <= 16: measures cover k
                                 periods, wave the last); 0 not settled */
  long steps;                 /* CVODE steps, all included */
  long rhs;                   /* right-hand side evaluations */
  timeint_method method;
  double multiplier; /* [1] modulus of the orbit's largest Floquet multiplier over its period_multiple periods; NaN:
                        not known. Of an orbit that was scouted: the exact law's beside it, also where the law is
                        regularised */
  double multiplier_re, multiplier_im;
  int free_sliders;   /* contacts that stick all the time: where their sliders rest, and with them the mean, depends on
                       the start */
  int switches;       /* contact transitions in the reported periods; exact law only */
  int scout_switches; /* the same of the scout's orbit, whose multiplier is reported; -1: there was no scout. They
                         differ next to a grazing shorter than integration errors */
  bool left_orbit;    /* the orbit next to the start is unstable; reported is the one the motion went to from there */
  double lyapunov;    /* [1/period] mean rate at which neighbours drift apart; NaN where it was not measured */
  double second_frequency;     /* [rad/time] of a motion on a torus, between 0 and omega/2, see torus.h; else NaN */
  double regularisation_error; /* [1] of the amplitude, relative; estimated with transient.richardson, else NaN */
  motion_error predicted;      /* [length] what timeint_predict expects; NaN before */
  contact_regime regime;       /* strongest regime of any contact in the reported period */
  int cvode_flag;              /* CVODE's own flag when the status is HC_INTEGRATOR */
  double wave[TIMEINT_WAVE];   /* [length] x at t = i T / TIMEINT_WAVE of the reported period */
} timeint_result;

/* From `state` at omega to the steady state as the settings say; `state` becomes a point on the orbit, *result its
 * measures. transient.richardson: the measures are extrapolated to no regularisation.
 *     auto      where the motion goes. With start: hbm the state is taken for a point next to an orbit: that orbit is
 *               the answer if it is stable; if not, the motion leaves it (left_orbit).
 *     shooting  the period-1 orbit next to the state, stable or not.
 *     march     period after period.
 * HC_OK: settled. HC_NOT_SETTLED after max_periods, HC_APERIODIC when nothing repeats within 16 periods and neighbours
 * drift apart, or the motion runs on a torus: in both *result is the last period. HC_INTEGRATOR,
 * HC_NOT_FINITE, HC_CHATTER; HC_NOT_CONVERGED,
 * HC_SINGULAR, HC_STALLED from shooting alone; HC_BAD_INPUT, HC_NO_MEMORY, HC_INTERRUPTED. */
hc_status timeint_steady(timeint *ti, double omega, double *state, const hc_monitor *monitor, timeint_result *result);

/* The orbit of k forcing periods next to `state` by Newton on the period map, stable or not, whatever
 * transient.steady_state says; the multiplier tells which. Errors as timeint_steady with shooting. 1 <= k <= 16; the
 * orbit may be a shorter one run through several times. */
hc_status timeint_orbit(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                        timeint_result *result);

/* The orbit of k periods through a state that lies next to it already, as that of the same equations integrated with
 * another tolerance does: neither looked for nor scouted. transient.richardson as in timeint_steady. Errors as
 * timeint_orbit. */
hc_status timeint_again(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                        timeint_result *result);

/* r[0..n-1]->predicted: the error that the time integration itself expects in the measures of the first n responses:
 * r[0] is the last result of this handle, to which `state` belongs, r[i] what timeint_response made of it. From its own
 * equations only:
 *     integration     distance from the orbit, and the scatter of periods times |(I - Phi)^-1|
 *     regularisation  twice the change by half of it: it is of first order, or better
 * With a scout that is one plain period of the regularised law, none of the exact. HC_OK, also where nothing can be
 * said (NaN); HC_NO_MEMORY, HC_INTERRUPTED. */
hc_status timeint_predict(timeint *ti, const double *state, const hc_monitor *monitor, int n, timeint_result *r);

/* *r, the last result of this handle, becomes that of response i (counted from 0) of the same periods: its measures.
 * Where the handle has only remembered the orbit its periods are integrated once more. transient.richardson: the
 * extrapolated ones. Errors of integration; HC_BAD_INPUT: there is no such response. */
hc_status timeint_response(timeint *ti, int i, timeint_result *r);

/* With a scout a handle remembers the orbits it found last, and gives them again to a start that leads to one of them.
 * Forget them: the next is integrated whatever it is. */
void timeint_forget(timeint *ti);

/* Stable by its multiplier: +1; -1 not; 0 unknown, or within 1e-9 of the border. */
int timeint_stability(const timeint_result *result);

#endif
