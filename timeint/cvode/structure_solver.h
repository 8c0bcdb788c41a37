/* structure_solver.h - structure_newton.h as CVODE's linear solver. CVODE's matrix is the structure_newton itself, set
 * by a CVLsLinSysFn (structure_solver_set); it has no entries. */
#ifndef HC_TIMEINT_STRUCTURE_SOLVER_H
#define HC_TIMEINT_STRUCTURE_SOLVER_H

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "timeint/cvode/structure_newton.h"

/* NULL: out of memory. *s stays the caller's, and outlives both. */
SUNMatrix structure_solver_matrix(structure_newton *s, SUNContext ctx);
SUNLinearSolver structure_solver_new(structure_newton *s, SUNContext ctx);

/* What a CVLsLinSysFn has to do, of *s for *m: linearised at y unless CVODE says that the last derivatives will do
 * (keep). 0, or 1 where it is singular: CVODE then tries a shorter step. */
int structure_solver_set(structure_newton *s, const scaled_model *m, const double *y, bool keep, double gamma);

#endif
