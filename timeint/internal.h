/* internal.h - the handle of timeint.h, for the files of this folder alone.
 *
 * timeint.c makes it and carries states across; steady.c decides how the steady state is found: linear_forever.c
 * (nothing to integrate), shoot.c (Newton on the period map), attract.c (where a motion goes that left its orbit),
 * march.c (waiting); sweep.c follows a branch. */
#ifndef HC_TIMEINT_INTERNAL_H
#define HC_TIMEINT_INTERNAL_H

#include "timeint/integrate.h"
#include "timeint/measure.h"
#include "timeint/settle.h"
#include "timeint/shoot.h"
#include "timeint/timeint.h"

struct timeint {          /* from timeint_new, to timeint_free; not shared between threads                  */
  model *model;           /* a copy: the caller may drop theirs                                             */
  transient_settings how; /* a copy */
  integrator *in;
  integrator *sweeper; /* the exact law's, for sweeps where `in` is not; else NULL                      */
  settle *settle;
  shoot *shoot;
  measure measure;
  scaled_model scaled; /* the equations at omega in units of length                                      */
  double omega;        /* [rad/time]                                                                     */
  double length;       /* [length] about the size of the motion; y is in units of it                     */
  double least_length; /* [length] which the unit never falls below                                      */
  double tolerance;    /* [1] CVODE's at present                                                         */
  double contraction;  /* [1] a priori, per period: exp(-C T/2M)                                         */
  double y[SCALED_MAX_STATES];
  int periods;       /* since timeint_begin                                                            */
  long steps0, rhs0; /* counts at timeint_begin                                                        */
};

/* timeint_steady by waiting: march.c. */
hc_status timeint_march(timeint *ti, const hc_monitor *monitor, timeint_result *r);

/* timeint_steady for `auto`: steady.c for the way to an orbit, attract.c for what becomes of a motion that is next
 * to none. */
hc_status timeint_attract(timeint *ti, int first, const hc_monitor *monitor, timeint_result *r);

/* What a Newton solve answers when there is nothing wrong but that it found no orbit. */
bool timeint_no_orbit(hc_status st);

/* The measures in *r, of the orbit through ti->y, extrapolated to no regularisation: richardson.c. */
hc_status timeint_extrapolate(timeint *ti, const hc_monitor *monitor, timeint_result *r);

/* The k periods from ti->y on, which is on an orbit found by `method`, measured into *r. */
hc_status timeint_report(timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r);

/* Length [L] within which an orbit is found: transient.tolerance of the motion's size, or what the integration's own
 * errors allow. */
double timeint_goal(const timeint *ti);

/* Equations, unit of length and a-priori contraction for omega; y from *state. HC_BAD_INPUT unless omega and *state
 * are finite, omega > 0. */
hc_status timeint_begin(timeint *ti, double omega, const timeint_state *state);

hc_status timeint_set_tolerance(timeint *ti, double tolerance);

/* One period, measured or not; then the unit of length follows the motion. */
hc_status timeint_period(timeint *ti, bool measured);

/* The state now. A contact without friction has its slider where the exact law has it, at u. */
timeint_state timeint_now(const timeint *ti);

/* [length] hypot(x, v/omega) now: the amplitude, if the motion were harmonic and centred. */
double timeint_size(const timeint *ti);

/* What settling is judged by, [2 + n_contacts] [length]: x, v/omega, and by how much x would follow each slider, kt
 * cos(alpha) w/(largest stiffness). */
void timeint_point(const timeint *ti, double *z);

/* CVODE's tolerance for a steady state within transient.tolerance. */
double timeint_final_tolerance(const timeint *ti);

#endif
