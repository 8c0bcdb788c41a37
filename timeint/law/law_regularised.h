/* law_regularised.h - the contact law of model/contact_law.h, made smooth enough for an implicit integrator.
 *
 *     N  = kn width softplus((v + gap)/width) + load   softplus(z) = log(1 + exp(z))
 *     S  = kt (u - w)                                  force of the tangential spring
 *     w' = sign(S) max(|S| - mu N, 0) / eta            viscoplastic slider: a Coulomb slider with a dashpot eta
 *                                                      beside it
 *     T  = S, limited to +-mu N                        the force on the mass; `overstress`: T = S, the dashpot's
 *                                                      force eta w' included
 *
 * width -> 0, eta -> 0 give the exact law. Where |S| <= mu N the contact sticks exactly, w is at rest. Errors:
 *   normal                   second order in width: N is off by at most kn width, within some widths of v = -gap
 *   tangential, overstress   first order in eta while w moves; a separated contact acts like a dashpot eta
 *   tangential, limited      T is exact in slip and separation; w lags by eta w'/kt, which is 0 where a slip ends
 *                            (second order), and eta u'/kt where a contact closes and sticks (first order)
 * Measured figures: docs/measurements/time-integration.md. Written in the tangential motion u and the normal motion v
 * [length]; the caller derives them from the degrees of freedom. Any consistent units. Needs libm only, allocates
 * nothing, keeps no state, cannot fail. */
#pragma once

#include <stdbool.h>

#include "model/contact_law.h"

/* |z| beyond which softplus is not evaluated: exp(-40) < 5e-18 is below rounding for z > 40, and N/(kn width) itself,
 * set to 0, for z < -40. Saves two exp in most evaluations, and no exp can overflow. */
enum { LAW_SOFT_END = 40 };

typedef struct law_regularised {
  double kt, kn, mu, gap, load; /* as in contact_law.h */
  double width;                 /* [length] >= 0 width of the corner in N; 0: exact corner */
  double eta;                   /* [force time/length] > 0 where has_friction */
  bool overstress;              /* T includes the dashpot's force; false after law_regularised_make */
  bool has_friction;            /* contact_has_friction; otherwise T = 0, as in the exact law, and w' = 0 */
  contact smooth;               /* the law itself, if it is smooth; else zeros */
} law_regularised;

typedef struct law_value {
  double n, change, t, rate;
} law_value; /* N, N - N0 and T [force], w' [length/time] */

/* Partial derivatives dN/dv, dT/du, ...; N depends on v alone, and the rest on u - w: dT/dw = -dT/du, dw'/dw =
 * -dw'/du. */
typedef struct law_derivatives {
  double n_v, t_u, t_v, rate_u, rate_v;
} law_derivatives;

/* The law of `c`, its slider relaxing at the rate kt/eta = 1/relaxation [1/time] while it slips. width >= 0,
 * relaxation > 0. */
law_regularised law_regularised_make(const contact *c, double width, double relaxation);

law_value law_regularised_eval(const law_regularised *c, double u, double v, double w);

/* Derivatives where they exist; at the corner |S| = mu N those of stick. */
law_derivatives law_regularised_derivatives(const law_regularised *c, double u, double v, double w);
