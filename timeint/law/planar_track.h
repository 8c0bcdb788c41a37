/* planar_track.h - contact_track.h for the two directions of a contact with two tangents under the law of the circle
 * (law_planar.h); U, W and T are vectors of the plane, t[2] its two directions, in one state.
 *
 *     stick  T = kt (U - rest), |T| <= mu N          slip  T = mu N e, |e| = 1, W = U - R e, R = mu N/kt
 *     W' = s e,  s = U'.e - R' >= 0                  e' = (U'.e_perp)/R e_perp
 * A state ends where one of these falls through 0:
 *     stick  (mu N)^2 - |T|^2        slip  kt s        both  V + gap
 * What follows: stick -> slip e = T/|T|; slip -> stick rest = U - R e; touch: rest = U, or slip at once along
 * U'/|U'| if kt |U'| > mu kn V'. Shortly before N = 0 the direction e has no time left to turn the motion, but turns
 * the faster itself: it is then held. libm only. */
#ifndef HC_TIMEINT_PLANAR_TRACK_H
#define HC_TIMEINT_PLANAR_TRACK_H

#include "timeint/law/contact_track.h"

typedef struct planar_contact_motion {
  double u[2], v, du[2], dv;
} planar_contact_motion;

/* contact_track_begin of both directions, the slider at w[2]. */
void planar_track_begin(contact_track t[2], const scaled_contact *c, const planar_contact_motion *at,
                        const double w[2]);

/* Does it slip, in a direction that may turn? */
static inline bool planar_track_turns(const contact_track t[2]) { return t->state == CONTACT_SLIP_PLUS && !t->held; }

/* (mu N)^2 - |kt (U - rest)|^2 as a series, and its noise. */
void planar_track_stick_guard(const contact_track t[2], const scaled_contact *c, const double *u1, const double *u2,
                              const double *v, track_guard *guard);

/* Is e to be held from here on? And the time [rad] left to N = 0. */
bool planar_track_holds(const contact_track t[2], const scaled_contact *c, const planar_contact_motion *at,
                        double *left);

/* That has happened there. */
void planar_track_pass(contact_track t[2], const scaled_contact *c, track_event event, const planar_contact_motion *at);

/* W at that motion, and W' from its rates. */
void planar_track_slider(const contact_track t[2], const scaled_contact *c, const planar_contact_motion *at,
                         double w[2]);
void planar_track_slider_rate(const contact_track t[2], const scaled_contact *c, const double du[2], double dv,
                              double dw[2]);

/* R there. */
double planar_track_radius(const scaled_contact *c, double v);

#endif
