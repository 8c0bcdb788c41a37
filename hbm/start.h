/* start.h - the first point of a response curve. */
#ifndef HC_HBM_START_H
#define HC_HBM_START_H

#include "hbm/hbm.h"

/* Harmonics X[2H+1] of the linear response at omega with every contact as the static state leaves it: stuck where it
 * is preloaded (gap > 0), apart otherwise. Closed form: x = F0 / (K' - M omega^2 + i C omega). Returns its norm. */
double hbm_linear_response(const model *m, double omega, int n_harm, double *X);

/* hbm_solve_first that may be stopped: HC_INTERRUPTED. */
hc_status hbm_solve_start(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point);

/* If the linear response is near the guess X (to `near` of its size) and satisfies the equations, it becomes X, with
 * its derivative by omega in dX: nothing happens at the contacts, so there is nothing to solve. Both [2H+1].
 * Otherwise false and X untouched. */
bool hbm_linear_point(hbm_solver *s, double omega, double near, double *X, double *dX, hbm_point *point);

#endif
