/* solutions.h - the solutions, at given omegas, of equations that the other program may have solved; private to
 * compare/verify/. */
#pragma once

#include "compare/response.h"
#include "compare/verify/truth/report.h"

enum { VERIFY_READINGS = 19 }; /* quantities that a column may hold instead of what the file says, that one first */

enum { VERIFY_MOST_SOLUTIONS = 16 }; /* at one omega from guesses; sampled equations may have many */

typedef struct verify_solution {
  double q[VERIFY_READINGS], scale[VERIFY_READINGS]; /* the quantities, and what their differences are measured by */
} verify_solution;

/* Reading number i of a file that says it holds *asked; *cause gets the bit of what is wrong with it then, 0 of none.
 * False: this one is no other than an earlier one. */
bool verify_reading(int i, const verify_quantity *asked, verify_quantity *out, verify_causes *causes);

/* Solutions first[i] .. first[i+1]-1 are those at omega[i]. */
typedef struct verify_solutions {
  int n, n_responses, length; /* omegas; responses that are read; numbers of a motion */
  int *first;                 /* [n+1] */
  int count;
  verify_solution *of; /* [count][n_responses] */
  double *x; /* [count][length] the motion of all degrees of freedom, [2H+1][dofs], which Newton may start from */
} verify_solutions;

/* *m with the responses that are asked for, and every degree of freedom behind them (an oscillator as it is): what all
 * below is asked of. HC_NO_MEMORY: *out is NULL. */
hc_status verify_model_seen(const model *m, int n, const int *response, model **out);

/* The motion of a response of the solution X at omega, and its measures. series[2H+1] is room that the motion
 * refers to from then on. Errors of hbm_measure and hbm_response. */
hc_status verify_motion_of_solution(hbm_solver *hbm, double omega, const double *X, int response, double *series,
                                    hbm_measures *m, verify_motion *out);

/* *setup with these equations for its own, but for the change of its model. */
compare_setup verify_settings(const compare_setup *setup, const verify_equations *e);

enum { VERIFY_FEW_SAMPLES = 4 }; /* a harmonic: such equations have many solutions */

/* The truth's curves, each traced once for all that ask for it; of the case's own model. n = 0: none yet. */
typedef struct verify_curve {
  int harmonics;
  double from, to;
  response_curve response;
} verify_curve;

typedef struct verify_curves {
  const model *model;
  int n;
  verify_curve *of;
} verify_curves;

/* *out: the one with exact forces and so many harmonics; NULL where there is none. Errors of response_trace: *out may
 * be there all the same, as far as it came. */
hc_status verify_curve_of(verify_curves *curves, const compare_setup *setup, int harmonics, double from, double to,
                          const hc_monitor *monitor, const response_curve **out);
void verify_curves_clear(verify_curves *curves);

/* Where solutions are asked for, and the sweep of the curve that passes there; what of the first responses is read. */
typedef struct verify_places {
  double from, to;
  int n;
  const double *omega; /* [n] ascending */
  const bool *only;    /* [n] at these alone; NULL: at all */
  int n_responses;
  const verify_quantity *asked; /* [n_responses] */
  const double *value;          /* [n_responses][stride] what the file has there, or NaN; NULL: not known */
  int stride;
  const verify_curves *curves; /* verify_solutions_of: the truth's; or NULL */
  bool plainly;                /* verify_solutions_near: from `near` alone where that leads to a solution */
} verify_places;

/* Along their response curve, as far as it comes. A solution that is not found is none.
 * HC_INTERRUPTED, HC_NO_MEMORY, or why there are no such equations. */
hc_status verify_solutions_of(const compare_setup *setup, const verify_equations *e, const verify_places *at,
                              const hc_monitor *monitor, verify_solutions *out);

/* A degree of freedom in the place of each response that is wrong, or taken from it: of[k][r] of the motions that are
 * there. */
void verify_solutions_move(verify_solutions *s, const verify_places *at, const model *m, int dof, bool relative,
                           const bool *wrong);

/* By Newton from the solutions `near` of other equations at the same omegas; from those scaled to the file's values,
 * where none is near these; and from those at the omega before if that is close: at a small part of what their curve
 * would cost. */
hc_status verify_solutions_near(const compare_setup *setup, const verify_equations *e, const verify_solutions *near,
                                const verify_places *at, verify_solutions *out);

void verify_solutions_clear(verify_solutions *s);
