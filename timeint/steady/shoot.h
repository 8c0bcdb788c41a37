/* shoot.h - a periodic orbit as a fixed point of the period map (period_map.h): z = F^k(z).
 *
 * Newton (KINSOL): z - F^k(z) = 0 with the Jacobian I - Phi. Quadratic where F is smooth, which it is unless the orbit
 * grazes a transition; the number of periods it takes does not depend on the damping. A free slider stays where the
 * start put it; the rest of the orbit is unique given that. Large structures take chord steps. Anderson
 * (KINSOL's fixed point) needs no Phi: used where Newton fails. */
#pragma once

#include <complex.h>

#include "timeint/timeint.h"

typedef struct shoot shoot;

typedef struct shoot_report {
  double distance;   /* [L] |(I - Phi)^-1 (F^k(z) - z)|: how far the orbit still is, to first order */
  double attainable; /* [L] no orbit can be found to better than this (period_map_attainable) */
  double moved;      /* [L] from the start to the orbit */
  double nonlinear;  /* [1] |F^k(z0) - z* - Phi (z0 - z*)| / |z0 - z*|, z0 the start: 0 where F^k is linear between
                       z0 and z* */
  double complex multiplier; /* the largest, free sliders left out; on the edge of slip of the side that sticks */
  int free_sliders;
} shoot_report;

/* [goal] The residual at which iterations stop, where (I - Phi)^-1 is known to its order of magnitude only. */
#define SHOOT_SHARE_OF_GOAL 0.1

/* On ti->map. HC_NO_MEMORY: *out is NULL. */
hc_status shoot_new(timeint *ti, shoot **out);
void shoot_free(shoot *s);

/* From ti->y to the orbit of k periods, Newton steps no longer than `reach` [L]; ti->y becomes a point on it. On
 * failure ti->y is unchanged. goal [L]: the distance from the orbit at which to stop; where the scatter of
 * integrated periods, times |(I - Phi)^-1|, is larger, that distance; report->distance says how far it came.
 * HC_SINGULAR, HC_STALLED, HC_NOT_CONVERGED; HC_NOT_SETTLED after max_periods; what integrate_monodromy answers;
 * HC_INTERRUPTED. */
hc_status shoot_newton(shoot *s, int k, double reach, double goal, const hc_monitor *monitor, shoot_report *report);
hc_status shoot_anderson(shoot *s, int k, double goal, const hc_monitor *monitor, shoot_report *report);

/* Answers that mean there is no orbit next to the start that Newton or Anderson could find, and nothing worse. */
static inline bool shoot_found_no_orbit(hc_status st)
{
  return st == HC_SINGULAR || st == HC_STALLED || st == HC_NOT_CONVERGED || st == HC_CHATTER || st == HC_NOT_SETTLED;
}

/* z[n]: the direction, of length 1, in which neighbours of the last orbit leave it fastest (or approach it slowest):
 * the power iteration on Phi. */
void shoot_direction(shoot *s, double *z);
