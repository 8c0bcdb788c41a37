/* sundials_compat.h - the few places where SUNDIALS 6.4 and 7.x differ. For the files that call SUNDIALS: newton.c here
 * and the integrators of timeint/. */
#pragma once

#include "numerics/room.h"

#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_types.h>

_Static_assert(sizeof(sunrealtype) == sizeof(double), "everything outside SUNDIALS is double");

#if SUNDIALS_VERSION_MAJOR >= 7

static inline void hc_sundials_quiet_handler(int line, const char *func, const char *file, const char *msg,
                                             SUNErrCode code, void *data, SUNContext ctx)
{
  (void)line, (void)func, (void)file, (void)msg, (void)code, (void)data, (void)ctx;
}

/* A context that prints nothing: errors are values here. Returns 0, or another number; *ctx is the caller's to free if
 * it is not NULL. Memory is also tested for the vectors, matrices and solvers that are made next (room.h). */
static inline int hc_sundials_context(SUNContext *ctx)
{
  if (!hc_room_for(0)) return 1;
  int err = SUNContext_Create(SUN_COMM_NULL, ctx);
  if (err) return err;
  SUNContext_ClearErrHandlers(*ctx);
  err = SUNContext_PushErrHandler(*ctx, hc_sundials_quiet_handler, NULL);
  return err || hc_room_for(0) ? err : 1;
}

#define HC_KINSOL_QUIET(mem) 0
#define HC_CVODE_QUIET(mem)  0

#else

/* NOLINTNEXTLINE(readability-non-const-parameter): the signature is SUNDIALS' */
static inline void hc_sundials_quiet_handler(int code, const char *module, const char *func, char *msg, void *data)
{
  (void)code, (void)module, (void)func, (void)msg, (void)data;
}

/* A context for one solver, used by one thread. Returns 0, or another number. */
static inline int hc_sundials_context(SUNContext *ctx) { return hc_room_for(0) ? SUNContext_Create(NULL, ctx) : 1; }

/* In 6.x each solver's memory has a handler of its own: errors are values here, so it prints nothing. */
#define HC_KINSOL_QUIET(mem) KINSetErrHandlerFn(mem, hc_sundials_quiet_handler, NULL)
#define HC_CVODE_QUIET(mem)  CVodeSetErrHandlerFn(mem, hc_sundials_quiet_handler, NULL)

#endif

static inline SUNLinearSolver_Type hc_is_direct(SUNLinearSolver ls)
{
  (void)ls;
  return SUNLINEARSOLVER_DIRECT;
}

static inline int hc_release_solver(SUNLinearSolver ls)
{
  ls->content = NULL; /* the owner frees itself */
  SUNLinSolFreeEmpty(ls);
  return 0;
}

/* A direct linear solver with these two functions and `owner` as content; NULL: no memory. */
static inline SUNLinearSolver hc_own_solver(SUNContext ctx, void *owner, int (*setup)(SUNLinearSolver, SUNMatrix),
                                            int (*solve)(SUNLinearSolver, SUNMatrix, N_Vector, N_Vector, sunrealtype))
{
  SUNLinearSolver ls = SUNLinSolNewEmpty(ctx);
  if (!ls) return NULL;
  ls->content = owner;
  ls->ops->gettype = hc_is_direct;
  ls->ops->setup = setup;
  ls->ops->solve = solve;
  ls->ops->free = hc_release_solver;
  return ls;
}
