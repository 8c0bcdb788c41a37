/* integrate_regularised.c - see integrate.h. BDF with the analytic dense Jacobian of model.c: the sliding slider is stiff (its rate is
 * 1/regularisation). Everything is made in integrate_new; a period allocates nothing. Slopes are CVODES' forward sensitivities to y(0),
 * switched off in periods without; a period with them takes other steps of the same tolerance: y is as good, but not the same bits. */
#include "timeint/integrate_private.h"

#include <stdlib.h>
#include <string.h>

#include <cvodes/cvodes.h>
#include <cvodes/cvodes_ls.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "cases/sundials_compat.h"

static const double two_pi = 6.283185307179586477;
static const double slope_tolerance = 1e-6; /* of the slopes' steps; they are about 1 */

enum {
  MAX_STEPS = 1000000,  /* per period: a thousand times what a hard one takes */
  MAX_ERROR_FAILS = 20, /* per step: a corner is met with a step 1e4 times too long now and then */
  MAX_NEWTON_FAILS = 30
};

typedef struct regularised { /* from integrate_new_regularised, to integrate_free; not shared between threads */
  integrator base;
  int n;            /* number of states                                                  */
  const model *m;   /* of the period under way; the caller's                             */
  bool not_finite;  /* the right-hand side was, in the period under way                  */
  SUNContext ctx;   /* made first, freed last, this integrator's alone                   */
  N_Vector y, dky;  /* [n] the state; dense output                                       */
  N_Vector *s;      /* [n][n] d y / d y_j(0), j = 0..n-1: CVODES calls them sensitivities */
  double *here;     /* [n][n] the Jacobian where their right-hand side is wanted         */
  SUNMatrix jac;    /* [n][n]                                                            */
  SUNLinearSolver ls;
  void *cv;
} regularised;

static int rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self)
{
  regularised *in = self;
  if (model_rhs(in->m, theta, NV_DATA_S(y), NV_DATA_S(dy))) return 0;
  in->not_finite = true;
  return -1;
}

static int jacobian(sunrealtype theta, N_Vector y, N_Vector dy, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2, N_Vector t3)
{
  (void)theta, (void)dy, (void)t1, (void)t2, (void)t3;
  regularised *in = self;
  model_jacobian(in->m, NV_DATA_S(y), SM_DATA_D(jac));
  return 0;
}

/* The variational equations s_j' = J s_j. */
static int slope_rhs(int n, sunrealtype theta, N_Vector y, N_Vector dy, N_Vector *s, N_Vector *ds, void *self, N_Vector t1, N_Vector t2)
{
  (void)theta, (void)dy, (void)t1, (void)t2;
  regularised *in = self;
  model_jacobian(in->m, NV_DATA_S(y), in->here);
  for (int j = 0; j < n; ++j) {
    const double *from = NV_DATA_S(s[j]);
    double *to = NV_DATA_S(ds[j]);
    memset(to, 0, sizeof *to * (size_t)n);
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i) to[i] += in->here[i + k * n] * from[k];
  }
  return 0;
}

static hc_status translate(regularised *in, int flag)
{
  if (flag == CV_SUCCESS) return HC_OK;
  in->base.flag = flag;
  if (in->not_finite) return HC_NOT_FINITE;
  return flag == CV_MEM_FAIL ? HC_NO_MEMORY : HC_INTEGRATOR; /* warnings, and flags yet unknown, too */
}

/* CVODE's rule for when to renew the Jacobian stays as it is: renewing it in every step was measured 30 % slower, since
 * CVODE then forgets the rate of convergence and takes a second Newton iteration to learn it. */
static hc_status make_cvode(regularised *in, double tolerance)
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
  return translate(in, integrate_first_flag(flags, sizeof flags / sizeof *flags));
}

/* Their errors are watched, too, if loosely: without that a step may leap over a corner that hardly moves y and put a slope off by
 * 4e-3 (measured; with it 3e-5 at worst), which costs Newton a step and hides a fold. Staggered: y is solved for first, then all
 * slopes; solving for both at once was measured as dear, and no better. */
static hc_status make_slopes(regularised *in)
{
  double absolute[MODEL_MAX_STATES];
  for (int j = 0; j < in->n; ++j) {
    N_VConst(0.0, in->s[j]);
    absolute[j] = slope_tolerance;
  }
  int flag = CVodeSensInit(in->cv, in->n, CV_STAGGERED, slope_rhs, in->s); /* first: the other calls need it */
  if (flag != CV_SUCCESS) return translate(in, flag);
  const int flags[] = {
      CVodeSensSStolerances(in->cv, slope_tolerance, absolute),
      CVodeSetSensErrCon(in->cv, 1),
      CVodeSensToggleOff(in->cv),
  };
  return translate(in, integrate_first_flag(flags, sizeof flags / sizeof *flags));
}

static hc_status make_parts(regularised *in)
{
  if (hc_sundials_context(&in->ctx)) return HC_NO_MEMORY;
  in->y = N_VNew_Serial(in->n, in->ctx);
  in->dky = N_VNew_Serial(in->n, in->ctx);
  in->jac = SUNDenseMatrix(in->n, in->n, in->ctx);
  in->s = N_VCloneVectorArray(in->n, in->y);
  in->here = calloc((size_t)(in->n * in->n), sizeof *in->here);
  if (!in->y || !in->dky || !in->jac || !in->s || !in->here) return HC_NO_MEMORY;
  in->ls = SUNLinSol_Dense(in->y, in->jac, in->ctx);
  in->cv = CVodeCreate(CV_BDF, in->ctx);
  return in->ls && in->cv ? HC_OK : HC_NO_MEMORY;
}

static void release(integrator *base)
{
  regularised *in = (regularised *)base;
  if (in->cv) CVodeFree(&in->cv);
  if (in->ls) SUNLinSolFree(in->ls);
  if (in->jac) SUNMatDestroy(in->jac);
  if (in->s) N_VDestroyVectorArray(in->s, in->n);
  if (in->dky) N_VDestroy(in->dky);
  if (in->y) N_VDestroy(in->y);
  if (in->ctx) SUNContext_Free(&in->ctx);
  free(in->here);
  free(in);
}

static hc_status set_tolerance(integrator *base, double tolerance)
{
  regularised *in = (regularised *)base;
  return translate(in, CVodeSStolerances(in->cv, tolerance, tolerance));
}

static int start_slopes(regularised *in)
{
  for (int j = 0; j < in->n; ++j) {
    N_VConst(0.0, in->s[j]);
    NV_Ith_S(in->s[j], j) = 1;
  }
  return CVodeSensReInit(in->cv, CV_STAGGERED, in->s);
}

static hc_status start_period(regularised *in, bool slopes)
{
  int flag = CVodeReInit(in->cv, 0.0, in->y);
  if (flag == CV_SUCCESS) flag = slopes ? start_slopes(in) : CVodeSensToggleOff(in->cv);
  if (flag == CV_SUCCESS) flag = CVodeSetStopTime(in->cv, two_pi);
  return translate(in, flag);
}

/* To the end of the period in one call. At tout == tstop 6.4 says CV_SUCCESS, 7 says CV_TSTOP_RETURN. */
static hc_status run(regularised *in)
{
  sunrealtype theta = 0;
  int flag = CVode(in->cv, two_pi, in->y, &theta, CV_NORMAL);
  return flag == CV_TSTOP_RETURN ? HC_OK : translate(in, flag);
}

/* The same steps, one call each. */
static hc_status run_watched(regularised *in, integrate_watch *watch, void *self)
{
  for (sunrealtype theta = 0;;) {
    sunrealtype before = theta;
    int flag = CVode(in->cv, two_pi, in->y, &theta, CV_ONE_STEP);
    if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN) return translate(in, flag);
    hc_status st = watch(self, &in->base, before, theta);
    if (st != HC_OK || flag == CV_TSTOP_RETURN) return st;
    if (!(theta < two_pi)) return HC_OK;
  }
}

static hc_status add_counts(regularised *in)
{
  long steps = 0, evals = 0;
  int flag = CVodeGetNumSteps(in->cv, &steps);
  if (flag == CV_SUCCESS) flag = CVodeGetNumRhsEvals(in->cv, &evals);
  in->base.steps += steps;
  in->base.rhs += evals;
  return translate(in, flag);
}

static hc_status take_slopes(regularised *in, double *slope)
{
  sunrealtype theta;
  int flag = CVodeGetSens(in->cv, &theta, in->s);
  for (int j = 0; j < in->n; ++j) memcpy(slope + j * in->n, NV_DATA_S(in->s[j]), sizeof *slope * (size_t)in->n);
  return translate(in, flag);
}

static hc_status period(integrator *base, const model *m, double *y, double *slope, integrate_watch *watch, void *self)
{
  regularised *in = (regularised *)base;
  const size_t bytes = sizeof *y * (size_t)in->n;
  in->m = m;
  in->not_finite = false;
  base->flag = CV_SUCCESS;
  memcpy(NV_DATA_S(in->y), y, bytes);
  hc_status st = start_period(in, slope != NULL);
  if (st == HC_OK) st = watch ? run_watched(in, watch, self) : run(in);
  hc_status counted = add_counts(in);
  if (st == HC_OK) st = counted;
  if (st == HC_OK && slope) st = take_slopes(in, slope);
  if (st == HC_OK) memcpy(y, NV_DATA_S(in->y), bytes);
  return st;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const regularised *in = (const regularised *)base;
  if (CVodeGetDky(in->cv, theta, order, in->dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->dky), sizeof *y * (size_t)in->n);
  return HC_OK;
}

static bool slides(const integrator *base, int j, const double *y) { return model_slides(((const regularised *)base)->m, j, y); }

static const integrator_class class = {.tolerance = set_tolerance, .period = period, .dense = dense, .slides = slides, .free = release};

hc_status integrate_new_regularised(int n_states, double tolerance, integrator **out)
{
  *out = NULL;
  regularised *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  in->base.does = &class;
  in->n = n_states;
  hc_status st = make_parts(in);
  if (st == HC_OK) st = make_cvode(in, tolerance);
  if (st == HC_OK) st = make_slopes(in);
  if (st == HC_OK) {
    *out = &in->base;
    return HC_OK;
  }
  release(&in->base);
  return st;
}
