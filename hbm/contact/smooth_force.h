/* smooth_force.h - contact force harmonics of smooth laws, by samples of a period. A polynomial of degree p of a motion
 * with H harmonics has p H of them, and its products with one of the first H have (p + 1) H: N >= (p + 1) H + 1
 * samples give the first H, and the Jacobian, without aliasing, to rounding. That many are `exact`. */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "model/contact_period.h"

extern const contact_evaluator polynomial_evaluator, polynomial_sampled_evaluator;

/* Extrema of the force along v[2 n_harm + 1], to rounding; u, u_2 are not looked at. As contact_measures_of. */
hc_status polynomial_measures_of(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,
                                 contact_period *out);
