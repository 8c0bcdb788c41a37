/* chaos.h - do neighbouring motions drift apart, although the motion itself goes nowhere?
 *
 * The largest Lyapunov exponent [1/period]: the mean of log |d_(n+1)|/|d_n|, d the distance of a neighbour that is
 * brought back to a small distance after each period. It is positive in chaos, but also while a motion leaves an
 * unstable orbit, which takes thousands of periods where damping is low. What tells the two apart is how often the
 * distance could have grown by e. Next to an orbit of k periods the motion's distance from it, D, is itself that of a
 * neighbour: it is at least half the return |z_n - z_(n-k)| (multipliers beyond -1 make it 2 D) and at most the size of
 * the motion, so in the time that a motion needs to leave neighbours grow by no more than
 *     log(2 size/return)
 * folds. In chaos there is no end to it, however narrow the bands in which the motion stays. */
#ifndef HC_TIMEINT_CHAOS_H
#define HC_TIMEINT_CHAOS_H

#include "timeint/steady/steady.h"

/* From ti->y on, which moves along. *chaos stays false, and nothing is integrated, before the transient has died out
 * (500 periods, and six times those in which damping reduces a difference by e) and where too few periods are left.
 * *rate [1/period]: the mean where it was measured, with chaos or without. */
hc_status chaos_test(timeint *ti, const hc_monitor *monitor, bool *chaos, double *rate);

#endif
