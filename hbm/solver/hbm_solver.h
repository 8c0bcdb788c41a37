/* hbm_solver.h - a solver of the harmonic-balance equations of one model, and a solution at a fixed omega.
 *
 *     R(X, omega) = 0,      X[n] [length]: mean, then cosine and sine of each harmonic (numerics/series.h)
 *
 * of x for an oscillator, n = 2H+1; of a structure, for every coefficient its coordinates (condensation.h), n =
 * hbm_n_coefficients.
 *
 * R is system.h's; the solution is KINSOL's (corrector.h). A solver serves one thread and is opaque; nothing is
 * printed. */
#pragma once

#include "hbm/contact/contact_report.h"
#include "hbm/hbm_settings.h"
#include "model/contact_period.h"
#include "model/model.h"
#include "numerics/base/status.h"

typedef struct hbm_solver hbm_solver;

/* A workspace for m and how it is to be solved (both copied). Errors of hbm_system_init: *out is NULL. */
hc_status hbm_solver_new(const model *m, const hbm_settings *how, hbm_solver **out);
void hbm_solver_free(hbm_solver *s); /* NULL is allowed */

int hbm_n_harmonics(const hbm_solver *s);    /* in use now; after a trace with auto, the most the curve needed */
int hbm_n_samples(const hbm_solver *s);      /* per period, in use now; 0 where forces are exact */
int hbm_n_dof(const hbm_solver *s);          /* of the model */
int hbm_n_contacts(const hbm_solver *s);     /* of the model: one with two tangents is two */
int hbm_n_coefficients(const hbm_solver *s); /* entries of X, with the harmonics in use now */

/* X[hbm_n_coefficients], as a guess, of a motion x[2H+1][n] of all degrees of freedom, coefficient by coefficient. */
void hbm_guess_of(const hbm_solver *s, const double *x, double *X);

/* A source of guesses: ask() fills x[2 n_harm + 1][n] [length], as for hbm_guess_of, with a guess of the solution at
 * omega; HC_NO_MEMORY and HC_INTERRUPTED are passed on, any other failure means there is none. */
typedef struct hbm_guess {
  hc_status (*ask)(void *self, const model *m, double omega, int n_harm, const hc_monitor *monitor, double *x);
  void (*free)(void *self);
  void *self;
} hbm_guess;

/* From now on *g is asked where Newton fails from the linear response; the solver's own, freed with it. */
void hbm_solver_take_guess(hbm_solver *s, const hbm_guess *g);

/* Systems that Newton was put to since the solver was made. */
long hbm_solves(const hbm_solver *s);

/* How many unknowns the equations have at a given omega, and how many Jacobians Newton's method has factored since they
 * were made, there and along the curve together. */
typedef struct hbm_newton_report {
  int unknowns;
  long factorisations;
} hbm_newton_report;
hbm_newton_report hbm_newton_work(const hbm_solver *s);

/* One solution, beside its harmonics. */
typedef struct hbm_point {
  double omega;    /* [rad/time] */
  double residual; /* [1] |R|, largest component, relative to the forces on its coordinate: hbm_system_weights */
  double d_omega;  /* [rad/time] tangent of the curve with respect to its parameter, beside hbm_curve's dX */
  int branch;     /* turning points passed since the start of the curve; of later parts (response_curve.h) counted on */
  int part;       /* of the curve, from 0: points of different parts are not connected */
  int iterations; /* Newton iterations spent on this point; 0: taken from the linear closed form */
  int even_sign;  /* of a symmetric solution hbm_even_sign (corrector.h), which changes at a branch point; else 0 */
  int harmonics;  /* kept at this point: changes along the curve for hbm.harmonics: auto */
  double error;   /* [1] estimated relative error for auto harmonics or samples, NaN when a number was given */
  bool over_join; /* of a curve: reached over a join of rest and slip (continuation.c), which is no turning point */
} hbm_point;

/* Solve at a fixed omega from the guess X[hbm_n_coefficients]; X is the solution on HC_OK and untouched otherwise. A
 * guess of zeros is none: solved as by hbm_first_solution. Errors of newton_solve and of the contact force. */
hc_status hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point);

/* The same, as exact as the tolerance asks and no more: without Newton's last step, which is a fifth of the work where
 * many guesses are tried. A guess of zeros is one. */
hc_status hbm_solve_roughly(hbm_solver *s, double omega, double *X, hbm_point *point);

/* Solve at a fixed omega without a guess: from the linear response, else along ramps of the damping and of the force
 * (ramp.h) or from the guess of hbm_solver_take_guess, in the order of continuation.c. X[hbm_n_coefficients] is
 * overwritten, and is a solution on HC_OK alone. HC_INTERRUPTED, HC_NO_MEMORY, or why the last ramp ended. */
hc_status hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point);

/* X becomes its mirror image, the motion -x(t + T/2), which solves a symmetric model's equations where X does. False,
 * and nothing is changed: the model is not symmetric. */
bool hbm_mirror(const hbm_solver *s, double *X);

/* Measures of one response over its period, from its series x[2H+1]. */
typedef struct hbm_measures {
  double amplitude;  /* [length] (max - min)/2 */
  double max, min;   /* [length] */
  double rms;        /* [length] mean included */
  double mean;       /* [length] x[0] */
  double harmonic_1; /* [length] |x[1] + i x[2]| */
  contact_report contact;
} hbm_measures;

/* The measures of the first response. Errors of the contact force. */
hc_status hbm_measure(hbm_solver *s, const double *X, hbm_measures *out);

/* Response r of the model, counted from 0, of the solution X at omega: its series x[2H+1], or its measures.
 * HC_BAD_INPUT: there is no such response; errors of the contact force; HC_NOT_FINITE: the rest of the structure
 * resonates undamped. */
hc_status hbm_response(hbm_solver *s, double omega, const double *X, int r, double *x);
hc_status hbm_measure_response(hbm_solver *s, double omega, const double *X, int r, hbm_measures *out);

/* x[n] [length] and v[n] [length/time]: the whole structure at t = 0 of the solution X at omega. Errors as of
 * hbm_response; HC_NO_MEMORY. */
hc_status hbm_state(hbm_solver *s, double omega, const double *X, double *x, double *v);

/* N[n_contacts] [force]: the contacts' normal forces at rest, under the static loads alone. HC_SINGULAR: nothing holds
 * the structure there. */
hc_status hbm_preloads(hbm_solver *s, double *N);

/* w[n_contacts] [length]: the sliders at t = 0 of the motion X. Errors of the contact force. */
hc_status hbm_sliders(hbm_solver *s, const double *X, double *w);

/* out[hbm_n_contacts]: of the solution X at omega, every contact by the exact law, also where the equations sample it,
 * those of the case first (contact_periods_merge). Errors of contact_measures_of, planar_measures_of. */
hc_status hbm_measure_contacts(hbm_solver *s, double omega, const double *X, contact_period *out);
