/* settle.h - has a sequence of states, one a period, reached a fixed point (or a k-cycle), and how far off is it?
 * Knows nothing of oscillators: points z_n of R^d under a contraction unknown, plus noise.
 *
 * Near a fixed point z*, z_n - z* = e_n and |e_n| ~ rho^n. For any stride m,
 *     |z_n - z_{n-m}| >= |e_{n-m}| (1 - rho^m) >= |e_n| (1 - rho^m)       so       |e_n| <= D_m / (1 - rho^m),
 * D_m = max |z_i - z_{i-m}| over the latest i (multipliers are complex: single differences oscillate). Each m gives
 * a bound; small ones answer soonest, long ones are not drowned by noise, which 1/(1 - rho) would amplify. The
 * smallest is taken.
 *
 * rho: the larger of
 *   - the a-priori contraction, given by the caller (exp(-C T/2M): what damping alone does to the modulus of a
 *     complex pair, friction only adding to it); believed no closer to 1 than CAP, where 1000 periods could tell it
 *     from 1 no longer;
 *   - the measured one, where the drift keeps one direction over a baseline of B periods (or 2 B, 4 B ...): that is
 *     a real multiplier, and it may be the slow one of a split pair (near a fold). Then rho^B is the ratio of the
 *     largest drifts of the last B periods and of the B before. Drift without direction is rotation or noise; no
 *     rate can be measured from noise. (So a multiplier so near 1 that its drift drowns in noise goes unseen: very
 *     close to a fold the distance is then underestimated.)
 * Nothing is said before 2 B + 17 states are in. B = 2/(1 - rho) a priori: two e-folds, 16 to 512 periods.
 * Multipliers near -1, or near another root of 1, hide from D_m at multiples of k: so the drift D_1 itself must be
 * small too. */
#ifndef HC_TIMEINT_SETTLE_H
#define HC_TIMEINT_SETTLE_H

#include "base/status.h"

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

/* The map has changed a little, and so has its fixed point: judge by points pushed from now on (the last one stays). */
void settle_restart(settle *s);

void settle_push(settle *s, const double *z);

/* The smallest |z_n - z_{n-k}| over k = 1..SETTLE_MAX_MULTIPLE: how near to any cycle the last step was. INFINITY
 * with one point. */
double settle_drift(const settle *s);

/* Contraction per step over the last 2 B: (largest drift of the last B)/(of the B before), to the power 1/B; 1 and
 * more where it does not fall, NaN before 2 B + 1 points. To be asked while the drift is far above the noise;
 * settle_judge does not rely on it. */
double settle_rate(const settle *s);

/* B, in steps. */
int settle_baseline(const settle *s);

/* The distance to the fixed point, or, if that is not within goal while some k-cycle is, to the shortest of these.
 * goal > 0. */
settle_estimate settle_judge(const settle *s, double goal);

#endif
