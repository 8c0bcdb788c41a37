/* integrate_closed_form.h - the integrator (integrate.h) of the exact law without CVODE, transient.method: closed_form.
 * While no contact changes its state the motion is the exponential of a linear equation: a power series, summed to
 * rounding (motion_series.h), or of a stiff structure, whose series would take thousands of steps, its complex modes
 * (motion_modes.h). A change of state is a root of guards that are polynomials or sums of exponentials; none is missed
 * except excursions below rounding. Period map, monodromy matrix, peaks and harmonics have no error but rounding: there
 * is no tolerance. */
#pragma once

#include "timeint/closed_form/interval_modes.h" /* INTERVAL_MODES_STIFF */
#include "timeint/period/integrate.h"

/* Complex modes are used where the fastest rate is more than `stiff` times omega (INTERVAL_MODES_STIFF; 0: wherever
 * they exist; INFINITY: never). HC_NO_MEMORY. */
hc_status integrate_new_closed_form(const modal_base *base, double stiff, integrator **out);
