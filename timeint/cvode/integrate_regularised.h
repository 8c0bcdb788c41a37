/* integrate_regularised.h - the integrator (integrate.h) of the regularised law: the equations of scaled.h by BDF with
 * their analytic Jacobian, as structure_newton.h has it. Stiff: a slipping slider follows its
 * limit at the rate 1/regularisation. */
#pragma once

#include "timeint/period/integrate.h"

/* In steps whose error is `tolerance` > 0 of the states' sizes (integrate_weights). HC_BAD_INPUT,
 * HC_NO_MEMORY. */
hc_status integrate_new_regularised(const modal_base *base, double tolerance, integrator **out);
