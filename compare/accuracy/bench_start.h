/* bench_start.h - what the methods of bench.h start from and are compared with: the exact law's orbit at a frequency,
 * as tight as rounding allows, and the solutions at a neighbouring one. Private to compare/accuracy/. */
#pragma once

#include "compare/accuracy/bench.h"
#include "compare/accuracy/method.h"
#include "compare/response.h"
#include "numerics/base/workspace.h"

/* What all methods start from there. */
typedef struct bench_start { /* from bench_start_new, to bench_start_free */
  workspace memory;          /* of the arrays below */
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

/* The response curve by harmonic balance, and the exact law's orbits next to it. */
typedef struct finder {
  compare_setup setup; /* with harmonics and forces of the curve; the sweep covers the asked frequencies */
  response_curve response;
  int n_states;
  workspace memory;              /* of the arrays below */
  double *X;                     /* [hbm_n_coefficients] harmonic balance's solution at the frequency under way */
  double *state, *other, *trial; /* [n_states] on the exact orbit there; for what one function needs */
  periodic_motion *motion;       /* [n_responses] of the last exact orbit */
} finder;

/* The curve over the sweep and the asked frequencies. finder_free in any case. */
hc_status finder_start(const compare_setup *setup, const number_list *at, const hc_monitor *monitor, finder *f);
void finder_free(finder *f);

/* That of the compared frequencies where the curve's response is largest. */
hc_status finder_default(finder *f, double *omega);

/* The largest stable response at omega. HC_NOT_CONVERGED: there is none, or no neighbour of it. */
hc_status finder_frequency(finder *f, double omega, const hc_monitor *monitor, bench_frequency *at, bench_start *start);
