/* first_solution.h - a solution without a guess. */
#ifndef HC_HBM_FIRST_SOLUTION_H
#define HC_HBM_FIRST_SOLUTION_H

#include "hbm/solver/hbm_solver.h"

/* hbm_solve_first that a monitor may stop: a solution X[2H+1] at omega, whatever X is at first. HC_OK, HC_INTERRUPTED,
 * HC_NO_MEMORY, or why the last ramp ended. */
hc_status hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point);

#endif
