/* structure_solver.c - see structure_solver.h. */
#include "timeint/cvode/structure_solver.h"

#include <nvector/nvector_serial.h>
#include <string.h>

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

SUNMatrix structure_solver_matrix(structure_newton *s, SUNContext ctx)
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

SUNLinearSolver structure_solver_new(structure_newton *s, SUNContext ctx)
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
