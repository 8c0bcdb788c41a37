/* test_series.c - trigonometric polynomials: values against direct sums, extrema against closed forms, root mean
 * square. eps = DBL_EPSILON throughout. The direct sums are long double (64-bit mantissa on x86): their own error is
 * 2000 times smaller. */
#include "numerics/rotate.h"
#include "tests/hbm/scenes.h"

enum { MAX_COEF = 2 * HBM_MAX_HARMONICS + 1 };

/* The rotation c_{h+1} = c_h c - s_h s is orthogonal but for rounding: the arguments c, s are each off by eps/2, so
 * a step turns by up to eps/sqrt(2) too much or stretches by as much, and its three operations a component add
 * another 1.5 eps: after h steps |error| <= 2.3 h eps, 3 h eps with room. A term then loses 2 eps more by its
 * products, and the sum H eps of its largest partial sum. All told 4 (H + 2) eps sum |X| h^d for the d-th
 * derivative, as h^d |X| are the terms there. */
static void values_agree_with_direct_sums(CHECK_STATE)
{
  static const int orders[] = {0, 1, 2, 5, 20, 50, 200};
  uint64_t seed = 1;
  double X[MAX_COEF];
  for (size_t o = 0; o < sizeof orders / sizeof *orders; ++o)
    for (int trial = 0; trial < 30; ++trial) {
      int H = orders[o];
      random_motion(&seed, H, 1, trial % 3, X);
      double th = PI * random_signed(&seed), c = cos(th), s = sin(th);
      long double x = X[0], d1 = 0, d2 = 0;
      double size[3] = {fabs(X[0]), 0, 0};
      for (int h = 1; h <= H; ++h) {
        long double ch = cosl((long double)h * th), sh = sinl((long double)h * th);
        x += X[2 * h - 1] * ch + X[2 * h] * sh;
        d1 += h * (X[2 * h] * ch - X[2 * h - 1] * sh);
        d2 -= (long double)h * h * (X[2 * h - 1] * ch + X[2 * h] * sh);
        double a = fabs(X[2 * h - 1]) + fabs(X[2 * h]);
        size[0] += a;
        size[1] += h * a;
        size[2] += (double)h * h * a;
      }
      series_jet j = series_at(H, X, c, s);
      double tol = 4 * (H + 2) * DBL_EPSILON;
      CHECK_NEAR(j.x, (double)x, tol * size[0], "x, H=%d th=%g", H, th);
      CHECK_NEAR(j.d1, (double)d1, tol * size[1], "x', H=%d th=%g", H, th);
      CHECK_NEAR(j.d2, (double)d2, tol * size[2], "x'', H=%d th=%g", H, th);
    }
}

/* What an extremum may be off by: th to 1e-9 rad costs |x''| 1e-18/2, and |x''| <= sum h^2 |X|; the rest is the
 * rounding of series_at, above. */
static double extremum_tolerance(int H, const double *X)
{
  double value = fabs(X[0]), curvature = 0;
  for (int h = 1; h <= H; ++h) {
    double a = fabs(X[2 * h - 1]) + fabs(X[2 * h]);
    value += a;
    curvature += (double)h * h * a;
  }
  return 4 * (H + 2) * DBL_EPSILON * value + 0.5e-18 * curvature;
}

/* At 61 time shifts of X, so that the extrema fall everywhere between the grid angles, some of them on one. */
static void check_extrema(const char *what, int H, const double *X, double max, double min)
{
  double Y[MAX_COEF];
  for (int k = 0; k <= 60; ++k) {
    double got_max, got_min;
    shift_motion(H, X, k * 2 * PI / (60.0 * (8 * H + 16)), Y); /* shifting rounds each coefficient to 1 eps or so */
    series_extrema(H, Y, &got_max, &got_min);
    double tol = extremum_tolerance(H, Y);
    CHECK_NEAR(got_max, max, tol, "%s: max, shift %d", what, k);
    CHECK_NEAR(got_min, min, tol, "%s: min, shift %d", what, k);
  }
}

static void a_constant_is_its_own_extremum(CHECK_STATE)
{
  double X[7] = {-0.75}, max, min;
  for (int H = 0; H <= 3; H += 3) {
    series_extrema(H, X, &max, &min);
    assert_true(max == -0.75 && min == -0.75);
  }
}

static void one_harmonic_swings_by_its_modulus(CHECK_STATE)
{
  static const int orders[] = {1, 2, 7, 200};
  double X[MAX_COEF];
  for (size_t o = 0; o < 4; ++o) {
    int H = orders[o];
    memset(X, 0, sizeof X);
    X[0] = 2;
    X[2 * H - 1] = 3;
    X[2 * H] = -4;
    check_extrema("one harmonic", H, X, 2 + 5, 2 - 5);
  }
}

/* cos th + q cos 2 th: the maximum is 1 + q; the minimum is q - 1 at pi while q <= 1/4, else -q - 1/(8 q), twice,
 * beside a local maximum at pi. At q = 1/4 four roots of x' meet. Just above, both minima and the maximum between
 * them fit between two grid angles: x' changes sign once. */
static void extrema_that_coincide(CHECK_STATE)
{
  static const double q[] = {
      0.05,  0.2,  0.249, 0.25, 0.25 * (1 + 1e-8), 0.25 * (1 + 1e-4), 0.25 * (1 + 1e-3), 0.25 * (1 + 4e-3),
      0.252, 0.26, 0.5,   2};
  for (size_t i = 0; i < sizeof q / sizeof *q; ++i) {
    double X[5] = {0, 1, 0, q[i], 0};
    char what[40];
    snprintf(what, sizeof what, "cos + %.17g cos 2", q[i]);
    check_extrema(what, 2, X, 1 + q[i], q[i] <= 0.25 ? q[i] - 1 : -q[i] - 1 / (8 * q[i]));
  }
}

/* Fejer's kernel 1 + 2 sum (1 - h/(H+1)) cos h th = (sin((H+1) th/2)/sin(th/2))^2/(H+1): one peak H + 1, and H
 * double zeros as minima. */
static void fejer_kernel(CHECK_STATE)
{
  static const int orders[] = {1, 2, 5, 20, 200};
  double X[MAX_COEF];
  for (size_t o = 0; o < 5; ++o) {
    int H = orders[o];
    memset(X, 0, sizeof X);
    X[0] = 1;
    for (int h = 1; h <= H; ++h) X[2 * h - 1] = 2 * (1 - h / (H + 1.0));
    check_extrema("Fejer", H, X, H + 1, 0);
  }
}

/* Against the largest of 4096 samples a period: never below a sample, and above the best one by no more than x''
 * step^2/8. */
static void check_against_samples(const char *what, int H, const double *X)
{
  enum { N = 4096 };
  double max, min, best = -INFINITY, least = INFINITY, curvature = 0;
  for (int h = 1; h <= H; ++h) curvature += (double)h * h * hypot(X[2 * h - 1], X[2 * h]);
  for (int i = 0; i < N; ++i) {
    double x = series_at(H, X, cos(2 * PI * i / N), sin(2 * PI * i / N)).x;
    best = larger(best, x);
    least = fmin(least, x);
  }
  series_extrema(H, X, &max, &min);
  double rounding = extremum_tolerance(H, X), step = 2 * PI / N, between = curvature * step * step / 8;
  CHECK_LE(best - max, rounding, "%s", what);
  CHECK_LE(max - best, between + rounding, "%s", what);
  CHECK_LE(min - least, rounding, "%s", what);
  CHECK_LE(least - min, between + rounding, "%s", what);
}

static void no_sample_lies_outside(CHECK_STATE)
{
  uint64_t seed = 2;
  double X[21];
  for (int trial = 0; trial < 100; ++trial) {
    int H = 1 + trial % 10;
    char what[40];
    snprintf(what, sizeof what, "H=%d, trial %d", H, trial);
    random_motion(&seed, H, 1, trial % 3, X);
    check_against_samples(what, H, X);
  }
}

/* Two unequal minima so close together that they fall between two grid angles: x' changes sign once there, and the
 * lower one must win. cos th + q cos 2 th has twin minima at pi +- y, y^2 = 2 (4q - 1) nearly; sin th lifts one of
 * them. */
static void the_lower_of_two_close_minima(CHECK_STATE)
{
  for (int d = 1; d <= 4; ++d)
    for (int tilt = -4; tilt <= 4; ++tilt)
      for (int k = 0; k < 8; ++k) {
        double depth = d * 1e-3, X[5] = {0, 1, 0.2 * tilt * pow(depth, 1.5), 0.25 * (1 + depth), 0}, Y[5];
        char what[80];
        snprintf(what, sizeof what, "4q-1 = %g, tilt %d, shift %d", depth, tilt, k);
        shift_motion(2, X, k * 2 * PI / (8 * 32), Y);
        check_against_samples(what, 2, Y);
      }
}

/* 2H+1 equidistant samples integrate x^2 (degree 2H) exactly: only rounding is left, 4 (H + 2) eps a sample relative
 * to (sum |X|)^2 >= x^2, doubled by squaring; the root halves it and divides by rms. */
static void rms_and_first_harmonic(CHECK_STATE)
{
  static const int orders[] = {0, 1, 3, 50, 200};
  uint64_t seed = 3;
  double X[MAX_COEF];
  for (size_t o = 0; o < 5; ++o) {
    int H = orders[o], n = 2 * H + 1;
    random_motion(&seed, H, 1, 1, X);
    double sum = 0, size = sum_abs(n, X);
    for (int i = 0; i < n; ++i) {
      double x = series_at(H, X, cos(2 * PI * i / n), sin(2 * PI * i / n)).x;
      sum += x * x / n;
    }
    double rms = sqrt(sum);
    CHECK_NEAR(series_rms(H, X), rms, 4 * (H + 2) * DBL_EPSILON * size * size / rms, "H=%d", H);
    CHECK_NEAR(series_harmonic_1(H, X), H ? sqrt(X[1] * X[1] + X[2] * X[2]) : 0, 4 * DBL_EPSILON * size, "H=%d", H);
  }
  double constant[1] = {-3};
  assert_true(series_rms(0, constant) == 3);
}

/* The three roundings of rotate.h, half of one of each cosine and sine of libm, and four of angle + x, which is below
 * 8: nine with room. */
static void rotated_angles(CHECK_STATE)
{
  uint64_t seed = 3;
  for (int trial = 0; trial < 2000; ++trial) {
    const double angle = 2 * PI * random_signed(&seed);
    double x[4], c[4], s[4];
    for (int i = 0; i < 4; ++i) x[i] = trial < 10 ? (i - 1.5) / 1.5 * ROTATE_MOST : ROTATE_MOST * random_signed(&seed);
    rotate(4, cos(angle), sin(angle), x, c, s);
    for (int i = 0; i < 4; ++i) {
      CHECK_NEAR(c[i], cos(angle + x[i]), 9 * DBL_EPSILON, "angle %g + %g", angle, x[i]);
      CHECK_NEAR(s[i], sin(angle + x[i]), 9 * DBL_EPSILON, "angle %g + %g", angle, x[i]);
    }
  }
}

CHECK_TESTS("numerics.series", 60, values_agree_with_direct_sums, a_constant_is_its_own_extremum,
            one_harmonic_swings_by_its_modulus, extrema_that_coincide, fejer_kernel, no_sample_lies_outside,
            the_lower_of_two_close_minima, rms_and_first_harmonic, rotated_angles)
