/* response_curve.h - the points of a response curve, with the tangent at each. Lengths along the curve are in its
 * metric: |dz|^2 = |dX|^2 + domega^2/omega_scale^2, |dX| the largest relative change of a contact (metric.h). */
#pragma once

#include <stddef.h>

#include "hbm/solver/hbm_solver.h"
#include "hbm/solver/metric.h"

typedef struct hbm_curve { /* made empty with {0}, freed by hbm_curve_free */
  int n, cap, n_coef;      /* points; room; entries of a row of X: hbm_n_coefficients */
  hbm_point *points;       /* [n] */
  double *X, *dX;          /* [n][n_coef] [length]; dX: tangent, same parameter as d_omega */
  metric *metric;          /* an owner of it; NULL while the curve is empty */
  double omega_scale;      /* [rad/time] what omega is measured by along the curve */
  hc_status end;      /* HC_OK: the sweep was covered, or left_at_start; else why the curve stops at its last point */
  bool left_at_start; /* ended because the branch turned back past the start of the sweep */
  bool arclength;     /* arc-length continuation was needed */
  bool asked;         /* solutions at given omegas (hbm_curve_at), not the points that a curve happens to have */
  bool inaccurate;    /* auto: somewhere not even the most harmonics or samples met hbm.accuracy */
  int linear;         /* points taken from the linear closed form */
  int turning_points; /* passed by the whole curve */
  int edges;          /* joins of rest and slip that were stepped over: what lies on them may be missing (README.md) */
  double edge_omega, edge_motion; /* [1] the longest such step, of omega and in the metric */
  int rejected;                   /* continuation steps that were tried and not accepted */
  long iterations, evaluations;   /* Newton iterations and contact force evaluations, rejected steps included */
} hbm_curve;

/* One more point, X[n_coef] and dX[n_coef] copied; n_coef is that of the curve's other points. HC_NO_MEMORY leaves the
 * curve as it was. */
hc_status hbm_curve_append(hbm_curve *curve, int n_coef, const double *X, const double *dX, const hbm_point *point);

/* Lengths along the curve are those of m and omega_scale from now on. */
void hbm_curve_measure_by(hbm_curve *curve, metric *m, double omega_scale);

void hbm_curve_free(hbm_curve *curve);

/* The metric at point k. */
static inline metric_at hbm_curve_metric(const hbm_curve *c, int k)
{
  return (metric_at){c->metric, c->n_coef, c->X + (size_t)k * c->n_coef, NULL};
}

/* [n_coef] of point k. */
static inline double *hbm_curve_X(const hbm_curve *c, int k) { return c->X + (size_t)k * c->n_coef; }
static inline double *hbm_curve_dX(const hbm_curve *c, int k) { return c->dX + (size_t)k * c->n_coef; }
