/* test_acceleration.c - x'' from the equation of motion, against motions x = A cos(th) for which it is known: with
 * C = 0, M x'' = (F0 - K A) c - f(A c), c = cos(th), which has its extrema at c = -1, c = 1 or a kink of f. They need
 * not be solutions. */
#include "base/constants.h"
#include "compare/verify/acceleration.h"
#include "tests/check.h"

/* x = amplitude cos, from sliders at 0. */
static double acceleration(const model *m, double amplitude)
{
  const double X[3] = {0, amplitude, 0};
  const verify_motion motion = verify_motion_of(2, 1, X);
  double room[8] = {0};
  assert_true(acceleration_room(m) <= 8);
  return acceleration_amplitude(m, &motion, room);
}

/* 1e-8 of a sample beside a kink, 1.5e-11 rad, costs at most that times the slope; rounding of golden sections around a
 * smooth extremum is of second order. 1e-10 of the largest force covers both. */
#define CLOSE 1e-10

/* A solution of the linear oscillator: amplitude omega^2 A. */
static void without_contact(void **state)
{
  (void)state;
  const double M = 3, C = 0.5, K = 7, omega = 2, F = 10, real = K - M * omega * omega, imaginary = C * omega,
               size = real * real + imaginary * imaginary;
  const model m = {.mass = M, .damping = C, .stiffness = K, .force = F};
  const double X[3] = {0, F * real / size, F * imaginary / size};
  const verify_motion motion = verify_motion_of(omega, 1, X);
  double room[1];
  CHECK_NEAR(acceleration_amplitude(&m, &motion, room), omega * omega * F / sqrt(size), CLOSE * F / M, "linear");
}

/* f = max(-1 + 2 c, 0), F0 - K A = 1: c from -1 to the kink at 1/2, and down to 0 at c = 1: from -1 to 1/2. */
static void unilateral_spring_has_its_kink(void **state)
{
  (void)state;
  model_contact spring = {.law = {.kn = 1, .gap = -1}, .tangent = 0, .normal = 1};
  const model m = {.mass = 1, .stiffness = 1, .force = 3, .n_contacts = 1, .contacts = &spring};
  CHECK_NEAR(acceleration(&m, 2), 0.75, CLOSE * 3, "kink");
}

/* Case 2's contact never slips: f = 550 max(10 c - sqrt(50), 0). F0 - K A = 90: the kink is the largest, c = 1 the
 * least. The slider that restarts on the sample after the touch is up to A 2 pi/4096 off, kt times which is 1 in
 * 1500. */
static void a_slider_restarts_at_the_touch(void **state)
{
  (void)state;
  const double half = sqrt(0.5);
  model_contact joint = {.law = {.kt = 100, .kn = 1000, .mu = 0.3, .gap = -5}, .tangent = half, .normal = half};
  const model m = {.mass = 1, .stiffness = 1, .force = 100, .n_contacts = 1, .contacts = &joint};
  const double highest = 90 * half, lowest = 90 - 550 * (10 - sqrt(50));
  CHECK_NEAR(acceleration(&m, 10), 0.5 * (highest - lowest), CLOSE * 5500, "case 2");
}

/* A Jenkins element on its own, F0 = K A: x'' is -T/M, and |T| reaches mu N0 both ways, once the slider has settled. */
static void friction_reaches_its_limit(void **state)
{
  (void)state;
  model_contact joint = {.law = {.kt = 10, .kn = 2, .mu = 0.5, .gap = 3}, .tangent = 1, .normal = 0};
  const model m = {.mass = 2, .stiffness = 4, .force = 8, .n_contacts = 1, .contacts = &joint};
  CHECK_NEAR(acceleration(&m, 2), 1.5, CLOSE * 8, "mu N0/M");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_contact),
      cmocka_unit_test(unilateral_spring_has_its_kink),
      cmocka_unit_test(a_slider_restarts_at_the_touch),
      cmocka_unit_test(friction_reaches_its_limit),
  };
  check_watchdog(60);
  return cmocka_run_group_tests_name("verify.acceleration", tests, NULL, NULL);
}
