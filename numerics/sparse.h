/* sparse.h - sparse matrices by columns, for readers of files and for large structures. */
#pragma once

#include <stdbool.h>

#include "numerics/base/status.h"

typedef struct sparse {
  int n;         /* rows and columns */
  int *start;    /* [n + 1] start[j] .. start[j + 1] - 1: entries of column j; or NULL */
  int *row;      /* row of each entry, ascending in a column */
  double *value; /* value of each entry */
} sparse;

/* Allocates n columns and `entries` entries, start all 0. HC_NO_MEMORY: nothing to free. */
hc_status sparse_new(int n, int entries, sparse *out);
void sparse_free(sparse *A);

/* Entry (i, j); 0 if it is not stored. */
double sparse_at(const sparse *A, int i, int j);

/* Y = A X; X[columns][n], Y likewise, not overlapping. */
void sparse_multiply(const sparse *A, int columns, const double *X, double *Y);

/* A + B. HC_NO_MEMORY. */
hc_status sparse_sum(const sparse *A, const sparse *B, sparse *out);

/* Conversion to a dense matrix [n][n] by columns, to be freed, and back without zeros; NULL, HC_NO_MEMORY: out of
 * memory. */
double *sparse_to_dense(const sparse *A);
hc_status sparse_from_dense(int n, const double *A, sparse *out);

/* True if an entry differs from that of the transpose by more than `tolerance` times the geometric mean of the two
 * diagonal entries; (i, j), i > j: the first such entry. */
bool sparse_unsymmetric(const sparse *A, double tolerance, int *i, int *j);
