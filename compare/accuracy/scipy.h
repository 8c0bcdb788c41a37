/* scipy.h - the steady state by scipy's LSODA without events, in a script run by python3. */
#pragma once

#include "compare/accuracy/bench_start.h"

enum { SCIPY_MOST_RUNS = 8, SCIPY_MOST_REPEATS = 32 };

typedef struct scipy_run {
  double rtol, amplitude, harmonic_1; /* [1] tolerance; [length] */
  int n;
  double seconds[SCIPY_MOST_REPEATS]; /* [s] processor time of solve_ivp in the process */
} scipy_run;

/* For one degree of freedom (model_is_oscillator): starts from the same state as the other methods, and marches until
 * the distance to the orbit, which decays by `multiplier` per period, is 1e-9 of the first. *n results in runs;
 * text[96] for people: versions, or why there are none. Without python3 or scipy: HC_OK with *n = 0. $PYTHON names the
 * python3. Results within a few seconds count. HC_INTERRUPTED, HC_NO_MEMORY. */
hc_status scipy_lsoda(const model *m, const bench_start *at, double multiplier, int repeats, const hc_monitor *monitor,
                      scipy_run *runs, int *n, char text[96]);
