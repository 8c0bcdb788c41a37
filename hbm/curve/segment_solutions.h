/* segment_solutions.h - solutions between two neighbouring points of a response curve, solved for from the
 * interpolant (segment.h) as guess. Segment k lies between the points k and k + 1. */
#ifndef HC_HBM_SEGMENT_SOLUTIONS_H
#define HC_HBM_SEGMENT_SOLUTIONS_H

#include "hbm/curve/response_curve.h"

/* Every solution at omega on segment k, appended to *out; include_end: point k + 1 itself counts too. Where Newton does
 * not converge next to the interpolant, the segment is halved at a point of its own and both halves are searched.
 * HC_NOT_CONVERGED after 40 halvings, HC_NO_MEMORY, errors of hbm_segment_point: *out has the solutions of the halves
 * before the one that failed. */
hc_status hbm_segment_solutions(hbm_solver *s, const hbm_curve *curve, int k, double omega, bool include_end,
                                hbm_curve *out);

/* A solution between points: its harmonics, its tangent, and the guess it was solved from. */
typedef struct hbm_candidate {
  double *X, *dX; /* [n_coef] */
  double *guess;  /* [n_coef + 1] or, for a solve in a plane, the plane's normal */
  hbm_point point;
} hbm_candidate;
hc_status hbm_candidate_new(int n_coef, hbm_candidate *out); /* one block: free(out->X) */

/* The point of the curve in the plane across the interpolant at sigma on segment k, with its tangent. Errors of
 * hbm_solve_plane and hbm_tangent_plane. */
hc_status hbm_segment_point(hbm_solver *s, const hbm_curve *curve, int k, double sigma, hbm_candidate *x);

#endif
