/* internal.h - the handle of timeint.h, for the files of this folder alone.
 *
 * timeint.c makes it and carries states across; march.c finds the steady state; sweep.c follows a branch. An event-located exact
 * law would bring its own integrate_period; shooting would stand beside march.c and share begin, period and report. */
#ifndef HC_TIMEINT_INTERNAL_H
#define HC_TIMEINT_INTERNAL_H

#include "timeint/integrate.h"
#include "timeint/measure.h"
#include "timeint/settle.h"
#include "timeint/timeint.h"

struct timeint { /* from timeint_new, to timeint_free; not shared between threads                  */
  scene sc;      /* a copy: the caller may drop theirs                                             */
  integrator *in;
  settle *settle;
  measure measure;
  model model;         /* the equations at omega in units of length                                      */
  double omega;        /* [rad/time]                                                                     */
  double length;       /* [length] about the size of the motion; y is in units of it                     */
  double least_length; /* [length] which the unit never falls below                                      */
  double tolerance;    /* [1] CVODE's at present                                                         */
  double contraction;  /* [1] a priori, per period: exp(-C T/2M)                                         */
  double y[MODEL_MAX_STATES];
  int periods;       /* since timeint_begin                                                            */
  long steps0, rhs0; /* counts at timeint_begin                                                        */
};

/* Equations, unit of length and a-priori contraction for omega; y from *state. HC_BAD_INPUT unless omega and *state are finite, omega
 * > 0. */
hc_status timeint_begin(timeint *ti, double omega, const timeint_state *state);

hc_status timeint_set_tolerance(timeint *ti, double tolerance);

/* One period, measured or not; then the unit of length follows the motion. */
hc_status timeint_period(timeint *ti, bool measured);

/* The state now. A contact without friction has its slider where the exact law has it, at u. */
timeint_state timeint_now(const timeint *ti);

/* [length] hypot(x, v/omega) now: the amplitude, if the motion were harmonic and centred. */
double timeint_size(const timeint *ti);

/* What settling is judged by, [2 + n_contacts] [length]: x, v/omega, and by how much x would follow each slider, kt cos(alpha)
 * w/(largest stiffness). */
void timeint_point(const timeint *ti, double *z);

/* CVODE's tolerance for a steady state within the scene's transient.tolerance. */
double timeint_final_tolerance(const timeint *ti);

#endif
