/* contact_measures.h - what the exact contact law does along a periodic motion of one contact: extrema of its
 * forces, slip path, and dissipated work (model/contact_period.h).
 *
 *     work = closed integral T du = sum over slip intervals of integral mu N |dw|,   w = u - s mu N/kt
 *
 * for T dT integrates to 0 over each time of contact. The second form has no term of the other sign: it is 0 where
 * nothing slips, and a short slip keeps its relative accuracy. Intervals are those of transitions.h, extrema are
 * found as roots of derivatives, and the integrals are Gauss's of sixteen points on panels so short that what is
 * integrated, a trigonometric polynomial of degree 2H, is exact to rounding. */
#pragma once

#include "hbm/hbm_settings.h"
#include "model/contact_period.h"
#include "numerics/base/status.h"

/* For the motion u[2 n_harm + 1], v[2 n_harm + 1] [length] (numerics/series.h), n_harm >= 1; where the history decides,
 * the slider starts from w = 0. HC_BAD_INPUT, HC_NO_MEMORY, HC_NOT_FINITE, and the errors of transitions_find. */
hc_status contact_measures_of(const contact *law, int n_harm, const double *u, const double *v, contact_period *out);
