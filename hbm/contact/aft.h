/* aft.h - contact force harmonics from displacement harmonics by sampling (alternating frequency/time).
 *
 * Needs n_time >= 2 n_harm + 1 samples a period, even or odd, else HC_BAD_INPUT. Its Jacobian is that of the
 * sampled F, aliasing included. Evaluating allocates nothing: HC_NOT_FINITE if X is not finite; HC_NOT_CLOSED if the
 * slider did not return to where it was a period before. */
#pragma once

#include "hbm/contact/contact_evaluator.h"

extern const contact_evaluator aft_evaluator; /* of one contact with one tangent */
