/* linear_solution.h - the response in closed form where nothing happens at the contacts: each is as the static state
 * leaves it, stuck where it is preloaded (gap > 0), apart otherwise.
 *
 *     x = Re [ F0 / (K' - M omega^2 + i C omega) exp(i omega t) ],      K' = K + stiffness of the stuck contacts */
#ifndef HC_HBM_LINEAR_SOLUTION_H
#define HC_HBM_LINEAR_SOLUTION_H

#include "hbm/hbm_solver.h"

/* Harmonics X[2H+1] of that response at omega. Returns their norm. */
double hbm_linear_response(const model *m, double omega, int n_harm, double *X);

/* If the linear response is near the guess X (to `near` of its size) and satisfies the equations, it becomes X, with
 * its derivative by omega in dX, both [2H+1], and *point. Otherwise false, and X, dX and *point are untouched. */
bool hbm_linear_point(hbm_solver *s, double omega, double near, double *X, double *dX, hbm_point *point);

#endif
