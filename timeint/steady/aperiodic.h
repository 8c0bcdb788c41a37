/* aperiodic.h - a motion that repeats itself after no number of periods: is it chaotic, or does it run on a torus?
 *
 * Chaos: the motion is bounded, and neighbouring motions drift apart exponentially for ever. The largest Lyapunov
 * exponent [1/period] is the mean of log(|d_(n+1)|/|d_n|), d the distance of a neighbour that is brought back to a
 * small distance after each period. It is positive in chaos, but also while a motion leaves an unstable orbit,
 * which takes thousands of periods where damping is low. What tells the two apart is how often the distance could have
 * grown by the factor e. Next to an orbit of k periods the motion's distance from it, D, is itself that of a
 * neighbour: it is at least half the return |z_n - z_(n-k)| (multipliers beyond -1 make it 2 D) and at most the size of
 * the motion, so in the time that a motion needs to leave neighbours grow by no more than
 *     log(2 size/return)
 * such factors. In chaos there is no such limit, even where the motion stays in narrow bands.
 *
 * Beyond a Neimark-Sacker bifurcation a complex pair of Floquet multipliers is outside the unit circle, and the motion
 * goes to a torus: its states after each period lie on a closed curve and go round it by nu turns a period,
 *     z_n = G(nu n),  G of period 1,  nu irrational
 * so that the motion is made of the frequencies (j + k nu) omega. What is seen once a period tells nu only up to its
 * sign and whole numbers: nu omega, 0 < nu < 1/2, is said. Neighbours neither approach nor drift apart (the largest
 * Lyapunov exponent is 0).
 *
 * Told by averages over two windows, one after the other, each weighted by w(t) = exp(-1/(t (1 - t))): on a torus they
 * converge faster than any power of the window's length (S. Das, Y. Saiki, E. Sander, J. A. Yorke, Nonlinearity 30,
 * 2017), in chaos like its root, and while a motion settles, or grows, they move. */
#pragma once

#include "timeint/steady/steady.h"

/* From ti->y on, which moves along. *chaos stays false, and nothing is integrated, before the transient has died out
 * (500 periods, and six times those in which damping reduces a difference by e) and where too few periods are left.
 * *rate [1/period]: the mean where it was measured, with chaos or without. */
hc_status chaos_test(timeint *ti, const hc_monitor *monitor, bool *chaos, double *rate);

/* From ti->y on, over two windows of 1024 periods, along which it moves. *nu [1]: of a torus, in (0, 1/2); NaN: it is
 * none, or cannot be told, or no periods are left. An oscillator never is on one: its period map shrinks areas, and a
 * closed curve would have to keep the one inside. Errors of integration; HC_INTERRUPTED. */
hc_status torus_test(timeint *ti, const hc_monitor *monitor, double *nu);

/* The same of what was seen: two windows of n values each of two things, the first of which may stand still. The part
 * of torus_test that integrates nothing. */
double torus_rotation(int n, const double *seen, const double *size);
