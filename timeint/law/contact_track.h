/* contact_track.h - the contacts of a structure along a motion of the exact law (model/contact_law.h): the state of
 * each, the guards that end it, and the state that follows. libm only. U, W, T have as many entries as the contact's
 * kind (law_kind.h) has directions, and t[] has a track for each; e = T/|T|, +-1 for one tangent.
 *
 * In an interval no contact changes its state, and each force is linear in the contact's motion, except T of a slip
 * whose direction turns:
 *     stick  T = kt (U - rest), |T| <= mu N          closed  N = kn (V + gap) + load
 *     slip   T = mu N e,  W = U - R e, R = mu N/kt,  W' = s e,  s = U'.e - R' >= 0
 *     two tangents   e' = (U'.e_perp)/R e_perp
 * A state ends where one of its guards falls through 0: V + gap, minus that, or one of the law's guards. With one
 * tangent these are linear in (U, V) or (U', V'), hence power series in tau if the motion is one. The state that
 * follows, and the variation of the slider with the motion:
 *     stick -> slip     e = T/|T|; W follows from the motion
 *     slip -> stick     rest = U - R e; one tangent: d rest = dU - dR e, since the guard of slip is the rate of rest
 *     -> separated      W = U
 *     touch             rest = U there, or slip at once along U'/|U'| if kt |U'| > mu kn V': d rest = dU - U' dV/V'
 * All forces are continuous. Without friction T = 0: a closed contact counts as stuck, its slider follows U.
 *
 * `most` of a track is the largest distance of its slider from its place at the start of the period, at changes of
 * state. With one tangent W is monotonic between two changes; where e turns it is not, and the caller also notes places
 * in between (contact_track_note) or the turn (contact_track_note_turn). */
#pragma once

#include "timeint/law/scaled.h"

/* Sets the state at the beginning of a period from the slider w. If |T| > mu N the slider moves until |T| = mu N; if
 * |T| = mu N the contact slips if the motion increases its load. */
void contact_track_begin(contact_track *t, const scaled_contact *c, const contact_motion *at, const double *w);

/* The guards of the state that are linear in the motion; returns their number. */
int contact_track_conditions(const contact_track *t, const scaled_contact *c, track_condition conditions[TRACK_GUARDS]);

/* True if the state has no other guards; false for two tangents in contact. */
bool contact_track_is_linear(const contact_track *t, const scaled_contact *c);

/* Noise of a guard, for motions of this size: below -noise it is negative. */
double contact_track_noise(const track_condition *g, const scaled_contact *c, const contact_motion *at);

/* Noise of V + gap, of forces, and of kt times rates: below minus that they are negative. */
double contact_track_distance_noise(const scaled_contact *c, double v);
double contact_track_force_noise(const scaled_contact *c, double u, double v, double w);
double contact_track_rate_noise(const scaled_contact *c, double du, double dv);

/* The guards of the state for U and V in powers of tau, u[directions][TRACK_TERMS], v[TRACK_TERMS]; not the end of a
 * slip whose direction turns. Returns their number. */
int contact_track_guards(const contact_track *t, const scaled_contact *c, const double *u, const double *v,
                         track_guard guard[TRACK_GUARDS]);

/* Sets the state that follows the event at the motion *at. */
void contact_track_pass(contact_track *t, const scaled_contact *c, track_event event, const contact_motion *at);

/* W at the motion *at; W' at a motion whose rates are in rates->u, rates->v. */
void contact_track_slider(const contact_track *t, const scaled_contact *c, const contact_motion *at, double *w);
void contact_track_slider_rate(const contact_track *t, const scaled_contact *c, const contact_motion *rates,
                               double *dw);

/* Updates `most` with the sliders at the motion *at; for all contacts with the sliders w at the end of the period. */
void contact_track_note(contact_track *t, const scaled_contact *c, const contact_motion *at);
void contact_track_end(contact_track *t, int n_contacts, const double *w);

/* Updates `most` for a slip whose direction has turned by `turn` [rad]: INFINITY above a quarter turn; below, W moves
 * away monotonically, and its end is enough. */
void contact_track_note_turn(contact_track *t, const scaled_contact *c, double turn);

/* mu N and R at the normal motion v. */
double contact_track_limit(const scaled_contact *c, double v);
double contact_track_radius(const scaled_contact *c, double v);

/* T and N - N0 of a direction as linear functions: T = t_u U + t_v V + t_0 (in variations also + t_w dW of rest), N -
 * N0 = n_v V + n_0. T = 0 here for a slip whose direction turns. */
typedef struct contact_forces_linear {
  double t_u, t_v, t_0, t_w, n_v, n_0;
} contact_forces_linear;
contact_forces_linear contact_track_forces(const contact_track *t, const scaled_contact *c);

/* Variation of rest in direction a at a touch that leads to stick, for variations du, dv of U_a, V there. */
double contact_track_vary_touch(const contact_motion *at, int a, double du, double dv);

/* Variation of a direction's W where W follows from the motion (slip, separated), with constant e. */
double contact_track_vary_slider(const contact_track *t, const scaled_contact *c, double du, double dv);
