/* test_contacts.c - single contacts of cases/adversarial by harmonic balance: what must come out by closed forms or by
 * the same scene in another guise. Both solvers: verdicts.transcript. */
#include "tests/adversarial/scenes.h"

/* Newton is quadratic: with hbm.tolerance, 1e-10 of the forces, met the error is its square; what is left is rounding,
 * some 100 operations a coefficient, times the steepness, at most 100 where scenes are compared. */
static const double SOLVED = 1e-11;

/* Case 2 grazes where |F0/(K - M w^2 + i C w)| sin(alpha) = |gap|, a quadratic equation for w^2. */
static double grazing_omega(const scene *sc, int sign)
{
  double K = *sc->structure->stiffness.v, M = *sc->structure->mass.v, C = *sc->structure->damping.v,
         r = sc->structure->loads->amplitude * sin(PI / 4) / sc->structure->contacts[0].given.law.gap;
  double b = 2 * K * M - C * C, root = sqrt(b * b - 4 * M * M * (K * K - r * r));
  return sqrt((b + sign * root) / (2 * M * M));
}

/* On it and an ulp either side: as many solutions as beside a fold, one of amplitude |gap|/sin(alpha). An ulp moves the
 * linear amplitude by dA/dw ulp(w) = 1e-15 A; where it touches, the response by less. */
static void grazing_to_an_ulp(CHECK_STATE)
{
  scene sc = load("grazing", NULL);
  const double amplitude = 5 * sqrt(2), low = grazing_omega(&sc, -1), high = grazing_omega(&sc, 1);
  CHECK_NEAR(low, 5.0995831509, 1e-10, "theory.md, 11");
  CHECK_NEAR(high, 7.3371828168, 1e-10, "theory.md, 11");
  const double omega[] = {nextafter(low, 0), low, nextafter(low, 9), nextafter(high, 0), high, nextafter(high, 9)};
  for (int i = 0; i < 6; ++i) {
    hbm_curve at = solutions(&sc, omega[i]);
    double nearest = INFINITY;
    assert_int_equal(at.n, i < 3 ? 1 : 3);
    for (int k = 0; k < at.n; ++k) nearest = fmin(nearest, fabs(norm_of(at.n_coef, solution(&at, k)) - amplitude));
    CHECK_LE(nearest, SOLVED * amplitude, "at %.17g", omega[i]);
    hbm_curve_free(&at);
  }
}

/* x = 1.6 cos + 1.2 sin, in whole numbers: 10/(4 + 3i). */
static void amplitude_equal_to_the_gap(CHECK_STATE)
{
  scene sc = load("amplitude_is_gap", NULL);
  static const double expected[] = {0, 1.6, 1.2};
  hbm_curve at = solutions(&sc, 6);
  assert_int_equal(at.n, 1);
  for (int i = 0; i < at.n_coef; ++i) CHECK_NEAR(at.X[i], i < 3 ? expected[i] : 0, SOLVED * 2, "X[%d]", i);
  hbm_curve_free(&at);
}

/* Where T = mu N exactly, and an ulp beside it: the same force as where it sticks, with ten times mu. */
static void on_the_edge_of_the_cone(CHECK_STATE)
{
  scene sc = load("cone_edge", NULL), sticks = LOAD("cone_edge", "contacts[0].friction=5"), beside = scene_own(&sc);
  const double kt = sc.structure->contacts[0].given.law.kt;
  assert_true(kt == sc.structure->contacts[0].given.law.mu * sc.structure->contacts[0].given.law.kn);
  same_answers(&sc, &sticks, 1, SOLVED);
  beside.structure->contacts[0].given.law.kt = nextafter(kt, 0);
  same_answers(&sc, &beside, 1, SOLVED);
  beside.structure->contacts[0].given.law.kt = nextafter(kt, 1e9);
  same_answers(&sc, &beside, 1, SOLVED);
}

/* Once separated, never slips: kt cos < mu kn sin; with a tenth of the friction it does. */
static void tangential_and_normal_force_vanish_together(CHECK_STATE)
{
  scene sc = load("vanishing_together", NULL), sticks = LOAD("vanishing_together", "contacts[0].friction=1000");
  same_answers(&sc, &sticks, 1, SOLVED);
  hbm_curve p = solutions(&sc, 25), q;
  sc.structure->contacts[0].given.law.mu = 0.03;
  q = solutions(&sc, 25);
  CHECK_LE(1e-3 * norm_of(p.n_coef, p.X), fabs(p.X[1] - q.X[1]) + fabs(p.X[2] - q.X[2]), "less friction does slip");
  hbm_curve_free(&p);
  hbm_curve_free(&q);
}

/* Odd symmetric, x(t + T/2) = -x(t); and with one harmonic, the Jenkins element in closed form, x = A cos th, phi =
 * arccos(1 - 2 fc/(kt A)):
 *     a1 = kt A/pi (phi - sin(2 phi)/2),  b1 = -kt A/pi sin^2(phi),  and  |(K - M w^2) A + a1, C w A - b1| = F0. */
static void angle_0_is_a_jenkins_element(CHECK_STATE)
{
  scene sc = load("angle_0", NULL), one = LOAD("angle_0", "hbm.harmonics=1");
  const double kt = one.structure->contacts[0].given.law.kt, fc = 0.05 * 200 * 0.5;
  for (int i = 0; i < sc.compare.omega.n; ++i) {
    double w = sc.compare.omega.v[i];
    hbm_curve at = solutions(&sc, w), first = solutions(&one, w);
    double size = norm_of(at.n_coef, at.X), A = hypot(first.X[1], first.X[2]);
    for (int h = 2; h <= 30; h += 2)
      CHECK_LE(larger(fabs(at.X[0]), hypot(at.X[2 * h - 1], at.X[2 * h])), SOLVED * size, "harmonic %d at %g", h, w);
    assert_true(A > fc / kt);
    double phi = acos(1 - 2 * fc / (kt * A));
    double a1 = kt * A / PI * (phi - sin(2 * phi) / 2), b1 = -kt * A / PI * sin(phi) * sin(phi);
    CHECK_NEAR(hypot((*one.structure->stiffness.v - *one.structure->mass.v * w * w) * A + a1,
                     *one.structure->damping.v * w * A - b1),
               one.structure->loads->amplitude, 1e-9 * one.structure->loads->amplitude, "at %g", w);
    hbm_curve_free(&at);
    hbm_curve_free(&first);
  }
}

/* The same whatever kt and mu; and with one harmonic the unilateral spring in closed form, x = m + A cos th, g = gap
 * + m, p = arccos(-g/A):
 *     a0 = kn/pi (g p + A sin p),  a1 = kn/pi (2 g sin p + A (p + sin p cos p)),  K m + a0 = 0 and |(K - M w^2) A +
 *     a1, C w A| = F0. */
static void angle_90_is_a_stop(CHECK_STATE)
{
  scene sc = load("angle_90", NULL),
        free_of = LOAD("angle_90", "contacts[0].friction=0", "contacts[0].tangential_stiffness=0");
  scene one = LOAD("angle_90", "hbm.harmonics=1");
  same_answers(&sc, &free_of, 1, SOLVED);
  for (int i = 1; i < 3; ++i) {
    double w = one.compare.omega.v[i], kn = one.structure->contacts[0].given.law.kn;
    hbm_curve at = solutions(&one, w);
    double m = at.X[0], A = hypot(at.X[1], at.X[2]), g = one.structure->contacts[0].given.law.gap + m;
    assert_true(A > -g);
    double p = acos(-g / A), a0 = kn / PI * (g * p + A * sin(p)),
           a1 = kn / PI * (2 * g * sin(p) + A * (p + sin(p) * cos(p)));
    CHECK_NEAR(*one.structure->stiffness.v * m, -a0, 1e-9 * one.structure->loads->amplitude, "mean at %g", w);
    CHECK_NEAR(hypot((*one.structure->stiffness.v - *one.structure->mass.v * w * w) * A + a1,
                     *one.structure->damping.v * w * A),
               one.structure->loads->amplitude, 1e-9 * one.structure->loads->amplitude, "at %g", w);
    hbm_curve_free(&at);
  }
}

/* mu = 0 is kt = 0; mu = 1e300 is mu = 1e6; where mu kn overflows it is said, in no time. */
static void friction_from_none_to_too_much(CHECK_STATE)
{
  scene none = load("no_friction", NULL), no_spring = LOAD("no_friction", "contacts[0].tangential_stiffness=0");
  scene huge = load("huge_friction", NULL), large = LOAD("huge_friction", "contacts[0].friction=1e6");
  scene beyond = LOAD("huge_friction", "contacts[0].friction=1e308");
  same_answers(&none, &no_spring, 1, SOLVED);
  same_answers(&large, &huge, 1, SOLVED);
  hbm_curve curve = {0};
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&beyond, &s));
  assert_int_equal(hbm_trace(s, beyond.omega_from, beyond.omega_to, NULL, &curve), HC_NOT_FINITE);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
}

/* Homogeneous of degree one: exactly, by a power of two; to rounding by three. */
static void gap_0_scales_with_the_force(CHECK_STATE)
{
  scene sc = load("gap_0", NULL), twice = LOAD("gap_0", "forcing.amplitude=200"),
        thrice = LOAD("gap_0", "forcing.amplitude=300");
  same_answers(&sc, &twice, 2, 0);
  same_answers(&sc, &thrice, 3, SOLVED);
}

/* Free and undamped from x = 0: back after pi/8 + pi/24, omega = 2 w1 w2/(w1 + w2) = 12, to 100 steps' 1e-12. */
static void gap_0_vibrates_at_its_bilinear_frequency(CHECK_STATE)
{
  scene sc = LOAD("gap_0", "forcing.amplitude=0", "oscillator.damping=0", "transient.law=exact",
                  "transient.steady_state=march", "transient.max_periods=1", "transient.start=rest");
  timeint_result r;
  const double omega = 2 * 8 * 24 / (8.0 + 24);
  scene_state y = {.x = 0, .v = 1};
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  assert_int_equal(timeint_steady(ti, omega, y.all, NULL, &r), HC_NOT_SETTLED);
  CHECK_NEAR(y.x * omega, 0, 1e-9, "x after a period");
  CHECK_NEAR(y.v, 1, 1e-9, "velocity after a period");
  timeint_free(ti);
}

/* Two equal contacts are one of twice the stiffness; and nothing hangs on the order of sixteen. */
static void contacts_that_switch_together(CHECK_STATE)
{
  scene two = load("two_at_once", NULL), one = scene_own(&two), sixteen = load("sixteen", NULL),
        reversed = scene_own(&sixteen);
  scene_keep_contacts(&one, 1);
  one.structure->contacts[0].given.law.kt *= 2;
  one.structure->contacts[0].given.law.kn *= 2;
  same_answers(&two, &one, 1, SOLVED);
  assert_int_equal(sixteen.structure->n_contacts, SCENE_MAX_CONTACTS);
  for (int j = 0; j < 16; ++j) reversed.structure->contacts[j].given = sixteen.structure->contacts[15 - j].given;
  same_answers(&sixteen, &reversed, 1, SOLVED);
}

CHECK_TESTS("adversarial.contacts", 900, grazing_to_an_ulp, amplitude_equal_to_the_gap, on_the_edge_of_the_cone,
            tangential_and_normal_force_vanish_together, angle_0_is_a_jenkins_element, angle_90_is_a_stop,
            friction_from_none_to_too_much, gap_0_scales_with_the_force, gap_0_vibrates_at_its_bilinear_frequency,
            contacts_that_switch_together)
