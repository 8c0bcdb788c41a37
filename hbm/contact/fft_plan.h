/* fft_plan.h - plans of FFTW's real transforms, made and freed under one lock. The planner keeps tables of the whole
 * process and is not thread-safe; executing plans is. Every plan of this program is made here
 * (.ci/layering checks it). Plans are ESTIMATE: made in microseconds, the same on every run, and the arrays keep their
 * contents. */
#ifndef HC_FFT_PLAN_H
#define HC_FFT_PLAN_H

#include <complex.h> /* before fftw3.h: fftw_complex is C's own type then */

#include <fftw3.h>

#include "base/status.h"

/* spectrum[n/2+1] -> samples[n], executing it overwrites the spectrum. HC_NO_MEMORY with *plan = NULL. */
hc_status fft_plan_to_samples(int n, fftw_complex *spectrum, double *samples, fftw_plan *plan);

/* samples[n] -> spectrum[n/2+1]; neither direction is normalised. HC_NO_MEMORY with *plan = NULL. */
hc_status fft_plan_to_spectrum(int n, double *samples, fftw_complex *spectrum, fftw_plan *plan);

/* plan may be NULL. */
void fft_plan_free(fftw_plan plan);

#endif
