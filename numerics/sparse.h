/* sparse.h - sparse matrices by columns: what readers of files make, and what large structures are kept as. */
#pragma once

#include <stdbool.h>

#include "numerics/base/status.h"

typedef struct sparse {
  int n;         /* rows and columns                                                           */
  int *start;    /* [n + 1] entries start[j] .. start[j + 1] - 1 are those of column j; or NULL */
  int *row;      /* of each entry, ascending in a column                                       */
  double *value; /* of each entry                                                              */
} sparse;

/* Room for n columns and `entries` entries, start all 0. HC_NO_MEMORY: nothing to free. */
hc_status sparse_new(int n, int entries, sparse *out);
void sparse_free(sparse *A);

/* Entry (i, j), 0 where none is kept. */
double sparse_at(const sparse *A, int i, int j);

/* Y = A X; X[columns][n], Y likewise, apart from each other. */
void sparse_multiply(const sparse *A, int columns, const double *X, double *Y);

/* A + B. HC_NO_MEMORY. */
hc_status sparse_sum(const sparse *A, const sparse *B, sparse *out);

/* [n][n] by columns, to free, and back without the zeros; NULL, HC_NO_MEMORY: out of memory. */
double *sparse_to_dense(const sparse *A);
hc_status sparse_from_dense(int n, const double *A, sparse *out);

/* Does A differ from its transpose by more than `tolerance` of the two diagonal entries' geometric mean anywhere? Then
 * the first such entry, i > j. */
bool sparse_unsymmetric(const sparse *A, double tolerance, int *i, int *j);
