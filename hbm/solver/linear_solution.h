/* linear_solution.h - the response in closed form where nothing happens at the contacts: each is as the static state
 * leaves it, stuck where it is pressed on, apart otherwise.
 *
 *     (S_h + K') q_h + constant = phi p_h,      K' = sum over stuck contacts of kt t t^T + kn n n^T
 *
 * The static state is that of the loads of harmonic 0 with all contacts stuck or apart, found by trying: from those
 * that are preloaded (gap > 0) or, under such loads, from all. */
#pragma once

#include "hbm/solver/hbm_solver.h"
#include "hbm/solver/system.h"

/* Harmonics X[n_coef] of that response at omega, with the system's phi and D: a guess of the right order of magnitude
 * where there is no such response. */
void hbm_linear_response(hbm_system *sys, double omega, double *X);

/* N[n_contacts] [force] of each contact at rest, under the loads of harmonic 0. HC_SINGULAR: nothing holds the
 * structure there. */
hc_status hbm_linear_rest(hbm_system *sys, double *N);

/* If the linear response is near the guess X (to `near` in the metric) and satisfies the equations, it becomes X, with
 * its derivative by omega in dX, both [n_coef], and *point. Otherwise false, and X, dX and *point are untouched. */
bool hbm_linear_point(hbm_solver *s, double omega, double near, double *X, double *dX, hbm_point *point);
