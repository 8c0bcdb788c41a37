/* test_linear.c - the linear oscillator in closed form against the Taylor series of its equation in long double:
 * damping from none to far beyond critical, and within roundings of it; stiffness of either sign, or none. */
#include "tests/check.h"

#include <float.h>

#include "model/linear.h"

/* x, x' after t of x'' + c x' + k x = f from (x, v): steps short for the roots, of which 30 terms leave nothing. */
static void by_series(double c, double k, double f, double t, long double *x, long double *v)
{
  const long double rate = 1 + (long double)c + sqrtl(fabsl((long double)k));
  const int steps = 1 + (int)(2 * rate * t);
  const long double h = (long double)t / steps;
  for (int s = 0; s < steps; ++s) {
    long double d0 = *x, d1 = *v, power = 1, next_x = d0, next_v = d1;
    for (int n = 0; n < 30; ++n) {
      const long double d2 = (n == 0 ? f : 0) - c * d1 - k * d0;
      power *= h / (n + 1);
      next_x += d1 * power, next_v += d2 * power;
      d0 = d1, d1 = d2;
    }
    *x = next_x, *v = next_v;
  }
}

static const double stiffness[] = {0,   1e-17, -1e-17, 1e-9, -1e-9, 0.01, -0.01, 0.09, 0.5,
                                   0.7, -0.5,  1,      2,    -3,    9,    25,    1000, 1e5};
static const double damping[] = {0, 1e-8, 0.01, 0.3, 1, 3, 10, 100, 1e3};
static const double times[] = {1e-8, 1e-3, 0.1, 0.5, 1, 2, 4, 6.28};
enum {
  STIFFNESSES = sizeof stiffness / sizeof *stiffness,
  DAMPINGS = sizeof damping / sizeof *damping,
  TIMES = sizeof times / sizeof *times
};

/* The modulus of the roots, for the rounding of root * t; a root far from the other is not larger than it matters. */
static double rate_of(double c, double k) { return sqrt(fabs(k)) + (c * c < 4 * k ? 0 : fmin(c, 1)); }

/* 4 roundings of an amplitude that grows with e^(rate t), and of the arguments rate t. */
static void check_free(double c, double k, double t, double *worst)
{
  double e[2][2];
  linear_free_motion(1, c, k, t, e);
  const double rate = rate_of(c, k), grow = k < 0 ? exp(sqrt(-k) * t) : 1;
  const double unit = DBL_EPSILON * (1 + rate * t) * grow, by_v = fmin(t, 1 / fmax(rate, 1e-3));
  for (int from = 0; from < 2; ++from) {
    long double x = from == 0, v = from == 1;
    by_series(c, k, 0, t, &x, &v);
    const double size = from == 0 ? 1 : by_v, off = (double)fabsl(e[0][from] - x) / (unit * size);
    const double off_v =
        (double)fabsl(e[1][from] - v) / (unit * (from == 0 ? fmax(fmax(rate, fabs(k) * by_v), 1e-200) : 1));
    *worst = fmax(*worst, fmax(off, off_v));
    CHECK_LE(off, 4, "x from %d, c %.17g k %.17g t %g", from, c, k, t);
    CHECK_LE(off_v, 4, "v from %d, c %.17g k %.17g t %g", from, c, k, t);
  }
}

static void free_motion(CHECK_STATE)
{
  double worst = 0;
  for (int i = 0; i < DAMPINGS; ++i)
    for (int j = 0; j < STIFFNESSES; ++j)
      for (int n = 0; n < TIMES; ++n)
        if (stiffness[j] > -1 || times[n] < 3) check_free(damping[i], stiffness[j], times[n], &worst);
  print_message("worst: %.2f of 4\n", worst);
}

/* Next to critical damping w = sqrt|c^2/4 - k| is rounding: what depends on w^2 is not. */
static void next_to_critical_damping(CHECK_STATE)
{
  double worst = 0;
  for (double k = 1e-3; k < 1e5; k *= 7)
    for (double off = 1e-16; off < 0.5; off *= 9)
      for (int sign = -1; sign <= 1; ++sign)
        for (int n = 0; n < TIMES; ++n) check_free(2 * sqrt(k) * (1 + sign * off), k, times[n], &worst);
  print_message("worst: %.2f of 4\n", worst);
}

/* Relative to s itself where nothing oscillates, to 1/k where it may pass 0. The series loses e^2 to its signs. */
static void step_response(CHECK_STATE)
{
  double worst = 0;
  for (int i = 0; i < DAMPINGS; ++i)
    for (int j = 0; j < STIFFNESSES; ++j)
      for (int n = 0; n < TIMES; ++n) {
        const double c = damping[i], k = stiffness[j], t = times[n];
        if (k < -1 && t > 3) continue;
        long double x = 0, v = 0;
        by_series(c, k, 1, t, &x, &v);
        const double s = linear_step_response(c, k, t), swing = k * t * t > 0.5 && c * c < 8 * k ? 1 / k : 0;
        const double off = fabs(s - (double)x) / (DBL_EPSILON * (1 + rate_of(c, k) * t) * fmax(fabs((double)x), swing));
        worst = fmax(worst, off);
        CHECK_LE(off, 8, "c %g k %g t %g: %.17g", c, k, t, s);
      }
  assert_true(linear_step_response(0.3, 2, 0) == 0 && linear_step_response(0, 0, 3) == 4.5);
  print_message("worst: %.2f of 8\n", worst);
}

CHECK_TESTS("model.linear", 60, free_motion, next_to_critical_damping, step_response)
