/* test_phase.c - contact states of the exact law: how a period begins, what bounds a phase, what follows it. */
#include "tests/check.h"

#include <float.h>

#include "tests/scene_parts.h"
#include "tests/timeint/scenes.h"
#include "timeint/phase.h"

static const double eps = DBL_EPSILON;

/* Stiffness 40, unit mass, omega and length 1: a contact's numbers stay as they are. */
static scaled_model with(double kt, double kn, double mu, double gap, double angle)
{
  scene sc = scene_linear(1, 0.4, 40, 10);
  scene_add(&sc, kt, kn, mu, gap, angle);
  sc.transient.law = TRANSIENT_LAW_EXACT;
  scaled_model m;
  scene_scaled(&m, &sc, 1, 1);
  return m;
}

static contact_state begin(const scaled_model *m, double x, double p, double w, phase *ph)
{
  const double y[SCENE_MAX_STATES] = {x, p, w};
  assert_true(phase_begin(ph, m, y) >= 0);
  return ph->contact[0].state;
}

/* At 45 degrees u = v = x/sqrt 2. kt = 4, mu kn = 2, gap = 1: T = 4(u - w), mu N = 2(v + 1). */
static void a_period_begins_in_any_state(void **state)
{
  (void)state;
  const double r = sqrt(2);
  scaled_model m = with(4, 4, 0.5, 1, 45);
  phase_contact states[3];
  phase ph = {.contact = states};
  assert_int_equal(begin(&m, -1.5 * r, 1, 0, &ph), CONTACT_SEPARATED);
  CHECK_NEAR(ph.up, -r, 4 * eps, "v + gap = 0");
  assert_int_equal(begin(&m, 0, 1, 0.3, &ph), CONTACT_STICK);
  assert_true(ph.contact[0].since_start);
  assert_int_equal(begin(&m, 0, 1, -0.7, &ph), CONTACT_SLIP_PLUS); /* T would be 2.8 > 2, and u outruns the limit */
  assert_int_equal(begin(&m, 0, -1, -0.7, &ph), CONTACT_STICK); /* moving back: on the limit, w = u - mu N/kt = -1/2 */
  assert_false(ph.contact[0].since_start);
  CHECK_NEAR(ph.contact[0].rest, -0.5, 4 * eps, "drawn to the limit");
  CHECK_NEAR(ph.contact[0].rest_by_x, 0.5 / r, 4 * eps, "cos - mu kn sin/kt");
  assert_int_equal(begin(&m, 0, -1, 0.7, &ph), CONTACT_SLIP_MINUS);
  assert_int_equal(begin(&m, -r, 1, -1, &ph), CONTACT_SLIP_PLUS); /* touching now: kt cos > mu kn sin */
  assert_int_equal(begin(&m, -r, -1, -1, &ph), CONTACT_SEPARATED);
  assert_int_equal(begin(&m, -r, 0, -1, &ph), CONTACT_SLIP_PLUS); /* at rest, P' = 10 + 40 sqrt 2 + 2 sqrt 2 > 0 */
  const double bad[][3] = {{NAN, 0, 0}, {0, INFINITY, 0}, {0, 0, NAN}, {0, 0, -INFINITY}, {1e308, 0, -1e308}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) assert_int_equal(phase_begin(&ph, &m, bad[i]), -1);
}

/* Some number in [0, 1); the same in every run. */
static double any(void)
{
  static uint64_t s = 88172645463325252u;
  s ^= s << 13, s ^= s >> 7, s ^= s << 17;
  return (double)(s >> 11) * 0x1p-53;
}

/* The phase's equation is that of the law (scaled_rhs, exact in any admissible state), sums of 8 terms rounded once
 * or twice each; up and down are where the first guard of contact_law.h vanishes: no guard is negative inside, one
 * is 0 at the end. */
static void bounds_and_force_are_those_of_the_law(void **state)
{
  (void)state;
  int stuck = 0, slipping = 0, ended = 0;
  for (int i = 0; i < 20000; ++i) {
    scaled_model m = with(8 * any(), 8 * any(), any(), 2 * any() - 0.5, 90 * any());
    const scaled_contact *mc = &m.contact[0];
    const contact law = {mc->law.kt, mc->law.kn, mc->law.mu, mc->law.gap};
    const double x = 2 * any() - 1, p = 2 * any() - 1, w = 2 * any() - 1;
    phase_contact states[3];
    phase ph = {.contact = states};
    contact_state st = begin(&m, x, p, w, &ph);
    double rest, by_x, dy[SCENE_MAX_STATES];
    phase_slider(&ph, 0, &rest, &by_x);
    const double y[SCENE_MAX_STATES] = {x, p, rest + by_x * x};
    scaled_rhs(&m, 0, y, dy);
    const double size = 10 + 50 + 8 * 3 + 8 * 3;
    CHECK_NEAR(phase_force(&ph, 1, x, p), dy[SCALED_P], 8 * eps * size, "P' in state %d of contact %d", st, i);
    slipping += contact_slip_sign(st) != 0;
    if (st != CONTACT_STICK || !ph.contact[0].since_start) continue;
    ++stuck;
    for (int side = 0; side < 2; ++side) {
      const double end = side ? ph.up : ph.down, inside = isfinite(end) ? 0.999 * end + 0.001 * x : x;
      const double tol = 64 * eps * (law.kt * (fabs(end) + fabs(w)) + law.kn * (fabs(end) + fabs(law.gap)));
      double least = INFINITY, least_in = INFINITY;
      for (int s = -1; s <= 1; s += 2) {
        least = fmin(least, contact_guard_stick(&law, s, mc->cosine * end, mc->sine * end, w));
        least_in = fmin(least_in, contact_guard_stick(&law, s, mc->cosine * inside, mc->sine * inside, w));
      }
      if (mc->sine * end + law.gap < 1e-12) continue; /* ends by separation */
      CHECK_LE(-least_in, 0, "guard inside");
      if (!isfinite(end)) continue;
      ++ended;
      CHECK_NEAR(least, 0, tol, "guard at the end of %d", i);
    }
  }
  assert_true(stuck > 2000 && slipping > 2000 && ended > 2000);
}

/* kt = 4, mu kn = 2, 45 degrees, gap = -1: touch at sqrt 2, slips at once while rising. Turning at x = 2 sqrt 2: N =
 * 4, T = 2, w = 2 - 1/2. Falling it slips back where 4(u - 3/2) = -2(u - 1): u = 4/3. */
static void a_slipping_contact_goes_round(void **state)
{
  (void)state;
  const double r = sqrt(2), tol = 16 * eps;
  scaled_model m = with(4, 4, 0.5, -1, 45);
  phase_contact states[3];
  phase ph = {.contact = states};
  assert_int_equal(begin(&m, 0, 1, 0, &ph), CONTACT_SEPARATED);
  assert_int_equal(phase_next(&ph, ph.up, 1, false), 1);
  assert_int_equal(ph.contact[0].state, CONTACT_SLIP_PLUS);
  assert_true(ph.slips);
  assert_int_equal(phase_next(&ph, 1.5 * r, 1, true), 0); /* no turn: P was rounded to the other side of 0 */
  assert_int_equal(phase_next(&ph, 2 * r, -1, true), 1);
  assert_int_equal(ph.contact[0].state, CONTACT_STICK);
  CHECK_NEAR(ph.contact[0].rest, 1.5, tol, "w");
  CHECK_NEAR(ph.contact[0].rest_by_x, 0.5 / r, tol, "dw/dx");
  assert_true(ph.up > 2 * r); /* it sticks on its limit: coming back it slips on at the same x, to rounding */
  CHECK_NEAR(ph.up, 2 * r, 64 * eps, "up");
  CHECK_NEAR(ph.down, 4 / 3.0 * r, tol, "slip backwards");
  assert_int_equal(phase_next(&ph, ph.down, -1, false), 1);
  assert_int_equal(ph.contact[0].state, CONTACT_SLIP_MINUS);
  CHECK_NEAR(ph.down, r, tol, "separation");
  assert_int_equal(phase_next(&ph, ph.down, -1, false), 1);
  assert_int_equal(ph.contact[0].state, CONTACT_SEPARATED);
}

/* kt cos <= mu kn sin: touches, sticks, and T and N vanish together; equality makes one guard constant. */
static void a_sticking_contact_separates_only(void **state)
{
  (void)state;
  for (int i = 0; i < 2000; ++i) {
    const double kn = 0.1 + any(), mu = any(), kt = i % 2 ? mu * kn : mu * kn * any(), gap = 2 * any() - 1;
    scaled_model m = with(kt, kn, mu, gap, 45);
    phase_contact states[3];
    phase ph = {.contact = states};
    assert_int_equal(begin(&m, -3, 1, 0, &ph), CONTACT_SEPARATED);
    const double over = ph.up + 1e-13 * any(); /* as located */
    assert_int_equal(phase_next(&ph, over, 1, false), 1);
    if (i % 2 == 0) assert_int_equal(ph.contact[0].state, CONTACT_STICK);
    CHECK_LE(1e300, ph.up, "nothing ends it rising, %d", i);
    assert_int_equal(phase_next(&ph, 2, -1, true), contact_slip_sign(ph.contact[0].state) != 0);
    /* at touch moved out by 16 eps */
    CHECK_NEAR(ph.down, -gap / m.contact[0].sine, 64 * eps, "the slip does not come first");
    assert_int_equal(phase_next(&ph, ph.down, -1, false), 1);
    assert_int_equal(ph.contact[0].state, CONTACT_SEPARATED);
  }
}

static void degenerate_contacts(void **state)
{
  (void)state;
  phase_contact states[3];
  phase ph = {.contact = states};
  scaled_model m = with(4, 4, 0.5, 1, 0); /* constant N = 4: slips where |4(x - w)| = 2 */
  assert_int_equal(begin(&m, 0, 1, 0.1, &ph), CONTACT_STICK);
  CHECK_NEAR(ph.up, 0.6, 4 * eps, "alpha 0");
  CHECK_NEAR(ph.down, -0.4, 4 * eps, "alpha 0");
  for (int i = 0; i < 2; ++i) { /* never touches */
    m = with(4, 4, 0.5, -i, 0);
    assert_int_equal(begin(&m, 0, 1, 0, &ph), CONTACT_SEPARATED);
    assert_false(phase_ends(&ph));
  }
  m = with(4, 0, 0.5, 1, 45); /* kn = 0: no force at all */
  assert_int_equal(begin(&m, 0, 1, 0, &ph), CONTACT_SEPARATED);
  assert_false(phase_ends(&ph));
  CHECK_NEAR(ph.k, 40, 0, "kn 0");
  const scaled_model smooth[] = {with(0, 4, 0.5, 1, 45), with(4, 4, 0, 1, 45), with(4, 4, 0.5, 1, 90)}; /* T = 0 */
  for (int i = 0; i < 3; ++i) {
    const double s = smooth[i].contact[0].sine;
    assert_int_equal(begin(&smooth[i], 0.1, 1, 0.3, &ph), CONTACT_STICK);
    CHECK_NEAR(ph.k, 40 + 4 * s * s, 64 * eps, "frictionless");
    CHECK_NEAR(ph.d, 0, 0, "preload");
    CHECK_NEAR(ph.down, -1 / s, 4 * eps, "frictionless");
    CHECK_LE(1e300, ph.up, "frictionless");
    double rest, by_x;
    phase_slider(&ph, 0, &rest, &by_x);
    CHECK_NEAR(rest + by_x, smooth[i].contact[0].cosine, 0, "w = u");
    CHECK_NEAR(phase_slider_stiffness(&ph, 0), 0, 0, "no traction");
    assert_int_equal(phase_next(&ph, ph.down, -1, false), 1);
    assert_int_equal(phase_next(&ph, ph.up, 1, false), 1);
    assert_int_equal(ph.contact[0].state, CONTACT_STICK);
  }
}

/* Two that touch at one x, and one that separates there: a single call takes all. A graze, on the guard but turning,
 * takes none. */
static void several_at_once(void **state)
{
  (void)state;
  scene sc = scene_linear(1, 0.4, 40, 10);
  for (int i = 0; i < 3; ++i) scene_add(&sc, 100, 1000, 0.3, -0.5, 45);
  sc.transient.law = TRANSIENT_LAW_EXACT;
  scaled_model m;
  scene_scaled(&m, &sc, 1, 1);
  const double y[SCENE_MAX_STATES] = {0, 1, 0, 0, 0};
  phase_contact states[3];
  phase ph = {.contact = states};
  assert_int_equal(phase_begin(&ph, &m, y), 0);
  const double edge = ph.up;
  assert_int_equal(phase_next(&ph, edge, -1, true), 0);
  assert_int_equal(phase_next(&ph, edge, 1, false), 3);
  CHECK_NEAR(ph.k, 40 + 3 * 0.5 * 1100, 1e3 * 8 * eps, "all in contact");
  assert_int_equal(phase_next(&ph, 2 * edge, -1, true), 0);
  assert_int_equal(phase_next(&ph, ph.down, -1, false), 3);
  CHECK_NEAR(ph.k, 40, 0, "all apart");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_period_begins_in_any_state),  cmocka_unit_test(bounds_and_force_are_those_of_the_law),
      cmocka_unit_test(a_slipping_contact_goes_round), cmocka_unit_test(a_sticking_contact_separates_only),
      cmocka_unit_test(degenerate_contacts),           cmocka_unit_test(several_at_once),
  };
  check_watchdog(60);
  return cmocka_run_group_tests_name("timeint.phase", tests, NULL, NULL);
}
