/* law_planar.h - law_regularised.h for the two directions of a contact with two tangents under the law of the circle:
 * u, w, S and T are vectors of the plane.
 *
 *     S  = kt (u - w)
 *     w' = e max(|S| - mu N, 0)/eta,  e = S/|S|
 *     T  = S, limited to |T| <= mu N; `overstress`: T = S
 *
 * width -> 0, eta -> 0 give the exact law. Where w moves, S is longer than mu N by eta |w'|: T is exact but for its
 * direction, which turns as if R = mu N/kt were longer by eta |w'|/kt. So where a slider creeps along the circle the
 * error is first order in eta (law_regularised.h: second). Takes the law of either direction, half of the contact's
 * normal force and twice its mu each, and needs what that does: libm, no memory, no state, no failure. */
#ifndef HC_TIMEINT_LAW_PLANAR_H
#define HC_TIMEINT_LAW_PLANAR_H

#include "timeint/law/law_regularised.h"

typedef struct planar_value {
  double n, change, t[2], rate[2];
} planar_value; /* N and N - N0 of either direction; T [force], w' [length/time] */

/* dN/dv of either direction, dT_a/du_b in t_u[a][b], dT_a/dv ...; w enters as u - w. */
typedef struct planar_derivatives {
  double n_v, t_u[2][2], t_v[2], rate_u[2][2], rate_v[2];
} planar_derivatives;

/* A contact law as the equations see it, with one tangent or with two; of one tangent in [0]. Chosen once, when the
 * contact is made (scaled.c); a new law is its file and its row in law_planar.c. */
typedef struct law_kind {
  int directions;
  planar_value (*evaluate)(const law_regularised *c, const double *u, double v, const double *w);
  planar_derivatives (*derivatives)(const law_regularised *c, const double *u, double v, const double *w);
} law_kind;

enum { LAW_ONE_TANGENT, LAW_TWO_TANGENTS };
extern const law_kind law_kinds[];

planar_value law_planar_eval(const law_regularised *c, const double *u, double v, const double *w);

/* Where the law has them; on the circle those of stick. */
planar_derivatives law_planar_derivatives(const law_regularised *c, const double *u, double v, const double *w);

#endif
