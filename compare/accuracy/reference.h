/* reference.h - what methods are compared with: the exact law's orbits. For the tables over H and N those at the
 * compared frequencies, and the peak of the response; for the benchmark the one at a frequency as tight as rounding
 * allows, and the solutions at a neighbouring frequency from which all methods start. */
#ifndef HC_REFERENCE_H
#define HC_REFERENCE_H

#include "compare/accuracy/accuracy.h"
#include "compare/accuracy/method.h"

typedef struct target {
  double omega;
  periodic_motion orbit;
} target;

typedef struct reference {
  int n;
  target *targets; /* [n] by frequency */
  int harmonics;   /* of the curve they were looked for from */
  bool peak_by_orbit;
  double peak_amplitude, peak_omega;
} reference;

/* From the curve of `hbm`, whose forces are exact. Free with reference_clear in any case. */
hc_status reference_make(const compare_setup *setup, const comparison *c, hbm_solver *hbm, const hbm_curve *curve,
                         const hc_monitor *monitor, reference *out);
void reference_clear(reference *r);

/* ---- at one frequency ---- */

/* The response curve by harmonic balance, and the exact law's orbits next to it. */
typedef struct finder {
  compare_setup setup; /* with harmonics and forces of the curve; the sweep covers the asked frequencies */
  method_curve response;
  int n_states;
  double *X;                     /* [hbm_n_coefficients] harmonic balance's solution at the frequency under way */
  double *state, *other, *trial; /* [n_states] on the exact orbit there; for what one function needs */
  periodic_motion *motion;       /* [n_responses] of the last exact orbit */
} finder;

/* The curve over the sweep and the asked frequencies. finder_free in any case. */
hc_status finder_start(const compare_setup *setup, const number_list *at, const hc_monitor *monitor, finder *f);
void finder_free(finder *f);

/* That of the compared frequencies where the curve's response is largest. */
hc_status finder_default(finder *f, double *omega);

/* The largest stable response at omega, into *at and *start, of bench_start_new. HC_NOT_CONVERGED: there is none, or no
 * neighbour of it. */
hc_status finder_frequency(finder *f, double omega, const hc_monitor *monitor, bench_frequency *at, bench_start *start);

#endif
