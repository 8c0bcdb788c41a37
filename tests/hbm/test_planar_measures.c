/* test_planar_measures.c - what a contact with two tangents and one limit does over a period: closed forms on a circle,
 * the law of one tangent on a line, and the work of the traction's harmonics. */
#include "hbm/contact/contact_measures.h"
#include "hbm/planar/planar_force.h"
#include "hbm/planar/planar_measures.h"
#include "tests/hbm/planar_scenes.h"

/* u = a (cos th, sin th), constant N: the slider goes round on sqrt(a^2 - r^2), r = mu N/kt. 1e-13: sums of a few dozen
 * terms of that size. */
static void a_circle_by_its_closed_form(CHECK_STATE)
{
  const contact law = {.kt = 3, .mu = 0.4, .load = 2.5}, half = circle_half(law);
  const double r = 1.0 / 3, a = 0.7, path = 2 * PI * sqrt(a * a - r * r), u1[3] = {0, a, 0}, u2[3] = {0, 0, a},
               v[3] = {0};
  contact_period out[2];
  assert_int_equal(planar_measures_of(&half, 1, u1, u2, v, out), HC_OK);
  assert_int_equal(out[0].regime, CONTACT_SLIPS);
  assert_int_equal(out[1].regime, CONTACT_SLIPS);
  assert_true(out[0].normal_min == 1.25 && out[0].normal_max == 1.25 && out[1].normal_max == 1.25);
  CHECK_NEAR(out[0].traction_max, 1, 1e-14, "traction");
  CHECK_NEAR(out[0].slip_distance, path, 1e-13, "path");
  CHECK_NEAR(out[0].work, path, 1e-13, "work");
  assert_true(out[1].work == 0 && out[1].slip_distance == 0 && out[1].traction_max == 0);
}

/* Stuck, |T| is the largest distance of an ellipse from its slider, here along its long axis. */
static void stuck_it_pulls_as_far_as_it_goes(CHECK_STATE)
{
  const contact half = circle_half((contact){.kt = 3, .mu = 0.4, .load = 25});
  const double c = cos(0.4), s = sin(0.4), u1[5] = {0, 0, 0, 0.9 * c, -0.2 * s}, u2[5] = {0, 0, 0, 0.9 * s, 0.2 * c},
               v[5] = {0};
  contact_period out[2];
  assert_int_equal(planar_measures_of(&half, 2, u1, u2, v, out), HC_OK);
  assert_int_equal(out[0].regime, CONTACT_STUCK);
  CHECK_NEAR(out[0].traction_max, 2.7, 1e-14, "traction");
  assert_true(out[0].work == 0 && out[0].slip_distance == 0);
}

/* Halves of what contact_measures_of says of the whole contact. Traction and path are found as roots and integrals of
 * other functions of the same motion: 1e-12 of them. */
static void on_a_line_it_is_one_tangent(CHECK_STATE)
{
  uint64_t seed = 41;
  double u[CIRCLE_MAX_LENGTH], u1[CIRCLE_MAX_LENGTH], u2[CIRCLE_MAX_LENGTH], v[CIRCLE_MAX_LENGTH];
  for (int trial = 0; trial < 300; ++trial) {
    const int H = 1 + trial % 7, n = series_length(H);
    const contact law = random_circle(&seed), half = circle_half(law);
    const double angle = PI * random_signed(&seed), c = cos(angle), s = sin(angle);
    contact_period pair[2], one;
    random_motion(&seed, H, 1, 1, u);
    random_motion(&seed, H, 1, 1, v);
    for (int i = 0; i < n; ++i) u1[i] = c * u[i], u2[i] = s * u[i];
    assert_int_equal(planar_measures_of(&half, H, u1, u2, v, pair), HC_OK);
    assert_int_equal(contact_measures_of(&law, H, u, v, &one), HC_OK);
    const double size = sum_abs(n, u) + sum_abs(n, v), force = law.kt * size;
    CHECK_NEAR(2 * pair[0].normal_max, one.normal_max, 1e-13 * (one.normal_max + law.kn * size), "trial %d", trial);
    CHECK_NEAR(2 * pair[1].normal_min, one.normal_min, 1e-13 * (one.normal_max + law.kn * size), "trial %d", trial);
    CHECK_NEAR(pair[0].traction_max, one.traction_max, 1e-12 * force, "trial %d", trial);
    CHECK_NEAR(pair[0].slip_distance, one.slip_distance, 1e-12 * size, "trial %d", trial);
    CHECK_NEAR(pair[0].work, one.work, 1e-12 * force * size, "trial %d", trial);
  }
}

/* closed integral T . du = pi sum over h of h (a_T b_u - b_T a_u), whatever the path: of the force's own harmonics. */
static void work_is_that_of_the_traction(CHECK_STATE)
{
  uint64_t seed = 42;
  double X[CIRCLE_MAX_X], F[CIRCLE_MAX_X];
  int slipped = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int H = 1 + trial % 7, n = series_length(H);
    const contact law = random_circle(&seed), half = circle_half(law);
    contact_period out[2];
    double work = 0;
    random_plane_motion(&seed, H, 1, X);
    CHECK_MADE(planar_force, f, planar_force_new(H, law.kn > 0 ? 3 : 2, &half, &f));
    assert_int_equal(planar_force_eval(f, X, F, NULL, NULL), HC_OK);
    assert_int_equal(planar_measures_of(&half, H, X, X + n, X + 2 * n, out), HC_OK);
    for (int d = 0; d < 2; ++d)
      for (int h = 1; h <= H; ++h)
        work += PI * h * (F[d * n + 2 * h - 1] * X[d * n + 2 * h] - F[d * n + 2 * h] * X[d * n + 2 * h - 1]);
    const double size = sum_abs(2 * n, X);
    CHECK_NEAR(out[0].work, work, 1e-12 * H * law.kt * size * size, "trial %d", trial);
    CHECK_LE(out[0].work, out[0].traction_max * out[0].slip_distance * (1 + 1e-12) + 1e-300, "trial %d", trial);
    slipped += out[0].work > 0;
    planar_force_free(f);
  }
  assert_true(slipped > 150);
}

static void what_is_no_motion_is_refused(CHECK_STATE)
{
  const contact half = circle_half((contact){.kt = 3, .mu = 0.4, .load = 2.5});
  const double u[3] = {0, NAN, 0}, v[3] = {0};
  contact_period out[2];
  assert_int_equal(planar_measures_of(&half, 0, v, v, v, out), HC_BAD_INPUT);
  assert_int_equal(planar_measures_of(&half, 1, v, u, v, out), HC_NOT_FINITE);
}

CHECK_TESTS("hbm.planar_measures", 60, a_circle_by_its_closed_form, stuck_it_pulls_as_far_as_it_goes,
            on_a_line_it_is_one_tangent, work_is_that_of_the_traction, what_is_no_motion_is_refused)
