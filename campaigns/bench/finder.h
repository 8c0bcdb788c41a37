/* finder.h - finds what methods are compared with at a frequency: the reference orbit there, and the solutions at a
 * neighbouring frequency from which all methods start. */
#ifndef HC_BENCH_FINDER_H
#define HC_BENCH_FINDER_H

#include "campaigns/bench/timed_method.h"

/* The response curve by harmonic balance, and the exact law's orbits next to it. */
typedef struct finder {
  scene sc; /* with harmonics and forces of the curve */
  model *model;
  hbm_solver *hbm;
  hbm_curve curve;
  int n_states;
  double *X;                     /* [hbm_n_coefficients] harmonic balance's solution at the frequency under way */
  double *state, *other, *trial; /* [n_states] on the exact orbit there; for what one function needs */
  periodic_motion *motion;       /* [n_responses] of the last exact orbit */
} finder;

/* The curve over the scene's sweep and the asked frequencies. finder_free in any case. */
hc_status finder_start(const scene *sc, const number_list *at, const hc_monitor *monitor, finder *f);
void finder_free(finder *f);

/* That of the scene's compare frequencies where the curve's response is largest. */
hc_status finder_default(finder *f, double *omega);

/* The largest stable response at omega, into *at and *start, which has room. HC_NOT_CONVERGED: there is none, or no
 * neighbour of it. */
hc_status finder_frequency(finder *f, double omega, const hc_monitor *monitor, bench_frequency *at, bench_start *start);

#endif
