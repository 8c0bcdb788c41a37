/* monodromy.h - the monodromy matrix along an event-located orbit, and its eigenvalues, the Floquet multipliers.
 *
 *     M dx'' + C dx' + k(t) dx - sum over stuck contacts t_j dheld_j = 0
 *
 * with dheld_j = kt dw_j set by dx at the instant the slider comes to rest (transitions.h). k is piecewise constant but
 * where a planar contact slips or a law is smooth. The vector field is continuous, so transitions add no jumps
 * (saltation is the identity). Nothing is truncated: unlike Hill's method it needs no decay of the Jacobian's
 * harmonics. Check: without slip the determinant is exp(-trace(M^-1 C) T). */
#pragma once

#include <complex.h>

#include "hbm/forces/contact_forces.h"
#include "hbm/stability/multipliers.h"

typedef struct monodromy monodromy;
typedef struct variation variation; /* variation.h */

/* How multipliers are found: a row for each way, chosen when a monodromy is made. */
typedef struct multiplier_method {
  /* *self, for m, which must live as long, and its variation. HC_NO_MEMORY; HC_SINGULAR if the mass is; in modes those
   * of modal_flow_new. *self is to be freed all the same, or NULL. */
  hc_status (*make)(const model *m, void **self, variation **v);
  void (*free)(void *self);
  /* lambda[2 n + contacts]: the multipliers of the orbit of variation_begin, *count of them, all but those that are 0.
   * HC_NOT_CONVERGED, also where it would take minutes, HC_NOT_FINITE, HC_SINGULAR, HC_NO_MEMORY. */
  hc_status (*find)(void *self, int *count, double complex *lambda);
} multiplier_method;

/* By intervals: exponentials where nothing varies (interval_flow.h), else integrated (planar_flow.h). */
extern const multiplier_method multipliers_by_intervals;

/* All in the modes of a large structure (modal_flow.h), from what outlasts a part of the period where that is far less
 * than all states; or, to compare with, from all of them. */
extern const multiplier_method multipliers_in_modes, multipliers_from_all_states;

/* Operations of one orbit that take some minutes; more are refused. */
#define MONODROMY_MOST_OPERATIONS 4e11

/* For orbits of m, which must live as long. Errors of how->make: *out is NULL. */
hc_status monodromy_new(const model *m, const multiplier_method *how, monodromy **out);
void monodromy_free(monodromy *w);

/* Everything but `agrees`, which is left false, and low = high = multiplier, for the orbit last evaluated by `orbit`,
 * at omega. A slider stuck all period has a multiplier 1 of its own, since its residual traction is not determined: it
 * is left out. HC_NOT_CONVERGED if the eigenvalues could not be computed, or not within minutes, HC_NOT_FINITE if they
 * are too large, HC_NO_MEMORY. GSL's error handler must be switched off: its errors come back as HC_NOT_CONVERGED
 * then. */
hc_status monodromy_stability(monodromy *w, const contact_forces *orbit, double omega, hbm_stability *out);

/* Those multipliers themselves: their number, and *lambda, valid until the next one is asked for. */
int monodromy_multipliers(const monodromy *w, const double complex **lambda);
