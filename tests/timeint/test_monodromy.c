/* test_monodromy.c - the monodromy matrix of a period (regularised law): against differences of periods. */

#include "model/linear.h"
#include "tests/scene_parts.h"
#include "tests/timeint/scenes.h"

enum { N = 3 }; /* X, P and one slider */

static integrator *make(const scaled_model *m, double tolerance)
{
  CHECK_MADE(integrator, in, integrate_new_regularised(m->base, tolerance, &in));
  return in;
}

/* Every step errs by up to 1e-6 of the variations (variation_tolerance); some 1300 steps, corners among them, add up
 * like independent errors to 4e-5. Allowed: 1e-4 (worst seen: 2.4e-5). The differences: a period at 1e-13 scatters by
 * up to 250 times that (timeint.c), over h = 1e-5 that is 4e-6. Their truncation has no bound here; that it is small
 * shows in the agreement. */
static void compare(const scene *from, const char *name, double omega, double length, double regularisation)
{
  scene sc = *from;
  scaled_model m;
  sc.transient.regularisation = regularisation;
  scene_scaled(&m, &sc, omega, length);
  integrator *fine = make(&m, 1e-13);
  double y[N] = {0.7, 0.5, 0.4}, want[N * N], monodromy[N * N], alone[2][2], apart = 0;
  for (int i = 0; i < 50; ++i) assert_int_equal(integrate_period(fine, &m, y, NULL, NULL), HC_OK);
  /* Central differences of fourth order. */
  static const double at[4] = {1, -1, 2, -2}, weight[4] = {8, -8, -1, 1};
  memset(want, 0, sizeof *want * N * N);
  for (int j = 0; j < N; ++j)
    for (int k = 0; k < 4; ++k) {
      double z[N] = {y[0], y[1], y[2]};
      z[j] += at[k] * 1e-5;
      assert_int_equal(integrate_period(fine, &m, z, NULL, NULL), HC_OK);
      for (int i = 0; i < N; ++i) want[i + j * N] += weight[k] * z[i] / (12 * 1e-5);
    }
  linear_free_motion(1, scene_c(&m), scene_k(&m), 2 * PI, alone);
  for (int i = 0; i < 4; ++i) apart = fmax(apart, fabs(want[i % 2 + i / 2 * N] - alone[i % 2][i / 2]));
  CHECK_LE(0.1, apart, "%s at %g: the contact takes part", name, omega);
  for (double tol = 1e-8; tol > 1e-13; tol *= 1e-2) {
    integrator *in = make(&m, tol);
    double z[N] = {y[0], y[1], y[2]}, plain[N] = {y[0], y[1], y[2]};
    assert_int_equal(integrate_period(in, &m, plain, NULL, NULL), HC_OK);
    assert_int_equal(integrate_monodromy(in, &m, z, monodromy), HC_OK);
    for (int i = 0; i < N * N; ++i)
      CHECK_NEAR(monodromy[i], want[i], 1e-4, "%s at %g, %g: monodromy[%d] at %g", name, omega, regularisation, i, tol);
    /* both within 400 tolerances of the exact end (INTEGRATE_BDF_SCATTER): as good, if not the same bits */
    for (int i = 0; i < N; ++i)
      CHECK_NEAR(z[i], plain[i], 800 * tol, "%s at %g, %g: y[%d] at %g", name, omega, regularisation, i, tol);
    integrate_free(in);
  }
  integrate_free(fine);
}

static void monodromy_is_the_difference_of_periods(CHECK_STATE)
{
  scene c2 = scene_c2(), b10 = scene_b10(), a10 = scene_a10();
  for (double regularisation = 1e-4; regularisation < 0.1; regularisation *= 100) {
    compare(&c2, "c2", 9, 20, regularisation);
    compare(&b10, "b10", 7, 1.4, regularisation);
    compare(&a10, "a10", 13, 0.7, regularisation);
  }
}

static void a_period_with_monodromy_does_not_affect_the_next(CHECK_STATE)
{
  scene sc = scene_c2();
  scaled_model m;
  scene_scaled(&m, &sc, 7, 10);
  integrator *in = make(&m, 1e-10);
  double y[N] = {0.8, 0.6, 0.5}, z[N] = {0.8, 0.6, 0.5}, w[N] = {0.8, 0.6, 0.5}, v[N] = {0.8, 0.6, 0.5},
         monodromy[2][N * N];
  assert_int_equal(integrate_period(in, &m, y, NULL, NULL), HC_OK);
  assert_int_equal(integrate_monodromy(in, &m, w, monodromy[0]), HC_OK);
  assert_int_equal(integrate_period(in, &m, z, NULL, NULL), HC_OK);
  assert_int_equal(integrate_monodromy(in, &m, v, monodromy[1]), HC_OK);
  assert_memory_equal(y, z, sizeof y); /* whatever came before: the same bits */
  assert_memory_equal(w, v, sizeof w);
  assert_memory_equal(monodromy[0], monodromy[1], sizeof monodromy[0]);
  m.by_load = NAN;
  assert_int_equal(integrate_monodromy(in, &m, v, monodromy[1]), HC_NOT_FINITE);
  assert_memory_equal(w, v, sizeof w); /* y stays on failure */
  scene_scaled(&m, &sc, 7, 10);
  double u[N] = {0.8, 0.6, 0.5};
  assert_int_equal(integrate_monodromy(in, &m, u, monodromy[1]), HC_OK); /* and works again */
  assert_memory_equal(monodromy[0], monodromy[1], sizeof monodromy[0]);
  integrate_free(in);
}

CHECK_TESTS("timeint.monodromy", 120, monodromy_is_the_difference_of_periods,
            a_period_with_monodromy_does_not_affect_the_next)
