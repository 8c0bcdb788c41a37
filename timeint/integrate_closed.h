/* integrate_closed.h - the integrator (integrate.h) of the exact law in closed form, transient.method: closed_form.
 * While no contact changes its state the motion is a sum of exponentials and harmonics (modal_motion.h); the change is
 * a root of such sums, found to rounding, none missed but excursions below rounding. Period map, monodromy matrix,
 * peaks and first harmonic have no error but rounding: there is no tolerance. Microseconds a period. */
#ifndef HC_INTEGRATE_CLOSED_H
#define HC_INTEGRATE_CLOSED_H

#include "timeint/integrate.h"

/* For n_states equations; the tolerance is ignored. HC_BAD_INPUT if n_states < 2; HC_NO_MEMORY. */
hc_status integrate_new_closed(int n_states, double tolerance, integrator **out);

#endif
