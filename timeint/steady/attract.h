/* attract.h - which attractor a motion goes to: a periodic orbit of up to 16 periods, or chaos. */
#ifndef HC_TIMEINT_ATTRACT_H
#define HC_TIMEINT_ATTRACT_H

#include "timeint/steady/steady.h"

/* From ti->y, next to no known stable orbit, to the attractor, its measures into *r. first: periods in the first
 * stretch of marching. HC_APERIODIC: *r is the last period; else as timeint_steady. */
hc_status attract(timeint *ti, int first, const hc_monitor *monitor, timeint_result *r);

#endif
