/* first_solution.h - a solution where nothing is known of it. */
#ifndef HC_HBM_FIRST_SOLUTION_H
#define HC_HBM_FIRST_SOLUTION_H

#include "hbm/hbm_solver.h"

/* A solution X[2H+1] at omega, of whatever is in X: hbm_solve_first that a monitor may stop with HC_INTERRUPTED. Else
 * HC_OK, or why the last ramp ended. */
hc_status hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point);

#endif
