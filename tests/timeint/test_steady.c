/* test_steady.c - the steady state where it has a closed form, at any scale; sub-harmonics; and every way not to get
 * there. */
#include "tests/check.h"

#include <complex.h>
#include <float.h>

#include "tests/timeint/scenes.h"

static double complex response(const scene *sc, double stiffness, double omega)
{
  return sc->structure->loads->amplitude /
         (stiffness - *sc->structure->mass.v * omega * omega + I * *sc->structure->damping.v * omega);
}

static hc_status steady(const scene *sc, double omega, scene_state *y, timeint_result *r)
{
  timeint *ti;
  hc_status st = scene_timeint(sc, &ti);
  if (st == HC_OK) st = timeint_steady(ti, omega, y->all, NULL, r);
  timeint_free(ti);
  return st;
}

/* Distance to the orbit <= transient.tolerance of the amplitude (what HC_OK says), and CVODE's own error: 1e-3 of
 * that a step, 600 steps a period, summed over 1/(1 - rho) periods <= 13 (omega <= 16: rho <= 0.925): 8 tolerances
 * if all had one sign. Together 10. */
static void check_harmonic(const scene *sc, const timeint_result *r, double complex X)
{
  const double tol = 10 * sc->transient.tolerance * cabs(X);
  CHECK_NEAR(r->a1, creal(X), tol, "a1 at %g", r->omega);
  CHECK_NEAR(r->b1, -cimag(X), tol, "b1 at %g", r->omega); /* Re(X e^{i th}) = a1 cos + b1 sin */
  CHECK_NEAR(r->harmonic_1, cabs(X), tol, "harmonic_1 at %g", r->omega);
  CHECK_NEAR(r->amplitude, cabs(X), tol, "amplitude at %g", r->omega);
  CHECK_NEAR(r->max, cabs(X), tol, "max at %g", r->omega);
  CHECK_NEAR(r->min, -cabs(X), tol, "min at %g", r->omega);
  CHECK_NEAR(r->mean, 0, tol, "mean at %g", r->omega);
  CHECK_NEAR(r->rms, cabs(X) / sqrt(2), tol, "rms at %g", r->omega);
  for (int i = 0; i < TIMEINT_WAVE; ++i)
    CHECK_NEAR(r->wave[i], creal(X * cexp(I * 2 * PI * i / TIMEINT_WAVE)), tol, "wave[%d] at %g", i, r->omega);
  CHECK_LE(r->closure, sc->transient.tolerance, "closure at %g", r->omega);
  assert_int_equal(r->period_multiple, 1);
}

static void without_contacts(CHECK_STATE)
{
  scene sc = scene_linear(1, 0.4, 40, 100);
  const double omegas[] = {1, 3, 6.3, 7, 16};
  for (int i = 0; i < 5; ++i) {
    scene_state y = {0};
    CHECK_FILLED(timeint_result, r, steady(&sc, omegas[i], &y, &r));
    check_harmonic(&sc, &r, response(&sc, 40, omegas[i]));
    CHECK_NEAR(y.x, r.a1, 10 * sc.transient.tolerance * r.amplitude, "the state is on the orbit");
    assert_int_equal(r.regime, CONTACT_LINEAR);
  }
}

/* Amplitude 0.11 of gap 0.5: min N is 200 (0.5 - 0.08) = 84, so softplus differs by exp(-0.42/5e-5), nothing; |T| <=
 * 100 * 0.08 = 8 < 0.3 * 84: no slip. From rest the start-up transient must not slip either: it at most doubles the
 * amplitude: 16 < 0.3 * 68. */
static void stuck_all_period(CHECK_STATE)
{
  scene sc = scene_a10();
  scene_state y = {0};
  CHECK_FILLED(timeint_result, r, steady(&sc, 10, &y, &r));
  check_harmonic(&sc, &r, response(&sc, scene_max_stiffness(&sc), 10));
  assert_int_equal(r.regime, CONTACT_STUCK);
}

/* Separated all period, kt = 0, mu = 0, alpha = 0 and 90 degrees, several in parallel: each is linear while it
 * neither slips nor opens. */
static void linear_contacts(CHECK_STATE)
{
  scene sc = scene_linear(1, 0.4, 40, 1);
  scene_add(&sc, 100, 200, 0.3, -5, 45); /* never touched */
  scene_add(&sc, 0, 60, 0.3, 5, 90);     /* kt = 0: a spring kn */
  scene_add(&sc, 70, 50, 0, 5, 30);      /* mu = 0: kn sin^2 */
  scene_add(&sc, 70, 0, 0.3, 5, 30);     /* kn = 0: nothing */
  scene_add(&sc, 30, 50, 0.9, 5, 0);     /* alpha = 0: kt */
  double k = 40 + 60 + 50 * 0.25 + 30;
  scene_state y = {0};
  CHECK_FILLED(timeint_result, r, steady(&sc, 9, &y, &r));
  check_harmonic(&sc, &r, response(&sc, k, 9));
  assert_int_equal(r.regime, CONTACT_STUCK);
  CHECK_NEAR(y.w[2], y.x * cos(PI / 6), 4 * DBL_EPSILON * fabs(y.x), "a slider without friction is at u");
}

/* Lengths and forces times s: the same numbers times s. CVODE sees states in units of the motion; the quotients'
 * rounding is amplified by steps decided otherwise, so agreement is to the tolerance: both within it of the orbit,
 * and 8 of them of each other as above. */
static void any_scale(CHECK_STATE)
{
  scene sc = scene_c2();
  scene_state y = {.x = 8, .v = 46, .w = {5}};
  timeint_result one, r;
  assert_int_equal(steady(&sc, 7, &y, &one), HC_OK);
  for (int big = 0; big < 2; ++big) {
    double s = big ? 1e9 : 1e-9;
    scene scaled = scene_own(&sc);
    scaled.structure->loads->amplitude *= s, scaled.structure->contacts[0].given.law.gap *= s;
    scene_state z = {.x = 8 * s, .v = 46 * s, .w = {5 * s}};
    assert_int_equal(steady(&scaled, 7, &z, &r), HC_OK);
    CHECK_NEAR(r.amplitude / s, one.amplitude, 10 * sc.transient.tolerance * one.amplitude, "scale %g", s);
    CHECK_NEAR(r.mean / s, one.mean, 10 * sc.transient.tolerance * one.amplitude, "scale %g", s);
    CHECK_LE(fabs((double)r.steps / (double)one.steps - 1), 0.3, "as cheap at scale %g", s);
  }
}

/* A start 1e8 times too large or too small ends on the same orbit, as accurately: CVODE's absolute tolerance follows
 * the motion down. (Kept at the start's size it would be 1e8 * 4e-13 of the motion.) */
static void start_of_any_size(CHECK_STATE)
{
  scene sc = scene_linear(1, 0.4, 40, 100);
  const double starts[] = {1e-8, 1e8};
  for (int i = 0; i < 2; ++i) {
    scene_state y = {.x = starts[i]};
    CHECK_FILLED(timeint_result, r, steady(&sc, 12, &y, &r));
    check_harmonic(&sc, &r, response(&sc, 40, 12));
  }
}

/* No force. In closed form nothing moves, exactly. Marched, a period leaves exp(-0.2 2 pi/7) = 0.836 of the state, and
 * of CVODE's error no more than its tolerance of the start: 0.836^500 = 1e-39 of it in 500 periods, the tolerance being
 * below 1e-12. */
static void without_force(CHECK_STATE)
{
  scene sc = scene_linear(1, 0.4, 40, 0);
  scene_state y = {.x = 1}, z = y;
  sc.transient.max_periods = 500;
  CHECK_FILLED(timeint_result, r, steady(&sc, 7, &y, &r));
  assert_int_equal(r.method, TIMEINT_BY_CLOSED_FORM);
  assert_true(r.amplitude == 0 && r.mean == 0 && y.x == 0 && y.v == 0);
  sc.transient.steady = TRANSIENT_STEADY_MARCH;
  assert_int_equal(steady(&sc, 7, &z, &r), HC_OK);
  assert_int_equal(r.method, TIMEINT_BY_MARCHING);
  CHECK_LE(larger(r.amplitude, hypot(z.x, z.v / 7)), 1e-12, "dies away");
}

/* docs/measurements: case 2 has period 2 at 5.55 and 5.56 (the 1e-4 law shifts frequencies by about 1e-3), period 1
 * at 5.08. */
static void sub_harmonics(CHECK_STATE)
{
  scene sc = scene_c2();
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  scene_state y = {.x = 0};
  timeint_result r;
  const double omegas[] = {5.08, 5.555};
  double from = 4.5;
  for (int i = 0; i < 2; ++i) {
    assert_int_equal(timeint_sweep(ti, from, omegas[i], y.all, NULL), HC_OK);
    assert_int_equal(timeint_steady(ti, omegas[i], y.all, NULL, &r), HC_OK);
    assert_int_equal(r.period_multiple, 1 + i);
    from = omegas[i];
  }
  sc.transient.max_periods = 300; /* 5.3 is aperiodic: said to be not settled, with a last period to show */
  timeint_free(ti);
  assert_int_equal(steady(&sc, 5.3, &y, &r), HC_NOT_SETTLED);
  assert_int_equal(r.period_multiple, 0);
  CHECK_LE(r.periods, 300, "no more than allowed");
  CHECK_LE(1e-6, r.closure, "far from any orbit");
  CHECK_LE(5, r.amplitude, "the last period is measured");
}

static void stopped_and_refused(CHECK_STATE)
{
  scene sc = scene_c2();
  int left = 11;
  sc.transient.steady = TRANSIENT_STEADY_MARCH;
  hc_monitor stop = {.tick = check_stop, .self = &left};
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  scene_state y = {.x = 0}, bad = {.x = NAN};
  timeint_result r;
  assert_int_equal(timeint_steady(ti, 7, y.all, &stop, &r), HC_INTERRUPTED);
  assert_int_equal(r.periods, 10);
  CHECK_LE(1, y.x != 0, "the state is kept");
  left = 11;
  assert_int_equal(timeint_sweep(ti, 7, 8, y.all, &stop), HC_INTERRUPTED);
  assert_int_equal(timeint_steady(ti, 7, bad.all, NULL, &r), HC_BAD_INPUT);
  assert_int_equal(timeint_steady(ti, 0, y.all, NULL, &r), HC_BAD_INPUT);
  assert_int_equal(timeint_sweep(ti, 7, -1, y.all, NULL), HC_BAD_INPUT);
  timeint_free(ti);
  *sc.structure->mass.v = NAN;
  assert_int_equal(scene_timeint(&sc, &ti), HC_BAD_INPUT);
  assert_null(ti);
}

CHECK_TESTS("timeint.steady", 300, without_contacts, stuck_all_period, linear_contacts, any_scale, start_of_any_size,
            without_force, sub_harmonics, stopped_and_refused)
