/* fft_plan.c - see fft_plan.h. */
#include "hbm/contact/fft_plan.h"

#include <pthread.h>

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
