/* structure.h - what the page shows of a structure alone, as JSON: how all of it moves, and what each contact does. */
#ifndef HC_REPORT_STRUCTURE_H
#define HC_REPORT_STRUCTURE_H

#include <jansson.h>

#include "casefile/scene.h"
#include "compare/comparison.h"

/* JSON null for one degree of freedom, else, read by structure.js,
 *     {names: of the responses; responses: `others` of report.c; dofs, contacts: names;
 *      solutions: [{omega, branch, stable (1, 0, -1), amplitude, cosine, sine: [n] of harmonic 1;
 *                   loops: [{of: "T over u", "N over v" or "T_2 over T_1", x, y, work}] of the contacts}]}
 * of the HBM solutions at the comparison's frequencies, some of them where there are many. Loops are of the exact law
 * along the solution. HC_INTERRUPTED, HC_NO_MEMORY, or why there is no model. */
hc_status structure_json(const scene *sc, const comparison *c, json_t *others, const hc_monitor *monitor, json_t **out);

#endif
