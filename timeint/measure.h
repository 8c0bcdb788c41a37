/* measure.h - what is reported of one or several successive periods, from CVODE's dense output.
 *
 * Peaks: roots of v, bracketed inside each step (a pair of them by an extremum of v of the other sign), refined to
 * rounding; x there errs by second order in the root. The wave: x at TIMEINT_WAVE equispaced instants. Mean, rms and
 * first harmonic are sums over these; x has a continuous second derivative, its harmonics fall like h^-4, so what
 * folds over from 512 and up is below 512^-4 = 1.5e-11 of x. */
#ifndef HC_TIMEINT_MEASURE_H
#define HC_TIMEINT_MEASURE_H

#include "timeint/integrate.h"
#include "timeint/timeint.h"

typedef struct measure { /* lengths in units of the model's L, until measure_report */
  const scaled_model *m;
  int periods;                    /* begun so far                                            */
  int next;                       /* index of the next instant of the wave                   */
  double y[SCALED_MAX_STATES], a; /* state and P' at the end of the last step         */
  double max, min;
  double sum, sum_sq, sum_cos, sum_sin; /* over the instants                         */
  bool slides;                          /* some contact slid at the end of some step               */
  double wave[TIMEINT_WAVE];
} measure;

void measure_begin(measure *me, const scaled_model *m);

/* y: state at the start of a period. Then hand measure_step and me to integrate_period. */
void measure_period(measure *me, const double *y);
hc_status measure_step(void *self, const integrator *in, double theta0, double theta1);

/* max, min, amplitude, rms, mean, a1, b1, harmonic_1, wave (of the last period) and regime into *r; L = length. */
void measure_report(const measure *me, const model *from, double length, timeint_result *r);

#endif
