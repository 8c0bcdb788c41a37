/* planar_measures.h - measures of a contact with two tangents under the exact law of the circle along a periodic
 * motion: contact_measures.h in the plane.
 *
 *     work = closed integral T . du = sum over slip intervals of integral mu N |dw|,   |w'| = s = u'.e - R'
 *
 * on the panels of planar_slip.h, by their own sums. */
#pragma once

#include "model/contact_period.h"
#include "numerics/base/status.h"

/* out[2]: the measures of the two halves as in contact_period.h; `half` is their law, with friction. The motion is u1[2
 * n_harm + 1], u2, v [length] (numerics/series.h), n_harm >= 1; where the history decides, the slider rests at the
 * place of planar_rest.h. HC_BAD_INPUT, HC_NO_MEMORY, and the errors of planar_force_eval. */
hc_status planar_measures_of(const contact *half, int n_harm, const double *u1, const double *u2, const double *v,
                             contact_period out[2]);
