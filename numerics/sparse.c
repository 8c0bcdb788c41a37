/* sparse.c - see sparse.h. */
#include "numerics/sparse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

hc_status sparse_new(int n, int entries, sparse *out)
{
  const size_t room = (size_t)entries + 1;
  *out = (sparse){.n = n,
                  .start = calloc((size_t)n + 1, sizeof *out->start),
                  .row = malloc(room * sizeof *out->row),
                  .value = malloc(room * sizeof *out->value)};
  if (out->start && out->row && out->value) return HC_OK;
  sparse_free(out);
  return HC_NO_MEMORY;
}

void sparse_free(sparse *A)
{
  free(A->start);
  free(A->row);
  free(A->value);
  *A = (sparse){0};
}

double sparse_at(const sparse *A, int i, int j)
{
  int low = A->start[j], high = A->start[j + 1];
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (A->row[middle] < i) low = middle + 1;
    else high = middle;
  }
  return low < A->start[j + 1] && A->row[low] == i ? A->value[low] : 0;
}

void sparse_multiply(const sparse *A, int columns, const double *X, double *Y)
{
  const size_t n = (size_t)A->n;
  memset(Y, 0, n * (size_t)columns * sizeof *Y);
  for (int c = 0; c < columns; ++c, X += n, Y += n)
    for (int j = 0; j < A->n; ++j)
      for (int k = A->start[j]; k < A->start[j + 1] && X[j] != 0; ++k) Y[A->row[k]] += A->value[k] * X[j];
}

hc_status sparse_sum(const sparse *A, const sparse *B, sparse *out)
{
  const hc_status st = sparse_new(A->n, A->start[A->n] + B->start[B->n], out);
  for (int j = 0, k = 0; j < A->n && st == HC_OK; out->start[++j] = k)
    for (int a = A->start[j], b = B->start[j]; a < A->start[j + 1] || b < B->start[j + 1]; ++k) {
      const int row_a = a < A->start[j + 1] ? A->row[a] : A->n, row_b = b < B->start[j + 1] ? B->row[b] : A->n;
      out->row[k] = row_a < row_b ? row_a : row_b;
      out->value[k] = 0;
      if (row_a == out->row[k]) out->value[k] += A->value[a++];
      if (row_b == out->row[k]) out->value[k] += B->value[b++];
    }
  return st;
}

double *sparse_to_dense(const sparse *A)
{
  const size_t n = (size_t)A->n;
  double *v = calloc(n * n, sizeof *v);
  for (size_t j = 0; v && j < n; ++j)
    for (int k = A->start[j]; k < A->start[j + 1]; ++k) v[(size_t)A->row[k] + n * j] = A->value[k];
  return v;
}

hc_status sparse_from_dense(int n, const double *A, sparse *out)
{
  int entries = 0;
  for (size_t k = 0; k < (size_t)n * (size_t)n; ++k) entries += A[k] != 0;
  const hc_status st = sparse_new(n, entries, out);
  for (int j = 0, k = 0; j < n && st == HC_OK; out->start[++j] = k)
    for (int i = 0; i < n; ++i) {
      const double value = A[(size_t)i + (size_t)n * (size_t)j];
      if (value != 0) out->row[k] = i, out->value[k++] = value;
    }
  return st;
}

bool sparse_unsymmetric(const sparse *A, double tolerance, int *i, int *j)
{
  for (int c = 0; c < A->n; ++c)
    for (int k = A->start[c]; k < A->start[c + 1]; ++k) {
      const int r = A->row[k];
      const double both = sqrt(fabs(sparse_at(A, r, r))) * sqrt(fabs(sparse_at(A, c, c)));
      if (fabs(A->value[k] - sparse_at(A, c, r)) <= tolerance * both) continue;
      *i = r > c ? r : c, *j = r > c ? c : r;
      return true;
    }
  return false;
}
