/* law_regularised.h - the contact law of model/contact_law.h, made smooth enough for an implicit integrator.
 *
 *     N  = kn width softplus((v + gap)/width) + load   softplus(z) = log(1 + exp(z))
 *     S  = kt (u - w)                                  force of the tangential spring
 *     w' = sign(S) max(|S| - mu N, 0) / eta            viscoplastic slider: a Coulomb slider with a dashpot eta
 *                                                      beside it
 *     T  = S, limited to +-mu N                        what reaches the mass; `overstress`: T = S, the dashpot's
 *                                                      force eta w' included
 *
 * width -> 0, eta -> 0 give the exact law. Where |S| <= mu N the contact sticks exactly, w is at rest. Errors:
 *   normal                   second order in width: N is off by at most kn width, over a range of some widths
 *   tangential, overstress   first order in eta wherever w moves; a separated contact acts like a dashpot eta
 *   tangential, limited      T is exact in slip and separation; w lags by eta w'/kt, which is 0 where a slip ends
 *                            (second order), but not where a contact closes and sticks (first order: eta u'/kt then)
 * Measured figures: docs/measurements/time-integration.md. Written in the tangential motion u and the normal motion v
 * [length]; the caller derives them from the degrees of freedom. Any consistent units. Needs libm only, allocates
 * nothing, keeps no state, cannot fail. */
#pragma once

#include <stdbool.h>

#include "model/contact_law.h"

/* For |z| > 40 exp(-|z|) < 5e-18: below rounding where it is added to z; for z < -40 it is all of N/(kn width), and
 * is set to 0. This saves two exp in most evaluations, and no exp can overflow. */
enum { LAW_SOFT_END = 40 };

typedef struct law_regularised {
  double kt, kn, mu, gap, load; /* as in contact_law.h */
  double width;                 /* [length] >= 0 of the corner in N; 0 is the exact corner */
  double eta;                   /* [force time/length] > 0 where has_friction */
  bool overstress;              /* the dashpot's force reaches the mass; law_regularised_make says no */
  bool has_friction;            /* contact_has_friction; otherwise T = 0, as in the exact law, and w' = 0 */
  contact smooth;               /* of a smooth law, all of it; else nothing */
} law_regularised;

typedef struct law_value {
  double n, change, t, rate;
} law_value; /* N, N - N0 and T [force], w' [length/time] */

/* Partial derivatives dN/dv, dT/du, ...; N depends on v alone, and w enters as u - w: dT/dw = -dT/du, dw'/dw =
 * -dw'/du. */
typedef struct law_derivatives {
  double n_v, t_u, t_v, rate_u, rate_v;
} law_derivatives;

/* The law of `c`, its slider relaxing at the rate kt/eta = 1/relaxation [1/time] while it slips. width >= 0,
 * relaxation > 0. */
law_regularised law_regularised_make(const contact *c, double width, double relaxation);

law_value law_regularised_eval(const law_regularised *c, double u, double v, double w);

/* Derivatives where the law has them; on the corner |S| = mu N those of stick. */
law_derivatives law_regularised_derivatives(const law_regularised *c, double u, double v, double w);
