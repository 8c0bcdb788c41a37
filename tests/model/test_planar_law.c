/* test_planar_law.c - the law of two tangents: its branches, the one-dimensional law along any line, and what no
 * rotation of the tangents changes. */
#include <float.h>

#include "model/contact_law.h"
#include "numerics/random.h"
#include "tests/check.h"

/* Dyadic numbers and a 3-4-5 triangle: N = 8, mu N = 2.5 at v = 0.5. */
static const contact law = {.kt = 4, .kn = 8, .mu = 0.3125, .gap = 0.5};

static void separated_lets_go_and_follows(CHECK_STATE)
{
  const double u[2] = {3, -4};
  double w[2] = {7, 8}, T[2] = {9, 9};
  assert_int_equal(contact_step_planar(&law, u, -0.5, w, T), CONTACT_SEPARATED);
  assert_true(w[0] == 3 && w[1] == -4 && T[0] == 0 && T[1] == 0);
}

static void stick_is_a_spring_to_the_slider(CHECK_STATE)
{
  const double u[2] = {1.375, -0.5};
  double w[2] = {1, 0}, T[2];
  assert_int_equal(contact_step_planar(&law, u, 0.5, w, T),
                   CONTACT_STICK); /* |T| = |(1.5, -2)| = 2.5, the limit included */
  assert_true(w[0] == 1 && w[1] == 0 && T[0] == 1.5 && T[1] == -2);
}

static void slip_returns_radially_and_drags_the_slider(CHECK_STATE)
{
  const double u[2] = {2.5, -2};
  double w[2] = {1, 0}, T[2]; /* the predictor (6, -8) is four times as long as the limit */
  assert_int_equal(contact_step_planar(&law, u, 0.5, w, T), CONTACT_SLIP_PLUS);
  assert_true(T[0] == 1.5 && T[1] == -2);
  assert_true(w[0] == 2.125 && w[1] == -1.5);
}

/* Steps along a line of any direction are contact_step's, to the rounding of the projections: each number below is off
 * by at most 8 roundings of the largest, kt (|u| + |w|) <= 16 of forces and 3 of lengths. */
static void along_a_line_it_is_the_law_of_one_tangent(CHECK_STATE)
{
  uint64_t seed = 7;
  for (int i = 0; i < 2000; ++i) {
    const double angle = PI * random_signed(&seed), e[2] = {cos(angle), sin(angle)}, along = 2 * random_signed(&seed),
                 v = random_signed(&seed), start = random_signed(&seed);
    double w1 = start, t1, w[2] = {start * e[0], start * e[1]}, T[2];
    const double u[2] = {along * e[0], along * e[1]};
    const contact_state one = contact_step(&law, along, v, &w1, &t1), two = contact_step_planar(&law, u, v, w, T);
    assert_int_equal(two, one == CONTACT_SLIP_MINUS ? CONTACT_SLIP_PLUS : one);
    for (int d = 0; d < 2; ++d) {
      CHECK_NEAR(T[d], t1 * e[d], 128 * DBL_EPSILON, "T of step %d", i);
      CHECK_NEAR(w[d], w1 * e[d], 32 * DBL_EPSILON, "w of step %d", i);
    }
  }
}

/* A random walk and the same walk turned by an angle stay turned by that angle; |T| never exceeds the limit; and either
 * half of a pair has the whole contact's limit. */
static void nothing_depends_on_the_tangents_or_on_the_half(CHECK_STATE)
{
  uint64_t seed = 11;
  contact half = law;
  half.kn /= 2, half.mu *= 2;
  double w[2] = {0}, turned[2] = {0}, T[2], T_turned[2];
  const double c = cos(1.1), s = sin(1.1);
  for (int i = 0; i < 500; ++i) {
    const double u[2] = {random_signed(&seed), random_signed(&seed)}, v = random_signed(&seed);
    const double u_turned[2] = {c * u[0] - s * u[1], s * u[0] + c * u[1]};
    const contact_state whole = contact_step_planar(&law, u, v, w, T);
    assert_int_equal(contact_step_planar(&half, u_turned, v, turned, T_turned), whole);
    assert_true(half.mu * contact_normal(&half, v) == law.mu * contact_normal(&law, v));
    CHECK_LE(hypot(T[0], T[1]), law.mu * contact_normal(&law, v) * (1 + 4 * DBL_EPSILON), "step %d", i);
    /* the step does not expand distances, so that at most i + 1 steps' roundings of lengths <= 3 add up */
    CHECK_NEAR(turned[0], c * w[0] - s * w[1], 16 * (i + 1) * DBL_EPSILON, "step %d", i);
    CHECK_NEAR(turned[1], s * w[0] + c * w[1], 16 * (i + 1) * DBL_EPSILON, "step %d", i);
  }
}

static void not_a_number_is_no_stick(CHECK_STATE)
{
  double w[2] = {0}, T[2];
  assert_int_not_equal(contact_step_planar(&law, (double[2]){NAN, 0}, 0.5, w, T), CONTACT_STICK);
  assert_true(isnan(T[0]) && isnan(w[0]));
}

CHECK_TESTS("model.planar_law", 30, separated_lets_go_and_follows, stick_is_a_spring_to_the_slider,
            slip_returns_radially_and_drags_the_slider, along_a_line_it_is_the_law_of_one_tangent,
            nothing_depends_on_the_tangents_or_on_the_half, not_a_number_is_no_stick)
