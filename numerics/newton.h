/* newton.h - full Newton by KINSOL for a square system r(z) = 0, with the answer checked by us. Memory is made once
 * and reused by every solve; nothing is allocated in a solve, but for the message SUNDIALS 7 composes and frees when
 * KINSol fails. One handle a thread. */
#ifndef HC_NEWTON_H
#define HC_NEWTON_H

#include "base/status.h"

typedef struct newton newton;

typedef struct newton_problem {
  int n;
  void *self;
  hc_status (*residual)(void *self, const double *z, double *r);   /* anything but HC_OK: z is refused */
  hc_status (*jacobian)(void *self, const double *z, double *jac); /* jac[row + n col], at the z of the last residual */
} newton_problem;

typedef struct newton_options {
  const double *z_scale, *r_scale; /* [n] weights: z_scale z and r_scale r are of order 1 */
  double tolerance;                /* largest |r_scale r| accepted */
  double max_step;                 /* longest Newton step, 2-norm of z_scale dz; KINSOL takes less than 1 for 1 */
  int max_iterations;
} newton_options;

typedef struct newton_report {
  int iterations;  /* Newton iterations, the final polishing one included */
  double residual; /* largest |r_scale r| at the z returned */
} newton_report;

hc_status newton_new(const newton_problem *problem, newton **out);
void newton_free(newton *nw);

/* Solve from *z. First plain Newton, then, if that fails, with KINSOL's line search from the same start. A converged
 * z gets one more Newton step: the tolerance is relative to forces that may nearly cancel, so the error in z may
 * still be large against it. HC_OK; HC_STALLED, HC_NOT_CONVERGED, HC_SINGULAR, HC_NOT_FINITE, HC_NO_MEMORY: *z is
 * then as it was given. */
hc_status newton_solve(newton *nw, double *z, const newton_options *opt, newton_report *report);

/* x := J(z)^-1 x with the Jacobian of the last solve's end. HC_SINGULAR, also after a solve that failed. */
hc_status newton_backsolve(newton *nw, double *x);

/* Evaluate and factor the Jacobian at z, for newton_backsolve and newton_sign, without solving. */
hc_status newton_factor_at(newton *nw, const double *z);

/* Sign of the determinant of the Jacobian of the last solve's end or newton_factor_at; 0 if it is singular. */
int newton_sign(const newton *nw);

#endif
