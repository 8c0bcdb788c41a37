/* corrector.h - the equations solved by Newton (KINSOL) in two forms:
 *
 *     fixed   R(X, omega) = 0 at a given omega                                                    n unknowns
 *     plane   R(X, omega) = 0 and normal . (z - anchor) = 0,  z = (X, omega)    (paper eq. 15-16) n + 1 unknowns
 *
 * The paper is [1] in README.md. normal = D t for a tangent t, where D is the metric of the curve: metric.h's on the
 * harmonics, 1/omega_scale^2 on omega. X has n_coef entries, the unknowns are its last n (system.h). While a ramp is
 * followed the place on it stands for omega in all of these. */
#pragma once

#include "hbm/solver/hbm_solver.h"

/* Makes s->fixed and s->plane. HC_NO_MEMORY. */
hc_status hbm_corrector_new(hbm_solver *s);

/* Solve the fixed form at omega from X; or the plane form from (X, *omega), which is also the anchor, with
 * `normal`[n+1] given. X and *omega are the solution on HC_OK, untouched
 * otherwise. Errors of newton_solve and of the contact force. */
hc_status hbm_solve_fixed(hbm_solver *s, double omega, double *X, hbm_point *point);
hc_status hbm_solve_plane(hbm_solver *s, const double *normal, double omega_scale, double *X, double *omega,
                          hbm_point *point);

/* The fixed form without a line search, which takes many times as long where it fails, too. */
hc_status hbm_solve_plainly(hbm_solver *s, double omega, double *X, hbm_point *point);

/* The plane form by plain Newton: at most hbm.iterations of them, no line search. Errors of hbm_solve_plane. */
hc_status hbm_solve_plane_plainly(hbm_solver *s, const double *normal, double omega_scale, double *X, double *omega,
                                  hbm_point *point);

/* dX/domega [n_coef] at X, the end of the last fixed solve; (dX, d_omega) along the curve, normal . (dX, d_omega) = 1,
 * at the end of the last plane solve. HC_SINGULAR. */
hc_status hbm_tangent_fixed(hbm_solver *s, const double *X, double *dX);
hc_status hbm_tangent_plane(hbm_solver *s, double *dX, double *d_omega);

/* The direction of the curve if it passed through (X, omega): the kernel of [dR/dX dR/domega] there, with normal .
 * (dX, d_omega) = 1. *det_sign: that of the plane form's Jacobian. X need not be a solution. HC_SINGULAR. */
hc_status hbm_kernel_at(hbm_solver *s, const double *normal, const double *X, double omega, double *dX, double *d_omega,
                        int *det_sign);

/* A symmetric solution X of a symmetric model has no entries of dR/dX between even harmonics (the mean among them) and
 * odd ones. Sign of the determinant of the even ones' block: it changes where the symmetry breaks (a branch point), and
 * the rest's where the symmetric branch turns. 0 where it is singular or cannot be evaluated. */
int hbm_even_sign(hbm_solver *s, double omega, const double *X);

/* True if the even harmonics of X and Y[n_coef], solutions of a symmetric model, point in opposite directions in the
 * metric: the symmetric motions lie between the two. */
bool hbm_on_either_side(const hbm_solver *s, int n_coef, const double *X, const double *Y);

/* phi[n_coef], even harmonics alone, of length 1 in the metric at X: nearest to the kernel of that block, by which the
 * other branch leaves a branch point. HC_SINGULAR, or errors of the contact force. */
hc_status hbm_even_kernel(hbm_solver *s, double omega, const double *X, double *phi);

/* [1] The largest row of R(X, omega), relative to the forces that make it up. Errors of the contact force. */
hc_status hbm_residual_at(hbm_solver *s, double omega, const double *X, double *residual);

/* Sign of det dR/dX at (X, omega) in *det_sign, 0 if it is singular. HC_SINGULAR, or errors of the contact force. */
hc_status hbm_det_sign_at(hbm_solver *s, double omega, const double *X, int *det_sign);
