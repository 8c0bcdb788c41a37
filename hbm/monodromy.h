/* monodromy.h - the monodromy matrix along an event-located orbit, and its eigenvalues, the Floquet multipliers.
 *
 *     M dx'' + C dx' + k(t) dx - sum over stuck contacts cos(alpha_j) dheld_j = 0
 *
 * with k piecewise constant and dheld_j = kt dw_j set by dx at the instant the slider comes to rest (transitions.h).
 * The vector field is continuous, so transitions add no jumps (saltation is the identity); each stretch between them
 * has a closed form. Nothing is truncated: unlike Hill's method it needs no decay of the Jacobian's harmonics. Check:
 * without slip the determinant is exp(-C T/M). */
#ifndef HC_HBM_MONODROMY_H
#define HC_HBM_MONODROMY_H

#include "hbm/exact_force.h"
#include "hbm/stability.h"

typedef struct monodromy monodromy;

/* Room for orbits of a model with n_contacts contacts. HC_NO_MEMORY: *out is NULL. */
hc_status monodromy_new(int n_contacts, monodromy **out);
void monodromy_free(monodromy *w);

/* Everything but `agrees`, which is left false, for the orbit last evaluated by `orbit`, at omega. A slider stuck all
 * period has a multiplier 1 of its own, since its residual traction is not determined: it is left out.
 * HC_NOT_CONVERGED if the eigenvalues could not be computed, HC_NOT_FINITE if they are too large, HC_NO_MEMORY. GSL's
 * error handler must be switched off: its errors come back as HC_NOT_CONVERGED then. */
hc_status monodromy_stability(monodromy *w, const model *m, const exact_force *orbit, double omega, hbm_stability *out);

#endif
