/* planar_columns.h - many variations of a contact with two tangents that slips under the law of the circle
 * (planar_series.h), term by term beside those of the motion (series_columns.h).
 *
 *     dT = d(mu N) e + mu N e_perp dphi
 *     mu N dphi' = kt (dU'.e_perp - U'.e dphi) - q d(mu N)
 * N, e, q and U' are those of the motion, so the equation is linear, with coefficients that are series. From touch-down
 * on, N_0 = 0, it is singular as that of e is, and dphi_0 follows from dU' and dN. A term is a coefficient times h^k.
 * Nothing is allocated after planar_columns_make. */
#ifndef HC_TIMEINT_PLANAR_COLUMNS_H
#define HC_TIMEINT_PLANAR_COLUMNS_H

#include "timeint/closed_form/planar_series.h"

typedef struct planar_columns { /* from planar_columns_make, to planar_columns_free; of one contact */
  int columns;                  /* the most side by side */
  bool fresh;
  double h, kt, friction; /* friction: mu kn */
  double limit[TRACK_TERMS], e[2][TRACK_TERMS], turn[TRACK_TERMS],
      slide[TRACK_TERMS];        /* the motion's: mu N, e, q, U'.e */
  double across[2][TRACK_TERMS]; /* mu N e_perp */
  double *u[2], *v;              /* [TRACK_TERMS][columns] of dU, dV */
  double *angle;                 /* [TRACK_TERMS][columns] of dphi */
  double *pull[2];               /* [columns] of dT */
  double *sum;                   /* [columns] */
  double *numbers;               /* of all arrays */
} planar_columns;

hc_status planar_columns_make(planar_columns *c, int columns); /* HC_NO_MEMORY; free it in any case */
void planar_columns_free(planar_columns *c);

/* Along that motion, steps of h. */
void planar_columns_begin(planar_columns *c, const planar_series *s, const scaled_contact *law, double h);

/* Term k = 0, 1, 2 ... of dT for `width` columns into c->pull; those of dU and dV are there up to k + 1, dphi_0 in
 * c->angle. */
void planar_columns_term(planar_columns *c, int width, int k);

/* dphi at the end of the step, of terms up to k: angle[width]. */
void planar_columns_end(const planar_columns *c, int width, int k, double *angle);

#endif
