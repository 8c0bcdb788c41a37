/* test_shoot.c - orbits as fixed points of the period map, with both laws: in few periods, the same orbit as marching
 * finds, unstable ones too; refused where there is none next to the start. */

#include "tests/hbm/multipliers.h"
#include "tests/scene_parts.h"
#include "tests/timeint/oracle.h"
#include "tests/timeint/scenes.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/timeint_private.h"

static timeint *made(scene sc, int law, int steady, int start)
{
  sc.transient.law = law;
  sc.transient.steady = steady;
  sc.transient.start = start;
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  return ti;
}

/* ---- the period map once more, not by the solver under test ---- */

/* One period of a scene's motion, in units of length. Exact law: in closed form (oracle.h). Regularised: by CVODE at
 * 1e-13, four digits tighter than any orbit here is integrated at. */
typedef struct period_map {
  scaled_model m;
  double length, omega; /* [length], [rad/time] */
  integrator *in;       /* of the regularised law, else NULL */
} period_map;

static period_map map_of(scene sc, int law, double omega, double length)
{
  period_map map = {.length = length, .omega = omega};
  sc.transient.law = law;
  scene_scaled(&map.m, &sc, omega, length);
  if (law == TRANSIENT_LAW_REGULARISED) assert_int_equal(integrate_new_regularised(map.m.base, 1e-13, &map.in), HC_OK);
  return map;
}

static double limit_of(const scaled_model *m, const scaled_contact *c, double x)
{
  return c->law.mu * c->law.kn * (scene_sine(m, c) * x + c->law.gap);
}

/* The contact's state at theta = 0. A traction within 1e-7 of its limit (the orbit is good for 1e-9) slips if it would
 * grow. */
static how state_at(const scaled_model *m, const double *z)
{
  const scaled_contact *c = &m->contact[0];
  const double limit = limit_of(m, c, z[SCALED_X]), t = c->law.kt * (scene_cosine(m, c) * z[SCALED_X] - z[SCALED_W]);
  if (limit <= 0) return APART;
  if (t >= limit - 1e-7 * c->law.kt && z[SCALED_P] > 0) return PLUS;
  return t <= -limit + 1e-7 * c->law.kt && z[SCALED_P] < 0 ? MINUS : STUCK;
}

/* z[3] -> its image, for a scene of one contact. `begins`: the state at theta = 0, exact law only. */
static void apply(const period_map *map, how begins, double *z)
{
  if (map->in) {
    assert_int_equal(integrate_period(map->in, &map->m, z, NULL, NULL), HC_OK);
    return;
  }
  oracle o = {.m = &map->m, .x = z[SCALED_X], .p = z[SCALED_P], .state = {begins}, .held = {z[SCALED_W]}};
  oracle_period(&o);
  z[SCALED_X] = o.x;
  z[SCALED_P] = o.p;
  z[SCALED_W] = oracle_slider(&o, 0);
}

/* Its derivatives at z, phi[3][3] by rows, by central differences with Richardson's extrapolation: of h^2 for X and P,
 * of h for the slider, which enters with |h| where T and N vanish together. */
static void differentiate(const period_map *map, const double *z, double h, double phi[3][3])
{
  static const double smooth[] = {-1 / 12.0, 8 / 12.0, -8 / 12.0, 1 / 12.0}, kinked[] = {-1 / 4.0, 1, -1, 1 / 4.0};
  static const int at[] = {2, 1, -1, -2};
  const how begins = state_at(&map->m, z);
  for (int q = 0; q < 3; ++q)
    for (int k = 0; k < 4; ++k) {
      double y[3] = {z[0], z[1], z[2]};
      y[q] += at[k] * h;
      apply(map, begins, y);
      for (int i = 0; i < 3; ++i)
        phi[i][q] = (k ? phi[i][q] : 0) + (q < SCALED_W || map->in ? smooth : kinked)[k] * y[i] / h;
    }
}

/* The eigenvalue nearest to lambda or its conjugate, and the largest modulus. */
static double nearest_eigenvalue(double phi[3][3], double complex lambda, double *largest)
{
  double off = INFINITY, work[9];
  double complex eigen[3];
  memcpy(work, phi, sizeof work);
  eigenvalues_of(3, work, eigen);
  *largest = 0;
  for (int i = 0; i < 3; ++i) {
    off = fmin(off, hypot(creal(eigen[i]) - creal(lambda), fabs(cimag(eigen[i])) - fabs(cimag(lambda))));
    *largest = fmax(*largest, cabs(eigen[i]));
  }
  return off;
}

/* Is y on an orbit of ti's, with the corner in N that it has there, whose multiplier is *r's?
 * - Shooting ends at a distance of `tolerance` times the size of the state (X, P), of 1 to 1.4 amplitudes.
 * - timeint.h promises the orbit z* within `tolerance` of the amplitude: |F(y) - y| <= |F(y) - F(z*)| + |z* - y| <=
 *   (|Phi| + 1) tolerance, in units of the amplitude, Phi the derivative of the period map F.
 * - A multiplier is off by what the two Phi differ by, times the condition of the eigenvalue, for which 10 is allowed.
 *   Exact law: 1e-6 by the differences in the slider (1e2 h^2 as in test_integrate_exact.c; those in X and P are
 *   nearer). Regularised law: each step of the variational equations errs by up to 1e-6 (variation_tolerance), and
 *   their errors, of either sign, add up like the root of their number. */
static void check_orbit(const scene *sc, const timeint *ti, int law, scene_state y, const timeint_result *r,
                        double tolerance)
{
  period_map map = map_of(*sc, law, r->omega, r->amplitude);
  const double z[3] = {y.x / r->amplitude, y.v / (r->omega * r->amplitude), y.w[0] / r->amplitude};
  double image[3] = {z[0], z[1], z[2]}, phi[3][3], norm = 0, largest;
  map.m.contact[0].law.width = ti->scaled.contact[0].law.width * ti->length / r->amplitude;
  CHECK_LE(r->closure, tolerance * fmax(1, hypot(z[0], z[1])), "closure at %g", r->omega);
  apply(&map, state_at(&map.m, z), image);
  differentiate(&map, z, law == TRANSIENT_LAW_EXACT ? 1e-4 : 1e-5, phi);
  for (int i = 0; i < 9; ++i) norm = hypot(norm, phi[i / 3][i % 3]);
  for (int i = 0; i < 3; ++i)
    CHECK_NEAR(image[i], z[i], (norm + 1) * tolerance, "law %d, state %d after a period at %g", law, i, r->omega);
  const double of_phi = law == TRANSIENT_LAW_EXACT ? 1e-6 : 1e-6 * sqrt((double)r->steps / r->periods);
  const double off = nearest_eigenvalue(phi, r->multiplier_re + I * r->multiplier_im, &largest);
  CHECK_LE(off, 10 * of_phi, "law %d: multiplier %g at %g", law, r->multiplier, r->omega);
  CHECK_NEAR(largest, r->multiplier, 10 * of_phi, "law %d: none is larger at %g", law, r->omega);
  integrate_free(map.in);
}

/* Shooting against marching, with the same law, from the same start: one orbit. Each is within transient.tolerance of
 * it. */
static void finds_what_marching_finds(CHECK_STATE)
{
  const struct {
    scene sc;
    double omega;
  } cases[] = {{scene_b10(), 7}, {scene_c2(), 6}, {scene_a10(), 13}, {scene_gap1(), 25}};
  for (int law = TRANSIENT_LAW_REGULARISED; law <= TRANSIENT_LAW_EXACT; ++law)
    for (int i = 0; i < 4; ++i) {
      timeint *march = made(cases[i].sc, law, TRANSIENT_STEADY_MARCH, TRANSIENT_START_REST);
      timeint *automatic = made(cases[i].sc, law, TRANSIENT_STEADY_AUTO, TRANSIENT_START_REST);
      scene_state y = {.x = 0}, z = y;
      CHECK_FILLED(timeint_result, marched, timeint_steady(march, cases[i].omega, y.all, NULL, &marched));
      CHECK_FILLED(timeint_result, shot, timeint_steady(automatic, cases[i].omega, z.all, NULL, &shot));
      const double tolerance = 2 * cases[i].sc.transient.tolerance;
      CHECK_NEAR(shot.amplitude, marched.amplitude, tolerance * marched.amplitude, "law %d case %d", law, i);
      CHECK_NEAR(shot.a1, marched.a1, tolerance * marched.amplitude, "law %d case %d a1", law, i);
      CHECK_NEAR(shot.b1, marched.b1, tolerance * marched.amplitude, "law %d case %d b1", law, i);
      assert_int_equal(marched.method, TIMEINT_BY_MARCHING);
      assert_int_equal(shot.method, TIMEINT_BY_SHOOTING);
      CHECK_LE(shot.periods, 0.7 * marched.periods, "law %d case %d periods", law, i);
      check_orbit(&cases[i].sc, automatic, law, z, &shot, cases[i].sc.transient.tolerance);
      timeint_free(automatic);
      timeint_free(march);
    }
}

/* From 1 % off the orbit: Newton doubles the digits each iteration, a period an iteration with the exact law. What
 * damping allows a march in one period is 1 - exp(-C T/2M) = 0.1 % of the way (r2). */
static void few_periods_whatever_the_damping(CHECK_STATE)
{
  const struct {
    scene sc;
    double omega, from;
    int most;
  } cases[] = {{scene_c2(), 9, 7, 20}, {scene_r2(), 708.5, 700, 60}};
  for (int i = 0; i < 2; ++i) {
    timeint *ti = made(cases[i].sc, TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_AUTO, TRANSIENT_START_UP);
    scene_state y = {.x = 0};
    assert_int_equal(timeint_sweep(ti, cases[i].from, cases[i].omega, y.all, NULL), HC_OK);
    CHECK_FILLED(timeint_result, r, timeint_steady(ti, cases[i].omega, y.all, NULL, &r));
    timeint_free(ti);
    ti = made(cases[i].sc, TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_AUTO, TRANSIENT_START_HBM);
    y.x *= 1.01;
    assert_int_equal(timeint_steady(ti, cases[i].omega, y.all, NULL, &r), HC_OK);
    CHECK_LE(r.periods, cases[i].most, "case %d", i);
    CHECK_LE(r.closure, 1e-9, "case %d", i);
    CHECK_LE(r.multiplier, 1, "case %d", i);
    timeint_free(ti);
  }
}

/* The orbit of one period, run through k times: its multiplier is that of one period to the power k, and it is still
 * reported as an orbit of one period. Both points are within 1e-9 of the orbit: a multiplier, of derivative 10 or less
 * there as check_orbit allows, is off by 1e-8, its k-th power by k times that. */
static void k_periods_multiply(CHECK_STATE)
{
  const struct {
    scene sc;
    double omega;
  } cases[] = {{scene_b10(), 7}, {scene_c2(), 6}, {scene_gap1(), 25}};
  for (int i = 0; i < 3; ++i) {
    timeint *ti = made(cases[i].sc, TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_AUTO, TRANSIENT_START_REST);
    scene_state y = {.x = 0};
    timeint_result once, r;
    assert_int_equal(timeint_steady(ti, cases[i].omega, y.all, NULL, &once), HC_OK);
    for (int k = 2; k <= 5; ++k) {
      assert_int_equal(timeint_orbit(ti, cases[i].omega, k, y.all, NULL, &r), HC_OK);
      const double complex power = cpow(once.multiplier_re + I * once.multiplier_im, k);
      CHECK_NEAR(r.multiplier, pow(once.multiplier, k), 1e-8 * k, "case %d, k = %d", i, k);
      CHECK_NEAR(r.multiplier_re, creal(power), 1e-8 * k, "case %d, k = %d", i, k);
      CHECK_NEAR(fabs(r.multiplier_im), fabs(cimag(power)), 1e-8 * k, "case %d, k = %d", i, k);
      assert_int_equal(r.period_multiple, 1);
    }
    timeint_free(ti);
  }
}

/* Stuck all period: the slider may rest anywhere in an interval. It stays where it is; the mean depends on it, and
 * nothing else does. x = (steady) + kt c w/(K + kt c^2 + kn s^2) with w at rest. */
static void a_free_slider_is_left_alone(CHECK_STATE)
{
  const scene sc = scene_a10();
  const double offset[] = {0, 0.02, -0.05}, c = sqrt(0.5), share = 100 * c / (40 + 100 * 0.5 + 200 * 0.5);
  for (int law = TRANSIENT_LAW_REGULARISED; law <= TRANSIENT_LAW_EXACT; ++law)
    for (int i = 0; i < 3; ++i) {
      timeint *ti = made(sc, law, TRANSIENT_STEADY_SHOOTING, TRANSIENT_START_REST);
      scene_state y = {.x = 0.15 + share * offset[i], .w = {offset[i]}};
      CHECK_FILLED(timeint_result, r, timeint_orbit(ti, 12, 1, y.all, NULL, &r));
      assert_int_equal(r.free_sliders, 1);
      CHECK_NEAR(r.amplitude, 10 / hypot(190 - 12 * 12, 0.4 * 12), 1e-9, "law %d", law); /* F0/|k - w^2 + i C w| */
      CHECK_NEAR(r.mean, share * offset[i], 1e-9, "law %d offset %g", law, offset[i]);
      CHECK_NEAR(y.w[0], offset[i], 1e-15, "law %d offset %g", law, offset[i]);
      timeint_free(ti);
    }
}

/* Case 2 has three orbits at 9: the two outer are stable, the one between is a saddle, with a real multiplier beyond
 * 1. Shooting finds each from 10 % off, says which it is, and reports none where none is next to the start. */
static void unstable_orbits_are_found_and_named(CHECK_STATE)
{
  const scene sc = scene_c2();
  const struct {
    double x, v, w;
    int stable;
  } orbits[] = {{-2.42, 1.91, -1.71, 1}, {-20.5, 78.8, -14.5, -1}};
  timeint *ti = made(sc, TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_SHOOTING, TRANSIENT_START_HBM);
  timeint_result r;
  for (int i = 0; i < 2; ++i)
    for (int way = 0; way < 4; ++way) {
      const double off_x = way & 1 ? 1.1 : 0.9, off_v = way & 2 ? 1.1 : 0.9;
      scene_state y = {.x = orbits[i].x * off_x, .v = orbits[i].v * off_v, .w = {orbits[i].w}};
      assert_int_equal(timeint_orbit(ti, 9, 1, y.all, NULL, &r), HC_OK);
      assert_int_equal(timeint_stability(&r), orbits[i].stable);
      check_orbit(&sc, ti, TRANSIENT_LAW_EXACT, y, &r, 1e-9);
      CHECK_NEAR(y.x, orbits[i].x, 5e-3 * fabs(orbits[i].x), "orbit %d, to the digits above", i);
      if (orbits[i].stable < 0) CHECK_NEAR(r.multiplier_im, 0, 0, "a saddle");
    }
  scene_state far = {.x = 8, .v = 300};
  assert_int_equal(timeint_orbit(ti, 9, 1, far.all, NULL, &r), HC_NOT_CONVERGED);
  timeint_free(ti);
}

/* Anderson's acceleration integrates without the variational equations; what it ends on has their matrix all the same.
 * From beside case 2's inner orbit at 9, and from rest without a load, where F(z) = z exactly and nothing is integrated
 * a second time for the matrix' sake: there the multiplier is that of the free mass, exp(-pi c/(m omega)). */
static void anderson_ends_with_the_matrix(CHECK_STATE)
{
  scene rows[] = {scene_c2(), scene_c2()};
  rows[1].structure->loads->amplitude = 0;
  rows[1].structure->contacts[0].given.law.gap = -1;
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
    timeint *ti = made(rows[i], TRANSIENT_LAW_EXACT, TRANSIENT_STEADY_SHOOTING, TRANSIENT_START_HBM);
    scene_state y = {.all = {0}};
    if (i == 0) y = (scene_state){.x = -2.4, .v = 1.9, .w = {-1.7}};
    assert_int_equal(timeint_begin(ti, 9, y.all), HC_OK);
    CHECK_FILLED(shoot_report, anderson, shoot_anderson(ti->shoot, 1, orbit_goal(ti), NULL, &anderson));
    assert_int_equal(timeint_begin(ti, 9, y.all), HC_OK);
    CHECK_FILLED(shoot_report, newton, shoot_newton(ti->shoot, 1, 10, orbit_goal(ti), NULL, &newton));
    CHECK_NEAR(cabs(anderson.multiplier), cabs(newton.multiplier), 1e-7, "case %zu", i);
    if (i == 1) {
      const double free_mass = exp(-0.5 * TWO_PI * *rows[i].structure->damping.v / (*rows[i].structure->mass.v * 9));
      CHECK_NEAR(cabs(anderson.multiplier), free_mass, 1e-12, "at rest");
    }
    timeint_free(ti);
  }
}

CHECK_TESTS("timeint.shoot", 120, finds_what_marching_finds, few_periods_whatever_the_damping, k_periods_multiply,
            a_free_slider_is_left_alone, unstable_orbits_are_found_and_named, anderson_ends_with_the_matrix)
