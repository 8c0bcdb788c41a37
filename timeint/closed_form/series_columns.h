/* series_columns.h - many variations of a structure's motion at once, in an interval between changes of contact state:
 *
 *     D'' + by_C C D' + by_K K D = - sum_j [ t_j dT_j + n_j dN_j ],   dT_j = t_u dU + t_v dV + t_w dW_j, dN_j = n_v dV
 *
 * A column is a variation; the terms z_k = d_k h^k of its power series over a step h come from
 *     (k + 1)(k + 2) z_{k+2} = -h^2 (by_K K z_k + contacts of z_k) - h (k + 1) by_C C z_{k+1}
 * for a block of columns together, by matrix products; contacts without stiffness are left out. Terms are added until
 * the truncation error of every column is below rounding (coarse matrices: a larger tolerance); a step is as long as 24
 * terms allow, about 2 over the highest frequency. Over intervals of many steps the map of one step is squared
 * repeatedly. Nothing is allocated after series_columns_make. */
#pragma once

#include <float.h>

#include "timeint/closed_form/motion_series.h"

enum { SERIES_COLUMNS_SQUARED = 1500 }; /* most states for which steps are squared: two matrices of 18 MB */
#define SERIES_COLUMNS_ROUNDING (0.25 * DBL_EPSILON)

typedef struct series_columns {
  int n, n_contacts, n_planar;
  double *turned_K, *turned_C;  /* [n][n] by rows; NULL where diagonal */
  int n_rows;                   /* number of rows of contacts with linear stiffness in this interval */
  int n_pulled;                 /* n_rows, and two tangents for each slip that turns */
  int n_moving;                 /* n_pulled, and those slips' normals that are not among n_rows */
  double *rows, *turned;        /* [n][n_moving] these rows, by columns; by rows */
  contact_forces_linear *law;   /* [n_contacts] linear forces in this interval, without T of slips that turn */
  int n_slipping;               /* number of contacts whose slip turns in this interval */
  int *normal;                  /* [n_planar] index in `rows` of each one's normal */
  double *x, *p;                /* [block][n] motion and its rate for a block of columns */
  double *x_end, *p_end;        /* [block][n] the same after a step */
  double *term, *next, *second; /* [block][n] z_k, z_{k+1}, z_{k+2} */
  double *motion, *motion_next; /* [block][n_moving] the rows' motion in z_k, then the forces on them; in z_{k+1} */
  double *slider;               /* [block][n_contacts] dW_j */
  double *size, *left;          /* [block] squared size of each column; squared term relative to the tolerance */
  planar_columns *turning;      /* [n_planar] */
  const motion_series *along;   /* the motion along which slips turn; else NULL */
  int n_states;                 /* 2 n + contacts */
  double *map, *squared;        /* [n_states][n_states] by rows: map of one or many steps; work; NULL: too large */
  double rounding;              /* [column] truncation tolerance, set by the owner */
  double reach;                 /* [rad] step length: first an estimate, halved whenever 24 terms do not suffice */
} series_columns;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status series_columns_make(series_columns *s, const modal_base *base, workspace *memory);

/* Starts an interval with the contact states of track[]. */
void series_columns_begin(series_columns *s, const scaled_model *m, const contact_track *track);

/* Advances `count` columns over `span`. Entry i of column q is at matrix[i ld + q]: rows 0..n-1 D, n..2n-1 D', then
 * dW_j, which is constant. HC_NOT_FINITE. */
hc_status series_columns_advance(series_columns *s, const scaled_model *m, double span, int count, int ld,
                                 double *matrix);

/* The same over one step h of a motion on which slips turn, h within its reach; the row of the first slider of each
 * such contact is dphi. false (coarse matrices only): the step is too long, and nothing was changed. */
bool series_columns_turn(series_columns *s, const scaled_model *m, const motion_series *along, double h, int count,
                         int ld, double *matrix);
