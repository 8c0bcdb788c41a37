/* test_fixed_step.c - hbm.continuation: fixed_step: its steps are what they are said to be, it passes the smooth curve
 * of exact forces with the same solutions as `auto`, and it stops, saying why, where kinks of sampled forces stop a
 * simple code and not `auto`. */
#include "numerics/norm.h"
#include "tests/hbm/traced.h"

static scene fixed(const char *name, int n_harm, bool keep_mean, int n_time, double step, int iterations)
{
  scene sc = scene_named(name, n_harm, keep_mean, n_time);
  sc.hbm.continuation = HBM_CONTINUATION_FIXED_STEP;
  sc.hbm.step = step;
  sc.hbm.iterations = iterations;
  return sc;
}

/* Part of point k + 1 seen from point k that lies along the tangent at k, in the curve's metric. */
static double advance(const hbm_curve *c, int k)
{
  const double *X = hbm_curve_X(c, k), *dX = hbm_curve_dX(c, k), *next = hbm_curve_X(c, k + 1);
  double size = 0, along = 0, length = 0, w2 = c->omega_scale * c->omega_scale, d_omega = c->points[k].d_omega;
  for (int i = 0; i < c->n_coef; ++i) {
    if (i > 0) size += X[i] * X[i]; /* the vibration: not the mean */
    along += dX[i] * (next[i] - X[i]);
    length += dX[i] * dX[i];
  }
  along = along / size + d_omega * (c->points[k + 1].omega - c->points[k].omega) / w2;
  return along / sqrt(length / size + d_omega * d_omega / w2);
}

/* Newton's corrections lie in a plane across the tangent, so that every point but the last, which is put on the end of
 * the sweep, is exactly a step ahead of the one before. The plane is one of Newton's equations: met to the tolerance,
 * 1e-10, of lengths in the metric; ten times that allows for the polishing step and rounding. */
static void every_step_is_the_same(CHECK_STATE)
{
  const double steps[] = {0.05, 0.01};
  for (int i = 0; i < 2; ++i) {
    scene sc = fixed("c2", 5, true, 1024, steps[i], 20);
    sc.hbm.force = HBM_FORCE_EXACT;
    traced t = trace(&sc, 3, 20, "c2");
    assert_int_equal(t.status, HC_OK);
    assert_int_equal(t.curve.rejected, 0);
    for (int k = 0; k + 2 < t.curve.n; ++k) {
      CHECK_NEAR(advance(&t.curve, k), steps[i], 1e-9, "point %d at omega %g", k, t.curve.points[k].omega);
      assert_true(t.curve.points[k + 1].iterations <= 21); /* the cap, and one to polish */
    }
    free_traced(&t);
  }
}

/* Both solve the same equations to 1e-10 of the forces, at 8 and 9 well off the folds (7.337, 9.21): 1e-8 of the
 * amplitudes leaves a factor 100 for the inverse of the Jacobian. Downwards too. */
static void smooth_curve_is_the_one_of_auto(CHECK_STATE)
{
  for (int down = 0; down <= 1; ++down) {
    scene sc = fixed("c2", 5, true, 1024, 0.02, 20), as_always;
    sc.hbm.force = HBM_FORCE_EXACT;
    as_always = sc;
    as_always.hbm.continuation = HBM_CONTINUATION_AUTO;
    traced a = trace(&sc, down ? 20 : 3, down ? 3 : 20, "fixed"),
           b = trace(&as_always, down ? 20 : 3, down ? 3 : 20, "auto");
    assert_int_equal(a.status, HC_OK);
    assert_int_equal(a.curve.turning_points, 2);
    for (double omega = 8; omega <= 9; omega += 0.5) {
      hbm_curve ours = {0}, theirs = {0};
      assert_int_equal(hbm_curve_at(a.s, &a.curve, omega, &ours), HC_OK);
      assert_int_equal(hbm_curve_at(b.s, &b.curve, omega, &theirs), HC_OK);
      assert_int_equal(ours.n, 3);
      assert_int_equal(theirs.n, 3);
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < ours.n_coef; ++i) {
          double size = norm_2(ours.n_coef, hbm_curve_X(&theirs, k));
          CHECK_NEAR(hbm_curve_X(&ours, k)[i], hbm_curve_X(&theirs, k)[i], 1e-8 * size, "omega %g", omega);
        }
      hbm_curve_free(&ours);
      hbm_curve_free(&theirs);
    }
    free_traced(&a);
    free_traced(&b);
  }
}

/* Case 2 with kn = 3e3 and N = 2^7 samples, restarted on a sample, without harmonic 0: the paper's code fails there
 * (figure 17). The sampled curve has a sawtooth's corners, some of which turn by more than a plane a step ahead can
 * meet: fixed steps stop, at whatever length, and keep what they have; `auto` gets round every corner. */
static void sampled_corners_stop_it(CHECK_STATE)
{
  const double steps[] = {0.05, 0.02, 0.01, 0.005};
  for (int i = 0; i < 4; ++i) {
    scene sc = fixed("c2", 1, false, 128, steps[i], 20);
    sc.structure->contacts[0].given.law.kn = 3e3;
    sc.hbm.restart = HBM_RESTART_SAMPLE;
    traced t = trace(&sc, 3, 40, "kn 3e3");
    assert_int_equal(t.status, HC_NOT_CONVERGED);
    assert_true(t.curve.n > 10 && t.curve.points[t.curve.n - 1].omega > 10);
    free_traced(&t);
  }
  scene sc = fixed("c2", 1, false, 128, 0.02, 20);
  sc.structure->contacts[0].given.law.kn = 3e3;
  sc.hbm.restart = HBM_RESTART_SAMPLE;
  sc.hbm.continuation = HBM_CONTINUATION_AUTO;
  hbm_curve whole = {0};
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  assert_int_equal(hbm_trace(s, 3, 40, NULL, &whole), HC_OK); /* some 5000 steps: more than trace() lets pass */
  hbm_curve_free(&whole);
  hbm_solver_free(s);
}

/* Newton must not take more than it may: with 1 it cannot follow where the curve bends, and says so. In the linear part
 * it can at the start only, since the equations are linear in X but not in omega. */
static void capped_iterations_stop_it(CHECK_STATE)
{
  scene sc = fixed("c2", 5, true, 1024, 0.05, 1);
  sc.hbm.force = HBM_FORCE_EXACT;
  traced t = trace(&sc, 3, 20, "one iteration");
  assert_int_equal(t.status, HC_NOT_CONVERGED);
  assert_true(t.curve.n >= 1 && t.curve.iterations <= 2 * t.curve.n + 25);
  free_traced(&t);
}

static void what_adapts_is_refused(CHECK_STATE)
{
  for (int samples = 0; samples <= 1; ++samples) {
    scene sc = fixed("c2", samples ? 3 : HBM_AUTO, true, samples ? HBM_AUTO : 1024, 0.02, 20);
    sc.hbm.accuracy = 1e-4;
    hbm_curve curve = {0};
    CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
    assert_int_equal(hbm_trace(s, 3, 20, NULL, &curve), HC_BAD_INPUT);
    assert_int_equal(curve.n, 0);
    hbm_curve_free(&curve);
    hbm_solver_free(s);
  }
}

CHECK_TESTS("hbm.fixed_step", 100, every_step_is_the_same, smooth_curve_is_the_one_of_auto, sampled_corners_stop_it,
            capped_iterations_stop_it, what_adapts_is_refused)
