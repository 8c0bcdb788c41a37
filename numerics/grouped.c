/* grouped.c - see grouped.h. */
#include "numerics/grouped.h"

#include <math.h>
#include <string.h>

#include "numerics/base/workspace.h"
#include "numerics/dense.h"

/* rounding [1]: a row belongs to L if its entries outside its group are below this part of those inside: sticking
 * contacts have rounding of a Fourier transform there. It changes Newton's steps, not the solution. most_response [1]:
 * A_LL counts as nearly singular if an entry of W is larger. */
static const double rounding = 1e-13, most_response = 1e5;

typedef struct part { /* a group; its unknowns of L are list[begin .. begin + L), those of R are rest[at .. at + R) */
  int first, end, begin, L, at, R;
  double *factors, *W; /* [L][L] factors of A_LL; [R + last][L] W, the last columns for unknowns of no group */
} part;

struct grouped {
  int n, n_parts, n_list, n_rest, last; /* last: number of unknowns of no group, at the end of `rest` */
  part *parts;
  int *list, *rest;           /* indices of the unknowns of L; of R */
  int *pivot_list, *pivot;    /* pivots of each A_LL, one behind the other; of `reduced` */
  double *inside, *outside;   /* [n] sums of |entries| of each row within and outside its group */
  double *factors, *W;        /* memory of all parts' factors and W */
  double *reduced, *coupling; /* [R][R] factors of A_RR - A_RL W; [L][R] A_RL of a group */
  double *y;                  /* [n] */
  workspace memory;
};

hc_status grouped_new(int n, int first, int size, grouped **out)
{
  *out = NULL;
  grouped *g = calloc(1, sizeof *g);
  if (!g) return HC_NO_MEMORY;
  const size_t N = (size_t)n, widest = (size_t)(size > first ? size : first);
  workspace *w = &g->memory;
  g->n = n;
  g->last = (n - first) % size;
  g->n_parts = (first > 0) + (n - first) / size;
  g->parts = workspace_array(w, (size_t)g->n_parts, sizeof *g->parts);
  for (int k = 0, at = 0; k < g->n_parts && g->parts; ++k) {
    g->parts[k].first = at;
    g->parts[k].end = at += k == 0 && first > 0 ? first : size;
  }
  int **const lists[] = {&g->list, &g->rest, &g->pivot_list, &g->pivot};
  for (size_t k = 0; k < sizeof lists / sizeof *lists; ++k) *lists[k] = workspace_array(w, N, sizeof(int));
  double **const vectors[] = {&g->inside, &g->outside, &g->y};
  for (size_t k = 0; k < sizeof vectors / sizeof *vectors; ++k) *vectors[k] = workspace_doubles(w, N);
  g->factors = workspace_doubles(w, N * widest);
  g->W = workspace_doubles(w, N * (widest + (size_t)g->last));
  g->coupling = workspace_doubles(w, N * widest);
  g->reduced = workspace_doubles(w, N * N);
  if (w->failed) return grouped_free(g), HC_NO_MEMORY;
  *out = g;
  return HC_OK;
}

void grouped_free(grouped *g)
{
  if (!g) return;
  workspace_free(&g->memory);
  free(g);
}

/* Divides the unknowns into L and R, and places factors and W of each group. */
static void divide(grouped *g, const double *A)
{
  const size_t n = (size_t)g->n;
  memset(g->inside, 0, n * sizeof(double));
  memset(g->outside, 0, n * sizeof(double));
  for (int k = 0; k < g->n_parts; ++k) {
    const int first = g->parts[k].first, end = g->parts[k].end;
    for (int j = first; j < end; ++j) {
      const double *column = A + n * (size_t)j;
      for (int i = 0; i < first; ++i) g->outside[i] += fabs(column[i]);
      for (int i = first; i < end; ++i) g->inside[i] += fabs(column[i]);
      for (int i = end; i < g->n; ++i) g->outside[i] += fabs(column[i]);
    }
  }
  g->n_list = g->n_rest = 0;
  double *factors = g->factors, *W = g->W;
  for (int k = 0; k < g->n_parts; ++k) {
    part *p = &g->parts[k];
    p->begin = g->n_list;
    p->at = g->n_rest;
    for (int i = p->first; i < p->end; ++i)
      if (g->outside[i] <= rounding * g->inside[i]) g->list[g->n_list++] = i;
      else g->rest[g->n_rest++] = i;
    p->L = g->n_list - p->begin;
    p->R = g->n_rest - p->at;
    p->factors = factors;
    p->W = W;
    factors += (size_t)p->L * (size_t)p->L;
    W += (size_t)p->L * (size_t)(p->R + g->last);
  }
  for (int i = g->n - g->last; i < g->n; ++i) g->rest[g->n_rest++] = i;
}

/* B[columns][rows] := the entries of A in these rows and columns. */
static void gather(const grouped *g, const double *A, int rows, const int *row, int columns, const int *column,
                   double *B)
{
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) *B++ = A[(size_t)row[i] + (size_t)g->n * (size_t)column[j]];
}

bool grouped_factor(grouped *g, const double *A, hc_status *status)
{
  divide(g, A);
  const int R = g->n_rest, last = g->last;
  if (R > g->n - g->n / 8) return false;
  gather(g, A, R, g->rest, R, g->rest, g->reduced);
  for (int k = 0; k < g->n_parts; ++k) {
    const part *p = &g->parts[k];
    const int *list = g->list + p->begin;
    gather(g, A, p->L, list, p->L, list, p->factors);
    gather(g, A, p->L, list, p->R, g->rest + p->at, p->W);
    double *of_last = p->W + (size_t)p->L * (size_t)p->R;
    gather(g, A, p->L, list, last, g->rest + R - last, of_last);
    if (dense_factor(p->L, p->factors, g->pivot_list + p->begin) != HC_OK) return false;
    dense_solve(p->L, p->factors, g->pivot_list + p->begin, p->R + last, p->W);
    for (int i = 0; i < p->L * p->R; ++i)
      if (!(fabs(p->W[i]) <= most_response)) return false;
    gather(g, A, R, g->rest, p->L, list, g->coupling);
    dense_add_product(R, p->R, p->L, -1, g->coupling, R, p->W, p->L, 1, g->reduced + (size_t)R * (size_t)p->at, R);
    dense_add_product(R, last, p->L, -1, g->coupling, R, of_last, p->L, 1, g->reduced + (size_t)R * (size_t)(R - last),
                      R);
  }
  *status = dense_factor(R, g->reduced, g->pivot);
  return true;
}

void grouped_solve(grouped *g, const double *A, double *x)
{
  const int R = g->n_rest, last = g->last;
  double *y = g->y, *x_R = y + g->n_list;
  for (int i = 0; i < g->n_list; ++i) y[i] = x[g->list[i]];
  for (int i = 0; i < R; ++i) x_R[i] = x[g->rest[i]];
  for (const part *p = g->parts; p < g->parts + g->n_parts; ++p)
    dense_solve(p->L, p->factors, g->pivot_list + p->begin, 1, y + p->begin);
  for (int j = 0; j < g->n_list; ++j) {
    const double *column = A + (size_t)g->n * (size_t)g->list[j];
    for (int i = 0; i < R; ++i) x_R[i] -= column[g->rest[i]] * y[j];
  }
  dense_solve(R, g->reduced, g->pivot, 1, x_R);
  for (const part *p = g->parts; p < g->parts + g->n_parts; ++p) {
    dense_add_product(p->L, 1, p->R, -1, p->W, p->L, x_R + p->at, p->R, 1, y + p->begin, p->L);
    dense_add_product(p->L, 1, last, -1, p->W + (size_t)p->L * (size_t)p->R, p->L, x_R + R - last, last, 1,
                      y + p->begin, p->L);
  }
  for (int i = 0; i < g->n_list; ++i) x[g->list[i]] = y[i];
  for (int i = 0; i < R; ++i) x[g->rest[i]] = x_R[i];
}

int grouped_sign(const grouped *g)
{
  int sign = dense_sign(g->n_rest, g->reduced, g->pivot);
  for (const part *p = g->parts; p < g->parts + g->n_parts; ++p)
    sign *= dense_sign(p->L, p->factors, g->pivot_list + p->begin);
  return sign;
}
