/* test_classics.c - the cases of cases/classics/ against the closed forms that their heads state, and a moving base
 * against the force that it is. Numbers of the heads are computed here from the formulas, by other means. */
#include "numerics/series.h"
#include "tests/adversarial/scenes.h"

/* Newton is quadratic: with hbm.tolerance, 1e-10 of the forces, met the error is its square; what is left is rounding,
 * some 100 operations a coefficient. */
static const double SOLVED = 1e-11;

static double hbm_amplitude(const hbm_curve *at, int k)
{
  double high, low;
  series_extrema((at->n_coef - 1) / 2, solution(at, k), &high, &low);
  return (high - low) / 2;
}

/* The steady state that time integration comes to from rest. */
static timeint_result march(const scene *sc, double omega)
{
  timeint_result r;
  scene_state y = {.x = 0};
  CHECK_MADE(timeint, ti, scene_timeint(sc, &ti));
  assert_int_equal(timeint_steady(ti, omega, y.all, NULL, &r), HC_OK);
  timeint_free(ti);
  return r;
}

/* At each turn the mass first unloads the tangential spring, over 2 mu N/kt of its way, from a velocity of 0: in a time
 * like 1/sqrt(kt), in which friction is too small by some mu N. So the amplitude is off by e/sqrt(kt) + O(1/kt): e of
 * two stiffnesses 100 apart is ten times as small in the second, and what is left without it is like the square of the
 * first's error. */
static void den_hartogs_friction(CHECK_STATE)
{
  static const char *const stiffness[] = {"contacts[0].tangential_stiffness=1e3",
                                          "contacts[0].tangential_stiffness=1e5"};
  static const double head[] = {2.0907, 3.2016};
  scene sc[] = {case_scene("classics/den_hartog", 1, &stiffness[0]),
                case_scene("classics/den_hartog", 1, &stiffness[1])};
  assert_int_equal(sc->compare.omega.n, 2);
  for (int i = 0; i < 2; ++i) {
    const double b = sc->compare.omega.v[i], limit = 0.5 * 0.8, V = 1 / (1 - b * b),
                 U = sin(PI / b) / (b * (1 + cos(PI / b))), exact = sqrt(V * V - limit * limit * U * U);
    const double softer = march(&sc[0], b).amplitude, stiffer = march(&sc[1], b).amplitude, off = 1 - softer / exact;
    CHECK_NEAR(exact, head[i], 5e-5, "the number of the case's head");
    CHECK_NEAR(off, 0.9e-2, 0.1e-2, "at kt = 1000 K");
    CHECK_NEAR(1 - stiffer / exact, off / 10, off * off, "at kt = 1e5 K");
    CHECK_NEAR(stiffer + (stiffer - softer) / 9, exact, off * off * exact, "without its error at %g", b);
  }
}

/* With one harmonic, |(K - M w^2) A + a1, C w A - b1| = F0. */
static void jenkins_element(CHECK_STATE)
{
  scene sc = case_scene("classics/jenkins", 0, NULL);
  const double kt = 0.5, fc = 0.5 * 0.4;
  for (int i = 0; i < sc.compare.omega.n; ++i) {
    const double w = sc.compare.omega.v[i];
    hbm_curve at = solutions(&sc, w);
    assert_int_equal(at.n, 1);
    const double A = hypot(at.X[1], at.X[2]), phi = A > fc / kt ? acos(1 - 2 * fc / (kt * A)) : PI,
                 a1 = kt * A / PI * (phi - sin(2 * phi) / 2), b1 = -kt * A / PI * sin(phi) * sin(phi);
    CHECK_NEAR(hypot((1 - w * w) * A + a1, 0.02 * w * A - b1), 0.25, 1e-9 * 0.25, "at %g", w);
    if (w == 1.1) CHECK_NEAR(A, 1.4064, 5e-5, "the number of the case's head");
    hbm_curve_free(&at);
  }
}

/* A solution at omega is 90 degrees behind the force C w A, and has amplitude A. SOLVED is of the forces on the mass;
 * what they leave of the motion is divided by the damping's, some 1/100 of them. */
static void turns_by_90_degrees(const char *name, double omega, double A)
{
  scene sc = case_scene(name, 0, NULL);
  const double force = *sc.structure->damping.v * omega * A;
  CHECK_NEAR(sc.structure->loads->amplitude, force, 5e-9, "%s: the case's, to its digits", name);
  sc.structure->loads->amplitude = force;
  hbm_curve at = solutions(&sc, omega);
  int k = 0;
  for (int i = 1; i < at.n; ++i)
    if (fabs(solution(&at, i)[1]) < fabs(solution(&at, k)[1])) k = i;
  CHECK_NEAR(solution(&at, k)[1], 0, 1e3 * SOLVED * A, "%s: cosine", name);
  CHECK_NEAR(solution(&at, k)[2], A, 1e3 * SOLVED * A, "%s: sine", name);
  hbm_curve_free(&at);
}

/* M w^2 = K + 3/4 k3 A^2: 1.21 = 1 + 0.75 * 0.28. */
static void duffings_oscillator(CHECK_STATE) { turns_by_90_degrees("classics/duffing", 1.1, 1); }

/* M w^2 is K and what the describing function makes of the stops. */
static void clearance_on_both_sides(CHECK_STATE)
{
  const double s = 0.5, k = 20 * (1 - 2 / PI * (asin(s) + s * sqrt(1 - s * s))), w = sqrt(1 + k);
  CHECK_NEAR(w, 2.9698560, 5e-8, "the number of the case's head");
  turns_by_90_degrees("classics/clearance", w, 2);
}

/* Damping moves the peak by some zeta^2, 2.5e-5 of it or less, and the harmonics above 21 no further; the resonance is
 * 4e-3 of it wide, so that 3e-4 beside its peak the response is smaller. */
static void bilinear_oscillator(CHECK_STATE)
{
  scene sc = case_scene("classics/bilinear", 0, NULL);
  const double peak = 2 * 2 * 4 / (2.0 + 4), off = 3e-4;
  double by_hbm[3], in_time[3];
  response r = response_of(&sc);
  for (int i = 0; i < 3; ++i) {
    const double omega = peak * (1 + (i - 1) * off);
    hbm_curve at = response_at(&r, omega);
    by_hbm[i] = hbm_amplitude(&at, 0);
    in_time[i] = march(&sc, omega).amplitude;
    hbm_curve_free(&at);
  }
  for (int i = 0; i < 3; i += 2) {
    CHECK_LE(by_hbm[i], by_hbm[1] * (1 - off), "HBM, beside the peak, %d", i);
    CHECK_LE(in_time[i], in_time[1] * (1 - off), "in time, beside the peak, %d", i);
  }
  response_free(&r);
}

/* x = Y r^2/(1 - r^2 + 2 i zeta r); of an acceleration a cos(omega t), Y = -a/omega^2. By marching to its tolerance,
 * 1e-9 of the orbit, and CVODE's steps as exact. */
static void moving_base(CHECK_STATE)
{
  scene sc = case_scene("classics/base", 0, NULL), shaken = sc; /* which shares the structure */
  shaken.base = (scene_base){.acceleration = 0.5};
  for (int i = 0; i < sc.compare.omega.n; ++i)
    for (int k = 0; k < 2; ++k) {
      const scene *one = k ? &shaken : &sc;
      const double w = sc.compare.omega.v[i], Y = k ? -0.5 / (w * w) : 0.5;
      const double complex exact = Y * w * w / (1 - w * w + I * (0.1 * w));
      const timeint_result r = march(one, w);
      hbm_curve at = solutions(one, w);
      CHECK_LE(cabs(at.X[1] - I * at.X[2] - exact), SOLVED * cabs(exact), "HBM at %g, %d", w, k);
      CHECK_LE(cabs(r.a1 - I * r.b1 - exact), 1e-8 * cabs(exact), "in time at %g, %d", w, k);
      hbm_curve_free(&at);
    }
}

/* At one omega a base that moves by Y is the force omega^2 M r Y, of two masses of which one rubs: it moves further
 * than its spring can hold, so it slips. */
static void a_moving_base_is_a_force(CHECK_STATE)
{
#define TWO_MASSES(load)                                                                                               \
  "structure: {mass: [[1, 0.1], [0.1, 0.5]], stiffness: [[3, -1], [-1, 2]], damping: {rayleigh: [0.05, 0]}}\n"         \
  "contacts: [{tangential_stiffness: 2, friction: 0.5, preload: 1, tangent: 1}]\nsweep: {omega: [0.8, 2.6]}\n"         \
  "transient: {law: exact, method: closed_form}\nresponse: [1]\n" load
  static const char moves[] = TWO_MASSES("base: {direction: {1: 1, 2: 1}, amplitude: 0.75}\n"),
                    forced[] = TWO_MASSES("forcing: [{direction: {1: 1.1, 2: 0.6}, amplitude: 3}]\n");
  const double omega = 2; /* 0.75 * 2^2 = 3, and both to the bit */
  case_error err;
  CHECK_FILLED(scene, base, case_parse("base", moves, strlen(moves), 0, NULL, &base, &err));
  CHECK_FILLED(scene, force, case_parse("force", forced, strlen(forced), 0, NULL, &force, &err));
  hbm_curve a = solutions(&base, omega), b = solutions(&force, omega);
  const timeint_result in_time = march(&base, omega), as_force = march(&force, omega);
  assert_true(a.n == 1 && b.n == 1);
  CHECK_LE(0.5 / 2, in_time.amplitude, "it slips");
  for (int i = 0; i < a.n_coef; ++i) CHECK_NEAR(a.X[i], b.X[i], SOLVED * norm_of(a.n_coef, b.X), "X[%d]", i);
  CHECK_NEAR(in_time.amplitude, as_force.amplitude, 1e-9 * as_force.amplitude, "in time");
  hbm_curve_free(&a);
  hbm_curve_free(&b);
  case_clear(&base);
  case_clear(&force);
}

CHECK_TESTS("hbm.classics", 120, den_hartogs_friction, jenkins_element, duffings_oscillator, clearance_on_both_sides,
            bilinear_oscillator, moving_base, a_moving_base_is_a_force)
