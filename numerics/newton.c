/* newton.c - see newton.h. Properties of KINSOL, and the remedy here:
 *   a NaN residual is "success" for KIN_NONE and an endless loop for KIN_LINESEARCH   a positive return refuses z
 *   the default longest step is 1000 |z0|, which is 0 from z = 0                      max_step is always set
 *   the Jacobian is kept for 10 iterations                              one setup an iteration, unless it is to be kept
 *   KIN_STEP_LT_STPTOL is positive, and may be a stall                                the residual decides */
#include "numerics/newton.h"

#include <kinsol/kinsol.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_linearsolver.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "numerics/base/trace.h"
#include "numerics/dense.h"
#include "numerics/grouped.h"
#include "numerics/norm.h"
#include "numerics/sundials_compat.h"
#include "numerics/vectors.h"

struct newton { /* from newton_new, to newton_free; not shared between threads */
  newton_problem problem;
  SUNContext ctx;               /* made first, freed last, this handle's alone */
  N_Vector z, z_scale, r_scale; /* [n] */
  N_Vector r, step;             /* [n] for our own check and polishing */
  SUNMatrix jac;                /* [n][n] overwritten by its factors, unless by_groups */
  SUNLinearSolver ls;
  void *kin;
  int *pivot;        /* [n] of the factors in jac */
  grouped *groups;   /* NULL where the problem has none, or is small */
  bool by_groups;    /* the last factors are those of `groups`, jac is the matrix */
  long factorings;   /* number of factorisations so far */
  double *start;     /* [n] start of the solve */
  bool factored;     /* valid factors exist, of the last solve */
  hc_status refusal; /* status with which the problem last rejected a z */
  int trials;        /* number of residuals since KINSOL's last Jacobian */
};

/* Most residuals between two Jacobians. KINSOL's line search halves its steps until they are 2^-36 of z, in each of two
 * loops; the second is endless if the same z does not give the same residual. */
enum { MOST_TRIALS = 200 };

static int on_residual(N_Vector z, N_Vector r, void *self)
{
  newton *nw = self;
  const double *v = N_VGetArrayPointer(r);
  nw->refusal = nw->problem.residual(nw->problem.self, N_VGetArrayPointer(z), N_VGetArrayPointer(r));
  for (int i = 0; i < nw->problem.n && nw->refusal == HC_OK; ++i)
    if (!isfinite(v[i])) nw->refusal = HC_NOT_FINITE;
  return nw->refusal == HC_OK ? 0 : 1;
}

static int on_jacobian(N_Vector z, N_Vector r, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2)
{
  newton *nw = self;
  (void)r, (void)t1, (void)t2;
  nw->refusal = nw->problem.jacobian(nw->problem.self, N_VGetArrayPointer(z), SUNDenseMatrix_Data(jac));
  return nw->refusal == HC_OK ? 0 : 1;
}

/* on_residual for KINSOL. SUNDIALS 7 reports a failing function in a text that it allocates, and crashes if that fails,
 * too (room.h). Without memory these functions therefore feign a solution, residual 0, so that KINSOL ends; `refusal`
 * keeps the status. */
static int kinsol_residual(N_Vector z, N_Vector r, void *self)
{
  newton *nw = self;
  if (++nw->trials > MOST_TRIALS && nw->refusal != HC_NO_MEMORY) {
    nw->refusal = HC_STALLED;
    return -1;
  }
  if (nw->refusal != HC_NO_MEMORY && on_residual(z, r, nw) == 0) return 0;
  if (nw->refusal != HC_NO_MEMORY) return 1;
  N_VConst(0.0, r);
  return 0;
}

static int kinsol_jacobian(N_Vector z, N_Vector r, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2)
{
  newton *nw = self;
  nw->trials = 0;
  if (trace_on(TRACE_newton))
    trace_line(TRACE_newton, "%d unknowns: residual %.3g", nw->problem.n,
               norm_weighted_max(nw->problem.n, N_VGetArrayPointer(nw->r_scale), N_VGetArrayPointer(r)));
  if (nw->refusal != HC_NO_MEMORY && on_jacobian(z, r, jac, nw, t1, t2) == 0) return 0;
  if (nw->refusal != HC_NO_MEMORY) return 1;
  for (int i = 0; i < nw->problem.n; ++i)
    for (int j = 0; j < nw->problem.n; ++j) SM_ELEMENT_D(jac, i, j) = i == j;
  return 0;
}

/* KINSOL would clear the matrix before each Jacobian: not needed, since all entries are written. */
static int keep_entries(SUNMatrix jac)
{
  (void)jac;
  return 0;
}

/* ---- linear equations: LU in jac itself (dense.h), or beside it (grouped.h), to KINSOL a direct solver ---- */

static int ls_setup(SUNLinearSolver ls, SUNMatrix jac)
{
  newton *nw = ls->content;
  const int recoverable = 1; /* KINSOL then returns KIN_LSETUP_FAIL */
  double *A = SUNDenseMatrix_Data(jac);
  hc_status st;
  ++nw->factorings;
  nw->by_groups = nw->groups && grouped_factor(nw->groups, A, &st);
  if (!nw->by_groups) st = dense_factor(nw->problem.n, A, nw->pivot);
  nw->factored = st == HC_OK;
  return nw->factored ? 0 : recoverable;
}

static int ls_solve(SUNLinearSolver ls, SUNMatrix jac, N_Vector x, N_Vector b, sunrealtype tolerance)
{
  newton *nw = ls->content;
  double *to = N_VGetArrayPointer(x);
  (void)tolerance;
  if (x != b) memcpy(to, N_VGetArrayPointer(b), (size_t)nw->problem.n * sizeof *to);
  if (nw->by_groups) grouped_solve(nw->groups, SUNDenseMatrix_Data(jac), to);
  else dense_solve(nw->problem.n, SUNDenseMatrix_Data(jac), nw->pivot, 1, to);
  return 0;
}

/* ---- made and freed --------------------------------------------------------------------------------------- */

static hc_status make_kinsol(newton *nw)
{
  sunindextype n = nw->problem.n;
  if (hc_sundials_context(&nw->ctx)) return HC_NO_MEMORY;
  N_Vector *const vectors[] = {&nw->z, &nw->z_scale, &nw->r_scale, &nw->r, &nw->step};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i)
    if (!(*vectors[i] = vectors_new(nw->problem.n, nw->ctx))) return HC_NO_MEMORY;
  if (!(nw->jac = SUNDenseMatrix(n, n, nw->ctx))) return HC_NO_MEMORY;
  nw->jac->ops->zero = keep_entries;
  if (!(nw->ls = hc_own_solver(nw->ctx, nw, ls_setup, ls_solve))) return HC_NO_MEMORY;
  if (!(nw->kin = KINCreate(nw->ctx)) || !hc_room_for(0)) return HC_NO_MEMORY;
  int bad = HC_KINSOL_QUIET(nw->kin);
  bad |= KINSetUserData(nw->kin, nw);
  bad |= KINInit(nw->kin, kinsol_residual, nw->z);
  bad |= KINSetLinearSolver(nw->kin, nw->ls, nw->jac);
  bad |= KINSetJacFn(nw->kin, kinsol_jacobian);
  bad |= KINSetMaxSubSetupCalls(nw->kin, 1);  /* with `keeps` KINSOL decides after each step whether to reuse the
                                                 Jacobian */
  bad |= KINSetScaledStepTol(nw->kin, 1e-15); /* small steps do not count as convergence: the residual decides */
  return bad ? HC_NO_MEMORY : HC_OK;
}

hc_status newton_new(const newton_problem *problem, newton **out)
{
  *out = NULL;
  newton *nw = calloc(1, sizeof *nw);
  if (!nw) return HC_NO_MEMORY;
  nw->problem = *problem;
  nw->start = calloc((size_t)problem->n, sizeof(double));
  nw->pivot = calloc((size_t)problem->n, sizeof *nw->pivot);
  hc_status st = nw->start && nw->pivot ? make_kinsol(nw) : HC_NO_MEMORY;
  if (st == HC_OK && problem->n > DENSE_SMALL && problem->group)
    st = grouped_new(problem->n, problem->first_group, problem->group, &nw->groups);
  if (st == HC_OK) {
    *out = nw;
    return HC_OK;
  }
  newton_free(nw);
  return st;
}

void newton_free(newton *nw)
{
  if (!nw) return;
  if (nw->kin) KINFree(&nw->kin);
  if (nw->ls) SUNLinSolFree(nw->ls);
  if (nw->jac) SUNMatDestroy(nw->jac);
  N_Vector const vectors[] = {nw->z, nw->z_scale, nw->r_scale, nw->r, nw->step};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i)
    if (vectors[i]) N_VDestroy(vectors[i]);
  if (nw->ctx) SUNContext_Free(&nw->ctx);
  grouped_free(nw->groups);
  free(nw->pivot);
  free(nw->start);
  free(nw);
}

/* Residual into r, and factors of the Jacobian, at nw->z; nw->factored: it is regular. */
static hc_status factor_here(newton *nw)
{
  if (on_residual(nw->z, nw->r, nw) || on_jacobian(nw->z, nw->r, nw->jac, nw, NULL, NULL)) return nw->refusal;
  ls_setup(nw->ls, nw->jac);
  return HC_OK;
}

hc_status newton_factor_at(newton *nw, const double *z)
{
  memcpy(N_VGetArrayPointer(nw->z), z, (size_t)nw->problem.n * sizeof(double));
  nw->factored = false;
  hc_status st = factor_here(nw);
  return st == HC_OK && !nw->factored ? HC_SINGULAR : st;
}

const double *newton_residual(const newton *nw) { return N_VGetArrayPointer(nw->r); }

int newton_sign(const newton *nw)
{
  if (!nw->factored) return 0;
  return nw->by_groups ? grouped_sign(nw->groups) : dense_sign(nw->problem.n, SUNDenseMatrix_Data(nw->jac), nw->pivot);
}

long newton_factorings(const newton *nw) { return nw->factorings; }

hc_status newton_backsolve(newton *nw, double *x)
{
  size_t bytes = (size_t)nw->problem.n * sizeof(double);
  memcpy(N_VGetArrayPointer(nw->step), x, bytes);
  if (!nw->factored || SUNLinSolSolve(nw->ls, nw->jac, nw->step, nw->step, 0) != 0) return HC_SINGULAR;
  memcpy(x, N_VGetArrayPointer(nw->step), bytes);
  return HC_OK;
}

/* One Newton step from z, whose residual is nw->r; undone if the residual grows and is not far below the tolerance.
 * *better: it was kept. */
static hc_status polish_once(newton *nw, const newton_options *opt, newton_report *report, bool *better)
{
  int n = nw->problem.n;
  double *z = N_VGetArrayPointer(nw->z), *r = N_VGetArrayPointer(nw->r), *step = N_VGetArrayPointer(nw->step);
  const double before = norm_weighted_max(n, opt->r_scale, r);
  *better = false;
  report->residual = before;
  bool solved = nw->factored && SUNLinSolSolve(nw->ls, nw->jac, nw->step, nw->r, 0) == 0;
  if (!solved) return HC_OK; /* a singular Jacobian: z is a solution all the same */
  double length = norm_weighted_max(n, opt->z_scale, step);
  if (!(length <= opt->max_step)) return HC_OK; /* a nearly singular one: the step would not improve z */
  for (int i = 0; i < n; ++i) z[i] -= step[i];
  ++report->iterations;
  double after = on_residual(nw->z, nw->r, nw) ? NAN : norm_weighted_max(n, opt->r_scale, r);
  *better = after <= before || after <= 0.1 * opt->tolerance;
  if (*better) {
    report->residual = after;
    return HC_OK;
  }
  for (int i = 0; i < n; ++i) z[i] += step[i];
  return on_residual(nw->z, nw->r, nw) ? nw->refusal : HC_OK;
}

/* Polishing from a converged z: one Newton step with a new Jacobian; or, with a reused Jacobian, steps while they halve
 * the residual. Leaves the factors used. */
static hc_status polish(newton *nw, const newton_options *opt, newton_report *report)
{
  const bool kept = opt->keeps > 0 && nw->factored && !opt->ends_fresh;
  bool better = true;
  double before;
  hc_status st = kept ? HC_OK : factor_here(nw);
  do {
    before = norm_weighted_max(nw->problem.n, opt->r_scale, N_VGetArrayPointer(nw->r));
    if (st == HC_OK) st = polish_once(nw, opt, report, &better);
  } while (st == HC_OK && kept && better && report->residual > 0 && report->residual <= 0.5 * before);
  return st;
}

/* A solve from nw->start by KINSOL's strategy. */
static hc_status solve_from_start(newton *nw, int strategy, const newton_options *opt, newton_report *report)
{
  size_t bytes = (size_t)nw->problem.n * sizeof(double);
  memcpy(N_VGetArrayPointer(nw->z), nw->start, bytes);
  int bad = KINSetFuncNormTol(nw->kin, opt->tolerance) | KINSetMaxNewtonStep(nw->kin, opt->max_step);
  bad |= KINSetNumMaxIters(nw->kin, opt->max_iterations);
  const bool keeps = opt->keeps > 0 && strategy == KIN_NONE;
  bad |= KINSetMaxSetupCalls(nw->kin, keeps ? opt->max_iterations : 1);
  if (keeps) bad |= KINSetResMonConstValue(nw->kin, opt->keeps);
  if (bad) return HC_NOT_FINITE;
  nw->refusal = HC_OK;
  nw->trials = 0;
  int flag = KINSol(nw->kin, nw->z, strategy, nw->z_scale, nw->r_scale);
  long iterations = 0;
  KINGetNumNonlinSolvIters(nw->kin, &iterations);
  report->iterations += (int)iterations;
  if (nw->refusal == HC_NO_MEMORY) return HC_NO_MEMORY;
  /* The status of a solve: from KINSOL's flag, and from the residual evaluated again at its z. */
  hc_status refusal = nw->refusal;
  bool finite = on_residual(nw->z, nw->r, nw) == 0;
  report->residual = finite ? norm_weighted_max(nw->problem.n, opt->r_scale, N_VGetArrayPointer(nw->r)) : NAN;
  bool small = report->residual <= opt->tolerance;
  switch (flag) {
  case KIN_SUCCESS:
  case KIN_INITIAL_GUESS_OK:
  case KIN_MAXITER_REACHED:
  case KIN_LSETUP_FAIL: return small ? HC_OK : flag == KIN_LSETUP_FAIL ? HC_SINGULAR : HC_NOT_CONVERGED;
  case KIN_STEP_LT_STPTOL:
  case KIN_LINESEARCH_NONCONV: return small ? HC_OK : HC_STALLED;
  case KIN_MEM_FAIL: return HC_NO_MEMORY;
  case KIN_SYSFUNC_FAIL:
  case KIN_FIRST_SYSFUNC_ERR:
  case KIN_REPTD_SYSFUNC_ERR: return refusal != HC_OK ? refusal : HC_NOT_FINITE;
  default: return HC_NOT_CONVERGED; /* so is any new flag */
  }
}

hc_status newton_solve(newton *nw, double *z, const newton_options *opt, newton_report *report)
{
  size_t bytes = (size_t)nw->problem.n * sizeof(double);
  *report = (newton_report){0, NAN};
  nw->factored = false;
  memcpy(nw->start, z, bytes);
  memcpy(N_VGetArrayPointer(nw->z_scale), opt->z_scale, bytes);
  memcpy(N_VGetArrayPointer(nw->r_scale), opt->r_scale, bytes);
  hc_status st = solve_from_start(nw, KIN_NONE, opt, report);
  if (st != HC_OK && st != HC_NO_MEMORY && !opt->plain) st = solve_from_start(nw, KIN_LINESEARCH, opt, report);
  if (st == HC_OK && !(opt->unpolished && nw->factored)) st = polish(nw, opt, report);
  if (st == HC_OK) memcpy(z, N_VGetArrayPointer(nw->z), bytes);
  else nw->factored = false;
  TRACE(newton, "%d unknowns: residual %.3g after %d steps: %s", nw->problem.n, report->residual, report->iterations,
        hc_status_text(st));
  return st;
}
