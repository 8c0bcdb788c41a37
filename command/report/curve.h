/* curve.h - the response curve and what stands on it, as JSON for the page: points in the curve's order, for a
 * folded curve is not a function of omega. */
#ifndef HC_REPORT_CURVE_H
#define HC_REPORT_CURVE_H

#include <jansson.h>

#include "casefile/scene.h"
#include "compare/comparison.h"

enum { CURVE_MOST_RESPONSES = 12 };

/* Of the first response, and into *others a list of the same for the others of a structure, up to
 * CURVE_MOST_RESPONSES in all (special points are the first one's): {curve: columns of points; turned: the same, with
 * harmonic 0 dropped if the scene keeps it, else kept; specials; transient: the rows' results}, read by response.js. A
 * curve that stops early is shown as far as it goes. HC_INTERRUPTED, HC_NO_MEMORY. */
hc_status curve_json(const scene *sc, const comparison *c, const hc_monitor *monitor, json_t **out, json_t **others);

#endif
