/* factor.c - see factor.h. */
#include "reduce/factor.h"

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

/* CHOLMOD's view of a sparse matrix's lower triangle. */
static cholmod_sparse view(const sparse *A)
{
  return (cholmod_sparse){.nrow = (size_t)A->n,
                          .ncol = (size_t)A->n,
                          .nzmax = (size_t)A->start[A->n],
                          .p = A->start,
                          .i = A->row,
                          .x = A->value,
                          .stype = -1,
                          .itype = CHOLMOD_INT,
                          .xtype = CHOLMOD_REAL,
                          .dtype = CHOLMOD_DOUBLE,
                          .sorted = 1,
                          .packed = 1};
}

/* Of A's columns the held ones become those of the identity, and the others lose the held rows. */
static void hold(cholmod_sparse *A, const bool *held)
{
  int *start = A->p, *row = A->i, to = 0;
  double *value = A->x;
  for (int j = 0, from = 0; j < (int)A->ncol; ++j) {
    const int end = start[j + 1];
    start[j] = to;
    for (; from < end; ++from) {
      const bool diagonal = held[j] && row[from] == j;
      if (!diagonal && (held[j] || held[row[from]])) continue;
      row[to] = row[from], value[to++] = diagonal ? 1 : value[from];
    }
  }
  start[A->ncol] = to;
}

hc_status factor_new(const sparse *K, const sparse *M, double shift, const bool *held, factor **out)
{
  const double least = 1e-13; /* reciprocal condition, from the factor's diagonal: below, what is left is rounding */
  double one[2] = {1, 0}, part[2] = {shift, 0};
  factor *f = *out = calloc(1, sizeof *f);
  if (!f) return HC_NO_MEMORY;
  f->held = held;
  cholmod_start(&f->common);
  f->common.print = 0;
  f->common.supernodal = CHOLMOD_SUPERNODAL;
  sparse diagonal; /* each entry of it is there, so that held rows have one */
  hc_status st = sparse_new(K->n, K->n, &diagonal);
  for (int i = 0; i < K->n && st == HC_OK; ++i)
    diagonal.start[i + 1] = i + 1, diagonal.row[i] = i, diagonal.value[i] = 0;
  if (st == HC_OK) {
    cholmod_sparse stiffness = view(K), mass = view(shift != 0 ? M : &diagonal), all = view(&diagonal);
    cholmod_sparse *part_sum = cholmod_add(&stiffness, &mass, one, part, 1, 1, &f->common);
    cholmod_sparse *A = part_sum ? cholmod_add(part_sum, &all, one, one, 1, 1, &f->common) : NULL;
    cholmod_free_sparse(&part_sum, &f->common);
    if (A) hold(A, held);
    f->L = A ? cholmod_analyze(A, &f->common) : NULL;
    if (f->L) cholmod_factorize(A, f->L, &f->common);
    cholmod_free_sparse(&A, &f->common);
    if (!f->L || f->common.status < CHOLMOD_OK) st = HC_NO_MEMORY;
    else if (f->common.status == CHOLMOD_NOT_POSDEF || !(cholmod_rcond(f->L, &f->common) > least)) st = HC_SINGULAR;
  }
  sparse_free(&diagonal);
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
