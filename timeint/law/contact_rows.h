/* contact_rows.h - the rows t_j and n_j of a structure's contacts, without zero rows and duplicates: the directions of
 * a contact share its normal. libm and BLAS. */
#pragma once

#include "numerics/base/workspace.h"
#include "timeint/law/modal_base.h"

typedef struct contact_rows { /* made once, then only read */
  int n, count;
  int *along, *across; /* [n_contacts] index of the row t_j, n_j; -1: the row is zero */
  double *row;         /* [count][n] by rows */
} contact_rows;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status contact_rows_make(contact_rows *c, const modal_base *base, workspace *memory);

/* q[count] := the rows times x[n]. */
void contact_rows_motion(const contact_rows *c, const double *x, double *q);

/* out[n] -= by sum_r force[r] row_r. */
void contact_rows_pull(const contact_rows *c, double by, const double *force, double *out);

/* Entry `row` of q or of a force; 0 if row is -1. */
static inline double contact_rows_at(const double *q, int row) { return row < 0 ? 0 : q[row]; }
