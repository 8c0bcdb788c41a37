/* test_chaos.c - what is called aperiodic, and what is not. Case 2 with the exact law, swept up: the cascade of period
 * doublings that begins at 5.106167 and the bands of chaos behind it, which are narrow: the state returns within a few
 * percent of itself after each period. */
#include "tests/check.h"

#include "tests/timeint/scenes.h"
#include "timeint/steady/aperiodic.h"
#include "timeint/steady/timeint_private.h"

static scene case2(void)
{
  scene sc = scene_c2();
  sc.transient.law = TRANSIENT_LAW_EXACT;
  sc.transient.method = TRANSIENT_METHOD_CLOSED_FORM;
  sc.transient.start = TRANSIENT_START_UP;
  return sc;
}

static hc_status swept_up(const scene *sc, double omega, timeint_result *r)
{
  CHECK_MADE(timeint, ti, scene_timeint(sc, &ti));
  scene_state y = {.x = 0};
  assert_int_equal(timeint_sweep(ti, 4, omega, y.all, NULL), HC_OK);
  hc_status st = timeint_steady(ti, omega, y.all, NULL, r);
  timeint_free(ti);
  return st;
}

/* Exponents by another program: the bilinear oscillator that case 2 is (docs/theory.md), its tangent carried along in
 * closed form over 4000 periods: 0.150 +- 0.003 at 5.13, 0.1555 +- 0.004 at 5.14 (standard errors). Here at least 640
 * periods are averaged: standard errors sqrt(4000/640) = 2.5 times as large, 0.0075 and 0.01; four of them. At 5.2 and
 * 5.4 the bands have merged. */
static void narrow_bands(CHECK_STATE)
{
  static const double at[][3] = {{5.13, 0.150, 0.030}, {5.14, 0.1555, 0.040}, {5.2, 0.2, 0.2}, {5.4, 0.2, 0.2}};
  scene sc = case2();
  for (size_t i = 0; i < sizeof at / sizeof *at; ++i) {
    timeint_result r;
    assert_int_equal(swept_up(&sc, at[i][0], &r), HC_APERIODIC);
    assert_int_equal(r.period_multiple, 0);
    CHECK_NEAR(r.lyapunov, at[i][1], at[i][2], "at %g", at[i][0]);
  }
}

/* The same through the laws and ways that people use; CVODE by itself takes seconds and is left to test_verdicts.c. */
static void narrow_bands_whoever_integrates(CHECK_STATE)
{
  static const transient_start start[] = {TRANSIENT_START_UP, TRANSIENT_START_HBM};
  for (int law = 0; law < 2; ++law)
    for (int k = 0; k < 2; ++k) {
      scene sc = scene_c2();
      sc.transient.law = law ? TRANSIENT_LAW_EXACT : TRANSIENT_LAW_REGULARISED;
      sc.transient.scout = true;
      sc.transient.start = start[k];
      timeint_result r;
      assert_int_equal(swept_up(&sc, 5.13, &r), HC_APERIODIC);
      CHECK_LE(0.1, r.lyapunov, "law %d, start %d", law, k);
    }
}

/* Between the bands, and below and above them, the motion repeats itself. */
static void cascade_and_windows(CHECK_STATE)
{
  static const struct {
    double omega;
    int multiple;
  } at[] = {{5.107, 2}, {5.11, 4}, {5.115, 8}, {5.51, 16}, {5.52, 8}, {5.53, 4}, {5.55, 2}};
  scene sc = case2();
  for (size_t i = 0; i < sizeof at / sizeof *at; ++i) {
    CHECK_FILLED(timeint_result, r, swept_up(&sc, at[i].omega, &r));
    if (r.period_multiple != at[i].multiple) print_error("at %g: %d periods\n", at[i].omega, r.period_multiple);
    assert_int_equal(r.period_multiple, at[i].multiple);
    CHECK_LE(r.multiplier, 1 - 1e-3, "at %g", at[i].omega);
  }
}

/* A motion on its way from the unstable orbit next to the fold: neighbours drift apart by a factor 1.004 a period, as
 * steadily as can be, for all of the first 640 periods, and there is no chaos in it. From next to the orbit nothing is
 * said at once: the motion goes on, and is asked again later. */
static void leaving_an_orbit_is_not_chaos(CHECK_STATE)
{
  static const double off[] = {1e-6, 3e-4, 1e-3, 2e-3, 3e-3, 5e-3};
  scene sc = case2();
  timeint_result r;
  sc.transient.start = TRANSIENT_START_UP;
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  /* Next to the fold at 9.21 a stable orbit and an unstable one meet, multipliers 1 - s and 1 + s: what is left of the
   * unstable one's distance to it is linear in s, so two stable orbits tell where it is. */
  scene_state y = {.x = 0}, before;
  double s = 0, s_before = 0;
  assert_int_equal(timeint_sweep(ti, 6, 9.2, y.all, NULL), HC_OK);
  for (int i = 0; i <= 20; ++i) {
    before = y, s_before = s;
    assert_int_equal(timeint_orbit(ti, 9.2 + (9.2095 - 9.2) * i / 20, 1, y.all, NULL, &r), HC_OK);
    s = 1 - r.multiplier_re;
  }
  for (int i = 0; i <= TIMEINT_W; ++i) y.all[i] -= 2 * s * (before.all[i] - y.all[i]) / (s_before - s);
  assert_int_equal(timeint_orbit(ti, 9.2095, 1, y.all, NULL, &r), HC_OK);
  CHECK_LE(1 + 1e-4, r.multiplier, "the unstable orbit");
  CHECK_LE(r.multiplier, 1 + 1e-2, "the unstable orbit");
  for (size_t i = 0; i < sizeof off / sizeof *off; ++i) {
    scene_state next = y;
    bool chaos;
    double rate;
    next.x *= 1 - off[i];
    assert_int_equal(timeint_begin(ti, 9.2095, next.all), HC_OK);
    ti->periods = 600; /* as if so many had passed: the transient has died out */
    assert_int_equal(chaos_test(ti, NULL, &chaos, &rate), HC_OK);
    assert_false(chaos);
    CHECK_LE(rate, 0, "%g off", off[i]); /* it has arrived elsewhere, or was only asked for a batch */
  }
  timeint_free(ti);
}

/* In the chaos at 5.13, stopped at any period of the first batch (40) or of the round after it (640): that is said, and
 * not chaos. */
static void an_interruption_is_no_chaos(CHECK_STATE)
{
  static const int at[] = {1, 40, 41, 60, 81, 679};
  const scene sc = case2();
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  scene_state y = {.x = 0};
  assert_int_equal(timeint_sweep(ti, 4, 5.13, y.all, NULL), HC_OK);
  for (size_t i = 0; i < sizeof at / sizeof *at; ++i) {
    int left = at[i];
    const hc_monitor stop = {.tick = check_stop, .self = &left};
    bool chaos;
    double rate;
    assert_int_equal(timeint_begin(ti, 5.13, y.all), HC_OK);
    ti->periods = 600; /* as if so many had passed: the transient has died out */
    assert_int_equal(chaos_test(ti, &stop, &chaos, &rate), HC_INTERRUPTED);
    assert_false(chaos);
    assert_int_equal(left, 0); /* and nothing is integrated after it */
  }
  timeint_free(ti);
}

CHECK_TESTS("timeint.chaos", 60, narrow_bands, narrow_bands_whoever_integrates, cascade_and_windows,
            leaving_an_orbit_is_not_chaos, an_interruption_is_no_chaos)
