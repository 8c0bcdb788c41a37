/* inverse.c - see inverse.h. In place, real and imaginary parts apart, columns K in panels:
 *     panel      Gauss and Jordan on columns K alone:  A_KK -> A_KK^-1,  A_iK -> -A_iK A_KK^-1
 *     the rest   A_KJ, set aside, times that:          A_KJ -> A_KK^-1 A_KJ,  A_iJ -> A_iJ - A_iK A_KK^-1 A_KJ
 * so that nearly all operations are products of real matrices (product.h). Rows are exchanged whole; in the end the
 * columns are, backwards. */
#include "numerics/inverse.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/wide_vectors.h"
#include "numerics/product.h"

enum { PANEL = 16 };

typedef struct split {
  int n;
  double *re, *im;                       /* [n][n] */
  double *minus_re, *minus_im, *plus_im; /* [n][PANEL] of rows set aside: -re, -im, im */
} split;

size_t inverse_room(int n) { return 2 * (size_t)n * (size_t)n + 3 * (size_t)n * PANEL; }

static double *entry(double *a, int n, int row, int column) { return a + (size_t)row + (size_t)column * (size_t)n; }

static void swap(double *a, double *b)
{
  const double kept = *a;
  *a = *b;
  *b = kept;
}

static void swap_rows(split *s, int a, int b)
{
  for (int j = 0; j < s->n && a != b; ++j) {
    swap(entry(s->re, s->n, a, j), entry(s->re, s->n, b, j));
    swap(entry(s->im, s->n, a, j), entry(s->im, s->n, b, j));
  }
}

static void swap_columns(split *s, int a, int b)
{
  for (int i = 0; i < s->n && a != b; ++i) {
    swap(entry(s->re, s->n, i, a), entry(s->re, s->n, i, b));
    swap(entry(s->im, s->n, i, a), entry(s->im, s->n, i, b));
  }
}

/* The row from k on whose entry in column k is largest. */
static int find_pivot(const split *s, int k)
{
  const double *re = s->re + (size_t)k * (size_t)s->n, *im = s->im + (size_t)k * (size_t)s->n;
  int p = k;
  for (int i = k + 1; i < s->n; ++i)
    if (fabs(re[i]) + fabs(im[i]) > fabs(re[p]) + fabs(im[p])) p = i;
  return p;
}

/* c += (x + i y) a, of columns; row k of c is to be x + i y alone. */
WIDE_VECTORS static void eliminate(int n, int k, const double *restrict are, const double *restrict aim,
                                   double *restrict cre, double *restrict cim)
{
  const double x = cre[k], y = cim[k];
  cre[k] = cim[k] = 0;
  for (int i = 0; i < n; ++i) {
    cre[i] += x * are[i] - y * aim[i];
    cim[i] += x * aim[i] + y * are[i];
  }
}

/* Column k of columns from..to-1: its entries become what the others' row k is to be multiplied by. */
static bool divide_column(split *s, int k)
{
  double *re = entry(s->re, s->n, 0, k), *im = entry(s->im, s->n, 0, k);
  const double complex inverse = 1 / (re[k] + I * im[k]);
  const double x = creal(inverse), y = cimag(inverse);
  if (!isfinite(x) || !isfinite(y)) return false;
  re[k] = -1, im[k] = 0;
  for (int i = 0; i < s->n; ++i) {
    const double a = re[i], b = im[i];
    re[i] = -(x * a - y * b);
    im[i] = -(x * b + y * a);
  }
  return true;
}

static bool invert_panel(split *s, int from, int to, int *pivot)
{
  const int n = s->n;
  for (int k = from; k < to; ++k) {
    pivot[k] = find_pivot(s, k);
    swap_rows(s, k, pivot[k]);
    if (!divide_column(s, k)) return false;
    for (int j = from; j < to; ++j)
      if (j != k)
        eliminate(n, k, entry(s->re, n, 0, k), entry(s->im, n, 0, k), entry(s->re, n, 0, j), entry(s->im, n, 0, j));
  }
  return true;
}

/* Rows from..to-1 of columns first..last-1 set aside, and 0 in their place. */
static void set_rows_aside(split *s, int from, int to, int first, int last)
{
  const int width = to - from;
  for (int j = first; j < last; ++j)
    for (int i = 0; i < width; ++i) {
      double *re = entry(s->re, s->n, from + i, j), *im = entry(s->im, s->n, from + i, j);
      const size_t at = (size_t)(j - first) * (size_t)width + (size_t)i;
      s->minus_re[at] = -*re, s->minus_im[at] = -*im, s->plus_im[at] = *im;
      *re = *im = 0;
    }
}

/* Columns first..last-1, beside the panel of columns from..to-1. */
static void apply_panel(split *s, int from, int to, int first, int last)
{
  const int n = s->n, width = to - from, columns = last - first;
  const double *re = entry(s->re, n, 0, from), *im = entry(s->im, n, 0, from);
  double *to_re = entry(s->re, n, 0, first), *to_im = entry(s->im, n, 0, first);
  if (columns == 0) return;
  set_rows_aside(s, from, to, first, last);
  product_subtract(n, columns, width, re, n, s->minus_re, width, to_re, n);
  product_subtract(n, columns, width, im, n, s->plus_im, width, to_re, n);
  product_subtract(n, columns, width, re, n, s->minus_im, width, to_im, n);
  product_subtract(n, columns, width, im, n, s->minus_re, width, to_im, n);
}

hc_status inverse_complex(int n, const double complex *A, int *pivot, double *work, double complex *inverse)
{
  const size_t entries = (size_t)n * (size_t)n, aside = (size_t)n * PANEL;
  split s = {.n = n};
  s.re = work, s.im = work + entries, s.minus_re = work + 2 * entries;
  s.minus_im = s.minus_re + aside, s.plus_im = s.minus_im + aside;
  for (size_t i = 0; i < entries; ++i) s.re[i] = creal(A[i]), s.im[i] = cimag(A[i]);
  for (int from = 0; from < n; from += PANEL) {
    const int to = from + PANEL < n ? from + PANEL : n;
    if (!invert_panel(&s, from, to, pivot)) return HC_SINGULAR;
    apply_panel(&s, from, to, 0, from);
    apply_panel(&s, from, to, to, n);
  }
  for (int k = n - 1; k >= 0; --k) swap_columns(&s, k, pivot[k]);
  for (size_t i = 0; i < entries; ++i) inverse[i] = s.re[i] + I * s.im[i];
  return HC_OK;
}
