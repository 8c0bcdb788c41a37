/* measure.h - measures of one or several successive periods, from the integrator's dense output.
 *
 * Peaks: roots of the response's rate, bracketed inside each step (two roots in one step by the extremum of v between
 * them) and refined to rounding; the error of x there is of second order in that of the root. The wave: x at
 * TIMEINT_WAVE equispaced instants; rms is a sum over these. Mean and first harmonic are integrals, step by step: the
 * integrator's own where a step solves a linear equation, else of the quintic through both ends of a step. Sums over
 * the instants would alias: x has a continuous second derivative, its harmonics fall like h^-4, but with a factor that
 * a stiff contact makes large (1e-9 of x on case 2 with kn = 1e4, 1e-6 with kn = 4e6 times the spring). */
#pragma once

#include "numerics/base/workspace.h"
#include "timeint/period/integrate.h"
#include "timeint/timeint_result.h"

#define MEASURE_RESTS 1e-9 /* [range of the motion] a slider that moves by less counts as resting */

typedef struct response_measure { /* of one response r, for an oscillator X */
  double x, p, a;                 /* r, r', r'' at the end of the last step */
  double max, min;
  double sum, sum_sq, sum_cos, sum_sin; /* sums over the instants of the wave */
  double integral[3];                   /* integrals of r, r cos, r sin; not valid if no_integrals */
  double wave[TIMEINT_WAVE];
} response_measure;

/* States of a contact during the periods: a sum of these. */
enum { SEEN_SEPARATED = 1, SEEN_STUCK = 2, SEEN_SLIPPING = 4 };
unsigned char measure_seen(contact_state state);
contact_regime measure_seen_regime(unsigned char seen, const contact *law);

/* Range of a contact's motion x, between steps by the cubic through both ends, with an error of about 1e-5 of it; x, x'
 * at the end of the last step. */
typedef struct contact_range {
  double min, max, x, p;
} contact_range;

typedef struct measure { /* lengths in units of the model's L, until measure_report */
  const scaled_model *m;
  int n_responses, n_contacts;
  int periods;                     /* number of periods begun */
  int next;                        /* index of the next instant of the wave */
  bool no_integrals;               /* some step has no accurate integrals: the sums are used */
  response_measure *response;      /* [n_responses] */
  contact_state *state;            /* [n_contacts] at the end of the last step */
  unsigned char *seen;             /* [n_contacts] SEEN_ values at the ends of steps */
  double *slider;                  /* [n_contacts][2] least and largest W at the ends of steps */
  contact_range *range;            /* [2 n_contacts] ranges of U of all contacts, then of V */
  double *circle;                  /* [TIMEINT_WAVE][2] cos and sin of the instants */
  double *end, *end_rate, *inside; /* [n_states] a state at a step's end, its derivative, a state inside a step */
} measure;

/* For models with n_states equations, n_responses and n_contacts; arrays are memory's. HC_NO_MEMORY. */
hc_status measure_make(measure *me, int n_states, int n_responses, int n_contacts, workspace *memory);

/* Starts a measurement; *m is not copied, and must not change until the last period. */
void measure_begin(measure *me, const scaled_model *m);

/* Call with the state y at the start of each period, before integrate_period(..., measure_step, me). */
void measure_period(measure *me, const double *y);
hc_status measure_step(void *self, const integrator *in, double theta0, double theta1);

/* Number of contacts that never separated and whose slider moved by less than MEASURE_RESTS of the largest response's
 * range (ten times the scatter of CVODE's steps): its place depends on the start. */
int measure_resting_sliders(const measure *me);

/* Alternating parts [length], (max - min)/2, of U of all contacts, V of all contacts, all responses: vibration of
 * state_sizes.h. */
void measure_vibration(const measure *me, double length, double *vibration);

/* max, min, amplitude, rms, mean, a1, b1, harmonic_1 and wave (of the last period) of response i, and the regime of all
 * contacts, into *r; L = length. */
void measure_report(const measure *me, const model *from, int i, double length, timeint_result *r);
