/* scipy.h - the same steady state by scipy's LSODA without events, a script that python3 runs. */
#pragma once

#include "compare/accuracy/bench_start.h"

enum { SCIPY_MOST_RUNS = 8, SCIPY_MOST_REPEATS = 32 };

typedef struct scipy_run {
  double rtol, amplitude, harmonic_1; /* [1], [length] */
  int n;
  double seconds[SCIPY_MOST_REPEATS]; /* of processor time inside the process, around solve_ivp alone */
} scipy_run;

/* For one degree of freedom (model_is_oscillator): from the same state as the others, marched until 1e-9 of the
 * start's distance is left (by `multiplier`, a period).
 * Into runs, *n of them, and words for people in text[96]: versions, or why there is nothing. No python3 or scipy is
 * HC_OK with *n = 0. $PYTHON says which python3. It gets a few seconds; what it did until then counts.
 * HC_INTERRUPTED, HC_NO_MEMORY. */
hc_status scipy_lsoda(const model *m, const bench_start *at, double multiplier, int repeats, const hc_monitor *monitor,
                      scipy_run *runs, int *n, char text[96]);
