/* test_verdicts.c - motions that are not of the forcing's period, on case 2 with the exact law: where the period-1
 * orbit loses its stability, and what the motion becomes. Figures: docs/measurements, from
 * another program and from AUTO. */
#include "tests/check.h"

#include "tests/timeint/scenes.h"

static scene exactly(scene sc)
{
  sc.transient.law = TRANSIENT_LAW_EXACT;
  return sc;
}

static scene case2(void) { return exactly(scene_c2()); }
static scene stiff(void) { return exactly(scene_c2kn1e4()); }

/* Up from 4, where only the period-1 orbit is stable, to omega; the orbit followed by shooting, stable or not. */
static scene_state followed_to(timeint *ti, double from, double omega, timeint_result *r)
{
  scene_state y = {.x = 0};
  assert_int_equal(timeint_sweep(ti, from, from, y.all, NULL), HC_OK);
  for (double at = from; at != omega;) {
    double step = 5e-3 * (omega > from ? 1 : -1);
    at = fabs(omega - at) <= fabs(step) ? omega : at + step;
    assert_int_equal(timeint_orbit(ti, at, 1, y.all, NULL, r), HC_OK);
  }
  return y;
}

/* omega between low and high where the multiplier is -1, by the secant rule. */
static double doubling(const scene *sc, double from, double low, double high)
{
  timeint_result r;
  double at[2] = {low, high}, f[2];
  scene_state y;
  CHECK_MADE(timeint, ti, scene_timeint(sc, &ti));
  for (int i = 0; i < 2; ++i) {
    y = followed_to(ti, from, at[i], &r);
    f[i] = r.multiplier_re + 1;
  }
  assert_true((f[0] < 0) != (f[1] < 0));
  for (int i = 0; i < 30 && fabs(at[1] - at[0]) > 1e-8; ++i) {
    double next = at[1] - f[1] * (at[1] - at[0]) / (f[1] - f[0]);
    assert_int_equal(timeint_orbit(ti, next, 1, y.all, NULL, &r), HC_OK);
    at[0] = at[1], f[0] = f[1];
    at[1] = next, f[1] = r.multiplier_re + 1;
  }
  timeint_free(ti);
  return at[1];
}

/* The references have 6 decimals; 1e-5 is asked. */
static void multiplier_passes_minus_one(CHECK_STATE)
{
  scene c2 = case2(), kn = stiff();
  CHECK_NEAR(doubling(&c2, 6, 5.107, 5.1055), 5.106167, 1e-5, "case 2, lower");
  CHECK_NEAR(doubling(&c2, 6, 5.58, 5.56), 5.569782, 1e-5, "case 2, upper");
  CHECK_NEAR(doubling(&kn, 6.5, 6.05, 6.03), 6.036792, 1e-5, "kn = 1e4");
}

/* Above the doubling the period-1 orbit is where the motion goes. */
static void period_1_above(CHECK_STATE)
{
  scene sc = stiff();
  timeint_result r;
  sc.transient.start = TRANSIENT_START_HBM;
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  scene_state y = followed_to(ti, 6.5, 6.05, &r);
  assert_int_equal(timeint_steady(ti, 6.05, y.all, NULL, &r), HC_OK);
  assert_int_equal(r.period_multiple, 1);
  assert_int_equal(timeint_stability(&r), 1);
  assert_false(r.left_orbit);
  timeint_free(ti);
}

/* Left to itself next to the unstable period-1 orbit. */
static void becomes(const scene *sc, double omega, int multiple, bool aperiodic)
{
  timeint_result r;
  CHECK_MADE(timeint, ti, scene_timeint(sc, &ti));
  scene_state y = followed_to(ti, 6.5, omega, &r);
  assert_int_equal(timeint_stability(&r), -1);
  y.x *= 1.001;
  hc_status st = timeint_steady(ti, omega, y.all, NULL, &r);
  assert_int_equal(st, aperiodic ? HC_APERIODIC : HC_OK);
  assert_int_equal(r.period_multiple, multiple);
  assert_true(r.left_orbit);
  if (aperiodic) CHECK_LE(1e-2, r.lyapunov, "at %g", omega);
  else CHECK_LE(r.multiplier, 1, "at %g", omega);
  timeint_free(ti);
}

static void sub_harmonics_of_case_2(CHECK_STATE)
{
  scene sc = case2();
  sc.transient.start = TRANSIENT_START_HBM;
  becomes(&sc, 5.56, 2, false);
  becomes(&sc, 5.54, 4, false);
  becomes(&sc, 5.4, 0, true);
}

static void sub_harmonics_with_a_stiff_contact(CHECK_STATE)
{
  scene sc = stiff();
  sc.transient.start = TRANSIENT_START_HBM;
  becomes(&sc, 5.3, 2, false);
  becomes(&sc, 5.8, 0, true);
}

/* At 5.11 a period-3 attractor coexists with the period-4 one that is reached by sweeping up. */
static void swept_up_to_period_4(CHECK_STATE)
{
  scene sc = case2();
  sc.transient.start = TRANSIENT_START_UP;
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  scene_state y = {.x = 0};
  assert_int_equal(timeint_sweep(ti, 4, 5.11, y.all, NULL), HC_OK);
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, 5.11, y.all, NULL, &r));
  assert_int_equal(r.period_multiple, 4);
  timeint_free(ti);
}

CHECK_TESTS("timeint.verdicts", 120, multiplier_passes_minus_one, period_1_above, sub_harmonics_of_case_2,
            sub_harmonics_with_a_stiff_contact, swept_up_to_period_4)
