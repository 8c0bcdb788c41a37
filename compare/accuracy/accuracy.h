/* accuracy.h - error and cost of HBM over truncation orders H and samples N (accuracy_run), and the orders at which
 * errors fall with N, H and the regularisation (order_fit). Not here: one solution's discrepancy (compare/budget.h). */
#pragma once

#include "compare/compare_settings.h"
#include "compare/comparison.h"
#include "numerics/base/status.h"

/* e ~ c x^-order over the points `from` <= x <= `to`, by least squares on logarithms. */
typedef struct order_fit {
  double order, spread; /* spread: standard error; NaN for less than three points; order NaN for less than two */
  double from, to;
  int points;
} order_fit;

enum { ORDER_MOST_POINTS = 512 };

/* x[n] ascending > 0, larger is finer; error e[n] >= 0 [1], NaN where there is none; n <= ORDER_MOST_POINTS. The line
 * is fitted to the envelope, the largest error at this x or a finer one, since an aliasing error is erratic and may be
 * small by chance. Points are used where the envelope is below 0.1 and above `floor`; of these the k finest, k >= 3,
 * that give the narrowest 95 % interval for the order, so that coarse points before the asymptotic range are left
 * out. */
order_fit order_fit_to(int n, const double *x, const double *e, double floor);

/* One pair (H, N), over the frequencies of the comparison and the referee's orbits there. NaN: not known. */
typedef struct accuracy_row {
  int harmonics, samples;                   /* samples 0: exact forces */
  bool possible;                            /* N >= 2 H + 2 */
  hc_status status;                         /* how the response curve ended */
  int solutions, missing;                   /* orbits that have a solution next to them; that have none */
  double worst, median;                     /* [1] |amplitude - orbit's|/orbit's over those solutions */
  double aliasing;                          /* [1] largest |amplitude - exact forces'|, same H */
  double peak_amplitude, peak_omega;        /* of the curve */
  double peak_error, peak_omega_error;      /* [1] against the exact transient's peak */
  int turning_points, false_turning_points; /* more than with exact forces, same H */
  int rejected;                             /* steps of the continuation */
  long iterations, evaluations;
  double seconds; /* of the processor time of the thread that made the row */
} accuracy_row;

typedef struct order_row {
  const char *quantity; /* "samples", "harmonics", "regularisation" */
  int harmonics;        /* samples: at this H; else 0 */
  double omega;         /* regularisation: at this frequency; else NaN */
  order_fit fit;
} order_row;

typedef struct accuracy {
  int n_rows, n_orders;
  accuracy_row *rows;      /* [n_rows] harmonics of compare.harmonics; in each exact forces, then compare.samples,
                         ascending */
  order_row *orders;       /* [n_orders] */
  int orbits, frequencies; /* what is compared with */
  int peak_harmonics;      /* the reference peak was looked for from that of the curve with so many */
  bool peak_by_orbit;      /* and found on the exact transient's own orbits; else it is that curve's */
  double peak_amplitude, peak_omega;
} accuracy;

/* The tables of the scene's compare.harmonics and compare.samples over the frequencies of *c, a comparison of the
 * same scene whose orbits are used again. Each solution is computed once; the sampled ones start from those with
 * exact forces. By setup->jobs threads, with the same rows whatever their number; only the calling one ticks *monitor.
 * HC_INTERRUPTED, HC_NO_MEMORY; rows found until then are kept. Free with accuracy_clear in any case. */
hc_status accuracy_run(const compare_setup *setup, const comparison *c, const hc_monitor *monitor, accuracy *out);
void accuracy_clear(accuracy *a);

/* At the row where it matters most, from rho, rho/4, rho/16, rho/64; no points without one or by the exact law. */
hc_status order_of_regularisation(const compare_setup *setup, const comparison *c, const hc_monitor *monitor,
                                  order_row *out);
