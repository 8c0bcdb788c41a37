/* test_acceleration.c - x'' from the equation of motion, against motions x = A cos(th) for which it is known: with
 * C = 0, M x'' = (F0 - K A) c - f(A c), c = cos(th), which has its extrema at c = -1, c = 1 or a kink of f. They need
 * not be solutions. */
#include "compare/verify/truth/truth.h"
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

static model *in_contact(double M, double K, double F, const contact *law, double tangent, double normal)
{
  CHECK_MADE(model, m, model_oscillator(M, 0, K, F, 1, &m));
  m->contacts[0].law = *law;
  *m->contacts[0].tangent = tangent;
  *m->contacts[0].normal = normal;
  return m;
}

/* 1e-8 of a sample beside a kink, 1.5e-11 rad, costs at most that times the slope; rounding of golden sections around a
 * smooth extremum is of second order. 1e-10 of the largest force covers both. */
#define CLOSE 1e-10

/* A solution of the linear oscillator: amplitude omega^2 A. */
static void without_contact(CHECK_STATE)
{
  const double M = 3, C = 0.5, K = 7, omega = 2, F = 10, real = K - M * omega * omega, imaginary = C * omega,
               size = real * real + imaginary * imaginary;
  CHECK_MADE(model, m, model_oscillator(M, C, K, F, 0, &m));
  const double X[3] = {0, F * real / size, F * imaginary / size};
  const verify_motion motion = verify_motion_of(omega, 1, X);
  double room[1];
  CHECK_NEAR(acceleration_amplitude(m, &motion, room), omega * omega * F / sqrt(size), CLOSE * F / M, "linear");
  model_free(m);
}

/* f = max(-1 + 2 c, 0), F0 - K A = 1: c from -1 to the kink at 1/2, and down to 0 at c = 1: from -1 to 1/2. */
static void unilateral_spring_has_its_kink(CHECK_STATE)
{
  const contact spring = {.kn = 1, .gap = -1};
  model *m = in_contact(1, 1, 3, &spring, 0, 1);
  CHECK_NEAR(acceleration(m, 2), 0.75, CLOSE * 3, "kink");
  model_free(m);
}

/* Case 2's contact never slips: f = 550 max(10 c - sqrt(50), 0). F0 - K A = 90: the kink is the largest, c = 1 the
 * least. The slider that restarts on the sample after the touch is up to A 2 pi/4096 off, kt times which is 1 in
 * 1500. */
static void a_slider_restarts_at_the_touch(CHECK_STATE)
{
  const double half = sqrt(0.5);
  const contact joint = {.kt = 100, .kn = 1000, .mu = 0.3, .gap = -5};
  model *m = in_contact(1, 1, 100, &joint, half, half);
  const double highest = 90 * half, lowest = 90 - 550 * (10 - sqrt(50));
  CHECK_NEAR(acceleration(m, 10), 0.5 * (highest - lowest), CLOSE * 5500, "case 2");
  model_free(m);
}

/* A Jenkins element on its own, F0 = K A: x'' is -T/M, and |T| reaches mu N0 both ways, once the slider has settled. */
static void friction_reaches_its_limit(CHECK_STATE)
{
  const contact joint = {.kt = 10, .kn = 2, .mu = 0.5, .gap = 3};
  model *m = in_contact(2, 4, 8, &joint, 1, 0);
  CHECK_NEAR(acceleration(m, 2), 1.5, CLOSE * 8, "mu N0/M");
  model_free(m);
}

CHECK_TESTS("verify.acceleration", 60, without_contact, unilateral_spring_has_its_kink, a_slider_restarts_at_the_touch,
            friction_reaches_its_limit)
