/* integrate_cvode.h - common part of the two integrators by CVODE; for integrate_*.c alone. */
#pragma once

#include <stddef.h>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "numerics/base/workspace.h"
#include "timeint/period/integrate_private.h"

typedef struct cvode_integrator cvode_integrator;

/* The equations that CVODE integrates, and the linear ones of a step. y, dy, r: [number of equations]. */
typedef struct cvode_equations {
  bool (*rate)(cvode_integrator *, double theta, const double *y, double *dy); /* false: dy is not finite */
  void (*linearise)(cvode_integrator *, const double *y);                      /* Jacobian J at y */
  bool (*factor)(cvode_integrator *, double gamma);                            /* I - gamma J; false: singular */
  void (*solve)(cvode_integrator *, double *r);                                /* r := (I - gamma J)^-1 r */
} cvode_equations;

struct cvode_integrator { /* the first member of each kind */
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
  const cvode_equations *equations;
  void *cv;
  workspace memory; /* memory of the owner's arrays */
};

/* Makes all parts from the context to CVODE, set up for n equations by `method` (CV_ADAMS, CV_BDF). Freeing works
 * half-built. HC_BAD_INPUT, HC_NO_MEMORY. */
hc_status integrate_make_parts(cvode_integrator *in, int n, int method, const cvode_equations *equations);
void integrate_free_parts(cvode_integrator *in);

/* Before a period: HC_NO_MEMORY if CVODE's first call might find none. */
hc_status integrate_begin_period(cvode_integrator *in);

/* The status for a flag of CVODE; a flag other than success is stored for integrate_flag. */
hc_status integrate_translate(cvode_integrator *in, int flag);

/* Checks the end that CVODE reports: HC_OK if theta is the end of the period and y[n] finite, else HC_INTEGRATOR,
 * HC_UNBOUNDED, HC_NOT_FINITE. */
hc_status integrate_check_end(cvode_integrator *in, double theta, int n);

/* Adds steps and right-hand sides since CVODE was last started to the counts. */
hc_status integrate_add_counts(cvode_integrator *in);

/* HC_OK if all n flags of calls that set CVODE up are CV_SUCCESS. Else HC_NO_MEMORY, whatever the flag: only memory can
 * fail there, and CVodeSetLinearSolver's CVLS_MEM_FAIL has the number of CV_CONV_FAILURE. */
hc_status integrate_set_up(const int *flags, size_t n);

/* Methods of integrator_class common to both: samples by dense output, no integrals, CVODE's tolerance. */
hc_status integrate_dense_samples(const integrator *in, int r, double theta, double step, int count, double *x);
bool integrate_no_fourier(const integrator *in, int r, double out[3]);
hc_status integrate_cvode_tolerance(integrator *in, double tolerance);
