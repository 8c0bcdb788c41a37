/* lu.c - see lu.h. Right-looking by columns: the inner loops run down contiguous columns, which the compiler
 * vectorises. */
#include "numerics/lu.h"

#include <math.h>
#include <stddef.h>

#include "base/wide_vectors.h"
#include "numerics/product.h"

/* Of so many unknowns on, columns are taken in panels: the same operations, in an order that the cache likes. */
enum { FROM_PANELS = 64, PANEL = 32 };

static double *column(double *a, int n, int j) { return a + (size_t)n * (size_t)j; }

static void swap_rows(int n, double *a, int k, int p, int from, int to)
{
  for (int j = from; j < to && p != k; ++j) {
    double *col = column(a, n, j), swap = col[k];
    col[k] = col[p];
    col[p] = swap;
  }
}

/* Columns from..to-1 of a, whose rows above `from` are done; rows are swapped in these columns alone. */
WIDE_VECTORS static int factor_columns(int n, double *restrict a, int *pivot, int from, int to)
{
  for (int k = from; k < to; ++k) {
    double *restrict pivot_col = column(a, n, k);
    int p = k;
    for (int i = k + 1; i < n; ++i)
      if (fabs(pivot_col[i]) > fabs(pivot_col[p])) p = i;
    pivot[k] = p;
    if (!(fabs(pivot_col[p]) > 0) || !isfinite(pivot_col[p])) return 0;
    swap_rows(n, a, k, p, from, to);
    double inverse = 1 / pivot_col[k];
    for (int i = k + 1; i < n; ++i) pivot_col[i] *= inverse;
    for (int j = k + 1; j < to; ++j) {
      double *restrict col = column(a, n, j), factor = col[k];
      for (int i = k + 1; i < n; ++i) col[i] -= factor * pivot_col[i];
    }
  }
  return 1;
}

/* The rows from..to-1 of U in column col, by the unit triangle of the panel. */
WIDE_VECTORS static void solve_in_panel(int n, double *restrict a, int from, int to, double *restrict col)
{
  for (int k = from; k < to; ++k) {
    const double *restrict pivot_col = column(a, n, k), factor = col[k];
    for (int i = k + 1; i < to; ++i) col[i] -= factor * pivot_col[i];
  }
}

int lu_factor(int n, double *a, int *pivot)
{
  if (n < FROM_PANELS) return factor_columns(n, a, pivot, 0, n);
  for (int from = 0; from < n; from += PANEL) {
    const int to = from + PANEL < n ? from + PANEL : n, left = n - to;
    if (!factor_columns(n, a, pivot, from, to)) return 0;
    for (int k = from; k < to; ++k) {
      swap_rows(n, a, k, pivot[k], 0, from);
      swap_rows(n, a, k, pivot[k], to, n);
    }
    for (int j = to; j < n; ++j) solve_in_panel(n, a, from, to, column(a, n, j));
    if (left > 0)
      product_subtract(left, left, to - from, column(a, n, from) + to, n, column(a, n, to) + from, n,
                       column(a, n, to) + to, n);
  }
  return 1;
}

WIDE_VECTORS void lu_solve(int n, const double *restrict a, const int *pivot, double *restrict x)
{
  for (int k = 0; k < n; ++k) {
    double swap = x[k];
    x[k] = x[pivot[k]];
    x[pivot[k]] = swap;
  }
  for (int k = 0; k < n; ++k) {
    const double *restrict col = a + (size_t)n * k, xk = x[k];
    for (int i = k + 1; i < n; ++i) x[i] -= xk * col[i];
  }
  for (int k = n - 1; k >= 0; --k) {
    const double *restrict col = a + (size_t)n * k, xk = x[k] /= col[k];
    for (int i = 0; i < k; ++i) x[i] -= xk * col[i];
  }
}

int lu_sign(int n, const double *a, const int *pivot)
{
  int sign = 1;
  for (int k = 0; k < n; ++k) {
    if (a[k + (size_t)n * k] < 0) sign = -sign;
    if (pivot[k] != k) sign = -sign;
  }
  return sign;
}
