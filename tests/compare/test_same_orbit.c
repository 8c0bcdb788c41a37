/* test_same_orbit.c - budget_same_orbit, on two motions made up so that the answer is plain. */
#include "compare/budget.h"
#include "tests/check.h"

/* 2 cos(omega t), settled and stable. */
static timeint_result settled(void)
{
  timeint_result r = {.amplitude = 2, .harmonic_1 = 2, .period_multiple = 1, .multiplier = 0.5};
  for (int i = 0; i < TIMEINT_WAVE; ++i) r.wave[i] = 2 * cos(2 * PI * i / TIMEINT_WAVE);
  return r;
}

/* budget.h: a twentieth of the amplitude, 0.1 here, at any one instant. 1 % on either side of it. */
static void a_twentieth_of_the_amplitude_apart(CHECK_STATE)
{
  const timeint_result a = settled();
  timeint_result b = a;
  assert_true(budget_same_orbit(&a, &b));
  b.wave[200] = a.wave[200] + 0.099;
  assert_true(budget_same_orbit(&a, &b) && budget_same_orbit(&b, &a));
  b.wave[200] = a.wave[200] - 0.101;
  assert_true(!budget_same_orbit(&a, &b) && !budget_same_orbit(&b, &a));
  b.wave[200] = NAN;
  assert_false(budget_same_orbit(&a, &b));
}

/* A slider that rests elsewhere moves the mean, and nothing else. */
static void a_free_mean_is_no_other_orbit(CHECK_STATE)
{
  const timeint_result a = settled();
  timeint_result b = a;
  for (int i = 0; i < TIMEINT_WAVE; ++i) b.wave[i] += 1;
  b.mean = 1;
  assert_false(budget_same_orbit(&a, &b));
  b.free_sliders = 1;
  assert_true(budget_same_orbit(&a, &b));
}

/* A stable orbit and an unstable one, or one of another period, are two, however near. Of unknown stability: one. */
static void stability_and_period_tell_orbits_apart(CHECK_STATE)
{
  const timeint_result a = settled();
  timeint_result b = a;
  b.multiplier = 1.5;
  assert_false(budget_same_orbit(&a, &b));
  b.multiplier = NAN;
  assert_true(budget_same_orbit(&a, &b));
  b = a;
  b.period_multiple = 2;
  assert_false(budget_same_orbit(&a, &b));
}

/* The relative difference of amplitudes, of the same orbit only. */
static void regularisation_is_of_one_orbit(CHECK_STATE)
{
  const timeint_result orbit = settled();
  timeint_result regularised = orbit;
  regularised.amplitude = 1.75;
  assert_true(budget_regularisation(&regularised, &orbit) == 0.125);
  regularised.period_multiple = 2;
  assert_true(isnan(budget_regularisation(&regularised, &orbit)));
}

CHECK_TESTS("compare.same_orbit", 60, a_twentieth_of_the_amplitude_apart, a_free_mean_is_no_other_orbit,
            stability_and_period_tell_orbits_apart, regularisation_is_of_one_orbit)
