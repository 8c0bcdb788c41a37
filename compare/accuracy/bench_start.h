/* bench_start.h - start and reference of the methods of bench.h: the exact law's orbit at a frequency, as accurate as
 * rounding allows, and the solutions at a neighbouring frequency. Private to compare/accuracy/. */
#pragma once

#include "compare/accuracy/bench.h"
#include "compare/accuracy/method.h"
#include "compare/response.h"
#include "numerics/base/workspace.h"

/* The start and reference of all methods at one frequency. */
typedef struct bench_start { /* from bench_start_new, to bench_start_free */
  workspace memory;          /* of the arrays below */
  double omega, neighbour;   /* [rad/time] */
  int most_coef, n_states, n_responses;
  double *X;     /* [most_coef] [length] HBM solution at the neighbour, in the order of hbm_solver.h, higher harmonics
                    0 */
  double *state; /* [n_states] a state of the exact orbit at the neighbour */
  periodic_motion *reference; /* [n_responses] exact motions at omega */
  double size;                /* [length] largest amplitude of these, to which errors are relative */
} bench_start;

/* Allocates for the model and its solver s. HC_NO_MEMORY. Call bench_start_free in any case. */
hc_status bench_start_new(const model *m, const hbm_solver *s, bench_start *at);
void bench_start_free(bench_start *at);

/* The response curve by harmonic balance, and the exact law's orbits next to it. */
typedef struct finder {
  compare_setup setup; /* the caller's, with the curve's harmonics and forces, and a sweep that covers the given
                          frequencies */
  response_curve response;
  int n_states;
  workspace memory;              /* of the arrays below */
  double *X;                     /* [hbm_n_coefficients] HBM solution at the current frequency */
  double *state, *other, *trial; /* [n_states] a state of the exact orbit there; work */
  periodic_motion *motion;       /* [n_responses] motions of the last exact orbit */
} finder;

/* Traces the curve over the sweep and the given frequencies. Call finder_free in any case. */
hc_status finder_start(const compare_setup *setup, const number_list *at, const hc_monitor *monitor, finder *f);
void finder_free(finder *f);

/* The compared frequency with the largest response of the curve. */
hc_status finder_default(finder *f, double *omega);

/* Fills *at and *start for the largest stable response at omega. HC_NOT_CONVERGED: there is none, or no neighbour of
 * it. */
hc_status finder_frequency(finder *f, double omega, const hc_monitor *monitor, bench_frequency *at, bench_start *start);
