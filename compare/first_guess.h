/* first_guess.h - a harmonic-balance solver that asks time integration where to begin. Where the linear response is no
 * guess from which Newton converges, the steady state of the exact law, found in closed form from rest, often is: hbm/
 * and timeint/ do not see each other, and meet here. The solution is harmonic balance's own all the same. */
#pragma once

#include "hbm/solver/hbm_solver.h"
#include "timeint/timeint.h"

/* hbm_solver_new, and the guess. */
hc_status guided_hbm_solver_new(const model *m, const hbm_settings *how, hbm_solver **out);

/* X[hbm_n_coefficients]: the solution that Newton comes to from the harmonics of the orbit next to state[n_states], by
 * time integration of m as in *how. HC_UNSUPPORTED of more than 100 DOFs; errors of timeint_orbit and hbm_solve. */
hc_status solution_of_motion(hbm_solver *s, const model *m, const transient_settings *how, double omega,
                             const double *state, const hc_monitor *monitor, double *X, hbm_point *point);
