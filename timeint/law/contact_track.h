/* contact_track.h - the contacts of a structure along a motion of the exact law (model/contact_law.h): the state of
 * each, what ends it, and what comes next. libm only.
 *
 * In an interval no contact changes its state, and each force is linear in the contact's motion:
 *     stick  T = kt (U - rest)        slip(s)  T = s mu N        closed  N = kn (V + gap) + load
 * Every guard is linear in (U, V) or (U', V'), so that of a motion in powers of tau it is such a series, too:
 *     closed      V + gap                            separated   -(V + gap)
 *     stick       mu N - s kt (U - rest), s = +-1    slip(s)     s kt U' - mu kn V'
 * A state ends where a guard of it falls through 0. What follows, and how the slider's place varies with the motion:
 *     stick -> slip(s)    W is tied to the motion
 *     slip(s) -> stick    rest = U - s mu N/kt; the guard that ends slip is the rate of this: d rest = dU - s mu dN/kt
 *     -> separated        W = U
 *     touch               rest = U there, or slip at once (contact_on_touch): d rest = dU - U' dV/V'
 * All forces are continuous. Without friction T = 0: a closed contact counts as stuck, its slider follows U. */
#ifndef HC_TIMEINT_CONTACT_TRACK_H
#define HC_TIMEINT_CONTACT_TRACK_H

#include "timeint/law/scaled.h"

typedef struct contact_track {
  contact_state state;
  double rest;      /* W while the contact sticks */
  bool since_start; /* it sticks since the start of the period: rest is an independent state */
  int limit;      /* the sign of T where the period began with |T| = mu N, and the slider tied to the motion; else 0 */
  double along;   /* of a circle (planar_track.h) that slips or began with |T| = mu N: this direction's part of e */
  bool fresh;     /* of a circle: it slips since a touch at this instant, N = 0 */
  bool held;      /* of a circle: it slips with e as it is until N = 0 */
  double changed; /* [rad] when it came to this state */
} contact_track;

/* U, V and their rates at one instant. */
typedef struct contact_motion {
  double u, v, du, dv;
} contact_motion;

/* The state at the beginning of a period, its slider at w. Where |T| > mu N the slider moves until |T| = mu N; where
 * |T| = mu N the contact slips if the motion keeps loading it. */
contact_track contact_track_begin(const scaled_contact *c, const contact_motion *at, double w);

enum { TRACK_GUARDS = 3, TRACK_ORDER = 24, TRACK_TERMS = TRACK_ORDER + 1 };
typedef enum track_event {
  TRACK_SEPARATES,
  TRACK_TOUCHES,
  TRACK_SLIPS_PLUS,
  TRACK_SLIPS_MINUS,
  TRACK_STICKS,
  TRACK_TURNS, /* of a circle that slips: its direction turns freely from here on; */
  TRACK_HOLDS  /* is held */
} track_event;

/* A guard of a state: g = by_u (U - from_u) + by_v (V + gap) + constant, or by_u U' + by_v V'. */
typedef struct track_condition {
  track_event event; /* what happens where it falls through 0 */
  bool of_rates;
  double by_u, by_v, from_u, gap, constant;
} track_condition;

/* All of the state; how many there are. Of a circle's two directions only the end of contact. */
int contact_track_conditions(const contact_track *t, const scaled_contact *c, track_condition conditions[TRACK_GUARDS]);

/* Below -noise it is negative, for motions as large as this one. */
double contact_track_noise(const track_condition *g, const scaled_contact *c, const contact_motion *at);

/* Rounding of V + gap, of forces and of kt times rates: below minus that they are negative. */
double contact_track_distance_noise(const scaled_contact *c, double v);
double contact_track_force_noise(const scaled_contact *c, double u, double v, double w);
double contact_track_rate_noise(const scaled_contact *c, double du, double dv);

/* A guard as a series in tau: coefficients g[order + 1]; below -noise it is negative. */
typedef struct track_guard {
  track_event event; /* what happens where it falls through 0 */
  double noise, g[TRACK_ORDER + 1];
} track_guard;

/* The guards of the state for U and V in powers of tau, u, v[TRACK_ORDER + 1]. How many there are. */
int contact_track_guards(const contact_track *t, const scaled_contact *c, const double *u, const double *v,
                         track_guard guard[TRACK_GUARDS]);

/* By how many the transitions of the period grow with that event at theta, which is not passed yet. Where traction and
 * limit vanish together (a contact that stuck when it touched, one degree of freedom), or where the motion turns at the
 * limit, a slip of no length begins or does not, by rounding: it is not counted. */
int contact_track_counts(contact_track *t, track_event event, double theta);

/* That has happened there: the state that follows. */
void contact_track_pass(contact_track *t, const scaled_contact *c, track_event event, const contact_motion *at);

/* W at that motion. */
double contact_track_slider(const contact_track *t, const scaled_contact *c, const contact_motion *at);

/* T and N - N0 as linear functions: T = t_u U + t_v V + t_0 (and + t_w dW for a variation of rest), N - N0 = n_v V +
 * n_0. Not T of a circle that slips, unless its direction is held. */
typedef struct contact_forces_linear {
  double t_u, t_v, t_0, t_w, n_v, n_0;
} contact_forces_linear;
contact_forces_linear contact_track_forces(const contact_track *t, const scaled_contact *c);

/* Variation of rest where the contact began to stick from state `before`, of variations du, dv of U, V. */
double contact_track_vary_rest(const scaled_contact *c, contact_state before, const contact_motion *at, double du,
                               double dv);

/* Variation of W of a contact whose slider is tied to the motion. */
double contact_track_vary_slider(const contact_track *t, const scaled_contact *c, double du, double dv);

#endif
