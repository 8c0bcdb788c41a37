/* test_no_allocation.c - after the first call, evaluating the contact force and solving at a frequency allocate
 * nothing. */
#include <fftw3.h>
#include <nvector/nvector_serial.h>

#include "compare/study/scene_solvers.h"
#include "hbm/contact/exact_force.h"
#include "hbm/planar/planar_force.h"
#include "numerics/sundials_compat.h"
#include "tests/counted.h"
#include "tests/hbm/scene_forces.h"
#include "tests/hbm/scenes.h"

/* The counter must see what libraries do, or the tests below would pass for nothing. */
static void the_counter_sees_libraries(CHECK_STATE)
{
  if (!COUNTED) skip();
  long before = allocations;
  double *a = fftw_alloc_real(100);
  assert_true(allocations > before);
  fftw_free(a);
  SUNContext ctx;
  before = allocations;
  assert_int_equal(hc_sundials_context(&ctx), 0);
  assert_true(allocations > before);
  before = allocations;
  N_Vector v = N_VNew_Serial(10, ctx);
  assert_true(allocations > before);
  N_VDestroy(v);
  SUNContext_Free(&ctx);
}

/* For sizes made of small primes. FFTW's own transforms of others (101, 1001 = 7 11 13, 1021 with Debian's FFTW 3.3)
 * take work space at each call, once to four times a transform: what aft.c promises does not hold for those. */
static void force_allocates_nothing(CHECK_STATE)
{
  static const int sizes[] = {64, 100, 1000, 4096};
  enum { H = 10, N_COEF = 2 * H + 1 };
  double X[N_COEF], F[N_COEF], jac[N_COEF * N_COEF];
  contact_report report;
  uint64_t seed = 11;
  for (int i = 0; i < 4; ++i) {
    scene sc = scene_named("c2", H, true, sizes[i]);
    CHECK_MADE(contact_forces, a, scene_forces(&sc, HBM_FORCE_SAMPLED, H, sizes[i], &a));
    random_motion(&seed, H, 10, 2, X);
    assert_int_equal(forces_eval(a, H, X, F, jac, &report), HC_OK);
    long before = allocations;
    for (int k = 0; k < 20; ++k) {
      random_motion(&seed, H, 10, 2, X);
      assert_int_equal(forces_eval(a, H, X, F, k % 2 ? jac : NULL, &report), HC_OK);
    }
    long after = allocations; /* cmocka may allocate */
    contact_forces_free(a);
    if (after != before) fail_msg("N = %d: %ld allocations in 20 evaluations", sizes[i], after - before);
  }
}

/* SUNDIALS 7 allocates, and frees, a message in each KINSol call that fails, although the handler drops it; 6
 * allocates nothing. A solve that fails calls KINSol twice, once a strategy. */
enum { MESSAGES = SUNDIALS_VERSION_MAJOR >= 7 ? 2 : 0 };

/* Event-located forces, with and without Jacobian, one coordinate and two, motions that touch, slip, or do neither. */
static void exact_force_allocates_nothing(CHECK_STATE)
{
  enum { H = 20, N_COEF = 2 * H + 1 };
  static double X[2 * N_COEF], F[2 * N_COEF], jac[4 * N_COEF * N_COEF];
  contact_report report;
  uint64_t seed = 12;
  for (int n_dof = 1; n_dof <= 2; ++n_dof) {
    moving_contact c[2] = {{{100, 1000, 0.3, -5}, {0.7, 0.1}, {0.7, 0.2}}, {{100, 1000, 0.3, 1}, {0.7, 0}, {0, 0.7}}};
    int bad = 0;
    CHECK_MADE(exact_force, e, exact_force_new(H, n_dof, 2, c, &e));
    long before = allocations;
    for (int k = 0; k < 40; ++k) {
      random_motion(&seed, H, k % 3 ? 10 : 0.1, 2, X);
      random_motion(&seed, H, k % 3 ? 10 : 0.1, 2, X + N_COEF);
      bad += exact_force_eval(e, X, F, k % 2 ? jac : NULL, k % 4 ? &report : NULL) != HC_OK;
    }
    long after = allocations;
    exact_force_free(e);
    assert_int_equal(bad, 0);
    assert_int_equal(after - before, 0);
  }
}

/* The same in a plane: always in contact, coming and going, and under a constant normal force. */
static void circle_force_allocates_nothing(CHECK_STATE)
{
  enum { H = 5, N_COEF = 2 * H + 1 };
  static double X[3 * N_COEF], F[3 * N_COEF], jac[9 * N_COEF * N_COEF];
  static const contact halves[] = {{2, 1, 0.6, 1.5, 0}, {2, 1, 0.6, 0.1, 0}, {2, 0, 0.6, 0, 1}};
  contact_report report;
  uint64_t seed = 13;
  for (int i = 0; i < 3; ++i) {
    int bad = 0;
    CHECK_MADE(planar_force, f, planar_force_new(H, i < 2 ? 3 : 2, &halves[i], &f));
    long before = allocations;
    for (int k = 0; k < 40; ++k) {
      for (int d = 0; d < 3; ++d) random_motion(&seed, H, 1, 1, X + d * N_COEF);
      bad += planar_force_eval(f, X, F, k % 2 ? jac : NULL, k % 4 ? &report : NULL) != HC_OK;
    }
    long after = allocations;
    planar_force_free(f);
    assert_int_equal(bad, 0);
    assert_int_equal(after - before, 0);
  }
}

/* Solving, measuring, predicting, and failing to solve: from 1e30 away, which ends in both strategies. */
static void solving_with(int force)
{
  enum { H = 10, N_COEF = 2 * H + 1 };
  scene sc = scene_named("c2", H, true, 1024);
  sc.hbm.force = force;
  hbm_measures m;
  double X[N_COEF], Y[N_COEF] = {0};
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, 6, NULL, X, &point));
  assert_int_equal(hbm_solve(s, 6.01, X, &point), HC_OK);
  CHECK_FILLED(motion_error, e, hbm_predict(s, 6.01, X, &e));
  long good = 0, wild = 0; /* allocations: in all good solves, most in one wild */
  int bad = 0, failed = 0;
  for (int k = 0; k < 50; ++k) {
    long before = allocations;
    bad += hbm_solve(s, 6 + 0.01 * k, X, &point) != HC_OK || hbm_measure(s, X, &m) != HC_OK;
    bad += hbm_predict(s, 6 + 0.01 * k, X, &e) != HC_OK;
    good += allocations - before;
    Y[0] = 1e3;
    for (int i = 1; i < N_COEF; ++i) Y[i] = (i * 7919 % 13 - 6) * 1e2;
    before = allocations;
    failed += hbm_solve(s, 8 + 0.01 * k, Y, &point) != HC_OK;
    if (allocations - before > wild) wild = allocations - before;
  }
  hbm_solver_free(s);
  assert_true(failed > 0); /* or no failing solve was counted */
  assert_int_equal(bad, 0);
  assert_int_equal(good, 0);
  assert_true(wild <= MESSAGES);
}

static void solve_allocates_nothing(CHECK_STATE)
{
  solving_with(HBM_FORCE_SAMPLED);
  solving_with(HBM_FORCE_EXACT);
}

CHECK_TESTS("hbm.no_allocation", 60, the_counter_sees_libraries, force_allocates_nothing, exact_force_allocates_nothing,
            circle_force_allocates_nothing, solve_allocates_nothing)
