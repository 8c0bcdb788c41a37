/* stability.h - is a periodic solution stable? Its Floquet multipliers, along its event-located orbit (monodromy.h). */
#pragma once

#include "hbm/solver/hbm_solver.h"
#include "hbm/stability/multipliers.h"

/* Floquet multipliers of the solution X at omega. The orbit's transitions are located exactly also where forces are
 * sampled. Errors of the contact force; HC_NOT_CONVERGED if the eigenvalues could not be computed (with GSL's error
 * handler switched off by the caller: left on, it ends the program), HC_NO_MEMORY, HC_NOT_FINITE (too large). */
hc_status hbm_stability_at(hbm_solver *s, double omega, const double *X, hbm_stability *out);

/* Multipliers of a structure of more than 50 degrees of freedom cost as much as a good part of its curve, unless it has
 * planar friction, no smooth law and at most 48 contacts (hbm_n_contacts); so do those of a smaller one with planar
 * friction or a smooth law where states and harmonics are so many that a solution takes 40 ms and more. They are
 * computed for a solution that is asked for, and left unknown at the points of a curve. */
bool hbm_stability_is_costly(const hbm_solver *s);
const char *hbm_stability_limit(const hbm_solver *s); /* why they are, in words; NULL: they are not */

/* With planar friction, no smooth law and more than 50 degrees of freedom hbm_stability_at finds NaN, which is unknown,
 * where modes do not diagonalise the damping or it is so light that steps would take minutes: true once that was so. */
bool hbm_stability_is_unknown(const hbm_solver *s);

/* From now on it is unknown of all solutions of such a structure, each of which costs ten points of a curve and more:
 * for curves that are only drawn. */
void hbm_leave_stability(hbm_solver *s);

/* +1 stable, -1 unstable, 0 unknown: the largest multiplier's size, or what its predicted error leaves of it, comes
 * within 1e-9 of 1, or the truncated equations disagree. */
int hbm_stability_verdict(const hbm_stability *st);
