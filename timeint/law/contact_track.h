/* contact_track.h - the contacts of a structure along a motion of the exact law (model/contact_law.h): the state of
 * each, what ends it, and what comes next. libm only. U, W, T have as many entries as the contact's kind
 * (law_kind.h) has directions, and t[] is the tracks of these; e = T/|T|, of one tangent +-1.
 *
 * In an interval no contact changes its state, and but for T of a slip whose direction turns each force is linear in
 * the contact's motion:
 *     stick  T = kt (U - rest), |T| <= mu N          closed  N = kn (V + gap) + load
 *     slip   T = mu N e,  W = U - R e, R = mu N/kt,  W' = s e,  s = U'.e - R' >= 0
 *     two tangents   e' = (U'.e_perp)/R e_perp
 * A state ends where a guard of it falls through 0: V + gap or minus that, or one of the law's, which for one tangent
 * are linear in (U, V) or (U', V'): so that of a motion in powers of tau it is such a series, too. What follows, and
 * how the slider's place varies with the motion:
 *     stick -> slip     e = T/|T|; W is tied to the motion
 *     slip -> stick     rest = U - R e; of one tangent the guard that ends slip is the rate of this: d rest = dU - dR e
 *     -> separated      W = U
 *     touch             rest = U there, or slip at once along U'/|U'| if kt |U'| > mu kn V': d rest = dU - U' dV/V'
 * All forces are continuous. Without friction T = 0: a closed contact counts as stuck, its slider follows U.
 *
 * `most` is how far a slider has been from where the period began, from its places at changes of state. Between two of
 * these that of one tangent is monotonic; where e turns it may come back to where it was: its places in between are to
 * be noted, or that e turned. */
#pragma once

#include "timeint/law/scaled.h"

/* The state at the beginning of a period, its slider at w. Where |T| > mu N the slider moves until |T| = mu N; where
 * |T| = mu N the contact slips if the motion keeps loading it. */
void contact_track_begin(contact_track *t, const scaled_contact *c, const contact_motion *at, const double *w);

/* The guards of the state that are linear in the motion; how many there are. */
int contact_track_conditions(const contact_track *t, const scaled_contact *c, track_condition conditions[TRACK_GUARDS]);

/* Are these all there are? Not of two tangents that touch. */
bool contact_track_is_linear(const contact_track *t, const scaled_contact *c);

/* Below -noise it is negative, for motions as large as this one. */
double contact_track_noise(const track_condition *g, const scaled_contact *c, const contact_motion *at);

/* Rounding of V + gap, of forces and of kt times rates: below minus that they are negative. */
double contact_track_distance_noise(const scaled_contact *c, double v);
double contact_track_force_noise(const scaled_contact *c, double u, double v, double w);
double contact_track_rate_noise(const scaled_contact *c, double du, double dv);

/* The guards of the state for U and V in powers of tau, u[directions][TRACK_TERMS], v[TRACK_TERMS]; not the end of a
 * slip whose direction turns. How many there are. */
int contact_track_guards(const contact_track *t, const scaled_contact *c, const double *u, const double *v,
                         track_guard guard[TRACK_GUARDS]);

/* That has happened there: the state that follows. */
void contact_track_pass(contact_track *t, const scaled_contact *c, track_event event, const contact_motion *at);

/* W at that motion, and W' from its rates at->u, at->v. */
void contact_track_slider(const contact_track *t, const scaled_contact *c, const contact_motion *at, double *w);
void contact_track_slider_rate(const contact_track *t, const scaled_contact *c, const contact_motion *rates,
                               double *dw);

/* `most` with the sliders where they are at that motion; at w, in all contacts, when the period is over. */
void contact_track_note(contact_track *t, const scaled_contact *c, const contact_motion *at);
void contact_track_end(contact_track *t, int n_contacts, const double *w);

/* The same of a slip whose direction has turned by so much [rad]: up to a quarter, W is farther from where it was the
 * longer it slips. */
void contact_track_note_turn(contact_track *t, const scaled_contact *c, double turn);

/* mu N there, and R. */
double contact_track_limit(const scaled_contact *c, double v);
double contact_track_radius(const scaled_contact *c, double v);

/* T and N - N0 of a direction as linear functions: T = t_u U + t_v V + t_0 (and + t_w dW for a variation of rest),
 * N - N0 = n_v V + n_0. Not T of a slip whose direction turns. */
typedef struct contact_forces_linear {
  double t_u, t_v, t_0, t_w, n_v, n_0;
} contact_forces_linear;
contact_forces_linear contact_track_forces(const contact_track *t, const scaled_contact *c);

/* Variation of rest of direction a of a contact that sticks since it touched, of variations du, dv of U_a, V. */
double contact_track_vary_touch(const contact_motion *at, int a, double du, double dv);

/* Variation of a direction's W where the slider is tied to the motion, e as it is. */
double contact_track_vary_slider(const contact_track *t, const scaled_contact *c, double du, double dv);
