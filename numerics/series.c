/* series.c - see series.h. */
#include "numerics/series.h"

#include <math.h>
#include <string.h>

#include "numerics/base/constants.h"

series_jet series_at(int n_harm, const double *X, double c, double s)
{
  series_jet j = {X[0], 0, 0};
  double ch = 1, sh = 0;
  for (int h = 1; h <= n_harm; ++h) {
    series_turn(c, s, &ch, &sh);
    double even = X[2 * h - 1] * ch + X[2 * h] * sh, odd = X[2 * h] * ch - X[2 * h - 1] * sh;
    j.x += even;
    j.d1 += h * odd;
    j.d2 -= (double)h * h * even;
  }
  return j;
}

double series_rms(int n_harm, const double *X)
{
  double sum = 0;
  for (int i = 1; i < series_length(n_harm); ++i) sum += X[i] * X[i];
  return sqrt(X[0] * X[0] + 0.5 * sum);
}

double series_harmonic_1(int n_harm, const double *X) { return n_harm > 0 ? hypot(X[1], X[2]) : 0; }

/* ---- several at once ---- */

enum { HALF = SERIES_GRID / 2 };

void series_grid_table_fill(int n_harm, double *table)
{
  for (int h = 1; h <= n_harm; ++h)
    for (int i = 0; i < HALF; ++i) {
      double th = TWO_PI * (h * i % SERIES_GRID) / SERIES_GRID;
      table[(h - 1) * SERIES_GRID + i] = cos(th);
      table[(h - 1) * SERIES_GRID + HALF + i] = sin(th);
    }
}

static void fill_coordinate(series_grid *g, int d, const double *table)
{
  g->size[0][d] = fabs(g->m.X[d][0]);
  g->size[1][d] = g->size[2][d] = 0;
  for (int h = 1; h <= g->m.n_harm; ++h) {
    double size = fabs(g->m.X[d][2 * h - 1]) + fabs(g->m.X[d][2 * h]);
    g->size[0][d] += size;
    g->size[1][d] += h * size;
    g->size[2][d] += (double)h * h * size;
  }
  double sum[2][3][HALF] = {{{0}}};
  /* Sums over even harmonics, [0], and odd ones, [1], of x and two derivatives at the first half of the grid. */
  for (int i = 0; i < HALF; ++i) sum[0][0][i] = g->m.X[d][0];
  for (int h = 1; h <= g->m.n_harm; ++h) {
    const double *restrict c = table + (h - 1) * SERIES_GRID, *restrict s = c + HALF;
    double *restrict x = sum[h & 1][0], *restrict d1 = sum[h & 1][1], *restrict d2 = sum[h & 1][2];
    double a = g->m.X[d][2 * h - 1], b = g->m.X[d][2 * h], h1 = h, h2 = h1 * h1;
    for (int i = 0; i < HALF; ++i) {
      double even = a * c[i] + b * s[i], odd = b * c[i] - a * s[i];
      x[i] += even;
      d1[i] += h1 * odd;
      d2[i] -= h2 * even;
    }
  }
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < HALF; ++i) {
      g->node[i].d[k][d] = sum[0][k][i] + sum[1][k][i];
      g->node[i + HALF].d[k][d] = sum[0][k][i] - sum[1][k][i];
    }
}

void series_grid_fill(series_grid *g, const series_vector *m, const double *table)
{
  g->m = *m;
  for (int d = 0; d < m->dim; ++d) fill_coordinate(g, d, table);
  memcpy(g->node + SERIES_GRID, g->node, SERIES_GRID * sizeof *g->node);
  g->node[2 * SERIES_GRID] = g->node[0];
  for (int i = 0; i <= 2 * SERIES_GRID; ++i) g->node[i].th = TWO_PI * i / SERIES_GRID;
}

/* Cosines and sines are computed once for all series. */
static inline series_node sum_at(const series_vector *m, double th, double c, double s, int dim)
{
  series_node node = {.th = th};
  double ch = 1, sh = 0, x[SERIES_MAX_DIM], d1[SERIES_MAX_DIM] = {0}, d2[SERIES_MAX_DIM] = {0};
  for (int d = 0; d < dim; ++d) x[d] = m->X[d][0];
  for (int h = 1; h <= m->n_harm; ++h) {
    series_turn(c, s, &ch, &sh);
    for (int d = 0; d < dim; ++d) {
      const double a = m->X[d][2 * h - 1], b = m->X[d][2 * h], even = a * ch + b * sh, odd = b * ch - a * sh;
      x[d] += even;
      d1[d] += h * odd;
      d2[d] -= (double)h * h * even;
    }
  }
  for (int d = 0; d < dim; ++d) node.d[0][d] = x[d], node.d[1][d] = d1[d], node.d[2][d] = d2[d];
  return node;
}

series_node series_vector_at(const series_vector *m, double th)
{
  _Static_assert(SERIES_MAX_DIM == 2, "one loop for each number of coordinates");
  const double c = cos(th), s = sin(th);
  return m->dim == 1 ? sum_at(m, th, c, s, 1) : sum_at(m, th, c, s, 2);
}
