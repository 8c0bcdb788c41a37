/* segment.h - segment k of a response curve, between its points k and k + 1: cubic Hermite interpolation from the
 * points and their tangents, and solutions found by Newton with the interpolant as guess. Lengths are in the curve's
 * metric (response_curve.h). */
#pragma once

#include "hbm/curve/response_curve.h"

/* Two neighbouring points z0, z1 and their tangents, scaled to dz/dsigma on sigma = 0..1. */
typedef struct hbm_segment {
  int n_coef;
  const double *X0, *X1, *dX0, *dX1; /* rows [n_coef] of the curve */
  double omega0, omega1;
  metric_at at;              /* the metric with both ends as reference */
  double omega_scale;        /* [rad/time] of the metric */
  double scale0, scale1;     /* dz/dsigma = scale * stored tangent */
  double d_omega0, d_omega1; /* domega/dsigma */
  double length;             /* arc length in the metric, from chord and angle */
} hbm_segment;

/* From point k to k + 1. It refers to the curve's rows: not valid after a point is appended. */
hbm_segment hbm_segment_between(const hbm_curve *curve, int k);

/* z and dz/dsigma at sigma, which may lie outside 0..1: extrapolation. dX and d_omega may be NULL. */
void hbm_segment_at(const hbm_segment *seg, double sigma, double *X, double *omega, double *dX, double *d_omega);

/* [rad/time] The largest (direction > 0) or least omega of the interpolant on sigma = 0..1. */
double hbm_segment_farthest(const hbm_segment *seg, double direction);

/* ---- solutions ---- */

/* Every solution at omega on segment k, appended to *out; include_end: point k + 1 itself counts too. Where Newton does
 * not converge next to the interpolant, a point of the curve halves the segment, and both halves are searched.
 * HC_NOT_CONVERGED after 40 halvings, HC_NO_MEMORY, errors of hbm_segment_point: *out has the solutions of the halves
 * before the one that failed. */
hc_status hbm_segment_solutions(hbm_solver *s, const hbm_curve *curve, int k, double omega, bool include_end,
                                hbm_curve *out);

/* A solution between points: its harmonics, its tangent, and the guess it was solved from. */
typedef struct hbm_candidate {
  double *X, *dX; /* [n_coef] */
  double *guess;  /* [n_coef + 1] that guess; after a solve in a plane, the plane's normal */
  hbm_point point;
} hbm_candidate;
hc_status hbm_candidate_new(int n_coef, hbm_candidate *out); /* one block: free(out->X) */

/* The point of the curve in the plane across the interpolant at sigma on segment k, with its tangent. Errors of
 * hbm_solve_plane and hbm_tangent_plane. */
hc_status hbm_segment_point(hbm_solver *s, const hbm_curve *curve, int k, double sigma, hbm_candidate *x);

/* ---- of the whole curve ---- */

/* *segment: the first of c's segments 0..segments - 1 that contains the given point of the curve `of`, which may be c;
 * negative: none. same_way: only segments on which omega has the same direction. Newton is run only where the
 * interpolant comes near. HC_NO_MEMORY. */
hc_status hbm_curve_passes(hbm_solver *s, const hbm_curve *c, int segments, const hbm_curve *of, int point,
                           bool same_way, int *segment);

/* Every solution of the curve at omega, appended to *at in the curve's order, each once; for a curve with parts also
 * the motion in which no contact changes state, where it exists, last and with its own branch. The status is HC_OK, or
 * that of the last segment on which a solution could not be found; solutions of the other segments are appended all the
 * same. Contacts with edges of slip (README.md): where a segment's search fails, Newton starts from its ends; where the
 * curve stopped before omega, one solution is found without it (hbm_first_solution). */
hc_status hbm_curve_at(hbm_solver *s, const hbm_curve *curve, double omega, hbm_curve *at);

/* (max - min)/2 of the first response of X. */
double hbm_amplitude_at(hbm_solver *s, const double *X);

/* The point of largest amplitude of the curve, refined between its points, appended to *peak. HC_BAD_INPUT for an
 * empty curve. */
hc_status hbm_curve_peak(hbm_solver *s, const hbm_curve *curve, hbm_curve *peak);

/* One more point at each summit of the first response's amplitude that lies between points: so the highest point of the
 * curve is its peak, to 1e-8 of the amplitude where it is smooth there, of many unknowns to 1e-5. Summits are searched
 * for beside point *top (0 at first) and each later one but the last `left` + 1; *top becomes the first point not
 * examined: all before it keep their places. HC_NO_MEMORY. */
hc_status hbm_curve_add_summits(hbm_solver *s, hbm_curve *curve, int left, int *top);

/* ---- a part of a segment that shrinks ---- */

/* For searches along a segment: each solution found becomes one of its ends, so that the interpolant between them gives
 * an ever better guess for the next. */
typedef struct hbm_narrowing {
  hbm_curve ends;  /* two points; zeroed before the first use, hbm_curve_free'd after the last */
  double from, to; /* sigma of the two ends on the original segment */
} hbm_narrowing;

/* All of segment k of c. HC_NO_MEMORY. */
hc_status hbm_narrowing_start(hbm_narrowing *p, const hbm_curve *c, int k);

/* The interpolant at sigma, counted on the original segment; dX, unless NULL, is its derivative by the place on the
 * shrunken part, 0..1. */
void hbm_narrowing_guess(const hbm_narrowing *p, double sigma, double *X, double *omega, double *dX);

/* The point of the curve there, as of hbm_segment_point, whose errors it has. */
hc_status hbm_narrowing_point(hbm_solver *s, const hbm_narrowing *p, double sigma, hbm_candidate *x);

/* x, at sigma, becomes the first end, or else the last. Does nothing if the part would become so short that rounding of
 * the ends spoils the interpolant. */
void hbm_narrowing_move(hbm_narrowing *p, bool first, double sigma, const hbm_candidate *x);
