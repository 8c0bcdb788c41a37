/* transitions.h - when a contact sticks, slips and separates over a period of a given motion, located to rounding
 * error. Needs libm only; allocates nothing.
 *
 * Every guard of the contact law (model/contact_law.h) is linear in the motion, so it is a trigonometric polynomial
 * f(th) plus a constant:
 *     contact   g   = v + gap
 *     stick(s)  q_s = mu kn (v + gap) - s (kt u - held),   held = kt w          slip(s) starts where q_s falls
 *                                                          through 0
 *     slip(s)   r_s = s kt u' - mu kn v'                                        stick starts where r_s falls through
 *               0
 * A crossing is searched between neighbouring angles of a grid. No crossing is missed, double roots (grazing)
 * included: an interval is dismissed only if max|f''| proves it empty, else it is divided at its extremum or in the
 * middle. */
#ifndef HC_TRANSITIONS_H
#define HC_TRANSITIONS_H

#include "base/status.h"
#include "model/contact_law.h"

enum { MOTION_MAX_DOF = 2, TRANSITIONS_GRID = 32 };

/* The motion of n_dof coordinates, each a series (series.h). */
typedef struct motion {
  int n_harm, n_dof;
  const double *X[MOTION_MAX_DOF]; /* [2 n_harm + 1] [length] */
} motion;

/* A contact and how the coordinates move it: u = sum cu[d] x_d, v = sum cv[d] x_d. */
typedef struct moving_contact {
  contact law;
  double cu[MOTION_MAX_DOF], cv[MOTION_MAX_DOF];
} moving_contact;

/* The coordinates and two derivatives by th at one angle. */
typedef struct motion_node {
  double th, d[3][MOTION_MAX_DOF];
} motion_node;

/* A stretch of the period in one state. */
typedef struct contact_piece {
  double from, to;              /* [rad] from < to <= from + 2 pi */
  contact_state state;          /* never CONTACT_SEPARATED: what is not covered is separated */
  double held;                  /* [force] kt w while stuck */
  double origin;                /* [rad] where the slider came to rest: d held = sum slope[d] dx_d(origin) */
  double slope[MOTION_MAX_DOF]; /* [force/length] all 0 when held depends on nothing */
  int transitions;              /* changes of state since the walk began: a guard against chatter */
} contact_piece;

/* Grid values of a motion, shared by all contacts. */
typedef struct motion_grid {
  motion m;
  double size[3][MOTION_MAX_DOF];             /* sums of |coefficients| of x, x', x'' */
  motion_node node[2 * TRANSITIONS_GRID + 1]; /* two periods: a walk that starts anywhere in the first never wraps */
} motion_grid;

/* cos and sin of h th_i for half the grid, [n_harm][2][TRANSITIONS_GRID/2], filled once: half a period later odd
 * harmonics change sign. */
static inline int motion_table_length(int n_harm) { return TRANSITIONS_GRID * n_harm; }
void motion_table_fill(int n_harm, double *table);

void motion_grid_fill(motion_grid *g, const motion *m, const double *table);
motion_node motion_at(const motion *m, double th);

/* The pieces of one period, ascending, into piece[cap]; *n of them. The slider starts at w = 0 where contact never
 * breaks. HC_CHATTER: more than cap pieces. HC_NOT_CLOSED: the slider did not repeat itself. */
hc_status transitions_find(const motion_grid *grid, const moving_contact *c, int cap, contact_piece *piece, int *n);

#endif
