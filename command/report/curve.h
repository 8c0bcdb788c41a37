/* curve.h - the response curve and what stands on it, as JSON for the page: points in the curve's order, for a
 * folded curve is not a function of omega. */
#ifndef HC_REPORT_CURVE_H
#define HC_REPORT_CURVE_H

#include <jansson.h>

#include "cases/scene.h"
#include "compare/comparison.h"

/* {curve: columns of points; turned: the same, with harmonic 0 dropped if the scene keeps it, else kept; specials;
 * transient: the rows' results}, read by response.js. A curve that stops early is shown as far as it goes.
 * HC_INTERRUPTED, HC_NO_MEMORY. */
hc_status curve_json(const scene *sc, const comparison *c, const hc_monitor *monitor, json_t **out);

#endif
