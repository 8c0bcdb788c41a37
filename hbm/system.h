/* system.h - the harmonic-balance equations of a model, and their derivatives.
 *
 *     R(X, omega) = Z(omega) X + F(X) - phi F0 e_1 = 0
 *     Z_h = [ K - M h^2 omega^2    (C + D) h omega   ]      on (a_h, b_h);   Z_0 = K
 *           [ - (C + D) h omega   K - M h^2 omega^2  ]
 *
 * F: contact force harmonics. phi = 1 and D = 0 but on a ramp (ramp.h). Without harmonic 0 (the paper's
 * mode) X[0] = 0 and row 0 is dropped. The mistakes of hbm_settings.h: harmonic 0 of F is multiplied, or the rows of
 * even harmonics become (K + M omega^2) X = 0. Vectors have 2H+1 entries, X[0] included; the unknowns are the n entries
 * from X[first] on. */
#ifndef HC_SYSTEM_H
#define HC_SYSTEM_H

#include "hbm/aft.h"
#include "hbm/exact_force.h"

typedef struct hbm_system {
  const model *model; /* the solver's */
  hbm_settings how;   /* a copy */
  int n_harm, n_coef; /* harmonics; 2 n_harm + 1 */
  int first, n;       /* first unknown in X (0, or 1 without harmonic 0); number of unknowns */
  double force_factor /* phi */, more_damping /* D [force time/length] */;
  aft *sampled; /* the one of these two that hbm.force asks for; the other is NULL */
  exact_force *located;
  double *X, *F, *dF; /* the last evaluation: where, force [n_coef], Jacobian [n_coef][n_coef] by columns */
  contact_report report;
  bool evaluated;      /* X, F and report belong together */
  bool differentiated; /* and so does dF: of sampled forces it is made when it is asked for first */
  double *rows;        /* [n_coef] residual or its derivative with row 0, which may have to be dropped */
  long evaluations;    /* of the contact force */
} hbm_system;

/* n_time: samples per period, for sampled forces only. HC_BAD_INPUT, HC_NO_MEMORY: *sys
 * still has to be cleared. */
hc_status hbm_system_init(hbm_system *sys, const model *m, const hbm_settings *how, int n_harm, int n_time);
void hbm_system_clear(hbm_system *sys);

/* Contact force at X into sys->F; nothing to do if X is where it was evaluated last. Errors of aft_eval and
 * exact_force_eval. */
hc_status hbm_system_contact(hbm_system *sys, const double *X);

/* R[n] at X[n_coef]. HC_NOT_FINITE rather than a NaN. */
hc_status hbm_system_residual(hbm_system *sys, double omega, const double *X, double *R);

/* dR/dX into jac[row + ld col], n x n, at the X of the last residual. */
void hbm_system_jacobian(hbm_system *sys, double omega, int ld, double *jac);

/* dR/domega [n] at X. */
void hbm_system_domega(hbm_system *sys, double omega, const double *X, double *dR);

/* What a residual is compared with [force]: the sum of the sizes of the forces it is made of, at the X of the last
 * residual. The size of their sum would be too small: near resonance K X and M omega^2 X cancel. */
double hbm_system_scale(const hbm_system *sys, double omega);

#endif
