/* test_fft_plan.c - every call of FFTW's planner is made under one and the same lock, and the plans do what fft_plan.h
 * promises. The linker wraps the planner and the locks, so that the test sees which lock is held. */

#include "compare/study/scene_solvers.h"
#include "hbm/contact/fft_plan.h"
#include "tests/check.h"
#include "tests/oscillator.h"
#include "tests/wrap.h"

static const pthread_mutex_t *held, *planner; /* the lock held now, or NULL; the lock held at the first call */
static int calls, unguarded;

WRAP(int, pthread_mutex_lock, (pthread_mutex_t * lock))
{
  held = lock;
  return __real_pthread_mutex_lock(lock);
}

WRAP(int, pthread_mutex_unlock, (pthread_mutex_t * lock))
{
  held = NULL;
  return __real_pthread_mutex_unlock(lock);
}

static void note_call(void)
{
  if (!planner) planner = held;
  unguarded += !held || held != planner;
  ++calls;
}

WRAP(fftw_plan, fftw_plan_dft_c2r_1d, (int n, fftw_complex *from, double *to, unsigned flags))
{
  note_call();
  return __real_fftw_plan_dft_c2r_1d(n, from, to, flags);
}

WRAP(fftw_plan, fftw_plan_dft_r2c_1d, (int n, double *from, fftw_complex *to, unsigned flags))
{
  note_call();
  return __real_fftw_plan_dft_r2c_1d(n, from, to, flags);
}

WRAP(void, fftw_destroy_plan, (fftw_plan plan))
{
  note_call();
  __real_fftw_destroy_plan(plan);
}

/* Two plans made and freed by a contact of aft.c, two by hand. */
static void one_lock_guards_the_planner(CHECK_STATE)
{
  scene sc = scene_oscillator(1, 0, 1, 0);
  fftw_complex spectrum[3];
  double samples[4];
  scene_add_contact(&sc, (scene_contact){{.kt = 1, .kn = 1, .mu = 0.3}, 45});
  calls = unguarded = 0;
  CHECK_MADE(contact_forces, a, scene_forces(&sc, HBM_FORCE_SAMPLED, 1, 4, &a));
  CHECK_FILLED(fftw_plan, there, fft_plan_to_samples(4, spectrum, samples, &there));
  CHECK_FILLED(fftw_plan, back, fft_plan_to_spectrum(4, samples, spectrum, &back));
  contact_forces_free(a);
  fft_plan_free(there);
  fft_plan_free(back);
  fft_plan_free(NULL);
  assert_int_equal(calls, 2 * 4);
  assert_int_equal(unguarded, 0);
}

/* 1 + 2 cos th - 6 sin th at four samples: 3, -5, -1, 7; sums of small integers and no others, so exact. */
static void plans_transform_both_ways(CHECK_STATE)
{
  static const double expected[4] = {3, -5, -1, 7};
  fftw_complex spectrum[3] = {1, 1 + 3 * I, 0};
  double samples[4];
  CHECK_FILLED(fftw_plan, there, fft_plan_to_samples(4, spectrum, samples, &there));
  CHECK_FILLED(fftw_plan, back, fft_plan_to_spectrum(4, samples, spectrum, &back));
  fftw_execute(there);
  for (int i = 0; i < 4; ++i) assert_true(samples[i] == expected[i]);
  fftw_execute(back);
  assert_true(spectrum[0] == 4 && spectrum[1] == 4 + 12 * I && spectrum[2] == 0);
  fft_plan_free(there);
  fft_plan_free(back);
}

CHECK_TESTS("hbm.fft_plan", 60, one_lock_guards_the_planner, plans_transform_both_ways)
