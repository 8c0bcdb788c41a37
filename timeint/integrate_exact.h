/* integrate_exact.h - the integrator (integrate.h) of the exact law, event-driven: while no contact changes its
 * state the equations are linear (phase.h); CVODE carries X and P to the next change and starts afresh there.
 * Sliders follow from the contact states. Adams: nothing here is stiff but a huge damping. */
#ifndef HC_TIMEINT_INTEGRATE_EXACT_H
#define HC_TIMEINT_INTEGRATE_EXACT_H

#include "timeint/integrate.h"

/* For n_states equations, in steps whose error is `tolerance` of the states (of 1, for states smaller than that).
 * HC_BAD_INPUT if n_states < 2; HC_NO_MEMORY, also for a tolerance that CVODE refuses. */
hc_status integrate_new_exact(int n_states, double tolerance, integrator **out);

#endif
