/* growth.h - test whether a response curve goes to infinity at a finite frequency, by the energies of a motion x with
 * harmonics x_h:
 *
 *     E = 1/4 sum_h (h omega)^2 x_h^H M x_h          [force length] kinetic energy, averaged over a period
 *     W = pi sum_k k |x_k^H p_k|                     work of the loads in a period, largest over their phase
 *     D = pi omega sum_h h^2 |x_h^H C x_h|           work that damping dissipates in a period
 *
 * Over a period the work of the loads equals what damping and friction dissipate. E and D grow with the amplitude A as
 * A^2; W grows as A, and so does the work of friction under bounded normal forces: 4 mu N for each slider and unit of
 * its amplitude. Where E is far above W, loads and friction no longer determine the amplitude; only damping could.
 * Coulomb friction and an undamped spring: F > 4 mu N/pi (Den Hartog 1931), with the natural frequency of the open
 * mass. */
#pragma once

#include "hbm/solver/hbm_solver.h"

/* *grows: true if E > 1e6 W and D < 1e-6 W. Damping would then limit the motion at 1e12 times the static amplitude or
 * beyond, where the loads are below hbm.tolerance of the forces that cancel. HC_NO_MEMORY; HC_NOT_FINITE as of
 * hbm_response. */
hc_status hbm_growth(hbm_solver *s, double omega, const double *X, bool *grows);
