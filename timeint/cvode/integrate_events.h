/* integrate_events.h - the integrator (integrate.h) of the exact law for structures by CVODE: one smooth right-hand
 * side for each set of contact states, from one transition to the next; guards are those of contact_track.h.
 * Adams' method, or BDF where damping makes the structure stiff: where its largest rate is 60 times the lowest natural
 * frequency or more (beam16: 4000 steps a period, not 22 000). A contact with two tangents that slips under the law of
 * the circle adds the angle of its traction to the states (law_planar.c). */
#pragma once

#include "timeint/period/integrate.h"

/* tolerance > 0: CVODE's, relative to the states' sizes (integrate_weights). HC_BAD_INPUT, HC_NO_MEMORY. */
hc_status integrate_new_events(const modal_base *base, double tolerance, integrator **out);
