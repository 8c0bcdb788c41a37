/* richardson.h - measures of a steady state extrapolated to no regularisation (transient.richardson). */
#ifndef HC_TIMEINT_RICHARDSON_H
#define HC_TIMEINT_RICHARDSON_H

#include "timeint/steady.h"

/* *r, the measures of the orbit through ti->y, becomes what they are at no regularisation, with an estimate of the
 * error left. Does nothing where the settings do not ask for it, or the law is exact. Errors as timeint_orbit. */
hc_status richardson_extrapolate(timeint *ti, const hc_monitor *monitor, timeint_result *r);

#endif
