/* path.h - a response curve while it is followed: prediction and correction of the next point. Direction and step
 * length are decided in continuation.c. Lengths are in the curve's metric (response_curve.h) at the last point. */
#pragma once

#include "hbm/curve/response_curve.h"
#include "hbm/solver/hbm_solver_impl.h"

/* A solution that a curve begins with. */
typedef struct path_seed {
  const double *X;  /* [n_coef] */
  const double *dX; /* [n_coef] its tangent, as path.dX; NULL: the tangent dX/domega, towards `to` */
  double d_omega;
  int orientation; /* the path's first orientation; read only with dX */
} path_seed;

/* Where a curve begins, and where it ends. */
typedef struct path_course {
  double from, to; /* [rad/time] start; limit of the sweep ahead. On a ramp, here and below, its parameter, not omega */
  double behind;   /* [rad/time] the sweep's other limit; equal to `from` for a curve that begins on it */
  bool may_come_from_above; /* the first solution may be searched for by following a curve down from high omega */
  const path_seed *seed;    /* NULL: hbm_first_solution at `from` */
  const hbm_curve *known;   /* parts found before, at which this curve ends; NULL: none */
} path_course;

typedef struct path {
  hbm_solver *s;
  hbm_curve *curve;
  const path_course *course;
  double from, to, direction; /* [rad/time] those of the course; direction: sign of to - from */
  double resolution;          /* [rad/time] width of the narrowest feature in omega: the linear resonance's half width,
                                 C/2M */
  double step;                /* [1] arc length to the next prediction */
  bool natural;               /* correct at the predicted omega; else in the plane across the predicted tangent */
  bool tangent_only;    /* predict by the last tangent alone, since the point before is beyond a corner or solves other
                           equations */
  bool kinked;          /* model_has_kinks */
  int orientation;      /* sign of det [dR/dX dR/domega; tangent]: changes only where a symmetry breaks */
  int first_outside;    /* index of the first point outside the sweep behind its start; 0 while inside */
  int droppable_points; /* number of successive points whose highest harmonics could be dropped; set to a negative
                           number after dropping failed, to delay the next attempt */
  bool more_samples;    /* the curve must start again with twice the samples: hbm.accuracy is not met */
  int edges;            /* number of attempts to step over a join of rest and slip */
  int points_at_last_edge;        /* number of points when a step over a join of rest and slip last failed */
  double step_at_last_edge;       /* [1] length of that step */
  int points_at_last_corner;      /* number of points when a step round a corner last failed */
  int flat_steps;                 /* number of successive accepted steps on flat curve, corrected in planes */
  double *X, *dX, omega, d_omega; /* prediction with its direction; after correction the trial point with its tangent */
  double *X_predicted, omega_predicted; /* the prediction, kept to measure the correction */
  double *chord;                        /* [n_coef] from the last point to the trial */
  double *missed; /* [n_coef] work of path_agrees_backwards: trial less last point less trial's tangent over the step */
  double *normal; /* [n+1] normal of the plane in which Newton corrects (corrector.h) */
  int det_sign;   /* sign of det dR/dX of the trial, or of the bordered matrix where corrected in a plane */
  hbm_point point; /* the trial's record, as appended to the curve */
} path;

/* Follows a course; the points are appended to an empty *curve. Statuses as of hbm_trace. */
hc_status path_trace(hbm_solver *s, const path_course *course, const hc_monitor *monitor, hbm_curve *curve);

/* Declares all points but the last `left` final: summits between them become points (not with fixed steps), and
 * curve->watch is called with them. Errors of hbm_curve_add_summits, hbm_curve_settle. */
hc_status path_settle(hbm_solver *s, hbm_curve *curve, int left);

/* The metric of harmonics at the last point. */
metric_at path_metric(const path *p);

/* Inner product of two directions (aX, a_omega), (bX, b_omega), for angles; length of one direction, for steps and
 * errors. */
double path_inner(const path *p, const double *aX, double a_omega, const double *bX, double b_omega);
double path_length(const path *p, const double *aX, double a_omega);

/* Distance the corrector moved the prediction, with omega measured by omega_unit. */
double path_correction(const path *p, double omega_unit);

/* True if the trial's own tangent, followed back over the change of omega, passes the last point within h. Past a
 * corner the last point's tangent predicts nothing, however short the step; the trial's tangent is valid there. */
bool path_agrees_backwards(const path *p, double h);

/* Share of omega in the trial's unit tangent: 1 where the curve is flat, 0 at a turning point. */
double path_flatness(const path *p);

/* Prediction at the arc length h into X, omega; its direction into dX, d_omega (unit length). Returns the ratio of
 * interpolation error to prediction error. */
double path_predict(path *p, double h);

/* hbm_even_sign of the trial; 0 where it is not symmetric. */
int path_even_sign(path *p);

/* Turn the trial's tangent forward: with kinks by the sign of its determinant, which must be the curve's orientation,
 * else by its angle to the last tangent. */
void path_orient_tangent(path *p);

/* p->normal for the plane across (dX, d_omega). */
void path_fill_normal(path *p);

/* Newton from (X, omega) in the plane across (dX, d_omega); the tangent there into dX, d_omega. Errors of
 * hbm_solve_plane and hbm_tangent_plane. */
hc_status path_correct_in_plane(path *p);

/* One step of fixed length into the trial, predicted along the last tangent and corrected by plain Newton. HC_OK, and
 * accepted; HC_NOT_CONVERGED where hbm.iterations of Newton's were not enough, HC_JUMPED, or another error of
 * hbm_solve_plane and hbm_tangent_plane. */
hc_status path_fixed_step(path *p, bool *accepted);

/* Adapts the number of harmonics to the last point. HC_OK once the estimated error (refine.h) meets hbm.accuracy, or
 * where no finer equations are available (curve->inaccurate), or with p->more_samples set when the curve must start
 * again. Drops harmonics after several successive points whose highest ones are negligible. Does nothing where the
 * settings give both numbers. HC_NO_MEMORY, or why no point could be solved for with the finer equations. */
hc_status path_adapt(path *p);

/* Cuts the curve's rows to the largest number of harmonics among its points, and sets the solver to that number: later
 * solves on the curve (an omega between its points, the peak) must not have fewer. HC_NO_MEMORY. */
hc_status path_finish(hbm_solver *s, hbm_curve *c);
