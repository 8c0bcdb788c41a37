/* test_system.c - what residuals are compared with: the sizes of the forces, added by hand. */
#include "hbm/solver/hbm_solver_impl.h"
#include "tests/hbm/scenes.h"
#include "tests/scene_parts.h"

/* Inertia, damping, spring and forcing of each harmonic count in full, also at resonance, K = M omega^2, where their
 * sum is small; and so does the contact force. In units of their own size each: 4 roundings a harmonic. */
static void forces_add_up_and_never_cancel(CHECK_STATE)
{
  scene sc = scene_named("c2", 2, true, 64);
  sc.hbm.force = HBM_FORCE_EXACT;
  *sc.structure->mass.v = 2, *sc.structure->damping.v = 0.5, *sc.structure->stiffness.v = 18,
  sc.structure->loads->amplitude = 7;
  const double X[] = {-0.1, 0.3, -0.4, 0.06, 0.08}, omega = 3; /* |a + i b| = 0.5 and 0.1 */
  const double inertia = 2 * 9 * 0.5 + 2 * 36 * 0.1, damper = 0.5 * 3 * 0.5 + 0.5 * 6 * 0.1,
               spring = 18 * (0.1 + 0.5 + 0.1);
  double R[5], all, moved;
  sc.structure->contacts[0].given.law.gap = 9; /* closed all the time, and stuck: F = (kt cos^2 + kn sin^2) x */
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  const double held = scene_stuck_stiffness(&sc.structure->contacts[0].given) * (0.1 + 0.5 + 0.1);
  assert_int_equal(hbm_system_residual(&s->sys, omega, X, R), HC_OK);
  const double scale = inertia + damper + spring + held + 7;
  hbm_system_sizes(&s->sys, omega, &all, &moved);
  CHECK_NEAR(all, scale, 16 * DBL_EPSILON * scale, "closed and stuck");
  hbm_solver_free(s);
  sc.structure->contacts[0].given.law.gap = -9; /* never closed */
  assert_int_equal(scene_hbm_solver(&sc, &s), HC_OK);
  assert_int_equal(hbm_system_residual(&s->sys, omega, X, R), HC_OK);
  hbm_system_sizes(&s->sys, omega, &all, &moved);
  assert_true(moved == all); /* no static load */
  CHECK_NEAR(all, scale - held, 16 * DBL_EPSILON * scale, "never closed");
  hbm_solver_free(s);
}

CHECK_TESTS("hbm.system", 20, forces_add_up_and_never_cancel)
