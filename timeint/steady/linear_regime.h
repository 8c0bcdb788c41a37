/* linear_regime.h - motions at which no contact changes its state any more: those of a linear oscillator, whose steady
 * state has a closed form.
 *
 * While every contact stays separated or stuck as it is at ti->y, scaled.h is linear:
 *     X'' + c X' + k X = f cos(theta) + d     k, d constant; d from the resting sliders and from closed clearances
 *     X = d/k + Re(Z e^{i theta}) + free motion,    Z = f/(k - 1 + i c)
 * The free motion's energy k x^2 + p^2 never grows (c >= 0), so from (x0, p0) on |x| <= sqrt(x0^2 + p0^2/k), and X
 * stays within |Z| plus that of d/k. Every guard of a contact is linear in X and so least at an end of that range:
 * if it is positive at both ends, the contact keeps its state. The condition is sufficient, not necessary: the free
 * motion and the response need not reach their largest values together. */
#pragma once

#include "timeint/steady/steady.h"

/* Does no contact change its state from ti->y on (after timeint_begin), as far as the condition above can tell, and
 * does the motion settle? Undamped it settles only if it has already, within transient.tolerance. Either law; of an
 * oscillator only; the regularised one is linear where v + gap is 40 widths of its corner in N away from 0. */
bool linear_regime_is_final(const timeint *ti);

/* True where linear_regime_is_final: ti->y goes onto the steady orbit at theta = 0, and its measures, multiplier and
 * free_sliders into *r; not omega and the counts of work. Sliders of stuck contacts stay; those of separated contacts
 * are where the law has them on the orbit. The multiplier is the oscillator's; that of the regularised slider of a
 * separated contact, exp(-2 pi/regularisation), is left out: it has no influence on X. */
bool linear_regime_steady(timeint *ti, timeint_result *r);

/* Where *r is what that said and ti->y is still there: the measures of response i into *r. */
bool linear_regime_response(const timeint *ti, int i, timeint_result *r);
