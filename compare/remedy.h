/* remedy.h - what brings the row of a comparison that is farthest beyond the gate within it. Nothing is advised that
 * was not tried: the row's solution is solved with the changed settings, the transient is integrated again where they
 * change it, every quantity of every response is held to its limit, and the curve of the new settings goes there.
 *
 * Tried one by one, what acts on the largest part of the row's budget first: harmonic 0, exact forces, more harmonics
 * (of H those after which H + 1 and H + 2 pass, too), those of harmonic balance together; then what needs another
 * transient: the start on the HBM orbit, the exact law, a finer tolerance; all; at last all with fifty harmonics.
 * Proof: tests/command/advice.py. */
#pragma once

#include "compare/comparison_private.h"

/* Into text, "use hbm.harmonics >= 9", "use hbm.static: true and hbm.force: exact", or "nothing within ... passes"; ""
 * where the row is within the gate or has no budget. HC_NO_MEMORY, HC_INTERRUPTED. */
hc_status remedy_find(comparison_work *w, const comparison_row *row, char text[COMPARISON_ADVICE_TEXT]);
