/* test_shoot.c - orbits as fixed points of the period map, with both laws: in few periods, the same orbit as marching
 * finds, unstable ones too; refused where there is none next to the start. */
#include "tests/check.h"

#include "campaigns/scene_solvers.h"
#include "tests/timeint/scenes.h"
#include "timeint/timeint_private.h"

static timeint *made(scene sc, int law, int steady, int start)
{
  timeint *ti;
  sc.transient.law = law;
  sc.transient.steady = steady;
  sc.transient.start = start;
  assert_int_equal(scene_timeint(&sc, &ti), HC_OK);
  return ti;
}

/* The state y lies within `closure` of the orbit, and a period moves it by I - Phi times that. |Phi| in (x, v/omega) is
 * at most omega_stuck/omega, below 4.1 in the cases here (c2 at 6). A period scatters by up to 1000 times CVODE's final
 * tolerance, which is at most a thousandth of transient.tolerance. Together 6.1 of it. */
static void check_orbit(timeint *ti, double omega, const scene_state *y, const timeint_result *r, double tolerance)
{
  scene_state next = {.x = 0};
  CHECK_LE(r->closure, tolerance, "closure at %g", omega);
  assert_int_equal(timeint_begin(ti, omega, y->all), HC_OK);
  assert_int_equal(timeint_set_tolerance(ti, timeint_final_tolerance(ti)), HC_OK);
  assert_int_equal(timeint_period(ti, false), HC_OK);
  timeint_get_state(ti, next.all);
  CHECK_NEAR(next.x, y->x, 6.1 * tolerance * r->amplitude, "x after a period at %g", omega);
  CHECK_NEAR(next.v, y->v, 6.1 * tolerance * r->amplitude * omega, "v after a period at %g", omega);
}

/* Shooting against marching, with the same law, from the same start: one orbit. Each is within transient.tolerance of
 * it. */
static void finds_what_marching_finds(void **state)
{
  (void)state;
  const struct {
    scene sc;
    double omega;
  } cases[] = {{scene_b10(), 7}, {scene_c2(), 6}, {scene_a10(), 13}, {scene_gap1(), 25}};
  for (int law = TRANSIENT_LAW_REGULARISED; law <= TRANSIENT_LAW_EXACT; ++law)
    for (int i = 0; i < 4; ++i) {
      timeint_result marched, shot;
      timeint *march = made(cases[i].sc, law, TRANSIENT_STEADY_MARCH, TRANSIENT_START_REST);
      timeint *automatic = made(cases[i].sc, law, TRANSIENT_STEADY_AUTO, TRANSIENT_START_REST);
      scene_state y = {.x = 0}, z = y;
      assert_int_equal(timeint_steady(march, cases[i].omega, y.all, NULL, &marched), HC_OK);
      assert_int_equal(timeint_steady(automatic, cases[i].omega, z.all, NULL, &shot), HC_OK);
      const double tolerance = 2 * cases[i].sc.transient.tolerance;
      CHECK_NEAR(shot.amplitude, marched.amplitude, tolerance * marched.amplitude, "law %d case %d", law, i);
      CHECK_NEAR(shot.a1, marched.a1, tolerance * marched.amplitude, "law %d case %d a1", law, i);
      CHECK_NEAR(shot.b1, marched.b1, tolerance * marched.amplitude, "law %d case %d b1", law, i);
      assert_int_equal(marched.method, TIMEINT_BY_MARCHING);
      assert_int_equal(shot.method, TIMEINT_BY_SHOOTING);
      CHECK_LE(shot.periods, 0.7 * marched.periods, "law %d case %d periods", law, i);
      check_orbit(automatic, cases[i].omega, &z, &shot, cases[i].sc.transient.tolerance);
      timeint_free(automatic);
      timeint_free(march);
    }
}

/* From 1 % off the orbit: Newton doubles the digits each iteration, a period an iteration with the exact law. What
 * damping allows a march in one period is 1 - exp(-C T/2M) = 0.1 % of the way (r2). */
static void few_periods_whatever_the_damping(void **state)
{
  (void)state;
  const struct {
    scene sc;
    double omega, from;
    int most;
  } cases[] = {{scene_c2(), 9, 7, 20}, {scene_r2(), 708.5, 700, 60}};
  for (int i = 0; i < 2; ++i) {
    timeint *ti = made(cases[i].sc, TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_AUTO, TRANSIENT_START_UP);
    timeint_result r;
    scene_state y = {.x = 0};
    assert_int_equal(timeint_sweep(ti, cases[i].from, cases[i].omega, y.all, NULL), HC_OK);
    assert_int_equal(timeint_steady(ti, cases[i].omega, y.all, NULL, &r), HC_OK);
    timeint_free(ti);
    ti = made(cases[i].sc, TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_AUTO, TRANSIENT_START_HBM);
    y.x *= 1.01;
    assert_int_equal(timeint_steady(ti, cases[i].omega, y.all, NULL, &r), HC_OK);
    CHECK_LE(r.periods, cases[i].most, "case %d", i);
    CHECK_LE(r.closure, 1e-9, "case %d", i);
    CHECK_LE(r.multiplier, 1, "case %d", i);
    timeint_free(ti);
  }
}

/* Stuck all period: the slider may rest anywhere in an interval. It stays where it is; the mean depends on it, and
 * nothing else does. x = (steady) + kt c w/(K + kt c^2 + kn s^2) with w at rest. */
static void a_free_slider_is_left_alone(void **state)
{
  (void)state;
  const scene sc = scene_a10();
  const double offset[] = {0, 0.02, -0.05}, c = sqrt(0.5), share = 100 * c / (40 + 100 * 0.5 + 200 * 0.5);
  for (int law = TRANSIENT_LAW_REGULARISED; law <= TRANSIENT_LAW_EXACT; ++law)
    for (int i = 0; i < 3; ++i) {
      timeint *ti = made(sc, law, TRANSIENT_STEADY_SHOOTING, TRANSIENT_START_REST);
      timeint_result r;
      scene_state y = {.x = 0.15 + share * offset[i], .w = {offset[i]}};
      assert_int_equal(timeint_orbit(ti, 12, 1, y.all, NULL, &r), HC_OK);
      assert_int_equal(r.free_sliders, 1);
      CHECK_NEAR(r.amplitude, 0.216217353374, 1e-9, "law %d", law);
      CHECK_NEAR(r.mean, share * offset[i], 1e-9, "law %d offset %g", law, offset[i]);
      CHECK_NEAR(y.w[0], offset[i], 1e-15, "law %d offset %g", law, offset[i]);
      timeint_free(ti);
    }
}

/* Case 2 has three orbits at 9: the two outer are stable, the one between is a saddle, with a real multiplier beyond
 * 1. Shooting finds each from 10 % off, says which it is, and reports none where none is next to the start. */
static void unstable_orbits_are_found_and_named(void **state)
{
  (void)state;
  const scene sc = scene_c2();
  const struct {
    double x, v, w;
    int stable;
  } orbits[] = {{-2.42, 1.91, -1.71, 1}, {-20.5, 78.8, -14.5, -1}};
  timeint *ti = made(sc, TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_SHOOTING, TRANSIENT_START_HBM);
  timeint_result r;
  for (int i = 0; i < 2; ++i)
    for (int way = 0; way < 4; ++way) {
      const double off_x = way & 1 ? 1.1 : 0.9, off_v = way & 2 ? 1.1 : 0.9;
      scene_state y = {.x = orbits[i].x * off_x, .v = orbits[i].v * off_v, .w = {orbits[i].w}};
      assert_int_equal(timeint_orbit(ti, 9, 1, y.all, NULL, &r), HC_OK);
      assert_int_equal(timeint_stability(&r), orbits[i].stable);
      CHECK_LE(r.closure, 1e-9, "orbit %d", i);
      CHECK_NEAR(y.x, orbits[i].x, 5e-3 * fabs(orbits[i].x), "orbit %d, to the digits above", i);
      if (orbits[i].stable < 0) CHECK_NEAR(r.multiplier_im, 0, 0, "a saddle");
    }
  scene_state far = {.x = 8, .v = 300};
  assert_int_equal(timeint_orbit(ti, 9, 1, far.all, NULL, &r), HC_NOT_CONVERGED);
  timeint_free(ti);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(finds_what_marching_finds),
      cmocka_unit_test(few_periods_whatever_the_damping),
      cmocka_unit_test(a_free_slider_is_left_alone),
      cmocka_unit_test(unstable_orbits_are_found_and_named),
  };
  check_watchdog(120);
  return cmocka_run_group_tests_name("timeint.shoot", tests, NULL, NULL);
}
