/* circle_law.h - the exact contact law with two tangents and one limit for both, the circle |T| <= mu N. Motion u,
 * slider w and traction T are vectors in the tangent plane:
 *
 *     stick      T = kt (u - w), |T| <= mu N, w constant
 *     slip       T = mu N e, |e| = 1, w = u - (mu N/kt) e, w' = s e, s = u'.e - mu N'/kt >= 0
 *     separated  T = 0, N = 0, w = u
 *
 * While it slips, the direction e = (cos phi, sin phi) follows the motion: (mu N/kt) phi' = u'.e_perp, e_perp = (-sin
 * phi, cos phi). With u, w and T on one line it is contact_law.h's law. The limit mu N is all that is taken from N
 * here, so `law` may be the contact's or that of one of the two model_contacts that it is made of: mu N of each is the
 * whole contact's. Needs libm only, allocates nothing, keeps no state, cannot fail.
 * Source: Yang and Menq 1998, J. Sound Vib. 217, 909-925 (the radial limit); the angle's equation is derived from it by
 * differentiating w = u - (mu N/kt) e. */
#ifndef HC_CIRCLE_LAW_H
#define HC_CIRCLE_LAW_H

#include "model/contact_law.h"

/* mu N [force] at normal motion v. */
static inline double circle_limit(const contact *law, double v) { return law->mu * contact_normal(law, v); }

/* One step of the law from slider position w to motion (u, v): elastic predictor, radial return to the limit. w becomes
 * the new position, T [force] the traction. Slip is CONTACT_SLIP_PLUS, whatever its direction, which is T's. Exact
 * where predictor and traction have one direction, else of first order: the slider goes the whole step in the direction
 * that slip has at its end (hbm/planar/planar_slider.h follows it as it turns). NaN anywhere gives NaN. */
contact_state circle_step(const contact *law, const double u[2], double v, double w[2], double T[2]);

/* State just after v + gap rises through 0, from the velocities there (dv > 0): it slips along du/|du| if kt |du| > mu
 * kn dv, else it sticks. */
contact_state circle_on_touch(const contact *law, const double du[2], double dv);

/* Guards of the exact law: each is positive inside the state and reaches 0 where it ends; and so does v + gap.
 *   stick   (mu N)^2 - |kt (u - w)|^2      [force^2]
 *   slip    kt s = kt u'.e - mu kn v'      [force/time], e being the direction of T */
double circle_guard_stick(const contact *law, const double u[2], double v, const double w[2]);
double circle_guard_slip(const contact *law, const double e[2], const double du[2], double dv);

#endif
