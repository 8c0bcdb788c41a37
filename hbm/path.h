/* path.h - a response curve under way, shared by continuation.c (which way, how far), adapt.c (with how many
 * harmonics) and path.c (its geometry). */
#ifndef HC_HBM_PATH_H
#define HC_HBM_PATH_H

#include "hbm/curve.h"
#include "hbm/solver.h"

typedef struct path {
  hbm_solver *s;
  hbm_curve *curve;
  double from, to, direction; /* direction: sign of to - from */
  double resolution; /* [rad/time] width of the narrowest feature in omega: the linear resonance's half width C/2M */
  double h;
  int sign;                       /* of det of the trial's Jacobian */
  bool fresh;                     /* the equations changed at the last point: extrapolate by its tangent alone */
  int left;                       /* index of the first point outside the sweep behind its start, 0 while inside */
  int easy;                       /* points in a row where fewer harmonics would do */
  int sense;                      /* sign of det [dR/dX dR/domega; tangent], kept along the curve */
  bool from_afar;                 /* a first point may be looked for from high omega */
  int turned;                     /* the number of points when corners were last tried */
  bool more_samples;              /* found wanting: start again with twice as many */
  bool natural;                   /* how the next step is corrected */
  int flat_steps;                 /* accepted in a row on flat curve while in arc-length mode */
  double *X, *dX, omega, d_omega; /* prediction, then trial point and its tangent */
  double *P, omega_p;             /* the prediction as it was */
  double *chord;                  /* from the last point to the trial */
  double *normal;                 /* [n+1] */
  hbm_point point;
} path;

/* Inner product of two directions (aX, a_omega), (bX, b_omega); x_scale measures the harmonics. */
double path_metric(const path *p, double x_scale, const double *aX, double a_omega, const double *bX, double b_omega);

/* Norm of the last point's harmonics, 1 if it is 0. */
double path_size(const path *p);

/* Distance the corrector moved the prediction, with omega measured by omega_unit. */
double path_correction(const path *p, double omega_unit);

/* Is the trial point as far from the last one as its own tangent says, within h? Past a corner the old tangent
 * predicts nothing, however short the step; the new one, looking back, does. */
bool path_agrees_backwards(const path *p, double h);

/* Share of omega in the unit tangent. */
double path_flatness(const path *p);

/* Newton from (X, omega) in the plane across (dX, d_omega); the tangent there into dX, d_omega. */
hc_status path_correct_in_plane(path *p);

/* As many harmonics as the last point needs, estimated there; HC_OK once hbm.accuracy is met or no finer equations
 * are to be had, or with more_samples set when the curve must start again. */
hc_status path_adapt(path *p);

/* The curve's rows cut to the harmonics it needed, and the solver set to them: what follows (--at, peaks) can have
 * no fewer. */
hc_status path_compact(hbm_solver *s, hbm_curve *c);

#endif
