/* newton.h - Newton by KINSOL for a square system r(z) = 0, with the answer checked by us. Memory is allocated
 * once and reused: a solve allocates nothing, except that SUNDIALS 7 composes and frees a message when KINSol fails.
 * A handle serves one thread. */
#pragma once

#include <stdbool.h>

#include "numerics/base/status.h"

typedef struct newton newton;

typedef struct newton_problem {
  int n;
  void *self;
  hc_status (*residual)(void *self, const double *z, double *r); /* r(z); any other status than HC_OK rejects z */
  hc_status (*jacobian)(void *self, const double *z,
                        double *jac); /* dr/dz, jac[row + n col], all entries, at the z of the last residual */
  int first_group, group; /* sizes of the first group and of the others, if most rows couple one group only (grouped.h);
                             group 0: no groups */
} newton_problem;

typedef struct newton_options {
  const double *z_scale, *r_scale; /* [n] weights: z_scale z and r_scale r are of order 1 */
  double tolerance;                /* largest |r_scale r| accepted */
  double max_step;                 /* longest Newton step, 2-norm of z_scale dz; KINSOL treats less than 1 as 1 */
  int max_iterations;
  bool plain;      /* true: no line search if plain Newton fails */
  bool unpolished; /* true: no polishing step after convergence, unless there are no factors yet */
  double keeps;    /* a Jacobian is reused after a step that reduces the residual to at most this part; 0: a new one for
                      each step. For Jacobians much dearer than residuals; not in the line search. */
  bool ends_fresh; /* with `keeps`: the last step has a new Jacobian, whose factors remain */
} newton_options;

typedef struct newton_report {
  int iterations;  /* Newton iterations, the final polishing one included */
  double residual; /* largest |r_scale r| at the z returned */
} newton_report;

hc_status newton_new(const newton_problem *problem, newton **out); /* HC_NO_MEMORY */
void newton_free(newton *nw);

/* Solve from *z. First plain Newton, then, if that fails, with KINSOL's line search from the same start. A converged z
 * gets one more Newton step (polishing), since its error may be much larger than the tolerance, which is relative to
 * forces that may nearly cancel. HC_STALLED, HC_SINGULAR, HC_NOT_CONVERGED, HC_NOT_FINITE, HC_NO_MEMORY, HC_BAD_INPUT,
 * or the status with which z was rejected; *z is then unchanged. */
hc_status newton_solve(newton *nw, double *z, const newton_options *opt, newton_report *report);

/* [n] r at the z of the last newton_solve; valid if that returned HC_OK. */
const double *newton_residual(const newton *nw);

/* x := J^-1 x with the last factored Jacobian: of the last solve's end, with `keeps` the one reused last, of an
 * unpolished solve that of its last step. HC_SINGULAR, also after a failed solve. */
hc_status newton_backsolve(newton *nw, double *x);

/* Evaluate and factor the Jacobian at z, for newton_backsolve and newton_sign. HC_SINGULAR, or the status with which z
 * was rejected. */
hc_status newton_factor_at(newton *nw, const double *z);

/* Sign of the determinant of the Jacobian of the last solve's end or newton_factor_at; 0 if it is singular. */
int newton_sign(const newton *nw);

/* Number of Jacobians factored so far. */
long newton_factorings(const newton *nw);
