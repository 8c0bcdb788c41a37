/* settle.h - has a sequence of states, one a period, reached a fixed point (or a k-cycle), and how far off is it?
 * Knows no mechanics: points z_n of R^d under an unknown contraction, plus noise.
 *
 * Near a fixed point z*, z_n - z* = e_n and |e_n| ~ rho^n. For any stride m,
 *     |z_n - z_{n-m}| >= |e_{n-m}| (1 - rho^m) >= |e_n| (1 - rho^m)       so       |e_n| <= D_m / (1 - rho^m),
 * D_m = max |z_i - z_{i-m}| over the latest i (multipliers are complex, so single differences oscillate). Each m gives
 * a bound: short strides the soonest; in long ones the noise is divided by 1 - rho^m instead of 1 - rho. The smallest
 * bound is used.
 *
 * rho: the larger of
 *   - the a-priori contraction, given by the caller (exp(-C T/2M): the modulus of a complex pair by damping alone;
 *     friction makes it smaller), but no more than contraction_cap, since 1000 periods cannot tell a larger one from 1;
 *   - the measured one, where the drift keeps one direction over a baseline of B periods (or 2 B, 4 B ...): that is
 *     a real multiplier, and may be the larger one of a pair that has become real (near a fold). Then rho^B is the
 *     ratio of the largest drifts of the last B periods and of the B before. Drift without direction is rotation or
 *     noise, and no rate is measured. (So a multiplier so near 1 that its drift is below the noise is not seen: very
 *     close to a fold the distance is underestimated.)
 * No estimate before 2 B + 17 states. B = 2/(1 - rho) a priori: two e-folds, 16 to 512 periods.
 * A multiplier near a k-th root of 1 other than 1, such as -1, makes D_m small at multiples m of k though the states
 * still move: so the drift D_1 must be small too. */
#pragma once

#include "timeint/steady/steady.h"

enum { SETTLE_MAX_MULTIPLE = 16 };

typedef struct settle settle;

typedef struct settle_estimate {
  double distance;    /* [as z] estimated |z_n - z*|; INFINITY when nothing can be said */
  double contraction; /* [1] measured, per step, along a drift of one direction; NaN without */
  int multiple;       /* of the shortest cycle within goal; 0: none is */
} settle_estimate;

/* Room for points of d components. Everything is allocated here. */
hc_status settle_new(int d, settle **out);
void settle_free(settle *s);

/* Forget all points. 0 <= contraction <= 1 a priori. */
void settle_start(settle *s, double contraction);

/* The map has changed a little, and so has its fixed point: judge by the last point and those pushed from now on. */
void settle_restart(settle *s);

void settle_push(settle *s, const double *z);

/* The smallest |z_n - z_{n-k}| over k = 1..SETTLE_MAX_MULTIPLE: how near to any cycle the last step was. INFINITY
 * with one point. */
double settle_drift(const settle *s);

/* The distance to the fixed point, or, if that is not within goal while some k-cycle is, to the shortest of these.
 * goal > 0. */
settle_estimate settle_judge(const settle *s, double goal);

/* ---- the steady state by integrating period after period until the state repeats itself ---- */

/* From ti->y to the steady state, its measures into *r. HC_NOT_SETTLED after max_periods: *r is then the last
 * period. */
hc_status settle_by_integration(timeint *ti, const hc_monitor *monitor, timeint_result *r);
