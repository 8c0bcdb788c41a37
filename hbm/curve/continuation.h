/* continuation.h - the response curve over a range of omega. Method: continuation.c. */
#pragma once

#include "hbm/curve/response_curve.h"

/* The response curve from omega `from` to `to`, appended to an empty *curve. What was found is kept whatever the
 * status, which is also in curve->end: HC_UNBOUNDED (growth.h), HC_STEP_TOO_SMALL, HC_TOO_MANY_POINTS, HC_INTERRUPTED,
 * HC_NO_MEMORY, or why the last step failed. curve->watch is called while it grows; where harmonics or samples are to
 * adapt, at its end. HC_BAD_INPUT, and nothing is changed, for a curve that is not empty, an omega not positive, or
 * steps that are fixed where harmonics or samples are to adapt. */
hc_status hbm_trace(hbm_solver *s, double from, double to, const hc_monitor *monitor, hbm_curve *curve);

/* As hbm_trace, then with continuation `auto` also the parts (response_curve.h) that begin at the sweep's other end or
 * where a symmetric part's symmetry breaks. curve->end and ends_at are the first part's; end becomes HC_OK if another
 * part, from the other side, reaches the place at which the first one stopped. */
hc_status hbm_trace_all(hbm_solver *s, double from, double to, const hc_monitor *monitor, hbm_curve *curve);

/* Continuation steps `scale` times as long as they would be, 0 < scale <= 1 (else 1): solutions must not depend on
 * the step length, and two traces of different scales show whether they do. */
void hbm_scale_steps(hbm_solver *s, double scale);
