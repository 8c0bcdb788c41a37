/* integrate.c - see integrate.h: passes each call to the law's integrator; the parts that both laws' are made of. */
#include "timeint/integrate_private.h"

#include <math.h>

#include "base/constants.h"
#include "numerics/sundials_compat.h"

void integrate_free(integrator *in)
{
  if (in) in->does->free(in);
}

hc_status integrate_tolerance(integrator *in, double tolerance)
{
  return integrate_translate(in, CVodeSStolerances(in->cv, tolerance, tolerance));
}

static hc_status period(integrator *in, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self)
{
  if (!in->called && !hc_room_for(0)) return HC_NO_MEMORY;
  in->called = true;
  return in->does->period(in, m, y, monodromy, watch, self);
}

hc_status integrate_period(integrator *in, const scaled_model *m, double *y, integrate_watch *watch, void *self)
{
  return period(in, m, y, NULL, watch, self);
}

hc_status integrate_monodromy(integrator *in, const scaled_model *m, double *y, double *monodromy)
{
  return period(in, m, y, monodromy, NULL, NULL);
}

hc_status integrate_dense(const integrator *in, double theta, int order, double *y)
{
  return in->does->dense(in, theta, order, y);
}
bool integrate_slips(const integrator *in, int j, const double *y) { return in->does->slips(in, j, y); }

long integrate_steps(const integrator *in) { return in->steps; }
long integrate_rhs(const integrator *in) { return in->rhs; }
long integrate_transitions(const integrator *in) { return in->transitions; }
int integrate_flag(const integrator *in) { return in->flag; }

int integrate_first_flag(const int *flags, size_t n)
{
  for (size_t i = 0; i < n; ++i)
    if (flags[i] != CV_SUCCESS) return flags[i];
  return CV_SUCCESS;
}

hc_status integrate_make_parts(integrator *in, int n, int method)
{
  if (hc_sundials_context(&in->ctx)) return HC_NO_MEMORY;
  in->y = N_VNew_Serial(n, in->ctx);
  in->dky = N_VNew_Serial(n, in->ctx);
  in->jac = SUNDenseMatrix(n, n, in->ctx);
  if (!in->y || !in->dky || !in->jac) return HC_NO_MEMORY;
  in->ls = SUNLinSol_Dense(in->y, in->jac, in->ctx);
  in->cv = CVodeCreate(method, in->ctx);
  return in->ls && in->cv && hc_room_for(0) ? HC_OK : HC_NO_MEMORY; /* room: CVodeInit comes next */
}

void integrate_free_parts(integrator *in)
{
  if (in->cv) CVodeFree(&in->cv);
  if (in->ls) SUNLinSolFree(in->ls);
  if (in->jac) SUNMatDestroy(in->jac);
  if (in->dky) N_VDestroy(in->dky);
  if (in->y) N_VDestroy(in->y);
  if (in->ctx) SUNContext_Free(&in->ctx);
}

hc_status integrate_translate(integrator *in, int flag)
{
  if (flag == CV_SUCCESS) return HC_OK;
  in->flag = flag;
  if (in->not_finite) return HC_NOT_FINITE;
  return flag == CV_MEM_FAIL ? HC_NO_MEMORY : HC_INTEGRATOR; /* warnings, and flags yet unknown, too */
}

hc_status integrate_check_end(integrator *in, double theta, int n)
{
  double size = 0;
  for (int i = 0; i < n; ++i) size += fabs(NV_Ith_S(in->y, i));
  if (theta > TWO_PI - 1e-13) return isfinite(size) ? HC_OK : HC_NOT_FINITE; /* CVODE: within 100 roundings */
  in->flag = CV_UNRECOGNIZED_ERR;
  return HC_INTEGRATOR;
}

hc_status integrate_add_counts(integrator *in)
{
  long steps = 0, evals = 0;
  int flag = CVodeGetNumSteps(in->cv, &steps);
  if (flag == CV_SUCCESS) flag = CVodeGetNumRhsEvals(in->cv, &evals);
  in->steps += steps;
  in->rhs += evals;
  return integrate_translate(in, flag);
}
