/* motion_series.h - the motion of a structure in an interval, as a power series in time, to rounding.
 *
 *     X'' + by_C C X' + by_K K X = p(theta) - sum_j [ t_j T_j + n_j (N_j - N0_j) ],  T_j, N_j linear (contact_track.h)
 *     X(theta0 + tau) = sum_k x_k tau^k:      (k + 1)(k + 2) x_{k+2} = the k-th coefficients of all the others
 * The equation is linear with constant coefficients, so the series converges for every tau; TRACK_ORDER terms are exact
 * to rounding up to a tau of about 2 over the highest frequency present. So the motion is the matrix exponential
 * applied to the state, without eigenvectors, and accurate also where frequencies coincide or a body is free; the
 * guards of all contacts are polynomials. A term costs O(n contacts). Source: Jorba and Zou, Experimental Mathematics
 * 14 (2005) 99, for the length of a step. Where a contact with two tangents slips, T is not linear in the motion, and
 * the series converges up to the nearest singularity: planar_series.h. Nothing is allocated after
 * motion_series_make. */
#pragma once

#include "numerics/base/workspace.h"
#include "timeint/closed_form/planar_series.h"
#include "timeint/law/contact_rows.h"

typedef struct motion_series {
  int n, n_contacts;
  double *x;     /* [TRACK_ORDER + 1][n] coefficients of X */
  double *u, *v; /* [n_contacts][TRACK_ORDER + 1] coefficients of U, V */
  double *force; /* [n] */
  contact_rows rows;
  double *q, *pull;           /* [rows.count] coefficient of the rows' motion; of forces on them */
  double *load;               /* [n_loads][2] coefficient of the loads' cosine and sine */
  contact_forces_linear *law; /* [n_contacts] linear forces in the interval */
  int n_turning;              /* number of contacts whose slip turns in this interval */
  planar_series *turning;     /* [n_planar] */
} motion_series;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status motion_series_make(motion_series *s, const modal_base *base, workspace *memory);

/* The series from X = y[0..n-1], X' = y[n..2n-1] at theta; returns the tau up to which it is exact to rounding,
 * possibly INFINITY. First decides which slips keep their direction (hold, law_kind.h): *held is the longest step for
 * which that is valid. */
double motion_series_begin(motion_series *s, const scaled_model *m, contact_track *track, double theta, const double *y,
                           double *held);

/* X and X' (order 0), or X' and X'' (order 1), at tau: out[2n]. */
void motion_series_at(const motion_series *s, double tau, int order, double *out);

/* The motion of contact j, in its `directions`, at tau. */
contact_motion motion_series_contact(const motion_series *s, int j, int directions, double tau);

/* All guards of contact j; returns their number. */
int motion_series_guards(const motion_series *s, const scaled_model *m, const contact_track *track, int j,
                         track_guard guard[TRACK_GUARDS]);

/* Directions of turning slips at tau: of contact j into t[], if its slip turns; of all into track[]. */
void motion_series_direction(const motion_series *s, int j, double tau, contact_track *t);
void motion_series_turn(const motion_series *s, double tau, contact_track *track);

/* Coefficients of row . X: r[TRACK_ORDER + 1]. */
void motion_series_of(const motion_series *s, const double *row, double *r);

/* sum c_k tau^k. */
double series_value(const double *c, double tau);

/* The first tau of [0, h] at which the guard falls through 0, 0 if it is below -noise there; INFINITY: none, except for
 * excursions smaller than the noise. */
double series_first_fall(const track_guard *guard, double h);
