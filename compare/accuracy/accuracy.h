/* accuracy.h - error and cost of HBM over truncation orders H and samples N (accuracy_run), and the orders of
 * convergence in N, H and the regularisation (order_fit). Not here: one solution's discrepancy (compare/budget.h). */
#pragma once

#include "compare/compare_settings.h"
#include "compare/comparison.h"
#include "numerics/base/status.h"

/* Fit e ~ c x^-order to the points from <= x <= to, by least squares on logarithms. */
typedef struct order_fit {
  double order, spread; /* spread: standard error of order; NaN for fewer than three points; order NaN for fewer than
                           two */
  double from, to;
  int points;
} order_fit;

enum { ORDER_MOST_POINTS = 512 };

/* x[n] ascending > 0, larger is finer; errors e[n] >= 0 [1], NaN: missing; n <= ORDER_MOST_POINTS. The line is fitted
 * to the envelope, the largest error at this x or a finer one, since an aliasing error is erratic and may be small by
 * chance. Points are used where the envelope is below 0.1 and above `floor`; of these the k finest, k >= 3, with the
 * narrowest 95 % interval for the order, which excludes coarse points before the asymptotic range. */
order_fit order_fit_to(int n, const double *x, const double *e, double floor);

/* One pair (H, N), over the frequencies of the comparison and the referee's orbits there. NaN: unknown. */
typedef struct accuracy_row {
  int harmonics, samples;                   /* samples 0: exact forces */
  bool possible;                            /* N >= 2 H + 2 */
  hc_status status;                         /* status of the response curve */
  int solutions, missing;                   /* number of orbits with, and without, a solution next to them */
  double worst, median;                     /* [1] largest and median |amplitude - orbit's|/orbit's over those
                                               solutions */
  double aliasing;                          /* [1] largest |amplitude - that with exact forces and same H|/orbit's */
  double peak_amplitude, peak_omega;        /* of the curve */
  double peak_error, peak_omega_error;      /* [1] relative to accuracy.peak_amplitude, peak_omega */
  int turning_points, false_turning_points; /* false: those in excess of the number with exact forces, same H */
  int rejected;                             /* rejected steps of the continuation */
  long iterations, evaluations;
  double seconds; /* [s] processor time of the thread that made the row */
} accuracy_row;

typedef struct order_row {
  const char *quantity; /* "samples", "harmonics", "regularisation" */
  int harmonics;        /* H of a fit in samples; else 0 */
  double omega;         /* frequency of a fit in regularisation; else NaN */
  order_fit fit;
} order_row;

typedef struct accuracy {
  int n_rows, n_orders;
  accuracy_row *rows;      /* [n_rows] for each H of compare.harmonics exact forces, then compare.samples, ascending */
  order_row *orders;       /* [n_orders] */
  int orbits, frequencies; /* number of reference orbits, and of their frequencies */
  int peak_harmonics;      /* H of the curve from whose peak the reference peak was searched */
  bool peak_by_orbit;      /* the reference peak is of exact orbits; else it is that curve's */
  double peak_amplitude, peak_omega;
} accuracy;

/* The tables of the scene's compare.harmonics and compare.samples over the frequencies of *c, a comparison of the same
 * scene whose orbits are used again. Sampled solutions start from those with exact forces. Runs on setup->jobs threads,
 * whose number does not change the rows; only the calling one ticks *monitor. HC_INTERRUPTED, HC_NO_MEMORY; rows found
 * before are kept. Call accuracy_clear in any case. */
hc_status accuracy_run(const compare_setup *setup, const comparison *c, const hc_monitor *monitor, accuracy *out);
void accuracy_clear(accuracy *a);

/* Order of the regularisation error at the row where it is largest, from rho, rho/4, rho/16, rho/64; no points if there
 * is no such row or the law is exact. */
hc_status order_of_regularisation(const compare_setup *setup, const comparison *c, const hc_monitor *monitor,
                                  order_row *out);
