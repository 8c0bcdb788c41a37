/* timeint_result.h - what time integration says of one steady state. Plain data. */
#pragma once

#include <stdbool.h>

#include "model/contact_law.h"
#include "model/periodic_motion.h"

enum { TIMEINT_WAVE = 512 };

/* How a steady state was reached. */
typedef enum timeint_method {
  TIMEINT_BY_CLOSED_FORM, /* no contact changes its state any more: nothing to integrate */
  TIMEINT_BY_SHOOTING,    /* Newton on the period map */
  TIMEINT_BY_ANDERSON,    /* accelerated iteration of the period map */
  TIMEINT_BY_MARCHING     /* period after period until the state repeats itself */
} timeint_method;

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
  int closed_form_periods;    /* forcing periods followed in closed form beforehand (transient.scout) */
  int period_multiple;        /* of the orbit found, 1 unless a sub-harmonic was found (k <= 16: measures cover k
                                 periods, wave the last); 0 not settled */
  long steps;                 /* CVODE steps, all included */
  long rhs;                   /* right-hand side evaluations */
  timeint_method method;
  double multiplier; /* [1] modulus of the orbit's largest Floquet multiplier over its period_multiple periods; NaN:
                        not known. Of an orbit first found in closed form: the exact law's beside it, also
                        where the law is regularised */
  double multiplier_re, multiplier_im;
  int free_sliders; /* contacts that stick all the time: where their sliders rest, and with them the mean, depends on
                       the start */
  int switches;     /* contact transitions in the reported periods; exact law only */
  bool left_orbit;  /* the orbit next to the start is unstable; reported is the one the motion went to from there */
  double lyapunov;  /* [1/period] mean rate at which neighbours drift apart; NaN where it was not measured */
  double second_frequency; /* [rad/time] of a motion on a torus, between 0 and omega/2, see aperiodic.h; else NaN */
  double window_low, window_high; /* [length] least and largest amplitude of one period among the next `window`
                                     ones, of a motion that does not repeat; else NaN, window 0 */
  int window;
  double drift;              /* [length/period] of the response of a body that creeps (HC_CREEPS); else NaN */
  motion_error predicted;    /* [length] what timeint_predict expects; NaN before */
  contact_regime regime;     /* strongest regime of any contact in the reported period */
  int cvode_flag;            /* CVODE's own flag when the status is HC_INTEGRATOR */
  double wave[TIMEINT_WAVE]; /* [length] x at t = i T / TIMEINT_WAVE of the reported period */
} timeint_result;
