/* richardson.h - measures of a steady state extrapolated to no regularisation (transient.richardson). */
#ifndef HC_TIMEINT_RICHARDSON_H
#define HC_TIMEINT_RICHARDSON_H

#include "timeint/steady/steady.h"

/* Memory, where the settings ask for it. HC_NO_MEMORY. */
hc_status richardson_new(timeint *ti);

/* *r, the measures of the orbit through ti->y, becomes what they are at no regularisation, with an estimate of the
 * error left; what becomes of every response is kept. ti->y ends on the orbit of RICHARDSON_FINEST times the
 * regularisation. Does nothing where the settings do not ask for it, or the law is exact. Errors as timeint_orbit. */
hc_status richardson_extrapolate(timeint *ti, const hc_monitor *monitor, timeint_result *r);

#define RICHARDSON_FINEST 0.25

/* The measures of response i in *r: of the last result, if it is extrapolated. */
void richardson_response(const timeint *ti, int i, timeint_result *r);

#endif
