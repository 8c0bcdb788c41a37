/* integrate_series.h - the integrator (integrate.h) of the exact law for structures without CVODE, transient.method:
 * closed_form. While no contact changes its state the motion is the exponential of a linear equation, summed to
 * rounding (motion_series.h); a change is a root of guards that are polynomials, none missed but excursions below
 * rounding. Period map, monodromy matrix, peaks and harmonics have no error but rounding: there is no tolerance. */
#ifndef HC_INTEGRATE_SERIES_H
#define HC_INTEGRATE_SERIES_H

#include "timeint/integrate.h"

/* HC_NO_MEMORY. */
hc_status integrate_new_series(const modal_base *base, integrator **out);

#endif
