/* curve.h - the points of a response curve, and the cubic Hermite interpolation between neighbours (tangents are
 * known at both ends). Lengths are in the curve's metric: |dz|^2 = |dX|^2/|X|^2 + domega^2/omega_scale^2. */
#ifndef HC_HBM_CURVE_H
#define HC_HBM_CURVE_H

#include <stddef.h>

#include "hbm/hbm.h"

/* One more point; HC_NO_MEMORY leaves the curve as it was. */
hc_status hbm_curve_append(hbm_curve *curve, int n_coef, const double *X, const double *dX, const hbm_point *point);

static inline double *hbm_curve_X(const hbm_curve *c, int k) { return c->X + (size_t)k * c->n_coef; }
static inline double *hbm_curve_dX(const hbm_curve *c, int k) { return c->dX + (size_t)k * c->n_coef; }

/* Zero what X[n_coef] has beyond the harmonics the solver keeps now. */
void hbm_trim(const hbm_solver *s, int n_coef, double *X);

/* Two neighbouring points z0, z1 and their tangents, scaled to dz/dsigma on sigma = 0..1. */
typedef struct hbm_segment {
  int n_coef;
  const double *X0, *X1, *dX0, *dX1;
  double omega0, omega1;
  double x_scale, omega_scale;
  double scale0, scale1;     /* dz/dsigma = scale * stored tangent */
  double d_omega0, d_omega1; /* already scaled */
  double length;             /* arc length in the metric, from chord and angle */
} hbm_segment;

hbm_segment hbm_segment_between(const hbm_curve *curve, int k); /* points k and k + 1 */

/* z and dz/dsigma at sigma, which may lie outside 0..1: extrapolation. dX and d_omega may be NULL. */
void hbm_segment_at(const hbm_segment *seg, double sigma, double *X, double *omega, double *dX, double *d_omega);

/* The sigma in [0, 1) where the interpolant passes omega, ascending; at most 3. last: the end 1 counts too. */
int hbm_segment_find(const hbm_segment *seg, double omega, bool last, double sigma[3]);

#endif
