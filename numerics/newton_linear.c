/* newton_linear.c - see newton_linear.h. Which way is taken, and why (times in lu.h and docs/benchmarks.md):
 *     own LU       of few unknowns, and of any number where the BLAS is the reference one: that is slower throughout
 *     LAPACK's LU  from 128 unknowns on with OpenBLAS, which is then twice as fast and soon five times
 *     SPGMR        from 300 unknowns on (3000 with OpenBLAS), where a dozen products and solves with n^2 operations
 *                  each cost less than 2/3 n^3: between two points of a curve the matrix changes little, so that the
 *                  factors of the last point, which its tangent needs in any case, precondition the next one
 * A solve by SPGMR that does not converge is done by factors, and so are the next few. SPGMR makes Newton's method an
 * inexact one that gains five digits an iteration; a converged solution gets its last step, its tangent and the sign of
 * its determinant from factors of its own Jacobian. */
#include "numerics/newton_linear.h"

#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "base/wide_vectors.h"
#include "numerics/dense.h"
#include "numerics/lu.h"

enum { LAPACK_FROM = 128, KRYLOV_FROM = 300, KRYLOV_FROM_FAST = 3000 };
/* A round moves 2 n^2 numbers; so many of them take about half as long as a factorisation. */
enum { UNKNOWNS_A_ROUND = 64, MOST_PENALTY = 8 };
static const double KRYLOV_TOLERANCE = 1e-5; /* of the right side; the step after convergence is by factors */

typedef struct content { /* of our SUNLinearSolver */
  int n, *pivot;         /* [n] */
  newton_work work;
  double *factors;       /* [n][n] of Krylov: LU of the matrix factored last; else they are in the matrix */
  bool factored;         /* there are factors */
  bool fresh;            /* they are those of the matrix at hand */
  SUNLinearSolver spgmr; /* of Krylov */
  N_Vector x, b;         /* [n] of Krylov */
  SUNMatrix matrix;      /* at hand, while SPGMR runs */
  int penalty, distrust; /* SPGMR failed: matrices to factor before it is tried again, the next time and now */
} content;

static SUNLinearSolver_Type type(SUNLinearSolver ls)
{
  (void)ls;
  return SUNLINEARSOLVER_DIRECT;
}

static newton_way chosen(newton_way way, int n)
{
  if (way != NEWTON_AUTO) return way;
  const bool fast = dense_blas_is_fast();
  if (n >= (fast ? KRYLOV_FROM_FAST : KRYLOV_FROM)) return NEWTON_KRYLOV;
  return fast && n >= LAPACK_FROM ? NEWTON_LAPACK_LU : NEWTON_OWN_LU;
}

static double *factors_of(content *c, SUNMatrix a) { return c->factors ? c->factors : SUNDenseMatrix_Data(a); }

static void solve_by_factors(content *c, SUNMatrix a, double *x)
{
  if (c->work.lapack) dense_solve(c->n, factors_of(c, a), c->pivot, x);
  else lu_solve(c->n, factors_of(c, a), c->pivot, x);
}

bool newton_linear_factor(SUNLinearSolver ls, SUNMatrix a)
{
  content *c = ls->content;
  double *factors = factors_of(c, a);
  if (c->factors) memcpy(factors, SUNDenseMatrix_Data(a), (size_t)c->n * (size_t)c->n * sizeof *factors);
  ++c->work.factored;
  c->factored =
      c->work.lapack ? dense_factor(c->n, factors, c->pivot) == HC_OK : lu_factor(c->n, factors, c->pivot) != 0;
  return c->fresh = c->factored;
}

static int setup(SUNLinearSolver ls, SUNMatrix a)
{
  content *c = ls->content;
  const int recoverable = 1; /* KINSOL then returns KIN_LSETUP_FAIL */
  c->fresh = false;
  if (c->factors && c->factored && c->distrust == 0) return 0;
  if (c->distrust > 0) --c->distrust;
  return newton_linear_factor(ls, a) ? 0 : recoverable;
}

/* ---- Krylov ------------------------------------------------------------------------------------------ */

WIDE_VECTORS static int multiply(void *self, N_Vector v, N_Vector z)
{
  content *c = self;
  const double *restrict A = SUNDenseMatrix_Data(c->matrix), *x = N_VGetArrayPointer(v);
  double *restrict y = N_VGetArrayPointer(z);
  const size_t n = (size_t)c->n;
  size_t j = 0;
  memset(y, 0, n * sizeof *y);
  for (; j + 2 <= n; j += 2)
    for (size_t i = 0; i < n; ++i) y[i] += x[j] * A[j * n + i] + x[j + 1] * A[(j + 1) * n + i];
  for (; j < n; ++j)
    for (size_t i = 0; i < n; ++i) y[i] += x[j] * A[j * n + i];
  return 0;
}

static int precondition(void *self, N_Vector r, N_Vector z, sunrealtype tolerance, int side)
{
  content *c = self;
  (void)tolerance, (void)side;
  memcpy(N_VGetArrayPointer(z), N_VGetArrayPointer(r), (size_t)c->n * sizeof(double));
  solve_by_factors(c, c->matrix, N_VGetArrayPointer(z));
  return 0;
}

/* x := A^-1 x; false, and x as it was, where SPGMR does not get there. */
static bool solve_by_krylov(content *c, SUNMatrix a, double *x)
{
  const size_t bytes = (size_t)c->n * sizeof *x;
  c->matrix = a;
  memcpy(N_VGetArrayPointer(c->b), x, bytes);
  N_VConst(0, c->x);
  const double size = sqrt(N_VDotProd(c->b, c->b));
  ++c->work.krylov;
  const bool solved = SUNLinSolSolve(c->spgmr, NULL, c->x, c->b, KRYLOV_TOLERANCE * size) == 0;
  c->work.rounds += SUNLinSolNumIters(c->spgmr);
  if (solved) memcpy(x, N_VGetArrayPointer(c->x), bytes);
  else ++c->work.krylov_failed;
  c->penalty = solved ? 0 : c->penalty == 0 ? 1 : c->penalty < MOST_PENALTY ? 2 * c->penalty : MOST_PENALTY;
  c->distrust = c->penalty;
  return solved;
}

static int solve(SUNLinearSolver ls, SUNMatrix a, N_Vector x, N_Vector b, sunrealtype tolerance)
{
  content *c = ls->content;
  double *to = N_VGetArrayPointer(x);
  const int recoverable = 1;
  (void)tolerance;
  if (x != b) memcpy(to, N_VGetArrayPointer(b), (size_t)c->n * sizeof *to);
  if (c->factors && !c->fresh && solve_by_krylov(c, a, to)) return 0;
  if (c->factors && !c->fresh && !newton_linear_factor(ls, a)) return recoverable;
  solve_by_factors(c, a, to);
  return 0;
}

/* ---- made and freed ---------------------------------------------------------------------------------- */

static int release(SUNLinearSolver ls)
{
  content *c = ls->content;
  if (c) {
    if (c->spgmr) SUNLinSolFree(c->spgmr);
    if (c->x) N_VDestroy(c->x);
    if (c->b) N_VDestroy(c->b);
    free(c->factors);
    free(c->pivot);
    free(c);
  }
  ls->content = NULL;
  SUNLinSolFreeEmpty(ls);
  return 0;
}

static bool make_krylov(content *c, SUNContext ctx)
{
  c->factors = malloc((size_t)c->n * (size_t)c->n * sizeof *c->factors);
  c->x = N_VNew_Serial(c->n, ctx);
  c->b = N_VNew_Serial(c->n, ctx);
  if (!c->factors || !c->x || !c->b) return false;
  if (!(c->spgmr = SUNLinSol_SPGMR(c->x, SUN_PREC_RIGHT, 16 + c->n / UNKNOWNS_A_ROUND, ctx))) return false;
  int bad = SUNLinSolSetATimes(c->spgmr, c, multiply) != 0;
  bad |= SUNLinSolSetPreconditioner(c->spgmr, c, NULL, precondition) != 0;
  bad |= SUNLinSolInitialize(c->spgmr) != 0;
  bad |= SUNLinSolSetup(c->spgmr, NULL) != 0;
  return !bad;
}

SUNLinearSolver newton_linear_solver(int n, newton_way way, SUNContext ctx)
{
  SUNLinearSolver ls = SUNLinSolNewEmpty(ctx);
  content *c = calloc(1, sizeof *c);
  if (!ls || !c) {
    if (ls) SUNLinSolFreeEmpty(ls);
    free(c);
    return NULL;
  }
  ls->content = c;
  ls->ops->gettype = type;
  ls->ops->setup = setup;
  ls->ops->solve = solve;
  ls->ops->free = release;
  c->n = n;
  c->work.way = chosen(way, n);
  c->work.lapack =
      c->work.way == NEWTON_LAPACK_LU || (c->work.way == NEWTON_KRYLOV && dense_blas_is_fast() && n >= LAPACK_FROM);
  c->pivot = calloc((size_t)n, sizeof *c->pivot);
  if (c->pivot && (c->work.way != NEWTON_KRYLOV || make_krylov(c, ctx))) return ls;
  release(ls);
  return NULL;
}

/* LAPACK counts pivots from 1. */
int newton_linear_sign(SUNLinearSolver ls, SUNMatrix a)
{
  content *c = ls->content;
  const double *factors = factors_of(c, a);
  int sign = 1;
  for (int k = 0; k < c->n; ++k) {
    if (factors[(size_t)k * (size_t)(c->n + 1)] < 0) sign = -sign;
    if (c->pivot[k] != (c->work.lapack ? k + 1 : k)) sign = -sign;
  }
  return sign;
}

newton_work newton_linear_work(SUNLinearSolver ls) { return ((const content *)ls->content)->work; }
