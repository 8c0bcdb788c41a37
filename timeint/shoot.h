/* shoot.h - a periodic orbit as a fixed point of the period map: z = F^k(z), F one period of the forcing.
 *
 * Newton (KINSOL): z - F^k(z) = 0 with the Jacobian I - Phi, Phi the monodromy matrix from the variational
 * equations. Quadratic where F is smooth, and F is where no transition is grazed; the number of periods it takes
 * does not know the damping. A slider stuck all the time repeats itself wherever it is: its row of Phi is that of
 * the identity. It is left where it is, and counted as free; everything else is unique given that. Anderson
 * (KINSOL's fixed point): needs no Phi; for where Newton fails. Works on ti->y in the unit of length ti->length, at
 * CVODE's tolerance of the moment. */
#ifndef HC_TIMEINT_SHOOT_H
#define HC_TIMEINT_SHOOT_H

#include <complex.h>

#include "timeint/timeint.h"

typedef struct shoot shoot;

typedef struct shoot_report {
  double distance;  /* [L] |(I - Phi)^-1 (F^k(z) - z)|: how far the orbit still is, to first order */
  double moved;     /* [L] from the start to the orbit */
  double nonlinear; /* [1] |F^k(z0) - z* - Phi (z0 - z*)| / |z0 - z*| at the start z0: 0 where the map is linear all
                       the way */
  double complex multiplier; /* the largest, free sliders left out */
  int free_sliders;
} shoot_report;

hc_status shoot_new(timeint *ti, shoot **out);
void shoot_free(shoot *s);

/* From ti->y to the orbit, Newton steps no longer than `reach` [L]; ti->y becomes a point on it. On failure ti->y is
 * where it was. goal [L]: distance at which to stop, or at what the scatter of periods, seen through (I - Phi)^-1,
 * allows; report->distance says which. HC_SINGULAR, HC_STALLED, HC_NOT_CONVERGED; HC_NOT_SETTLED after max_periods;
 * what integration answers; HC_INTERRUPTED. */
hc_status shoot_newton(shoot *s, int k, double reach, double goal, const hc_monitor *monitor, shoot_report *report);
hc_status shoot_anderson(shoot *s, int k, double goal, const hc_monitor *monitor, shoot_report *report);

/* The direction in which neighbours of the last orbit leave it fastest (or approach it slowest), of length 1. */
void shoot_direction(const shoot *s, double *z);

#endif
