/* trial.h - one method with one choice of settings, made ready at a place and then run as often as it takes. */
#ifndef HC_BENCH_TRIAL_H
#define HC_BENCH_TRIAL_H

#include "campaigns/bench/bench.h"
#include "campaigns/scene_solvers.h"
#include "compare/motion.h"
#include "hbm/hbm.h"
#include "timeint/steady.h"

enum { TRIAL_MOST_COEF = 2 * HBM_MAX_HARMONICS + 1 };

/* What all trials of a place start from. */
typedef struct place_start {
  double omega, neighbour;   /* [rad/time] */
  double X[TRIAL_MOST_COEF]; /* [length] HBM solution at the neighbour, as many harmonics as there are, then zeros */
  scene_state state;         /* on the exact orbit at the neighbour */
  periodic_motion reference; /* at omega */
} place_start;

typedef struct trial {
  bench_row *row; /* the caller's; settings are read, outcome and errors written */
  scene sc;
  hbm_solver *hbm; /* one of the two */
  timeint *ti;
  double X[TRIAL_MOST_COEF]; /* the HBM method's own solution at the neighbour */
  double *seconds;           /* [cap] of each run */
  int runs, cap, batch;      /* batch: solutions a run, so that a run is long enough for the clock */
  double spent;              /* [s] */
} trial;

extern const double trial_slow; /* [s] of a solution: what takes longer is measured by its first run */

/* Ready to run up to cap times, the first run done: errors and outcome are in the row. HC_INTERRUPTED, HC_NO_MEMORY;
 * what goes wrong with the method itself is the row's outcome. Free in any case. */
hc_status trial_start(const scene *sc, const place_start *at, bench_row *row, int cap, const hc_monitor *monitor,
                      trial *t);

/* Once more, timed. */
hc_status trial_run(trial *t, const place_start *at, const hc_monitor *monitor);

/* hbm_exact: what the whole curve takes, into the row; left at NaN when it takes too long. */
hc_status trial_curve(trial *t, const hc_monitor *monitor);

/* Median and quartiles of the runs into the row; frees. */
void trial_finish(trial *t);

/* Median and quartiles of v[n], which is sorted. */
void trial_quartiles(int n, double *v, double *low, double *median, double *high);

#endif
