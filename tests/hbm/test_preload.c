/* test_preload.c - a preload many orders of magnitude above what moves the mass must not drown it in rounding.
 *
 * kn gap = 8e8, a motion of 1e-10: in contact all the time and stuck, the force is (kt cos^2 + kn sin^2) x, with
 * nothing left of the preload. As a difference N - N0 it would carry 8e8 units of 1e-16, five orders more than the
 * force itself. Found by `stress`. */
#include "tests/hbm/scene_forces.h"
#include "tests/hbm/scenes.h"
#include "tests/scene_parts.h"

enum { H = 3, N_COEF = 2 * H + 1 };
static const double X[N_COEF] = {1e-11, 1e-10, -2e-10, 3e-11, 1e-11, 0, -5e-12};

static scene preloaded(void)
{
  scene sc = scene_named("a10", H, true, 64);
  sc.structure->contacts[0].given.law = (contact){.kt = 3e6, .kn = 1e8, .mu = 0.5, .gap = 8};
  sc.structure->contacts[0].given.angle_deg = 30;
  return sc;
}

/* Each coefficient sums 2H+1 (exact) or 64 (sampled) products: as many rounding units of the largest. */
static void check(const double *F, double terms, const char *which)
{
  const scene sc = preloaded();
  const double k = scene_stuck_stiffness(&sc.structure->contacts[0].given);
  for (int i = 0; i < N_COEF; ++i) CHECK_NEAR(F[i], k * X[i], terms * DBL_EPSILON * k * 2e-10, "%s, row %d", which, i);
}

static void exact_force_of_a_small_motion(CHECK_STATE)
{
  scene sc = preloaded();
  double F[N_COEF];
  CHECK_MADE(contact_forces, e, scene_forces(&sc, HBM_FORCE_EXACT, H, 0, &e));
  assert_int_equal(forces_eval(e, H, X, F, NULL, NULL), HC_OK);
  contact_forces_free(e);
  check(F, 4 * N_COEF, "exact");
}

static void sampled_force_of_a_small_motion(CHECK_STATE)
{
  scene sc = preloaded();
  double F[N_COEF];
  CHECK_MADE(contact_forces, a, scene_forces(&sc, HBM_FORCE_SAMPLED, H, 64, &a));
  assert_int_equal(forces_eval(a, H, X, F, NULL, NULL), HC_OK);
  contact_forces_free(a);
  check(F, 64, "sampled");
}

/* Open for part of the period the preload is missing there: against samples, whose error is d^2/8 times the jumps of
 * the force's derivative, d = 2 pi/N. */
static void an_opening_takes_the_preload_away(CHECK_STATE)
{
  enum { N = 8192 };
  scene sc = preloaded();
  const double large[N_COEF] = {0, 20, 0, 1, 0, 0, 0};
  double F[N_COEF], G[N_COEF];
  CHECK_MADE(contact_forces, e, scene_forces(&sc, HBM_FORCE_EXACT, H, 0, &e));
  CHECK_FILLED(contact_report, report, forces_eval(e, H, large, F, NULL, &report));
  assert_int_equal(report.regime, CONTACT_SEPARATES);
  CHECK_MADE(contact_forces, a, scene_forces(&sc, HBM_FORCE_SAMPLED, H, N, &a));
  assert_int_equal(forces_eval(a, H, large, G, NULL, NULL), HC_OK);
  const double d = 2 * PI / N, rate = 1e8 * 22; /* at most kn |x'|; some ten transitions and intervals, each counted
                                                    once */
  for (int i = 0; i < N_COEF; ++i) CHECK_NEAR(F[i], G[i], 10 * rate * d * d / 8, "row %d", i);
  contact_forces_free(e);
  contact_forces_free(a);
}

CHECK_TESTS("hbm.preload", 30, exact_force_of_a_small_motion, sampled_force_of_a_small_motion,
            an_opening_takes_the_preload_away)
