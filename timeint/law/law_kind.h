/* law_kind.h - a contact law as time integration sees it: a row of functions, chosen once, when the contact is made
 * (scaled.c). A new smooth law is its file, which defines its row.
 *
 * A contact has one direction in the tangent plane, or two under the law of the circle, which are neighbours (model.h):
 * U, W, S and T are vectors of so many entries, and so are the arrays w[], t[] of what a direction has. N is half of
 * the contact's for either of two directions, and mu twice as large. Functions need libm only and cannot fail. */
#pragma once

#include "timeint/law/law_regularised.h"

/* ---- regularised (law_regularised.h) --------------------------------------------------------------------------- */

typedef struct planar_value {
  double n, change, t[2], rate[2];
} planar_value; /* N and N - N0 of either direction; T [force], w' [length/time] */

/* dN/dv of either direction, dT_a/du_b in t_u[a][b], dT_a/dv ...; w enters as u - w; dT/du'. */
typedef struct planar_derivatives {
  double n_v, t_u[2][2], t_v[2], rate_u[2][2], rate_v[2], t_du;
} planar_derivatives;

/* U, V and their rates at one instant. */
typedef struct contact_motion {
  double u[2], v, du[2], dv;
} contact_motion;

/* ---- exact (contact_track.h) ----------------------------------------------------------------------------------- */

/* What CVODE knows of a slip in two directions, where phi, the angle of e, is a state of its equations. */
typedef struct law_opening {
  double began; /* phi where it began to turn */
  bool opens;   /* since a touch, until theta = `until`: phi' = rate */
  double rate, until;
} law_opening;

/* One direction of a contact along the motion of a period; states and flags are the same in all of its directions. */
typedef struct contact_track {
  contact_state state;
  double rest;       /* W while the contact sticks */
  bool since_start;  /* it sticks since the start of the period: rest is an independent state */
  double along;      /* T/|T| where it slips, or began with |T| = mu N: this direction's part of e */
  bool turns;        /* e follows the motion: T is not linear in it */
  bool fresh;        /* it turns since a touch at this instant, N = 0 */
  double changed;    /* [rad] when it came to this state */
  law_opening opens; /* by CVODE */
  double from, most; /* W where the period began; the largest |W - from| since, INFINITY once separated */
} contact_track;

enum { TRACK_GUARDS = 3, TRACK_ORDER = 24, TRACK_TERMS = TRACK_ORDER + 1 };
typedef enum track_event {
  TRACK_SEPARATES,
  TRACK_TOUCHES,
  TRACK_SLIPS_PLUS,
  TRACK_SLIPS_MINUS,
  TRACK_STICKS,
  TRACK_TURNS, /* of a contact that slips: its direction turns freely from here on; */
  TRACK_HOLDS  /* is held */
} track_event;

/* A guard of a state: g = by_u (U - from_u) + by_v (V + gap) + constant, or by_u U' + by_v V'. */
typedef struct track_condition {
  track_event event; /* what happens where it falls through 0 */
  bool of_rates;
  double by_u, by_v, from_u, gap, constant;
} track_condition;

/* A guard as a series in tau: coefficients g[TRACK_TERMS]; below -noise it is negative. */
typedef struct track_guard {
  track_event event; /* what happens where it falls through 0 */
  double noise, g[TRACK_TERMS];
} track_guard;

/* ---- a row ----------------------------------------------------------------------------------------------------- */

/* A motion at theta, with U'' and V'', and the contact's own state by CVODE. */
typedef struct law_instant {
  contact_motion at;
  double bend[2], normal_bend;
  double theta, own;
} law_instant;

/* T and N - N0 that are not linear in the motion, and the rate of the own state z; what they follow: dT_a/dV, dT_a/dz,
 * dz'/dU'_a, dz'/dV, dz'/dz; of smooth laws, of one tangent, dT/dU' and dN/dV. */
typedef struct law_pull {
  double t[2], n, rate;
} law_pull;
typedef struct law_slopes {
  double t_v[2], t_own[2], rate_du[2], rate_v, rate_own, t_du, n_v;
} law_slopes;

typedef struct scaled_contact scaled_contact;
typedef struct law_kind {
  int directions;
  bool smooth;   /* beside forces linear in the motion there are those of pull, in all states, without a state z */
  bool by_rates; /* U', V' are looked at by the next two */
  planar_value (*evaluate)(const law_regularised *c, const contact_motion *at, const double *w);
  /* Where the law has them; on the limit |S| = mu N those of stick. */
  planar_derivatives (*derivatives)(const law_regularised *c, const contact_motion *at, const double *w);
  double (*bend)(const law_regularised *c); /* the change of a rate over which T bends; NULL: that of the motion */

  /* Guards of a contact with friction that touches, but the end of contact. Those that are linear in the motion (NULL:
   * none); those that are not (NULL: none), as series, from those of U and V: u[directions][TRACK_TERMS],
   * v[TRACK_TERMS]. How many. */
  int (*conditions)(const contact_track *t, const scaled_contact *c, track_condition conditions[TRACK_GUARDS]);
  int (*curved_guards)(const contact_track *t, const scaled_contact *c, const double *u, const double *v,
                       track_guard guard[TRACK_GUARDS]);

  /* By how many the period's transitions grow with that event at theta, which is not passed yet. */
  int (*counts)(contact_track *t, track_event event, double theta);

  /* While it slips: holds e from that motion on if it has no time left to turn the motion, or lets it turn. The longest
   * step [rad] for which that holds. NULL: e never turns. */
  double (*hold)(contact_track *t, const scaled_contact *c, const contact_motion *at);

  /* By CVODE, which carries a state z of such a contact beside the motion; all NULL where there is none. */
  double (*own_begin)(contact_track *t); /* z of the track's direction, from where it turns */
  void (*own_open)(contact_track *t, const scaled_contact *c, const law_instant *now); /* it has just touched */
  void (*own_follow)(contact_track *t, double own); /* the track's direction from z */
  law_pull (*pull)(const contact_track *t, const scaled_contact *c, const contact_motion *at, double own);
  law_slopes (*slopes)(const contact_track *t, const scaled_contact *c, const contact_motion *at, double own);
  /* Values and rates, g[0] and g[1], of all guards, the end of contact first; e may be held where that changes a rate
   * by less than may_change until N = 0. How many. */
  int (*own_guards)(const contact_track *t, const scaled_contact *c, const law_instant *now, double may_change,
                    track_guard guard[TRACK_GUARDS]);
} law_kind;

extern const law_kind law_line, law_planar; /* one tangent; two under the law of the circle */
#define LAW_KIND(code, name) extern const law_kind law_##name;
CONTACT_SMOOTH_LIST(LAW_KIND)
#undef LAW_KIND

struct scaled_contact {
  law_regularised law; /* without dimensions */
  const law_kind *kind;
  int direction;  /* of the kind's: 0, 1 */
  double preload; /* N0 */
};
