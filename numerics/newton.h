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
  hc_status (*residual)(void *self, const double *z, double *r); /* r(z); anything but HC_OK refuses z */
  hc_status (*jacobian)(void *self, const double *z,
                        double *jac); /* dr/dz, jac[row + n col], all of it, at the last residual's z */
  int first_group, group; /* unknowns of the first group, then of each, where most rows stay within theirs (grouped.h);
                             group is 0 where there are none */
} newton_problem;

typedef struct newton_options {
  const double *z_scale, *r_scale; /* [n] weights: z_scale z and r_scale r are of order 1 */
  double tolerance;                /* largest |r_scale r| accepted */
  double max_step;                 /* longest Newton step, 2-norm of z_scale dz; KINSOL treats less than 1 as 1 */
  int max_iterations;
  bool plain;      /* no line search where plain Newton fails */
  bool unpolished; /* z as it converged: the last step is not taken, but for factors where there are none */
  double keeps;    /* a Jacobian serves on after a step that leaves at most this part of the residual, where a residual
                   takes much less than a Jacobian; 0: each step has its own. Not in the line search. */
  bool ends_fresh; /* with `keeps`, too, the last step has its own, whose factors are left */
} newton_options;

typedef struct newton_report {
  int iterations;  /* Newton iterations, the final polishing one included */
  double residual; /* largest |r_scale r| at the z returned */
} newton_report;

hc_status newton_new(const newton_problem *problem, newton **out); /* HC_NO_MEMORY */
void newton_free(newton *nw);

/* Solve from *z. First plain Newton, then, if that fails, with KINSOL's line search from the same start. A converged
 * z gets one more Newton step, since its error may be much larger than the tolerance: that is relative to forces that
 * may nearly cancel. With `plain` there is no line search, with `unpolished` no last step. HC_STALLED, HC_SINGULAR,
 * HC_NOT_CONVERGED, HC_NOT_FINITE, HC_NO_MEMORY, HC_BAD_INPUT, or why z was refused: *z is then as it was given. */
hc_status newton_solve(newton *nw, double *z, const newton_options *opt, newton_report *report);

/* [n] r at the z that the last newton_solve returned, where it was HC_OK. */
const double *newton_residual(const newton *nw);

/* x := J(z)^-1 x with the Jacobian of the last solve's end, or the last one kept; of an unpolished solve with that of
 * its last step. HC_SINGULAR, also after a solve that failed. */
hc_status newton_backsolve(newton *nw, double *x);

/* Evaluate and factor the Jacobian at z, for newton_backsolve and newton_sign. HC_SINGULAR, or why z was refused. */
hc_status newton_factor_at(newton *nw, const double *z);

/* Sign of the determinant of the Jacobian of the last solve's end or newton_factor_at; 0 if it is singular. */
int newton_sign(const newton *nw);

/* How many Jacobians have been factored so far. */
long newton_factorings(const newton *nw);
