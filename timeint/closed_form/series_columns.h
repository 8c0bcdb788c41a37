/* series_columns.h - many variations of a structure's motion at once, in an interval between changes of contact state:
 *
 *     D'' + by_C C D' + by_K K D = - sum_j [ t_j dT_j + n_j dN_j ],   dT_j = t_u dU + t_v dV + t_w dW_j, dN_j = n_v dV
 *
 * A column is a variation; the terms z_k = d_k h^k of its power series over a step h come from
 *     (k + 1)(k + 2) z_{k+2} = -h^2 (by_K K z_k + contacts of z_k) - h (k + 1) by_C C z_{k+1}
 * for a block of columns together: products of matrices, not of a matrix and a vector, and contacts that resist no
 * motion are left out. So many terms are taken that
 * what is left out of any column is below its rounding (of a coarse matrix, a larger part of it); a step is as long as
 * LAST terms allow, about 2 over the highest frequency. Where contacts stay as they are for many steps, the map of one
 * is squared until it is that of all. Nothing is allocated after series_columns_make. */
#pragma once

#include <float.h>

#include "timeint/closed_form/motion_series.h"

enum { SERIES_COLUMNS_SQUARED = 1500 }; /* states at most: two matrices of 18 MB */
#define SERIES_COLUMNS_ROUNDING (0.25 * DBL_EPSILON)

typedef struct series_columns {
  int n, n_contacts, n_planar;
  double *turned_K, *turned_C;  /* [n][n] by rows, where they are not diagonal; else NULL */
  int n_rows;                   /* of contacts that resist linearly in this interval, */
  int n_pulled;                 /* with the two tangents of each slip that turns, */
  int n_moving;                 /* and with the normals of those that are not among them yet */
  double *rows, *turned;        /* [n][n_moving] by columns; by rows */
  contact_forces_linear *law;   /* [n_contacts] of this interval, but T of slips that turn */
  int n_slipping;               /* contacts whose slip turns in this interval */
  int *normal;                  /* [n_planar] the row of its normal */
  double *x, *p;                /* [block][n] motion and its rate, of a block of columns */
  double *x_end, *p_end;        /* [block][n] the same after a step */
  double *term, *next, *second; /* [block][n] z_k, z_{k+1}, z_{k+2} */
  double *motion, *motion_next; /* [block][n_moving] of the rows in z_k, then their forces; in z_{k+1} */
  double *slider;               /* [block][n_contacts] dW_j */
  double *size, *left;          /* [block] of columns, squared */
  planar_columns *turning;      /* [n_planar] */
  const motion_series *along;   /* where slips turn: the motion; else NULL */
  int n_states;                 /* 2 n + contacts */
  double *map, *squared;        /* [n_states][n_states] by rows, of a step or of many; NULL: too large */
  double rounding;              /* [column] truncation tolerance, set by the owner */
  double reach;                 /* [rad] the longest step that has been seen to suffice, or is hoped to */
} series_columns;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status series_columns_make(series_columns *s, const modal_base *base, workspace *memory);

/* From here on contacts are in the states of track[]. */
void series_columns_begin(series_columns *s, const scaled_model *m, const contact_track *track);

/* count columns over `span`. Number i of column q is at matrix[i ld + q]: rows 0..n-1 D, n..2n-1 D', then dW_j, which
 * stays. HC_NOT_FINITE. */
hc_status series_columns_advance(series_columns *s, const scaled_model *m, double span, int count, int ld,
                                 double *matrix);

/* The same over one step h of a motion on which slips turn, h within its reach; the row of the first slider of each
 * is dphi. false: of a coarse matrix the step is too long for it, and nothing was done. */
bool series_columns_turn(series_columns *s, const scaled_model *m, const motion_series *along, double h, int count,
                         int ld, double *matrix);
