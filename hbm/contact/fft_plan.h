/* fft_plan.h - plans of FFTW's real transforms, made and freed under one lock; a series to samples, and back. The
 * planner keeps tables of the whole process and is not thread-safe; executing plans is. Every plan of this program is
 * made here (.ci/layering checks it). Plans are ESTIMATE: made in microseconds, the same on every run, and the arrays
 * keep their contents. */
#pragma once

#include <complex.h> /* before fftw3.h: fftw_complex is C's own type then */

#include <fftw3.h>

#include "numerics/base/status.h"
#include "numerics/base/workspace.h"

/* spectrum[n/2+1] -> samples[n], executing it overwrites the spectrum. HC_NO_MEMORY with *plan = NULL. */
hc_status fft_plan_to_samples(int n, fftw_complex *spectrum, double *samples, fftw_plan *plan);

/* samples[n] -> spectrum[n/2+1]; neither direction is normalised. HC_NO_MEMORY with *plan = NULL. */
hc_status fft_plan_to_spectrum(int n, double *samples, fftw_complex *spectrum, fftw_plan *plan);

/* plan may be NULL. */
void fft_plan_free(fftw_plan plan);

/* ---- samples of a period, at th_i = 2 pi i/n_time, and the series behind them (numerics/series.h) ---- */

typedef struct period_samples {
  int n_harm, n_time;
  double *sample;       /* [n_time] room */
  fftw_complex *spec;   /* [n_time/2+1] */
  double complex *root; /* [n_time] exp(i th_i) */
  fftw_plan to_time, to_freq;
} period_samples;

/* Arrays are memory's; period_samples_clear in any case. HC_NO_MEMORY. */
hc_status period_samples_make(int n_harm, int n_time, workspace *memory, period_samples *out);
void period_samples_clear(period_samples *p);

/* samples[n_time], of a workspace, of the series X[2 n_harm + 1]. */
void period_samples_of(const period_samples *p, const double *X, double *samples);

/* The first n_harm harmonics, any number below n_time, of samples[n_time], of a workspace: out[2 n_harm + 1]. Above
 * n_time/2 a harmonic reads its alias, as the sampled sums themselves do. */
void period_samples_series(const period_samples *p, double *samples, int n_harm, double *out);

/* to[2 n_harm + 1] += weight times what the harmonics are at sample i. */
void period_samples_add(const period_samples *p, double weight, int i, double *to);
