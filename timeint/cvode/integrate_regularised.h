/* integrate_regularised.h - the integrator (integrate.h) of the regularised law: the equations of scaled.h by BDF with
 * their analytic Jacobian, as structure_newton.h has it. Stiff: a slipping slider follows its
 * limit at the rate 1/regularisation. */
#pragma once

#include "timeint/period/integrate.h"

/* In steps whose error is `tolerance` of the states (of 1, for states smaller than that). HC_NO_MEMORY, also for a
 * tolerance that CVODE refuses. */
hc_status integrate_new_regularised(const modal_base *base, double tolerance, integrator **out);
