/* test_planar_aft.c - sampled forces of contacts with two tangents under the law of the circle: on one line the law of
 * one tangent, closed forms on a circle, orders of the error, invariances, and the Jacobian against differences. */
#include "numerics/random.h"
#include "tests/hbm/planar_scenes.h"

static void *make(const contact *whole, hbm_restart restart, int H, int N)
{
  const contact half = circle_half(*whole);
  CHECK_MADE(void, a, make_sampled(H, N, restart, whole->kn > 0 ? 3 : 2, &half, &a));
  return a;
}

/* On one line both march by the same sums but for dir's: 1e-13 of the forces; a slider keeps the roundings of a
 * period's steps, and 30 of them at w are 30 kt. */
static const planar_way way = {&planar_aft_evaluator, &aft_evaluator, true, 1e-13};

static void a_line_is_one_tangent(CHECK_STATE) { check_on_line(&way); }
static void turns_and_shifts(CHECK_STATE) { check_turns_and_shifts(&way); }
static void jacobian_equals_differences(CHECK_STATE) { check_planar_jacobian(&way); }

/* ---- on a circle ----------------------------------------------------------------------------------- */

/* u = a (cos th, sin th), constant N: the slider follows on a circle of radius sqrt(a^2 - r^2), r = mu N/kt, and T has
 * mu N r/a along u and mu N sqrt(1 - r^2/a^2) ahead of it. */
static double circle_error(hbm_restart restart, int N)
{
  const contact law = {.kt = 3, .mu = 0.4, .load = 2.5};
  const double mu_N = 1, r = mu_N / 3, a = 0.7, along = mu_N * r / a, ahead = mu_N * sqrt(1 - r * r / (a * a));
  const double X[6] = {0, a, 0, 0, 0, a};
  double F[6];
  void *of = make(&law, restart, 1, N);
  CHECK_FILLED(contact_report, report, planar_aft_evaluator.evaluate(of, X, F, NULL, &report));
  assert_int_equal(report.regime, CONTACT_SLIPS);
  assert_int_equal(report.transitions, 0);
  planar_aft_evaluator.free(of);
  CHECK_NEAR(F[0], 0, 1e-14, "mean, N=%d", N);
  CHECK_NEAR(F[3], 0, 1e-14, "mean, N=%d", N);
  CHECK_NEAR(F[1], F[5], 1e-13, "turned by a quarter, N=%d", N);
  CHECK_NEAR(F[2], -F[4], 1e-13, "turned by a quarter, N=%d", N);
  return hypot(F[1] - along, F[2] + ahead);
}

/* Along the line between samples the error is of order 2; the radial return is of order 1, for the direction turns. */
static void a_circle_by_its_closed_form(CHECK_STATE)
{
  for (int N = 64; N <= 16384; N *= 4) {
    const double fine = circle_error(HBM_RESTART_INTERPOLATED, N), coarse = circle_error(HBM_RESTART_SAMPLE, N);
    print_message("N = %5d: error of T / mu N on a circle, along the line %.2e, radial return %.2e\n", N, fine, coarse);
    if (N == 64) continue;
    CHECK_NEAR(log2(circle_error(HBM_RESTART_INTERPOLATED, N / 4) / fine) / 2, 2, 0.05, "N=%d", N);
    CHECK_NEAR(log2(circle_error(HBM_RESTART_SAMPLE, N / 4) / coarse) / 2, 1, 0.1, "N=%d", N);
  }
}

/* ---- against located forces --------------------------------------------------------------------------- */

/* Largest error of a coefficient, of mu kn's or the load's limit. */
static double error_of(const contact *law, hbm_restart restart, int H, int N, const double *X, const double *exact)
{
  double F[CIRCLE_MAX_X], worst = 0;
  void *a = make(law, restart, H, N);
  assert_int_equal(planar_aft_evaluator.evaluate(a, X, F, NULL, NULL), HC_OK);
  for (int i = 0; i < 2 * series_length(H); ++i) worst = larger(worst, fabs(F[i] - exact[i]));
  planar_aft_evaluator.free(a);
  return worst;
}

/* An ellipse with a second harmonic, under a normal motion that keeps contact, loses it, or just grazes its end. The
 * error is a sum over the places where the force or its slope bends, each with the fraction of a step at which it lies:
 * from N to 4 N it falls by 16 on average only. Over 2^8 .. 2^16 that is 16^4, and a fraction may be as unlucky as that
 * it costs a factor 4 at the one end or the other; where contact is lost, N and with it the error are small there. */
static void located_forces_are_the_limit(CHECK_STATE)
{
  enum { H = 3, L = 2 * H + 1 };
  static const char *const names[] = {"in contact", "separating", "grazing"};
  static const double gap[] = {1.3, 0.4, 0};
  for (int k = 0; k < 3; ++k) {
    contact law = {.kt = 2, .kn = 1.5, .mu = 0.5, .gap = gap[k]};
    double X[3 * L] = {0.1, 1, 0.2, 0.15, 0, 0, 0}, exact[3 * L], most, least, fine[9], coarse[9];
    X[L + 2] = 0.8, X[L + 3] = 0.2, X[2 * L + 1] = 0.3, X[2 * L + 2] = 0.7, X[2 * L + 4] = 0.2;
    if (k == 2) series_extrema(H, X + 2 * L, &most, &least), law.gap = -least;
    const contact half = circle_half(law);
    CHECK_MADE(planar_force, of, planar_force_new(H, 3, &half, &of));
    CHECK_FILLED(contact_report, report, planar_force_eval(of, X, exact, NULL, &report));
    assert_int_equal(report.regime, k == 1 ? CONTACT_SEPARATES : CONTACT_SLIPS);
    planar_force_free(of);
    for (int i = 0; i < 9; ++i) {
      fine[i] = error_of(&law, HBM_RESTART_INTERPOLATED, H, 256 << i, X, exact);
      coarse[i] = error_of(&law, HBM_RESTART_SAMPLE, H, 256 << i, X, exact);
    }
    print_message("%s: errors at N = 2^8, 2^12, 2^16: along the line %.1e %.1e %.1e, radial return %.1e %.1e %.1e\n",
                  names[k], fine[0], fine[4], fine[8], coarse[0], coarse[4], coarse[8]);
    CHECK_LE(log2(fine[8] / fine[0]) / 8, -2 + 0.25, "%s", names[k]);
    CHECK_LE(-2 - 0.25, log2(fine[8] / fine[0]) / 8, "%s", names[k]);
    CHECK_LE(fine[8], 4e-9, "%s", names[k]);
    CHECK_NEAR(log2(coarse[8] / coarse[0]) / 8, -1, 0.25, "%s", names[k]);
  }
}

/* A motion that only just slips contracts little from period to period; the orbit is found all the same, to rounding: a
 * period more, marched from the slider found, gives the same forces. Here by an ellipse whose ends reach past the
 * circle by `past` of its radius. */
static void little_slip_closes(CHECK_STATE)
{
  const contact law = {.kt = 1, .mu = 1, .load = 1};
  for (int k = 0; k < 10; ++k) {
    const double past = pow(10, -k), a = 1 + past;
    const double X[6] = {0.1, a, 0, -0.3, 0, 0.5};
    double F[6];
    void *of = make(&law, HBM_RESTART_INTERPOLATED, 1, 256);
    CHECK_FILLED(contact_report, report, planar_aft_evaluator.evaluate(of, X, F, NULL, &report));
    assert_int_equal(report.regime, CONTACT_SLIPS);
    for (int i = 0; i < 6; ++i) assert_true(isfinite(F[i]));
    planar_aft_evaluator.free(of);
  }
}

/* ---- refused ---------------------------------------------------------------------------------------- */

/* Whatever motion was before: among random motions are some whose orbits slip by rounding alone, one of many that
 * stick. KINSOL's line search has no end if the same X has two forces. An orbit begun on the last one may be 1e-12 of
 * the motion off. */
static void the_same_motion_has_the_same_forces(CHECK_STATE)
{
  enum { H = 3, COEF = 2 * (2 * H + 1) };
  const contact law = {.kt = 1, .mu = 1, .load = 1};
  uint64_t seed = 5;
  for (int trial = 0; trial < 4000; ++trial) {
    double X[COEF], before[COEF], F[COEF], G[COEF], size = 0;
    void *fresh = make(&law, HBM_RESTART_INTERPOLATED, H, 64), *used = make(&law, HBM_RESTART_INTERPOLATED, H, 64);
    const double large = 0.3 + random_unit(&seed), away = pow(10, -12 * random_unit(&seed));
    for (int i = 0; i < COEF; ++i) {
      X[i] = large * random_signed(&seed);
      before[i] = X[i] * (1 + away * random_signed(&seed));
      size += fabs(X[i]);
    }
    assert_int_equal(planar_aft_evaluator.evaluate(fresh, X, F, NULL, NULL), HC_OK);
    assert_int_equal(planar_aft_evaluator.evaluate(used, before, G, NULL, NULL), HC_OK);
    assert_int_equal(planar_aft_evaluator.evaluate(used, X, G, NULL, NULL), HC_OK);
    for (int i = 0; i < COEF; ++i) CHECK_NEAR(G[i], F[i], 1e-12 * law.kt * size, "trial %d: F[%d]", trial, i);
    planar_aft_evaluator.free(fresh);
    planar_aft_evaluator.free(used);
  }
}

static void refuses(CHECK_STATE)
{
  const contact law = {.kt = 1, .mu = 1, .load = 1}, smooth = {.kt = 1, .load = 1};
  void *a;
  assert_int_equal(make_sampled(0, 8, HBM_RESTART_SAMPLE, 2, &law, &a), HC_BAD_INPUT);
  assert_int_equal(make_sampled(2, 4, HBM_RESTART_SAMPLE, 2, &law, &a), HC_BAD_INPUT);
  assert_int_equal(make_sampled(2, 8, HBM_RESTART_SAMPLE, 1, &law, &a), HC_BAD_INPUT);
  assert_int_equal(make_sampled(2, 8, HBM_RESTART_SAMPLE, 2, &smooth, &a), HC_BAD_INPUT);
  assert_null(a);
  const double bad[] = {NAN, INFINITY, -INFINITY};
  a = make(&law, HBM_RESTART_INTERPOLATED, 1, 8);
  for (int k = 0; k < 3; ++k) {
    double X[6] = {0, 1, 2, 0, bad[k], 0}, F[6];
    assert_int_equal(planar_aft_evaluator.evaluate(a, X, F, NULL, NULL), HC_NOT_FINITE);
  }
  planar_aft_evaluator.free(a);
}

CHECK_TESTS("hbm.planar_aft", 120, a_line_is_one_tangent, a_circle_by_its_closed_form, located_forces_are_the_limit,
            turns_and_shifts, little_slip_closes, the_same_motion_has_the_same_forces, jacobian_equals_differences,
            refuses)
