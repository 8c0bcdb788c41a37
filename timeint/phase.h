/* phase.h - the contact states of the exact law (model/contact_law.h) in which a motion stays for a while, and what
 * ends them. libm only.
 *
 * In a phase every contact sticks, slips one way or is separated, and the equation of scaled.h is linear:
 *     P' = f cos(theta) - c P - k X - d            k, d constant: no switch is left in it, whatever X and P are
 *     W_j = rest_j + by_x_j X                      the slider: fixed while it sticks (by_x = 0), tied to X otherwise
 * u and v are proportional to X, so every guard of contact_law.h is a function of X alone or proportional to P. A
 * phase lasts while
 *     down < X < up,  and P keeps its sign if some contact slips.
 *
 * At the ends (docs/theory.md, 2): touch -> contact_on_touch; stick -> slip; closed -> separated; slip -> stick where P
 * changes sign.
 *  - A guard that vanishes where a phase begins, and then grows, is moved outwards by a rounding, so that it can
 *    still end the phase.
 *  - kt cos = mu kn sin to rounding: that guard is constant while sticking, and dropped.
 *  - T and N vanish together (a contact that touched and stuck): the separation is what happens, the slip's guard is
 *    dropped.
 *  - Several ends at one X, of one contact or of several: all are taken, in the order in which they follow from each
 *    other.
 * Without friction (kt, kn or mu 0) T = 0: a closed contact counts as stuck, its slider goes with u, only v + gap
 * ends it. */
#ifndef HC_TIMEINT_PHASE_H
#define HC_TIMEINT_PHASE_H

#include <stdbool.h>

#include "timeint/scaled.h"

typedef struct phase_contact {
  contact_state state;
  double held;      /* the slider while it sticks */
  double held_by_x; /* what held follows X by where it came to rest: d held/d X there, at fixed theta */
  bool own;         /* sticks since the period's start: held is a state of its own */
  double up, down;  /* X at which it ends, rising or falling; infinite if never */
  contact_state after_up, after_down; /* after_up of a separated contact is asked of contact_on_touch */
} phase_contact;

typedef struct phase {
  const scaled_model *m; /* the caller's */
  double k, d, up, down;
  int way;    /* +1: X rises, -1: falls, 0: at rest, at the phase's beginning */
  bool slips; /* some contact does: the phase ends where P changes sign       */
  phase_contact contact[TIMEINT_MAX_CONTACTS];
} phase;

/* The phase at theta = 0 of any finite state y: sliders beyond their limit are drawn to it, those on it slip if the
 * motion there goes on. Answers how many contacts changed at once (0 but for states on a guard), or -1 if something
 * is not finite. */
int phase_begin(phase *ph, const scaled_model *m, const double *y);

/* The phase after the present one ended at x: X crossed up or down, or P changed sign (`turned`). way: sign of P
 * from now on. Answers how many transitions that took; at 0 the phase goes on as it was. */
int phase_next(phase *ph, double x, int way, bool turned);

/* Is there anything that can end it? */
static inline bool phase_ends(const phase *ph) { return ph->slips || ph->up < INFINITY || ph->down > -INFINITY; }

/* P'. cosine: of theta. */
static inline double phase_force(const phase *ph, double cosine, double x, double p)
{
  return ph->m->f * cosine - ph->m->c * p - ph->k * x - ph->d;
}

/* W_j = *rest + *by_x X. */
void phase_slider(const phase *ph, int j, double *rest, double *by_x);

/* Force on P' by the slider of a stuck contact: dP'/dW_j; 0 in the other states. */
double phase_share(const phase *ph, int j);

#endif
