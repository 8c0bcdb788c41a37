/* response_curve.h - the points of a response curve, with the tangent at each. Lengths along the curve are in its
 * metric: |dz|^2 = |dX|^2 + domega^2/omega_scale^2, |dX| the largest relative change of a contact (metric.h). */
#pragma once

#include <stddef.h>

#include "hbm/solver/hbm_solver.h"
#include "hbm/solver/metric.h"

/* Where a part of a curve began: at the sweep's first omega, at its last one, or at a branch point of a symmetric
 * part. */
typedef enum hbm_part_start { HBM_PART_FROM_FIRST, HBM_PART_FROM_LAST, HBM_PART_FROM_BRANCH } hbm_part_start;

/* Points that are connected, in their order along the curve. */
typedef struct hbm_curve_part {
  int first, n; /* points */
  hbm_part_start start;
  hc_status end;      /* HC_OK: it left the sweep, or closed, or came to a part that was known; else why it stops */
  bool left_at_start; /* turned back past where it began */
  bool closed;        /* came back to its first point */
  bool met;           /* came to another part */
  double ends_at;     /* [rad/time] of its last point */
} hbm_curve_part;
/* Whoever wants points as soon as they are found. added(): points from..to-1 of *curve, which follow those of the last
 * call, stay as they are. The solver may be asked about them, but not trace; a failure ends the curve with it. */
struct hbm_curve;
typedef struct hbm_curve_watch {
  hc_status (*added)(void *self, const struct hbm_curve *curve, int from, int to); /* NULL: nobody does */
  void *self;
} hbm_curve_watch;

typedef struct hbm_curve { /* made empty with {0}, freed by hbm_curve_free */
  int n, cap, n_coef;      /* points; room; entries of a row of X: hbm_n_coefficients */
  hbm_point *points;       /* [n] */
  double *X, *dX;          /* [n][n_coef] [length]; dX: tangent, same parameter as d_omega */
  metric *metric;          /* an owner of it; NULL while the curve is empty */
  double omega_scale;      /* [rad/time] what omega is measured by along the curve */
  hbm_curve_watch watch;   /* set in an empty curve */
  int settled;             /* points, from the first one on, that stay as they are */
  int n_parts;             /* 0 of a curve that is one part, as hbm_trace makes it */
  hbm_curve_part *parts;   /* [n_parts] of hbm_trace_all */
  hc_status end;           /* HC_OK: the sweep was covered, or left_at_start; else why the first part stops */
  double ends_at;          /* [rad/time] of the first part's last point */
  bool left_at_start;      /* ended because the branch turned back past the start of the sweep */
  bool closed, met;        /* ended because it came back to its first point; because it came to another part .. */
  int met_segment;         /* .. on this segment of the known curve */
  bool arclength;          /* arc-length continuation was needed */
  bool asked;              /* solutions at given omegas (hbm_curve_at), not the points that a curve happens to have */
  bool inaccurate;         /* auto: somewhere not even the most harmonics or samples met hbm.accuracy */
  int linear;              /* points taken from the linear closed form */
  int turning_points;      /* passed by the whole curve */
  int edges; /* joins of rest and slip that were stepped over: what lies on them may be missing (README.md) */
  double edge_omega, edge_motion; /* [1] the longest such step, of omega and in the metric */
  int rejected;                   /* continuation steps that were tried and not accepted */
  long iterations, evaluations;   /* Newton iterations and contact force evaluations, rejected steps included */
} hbm_curve;

/* One more point, X[n_coef] and dX[n_coef] copied; n_coef is that of the curve's other points. HC_NO_MEMORY leaves the
 * curve as it was. */
hc_status hbm_curve_append(hbm_curve *curve, int n_coef, const double *X, const double *dX, const hbm_point *point);

/* The first `settled` points stay as they are from now on: watch.added is called with the new ones among them, and its
 * status returned. */
hc_status hbm_curve_settle(hbm_curve *curve, int settled);

/* Lengths along the curve are those of m and omega_scale from now on. */
void hbm_curve_measure_by(hbm_curve *curve, metric *m, double omega_scale);

void hbm_curve_free(hbm_curve *curve);

/* Are points k and k + 1 neighbours on one part: is there a segment between them? */
static inline bool hbm_curve_has_segment(const hbm_curve *c, int k)
{
  return k + 1 < c->n && c->points[k].part == c->points[k + 1].part;
}

/* `part` becomes one more part of *curve, both measured alike: its points behind the others, its branches counted on
 * from theirs. Rows get the longer of the two's lengths. HC_NO_MEMORY leaves *curve as it was. */
hc_status hbm_curve_add_part(hbm_curve *curve, const hbm_curve *part, hbm_part_start start);

/* The metric at point k. */
static inline metric_at hbm_curve_metric(const hbm_curve *c, int k)
{
  return (metric_at){c->metric, c->n_coef, c->X + (size_t)k * c->n_coef, NULL};
}

/* [n_coef] of point k. */
static inline double *hbm_curve_X(const hbm_curve *c, int k) { return c->X + (size_t)k * c->n_coef; }
static inline double *hbm_curve_dX(const hbm_curve *c, int k) { return c->dX + (size_t)k * c->n_coef; }
