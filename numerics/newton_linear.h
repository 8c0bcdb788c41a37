/* newton_linear.h - the linear solver of newton.c, to KINSOL a direct one whatever it does; private to numerics/. */
#ifndef HC_NEWTON_LINEAR_H
#define HC_NEWTON_LINEAR_H

#include <sundials/sundials_linearsolver.h>

#include "numerics/newton_way.h"

/* For dense n x n matrices; NULL when out of memory. Freed by SUNLinSolFree. A direct way factors the matrix in place;
 * Krylov leaves it as it is, and keeps factors of its own. */
SUNLinearSolver newton_linear_solver(int n, newton_way way, SUNContext ctx);

/* Factors of a, whatever the way; solves are by them until the next setup. False if it is singular. */
bool newton_linear_factor(SUNLinearSolver ls, SUNMatrix a);

/* Sign of the determinant of the matrix factored last. */
int newton_linear_sign(SUNLinearSolver ls, SUNMatrix a);

newton_work newton_linear_work(SUNLinearSolver ls);

#endif
