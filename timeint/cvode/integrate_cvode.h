/* integrate_cvode.h - what the two integrators by CVODE share; for integrate_*.c alone. */
#pragma once

#include <stddef.h>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "numerics/base/workspace.h"
#include "timeint/period/integrate_private.h"

typedef struct cvode_integrator { /* the first member of each kind */
  integrator base;
  const scaled_model *m; /* of the period under way; the caller's */
  bool not_finite;       /* a right-hand side was not finite in the period under way */
  bool interrupted;      /* the monitor stopped it */
  double tolerance;      /* [sizes of states] of a step; > 0 */
  int n_sized;           /* how many of the equations' states have a size; the others are angles */
  bool called;     /* CVODE has been called: its first call allocates, and crashes if it cannot (numerics/room.h) */
  SUNContext ctx;  /* made first, freed last, this integrator's alone */
  N_Vector y, dky; /* [n] what CVODE integrates; dense output */
  SUNMatrix jac;   /* without entries */
  SUNLinearSolver ls;
  void *equations;                           /* the linear ones of a step, the owner's, */
  void (*solve)(void *equations, double *r); /* and how they are solved, from the right-hand side r[n] */
  void *cv;
  workspace memory; /* of the owner's arrays */
} cvode_integrator;

enum { INTEGRATE_SINGULAR = 1 }; /* what a CVLsLinSysFn answers to have CVODE try a shorter step */

/* From the context to CVODE's memory, for n equations by `method` (CV_ADAMS, CV_BDF) whose linear ones are solved by
 * solve_by (the owner's CVLsLinSysFn makes their factors), and back; freeing works half-built. */
hc_status integrate_make_parts(cvode_integrator *in, int n, int method, void *equations,
                               void (*solve_by)(void *equations, double *r));
void integrate_free_parts(cvode_integrator *in);

/* Before a period: HC_NO_MEMORY if CVODE's first call might find none. */
hc_status integrate_begin_period(cvode_integrator *in);

/* At each right-hand side; false: the period ends as interrupted. */
bool integrate_cvode_goes_on(cvode_integrator *in);

/* The status for a flag of CVODE's; the flag is kept for integrate_flag unless it is success. */
hc_status integrate_translate(cvode_integrator *in, int flag);

/* What CVODE calls success is checked: HC_OK if theta is the end of the period and y[n] finite, else HC_INTEGRATOR,
 * HC_NOT_FINITE. */
hc_status integrate_check_end(cvode_integrator *in, double theta, int n);

/* Steps and right-hand sides since CVODE was last started, added to the counts. */
hc_status integrate_add_counts(cvode_integrator *in);

/* The first of n flags that is not CV_SUCCESS, else CV_SUCCESS. */
int integrate_first_flag(const int *flags, size_t n);

/* CVODE's weights at y, a CVEwtFn: the error of a step is held against tolerance (1 + |y_i|) size_i of each state. */
int integrate_weights(N_Vector y, N_Vector weight, void *in);

/* The methods of integrator_class that are the same for both laws: samples one by one by dense output, no integrals,
 * CVODE's tolerance. */
hc_status integrate_dense_samples(const integrator *in, int r, double theta, double step, int count, double *x);
bool integrate_no_fourier(const integrator *in, int r, double out[3]);
hc_status integrate_cvode_tolerance(integrator *in, double tolerance);
