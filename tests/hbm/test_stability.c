/* test_stability.c - Floquet multipliers: where the oscillator is linear against its eigenvalues, where nothing
 * slips by their product, where it slips against the derivative of a period map that the test marches itself. */

#include "compare/study/scene_solvers.h"
#include "tests/hbm/period_map.h"
#include "tests/hbm/scenes.h"
#include "tests/scene_parts.h"

/* lambda = exp(r T), r the roots of M r^2 + C r + k = 0; trace and determinant follow. What rounds: T = 2 pi/omega
 * and sqrt(d) by 2 eps each, so the angle by 4 eps |sqrt(d)| T; then ten operations on numbers of order n = |phi| <=
 * 1 + w + k/(M w) (the off-diagonal entries have units: cos^2 and -sin^2 cancel in the determinant, w sin and sin/w
 * do not grow it). A multiplier is the root of a quadratic: with half^2 - det near 0 its error is that of det over
 * the root. All of it: eps (16 + 4 |r| T) (1 + 1/|l1 - l2|). */
static void check_linear(const scene *sc, double k, double omega, contact_regime regime, const char *what)
{
  double X[64];
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(sc, &s));
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
  CHECK_FILLED(hbm_measures, measures, hbm_measure(s, X, &measures));
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, omega, X, &st));
  hbm_solver_free(s);
  assert_int_equal(measures.contact.regime, regime);
  double a = 0.5 * *sc->structure->damping.v / *sc->structure->mass.v, T = 2 * PI / omega;
  double complex d = csqrt(a * a - k / *sc->structure->mass.v), l1 = cexp((-a + d) * T), l2 = cexp((-a - d) * T);
  double tol = DBL_EPSILON * (16 + 4 * (a + cabs(d)) * T) * (1 + 1 / cabs(l1 - l2));
  CHECK_NEAR(st.multiplier, fmax(cabs(l1), cabs(l2)), tol, "%s omega=%g", what, omega);
  CHECK_NEAR(st.re, creal(l1), tol, "%s omega=%g", what, omega);
  CHECK_NEAR(fabs(st.im), fabs(cimag(l1)), tol, "%s omega=%g", what, omega);
  CHECK_NEAR(st.determinant, creal(l1 * l2), tol, "%s omega=%g", what, omega);
  CHECK_NEAR(st.flip, creal((1 + l1) * (1 + l2)), 4 * tol, "%s omega=%g", what, omega);
  CHECK_NEAR(st.fold, creal((1 - l1) * (1 - l2)), 4 * tol, "%s omega=%g", what, omega);
}

static void a_linear_oscillator_has_the_exponentials_of_its_eigenvalues(CHECK_STATE)
{
  /* critical: 12.65 at k = 40, 36.4 stuck */
  static const double damping[] = {0.02, 0.4, 5, 12.7, 30}, omegas[] = {2.3, 6, 11, 40};
  for (size_t i = 0; i < sizeof damping / sizeof *damping; ++i)
    for (size_t q = 0; q < sizeof omegas / sizeof *omegas; ++q) {
      scene none = exact_scene("b10", 5, true), apart, stuck = exact_scene("a10", 5, true);
      *none.structure->damping.v = *stuck.structure->damping.v = damping[i];
      stuck.structure->loads->amplitude = none.structure->loads->amplitude =
          1e-3; /* moves far less than gap 0.5, or the traction mu N0 = 30 */
      apart = scene_own(&none);
      scene_keep_contacts(&none, 0);
      check_linear(&none, 40, omegas[q], CONTACT_LINEAR, "no contact");
      check_linear(&apart, 40, omegas[q], CONTACT_LINEAR, "apart");
      check_linear(&stuck, 40 + 50 + 100, omegas[q], CONTACT_STUCK, "stuck"); /* kt cos^2 + kn sin^2 at 45 degrees */
      scene both = scene_own(&stuck);
      scene_add_contact(&both, (scene_contact){{70, 30, 0.2, -2}, 30});
      check_linear(&both, 190, omegas[q], CONTACT_STUCK, "one stuck, one apart");
      both.structure->contacts[1].given.law.gap = 1;
      check_linear(&both, 190 + 70 * 0.75 + 30 * 0.25, omegas[q], CONTACT_STUCK, "two stuck");
    }
}

/* Product of all multipliers but those of sliders at rest across th = 0, which are 0 and change neither flip nor
 * fold: 1 + trace + det and 1 - trace + det. */
static double moving_determinant(const hbm_stability *st) { return 0.5 * (st->flip + st->fold) - 1; }

/* Liouville: without slip the divergence of the flow is -C/M all the time, and events add nothing. The determinant
 * is a difference of products of phi's entries, each of m intervals long and rounded 10 times an interval: 10 m eps
 * |phi_00 phi_11|, and with det = b, trace = 2 half, no product exceeds half^2 + |phi_01 phi_10| <= trace^2 +
 * multiplier^2 + 1. m <= transitions + 2 < 40 here: 1e-13 times that; 1e-12 leaves room for the angles. */
static void without_slip_the_determinant_is_that_of_the_damping(CHECK_STATE)
{
  static const int harmonics[] = {5, 20};
  for (int q = 0; q < 2; ++q) {
    scene sc = exact_scene("c2", harmonics[q], true);
    hbm_curve c = {0};
    CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
    assert_int_equal(hbm_trace(s, 3, 20, NULL, &c), HC_OK);
    int unstable = 0, stable = 0, slider_across_0 = 0;
    for (int k = 0; k < c.n; ++k) {
      double omega = c.points[k].omega, det = exp(-*sc.structure->damping.v * 2 * PI / omega / *sc.structure->mass.v);
      CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, omega, c.X + (size_t)k * c.n_coef, &st));
      CHECK_NEAR(moving_determinant(&st), det, 1e-12 * (1 + st.multiplier * st.multiplier), "H=%d omega=%.17g",
                 harmonics[q], omega);
      if (fabs(st.determinant) > 1e-9)
        CHECK_NEAR(st.determinant, det, 1e-12 * (1 + st.multiplier * st.multiplier), "H=%d omega=%.17g", harmonics[q],
                   omega);
      else ++slider_across_0;
      /* one determinant, two multipliers: l and det/l, or a pair of modulus sqrt(det) */
      CHECK_LE(sqrt(det), st.multiplier * (1 + 1e-12), "H=%d omega=%.17g", harmonics[q], omega);
      if (st.im == 0) {
        CHECK_NEAR(st.flip, (1 + st.re) * (1 + det / st.re), 1e-11 * (1 + fabs(st.re)) * (1 + fabs(st.re)),
                   "H=%d omega=%.17g", harmonics[q], omega);
        CHECK_NEAR(st.fold, (1 - st.re) * (1 - det / st.re), 1e-11 * (1 + fabs(st.re)) * (1 + fabs(st.re)),
                   "H=%d omega=%.17g", harmonics[q], omega);
      }
      ++*(st.multiplier > 1 ? &unstable : &stable);
    }
    assert_true(unstable > 10 && stable > 10 && slider_across_0 < c.n / 2);
    hbm_curve_free(&c);
    hbm_solver_free(s);
  }
}

/* The solution at omega, which slips, against the derivative of the test's own period map (period_map.h). Slip takes
 * area out of the flow: the determinant is below that of the damping alone, visibly here. */
static void check_slipping(const scene *sc, double omega, const char *what)
{
  double X[2 * 30 + 1];
  CHECK_MADE(model, m, scene_model(sc, &m));
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(sc, &s));
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
  check_against_map(what, s, m, omega, X);
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, omega, X, &st));
  CHECK_LE(moving_determinant(&st),
           (1 - 1e-3) * exp(-*sc->structure->damping.v * TWO_PI / omega / *sc->structure->mass.v), "%s at %g", what,
           omega);
  hbm_solver_free(s);
  model_free(m);
}

static void slipping_orbits_against_the_period_map(CHECK_STATE)
{
  static const struct {
    const char *name;
    double omega;
  } at[] = {{"b10", 5.5}, {"b10", 6.5}, {"b10", 7}, {"a10", 13}, {"a10", 13.5}, {"a10", 14}};
  for (size_t i = 0; i < sizeof at / sizeof *at; ++i) {
    scene sc = exact_scene(at[i].name, 30, true);
    check_slipping(&sc, at[i].omega, at[i].name);
  }
}

static void two_contacts_against_the_period_map(CHECK_STATE)
{
  static const double omegas[] = {5.5, 7, 8};
  for (int i = 0; i < 3; ++i) {
    scene sc = exact_scene("b10", 30, true);
    scene_add_contact(&sc, (scene_contact){{60, 80, 0.2, -0.2}, 30});
    check_slipping(&sc, omegas[i], "two contacts");
  }
}

/* Shakedown: the slider slipped from w = 0 until friction just holds it. Where it rests is one of a family of places,
 * so its multiplier is 1 and is left out; the others are those of the stuck oscillator, exp(lambda T) with M lambda^2
 * + C lambda + K' = 0. A stress campaign found the case: the verdict was "unknown" for orbits that are stable. */
static void a_slider_shaken_down_is_held(CHECK_STATE)
{
  scene sc = exact_scene("a10", 4, true);
  *sc.structure->mass.v = 0.004673179462143663, *sc.structure->damping.v = 3.034467329816304,
  *sc.structure->stiffness.v = 5318.444481348431, sc.structure->loads->amplitude = 583.943258710234;
  sc.structure->contacts[0].given = (scene_contact){
      {.kt = 15.850124418365803, .kn = 1.2291759286480795, .mu = 1.9994961307629158, .gap = 0.732771594469483},
      55.94139530323445};
  const double omega = 881.68431426493737, rate = 0.5 * *sc.structure->damping.v / *sc.structure->mass.v,
               k = *sc.structure->stiffness.v + scene_stuck_stiffness(&sc.structure->contacts[0].given);
  double X[9];
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
  CHECK_LE(1e-6, fabs(X[0]), "the slider has slipped: it rests where the mean is not 0");
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, omega, X, &st));
  CHECK_LE(rate * rate, k / *sc.structure->mass.v, "under-damped, so that both multipliers have the modulus");
  CHECK_NEAR(st.multiplier, exp(-rate * 2 * PI / omega), 1e-12, "stuck oscillator");
  assert_int_equal(hbm_stability_verdict(&st), 1);
  hbm_solver_free(s);
}

/* Between the turning point of H harmonics, where det dR/dX changes sign, and the orbit whose multiplier is 1, the two
 * contradict each other, and the verdict is "unknown". Past the turning point det dR/dX has the other sign. */
static void the_determinant_has_its_say(CHECK_STATE)
{
  scene sc = exact_scene("c2", 3, true);
  hbm_curve curve = {0};
  hbm_special *at;
  int n, contradictions = 0, checked = 0;
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  assert_int_equal(hbm_trace(s, 3, 20, NULL, &curve), HC_OK);
  assert_int_equal(hbm_specials(s, &curve, &at, &n), HC_OK);
  for (int i = 0; i < n; ++i) {
    if (at[i].kind != HBM_TURNING_POINT) continue;
    for (double d = 1e-1; d > 1e-7; d *= 0.5)
      for (int side = -1; side <= 1; side += 2) {
        hbm_curve found = {0};
        assert_int_equal(hbm_curve_at(s, &curve, at[i].omega + side * d, &found), HC_OK);
        for (int k = 0; k < found.n; ++k) {
          CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, found.points[k].omega, hbm_curve_X(&found, k), &st));
          bool agrees = (found.points[k].branch % 2 == 0) == (st.fold > 0);
          assert_int_equal(st.agrees, agrees);
          if (!agrees) assert_int_equal(hbm_stability_verdict(&st), 0);
          contradictions += !agrees;
          ++checked;
        }
        hbm_curve_free(&found);
      }
  }
  print_message("%d of %d contradict\n", contradictions, checked);
  assert_true(contradictions > 0 && contradictions < checked);
  free(at);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
}

CHECK_TESTS("hbm.stability", 200, a_linear_oscillator_has_the_exponentials_of_its_eigenvalues,
            without_slip_the_determinant_is_that_of_the_damping, slipping_orbits_against_the_period_map,
            two_contacts_against_the_period_map, a_slider_shaken_down_is_held, the_determinant_has_its_say)
