/* planar_shift.h - a pass of a circle's slider moved to where it closes, when that is near: to first order, by the
 * same variational equations as the force's derivatives (planar_force.h), w while it sticks and phi while it slips.
 * Moved by d, phi is then off by about d^2; the ends of intervals stay where they are, and what is integrated over the
 * intervals is off by d^2, too, since the force is continuous there. libm only, nothing is allocated. */
#ifndef HC_HBM_PLANAR_SHIFT_H
#define HC_HBM_PLANAR_SHIFT_H

#include "hbm/planar/planar_cycle.h"

/* [rad] The most that phi may be moved by. */
#define PLANAR_SHIFT_MOST 3e-9

/* Moves the last pass, which must have been in contact all the time, by dw0 [length] of its start; false, and nothing
 * is changed, where phi would be moved by more than PLANAR_SHIFT_MOST. */
bool planar_shift(planar_cycle *c, const double dw0[2]);

#endif
