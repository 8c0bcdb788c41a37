/* first_guess.h - a harmonic-balance solver that asks time integration where to begin. Where the linear response is no
 * guess from which Newton converges, the steady state of the exact law, found in closed form from rest, often is: hbm/
 * and timeint/ do not see each other, and meet here. The solution is harmonic balance's own all the same. */
#pragma once

#include "hbm/solver/hbm_solver.h"

/* hbm_solver_new, and the guess. */
hc_status guided_hbm_solver_new(const model *m, const hbm_settings *how, hbm_solver **out);
