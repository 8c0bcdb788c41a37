/* monodromy.h - the monodromy matrix along an event-located orbit, and its eigenvalues, the Floquet multipliers.
 *
 *     M dx'' + C dx' + k(t) dx - sum over stuck contacts t_j dheld_j = 0
 *
 * with dheld_j = kt dw_j set by dx at the instant the slider comes to rest (transitions.h). k is piecewise constant but
 * where a planar contact slips or a law is smooth. The vector field is continuous, so transitions add no jumps
 * (saltation is the identity). Intervals of constant k are matrix exponentials (interval_flow.h), others are integrated
 * (planar_flow.h), or all in the modes of a large structure (modal_flow.h). Nothing is truncated: unlike Hill's method
 * it needs no decay of the Jacobian's harmonics. Check: without slip the determinant is exp(-trace(M^-1 C) T). */
#pragma once

#include <complex.h>

#include "hbm/forces/contact_forces.h"
#include "hbm/stability/multipliers.h"

typedef struct monodromy monodromy;

/* How intervals are followed: as above; or all of them in the modes of a large structure (modal_flow.h), from what
 * outlasts a part of the period where that is far less than all states, or, to compare with, from all of them. */
typedef enum monodromy_method {
  MONODROMY_BY_INTERVALS,
  MONODROMY_IN_MODES,
  MONODROMY_FROM_ALL_STATES
} monodromy_method;

/* Room for orbits of m, which must live as long. HC_NO_MEMORY; HC_SINGULAR if its mass is; in modes also the errors of
 * modal_flow_new: *out is NULL. */
hc_status monodromy_new(const model *m, monodromy_method how, monodromy **out);
void monodromy_free(monodromy *w);

/* Everything but `agrees`, which is left false, and low = high = multiplier, for the orbit last evaluated by `orbit`,
 * at omega. A slider stuck all period has a multiplier 1 of its own, since its residual traction is not determined: it
 * is left out. HC_NOT_CONVERGED if the eigenvalues could not be computed, or not within minutes, HC_NOT_FINITE if they
 * are too large, HC_NO_MEMORY. GSL's error handler must be switched off: its errors come back as HC_NOT_CONVERGED
 * then. */
hc_status monodromy_stability(monodromy *w, const model *m, const contact_forces *orbit, double omega,
                              hbm_stability *out);

/* Those multipliers themselves: their number, and *lambda, valid until the next one is asked for. */
int monodromy_multipliers(const monodromy *w, const double complex **lambda);
