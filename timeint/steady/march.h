/* march.h - the steady state by integrating period after period until the state repeats itself. */
#ifndef HC_TIMEINT_MARCH_H
#define HC_TIMEINT_MARCH_H

#include "timeint/steady/steady.h"

/* From ti->y to the steady state, its measures into *r. HC_NOT_SETTLED after max_periods: *r is then the last
 * period. */
hc_status march_to_steady_state(timeint *ti, const hc_monitor *monitor, timeint_result *r);

#endif
