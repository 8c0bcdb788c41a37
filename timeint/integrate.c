/* integrate.c - see integrate.h. BDF with the analytic dense Jacobian of model.c: the sliding slider is stiff (its rate is
 * 1/regularisation). Everything is made in integrate_new; a period allocates nothing. */
#include "timeint/integrate.h"

#include <stdlib.h>
#include <string.h>

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "cases/sundials_compat.h"

static const double two_pi = 6.283185307179586477;

enum {
  MAX_STEPS = 1000000,  /* per period: a thousand times what a hard one takes */
  MAX_ERROR_FAILS = 20, /* per step: a corner is met with a step 1e4 times too long now and then */
  MAX_NEWTON_FAILS = 30
};

struct integrator { /* from integrate_new, to integrate_free; not shared between threads */
  int n;            /* number of states                                                  */
  const model *m;   /* of the period under way; the caller's                             */
  long steps, rhs;  /* of all finished periods                                           */
  int flag;         /* CVODE's last flag other than success                              */
  bool not_finite;  /* the right-hand side was, in the period under way                  */
  SUNContext ctx;   /* made first, freed last, this integrator's alone                   */
  N_Vector y, dky;  /* [n] the state; dense output                                       */
  SUNMatrix jac;    /* [n][n]                                                            */
  SUNLinearSolver ls;
  void *cv;
};

static int rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self)
{
  integrator *in = self;
  if (model_rhs(in->m, theta, NV_DATA_S(y), NV_DATA_S(dy))) return 0;
  in->not_finite = true;
  return -1;
}

static int jacobian(sunrealtype theta, N_Vector y, N_Vector dy, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2, N_Vector t3)
{
  (void)theta, (void)dy, (void)t1, (void)t2, (void)t3;
  integrator *in = self;
  model_jacobian(in->m, NV_DATA_S(y), SM_DATA_D(jac));
  return 0;
}

static hc_status translate(integrator *in, int flag)
{
  if (flag == CV_SUCCESS) return HC_OK;
  in->flag = flag;
  if (in->not_finite) return HC_NOT_FINITE;
  return flag == CV_MEM_FAIL ? HC_NO_MEMORY : HC_INTEGRATOR; /* warnings, and flags yet unknown, too */
}

/* The first flag of a sequence of calls that was not success. */
static int first_of(const int *flags, size_t n)
{
  for (size_t i = 0; i < n; ++i)
    if (flags[i] != CV_SUCCESS) return flags[i];
  return CV_SUCCESS;
}

/* CVODE's rule for when to renew the Jacobian stays as it is: renewing it in every step was measured 30 % slower, since
 * CVODE then forgets the rate of convergence and takes a second Newton iteration to learn it. */
static hc_status make_cvode(integrator *in, double tolerance)
{
  N_VConst(0.0, in->y);
  int flag = CVodeInit(in->cv, rhs, 0.0, in->y); /* first: the other calls need it */
  if (flag != CV_SUCCESS) return translate(in, flag);
  const int flags[] = {
      HC_CVODE_QUIET(in->cv),
      CVodeSStolerances(in->cv, tolerance, tolerance),
      CVodeSetUserData(in->cv, in),
      CVodeSetLinearSolver(in->cv, in->ls, in->jac),
      CVodeSetJacFn(in->cv, jacobian),
      CVodeSetMaxNumSteps(in->cv, MAX_STEPS),
      CVodeSetMaxErrTestFails(in->cv, MAX_ERROR_FAILS),
      CVodeSetMaxConvFails(in->cv, MAX_NEWTON_FAILS),
      CVodeSetMaxHnilWarns(in->cv, -1),
  };
  return translate(in, first_of(flags, sizeof flags / sizeof *flags));
}

static hc_status make_parts(integrator *in)
{
  if (hc_sundials_context(&in->ctx)) return HC_NO_MEMORY;
  in->y = N_VNew_Serial(in->n, in->ctx);
  in->dky = N_VNew_Serial(in->n, in->ctx);
  in->jac = SUNDenseMatrix(in->n, in->n, in->ctx);
  if (!in->y || !in->dky || !in->jac) return HC_NO_MEMORY;
  in->ls = SUNLinSol_Dense(in->y, in->jac, in->ctx);
  in->cv = CVodeCreate(CV_BDF, in->ctx);
  return in->ls && in->cv ? HC_OK : HC_NO_MEMORY;
}

hc_status integrate_new(int n_states, double tolerance, integrator **out)
{
  *out = NULL;
  integrator *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  in->n = n_states;
  hc_status st = make_parts(in);
  if (st == HC_OK) st = make_cvode(in, tolerance);
  if (st == HC_OK) {
    *out = in;
    return HC_OK;
  }
  integrate_free(in);
  return st;
}

void integrate_free(integrator *in)
{
  if (!in) return;
  if (in->cv) CVodeFree(&in->cv);
  if (in->ls) SUNLinSolFree(in->ls);
  if (in->jac) SUNMatDestroy(in->jac);
  if (in->dky) N_VDestroy(in->dky);
  if (in->y) N_VDestroy(in->y);
  if (in->ctx) SUNContext_Free(&in->ctx);
  free(in);
}

hc_status integrate_tolerance(integrator *in, double tolerance) { return translate(in, CVodeSStolerances(in->cv, tolerance, tolerance)); }

static hc_status start_period(integrator *in)
{
  int flag = CVodeReInit(in->cv, 0.0, in->y);
  if (flag == CV_SUCCESS) flag = CVodeSetStopTime(in->cv, two_pi);
  return translate(in, flag);
}

/* To the end of the period in one call. At tout == tstop 6.4 says CV_SUCCESS, 7 says CV_TSTOP_RETURN. */
static hc_status run(integrator *in)
{
  sunrealtype theta = 0;
  int flag = CVode(in->cv, two_pi, in->y, &theta, CV_NORMAL);
  return flag == CV_TSTOP_RETURN ? HC_OK : translate(in, flag);
}

/* The same steps, one call each. */
static hc_status run_watched(integrator *in, integrate_watch *watch, void *self)
{
  for (sunrealtype theta = 0;;) {
    sunrealtype before = theta;
    int flag = CVode(in->cv, two_pi, in->y, &theta, CV_ONE_STEP);
    if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN) return translate(in, flag);
    hc_status st = watch(self, in, before, theta);
    if (st != HC_OK || flag == CV_TSTOP_RETURN) return st;
    if (!(theta < two_pi)) return HC_OK;
  }
}

static hc_status add_counts(integrator *in)
{
  long steps = 0, evals = 0;
  int flag = CVodeGetNumSteps(in->cv, &steps);
  if (flag == CV_SUCCESS) flag = CVodeGetNumRhsEvals(in->cv, &evals);
  in->steps += steps;
  in->rhs += evals;
  return translate(in, flag);
}

hc_status integrate_period(integrator *in, const model *m, double *y, integrate_watch *watch, void *self)
{
  const size_t bytes = sizeof *y * (size_t)in->n;
  in->m = m;
  in->not_finite = false;
  in->flag = CV_SUCCESS;
  memcpy(NV_DATA_S(in->y), y, bytes);
  hc_status st = start_period(in);
  if (st == HC_OK) st = watch ? run_watched(in, watch, self) : run(in);
  hc_status counted = add_counts(in);
  if (st == HC_OK) st = counted;
  if (st == HC_OK) memcpy(y, NV_DATA_S(in->y), bytes);
  return st;
}

hc_status integrate_dense(const integrator *in, double theta, int order, double *y)
{
  if (CVodeGetDky(in->cv, theta, order, in->dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->dky), sizeof *y * (size_t)in->n);
  return HC_OK;
}

long integrate_steps(const integrator *in) { return in->steps; }
long integrate_rhs(const integrator *in) { return in->rhs; }
int integrate_flag(const integrator *in) { return in->flag; }
