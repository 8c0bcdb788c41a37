/* regularised.h - the regularised law checks itself on the orbit it has found.
 *
 * The corner in N is a part of each contact's vibration on its own orbit (state_sizes.h). Before an orbit is known that
 * is an estimate; where the orbit contradicts it, it is found again with what was measured there. Then the error of
 * amplitudes by the regularisation, width and eta:
 *     the exact law's orbit is known in closed form   the difference to it
 *     else                                            the change by half the regularisation, whose orbit is kept
 * Where it is larger than transient_settings.regularisation_error, the regularisation is halved until it is not (0: no
 * error is looked for). A contact that neither slips nor comes to within LAW_SOFT_END widths of its corner has none. */
#pragma once

#include "timeint/steady/steady.h"

/* Before the orbit of k periods next to ti->y is looked for: widths, where the closed form has one next to it. Errors
 * of orbits. */
hc_status regularised_begin(timeint *ti, int k, const hc_monitor *monitor);

/* On the orbit just found and measured, *r. HC_OK, also where no halving is enough: who reads the number asks for its
 * error (timeint_predict). HC_NOT_SETTLED where an orbit is lost on the way; HC_NO_MEMORY, HC_INTERRUPTED. */
hc_status regularised_check(timeint *ti, const hc_monitor *monitor, timeint_result *r);
