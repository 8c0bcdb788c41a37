/* between.h - solutions between the points of a response curve. */
#ifndef HC_HBM_BETWEEN_H
#define HC_HBM_BETWEEN_H

#include "hbm/hbm.h"

/* Every solution at omega on the stretch from point k to point k + 1, appended to *out; last: point k + 1 itself
 * counts too. Solved by Newton from the interpolant; where that does not land next to it, the stretch is halved by a
 * point of its own and both halves are tried. */
hc_status hbm_segment_solutions(hbm_solver *s, const hbm_curve *curve, int k, double omega, bool last, hbm_curve *out);

/* A point between points and room to find it: three rows of one block. */
typedef struct hbm_candidate {
  double *X, *dX, *guess;
  hbm_point point;
} hbm_candidate;
hc_status hbm_candidate_new(int n_coef, hbm_candidate *out); /* free(out->X) */

/* The point of the curve in the plane across the interpolant at sigma on segment k, with its tangent. */
hc_status hbm_segment_point(hbm_solver *s, const hbm_curve *curve, int k, double sigma, hbm_candidate *x);

#endif
