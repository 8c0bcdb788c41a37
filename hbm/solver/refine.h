/* refine.h - the error of a solution by truncation or sampling, estimated by one Newton step on finer equations. With
 * R' the residual of twice the harmonics (or samples), J' its Jacobian and X the solution padded with zeros, X - J'^-1
 * R'(X) is their solution to second order, so the length of J'^-1 R'(X) in the metric at X (metric.h) estimates the
 * relative error of X, low harmonics included. The difference of solutions for H and H + 1 is no estimate: convergence
 * in H is not monotone. */
#pragma once

#include "hbm/solver/system.h"

typedef struct refinement refinement;

/* The equations of another's model and metric with n_harm harmonics and n_time samples (for sampled forces). Errors of
 * hbm_system_init. */
hc_status refinement_new(const hbm_system *of, const hbm_settings *how, int n_harm, int n_time, refinement **out);
void refinement_free(refinement *r);

int refinement_harmonics(const refinement *r);

/* Y[dim (2 n' + 1)] := Y - J'^-1 R'(Y), n' = refinement_harmonics; *step [1] = its length in the metric. Errors of the
 * contact force, HC_SINGULAR, HC_NOT_FINITE: Y is as it was, *step INFINITY. */
hc_status refinement_step(refinement *r, double omega, double *Y, double *step);

/* x[2 n' + 1]: response r of the model, of Y at omega. Errors of hbm_response. */
hc_status refinement_response(refinement *r, double omega, const double *Y, int response, double *x);

/* *orbit: the contact forces of these equations, evaluated at Y. Errors of the contact force. */
hc_status refinement_orbit(refinement *r, const double *Y, const contact_forces **orbit);

/* [1] How far rounding may move what the last step came to: the length of J'^-1 s, where each s_i is one rounding of
 * the sum of all forces on its coordinate. INFINITY rather than a NaN. */
double refinement_rounding(refinement *r, double omega);

/* Relative error of the solution X[dim (2 n_harm + 1)], n_harm <= refinement_harmonics; INFINITY if the step fails. */
double refinement_error(refinement *r, double omega, int n_harm, const double *X);

/* Finer equations have as many harmonics at least: with fewer a short contact does not show in the error of H = 1. */
enum { REFINE_FEWEST_HARMONICS = 14 };

/* The ladder of truncation orders that auto climbs: the next above (up) or below, HBM_MAX_HARMONICS / 2 at most. */
enum { REFINE_MOST_HARMONICS = HBM_MAX_HARMONICS / 2, REFINE_MOST_SAMPLES = 1 << 20 };
int refine_next_harmonics(int n_harm, bool up);
