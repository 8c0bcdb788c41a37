/* between.h - solutions between the points of a response curve: at a given omega, and where the amplitude is largest.
 * Each is solved for; interpolation only gives the guess. */
#ifndef HC_HBM_BETWEEN_H
#define HC_HBM_BETWEEN_H

#include "hbm/curve/response_curve.h"

/* Every solution of the curve at omega, appended to *at in the curve's order. The status is HC_OK, or that of the
 * last segment on which a solution could not be found; the other segments' solutions are there all the same. Where a
 * curve whose contacts have edges of slip stopped before omega: one solution, found without it; of their edges of
 * slip (README.md) those that Newton finds at omega from a segment's ends. */
hc_status hbm_curve_at(hbm_solver *s, const hbm_curve *curve, double omega, hbm_curve *at);

/* The point of largest amplitude of the curve, refined between its points, appended to *peak. HC_BAD_INPUT for an
 * empty curve. */
hc_status hbm_curve_peak(hbm_solver *s, const hbm_curve *curve, hbm_curve *peak);

#endif
