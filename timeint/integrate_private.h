/* integrate_private.h - what the two integrators share (integrate.c); for integrate*.c alone. */
#ifndef HC_TIMEINT_INTEGRATE_PRIVATE_H
#define HC_TIMEINT_INTEGRATE_PRIVATE_H

#include <stddef.h>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "timeint/integrate.h"

typedef struct integrator_class {
  /* monodromy, watch: or NULL */
  hc_status (*period)(integrator *, const scaled_model *, double *y, double *monodromy, integrate_watch *, void *self);
  hc_status (*dense)(const integrator *, double theta, int order, double *y);
  bool (*slips)(const integrator *, int j, const double *y);
  void (*free)(integrator *);
} integrator_class;

struct integrator { /* the first member of each kind */
  const integrator_class *does;
  long steps, rhs, transitions; /* of all finished periods */
  int flag;                     /* CVODE's last flag other than success */
  bool not_finite;              /* a right-hand side was not finite in the period under way */
  SUNContext ctx;               /* made first, freed last, this integrator's alone */
  N_Vector y, dky;              /* [n] what CVODE integrates; dense output */
  SUNMatrix jac;                /* [n][n] */
  SUNLinearSolver ls;
  void *cv;
  bool called; /* CVODE has been called: its first call allocates, and crashes if it cannot (sundials_compat.h) */
};

/* From the context to CVODE's memory, for n equations by `method` (CV_ADAMS, CV_BDF), and back; freeing works
 * half-built. */
hc_status integrate_make_parts(integrator *in, int n, int method);
void integrate_free_parts(integrator *in);

/* The status for a flag of CVODE's; the flag is kept for integrate_flag unless it is success. */
hc_status integrate_translate(integrator *in, int flag);

/* What CVODE calls success is checked: HC_OK if theta is the end of the period and y[n] finite, else HC_INTEGRATOR,
 * HC_NOT_FINITE. */
hc_status integrate_check_end(integrator *in, double theta, int n);

/* Steps and right-hand sides since CVODE was last started, added to the counts. */
hc_status integrate_add_counts(integrator *in);

/* The first of n flags that is not CV_SUCCESS, else CV_SUCCESS. */
int integrate_first_flag(const int *flags, size_t n);

#endif
