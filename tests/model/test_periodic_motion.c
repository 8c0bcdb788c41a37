/* test_periodic_motion.c - measures, harmonics and distances of motions whose answers are known in closed form. */
#include "model/periodic_motion.h"

#include <float.h>

#include "tests/check.h"

/* x = m + A cos(th - p) + C cos(2 th - q): mean m, a1 + i b1 = A exp(i p), rms^2 = m^2 + (A^2 + C^2)/2. */
static const double mean = 0.3, first = 2, second = 0.5, phase = 0.7, twice = -1.1;

static void fill_series(double X[5])
{
  X[0] = mean;
  X[1] = first * cos(phase), X[2] = first * sin(phase);
  X[3] = second * cos(twice), X[4] = second * sin(twice);
}

static double value_at(double th) { return mean + first * cos(th - phase) + second * cos(2 * th - twice); }

/* Every number is a sum of at most five terms of size 2: 8 units of rounding of 2 each. A sample adds the rounding of
 * its angle, up to 2 pi, times |x'| <= A + 2 C = 3: 4 more. */
static void a_series_has_its_measures(CHECK_STATE)
{
  const double tol = 16 * DBL_EPSILON, max = 2.25, min = -1.75; /* as given: extrema are the caller's */
  double X[5];
  fill_series(X);
  const periodic_motion m = motion_of_series(2, X, max, min);
  CHECK_NEAR(m.amplitude, 2, 0, "half of 2.25 + 1.75");
  assert_true(m.max == max && m.min == min && !m.mean_free);
  CHECK_NEAR(m.mean, mean, tol, "mean");
  CHECK_NEAR(m.rms, sqrt(mean * mean + 0.5 * (first * first + second * second)), tol, "rms");
  CHECK_NEAR(m.a1, first * cos(phase), tol, "a1");
  CHECK_NEAR(m.b1, first * sin(phase), tol, "b1");
  CHECK_NEAR(m.harmonic_1, first, tol, "|a1 + i b1|");
  for (int i = 0; i < MOTION_SAMPLES; ++i)
    CHECK_NEAR(m.samples[i], value_at(2 * PI * i / MOTION_SAMPLES), 2 * tol, "sample %d", i);
  const periodic_motion still = motion_of_series(0, X, mean, mean);
  assert_true(still.amplitude == 0 && still.a1 == 0 && still.b1 == 0 && still.harmonic_1 == 0);
}

/* The highest harmonic that 512 samples may hold beside n_harm others is 511 - n_harm: it folds onto n_harm + 1. With
 * one more it folds onto n_harm itself, its cosine unchanged. Sums of 512 products of size 2, each rounded: the worst
 * case is 512 units of rounding, halved by the factor 2/512 and doubled by the size. */
static void harmonics_come_back_from_samples(CHECK_STATE)
{
  enum { H = 6 };
  const double tol = 2 * MOTION_SAMPLES * DBL_EPSILON, high = 0.25;
  double X[5], found[2 * H + 1];
  fill_series(X);
  periodic_motion m = motion_of_series(2, X, 0, 0);
  for (int i = 0; i < MOTION_SAMPLES; ++i)
    m.samples[i] += high * cos(2 * PI * (double)((MOTION_SAMPLES - 1 - H) * i % MOTION_SAMPLES) / MOTION_SAMPLES);
  motion_harmonics(&m, H, found);
  for (int k = 0; k < 2 * H + 1; ++k) CHECK_NEAR(found[k], k < 5 ? X[k] : 0, tol, "coefficient %d", k);
  double folded[2 * (H + 1) + 1];
  motion_harmonics(&m, H + 1, folded);
  CHECK_NEAR(folded[2 * H + 1], high, tol, "harmonic 505 is harmonic 7 on 512 samples");
}

/* b is a moved by 0.25 and with one sample moved 0.5 farther: by dyadic numbers, so that nothing is rounded. */
static void the_mean_counts_unless_it_is_free(CHECK_STATE)
{
  periodic_motion a = {.amplitude = 2, .harmonic_1 = 1.5, .mean = 0.5}, b = a;
  for (int i = 0; i < MOTION_SAMPLES; ++i) a.samples[i] = 0.5 + i % 8, b.samples[i] = a.samples[i] + 0.25;
  b.samples[77] += 0.5;
  b.mean += 0.25;
  b.amplitude = 2.5;
  b.harmonic_1 = 1;
  motion_distance d = motion_between(&a, &b);
  assert_true(d.amplitude == 0.5 && d.harmonic_1 == 0.5 && d.mean == 0.25 && d.waveform == 0.75);
  for (int side = 0; side < 2; ++side) {
    a.mean_free = side == 0, b.mean_free = side == 1;
    d = motion_between(&a, &b);
    assert_true(d.waveform == 0.5 && d.mean == 0.25);
    d = motion_between(&b, &a);
    assert_true(d.waveform == 0.5 && d.mean == 0.25);
  }
}

static void a_sample_that_is_no_number_is_no_distance(CHECK_STATE)
{
  periodic_motion a = {.amplitude = 1}, b = a;
  b.samples[300] = NAN; /* larger differences before and after it */
  b.samples[10] = 5, b.samples[400] = 7;
  assert_true(isnan(motion_between(&a, &b).waveform) && isnan(motion_between(&b, &a).waveform));
}

CHECK_TESTS("model.periodic_motion", 60, a_series_has_its_measures, harmonics_come_back_from_samples,
            the_mean_counts_unless_it_is_free, a_sample_that_is_no_number_is_no_distance)
