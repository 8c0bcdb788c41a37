/* first_guess.h - a harmonic-balance solver that asks time integration where to begin. Where the linear response is no
 * guess from which Newton converges, the steady state of the exact law, found in closed form from rest, often is: hbm/
 * and timeint/ do not see each other, and meet here. The solution is harmonic balance's own all the same. */
#pragma once

#include "hbm/solver/hbm_solver.h"
#include "timeint/timeint.h"

/* hbm_solver_new, and the guess. */
hc_status guided_hbm_solver_new(const model *m, const hbm_settings *how, hbm_solver **out);

/* X[(2 n_harm + 1) n]: the harmonics of all DOFs of the orbit next to state[n_states], by time integration as in *how.
 * HC_UNSUPPORTED of more than 100 DOFs; errors of timeint_orbit. */
hc_status harmonics_of_motion(const model *m, const transient_settings *how, double omega, const double *state,
                              int n_harm, const hc_monitor *monitor, double *X);
