/* integrate_cvode.c - see integrate_cvode.h. */
#include "timeint/cvode/integrate_cvode.h"

#include <math.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "base/constants.h"
#include "numerics/sundials_compat.h"

static SUNMatrix_ID kind_of_matrix(SUNMatrix a)
{
  (void)a;
  return SUNMATRIX_CUSTOM;
}

static void release_matrix(SUNMatrix a)
{
  a->content = NULL; /* the caller's */
  SUNMatFreeEmpty(a);
}

/* structure_newton.h as CVODE's linear solver: the matrix is the structure_newton itself, set by a CVLsLinSysFn; it has
 * no entries. NULL: out of memory. *s stays the caller's, and outlives both. */
static SUNMatrix structure_solver_matrix(structure_newton *s, SUNContext ctx)
{
  SUNMatrix a = SUNMatNewEmpty(ctx);
  if (!a) return NULL;
  a->content = s;
  a->ops->getid = kind_of_matrix;
  a->ops->destroy = release_matrix;
  return a;
}

static SUNLinearSolver_Type kind_of_solver(SUNLinearSolver ls)
{
  (void)ls;
  return SUNLINEARSOLVER_DIRECT;
}

/* structure_solver_set has made the factors. */
static int setup(SUNLinearSolver ls, SUNMatrix a)
{
  (void)ls, (void)a;
  return 0;
}

static int solve(SUNLinearSolver ls, SUNMatrix a, N_Vector x, N_Vector b, sunrealtype tolerance)
{
  (void)a, (void)tolerance;
  structure_newton *s = ls->content;
  const size_t states = 2 * (size_t)s->n + (size_t)s->n_contacts;
  if (x != b) memcpy(NV_DATA_S(x), NV_DATA_S(b), states * sizeof(double));
  structure_newton_solve(s, NV_DATA_S(x));
  return 0;
}

static int release_solver(SUNLinearSolver ls)
{
  ls->content = NULL; /* the caller's */
  SUNLinSolFreeEmpty(ls);
  return 0;
}

static SUNLinearSolver structure_solver_new(structure_newton *s, SUNContext ctx)
{
  SUNLinearSolver ls = SUNLinSolNewEmpty(ctx);
  if (!ls) return NULL;
  ls->content = s;
  ls->ops->gettype = kind_of_solver;
  ls->ops->setup = setup;
  ls->ops->solve = solve;
  ls->ops->free = release_solver;
  return ls;
}

int structure_solver_set(structure_newton *s, const scaled_model *m, const double *y, bool keep, double gamma)
{
  const int recoverable = 1;
  if (!keep) structure_newton_linearise(s, m, y);
  return structure_newton_factor(s, m, gamma) ? 0 : recoverable;
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
  return integrate_translate(in, CVodeSStolerances(in->cv, tolerance, tolerance));
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

int integrate_first_flag(const int *flags, size_t n)
{
  for (size_t i = 0; i < n; ++i)
    if (flags[i] != CV_SUCCESS) return flags[i];
  return CV_SUCCESS;
}

hc_status integrate_make_parts(cvode_integrator *in, int n, int method, structure_newton *newton)
{
  if (hc_sundials_context(&in->ctx)) return HC_NO_MEMORY;
  in->y = N_VNew_Serial(n, in->ctx);
  in->dky = N_VNew_Serial(n, in->ctx);
  in->jac = newton ? structure_solver_matrix(newton, in->ctx) : SUNDenseMatrix(n, n, in->ctx);
  if (!in->y || !in->dky || !in->jac) return HC_NO_MEMORY;
  in->ls = newton ? structure_solver_new(newton, in->ctx) : SUNLinSol_Dense(in->y, in->jac, in->ctx);
  in->cv = CVodeCreate(method, in->ctx);
  return in->ls && in->cv && hc_room_for(0) ? HC_OK : HC_NO_MEMORY; /* room: CVodeInit comes next */
}

void integrate_free_parts(cvode_integrator *in)
{
  if (in->cv) CVodeFree(&in->cv);
  if (in->ls) SUNLinSolFree(in->ls);
  if (in->jac) SUNMatDestroy(in->jac);
  if (in->dky) N_VDestroy(in->dky);
  if (in->y) N_VDestroy(in->y);
  if (in->ctx) SUNContext_Free(&in->ctx);
}

bool integrate_cvode_goes_on(cvode_integrator *in)
{
  in->interrupted = in->interrupted || !integrate_goes_on(&in->base);
  return !in->interrupted;
}

hc_status integrate_translate(cvode_integrator *in, int flag)
{
  if (flag == CV_SUCCESS) return HC_OK;
  in->base.flag = flag;
  if (in->interrupted) return HC_INTERRUPTED;
  if (in->not_finite) return HC_NOT_FINITE;
  return flag == CV_MEM_FAIL ? HC_NO_MEMORY : HC_INTEGRATOR; /* warnings, and flags yet unknown, too */
}

hc_status integrate_check_end(cvode_integrator *in, double theta, int n)
{
  double size = 0;
  for (int i = 0; i < n; ++i) size += fabs(NV_Ith_S(in->y, i));
  if (theta > TWO_PI - 1e-13) return isfinite(size) ? HC_OK : HC_NOT_FINITE; /* CVODE: within 100 roundings */
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
