/* segment.h - cubic Hermite interpolation of a response curve between two neighbouring points, from the points and
 * their tangents. Lengths are in the curve's metric (response_curve.h). */
#ifndef HC_HBM_SEGMENT_H
#define HC_HBM_SEGMENT_H

#include "hbm/curve/response_curve.h"

/* Two neighbouring points z0, z1 and their tangents, scaled to dz/dsigma on sigma = 0..1. */
typedef struct hbm_segment {
  int n_coef;
  const double *X0, *X1, *dX0, *dX1; /* of the curve: rows of n_coef */
  double omega0, omega1;
  double x_scale, omega_scale; /* of the metric; x_scale: |X| of the larger end, 1 if both are 0 */
  double scale0, scale1;       /* dz/dsigma = scale * stored tangent */
  double d_omega0, d_omega1;   /* domega/dsigma */
  double length;               /* arc length in the metric, from chord and angle */
} hbm_segment;

/* From point k to k + 1. It refers to the curve's rows: not valid after a point is appended. */
hbm_segment hbm_segment_between(const hbm_curve *curve, int k);

/* z and dz/dsigma at sigma, which may lie outside 0..1: extrapolation. dX and d_omega may be NULL. */
void hbm_segment_at(const hbm_segment *seg, double sigma, double *X, double *omega, double *dX, double *d_omega);

/* The sigma in [0, 1) where the interpolant passes omega, ascending; at most 3. include_end: sigma = 1 counts too. */
int hbm_segment_find(const hbm_segment *seg, double omega, bool include_end, double sigma[3]);

#endif
