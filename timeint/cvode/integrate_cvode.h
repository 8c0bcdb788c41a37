/* integrate_cvode.h - common part of the two integrators by CVODE; for integrate_*.c alone. */
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
  const scaled_model *m; /* model of the current period; not owned */
  bool not_finite;       /* a right-hand side of the current period was not finite */
  bool interrupted;      /* the monitor stopped the current period */
  double tolerance;      /* [sizes of states] tolerance of a step; > 0 */
  int n_sized;           /* number of states with a size; the others are angles */
  bool called;     /* CVODE has been called: its first call allocates, and crashes if it cannot (numerics/room.h) */
  SUNContext ctx;  /* made first, freed last, this integrator's alone */
  N_Vector y, dky; /* [n] state integrated by CVODE; dense output */
  SUNMatrix jac;   /* without entries, see integrate_cvode.c */
  SUNLinearSolver ls;
  void *equations;                           /* linear equations of a step; not owned */
  void (*solve)(void *equations, double *r); /* solves them; r[n]: right-hand side, then solution */
  void *cv;
  workspace memory; /* memory of the owner's arrays */
} cvode_integrator;

enum { INTEGRATE_SINGULAR = 1 }; /* return value of a CVLsLinSysFn that makes CVODE try a shorter step */

/* Makes all parts from the context to CVODE's memory, for n equations by `method` (CV_ADAMS, CV_BDF), whose linear
 * equations solve_by solves (the owner's CVLsLinSysFn factors them). Freeing works half-built. HC_BAD_INPUT,
 * HC_NO_MEMORY. */
hc_status integrate_make_parts(cvode_integrator *in, int n, int method, void *equations,
                               void (*solve_by)(void *equations, double *r));
void integrate_free_parts(cvode_integrator *in);

/* Before a period: HC_NO_MEMORY if CVODE's first call might find none. */
hc_status integrate_begin_period(cvode_integrator *in);

/* Call at each right-hand side; false: the monitor interrupts the period. */
bool integrate_cvode_goes_on(cvode_integrator *in);

/* The status for a flag of CVODE; a flag other than success is stored for integrate_flag. */
hc_status integrate_translate(cvode_integrator *in, int flag);

/* Checks the end that CVODE reports: HC_OK if theta is the end of the period and y[n] finite, else HC_INTEGRATOR,
 * HC_UNBOUNDED, HC_NOT_FINITE. */
hc_status integrate_check_end(cvode_integrator *in, double theta, int n);

/* Adds steps and right-hand sides since CVODE was last started to the counts. */
hc_status integrate_add_counts(cvode_integrator *in);

/* The first of n flags that is not CV_SUCCESS, else CV_SUCCESS. */
int integrate_first_flag(const int *flags, size_t n);

/* CVODE's weights at y, a CVEwtFn: the error of state i in a step is compared with tolerance (1 + |y_i|) size_i. */
int integrate_weights(N_Vector y, N_Vector weight, void *in);

/* Methods of integrator_class common to both: samples by dense output, no integrals, CVODE's tolerance. */
hc_status integrate_dense_samples(const integrator *in, int r, double theta, double step, int count, double *x);
bool integrate_no_fourier(const integrator *in, int r, double out[3]);
hc_status integrate_cvode_tolerance(integrator *in, double tolerance);
