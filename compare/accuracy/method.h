/* method.h - one method with one choice of settings: what it finds, how far that is from the reference, and what it
 * costs. The tables over H and N (accuracy.c) and the benchmark at one frequency (bench.c) are made of these. */
#ifndef HC_ACCURACY_METHOD_H
#define HC_ACCURACY_METHOD_H

#include "compare/accuracy/bench.h"
#include "compare/motion.h"
#include "hbm/hbm.h"
#include "timeint/steady/steady.h"

/* *setup with the method's settings: harmonics and samples (0: as they are) of harmonic balance, or the regularisation
 * (NaN: exact law) and tolerance of time integration. */
compare_setup method_setup(const compare_setup *setup, bench_method method, int harmonics, int samples,
                           double regularisation, double tolerance);

/* A response curve and its price. */
typedef struct method_curve {
  hbm_solver *hbm; /* NULL where it could not be made */
  hbm_curve curve;
  hc_status status; /* how it ended */
  double seconds;   /* of processor time */
} method_curve;

/* By harmonic balance over the sweep, widened to the compared frequencies. HC_NO_MEMORY, HC_INTERRUPTED; else HC_OK,
 * with the curve as far as it goes. method_curve_free in any case. */
hc_status method_curve_trace(const compare_setup *setup, const hc_monitor *monitor, method_curve *out);
void method_curve_free(method_curve *c);

/* The largest of each difference between n motions and their references, over `size`; NaN stays. */
motion_distance method_error(int n, const periodic_motion *found, const periodic_motion *reference, double size);

/* Median and quartiles of v[n], which is sorted; NaN of none. */
void method_quartiles(int n, double *v, double *low, double *median, double *high);

/* ---- timed at one frequency ---- */

/* What all methods start from there. */
typedef struct bench_start { /* from bench_start_new, to bench_start_free */
  double omega, neighbour;   /* [rad/time] */
  int most_coef, n_states, n_responses;
  double *X;     /* [most_coef] [length] HBM solution at the neighbour, as many harmonics as there are, then
                                 zeros: coefficient by coefficient (hbm_solver.h) */
  double *state; /* [n_states] on the exact orbit at the neighbour */
  periodic_motion *reference; /* [n_responses] at omega */
  double size;                /* [length] the largest amplitude of these: what errors are relative to */
} bench_start;

/* For the harmonic balance of the model; HC_NO_MEMORY, *at is to be freed then, too. */
hc_status bench_start_new(const model *m, const hbm_solver *s, bench_start *at);
void bench_start_free(bench_start *at);

typedef struct timed_method {
  bench_row *row; /* the caller's; settings are read, outcome and errors written */
  compare_setup setup;
  hbm_solver *hbm; /* one of the two */
  timeint *ti;
  double *X, *trial;       /* [most_coef] the HBM method's own solution at the neighbour; the one at omega */
  double *state;           /* [n_states] */
  periodic_motion *motion; /* [n_responses] of the last solution */
  double *seconds;         /* [cap] of each run */
  int runs, cap, batch;    /* batch: solutions a run, so that a run is long enough for the clock */
  double spent;            /* [s] */
} timed_method;

extern const double timed_method_slow; /* [s] of a solution: what takes longer is measured by its first run */

/* Ready to run up to cap times, the first run done: errors and outcome are in the row. HC_INTERRUPTED, HC_NO_MEMORY;
 * what goes wrong with the method itself is the row's outcome. Free in any case. */
hc_status timed_method_start(const compare_setup *setup, const bench_start *at, bench_row *row, int cap,
                             const hc_monitor *monitor, timed_method *t);

/* Once more, timed. */
hc_status timed_method_run(timed_method *t, const bench_start *at, const hc_monitor *monitor);

/* hbm_exact: what the whole curve takes, into the row; left at NaN when it takes too long. */
hc_status timed_method_curve(timed_method *t, const hc_monitor *monitor);

/* Median and quartiles of the runs into the row; frees. */
void timed_method_finish(timed_method *t);

#endif
