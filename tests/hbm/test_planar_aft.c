/* test_planar_aft.c - sampled forces of contacts with two tangents under the law of the circle: on one line the law of
 * one tangent, closed forms on a circle, orders of the error, invariances, and the Jacobian against differences. */
#include "hbm/contact/aft.h"
#include "hbm/planar/planar_force.h"
#include "tests/hbm/planar_scenes.h"

static const hbm_restart restarts[] = {HBM_RESTART_INTERPOLATED, HBM_RESTART_SAMPLE,   HBM_RESTART_ZEROED,
                                       HBM_RESTART_KEPT,         HBM_RESTART_ONE_PASS, HBM_RESTART_ONE_PASS_SAMPLE};
enum { RESTARTS = sizeof restarts / sizeof *restarts };

static double jac[CIRCLE_MAX_X * CIRCLE_MAX_X], line_jac[4 * CIRCLE_MAX_LENGTH * CIRCLE_MAX_LENGTH];

static void *make(const contact *whole, hbm_restart restart, int H, int N)
{
  const contact half = circle_half(*whole);
  void *a;
  assert_int_equal(make_sampled(H, N, restart, whole->kn > 0 ? 3 : 2, &half, &a), HC_OK);
  return a;
}

/* Largest force that a motion of that size can cause, for tolerances in roundings of it. */
static double force_size(const contact *law, double size)
{
  return law->kt * size + law->kn * (size + fabs(law->gap)) + law->load;
}

/* ---- on one line ---------------------------------------------------------------------------------- */

/* J d of the circle along the line, against the other's: T along the direction, nothing across. */
static void compare_jacobians(int H, int n_dof, const double dir[2], const double *d, double tolerance, int trial)
{
  const int n = series_length(H), rows = n_dof * n, line_rows = (n_dof - 1) * n;
  for (int p = 0; p < n; ++p) {
    double along = 0, across = 0, wanted = 0;
    for (int q = 0; q < n; ++q) {
      for (int e = 0; e < 2; ++e) {
        const double *column = jac + (size_t)(e * n + q) * (size_t)rows;
        along += (dir[0] * column[p] + dir[1] * column[n + p]) * dir[e] * d[q];
        across += (dir[0] * column[n + p] - dir[1] * column[p]) * dir[e] * d[q];
      }
      wanted += line_jac[p + line_rows * q] * d[q];
      if (n_dof < 3) continue;
      const double *column = jac + (size_t)(2 * n + q) * (size_t)rows;
      along += (dir[0] * column[p] + dir[1] * column[n + p]) * d[n + q];
      wanted += line_jac[p + line_rows * (n + q)] * d[n + q];
    }
    CHECK_NEAR(along, wanted, tolerance, "trial %d row %d", trial, p);
    CHECK_NEAR(across, 0, tolerance, "trial %d row %d, across", trial, p);
  }
}

/* u = dir U: whatever the restart, T = dir T of the law of one tangent, and so is the Jacobian in the directions that
 * stay on the line. Both march by the same sums but for dir's: 1e-13 of the forces; a slider keeps the roundings of a
 * period's steps, and 30 of them at w are 30 kt. */
static void a_line_is_one_tangent(CHECK_STATE)
{
  uint64_t seed = 21;
  int regimes[4] = {0}, told_apart = 0;
  double U[2 * CIRCLE_MAX_LENGTH], d[2 * CIRCLE_MAX_LENGTH], X[CIRCLE_MAX_X], F[CIRCLE_MAX_X], G[2 * CIRCLE_MAX_LENGTH];
  for (int trial = 0; trial < 600; ++trial) {
    const int H = 1 + trial % 9, N = 2 * H + 20 + 7 * (trial % 40), n = series_length(H);
    const hbm_restart restart = restarts[trial % RESTARTS];
    const double angle = PI * random_signed(&seed), dir[2] = {cos(angle), sin(angle)};
    const contact law = random_circle(&seed);
    const int n_dof = law.kn > 0 ? 3 : 2;
    const moving_contact on_line = {.law = law, .cu = {1, 0}, .cv = {0, n_dof - 2}};
    void *a = make(&law, restart, H, N);
    aft *b;
    contact_report in_plane, in_line;
    assert_int_equal(aft_new(H, N, restart, n_dof - 1, 1, &on_line, &b), HC_OK);
    random_motion(&seed, H, 1, 1, U);
    random_motion(&seed, H, 1, 1, U + n);
    for (int i = 0; i < n; ++i) X[i] = dir[0] * U[i], X[n + i] = dir[1] * U[i], X[2 * n + i] = U[n + i];
    assert_int_equal(planar_aft_evaluator.evaluate(a, X, F, NULL, &in_plane), HC_OK);
    assert_int_equal(aft_eval(b, U, G, line_jac, &in_line), HC_OK);
    const double size = force_size(&law, sum_abs(2 * n, U)), tolerance = 1e-13 * size;
    for (int i = 0; i < n; ++i) {
      CHECK_NEAR(dir[0] * F[i] + dir[1] * F[n + i], G[i], tolerance, "trial %d coefficient %d", trial, i);
      CHECK_NEAR(dir[0] * F[n + i] - dir[1] * F[i], 0, tolerance, "trial %d coefficient %d, across", trial, i);
      if (n_dof == 3) CHECK_NEAR(F[2 * n + i], G[n + i], tolerance, "trial %d coefficient %d, normal", trial, i);
    }
    double w[2], w_line;
    planar_aft_evaluator.sliders(a, w);
    aft_sliders(b, &w_line);
    if (in_plane.regime != CONTACT_LINEAR)
      CHECK_NEAR(dir[0] * w[0] + dir[1] * w[1], w_line, 1e-13 * sum_abs(2 * n, U), "trial %d", trial);
    if (in_plane.regime != in_line.regime) { /* pushed until friction just holds it: a slip by rounding or none */
      ++told_apart;
      assert_true(fmin(in_plane.regime, in_line.regime) == CONTACT_STUCK);
      assert_true(fmax(in_plane.regime, in_line.regime) == CONTACT_SLIPS);
    } else assert_int_equal(in_plane.free_sliders, in_line.free_sliders);
    ++regimes[in_line.regime];
    random_motion(&seed, H, 1, 0, d);
    random_motion(&seed, H, 1, 0, d + n);
    planar_aft_evaluator.jacobian(a, jac);
    compare_jacobians(H, n_dof, dir, d, 1e-12 * force_size(&law, 1) * sum_abs(2 * n, d), trial);
    planar_aft_evaluator.free(a);
    aft_free(b);
  }
  assert_true(told_apart < 60);
  for (int r = CONTACT_STUCK; r <= CONTACT_SEPARATES; ++r) assert_true(regimes[r] > 20);
}

/* ---- on a circle ----------------------------------------------------------------------------------- */

/* u = a (cos th, sin th), constant N: the slider follows on a circle of radius sqrt(a^2 - r^2), r = mu N/kt, and T has
 * mu N r/a along u and mu N sqrt(1 - r^2/a^2) ahead of it. */
static double circle_error(hbm_restart restart, int N)
{
  const contact law = {.kt = 3, .mu = 0.4, .load = 2.5};
  const double mu_N = 1, r = mu_N / 3, a = 0.7, along = mu_N * r / a, ahead = mu_N * sqrt(1 - r * r / (a * a));
  const double X[6] = {0, a, 0, 0, 0, a};
  double F[6];
  contact_report report;
  void *of = make(&law, restart, 1, N);
  assert_int_equal(planar_aft_evaluator.evaluate(of, X, F, NULL, &report), HC_OK);
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
  for (int i = 0; i < 2 * series_length(H); ++i) worst = fmax(worst, fabs(F[i] - exact[i]));
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
    contact_report report;
    planar_force *of;
    assert_int_equal(planar_force_new(H, 3, &half, &of), HC_OK);
    assert_int_equal(planar_force_eval(of, X, exact, NULL, &report), HC_OK);
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

/* ---- what must not matter ---------------------------------------------------------------------------- */

/* The plane turned, forces turn with it; the motion begun k samples later, forces begin later too, unless where the
 * slider rests depends on where it began. 1e-12: each period of dragging adds its roundings, and few are needed. */
static void turns_and_shifts(CHECK_STATE)
{
  uint64_t seed = 22;
  double X[CIRCLE_MAX_X], Y[CIRCLE_MAX_X], F[CIRCLE_MAX_X], G[CIRCLE_MAX_X], wanted[CIRCLE_MAX_X];
  int shifted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int H = 1 + trial % 6, N = 2 * H + 12 + 11 * (trial % 20), n = series_length(H);
    const contact law = random_circle(&seed);
    const int n_dof = law.kn > 0 ? 3 : 2, step = 1 + trial % (N - 1);
    const double angle = PI * random_signed(&seed), shift = 2 * PI * step / N;
    void *a = make(&law, restarts[trial % 2], H, N);
    contact_report report;
    random_plane_motion(&seed, H, 1, X);
    const double tolerance = 1e-12 * force_size(&law, sum_abs(3 * n, X));
    assert_int_equal(planar_aft_evaluator.evaluate(a, X, F, NULL, &report), HC_OK);
    turn_plane(H, angle, X, Y);
    turn_plane(H, angle, F, wanted);
    assert_int_equal(planar_aft_evaluator.evaluate(a, Y, G, NULL, NULL), HC_OK);
    for (int i = 0; i < n_dof * n; ++i) CHECK_NEAR(G[i], wanted[i], tolerance, "turned, trial %d row %d", trial, i);
    if (!report.free_sliders && ++shifted) {
      for (int d = 0; d < n_dof; ++d) {
        shift_motion(H, X + d * n, shift, Y + d * n);
        shift_motion(H, F + d * n, shift, wanted + d * n);
      }
      assert_int_equal(planar_aft_evaluator.evaluate(a, Y, G, NULL, NULL), HC_OK);
      for (int i = 0; i < n_dof * n; ++i) CHECK_NEAR(G[i], wanted[i], tolerance, "shifted, trial %d row %d", trial, i);
    }
    planar_aft_evaluator.free(a);
  }
  assert_true(shifted > 150);
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
    contact_report report;
    void *of = make(&law, HBM_RESTART_INTERPOLATED, 1, 256);
    assert_int_equal(planar_aft_evaluator.evaluate(of, X, F, NULL, &report), HC_OK);
    assert_int_equal(report.regime, CONTACT_SLIPS);
    for (int i = 0; i < 6; ++i) assert_true(isfinite(F[i]));
    planar_aft_evaluator.free(of);
  }
}

/* ---- Jacobian --------------------------------------------------------------------------------------- */

static hc_status forces(void *a, const double *X, double *F)
{
  return planar_aft_evaluator.evaluate(a, X, F, NULL, NULL);
}

/* Against differences, to 1e-9. A sample that changes its state, in a motion out of some dozens, moves the difference
 * by its kink: those are the trials counted as skipped. */
static void jacobian_equals_differences(CHECK_STATE)
{
  uint64_t seed = 23;
  double X[CIRCLE_MAX_X], d[CIRCLE_MAX_X], F[CIRCLE_MAX_X], slope[CIRCLE_MAX_X], product[CIRCLE_MAX_X];
  int skipped = 0, checked = 0, regimes[4] = {0};
  for (int trial = 0; trial < 480; ++trial) {
    const int H = 1 + trial % 7, N = 2 * H + 10 + 9 * (trial % 25), n = series_length(H);
    const contact law = random_circle(&seed);
    const int n_dof = law.kn > 0 ? 3 : 2, rows = n_dof * n;
    void *a = make(&law, restarts[trial % RESTARTS], H, N);
    contact_report report;
    random_plane_motion(&seed, H, 1, X);
    random_plane_motion(&seed, H, 1, d);
    const double size = force_size(&law, 1) * sum_abs(rows, d);
    const double disagreement = circle_slope_along(rows, forces, a, X, d, slope);
    if (disagreement > 1e-6 * size && ++skipped) {
      planar_aft_evaluator.free(a);
      continue;
    }
    ++checked;
    assert_int_equal(planar_aft_evaluator.evaluate(a, X, F, NULL, &report), HC_OK);
    planar_aft_evaluator.jacobian(a, jac);
    circle_product(rows, jac, d, product);
    for (int p = 0; p < rows; ++p)
      CHECK_NEAR(product[p], slope[p], 1e-8 * size + disagreement, "trial %d restart %d regime %d row %d", trial,
                 trial % RESTARTS, report.regime, p);
    ++regimes[report.regime];
    planar_aft_evaluator.free(a);
  }
  print_message("%d directions checked, %d skipped for a changed state\n", checked, skipped);
  assert_true(skipped < checked / 4);
  for (int r = CONTACT_STUCK; r <= CONTACT_SEPARATES; ++r) assert_true(regimes[r] > 10);
}

/* ---- refused ---------------------------------------------------------------------------------------- */

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
            turns_and_shifts, little_slip_closes, jacobian_equals_differences, refuses)
