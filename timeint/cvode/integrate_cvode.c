/* integrate_cvode.c - see integrate_cvode.h. */
#include "timeint/cvode/integrate_cvode.h"

#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/sundials_compat.h"
#include "numerics/vectors.h"

enum {
  MAX_STEPS = 1000000, /* from one start to the next: a thousand times those of a difficult period */
  SINGULAR = 1         /* return value of linear_system that makes CVODE try a shorter step */
};

static int rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self)
{
  cvode_integrator *in = self;
  in->interrupted = in->interrupted || !integrate_goes_on(&in->base);
  if (in->interrupted) return -1;
  if (in->equations->rate(in, theta, NV_DATA_S(y), NV_DATA_S(dy))) return 0;
  in->not_finite = true;
  return -1;
}

/* CVODE's Newton matrix, which has no entries: the owner fills, factors and solves its own equations. CVODE's rule for
 * when to renew the Jacobian stays as it is: renewing it in every step was measured 30 % slower, since CVODE then
 * forgets the rate of convergence and takes a second Newton iteration to learn it. */
static int linear_system(sunrealtype theta, N_Vector y, N_Vector dy, SUNMatrix matrix, sunbooleantype keep,
                         sunbooleantype *renewed, sunrealtype gamma, void *self, N_Vector t1, N_Vector t2, N_Vector t3)
{
  (void)theta, (void)dy, (void)matrix, (void)t1, (void)t2, (void)t3;
  cvode_integrator *in = self;
  *renewed = !keep;
  if (!keep) in->equations->linearise(in, NV_DATA_S(y));
  return in->equations->factor(in, gamma) ? 0 : SINGULAR;
}

static SUNMatrix_ID kind_of_matrix(SUNMatrix a)
{
  (void)a;
  return SUNMATRIX_CUSTOM;
}

static SUNMatrix empty_matrix(SUNContext ctx)
{
  SUNMatrix a = SUNMatNewEmpty(ctx);
  if (!a) return NULL;
  a->ops->getid = kind_of_matrix;
  a->ops->destroy = SUNMatFreeEmpty;
  return a;
}

static int setup(SUNLinearSolver ls, SUNMatrix a)
{
  (void)ls, (void)a;
  return 0;
}

static int solve(SUNLinearSolver ls, SUNMatrix a, N_Vector x, N_Vector b, sunrealtype tolerance)
{
  (void)a, (void)tolerance;
  cvode_integrator *in = ls->content;
  if (x != b) memcpy(NV_DATA_S(x), NV_DATA_S(b), (size_t)NV_LENGTH_S(b) * sizeof(double));
  in->equations->solve(in, NV_DATA_S(x));
  return 0;
}

hc_status integrate_begin_period(cvode_integrator *in)
{
  if (!in->called && !hc_room_for(0)) return HC_NO_MEMORY;
  in->called = true;
  in->not_finite = in->interrupted = false;
  in->base.flag = CV_SUCCESS;
  return HC_OK;
}

hc_status integrate_cvode_tolerance(integrator *base, double tolerance)
{
  cvode_integrator *in = (cvode_integrator *)base;
  if (!(tolerance > 0)) return integrate_translate(in, CV_ILL_INPUT);
  in->tolerance = tolerance;
  return HC_OK;
}

/* [1] Largest state within a period, in units of length, about its size at the beginning; beyond: HC_UNBOUNDED. */
static const double most_growth = 1e9;

/* CVODE's weights at y: the error of state i in a step is compared with tolerance (1 + |y_i|) size_i. Fails beyond
 * most_growth: a motion that is unbounded in finite time takes steps without end. */
static int weights(N_Vector y, N_Vector weight, void *self)
{
  const cvode_integrator *in = self;
  const double *size = in->m->size;
  for (int i = 0; i < NV_LENGTH_S(y); ++i) {
    const double within = in->tolerance * (size && i < in->n_sized ? size[i] : 1);
    if (fabs(NV_Ith_S(y, i)) > most_growth) return -1;
    NV_Ith_S(weight, i) = 1 / (within * fabs(NV_Ith_S(y, i)) + within);
  }
  return 0;
}

hc_status integrate_dense_samples(const integrator *in, int r, double theta, double step, int count, double *x)
{
  const cvode_integrator *cv = (const cvode_integrator *)in;
  for (int i = 0; i < count; ++i) {
    if (CVodeGetDky(cv->cv, theta + i * step, 0, cv->dky) != CV_SUCCESS) return HC_BUG; /* outside the step */
    x[i] = scaled_response(cv->m, r, NV_DATA_S(cv->dky));
  }
  return HC_OK;
}

bool integrate_no_fourier(const integrator *in, int r, double out[3])
{
  (void)in, (void)r;
  out[0] = out[1] = out[2] = NAN;
  return false;
}

hc_status integrate_set_up(const int *flags, size_t n)
{
  for (size_t i = 0; i < n; ++i)
    if (flags[i] != CV_SUCCESS) return HC_NO_MEMORY;
  return HC_OK;
}

hc_status integrate_make_parts(cvode_integrator *in, int n, int method, const cvode_equations *equations)
{
  if (!(in->tolerance > 0)) return HC_BAD_INPUT;
  in->equations = equations;
  if (hc_sundials_context(&in->ctx)) return HC_NO_MEMORY;
  in->y = vectors_new(n, in->ctx);
  in->dky = vectors_new(n, in->ctx);
  in->jac = empty_matrix(in->ctx);
  if (!in->y || !in->dky || !in->jac) return HC_NO_MEMORY;
  in->ls = hc_own_solver(in->ctx, in, setup, solve);
  in->cv = CVodeCreate(method, in->ctx);
  if (!in->ls || !in->cv || !hc_room_for(0)) return HC_NO_MEMORY; /* hc_room_for: for CVodeInit */
  N_VConst(0.0, in->y);
  if (CVodeInit(in->cv, rhs, 0.0, in->y) != CV_SUCCESS) return HC_NO_MEMORY; /* first: the other calls need it */
  const int flags[] = {
      HC_CVODE_QUIET(in->cv),
      CVodeWFtolerances(in->cv, weights),
      CVodeSetUserData(in->cv, in),
      CVodeSetLinearSolver(in->cv, in->ls, in->jac),
      CVodeSetLinSysFn(in->cv, linear_system),
      CVodeSetMaxNumSteps(in->cv, MAX_STEPS),
      CVodeSetMaxHnilWarns(in->cv, -1),
  };
  return integrate_set_up(flags, sizeof flags / sizeof *flags);
}

void integrate_free_parts(cvode_integrator *in)
{
  if (in->cv) CVodeFree(&in->cv);
  if (in->ls) SUNLinSolFree(in->ls);
  if (in->jac) SUNMatDestroy(in->jac);
  if (in->dky) N_VDestroy(in->dky);
  if (in->y) N_VDestroy(in->y);
  if (in->ctx) SUNContext_Free(&in->ctx);
  workspace_free(&in->memory);
}

hc_status integrate_translate(cvode_integrator *in, int flag)
{
  if (flag == CV_SUCCESS) return HC_OK;
  in->base.flag = flag;
  if (in->interrupted) return HC_INTERRUPTED;
  if (N_VMaxNorm(in->y) > most_growth) return HC_UNBOUNDED; /* where CVODE stopped */
  if (in->not_finite) return HC_NOT_FINITE;
  return flag == CV_MEM_FAIL ? HC_NO_MEMORY : HC_INTEGRATOR; /* warnings, and flags yet unknown, too */
}

hc_status integrate_check_end(cvode_integrator *in, double theta, int n)
{
  double size = 0;
  for (int i = 0; i < n; ++i) size += fabs(NV_Ith_S(in->y, i));
  if (theta > TWO_PI - 1e-13 && isinf(size)) return HC_UNBOUNDED;
  if (theta > TWO_PI - 1e-13) return isnan(size) ? HC_NOT_FINITE : HC_OK; /* CVODE: within 100 roundings */
  in->base.flag = CV_UNRECOGNIZED_ERR;
  return HC_INTEGRATOR;
}

hc_status integrate_add_counts(cvode_integrator *in)
{
  long steps = 0, evals = 0;
  int flag = CVodeGetNumSteps(in->cv, &steps);
  if (flag == CV_SUCCESS) flag = CVodeGetNumRhsEvals(in->cv, &evals);
  in->base.steps += steps;
  in->base.rhs += evals;
  return integrate_translate(in, flag);
}
