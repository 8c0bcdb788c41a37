/* narrowing.h - a part of a segment of a response curve, on which something is searched for. It shrinks: solutions
 * that are found become its ends, so that the interpolant between these says ever better where the next one is, and
 * Newton starts next to it. */
#ifndef HC_HBM_NARROWING_H
#define HC_HBM_NARROWING_H

#include "hbm/curve/segment_solutions.h"

typedef struct hbm_narrowing {
  hbm_curve ends;  /* two points; zeroed before the first use, hbm_curve_free'd after the last */
  double from, to; /* sigma of the segment where these are */
} hbm_narrowing;

/* All of segment k of c. HC_NO_MEMORY. */
hc_status hbm_narrowing_start(hbm_narrowing *p, const hbm_curve *c, int k);

/* The interpolant at sigma, which is the segment's. */
void hbm_narrowing_guess(const hbm_narrowing *p, double sigma, double *X, double *omega);

/* The point of the curve there, as of hbm_segment_point, whose errors it has. */
hc_status hbm_narrowing_point(hbm_solver *s, const hbm_narrowing *p, double sigma, hbm_candidate *x);

/* x, at sigma, becomes the end that comes first, or else the last. Nothing happens where the part would become so
 * short that the ends' rounding shows in the interpolant. */
void hbm_narrowing_move(hbm_narrowing *p, bool first, double sigma, const hbm_candidate *x);

#endif
