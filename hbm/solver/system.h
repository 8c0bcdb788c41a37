/* system.h - the harmonic-balance equations of a model, and their derivatives.
 *
 *     R(X, omega) = S(omega) X + F(X) - phi p(omega) = 0
 *     S_h = [  Re S   Im S ]      on (a_h, b_h),   Re S_0 on the mean;      S, p: condensation.h
 *           [ -Im S   Re S ]
 *
 * X: the coordinates' harmonics, ordered by coefficient, then by coordinate (contact_forces.h); of an oscillator S_h =
 * K - M h^2 omega^2 + i h omega C and X is that of x. F: contact force harmonics. phi = 1, and D = 0 in S, but on a
 * ramp (ramp.h). Without harmonic 0 (the paper's mode) the means are 0 and their rows are dropped. Vectors have
 * dim (2H+1) entries, the means included; the unknowns are the n entries from X[first] on. */
#pragma once

#include "hbm/forces/contact_forces.h"
#include "hbm/solver/metric.h"
#include "model/modes.h"
#include "numerics/base/workspace.h"
#include "numerics/series.h"

typedef struct hbm_system {
  const model *model; /* the solver's */
  hbm_settings how;   /* a copy */
  int n_harm, dim;    /* harmonics; coordinates */
  int n_coef;         /* dim (2 n_harm + 1) */
  int first, n;       /* first unknown in X (0, or dim without harmonic 0); number of unknowns */
  double force_factor /* phi */, more_damping /* D [force time/length] */;
  condensation *linear;
  metric *metric; /* shared with whoever else measures this model's solutions */
  contact_forces *contacts;
  model_scales scales;
  double *X, *F; /* [n_coef] the last evaluation: where, and the contact force */
  contact_report report;
  double omega;            /* [rad/time] of the last residual, where forces depend on it */
  bool evaluated, derived; /* X, F and report belong together; and the contacts' Jacobian with them */
  double *rows;            /* [n_coef] residual or its derivative with the means' rows, which may have to be dropped */
  double complex *amplitudes; /* [2][dim] */
  double *all, *moved;        /* [dim] of hbm_system_weights */
  long evaluations;           /* of the contact force */
  bool *stuck;                /* [n_contacts] of linear_solution.c, and all that follows: */
  double *stiffness;          /* [dim][dim] K' */
  double complex *A, *z;      /* [dim][dim] factored; [dim] */
  int *pivot;                 /* [dim] */
  workspace memory;           /* of all of its arrays */
} hbm_system;

/* Entries of X with n_harm harmonics. */
static inline int hbm_system_length(const hbm_system *sys, int n_harm) { return sys->dim * series_length(n_harm); }

/* n_time: samples per period, for sampled forces only. HC_BAD_INPUT (a load above harmonic n_harm, too); HC_NO_MEMORY;
 * HC_SINGULAR, HC_NOT_CONVERGED of model_find_scales and condensation_new: *sys still has to be cleared. shared: the
 * metric of m's solutions, if there is one; NULL: it is made. */
hc_status hbm_system_init(hbm_system *sys, const model *m, const hbm_settings *how, int n_harm, int n_time,
                          metric *shared);
void hbm_system_clear(hbm_system *sys);

/* The frequency of evaluations to come. */
void hbm_system_at(hbm_system *sys, double omega);

/* Contact force at X into sys->F, where `derive` with what hbm_system_jacobian takes; nothing to do if X is where it
 * was evaluated last. Errors of contact_forces_eval. */
hc_status hbm_system_contact(hbm_system *sys, const double *X, bool derive);

/* The first response's series x[2 n_harm + 1] of the motion X. */
void hbm_system_response(const hbm_system *sys, int n_harm, const double *X, double *x);

/* Series x[2 n_harm + 1] of response r of the model, of the motion X[n_coef] at omega; without harmonic 0 its mean is
 * 0. Errors of condensation_at. */
hc_status hbm_system_any_response(hbm_system *sys, double omega, const double *X, int r, double *x);

/* R[n] at X[n_coef]. HC_NOT_FINITE rather than a NaN, and where condensation_at says so. */
hc_status hbm_system_residual(hbm_system *sys, double omega, const double *X, double *R);

/* dR/dX into jac[row + ld col], n x n, at the X of the last residual. */
void hbm_system_jacobian(hbm_system *sys, double omega, int ld, double *jac);

/* rows[n] = S X at X and the omega of the last residual; turned: i S X, each amplitude a - i b times i, the means 0. */
void hbm_system_linear(hbm_system *sys, const double *X, bool turned, double *rows);

/* dR/domega [n] at X and the omega of the last residual; dR/dD; dR/dphi. */
void hbm_system_domega(hbm_system *sys, double omega, const double *X, double *dR);
void hbm_system_ddamping(hbm_system *sys, double omega, const double *X, double *dR);
void hbm_system_dforce(hbm_system *sys, double omega, double *dR); /* by phi */

/* all[dim], moved[dim] [force], at the X of the last residual: the forces on each coordinate, added up by size over all
 * harmonics; and of these what moves the structure from its rest under static loads (of the means only what is not the
 * same at rest). The size of their sum would be too small: near resonance K X and M omega^2 X cancel. NaN where
 * condensation_at fails. */
void hbm_system_sizes(const hbm_system *sys, double omega, double *all, double *moved);

/* Are the means of the last evaluation known to two digits, as far as rounding goes? Not where a load pushes along a
 * motion that K holds by its own rounding alone: the residual is small beside K X, and the mean is anything. */
bool hbm_system_knows_means(const hbm_system *sys);

/* weight[n]: 1 over what each row of a residual is compared with [1/force]: `moved` of its own coordinate, so that no
 * part of a structure is solved less well for another part's larger forces, nor the vibration for its static load; but
 * no less than `least` of the sum of `all`, whose rounding is left. 1 where there is no force at all; NaN where
 * condensation_at fails. */
void hbm_system_weights(hbm_system *sys, double omega, double least, double *weight);
