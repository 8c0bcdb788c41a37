/* integrate_regularised.h - the integrator (integrate.h) of the regularised law: the equations of scaled.h by BDF with
 * the analytic Jacobian of structure_newton.h. They are stiff: a slipping slider relaxes at the rate
 * 1/regularisation. */
#pragma once

#include "timeint/period/integrate.h"

/* tolerance > 0: error of a step, relative to the states' sizes (integrate_weights). HC_BAD_INPUT, HC_NO_MEMORY. */
hc_status integrate_new_regularised(const modal_base *base, double tolerance, integrator **out);
