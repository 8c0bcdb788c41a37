/* series.h - real trigonometric polynomials, mean first:
 *
 *     x(th) = X[0] + sum_{h=1..H} X[2h-1] cos(h th) + X[2h] sin(h th),      th = omega t [rad]
 *
 * stored as X[2H+1]. Needs libm only, allocates nothing. */
#ifndef HC_SERIES_H
#define HC_SERIES_H

/* Value, d/dth, d2/dth2. */
typedef struct series_jet {
  double x, d1, d2;
} series_jet;

/* Coefficients of n_harm harmonics. */
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

/* Largest and smallest value over a period, to rounding: every extremum is found (crossing.h). */
void series_extrema(int n_harm, const double *X, double *max, double *min);

/* Root mean square over a period, mean included. */
double series_rms(int n_harm, const double *X);

/* |a_1 + i b_1|, or 0 when n_harm = 0. */
double series_harmonic_1(int n_harm, const double *X);

#endif
