/* path.h - a response curve while it is followed: where the next point is predicted and corrected. continuation.c
 * decides which way and how far. Lengths are in the curve's metric
 * (response_curve.h) at the last point. */
#pragma once

#include "hbm/curve/response_curve.h"
#include "hbm/solver/hbm_solver_impl.h"

/* A solution that a curve begins with. */
typedef struct path_seed {
  const double *X;  /* [n_coef] */
  const double *dX; /* [n_coef] its tangent; NULL: that by omega, towards `to` */
  double d_omega;
  int orientation; /* of path, with dX */
} path_seed;

/* Where a curve begins, and where it ends. */
typedef struct path_course {
  double from, to; /* [rad/time] it begins at `from` towards the limit `to` of the sweep. On a ramp, here and below,
                      places on it stand for omega */
  double behind;   /* [rad/time] the sweep's other limit: `from`, where it begins there */
  bool may_come_from_above; /* a first solution may be looked for by following the curve down from high omega */
  const path_seed *seed;    /* NULL: hbm_first_solution at `from` */
  const hbm_curve *known;   /* ends where it comes to a part of this one; NULL: there is none */
} path_course;

typedef struct path {
  hbm_solver *s;
  hbm_curve *curve;
  const path_course *course;
  double from, to, direction; /* [rad/time] of the course; direction: sign of to - from */
  double resolution;          /* [rad/time] width of the narrowest feature in omega: the linear resonance's half width,
                                 C/2M */
  double step;                /* [1] arc length to the next prediction */
  bool natural;               /* correct at the predicted omega; else in the plane across the predicted tangent */
  bool tangent_only;          /* predict by the last tangent alone: the point before is on the far side of a corner, or
                                 solves other equations */
  bool kinked;                /* model_has_kinks */
  int orientation;            /* sign of det [dR/dX dR/domega; tangent]: changes only where a symmetry breaks */
  int first_outside;          /* index of the first point outside the sweep behind its start; 0 while inside */
  int droppable_points;       /* points in a row whose highest harmonics could be dropped; negative after dropping them
                                 failed, so that more points are waited for */
  bool more_samples;          /* start again with twice as many: these do not meet hbm.accuracy */
  int edges;                  /* joins of rest and slip that were passed, or where that was tried */
  int points_at_last_edge;    /* number of points when a step over a join of rest and slip last failed */
  double step_at_last_edge;   /* [1] its length */
  int points_at_last_corner;  /* number of points when a step round a corner last failed */
  int flat_steps;             /* accepted in a row on flat curve while correcting in planes */
  double *X, *dX, omega, d_omega;       /* prediction, then corrected point (the trial), and its tangent */
  double *X_predicted, omega_predicted; /* the prediction as it was */
  double *chord;                        /* [n_coef] from the last point to the trial */
  double *missed;                       /* [n_coef] by which a motion expected somewhere is not that found */
  double *normal;                       /* [n+1] of the plane (corrector.h) */
  int det_sign;                         /* of the trial's Jacobian */
  hbm_point point;                      /* of the trial */
} path;

/* The curve of a course, appended to an empty *curve, as of hbm_trace, whose statuses it has. */
hc_status path_trace(hbm_solver *s, const path_course *course, const hc_monitor *monitor, hbm_curve *curve);

/* Summits between points that stay become points themselves, and who watches the curve gets all of these, but for the
 * last `left` points. Errors of hbm_curve_add_summits, hbm_curve_settle. */
hc_status path_settle(hbm_solver *s, hbm_curve *curve, int left);

/* The metric of harmonics at the last point. */
metric_at path_metric(const path *p);

/* Inner product of two directions (aX, a_omega), (bX, b_omega), for angles; and the length of one: of a step, an
 * error. */
double path_inner(const path *p, const double *aX, double a_omega, const double *bX, double b_omega);
double path_length(const path *p, const double *aX, double a_omega);

/* Distance the corrector moved the prediction, with omega measured by omega_unit. */
double path_correction(const path *p, double omega_unit);

/* Does the trial's own tangent, followed back over the change of omega, lead to the last point within h? Past a corner
 * the last point's tangent predicts nothing, however short the step; the trial's does, looking back. */
bool path_agrees_backwards(const path *p, double h);

/* Share of omega in the trial's unit tangent: 1 where the curve is flat, 0 at a turning point. */
double path_flatness(const path *p);

/* Prediction by the arc length h into X, omega; its direction into dX, d_omega (unit length). Returns interpolation
 * error / prediction error. */
double path_predict(path *p, double h);

/* hbm_even_sign of the trial; 0 where it is not symmetric. */
int path_even_sign(path *p);

/* Turn the trial's tangent forward: the sign of its determinant becomes the curve's orientation. */
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

/* As many harmonics as the last point needs. HC_OK once the estimated error (refine.h) meets hbm.accuracy, or where no
 * finer equations are to be had (curve->inaccurate), or with p->more_samples set when the curve must start again.
 * Fewer harmonics again after several points in a row whose highest ones would not show. Does nothing where the
 * settings give both numbers. HC_NO_MEMORY, or why no point could be solved for with the finer equations. */
hc_status path_adapt(path *p);

/* The curve's rows cut to the harmonics it needed, and the solver set to them: what is solved on the curve later (an
 * omega between its points, the peak) must not have fewer. HC_NO_MEMORY. */
hc_status path_finish(hbm_solver *s, hbm_curve *c);
