/* test_smooth_force.c - the harmonics of polynomial springs and of tanh friction, and their Jacobians. */
#include <float.h>

#include "hbm/forces/contact_forces.h"
#include "hbm/hbm.h"
#include "tests/hbm/random_structures.h"

enum { H = 7, LENGTH = 2 * H + 1, MOST = 2 * LENGTH };

static contact_forces *forces_of(const contact *law, int dim, const double *tangent, const double *normal,
                                 hbm_force force, int n_time)
{
  const placed_contact c = {.law = *law, .tangent = tangent, .normal = normal};
  const evaluator_settings how = {.n_harm = H, .n_time = n_time};
  CHECK_MADE(contact_forces, f, contact_forces_new_of(dim, 1, &c, force, &how, &f));
  return f;
}

static void draw_motion(uint64_t *seed, int n, double *X)
{
  for (int i = 0; i < n; ++i) X[i] = random_signed(seed) / (1 + i / 4);
}

static double largest(int n, const double *a, const double *b)
{
  double most = 0;
  for (int i = 0; i < n; ++i) most = larger(most, fabs(a[i] - (b ? b[i] : 0)));
  return most;
}

/* f(v) of H harmonics has p H: N >= (p + 1) H + 1 samples give the first H, so that 16 times as many change nothing but
 * rounding, a few roundings of each of log N sums. Of one sample fewer harmonic p H is the -H-th, in full. */
static void a_polynomial_is_exact_with_so_many_samples_and_not_with_one_fewer(CHECK_STATE)
{
  const int powers[] = {2, 3, 5, 7};
  uint64_t seed = 7;
  for (int i = 0; i < 4; ++i) {
    const int p = powers[i], n_time = (p + 1) * H + 1;
    contact law = {.smooth = CONTACT_POLYNOMIAL};
    law.power[p - 2] = 1;
    const double zero = 0, normal = -0.7;
    double X[LENGTH], F[4][LENGTH];
    contact_report report;
    draw_motion(&seed, LENGTH, X);
    X[2 * H - 1] = 1;
    const int n[4] = {n_time, n_time, 16 * n_time, n_time - 1};
    for (int k = 0; k < 4; ++k) {
      contact_forces *f = forces_of(&law, 1, &zero, &normal, k ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT, n[k]);
      assert_int_equal(contact_forces_eval(f, X, F[k], false, &report), HC_OK);
      assert_int_equal(report.regime, CONTACT_BENDS);
      contact_forces_free(f);
    }
    const double size = largest(LENGTH, F[0], NULL), rounding = 256 * DBL_EPSILON * size;
    CHECK_LE(largest(LENGTH, F[0], F[1]), rounding, "p = %d", p);
    CHECK_LE(largest(LENGTH, F[0], F[2]), rounding, "p = %d", p);
    assert_true(largest(LENGTH, F[0], F[3]) > 1e6 * rounding);
  }
}

/* x = A cos th: x^3 = A^3 (3 cos th + cos 3 th)/4, x^2 = A^2 (1 + cos 2 th)/2. */
static void a_cosine_has_the_closed_form_harmonics(CHECK_STATE)
{
  contact law = {.smooth = CONTACT_POLYNOMIAL};
  const double zero = 0, one = 1, A = 1.3;
  double X[LENGTH] = {0, A}, F[LENGTH], expected[LENGTH] = {0};
  law.power[0] = 2, law.power[1] = 5;
  contact_forces *f = forces_of(&law, 1, &zero, &one, HBM_FORCE_EXACT, 0);
  CHECK_FILLED(contact_report, report, contact_forces_eval(f, X, F, false, &report));
  expected[0] = expected[3] = 2 * A * A / 2;
  expected[1] = 5 * 3 * A * A * A / 4, expected[5] = 5 * A * A * A / 4;
  CHECK_LE(largest(LENGTH, F, expected), 32 * DBL_EPSILON * 10, "harmonics");
  contact_forces_free(f);
}

/* Central differences of step h are off by h^2/6 of the third derivative and DBL_EPSILON/h of the value: of numbers of
 * the order of 100 at most, 1e-8 and 1e-9 with h = 1e-5 but for tanh, whose third derivative is 1/epsilon^2 larger. */
static void check_jacobian(contact_forces *f, int n, double *X, double tolerance, const char *what)
{
  const double h = 1e-5;
  double F[2][MOST], jac[MOST * MOST];
  CHECK_FILLED(contact_report, report, contact_forces_eval(f, X, F[0], true, &report));
  memcpy(jac, contact_forces_jacobian(f), (size_t)n * (size_t)n * sizeof *jac);
  const double size = fmax(1, largest(n * n, jac, NULL));
  for (int j = 0; j < n; ++j) {
    const double x = X[j];
    for (int s = 0; s < 2; ++s) {
      X[j] = x + (s ? -h : h);
      assert_int_equal(contact_forces_eval(f, X, F[s], false, &report), HC_OK);
    }
    X[j] = x;
    for (int i = 0; i < n; ++i)
      CHECK_NEAR(jac[j * n + i], (F[0][i] - F[1][i]) / (2 * h), tolerance * size, "%s: %d by %d", what, i, j);
  }
}

static void jacobians_are_differences(CHECK_STATE)
{
  uint64_t seed = 11;
  const double tangent[2] = {0.8, -0.3}, normal[2] = {0.2, 1}, along[2] = {1, 0}, zero[2] = {0, 0};
  double X[MOST];
  for (int force = 0; force < 2; ++force) {
    const hbm_force by = force ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT;
    contact law = {.smooth = CONTACT_POLYNOMIAL};
    for (int i = 0; i < CONTACT_POWERS; ++i) law.power[i] = 0.3 / (i + 1);
    contact_forces *f = forces_of(&law, 2, zero, normal, by, 40);
    draw_motion(&seed, MOST, X);
    for (int i = 0; i < MOST; ++i) X[i] *= 0.3;
    check_jacobian(f, MOST, X, 1e-8, "polynomial");
    contact_forces_free(f);
    const contact laws[] = {{.smooth = CONTACT_TANH, .mu = 0.3, .load = 2, .epsilon = 0.7},
                            {.smooth = CONTACT_TANH, .mu = 0.4, .kn = 3, .gap = 0.2, .epsilon = 0.9},
                            {.smooth = CONTACT_TANH, .mu = 0.4, .kn = 3, .gap = 8, .epsilon = 0.9}};
    for (int k = 0; k < 3; ++k)
      for (int one = 0; one < 2; ++one) {
        f = forces_of(&laws[k], 2, one ? along : tangent, k == 0 ? zero : one ? along : normal, by, 64);
        contact_forces_at(f, 1.7);
        draw_motion(&seed, MOST, X);
        check_jacobian(f, MOST, X, 1e-7, "tanh");
        contact_forces_free(f);
      }
  }
}

/* By omega as by differences, too; and the same from 2^14 samples, which are as good as 2 pi/N to the power of what the
 * pole of tanh allows: exp(-N pi epsilon/2/|omega u''|) < 1e-100 here. */
static void tanh_without_aliasing_is_what_many_samples_give(CHECK_STATE)
{
  uint64_t seed = 13;
  const double tangent = 1, zero = 0, h = 1e-5;
  const contact law = {.smooth = CONTACT_TANH, .mu = 0.3, .load = 2, .epsilon = 0.05};
  contact_forces *f = forces_of(&law, 1, &tangent, &zero, HBM_FORCE_EXACT, 0),
                 *sampled = forces_of(&law, 1, &tangent, &zero, HBM_FORCE_SAMPLED, 1 << 14);
  double X[LENGTH], F[LENGTH], G[LENGTH], by_omega[LENGTH] = {0}, ends[2][LENGTH];
  draw_motion(&seed, LENGTH, X);
  assert_true(contact_forces_at(f, 1.3) && contact_forces_at(sampled, 1.3));
  CHECK_FILLED(contact_report, report, contact_forces_eval(f, X, F, true, &report));
  assert_int_equal(contact_forces_eval(sampled, X, G, false, &report), HC_OK);
  CHECK_LE(largest(LENGTH, F, G), 1e-13, "harmonics");
  contact_forces_add_by_omega(f, by_omega);
  for (int s = 0; s < 2; ++s) {
    contact_forces_at(f, 1.3 + (s ? -h : h));
    assert_int_equal(contact_forces_eval(f, X, ends[s], false, &report), HC_OK);
  }
  for (int i = 0; i < LENGTH; ++i)
    CHECK_NEAR(by_omega[i], (ends[0][i] - ends[1][i]) / (2 * h), 1e-8, "by omega, %d", i);
  contact_forces_free(f);
  contact_forces_free(sampled);
}

/* u = A cos th: as epsilon falls the work tends to 4 mu N A, with an error of the order of epsilon^2. */
static void tanh_tends_to_coulombs_law(CHECK_STATE)
{
  double u[LENGTH] = {0, 2}, v[LENGTH] = {0}, off[3];
  for (int i = 0; i < 3; ++i) {
    const contact law = {.smooth = CONTACT_TANH, .mu = 0.3, .load = 2, .epsilon = 0.1 / (1 << (2 * i))};
    CHECK_FILLED(contact_period, p, tanh_measures_of(&law, H, u, NULL, v, &p));
    off[i] = 4 * 0.6 * 2 - p.work;
    CHECK_NEAR(p.slip_distance, 8, 1e-5, "path"); /* |u'| has its kinks within panels that short */
  }
  CHECK_NEAR(off[0] / off[1], 16, 0.1, "second order: %g, %g", off[0], off[1]);
  CHECK_NEAR(off[1] / off[2], 16, 0.1, "second order: %g, %g", off[1], off[2]);
}

/* Duffing's equation at H = 1 is its first approximation: G = ((K - M w^2 + 3/4 k a)^2 + (C w)^2) a = F^2, a = A^2; its
 * curve turns where dG/da = 0, too. */
static const double C = 0.05, F0 = 0.05, BY_A = 0.75 * 3;

static double first_approximation(double w, double a)
{
  const double k = 1 - w * w + BY_A * a;
  return (k * k + C * C * w * w) * a;
}

/* The fold's w by Newton on G = F^2, dG/da = 0 from a point next to it. */
static double fold_from(double w, double a)
{
  for (int it = 0; it < 20; ++it) {
    const double k = 1 - w * w + BY_A * a, G = first_approximation(w, a) - F0 * F0;
    const double G_a = k * k + C * C * w * w + 2 * BY_A * k * a, G_aa = 4 * BY_A * k + 2 * BY_A * BY_A * a;
    const double G_w = (-4 * w * k + 2 * C * C * w) * a, G_aw = -4 * w * k + 2 * C * C * w - 4 * w * BY_A * a;
    const double det = G_a * G_aw - G_w * G_aa;
    a -= (G_aw * G - G_w * G_a) / det;
    w -= (G_a * G_a - G_aa * G) / det;
  }
  return w;
}

static void duffings_first_approximation_is_one_harmonic(CHECK_STATE)
{
  CHECK_MADE(model, m, model_oscillator(1, C, 1, F0, 1, &m));
  *m->contacts->normal = 1;
  m->contacts->law.smooth = CONTACT_POLYNOMIAL;
  m->contacts->law.power[1] = 3;
  const hbm_settings how = {
      .harmonics = 1, .keep_mean = true, .force = HBM_FORCE_EXACT, .tolerance = 1e-13, .accuracy = 1e-4};
  hbm_curve curve = {0};
  hbm_special *fold;
  int n, turns = 0;
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
  assert_int_equal(hbm_trace(s, 0.5, 2, NULL, &curve), HC_OK);
  assert_true(curve.n > 20);
  for (int k = 0; k < curve.n; ++k) {
    const double *X = hbm_curve_X(&curve, k), w = curve.points[k].omega, a = X[1] * X[1] + X[2] * X[2];
    CHECK_NEAR(sqrt(first_approximation(w, a)), F0, 1e-13, "omega = %g", w); /* the residual's tolerance */
  }
  assert_int_equal(hbm_specials(s, &curve, &fold, &n), HC_OK);
  for (int k = 0; k < n; ++k) {
    if (fold[k].kind != HBM_TURNING_POINT) continue;
    ++turns;
    CHECK_NEAR(fold[k].omega, fold_from(fold[k].omega, fold[k].amplitude * fold[k].amplitude), 1e-9, "fold %d", k);
  }
  assert_int_equal(turns, 2);
  free(fold);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  model_free(m);
}

CHECK_TESTS("hbm.smooth_force", 60, a_polynomial_is_exact_with_so_many_samples_and_not_with_one_fewer,
            a_cosine_has_the_closed_form_harmonics, jacobians_are_differences,
            tanh_without_aliasing_is_what_many_samples_give, tanh_tends_to_coulombs_law,
            duffings_first_approximation_is_one_harmonic)
