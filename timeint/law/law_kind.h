/* law_kind.h - interface of contact laws for time integration: a table of functions, selected when the contact is made
 * (scaled.c). A new smooth law is a file that defines its table.
 *
 * A contact has one direction in the tangent plane, or two under the law of the circle, which are neighbours (model.h):
 * U, W, S, T and the arrays w[], t[] have an entry for each direction. N is half of the contact's for either of two
 * directions, and mu twice as large. Functions need libm only and cannot fail. */
#pragma once

#include "timeint/law/law_regularised.h"

/* ---- regularised (law_regularised.h) --------------------------------------------------------------------------- */

typedef struct planar_value {
  double n, change, t[2], rate[2];
} planar_value; /* N and N - N0 of either direction; T [force], w' [length/time] */

/* dN/dv of either direction, dT_a/du_b in t_u[a][b], dT_a/dv ...; derivatives by w are minus those by u; t_du =
 * dT/du'. */
typedef struct planar_derivatives {
  double n_v, t_u[2][2], t_v[2], rate_u[2][2], rate_v[2], t_du;
} planar_derivatives;

/* U, V and their rates at one instant. */
typedef struct contact_motion {
  double u[2], v, du[2], dv;
} contact_motion;

/* ---- exact (contact_track.h) ----------------------------------------------------------------------------------- */

/* The start of a slip in two directions by CVODE, where phi, the angle of e, is a state of its equations. */
typedef struct law_opening {
  double began; /* [rad] phi at the start of the turn */
  bool opens;   /* true from a touch until theta = `until`: phi' = rate */
  double rate, until;
} law_opening;

/* One direction of a contact along the motion of a period; state and flags are equal in all directions of a contact. */
typedef struct contact_track {
  contact_state state;
  double rest;       /* W; valid while the contact sticks */
  bool since_start;  /* sticks since the start of the period, so that rest is an independent state */
  double along;      /* this direction's component of e = T/|T|; valid while it slips, or where the period began with
                        |T| = mu N */
  bool turns;        /* slips, and e turns with the motion: T is not linear in it */
  bool fresh;        /* turns, starting with a touch at this instant, N = 0 */
  double changed;    /* [rad] theta of the last event; -INFINITY after a touch; kept by law_line */
  law_opening opens; /* used with CVODE only */
  double from, most; /* W at the start of the period; largest |W - from| since, INFINITY after a separation */
} contact_track;

enum { TRACK_GUARDS = 3, TRACK_ORDER = 24, TRACK_TERMS = TRACK_ORDER + 1 };
typedef enum track_event {
  TRACK_SEPARATES,
  TRACK_TOUCHES,
  TRACK_SLIPS_PLUS,
  TRACK_SLIPS_MINUS,
  TRACK_STICKS,
  TRACK_TURNS, /* the direction of a slip is free to turn from here on */
  TRACK_HOLDS  /* the direction of a slip is kept constant from here on */
} track_event;

/* A guard of a state: g = by_u (U - from_u) + by_v (V + gap) + constant, or by_u U' + by_v V'. */
typedef struct track_condition {
  track_event event; /* event where it falls through 0 */
  bool of_rates;
  double by_u, by_v, from_u, gap, constant;
} track_condition;

/* A guard as a series in tau: coefficients g[TRACK_TERMS]; below -noise it is negative. */
typedef struct track_guard {
  track_event event; /* event where it falls through 0 */
  double noise, g[TRACK_TERMS];
} track_guard;

/* ---- a row ----------------------------------------------------------------------------------------------------- */

/* A contact's motion at theta, with U'' and V'', and its own state z. */
typedef struct law_instant {
  contact_motion at;
  double bend[2], normal_bend;
  double theta, own;
} law_instant;

/* law_pull: T and N - N0 that are not linear in the motion, and the rate of the own state z. law_slopes: their
 * derivatives dT_a/dV, dT_a/dz, dz'/dU'_a, dz'/dV, dz'/dz; for smooth laws, which have one tangent, dT/dU' and
 * dN/dV. */
typedef struct law_pull {
  double t[2], n, rate;
} law_pull;
typedef struct law_slopes {
  double t_v[2], t_own[2], rate_du[2], rate_v, rate_own, t_du, n_v;
} law_slopes;

typedef struct scaled_contact scaled_contact;
typedef struct law_kind {
  int directions;
  bool smooth;   /* forces of pull() act in all states, beside those linear in the motion; there is no state z */
  bool by_rates; /* evaluate() and derivatives() read U', V' */
  planar_value (*evaluate)(const law_regularised *c, const contact_motion *at, const double *w);
  /* Derivatives where they exist; on the limit |S| = mu N those of stick. */
  planar_derivatives (*derivatives)(const law_regularised *c, const contact_motion *at, const double *w);
  double (*bend)(const law_regularised *c); /* velocity scale on which T is nonlinear; NULL: the motion's own
                                               velocity */

  /* Guards of a contact with friction while in contact, without the end of contact; return their number. conditions:
   * those linear in the motion; curved_guards: the others, as series, from the series u[directions][TRACK_TERMS],
   * v[TRACK_TERMS] of U and V. NULL: none. */
  int (*conditions)(const contact_track *t, const scaled_contact *c, track_condition conditions[TRACK_GUARDS]);
  int (*curved_guards)(const contact_track *t, const scaled_contact *c, const double *u, const double *v,
                       track_guard guard[TRACK_GUARDS]);

  /* Number of transitions, possibly negative, that the event at theta adds to the period's; called before
   * contact_track_pass. */
  int (*counts)(contact_track *t, track_event event, double theta);

  /* While it slips: keeps e constant from that motion on if contact ends too soon for a turn of e to matter, else lets
   * it turn. Returns the longest step [rad] for which the decision is valid. NULL: e never turns. */
  double (*hold)(contact_track *t, const scaled_contact *c, const contact_motion *at);

  /* With CVODE, which integrates an own state z of the contact beside the motion; all NULL if there is none. */
  double (*own_begin)(contact_track *t); /* z from the track's direction, at the start of a turn */
  void (*own_open)(contact_track *t, const scaled_contact *c, const law_instant *now); /* after a touch: sets
                                                                                          t->opens */
  void (*own_follow)(contact_track *t, double own); /* sets the track's direction from z */
  law_pull (*pull)(const contact_track *t, const scaled_contact *c, const contact_motion *at, double own);
  law_slopes (*slopes)(const contact_track *t, const scaled_contact *c, const contact_motion *at, double own);
  /* Values and rates, g[0] and g[1], of all guards, the end of contact first; returns their number. may_change: largest
   * change of a rate until N = 0 that keeping e constant may cause. */
  int (*own_guards)(const contact_track *t, const scaled_contact *c, const law_instant *now, double may_change,
                    track_guard guard[TRACK_GUARDS]);
} law_kind;

extern const law_kind law_line, law_planar; /* one tangent; two under the law of the circle */
#define LAW_KIND(code, name) extern const law_kind law_##name;
CONTACT_SMOOTH_LIST(LAW_KIND)
#undef LAW_KIND

struct scaled_contact {
  law_regularised law; /* in the dimensionless units of scaled.h */
  const law_kind *kind;
  int direction;  /* index of this direction: 0, 1 */
  double preload; /* N0 */
};
