/* planar_angle.h - a contact with two tangents that slips under the law of the circle, for an integrator that carries
 * the angle of its traction as a state (integrate_events.h): e = (cos phi, sin phi).
 *
 *     T = mu N e,   phi' = kt (U'.e_perp)/(mu N)
 * At touch-down that is 0/0. The one solution that does not run away backwards in time starts along U', with
 *     phi'_0 = beta psi'/(1 + beta),   beta = kt |U'|/(mu kn V'),   psi' = U''.e_perp/|U'|: the turn of U'
 * and phi grows at that rate for the first `opening`: off by its square, which changes a rate of the motion by its
 * fourth power, or third as beta -> 1. Before N = 0 phi is held where what it could still change is small. The guards
 * are those of law_planar.c, that of stick linear, mu N - |T|, which means something at N = 0, too. libm only. */
#ifndef HC_TIMEINT_PLANAR_ANGLE_H
#define HC_TIMEINT_PLANAR_ANGLE_H

#include "timeint/law/contact_track.h"

typedef struct planar_angle {
  int contact;  /* its first direction */
  double began; /* phi where it began to follow it */
  bool opens;   /* since a touch, until theta = `until`: phi' = rate */
  double rate, until;
  double held_pull; /* what a held direction may change of a rate until N = 0 */
} planar_angle;

/* U, V, U', V' and U'', V'' at theta. */
typedef struct angle_motion {
  contact_motion at;
  double bend[2], normal_bend;
  double theta, phi;
} angle_motion;

/* The circle has just touched at such a motion, and slips. */
void planar_angle_open(planar_angle *a, const scaled_contact *c, const angle_motion *now);

/* phi', of a circle in any state. */
double planar_angle_rate(const planar_angle *a, const contact_track t[2], const scaled_contact *c,
                         const contact_motion *at, double phi);

/* T = mu N e and phi' of a circle that slips: what they follow. */
typedef struct angle_slopes {
  double t_v[2], t_phi[2], rate_u[2] /* by U' */, rate_v, rate_phi;
} angle_slopes;
angle_slopes planar_angle_slopes(const planar_angle *a, const contact_track t[2], const scaled_contact *c,
                                 const contact_motion *at, double phi);

/* Values and rates, g[0] and g[1], of all guards, the end of contact first. How many there are. */
int planar_angle_guards(const planar_angle *a, const contact_track t[2], const scaled_contact *c,
                        const angle_motion *now, track_guard guard[TRACK_GUARDS]);

#endif
