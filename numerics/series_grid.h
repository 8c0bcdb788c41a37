/* series_grid.h - several trigonometric polynomials at one angle or on a grid of angles, with two derivatives. libm
 * only, nothing is allocated. */
#ifndef HC_SERIES_GRID_H
#define HC_SERIES_GRID_H

enum { SERIES_MAX_DIM = 2, SERIES_GRID = 32 };

/* x_1(th) .. x_dim(th), each a series (series.h). */
typedef struct series_vector {
  int n_harm, dim;
  const double *X[SERIES_MAX_DIM]; /* [2 n_harm + 1] */
} series_vector;

/* Values and two derivatives by th at one angle. */
typedef struct series_node {
  double th, d[3][SERIES_MAX_DIM];
} series_node;

series_node series_vector_at(const series_vector *m, double th);

/* On SERIES_GRID equidistant angles a period. */
typedef struct series_grid {
  series_vector m;
  double size[3][SERIES_MAX_DIM];        /* sums of |coefficients| of x, x', x'' */
  series_node node[2 * SERIES_GRID + 1]; /* two periods: one that starts anywhere in the first lies in them */
} series_grid;

/* cos and sin of h th_i for half the grid, [n_harm][2][SERIES_GRID/2], filled once: half a period later odd harmonics
 * change sign. */
static inline int series_grid_table_length(int n_harm) { return SERIES_GRID * n_harm; }
void series_grid_table_fill(int n_harm, double *table);

void series_grid_fill(series_grid *g, const series_vector *m, const double *table);

#endif
