/* planar_series.h - a contact with two tangents that slips under the law of the circle, in powers of tau.
 *
 *     T = mu N e,  |e| = 1,   e' = q e_perp,   mu N q = kt U'.e_perp          e_perp = (-e_2, e_1)
 * U and V are those of motion_series.h, T is part of its equation: T_k depends only on coefficients of the motion that
 * are known by then, so the two series are computed together. Where mu N_0 > 0
 *     mu N_0 q_{k-1} = kt (U'.e_perp)_{k-1} - sum_{i=1}^{k-1} mu N_i q_{k-1-i}
 * At touch-down N_0 = 0, and the equation of e is singular. All its solutions but one diverge backwards in time; that
 * one starts along U', e_0 = U'_0/|U'_0|, and is a power series as well, q_{k-1} being in (U'.e_perp)_k, too:
 *     (mu N_1 + kt |U'_0|/k) q_{k-1} = kt (U'.e_perp)_k without it - sum_{i=2}^{k} mu N_i q_{k-i}
 * The contact slips while s = U'.e - (mu N)'/kt >= 0. */
#pragma once

#include "numerics/base/workspace.h"
#include "timeint/law/contact_track.h"

typedef struct planar_series {
  int contact;                 /* index of its first direction */
  bool fresh;                  /* starts at touch-down, N_0 = 0 */
  double limit[TRACK_TERMS];   /* mu N */
  double e[2][TRACK_TERMS];    /* coefficients of e; if fresh the last one is unknown, 0 */
  double turn[TRACK_TERMS];    /* coefficients of q, one less than of e */
  double rate[2][TRACK_TERMS]; /* coefficients of U', one less than of U */
  const double *u[2], *v;      /* [TRACK_TERMS] the motion's series, as far as known */
} planar_series;

/* Starts the series of contact j with states t[2], its motion being in u[2][TRACK_TERMS], v[TRACK_TERMS]. */
void planar_series_begin(planar_series *s, int j, const contact_track t[2], const double *u, const double *v);

/* Computes coefficient k = 0, 1, 2 ..., in order, from U and V known up to k + 1. pull[2]: coefficient of T. */
void planar_series_next(planar_series *s, const scaled_contact *c, int k, double pull[2]);

/* The tau up to which the series of e is accurate to rounding. */
double planar_series_reach(const planar_series *s);

/* e at tau, of length 1. */
void planar_series_direction(const planar_series *s, double tau, double e[2]);

/* The series of kt s, the guard of slip: g[TRACK_TERMS]. */
void planar_series_guard(const planar_series *s, const scaled_contact *c, double *g);

/* Many variations of such a contact, term by term beside those of the motion (series_columns.h):
 *     dT = d(mu N) e + mu N e_perp dphi
 *     mu N dphi' = kt (dU'.e_perp - U'.e dphi) - q d(mu N)
 * N, e, q and U' are those of the motion, so the equation is linear, with coefficients that are series. At touch-down,
 * N_0 = 0, it is singular like that of e, and dphi_0 follows from dU' and dN. A term is a coefficient times h^k.
 * Nothing is allocated after planar_columns_make. */
typedef struct planar_columns { /* of one contact */
  int columns;                  /* capacity of columns */
  bool fresh;
  double h, kt, friction; /* friction: mu kn */
  /* terms of the motion: mu N, e, q, U'.e */
  double limit[TRACK_TERMS], e[2][TRACK_TERMS], turn[TRACK_TERMS], slide[TRACK_TERMS];
  double across[2][TRACK_TERMS]; /* mu N e_perp */
  double *u[2], *v;              /* [TRACK_TERMS][columns] terms of dU, dV */
  double *angle;                 /* [TRACK_TERMS][columns] terms of dphi */
  double *pull[2];               /* [columns] current term of dT */
  double *sum;                   /* [columns] */
} planar_columns;

/* Arrays are memory's. */
void planar_columns_make(planar_columns *c, int columns, workspace *memory);

/* Starts a step h along the motion of s. */
void planar_columns_begin(planar_columns *c, const planar_series *s, const scaled_contact *law, double h);

/* Term k = 0, 1, 2 ... of dT for `width` columns into c->pull; terms of dU and dV must be set up to k + 1, dphi_0 in
 * c->angle. */
void planar_columns_term(planar_columns *c, int width, int k);

/* dphi at the end of the step, the sum of terms up to k: angle[width]. */
void planar_columns_end(const planar_columns *c, int width, int k, double *angle);
