/* series.h - real trigonometric polynomials, mean first:
 *
 *     x(th) = X[0] + sum_{h=1..H} X[2h-1] cos(h th) + X[2h] sin(h th),      th = omega t [rad]
 *
 * stored as X[2H+1]. Needs libm only, allocates nothing. */
#pragma once

/* Value, d/dth, d2/dth2. */
typedef struct series_jet {
  double x, d1, d2;
} series_jet;

/* Number of coefficients for n_harm harmonics. */
static inline int series_length(int n_harm) { return 2 * n_harm + 1; }

/* From cos and sin of h th, in *ch and *sh, to those of (h + 1) th; c and s are those of th. From 1, 0 the error of the
 * h-th turn is at most 3 h roundings (tests/numerics/test_series.c). */
static inline void series_turn(double c, double s, double *ch, double *sh)
{
  double next = *ch * c - *sh * s;
  *sh = *ch * s + *sh * c;
  *ch = next;
}

/* x, x', x'' at the angle whose cosine and sine are c and s. Error: about n_harm rounding units of sum |X|. */
series_jet series_at(int n_harm, const double *X, double c, double s);

/* Largest and smallest value over a period, to rounding: every extremum is found (crossing.c). */
void series_extrema(int n_harm, const double *X, double *max, double *min);

/* Rate of the amplitude (max - min)/2 of X as X moves along dX; where two extrema are equally large, one of the two. */
double series_amplitude_rate(int n_harm, const double *X, const double *dX);

/* Root mean square over a period, mean included. */
double series_rms(int n_harm, const double *X);

/* |a_1 + i b_1|, or 0 when n_harm = 0. */
double series_harmonic_1(int n_harm, const double *X);

/* ---- several series at one angle or on a grid of angles, with two derivatives ---- */

enum { SERIES_MAX_DIM = 2, SERIES_GRID = 32 };

/* x_1(th) .. x_dim(th), each a series as above. */
typedef struct series_vector {
  int n_harm, dim;
  const double *X[SERIES_MAX_DIM]; /* [2 n_harm + 1] */
} series_vector;

/* Values and two derivatives by th at one angle. */
typedef struct series_node {
  double th, d[3][SERIES_MAX_DIM];
} series_node;

series_node series_vector_at(const series_vector *m, double th);

/* The series on SERIES_GRID equidistant angles per period. */
typedef struct series_grid {
  series_vector m;
  double size[3][SERIES_MAX_DIM];        /* sums of |coefficients| of x, x', x'' */
  series_node node[2 * SERIES_GRID + 1]; /* two periods, so that a period may start anywhere in the first */
} series_grid;

/* cos and sin of h th_i for half the grid, [n_harm][2][SERIES_GRID/2], filled once: half a period later odd harmonics
 * change sign. */
static inline int series_grid_table_length(int n_harm) { return SERIES_GRID * n_harm; }
void series_grid_table_fill(int n_harm, double *table);

void series_grid_fill(series_grid *g, const series_vector *m, const double *table);
