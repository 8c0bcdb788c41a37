/* linear_forever.h - motions at whose contacts nothing happens any more: a linear oscillator, settled by formula
 * instead of integration.
 *
 * While every contact stays separated or stuck as it is at ti->y, scaled.h is linear:
 *     X'' + c X' + k X = f cos(theta) + d       k, d constant: d from held sliders and from clearances that are
 *                                               closed
 *     X = d/k + Re(Z e^{i theta}) + free motion,    Z = f/(k - 1 + i c)
 * The free motion's energy k x^2 + p^2 never grows (c >= 0), so from (x0, p0) on it stays within sqrt(x0^2 +
 * p0^2/k), and X within |Z| + that of d/k for ever. Every guard of a contact is linear in X and so least at an end
 * of that range: if it is positive at both ends, the state never ends. The bound adds what need not coincide: "no"
 * means not known. */
#ifndef HC_TIMEINT_LINEAR_FOREVER_H
#define HC_TIMEINT_LINEAR_FOREVER_H

#include "timeint/timeint.h"

/* Will no contact change its state from ti->y on (after timeint_begin), and does the motion settle? Undamped it does
 * only if it has, within transient.tolerance. Either law; the regularised one is linear, too, where its corner in N
 * is 40 widths away. */
bool linear_forever(const timeint *ti);

/* After linear_forever said yes: ti->y onto the steady orbit at theta = 0, and its measures, multiplier and
 * free_sliders into *r; not omega and the counts of work. Sliders: held ones stay; those of separated contacts are
 * where the law has them on the orbit. The multiplier is the oscillator's; that of a regularised slider let go,
 * exp(-2 pi/regularisation), is left out: it does not reach X. */
void linear_steady(timeint *ti, timeint_result *r);

#endif
