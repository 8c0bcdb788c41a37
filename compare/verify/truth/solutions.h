/* solutions.h - the solutions, at given omegas, of equations that the other program may have solved; private to
 * compare/verify/. */
#pragma once

#include "compare/verify/truth/report.h"
#include "hbm/hbm.h"

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
  verify_quantity asked;
  int n, n_coef; /* omegas; numbers of a solution */
  int *first;    /* [n+1] */
  int count;
  verify_solution *of; /* [count] */
  double *X;           /* [count][n_coef] */
} verify_solutions;

/* The motion of a response of the solution X at omega, and its measures. series[2H+1] is room that the motion
 * refers to from then on. Errors of hbm_measure and hbm_response. */
hc_status verify_motion_of_solution(hbm_solver *hbm, double omega, const double *X, int response, double *series,
                                    hbm_measures *m, verify_motion *out);

/* *setup with these equations for its own, but for the change of its model. */
compare_setup verify_settings(const compare_setup *setup, const verify_equations *e);

/* Where solutions are asked for, and the sweep of the curve that passes there. */
typedef struct verify_places {
  double from, to;
  int n;
  const double *omega; /* [n] */
} verify_places;

/* Along their response curve, as far as it comes. A solution that is not found is none.
 * HC_INTERRUPTED, HC_NO_MEMORY, or why there are no such equations. */
hc_status verify_solutions_of(const compare_setup *setup, const verify_equations *e, const verify_quantity *asked,
                              const verify_places *at, const hc_monitor *monitor, verify_solutions *out);

/* The same of every degree of freedom in turn: keep(self, i, its solutions), which are gone when it returns. The curve
 * is followed once. */
typedef void verify_keep_dof(void *self, int dof, const verify_solutions *of);
hc_status verify_solutions_of_dofs(const compare_setup *setup, const verify_equations *e, const verify_quantity *asked,
                                   const verify_places *at, const hc_monitor *monitor, verify_keep_dof *keep,
                                   void *self);

/* By Newton from the solutions `near` of equations with as many harmonics at the same omegas, and from those at the
 * omega before if that is close: sampled equations from exact ones, at a small part of what their curve would cost.
 * omega[] ascends. */
hc_status verify_solutions_near(const compare_setup *setup, const verify_equations *e, const verify_solutions *near,
                                const double *omega, verify_solutions *out);

void verify_solutions_clear(verify_solutions *s);
