/* fft_plan.c - see fft_plan.h. FFTW does not normalise and uses exp(-i): the 2/N and the sign of the sine are here,
 * nowhere else. */
#include "hbm/contact/fft_plan.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/room.h"

static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

/* FFTW's planner aborts if an allocation of its own fails. What it allocates grows with n, so room for 64 n bytes is
 * asked for. */
static bool room_for_plan(int n) { return hc_room_for(64 * (size_t)n); }

hc_status fft_plan_to_samples(int n, fftw_complex *spectrum, double *samples, fftw_plan *plan)
{
  *plan = NULL;
  if (!room_for_plan(n)) return HC_NO_MEMORY;
  pthread_mutex_lock(&planner);
  *plan = fftw_plan_dft_c2r_1d(n, spectrum, samples, FFTW_ESTIMATE);
  pthread_mutex_unlock(&planner);
  return *plan ? HC_OK : HC_NO_MEMORY;
}

hc_status fft_plan_to_spectrum(int n, double *samples, fftw_complex *spectrum, fftw_plan *plan)
{
  *plan = NULL;
  if (!room_for_plan(n)) return HC_NO_MEMORY;
  pthread_mutex_lock(&planner);
  *plan = fftw_plan_dft_r2c_1d(n, samples, spectrum, FFTW_ESTIMATE);
  pthread_mutex_unlock(&planner);
  return *plan ? HC_OK : HC_NO_MEMORY;
}

void fft_plan_free(fftw_plan plan)
{
  if (!plan) return;
  pthread_mutex_lock(&planner);
  fftw_destroy_plan(plan);
  pthread_mutex_unlock(&planner);
}

hc_status period_samples_make(int n_harm, int n_time, workspace *memory, period_samples *out)
{
  const size_t n = (size_t)n_time;
  period_samples *p = out;
  *p = (period_samples){.n_harm = n_harm, .n_time = n_time};
  p->sample = workspace_doubles(memory, n);
  p->spec = workspace_array(memory, n / 2 + 1, sizeof *p->spec);
  p->root = workspace_array(memory, n, sizeof *p->root);
  if (memory->failed) return HC_NO_MEMORY;
  const double step = TWO_PI / n_time;
  for (int i = 0; i < n_time; ++i) p->root[i] = cos(i * step) + I * sin(i * step);
  const hc_status st = fft_plan_to_samples(n_time, p->spec, p->sample, &p->to_time);
  return st == HC_OK ? fft_plan_to_spectrum(n_time, p->sample, p->spec, &p->to_freq) : st;
}

void period_samples_clear(period_samples *p)
{
  fft_plan_free(p->to_time);
  fft_plan_free(p->to_freq);
}

void period_samples_of(const period_samples *p, const double *X, double *samples)
{
  memset(p->spec + p->n_harm, 0, ((size_t)(p->n_time / 2 - p->n_harm) + 1) * sizeof *p->spec);
  p->spec[0] = X[0];
  for (int h = 1; h <= p->n_harm; ++h) p->spec[h] = 0.5 * (X[2 * h - 1] - I * X[2 * h]);
  fftw_execute_dft_c2r(p->to_time, p->spec, samples);
}

void period_samples_series(const period_samples *p, double *samples, int n_harm, double *out)
{
  const int n = p->n_time;
  fftw_execute_dft_r2c(p->to_freq, samples, p->spec);
  out[0] = creal(p->spec[0]) / n;
  for (int h = 1; h <= n_harm; ++h) {
    const double complex z = h <= n / 2 ? p->spec[h] : conj(p->spec[n - h]);
    out[2 * h - 1] = 2 * creal(z) / n;
    out[2 * h] = -2 * cimag(z) / n;
  }
}

void period_samples_add(const period_samples *p, double weight, int i, double *to)
{
  int at = 0; /* h times the sample, modulo n_time */
  if (weight == 0) return;
  to[0] += weight;
  for (int h = 1; h <= p->n_harm; ++h) {
    if ((at += i) >= p->n_time) at -= p->n_time;
    to[2 * h - 1] += weight * creal(p->root[at]);
    to[2 * h] += weight * cimag(p->root[at]);
  }
}
