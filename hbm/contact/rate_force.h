/* rate_force.h - contact force harmonics of friction as a smooth function of the velocity,
 *
 *     T = mu N tanh(omega u'/epsilon),      N - N0 by located transitions (exact_force.h)
 *
 * Without aliasing: T's integrals by Gauss's rule on panels of each time in contact, no longer than 0.65 of the
 * distance to the nearest pole of tanh, i pi epsilon/2 beside where u' = 0: to rounding, however small epsilon is. The
 * other evaluator samples T and N - N0 at n_time instants. The Jacobian is that of u and v, and of u' by harmonics. */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "model/contact_period.h"

extern const contact_evaluator tanh_evaluator, tanh_sampled_evaluator;

/* As contact_measures_of, law->epsilon [length]: that of the velocity by angle, epsilon/omega. The path of slip is that
 * of u in contact, the work is T's. */
hc_status tanh_measures_of(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,
                           contact_period *out);
