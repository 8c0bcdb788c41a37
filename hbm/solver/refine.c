/* refine.c - see refine.h. */
#include "hbm/solver/refine.h"

#include <float.h>
#include <string.h>

#include "numerics/dense.h"
#include "numerics/norm.h"

struct refinement {
  hbm_system sys;
  double *X;      /* [n_coef] padded */
  double *R;      /* [n] residual, then step */
  double *change; /* [n_coef] that step, with the means */
  double *jac;    /* [n][n] */
  int *pivot;     /* [n] */
  workspace memory;
};

hc_status refinement_new(const hbm_system *of, const hbm_settings *how, int n_harm, int n_time, refinement **out)
{
  *out = NULL;
  refinement *r = calloc(1, sizeof *r);
  if (!r) return HC_NO_MEMORY;
  hc_status st = hbm_system_init(&r->sys, of->model, how, n_harm, n_time, of->metric);
  size_t n = (size_t)r->sys.n_coef;
  r->X = workspace_doubles(&r->memory, n);
  r->R = workspace_doubles(&r->memory, n);
  r->change = workspace_doubles(&r->memory, n);
  r->jac = workspace_doubles(&r->memory, n * n);
  r->pivot = workspace_array(&r->memory, n, sizeof *r->pivot);
  if (st == HC_OK && r->memory.failed) st = HC_NO_MEMORY;
  if (st == HC_OK) {
    *out = r;
    return HC_OK;
  }
  refinement_free(r);
  return st;
}

void refinement_free(refinement *r)
{
  if (!r) return;
  hbm_system_clear(&r->sys);
  workspace_free(&r->memory);
  free(r);
}

int refinement_harmonics(const refinement *r) { return r->sys.n_harm; }

/* The length, at Y, of the change of the unknowns that r->R holds. */
static double length_at(refinement *r, const double *Y)
{
  const metric_at at = {r->sys.metric, r->sys.n_coef, Y, NULL};
  memset(r->change, 0, (size_t)r->sys.first * sizeof *r->change);
  memcpy(r->change + r->sys.first, r->R, (size_t)r->sys.n * sizeof *r->change);
  return metric_length(&at, r->change);
}

hc_status refinement_step(refinement *r, double omega, double *Y, double *step)
{
  const int n = r->sys.n;
  *step = INFINITY;
  hc_status st = hbm_system_residual(&r->sys, omega, Y, r->R);
  if (st != HC_OK) return st;
  hbm_system_jacobian(&r->sys, omega, n, r->jac);
  if (dense_factor(n, r->jac, r->pivot) != HC_OK) return HC_SINGULAR;
  dense_solve(n, r->jac, r->pivot, 1, r->R);
  const double length = length_at(r, Y);
  if (!isfinite(length)) return HC_NOT_FINITE;
  for (int i = 0; i < n; ++i) Y[i + r->sys.first] -= r->R[i];
  *step = length;
  return HC_OK;
}

hc_status refinement_response(refinement *r, double omega, const double *Y, int response, double *x)
{
  return hbm_system_any_response(&r->sys, omega, Y, response, x);
}

hc_status refinement_orbit(refinement *r, const double *Y, const contact_forces **orbit)
{
  *orbit = r->sys.contacts;
  return hbm_system_contact(&r->sys, Y, false);
}

double refinement_rounding(refinement *r, double omega)
{
  const int n = r->sys.n;
  hbm_system_sizes(&r->sys, omega, r->sys.all, r->sys.moved);
  for (int i = 0; i < n; ++i) r->R[i] = DBL_EPSILON * r->sys.all[i % r->sys.dim];
  dense_solve(n, r->jac, r->pivot, 1, r->R);
  const double length = length_at(r, r->sys.X);
  return isfinite(length) ? length : INFINITY;
}

double refinement_error(refinement *r, double omega, int n_harm, const double *X)
{
  double step;
  memset(r->X, 0, (size_t)r->sys.n_coef * sizeof(double));
  memcpy(r->X, X, (size_t)hbm_system_length(&r->sys, n_harm) * sizeof(double));
  return refinement_step(r, omega, r->X, &step) == HC_OK ? step : INFINITY;
}

int refine_next_harmonics(int n_harm, bool up)
{
  static const int ladder[] = {1, 2, 3, 5, 7, 10, 14, 20, 28, 40, 56, 80, REFINE_MOST_HARMONICS};
  enum { RUNGS = sizeof ladder / sizeof *ladder };
  int i = 0;
  while (i + 1 < RUNGS && ladder[i] < n_harm) ++i;
  if (up) return ladder[i + 1 < RUNGS ? i + 1 : i];
  return ladder[i > 0 ? i - 1 : 0];
}
