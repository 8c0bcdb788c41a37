/* response_curve.h - the points of a response curve, with the tangent at each. Lengths along the curve are in its
 * metric: |dz|^2 = |dX|^2 + domega^2/omega_scale^2, |dX| the largest relative change of a contact (metric.h). */
#pragma once

#include <stddef.h>

#include "hbm/solver/hbm_solver.h"
#include "hbm/solver/metric.h"

/* Start of a part of a curve: the sweep's first omega, its last one, or a branch point of a symmetric part. */
typedef enum hbm_part_start { HBM_PART_FROM_FIRST, HBM_PART_FROM_LAST, HBM_PART_FROM_BRANCH } hbm_part_start;

/* A connected run of points, in their order along the curve. */
typedef struct hbm_curve_part {
  int first, n; /* its points first..first + n - 1 */
  hbm_part_start start;
  hc_status end;      /* HC_OK: it left the sweep, closed, or met a known part; else why it stops */
  bool left_at_start; /* it turned back and left the sweep past its start */
  bool closed;        /* it returned to its own points */
  bool met;           /* it reached another part */
  double ends_at;     /* [rad/time] of its last point */
} hbm_curve_part;
/* Callback for points as soon as they are final. added(): points from..to-1 of *curve, which follow those of the last
 * call, change no more. It may use the solver on them, but not trace; its failure ends the curve with that status. */
struct hbm_curve;
typedef struct hbm_curve_watch {
  hc_status (*added)(void *self, const struct hbm_curve *curve, int from, int to); /* NULL: none */
  void *self;
} hbm_curve_watch;

typedef struct hbm_curve { /* made empty with {0}, freed by hbm_curve_free */
  int n, cap, n_coef;      /* points; capacity; entries of a row of X: hbm_n_coefficients */
  hbm_point *points;       /* [n] */
  double *X, *dX;          /* [n][n_coef] [length]; dX: tangent, same parameter as d_omega */
  metric *metric;          /* metric of lengths along the curve, shared; NULL while the curve is empty */
  double omega_scale;      /* [rad/time] unit of omega in these lengths */
  hbm_curve_watch watch;   /* set in an empty curve */
  int settled;             /* number of final points, from the first one on */
  int n_parts;             /* 0 for a curve of hbm_trace, which is one part without a record */
  hbm_curve_part *parts;   /* [n_parts] records made by hbm_trace_all */
  hc_status end;           /* HC_OK: the sweep was covered, or left_at_start; else why the first part stops */
  double ends_at;          /* [rad/time] of the first part's last point */
  bool left_at_start;      /* ended because the branch turned back past the start of the sweep */
  bool closed, met;        /* ended because it returned to its own points; because it reached another part .. */
  int met_segment;         /* .. on this segment of the known curve */
  bool arclength;          /* arc-length continuation was needed */
  bool asked;              /* the points are solutions at given omegas (hbm_curve_at), not those of a traced curve */
  bool inaccurate;         /* adaptive only: at some point the largest number of harmonics or samples did not meet
                              hbm.accuracy */
  int linear;              /* points taken from the linear closed form */
  int turning_points;      /* number of turning points passed by the whole curve */
  int edges; /* number of joins of rest and slip that were stepped over: solutions next to them may be missing
                (README.md) */
  double edge_omega, edge_motion; /* [1] longest such step: relative change of omega; length in the metric */
  int rejected;                   /* number of continuation steps tried and not accepted */
  long iterations, evaluations;   /* Newton iterations and contact force evaluations, rejected steps included */
} hbm_curve;

/* One more point, X[n_coef] and dX[n_coef] copied; n_coef is that of the curve's other points. HC_NO_MEMORY, and HC_BUG
 * for another n_coef, leave the curve as it was. */
hc_status hbm_curve_append(hbm_curve *curve, int n_coef, const double *X, const double *dX, const hbm_point *point);

/* Declares the first `settled` points final: calls watch.added with the new ones among them, and returns its status. */
hc_status hbm_curve_settle(hbm_curve *curve, int settled);

/* Sets the metric (shared, not copied) and the unit of omega for lengths along the curve. */
void hbm_curve_measure_by(hbm_curve *curve, metric *m, double omega_scale);

void hbm_curve_free(hbm_curve *curve);

/* True if points k and k + 1 exist and belong to one part: segment k. */
static inline bool hbm_curve_has_segment(const hbm_curve *c, int k)
{
  return k + 1 < c->n && c->points[k].part == c->points[k + 1].part;
}

/* Appends `part`, of the same metric, as one more part: its points behind the others, its branch numbers continuing
 * theirs. Rows get the longer of the two lengths. HC_NO_MEMORY leaves *curve as it was. */
hc_status hbm_curve_add_part(hbm_curve *curve, const hbm_curve *part, hbm_part_start start);

/* The metric at point k. */
static inline metric_at hbm_curve_metric(const hbm_curve *c, int k)
{
  return (metric_at){c->metric, c->n_coef, c->X + (size_t)k * c->n_coef, NULL};
}

/* [n_coef] row of point k. */
static inline double *hbm_curve_X(const hbm_curve *c, int k) { return c->X + (size_t)k * c->n_coef; }
static inline double *hbm_curve_dX(const hbm_curve *c, int k) { return c->dX + (size_t)k * c->n_coef; }
