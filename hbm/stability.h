/* stability.h - is a periodic solution stable? Floquet multipliers from the monodromy matrix along the event-located
 * orbit.
 *
 *     M dx'' + C dx' + k(t) dx - sum over stuck contacts cos(alpha_j) dheld_j = 0
 *
 * with k piecewise constant and dheld_j = kt dw_j set by dx at the instant the slider comes to rest (transitions.h).
 * The vector field is continuous, so transitions add no jumps (saltation is the identity); each stretch has a closed
 * form. Nothing is truncated: unlike Hill's method it needs no decay of the Jacobian's harmonics. Check: without
 * slip the determinant is exp(-C T/M). */
#ifndef HC_STABILITY_H
#define HC_STABILITY_H

#include "base/status.h"
#include "model/model.h"

typedef struct hbm_stability {
  double multiplier; /* modulus of the largest Floquet multiplier */
  double re, im;     /* that multiplier */
  double flip, fold; /* product of (1 + multiplier), of (1 - multiplier): change sign at a period doubling, at a fold */
  double determinant; /* product of all multipliers */
  bool agrees; /* the equations' own fold test, the sign of det dR/dX, says the same as `fold`: with few harmonics it
                  need not */
} hbm_stability;

typedef struct exact_force exact_force; /* hbm/exact_force.h */
typedef struct stability stability;

/* Room for orbits of a model with n_contacts contacts. HC_NO_MEMORY: *out is NULL. */
hc_status stability_new(int n_contacts, stability **out);
void stability_free(stability *s);

/* For the orbit last evaluated by e, at omega. A slider stuck all period has a multiplier 1 of its own (its residual
 * traction is a family); it is left out. HC_NOT_CONVERGED if the eigenvalues could not be computed, HC_NOT_FINITE if
 * they are too large. GSL's error handler is the caller's business: switched off, its errors come back as
 * HC_NOT_CONVERGED. `agrees` is left false here: it is the solver's to say (hbm_stability_at). */
hc_status stability_of(stability *s, const model *m, const exact_force *e, double omega, hbm_stability *out);

#endif
