/* phase.h - a phase: a stretch of a motion of the exact law (model/contact_law.h) in which no contact changes its
 * state; its equations, and which X or P ends it. libm only.
 *
 * In a phase every contact sticks, slips one way or is separated, and the equation of scaled.h is linear:
 *     P' = f cos(theta) - c P - k X - d            k, d constant
 *     W_j = rest_j + by_x_j X                      the slider: at rest while it sticks (by_x = 0), tied to X otherwise
 * u and v are proportional to X, so every guard of contact_law.h is a function of X alone or proportional to P. A
 * phase lasts while
 *     down < X < up,  and P keeps its sign if some contact slips.
 *
 * At the ends (docs/theory.md, 2): touch -> contact_on_touch; stick -> slip; closed -> separated; slip -> stick where P
 * changes sign.
 *  - A guard that vanishes where a phase begins, and then grows, is moved outwards by a rounding error, so that it can
 *    still end the phase.
 *  - kt cos = mu kn sin to rounding: that guard is constant while the contact sticks, and left out.
 *  - T and N vanish together (a contact that stuck when it touched): the contact separates, and the guard of slip is
 *    left out.
 *  - Several guards vanish at one X, of one contact or of several: all these transitions are made in one call, each
 *    contact's in the order in which one state follows the other.
 * Without friction (kt, kn or mu 0) T = 0: a closed contact counts as stuck, its slider follows u, and only v + gap
 * ends that state. */
#ifndef HC_TIMEINT_PHASE_H
#define HC_TIMEINT_PHASE_H

#include <math.h>
#include <stdbool.h>

#include "timeint/scaled.h"

typedef struct phase_contact {
  contact_state state;
  double rest;                        /* W while the contact sticks */
  double rest_by_x;                   /* d rest/d X where the contact began to stick, at fixed theta */
  bool since_start;                   /* it sticks since the start of the period: rest is an independent state */
  double up, down;                    /* X at which the state ends, rising or falling; infinite if never */
  contact_state after_up, after_down; /* after_up of a separated contact is asked of contact_on_touch */
} phase_contact;

typedef struct phase {
  const scaled_model *m; /* the caller's */
  double k, d, up, down;
  int way;                /* +1: X rises, -1: falls, 0: at rest, at the phase's beginning */
  bool slips;             /* some contact does: the phase ends where P changes sign       */
  phase_contact *contact; /* [m->n_contacts], memory of whoever owns the phase */
} phase;

/* The phase at theta = 0 of any finite state y, ph->contact pointing at memory for m->n_contacts contacts. Where
 * |T| > mu N the slider moves until |T| = mu N; where |T| = mu N the contact slips if P keeps loading it. Answers how
 * many contacts changed their state at once (0 but for states on a guard), or -1 if something is not finite. */
int phase_begin(phase *ph, const scaled_model *m, const double *y);

/* The phase after the present one ended at x: X crossed up or down, or P changed sign (`turned`). way: sign of P
 * from now on. Answers the number of transitions; if it is 0 the phase goes on unchanged. */
int phase_next(phase *ph, double x, int way, bool turned);

/* *to becomes a copy of *from, in its own memory for as many contacts. */
void phase_copy(phase *to, const phase *from);

/* Is there an X, or a change of sign of P, that ends the phase? */
static inline bool phase_ends(const phase *ph) { return ph->slips || ph->up < INFINITY || ph->down > -INFINITY; }

/* P'. cosine: of theta. */
static inline double phase_force(const phase *ph, double cosine, double x, double p)
{
  return ph->m->f * cosine - ph->m->c * p - ph->k * x - ph->d;
}

/* W_j = *rest + *by_x X. */
void phase_slider(const phase *ph, int j, double *rest, double *by_x);

/* The sliders' part of y[n_states], X and P being there: their places (order 0) or velocities (order 1: X is then
 * X'). */
void phase_set_sliders(const phase *ph, int order, double *y);

/* dP'/dW_j: kt cos of a stuck contact; 0 in the other states. */
double phase_slider_stiffness(const phase *ph, int j);

#endif
