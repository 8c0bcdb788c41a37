/* test_contact_law.c - the exact contact law, branch by branch, and what holds between branches. */
#include <float.h>

#include "tests/cases/case_text.h"
#include "tests/scene_parts.h"

/* Dyadic numbers: every product and sum below is exact, so equality is asked for. */
static const contact law = {.kt = 4, .kn = 8, .mu = 0.25, .gap = 0.5};

static void separated_lets_go_and_follows(CHECK_STATE)
{
  double w = 7, t = 9;
  assert_int_equal(contact_step(&law, 3, -1, &w, &t), CONTACT_SEPARATED);
  assert_true(w == 3 && t == 0);
  w = 7, t = 9;
  assert_int_equal(contact_step(&law, 3, -0.5, &w, &t), CONTACT_SEPARATED); /* v + gap = 0: N = 0 */
  assert_true(w == 3 && t == 0);
  assert_true(contact_normal(&law, -0.5) == 0 && contact_normal(&law, -1) == 0 && contact_normal(&law, 0.5) == 8);
  assert_true(contact_preload(&law) == 4);
  assert_true(contact_preload(&(contact){.kn = 8, .gap = -0.5}) == 0);
}

static void stick_is_a_spring_to_the_slider(CHECK_STATE)
{
  double w = 1, t; /* N = 8, limit 2, so |u - w| <= 0.5 sticks, the limit included */
  assert_int_equal(contact_step(&law, 1.25, 0.5, &w, &t), CONTACT_STICK);
  assert_true(w == 1 && t == 1);
  assert_int_equal(contact_step(&law, 1.5, 0.5, &w, &t), CONTACT_STICK);
  assert_true(w == 1 && t == 2);
  assert_int_equal(contact_step(&law, 0.5, 0.5, &w, &t), CONTACT_STICK);
  assert_true(w == 1 && t == -2);
}

static void slip_holds_the_limit_and_drags_the_slider(CHECK_STATE)
{
  double w = 1, t;
  assert_int_equal(contact_step(&law, 3, 0.5, &w, &t), CONTACT_SLIP_PLUS);
  assert_true(t == 2 && w == 2.5);
  assert_int_equal(contact_step(&law, -3, 0.5, &w, &t), CONTACT_SLIP_MINUS);
  assert_true(t == -2 && w == -2.5);
  assert_int_equal(contact_slip_sign(CONTACT_SLIP_PLUS), 1);
  assert_int_equal(contact_slip_sign(CONTACT_SLIP_MINUS), -1);
  assert_int_equal(contact_slip_sign(CONTACT_STICK), 0);
  assert_int_equal(contact_slip_sign(CONTACT_SEPARATED), 0);
}

static void no_tangential_spring_means_no_friction_force(CHECK_STATE)
{
  contact c = law;
  double w = 1, t = 5;
  c.kt = 0;
  assert_int_equal(contact_step(&c, 100, 0.5, &w, &t), CONTACT_STICK);
  assert_true(t == 0 && w == 1);
  c.mu = 0; /* 0 <= 0: still no division by kt = 0 */
  assert_int_equal(contact_step(&c, 100, 0.5, &w, &t), CONTACT_STICK);
  assert_true(t == 0 && w == 1);
  assert_int_equal(contact_step(&c, 100, -1, &w, &t), CONTACT_SEPARATED);
  assert_true(t == 0 && w == 100);
}

static void no_friction_slips_with_the_slider_on_the_mass(CHECK_STATE)
{
  contact c = law;
  double w = 1, t = 5;
  c.mu = 0;
  assert_int_equal(contact_step(&c, 3, 0.5, &w, &t), CONTACT_SLIP_PLUS);
  assert_true(t == 0 && w == 3);
  assert_int_equal(contact_step(&c, 2, 0.5, &w, &t), CONTACT_SLIP_MINUS);
  assert_true(t == 0 && w == 2);
}

static void touching_decides_by_the_velocities(void **state)
{
  (void)state; /* kt du against mu kn dv = 2 dv */
  assert_int_equal(contact_on_touch(&law, 1, 1), CONTACT_SLIP_PLUS);
  assert_int_equal(contact_on_touch(&law, -1, 1), CONTACT_SLIP_MINUS);
  assert_int_equal(contact_on_touch(&law, 0.5, 1), CONTACT_STICK); /* equal: sticks */
  assert_int_equal(contact_on_touch(&law, -0.5, 1), CONTACT_STICK);
  assert_int_equal(contact_on_touch(&law, 0, 1), CONTACT_STICK);
}

/* For one slider position T = clamp(kt (u - w), +-mu N(v)), so |T1 - T2| <= kt |u1 - u2| + mu kn |v1 - v2| across
 * every transition, separation included. Rounding: each T is off by at most 3 eps (kt (|u| + |w|) + mu kn (|v| +
 * |gap|)), below 60 eps with the numbers drawn here; two of them make 120 eps. Steps of 0.1 cross every limit often. */
static void force_has_no_jump(CHECK_STATE)
{
  uint64_t s = 1;
  int states[4] = {0};
  for (int i = 0; i < 20000; ++i) {
    contact c = {
        .kt = 4 * random_unit(&s), .kn = 4 * random_unit(&s), .mu = random_unit(&s), .gap = 2 * random_unit(&s) - 1};
    double w = 2 * random_unit(&s) - 1, w1 = w, w2 = w, u = 2 * random_unit(&s) - 1, v = 2 * random_unit(&s) - 1;
    double step = 0.1, du = step * (2 * random_unit(&s) - 1), dv = step * (2 * random_unit(&s) - 1), t1, t2;
    contact_state a = contact_step(&c, u, v, &w1, &t1), b = contact_step(&c, u + du, v + dv, &w2, &t2);
    CHECK_LE(fabs(t2 - t1), c.kt * fabs(du) + c.mu * c.kn * fabs(dv) + 120 * DBL_EPSILON, "i=%d", i);
    if (a != b) ++states[a];
  }
  for (int i = 0; i < 4; ++i) assert_true(states[i] > 0); /* transitions of every kind were met */
}

/* A small step h after touching, u = u0 + du h, v = -gap + dv h, w = u0, is in the state that contact_on_touch
 * predicts. kt du h and mu kn dv h scale alike, so only draws within rounding of equality could differ; those are left
 * out. */
static void touching_agrees_with_the_step_after_it(CHECK_STATE)
{
  uint64_t s = 3;
  int seen[4] = {0};
  for (int i = 0; i < 20000; ++i) {
    contact c = {.kt = 4 * random_unit(&s), .kn = 4 * random_unit(&s), .mu = random_unit(&s), .gap = 0};
    double du = 2 * random_unit(&s) - 1, dv = random_unit(&s) + 0x1p-20, h = 0x1p-10, w = 0, t;
    if (fabs(c.kt * fabs(du) - c.mu * c.kn * dv) < 1e-12) continue;
    contact_state st = contact_on_touch(&c, du, dv);
    assert_int_equal(contact_step(&c, du * h, dv * h, &w, &t), st);
    ++seen[st];
  }
  assert_true(seen[CONTACT_STICK] > 0 && seen[CONTACT_SLIP_PLUS] > 0 && seen[CONTACT_SLIP_MINUS] > 0);
}

/* Constant limit fc = mu kn gap (v = 0): a cycle of amplitude A loses 4 fc (A - fc/k). k = 1, fc = 1/2, A = 1: 1.
 * Steps of 1/8 put each kink (|u - u_turn| = 2 fc/k = 1) on a step, T is linear in between, and all numbers are
 * dyadic: the sum is exact. */
static void jenkins_loses_the_closed_form_energy(CHECK_STATE)
{
  contact c = {.kt = 1, .kn = 1, .mu = 0.5, .gap = 1};
  double w = 0, t, before, loss = 0;
  contact_step(&c, 1, 0, &w, &before); /* at the upper turn, slipped: w = 1/2 */
  assert_true(w == 0.5 && before == 0.5);
  for (int i = 1; i <= 32; ++i) {
    double du = i <= 16 ? -0.125 : 0.125, u = i <= 16 ? 1 - 0.125 * i : -1 + 0.125 * (i - 16);
    contact_step(&c, u, 0, &w, &t);
    loss += (before + t) / 2 * du;
    before = t;
  }
  assert_true(loss == 1.0 && w == 0.5);
}

static void geometry_is_exact_at_the_ends(CHECK_STATE)
{
  double c, s;
  scene_contact k = {.law = {.kt = 100, .kn = 1000}, .angle_deg = 0};
  scene_direction(&k, &c, &s);
  assert_true(c == 1 && s == 0);
  k.angle_deg = 90;
  scene_direction(&k, &c, &s);
  assert_true(c == 0 && s == 1 && scene_stuck_stiffness(&k) == 1000);
  k.angle_deg = 45;
  /* (kt + kn)/2; the angle's rounding moves cos^2 and sin^2 by opposite 2 eps, theirs add 2 eps each: 1100 * 4 eps
   * is ample */
  CHECK_NEAR(scene_stuck_stiffness(&k), 550, 1100 * 4 * DBL_EPSILON, "45 degrees");
  scene sc = scene_oscillator(1, 0, 40, 0);
  for (int j = 0; j < 2; ++j) scene_add_contact(&sc, k);
  CHECK_NEAR(scene_max_stiffness(&sc), 1140, 2400 * 4 * DBL_EPSILON, "two contacts");
}

static void names_are_those_of_the_columns(CHECK_STATE)
{
  assert_string_equal(contact_regime_name(CONTACT_LINEAR), "linear");
  assert_string_equal(contact_regime_name(CONTACT_STUCK), "stick");
  assert_string_equal(contact_regime_name(CONTACT_SLIPS), "slip");
  assert_string_equal(contact_regime_name(CONTACT_SEPARATES), "separation");
}

CHECK_TESTS("cases.contact_law", 60, separated_lets_go_and_follows, stick_is_a_spring_to_the_slider,
            slip_holds_the_limit_and_drags_the_slider, no_tangential_spring_means_no_friction_force,
            no_friction_slips_with_the_slider_on_the_mass, touching_decides_by_the_velocities, force_has_no_jump,
            touching_agrees_with_the_step_after_it, jenkins_loses_the_closed_form_energy, geometry_is_exact_at_the_ends,
            names_are_those_of_the_columns)
