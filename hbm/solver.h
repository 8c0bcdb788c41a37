/* solver.h - inside of hbm_solver, for the files of this folder: the equations, and KINSOL for both of their forms.
 *
 *     fixed:   R(X, omega) = 0 at given omega                                              n unknowns
 *     plane:   R(X, omega) = 0 and  normal . D (z - anchor) = 0,   z = (X, omega)          n + 1 unknowns  (paper
 *              eq. 15-16)
 *
 * Everything the continuation measures lengths with is the metric D: 1/x_scale^2 on the harmonics, 1/omega_scale^2
 * on omega. */
#ifndef HC_HBM_SOLVER_H
#define HC_HBM_SOLVER_H

#include "hbm/hbm.h"
#include "hbm/refine.h"
#include "hbm/system.h"
#include "numerics/newton.h"

struct hbm_solver {
  model *model; /* a copy: the caller may drop theirs */
  hbm_settings how;
  hbm_system sys;
  double step_scale; /* of hbm_scale_steps */
  int n_time;        /* samples per period, for sampled forces */
  newton *fixed, *plane;
  exact_force *pattern; /* transitions of a solution of sampled equations; NULL when the equations are exact_force */
  stability *stability;
  double omega;                                /* of the fixed form */
  refinement *finer_harmonics, *finer_samples; /* what auto measures itself by; NULL where the settings say a number */
  double *Z;                                   /* [n_coef]  X with harmonic 0, for the callbacks */
  double *z;                                   /* [n+1]     unknowns of a solve */
  double *z_scale, *r_scale;                   /* [n+1]     weights for KINSOL */
  double *normal, *anchor;                     /* [n+1]     of the plane form, metric weights included in normal */
};

/* Other numbers of harmonics and samples from here on. The solver is unusable, but may be freed, unless HC_OK. */
hc_status hbm_solver_resize(hbm_solver *s, int n_harm, int n_time);

/* z[n+1] <-> X[n_coef] and omega. */
void hbm_pack(const hbm_solver *s, const double *X, double omega, double *z);
void hbm_unpack(const hbm_solver *s, const double *z, double *X, double *omega);

/* Solve the fixed form at omega from X; or the plane form from (X, *omega), which is also the anchor, with
 * `normal`[n+1] given. x_scale [length] is the size of X. */
hc_status hbm_solve_fixed(hbm_solver *s, double omega, double x_scale, double *X, hbm_point *point);
hc_status hbm_solve_plane(hbm_solver *s, const double *normal, double x_scale, double omega_scale, double *X,
                          double *omega, hbm_point *point);

/* dX/domega [n_coef] at the end of the last fixed solve; (dX, domega) along the curve, with normal . (dX, domega) =
 * 1, after a plane solve. */
hc_status hbm_tangent_fixed(hbm_solver *s, const double *X, double *dX);
hc_status hbm_tangent_plane(hbm_solver *s, double *dX, double *d_omega);

/* The curve's direction if it passed through (X, omega): the kernel of the equations there, with normal . (dX,
 * domega) = 1. sign: of the determinant of the plane form. X need not be a solution. */
hc_status hbm_kernel_at(hbm_solver *s, const double *normal, const double *X, double omega, double *dX, double *d_omega,
                        int *sign);

/* The exact evaluator, evaluated at X, and what it found. */
hc_status hbm_pattern_at(hbm_solver *s, const double *X, const exact_force **e, contact_report *report);

/* Euclidean norm of v[n]. */
double hbm_norm(int n, const double *v);

#endif
