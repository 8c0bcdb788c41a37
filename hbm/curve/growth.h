/* growth.h - does a response curve go to infinity at a finite frequency? By energy, of a motion x with harmonics x_h:
 *
 *     E = 1/4 sum_h (h omega)^2 x_h^H M x_h          [force length] kinetic energy, averaged over a period
 *     W = pi sum_k k |x_k^H p_k|                     the most that the loads can do in a period, in the best phase
 *     D = pi omega sum_h h^2 |x_h^H C x_h|           what damping takes in a period
 *
 * Over a period the loads do what damping and friction take. In proportion to the amplitude A, E and D grow as A^2, W
 * as A, and so does what friction under bounded normal forces takes, 4 mu N a slider and unit of its amplitude. Where E
 * is far above W, loads and friction no longer tell at which amplitude the motion is; damping alone could. Coulomb
 * friction and an undamped spring: F > 4 mu N/pi (Den Hartog 1931), with the natural frequency of the open mass. */
#pragma once

#include "hbm/solver/hbm_solver.h"

/* *grows: E > 1e6 W, and D < 1e-6 W: damping would limit the motion at 1e12 times the static amplitude at the earliest,
 * where the loads are below hbm.tolerance of the forces that cancel. HC_NO_MEMORY; HC_NOT_FINITE as of hbm_response. */
hc_status hbm_growth(hbm_solver *s, double omega, const double *X, bool *grows);
