/* condensation.h - reduction of a structure to the coordinates q on which its contacts act. Only q enters the nonlinear
 * forces, so only q is solved for, whatever n is; the rest is linear and follows from q.
 *
 *     x = P q + Y y        every contact's direction d has d . Y = 0, so u and v are combinations of q alone
 *     [ Z_qq  Z_qy ] [q]   [p_q]   [F]          Z = K - h^2 omega^2 M + i h omega (C + D Mu),   Mu = n M/trace M
 *     [ Z_yq  Z_yy ] [y] = [p_y] - [0]          (all of it P^T Z P, P^T Z Y, ...)
 *     S q + F = p,    S = Z_qq - Z_qy Z_yy^-1 Z_yq,    p = p_q - Z_qy Z_yy^-1 p_y,    y = Z_yy^-1 (p_y - Z_yq q)
 *
 * for each harmonic h, as complex amplitudes a - i b. q: displacements of the contacts, as many as are independent, and
 * the first response; q = x where they span all of x, as with one degree of freedom. y, the rest: its modes with q
 * fixed. For a large damped rest S is computed from a sum over the modes of the whole structure (compliance.h), at most
 * n dim^2 operations a harmonic; else from the formula above, with n dim^2 operations if C is diagonal in the rest's
 * modes, or an LU of Z_yy. Nothing is truncated. Source: Krack and Gross, Harmonic Balance for Nonlinear Vibration
 * Problems, Springer 2019, section 4.1; modes with q fixed: Craig and Bampton 1968. */
#pragma once

#include <complex.h>

#include "model/model.h"

typedef struct condensation condensation;

/* For m, which must live as long, and harmonics 0..n_harm. HC_NO_MEMORY; HC_SINGULAR: K has a rigid-body motion with q
 * fixed, or M is not positive definite. */
hc_status condensation_new(const model *m, int n_harm, condensation **out);
void condensation_free(condensation *c); /* NULL is allowed */

/* From now on C has this factor in Z of harmonic h, *by_omega being its derivative, in the place of i h omega. */
typedef double complex condensation_damping(int h, double omega, double complex *by_omega);
void condensation_damp(condensation *c, condensation_damping *damping);

/* Number of coordinates q. */
int condensation_dim(const condensation *c);

/* [dim] The directions of contact j in q: u = tangent . q, v = normal . q. */
const double *condensation_tangent(const condensation *c, int j);
const double *condensation_normal(const condensation *c, int j);

/* [dim] [force/length] Row sums of eps |P|^T |K| |P|: rounding error of the mean forces on q, for all mean q = 1. */
const double *condensation_rounding(const condensation *c);

/* q[dim] of a motion x[n]. */
void condensation_coordinates(const condensation *c, const double *x, double *q);

/* [dim] The first response as a row on q, which spans it by construction. */
const double *condensation_first_response(const condensation *c);

/* Prepares all functions below for this omega [rad/time] and for the additional damping D = more_damping.
 * HC_NOT_FINITE: the rest resonates undamped there. */
hc_status condensation_at(condensation *c, double omega, double more_damping);

/* S of harmonic h, [dim][dim] by columns, followed by those of the next harmonics. Sizes: for each entry of S the sum
 * of the absolute values of its terms; valid until the next call. */
const double complex *condensation_stiffness(const condensation *c, int h);
const double *condensation_sizes(condensation *c, int h);
bool condensation_is_by_modes(const condensation *c, int h); /* true: S comes from compliance.h; false: from Z_yy */

/* p [dim] of load number i of the model, cosine - i sine. */
const double complex *condensation_load(const condensation *c, int i);

/* dS a and dp of harmonic h and load i, a[dim], where Z changes by dZ = (alpha M + beta C): by omega, alpha = -2 h^2
 * omega + i h D n/trace M, beta = i h; by D, alpha = i h omega n/trace M, beta = 0. inertial: relative change of an
 * inertial load, 2/omega or 0. */
typedef struct condensation_change {
  double complex alpha, beta;
  double inertial;
} condensation_change;
condensation_change condensation_by_omega(const condensation *c, int h);
condensation_change condensation_by_damping(const condensation *c, int h);
void condensation_stiffness_change(condensation *c, int h, condensation_change by, const double complex *a,
                                   double complex *dS_a);
void condensation_load_change(condensation *c, int i, condensation_change by, double complex *dp);

/* Harmonic h of response r is row . q + rest, row[dim]; the loads' contribution, in rest, is multiplied by factor. */
void condensation_response(condensation *c, int h, int r, double factor, double complex *row, double complex *rest);

/* x[n]: harmonic h of the whole structure's motion from that of q[dim]; loads are multiplied by factor. HC_NOT_FINITE
 * as in condensation_at. */
hc_status condensation_motion(condensation *c, int h, const double complex *q, double factor, double complex *x);
