/* factor.c - see factor.h. */
#include "model/reduce/factor.h"

#include <cholmod.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct factor {
  const bool *held;
  cholmod_common common;
  cholmod_factor *L;
  cholmod_dense *answer, *Y, *E; /* room of cholmod_solve2, which it keeps */
};

void factor_hold_empty(const sparse *K, const sparse *M, bool *held)
{
  for (int i = 0; i < K->n; ++i) {
    bool empty = true;
    for (int k = K->start[i]; k < K->start[i + 1]; ++k) empty &= K->value[k] == 0;
    for (int k = M->start[i]; k < M->start[i + 1]; ++k) empty &= M->value[k] == 0;
    held[i] |= empty;
  }
}

static int entries_below(const sparse *A)
{
  int entries = 0;
  for (int j = 0; j < A->n; ++j)
    for (int k = A->start[j]; k < A->start[j + 1]; ++k) entries += A->row[k] > j;
  return entries;
}

/* The lower triangle of K + shift M. The held columns and rows are those of the identity, so every column has its
 * diagonal, first. */
static hc_status shifted(const sparse *K, const sparse *M, double shift, const bool *held, sparse *A)
{
  const int n = K->n, with_mass = shift != 0;
  const hc_status st = sparse_new(n, entries_below(K) + with_mass * entries_below(M) + n, A);
  for (int j = 0, to = 0; j < n && st == HC_OK; A->start[++j] = to) {
    int k = K->start[j], m = M->start[j];
    const int end_k = held[j] ? k : K->start[j + 1], end_m = held[j] || !with_mass ? m : M->start[j + 1];
    A->row[to] = j, A->value[to++] = held[j] ? 1 : sparse_at(K, j, j) + shift * sparse_at(M, j, j);
    while (k < end_k || m < end_m) {
      const int row_k = k < end_k ? K->row[k] : n, row_m = m < end_m ? M->row[m] : n;
      const int i = row_k < row_m ? row_k : row_m;
      const double value = (row_k == i ? K->value[k++] : 0) + (row_m == i ? shift * M->value[m++] : 0);
      if (i > j && !held[i]) A->row[to] = i, A->value[to++] = value;
    }
  }
  return st;
}

hc_status factor_new(const sparse *K, const sparse *M, double shift, const bool *held, factor **out)
{
  const double least = 1e-13; /* reciprocal condition, from the factor's diagonal: below, what is left is rounding */
  factor *f = *out = calloc(1, sizeof *f);
  if (!f) return HC_NO_MEMORY;
  f->held = held;
  cholmod_start(&f->common);
  f->common.print = 0;
  f->common.supernodal = CHOLMOD_SUPERNODAL;
  sparse A = {0};
  hc_status st = shifted(K, M, shift, held, &A);
  if (st == HC_OK) {
    cholmod_sparse lower = {.nrow = (size_t)A.n,
                            .ncol = (size_t)A.n,
                            .nzmax = (size_t)A.start[A.n],
                            .p = A.start,
                            .i = A.row,
                            .x = A.value,
                            .stype = -1,
                            .itype = CHOLMOD_INT,
                            .xtype = CHOLMOD_REAL,
                            .dtype = CHOLMOD_DOUBLE,
                            .sorted = 1,
                            .packed = 1};
    f->L = cholmod_analyze(&lower, &f->common);
    if (f->L) cholmod_factorize(&lower, f->L, &f->common);
    if (!f->L || f->common.status < CHOLMOD_OK) st = HC_NO_MEMORY;
    else if (f->common.status == CHOLMOD_NOT_POSDEF || !(cholmod_rcond(f->L, &f->common) > least)) st = HC_SINGULAR;
  }
  sparse_free(&A);
  if (st == HC_OK) return HC_OK;
  factor_free(f);
  *out = NULL;
  return st;
}

void factor_free(factor *f)
{
  if (!f) return;
  cholmod_free_factor(&f->L, &f->common);
  cholmod_free_dense(&f->answer, &f->common);
  cholmod_free_dense(&f->Y, &f->common);
  cholmod_free_dense(&f->E, &f->common);
  cholmod_finish(&f->common);
  free(f);
}

hc_status factor_solve(factor *f, int columns, double *X)
{
  enum { BLOCK = 32 }; /* columns at a time: BLAS 3, and no third copy of all of them */
  const size_t n = f->L->n;
  for (int c = 0; c < columns; c += BLOCK) {
    const size_t some = (size_t)(columns - c < BLOCK ? columns - c : BLOCK);
    double *x = X + n * (size_t)c;
    for (size_t k = 0; k < some * n; ++k)
      if (f->held[k % n]) x[k] = 0;
    cholmod_dense right = {.nrow = n, .ncol = some, .nzmax = n * some, .d = n, .x = x, .xtype = CHOLMOD_REAL};
    if (!cholmod_solve2(CHOLMOD_A, f->L, &right, NULL, &f->answer, NULL, &f->Y, &f->E, &f->common)) return HC_NO_MEMORY;
    memcpy(x, f->answer->x, some * n * sizeof *x);
  }
  return HC_OK;
}

hc_status factor_shifted(const sparse *K, const sparse *M, const bool *held, double shift_floating, double *shift,
                         factor **out)
{
  double steepest = 0; /* K/M of a row: the order of the largest eigenvalue */
  *shift = 0;
  const hc_status st = factor_new(K, M, 0, held, out);
  if (st != HC_SINGULAR) return st;
  for (int i = 0; i < K->n; ++i)
    if (!held[i] && sparse_at(M, i, i) > 0) steepest = fmax(steepest, sparse_at(K, i, i) / sparse_at(M, i, i));
  *shift = fmax(shift_floating, 1e-10 * steepest);
  return factor_new(K, M, *shift, held, out);
}
