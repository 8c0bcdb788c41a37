/* escape.h - motions that repeat no more because they go away, told from those that have only not settled yet.
 *
 * Growth: nothing damps some mode, and the size of the motion grows by as much a period as it did before, far above
 * what the loads alone explain.
 *
 * Creep: nothing holds the structure along a direction d but friction, and it moves on by d in each period:
 *
 *     x(t + T) = x(t) + d,   w_j(t + T) = w_j(t) + t_j . d,   K d = 0,   n_j . d = 0        w: sliders
 *
 * The equations know no place along such a d, so that a motion that has done this in one period does it in each. */
#pragma once

#include "timeint/steady/steady.h"

/* False where K has no direction without stiffness: nothing creeps. */
bool timeint_may_creep(const timeint *ti);

/* HC_UNBOUNDED where the motion is larger than any damped resonance, and than its start; HC_NOT_FINITE where numbers
 * have overflown, which is no growth. */
hc_status escape_size(const timeint *ti);

/* After some periods: their number, and the size of the motion, where the number has doubled since: true. */
bool escape_note(timeint *ti);

/* True if the motion at ti->y grows, by three sizes noted and the present one. */
bool escape_grows(const timeint *ti);

/* *creeps, after two more periods; ti->drift[n_dof] is then d, in the case's coordinates. At once, and false, where K
 * has no direction of that kind. Errors of integration. */
hc_status escape_look_for_creep(timeint *ti, bool *creeps);
