/* test_newton_linear.c - the linear solver of Newton's method: every way gives the same answers, through SUNDIALS, and
 * SPGMR falls back to factors where it fails. */
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "numerics/lu.h"
#include "numerics/newton_linear.h"
#include "numerics/sundials_compat.h"
#include "tests/check.h"
#include "tests/random.h"

enum { N = 151 /* odd: a pivot miscounted everywhere turns the sign over */ };

typedef struct bench {
  SUNContext ctx;
  SUNMatrix m;
  N_Vector b, x;
  SUNLinearSolver ls;
  double a[N * N]; /* the matrix in m before it was factored */
} bench;

static void set_up(bench *w, newton_way way)
{
  assert_int_equal(hc_sundials_context(&w->ctx), 0);
  w->m = SUNDenseMatrix(N, N, w->ctx);
  w->b = N_VNew_Serial(N, w->ctx);
  w->x = N_VNew_Serial(N, w->ctx);
  assert_non_null(w->ls = newton_linear_solver(N, way, w->ctx));
}

static void tear_down(bench *w)
{
  SUNLinSolFree(w->ls);
  N_VDestroy(w->b);
  N_VDestroy(w->x);
  SUNMatDestroy(w->m);
  SUNContext_Free(&w->ctx);
}

/* Entries in [-1, 1), and n on the diagonal: the condition is less than 10. */
static void random_problem(uint64_t *seed, bench *w)
{
  for (int i = 0; i < N * N; ++i) w->a[i] = random_signed(seed) + (i % (N + 1) == 0 ? N : 0);
  for (int i = 0; i < N; ++i) N_VGetArrayPointer(w->b)[i] = random_signed(seed);
}

static void take(bench *w) { memcpy(SUNDenseMatrix_Data(w->m), w->a, sizeof w->a); }

/* Largest |A x - b| over the largest |b|. */
static double residual(const bench *w)
{
  const double *x = N_VGetArrayPointer(w->x), *b = N_VGetArrayPointer(w->b);
  double worst = 0, size = 0;
  for (int i = 0; i < N; ++i) {
    double sum = -b[i];
    for (int j = 0; j < N; ++j) sum += w->a[i + N * j] * x[j];
    worst = fmax(worst, fabs(sum));
    size = fmax(size, fabs(b[i]));
  }
  return worst / size;
}

/* Own LU bit for bit what lu.h gives; LAPACK's within rounding: n units times the condition. */
static void direct_ways_solve(void **state)
{
  (void)state;
  static bench w;
  static double f[N * N];
  for (newton_way way = NEWTON_OWN_LU; way <= NEWTON_LAPACK_LU; ++way) {
    uint64_t seed = 5;
    int pivot[N];
    double x[N];
    set_up(&w, way);
    random_problem(&seed, &w);
    take(&w);
    memcpy(f, w.a, sizeof f);
    memcpy(x, N_VGetArrayPointer(w.b), sizeof x);
    assert_true(lu_factor(N, f, pivot));
    lu_solve(N, f, pivot, x);
    assert_int_equal(SUNLinSolSetup(w.ls, w.m), 0);
    assert_int_equal(newton_linear_sign(w.ls, w.m), lu_sign(N, f, pivot));
    assert_int_equal(SUNLinSolSolve(w.ls, w.m, w.x, w.b, 0), 0);
    if (way == NEWTON_OWN_LU) assert_memory_equal(N_VGetArrayPointer(w.x), x, sizeof x);
    CHECK_LE(residual(&w), N * 10 * 2.2e-16, "way %d", way);
    SUNMatZero(w.m);
    assert_true(SUNLinSolSetup(w.ls, w.m) > 0);
    tear_down(&w);
  }
}

/* A matrix that changed by 1e-2 of its diagonal is solved by SPGMR with the old factors, to 1e-5 of the right side in
 * the 2-norm, which is at most sqrt(n) of it in the largest entry; one of opposite sign in half of its rows is not, and
 * is factored; what is factored at last has the sign of that. */
static void krylov_uses_old_factors_while_they_serve(void **state)
{
  (void)state;
  static bench w;
  uint64_t seed = 9;
  set_up(&w, NEWTON_KRYLOV);
  random_problem(&seed, &w);
  take(&w);
  assert_int_equal(SUNLinSolSetup(w.ls, w.m), 0); /* the first: there are no factors yet */
  assert_int_equal(newton_linear_sign(w.ls, w.m), 1);
  for (int i = 0; i < N * N; ++i) w.a[i] += 0.01 * N * random_signed(&seed) / 12; /* norm 0.01 n: sqrt(n) = 12 */
  take(&w);
  assert_int_equal(SUNLinSolSetup(w.ls, w.m), 0);
  assert_int_equal(SUNLinSolSolve(w.ls, w.m, w.x, w.b, 0), 0);
  CHECK_LE(residual(&w), 1e-5 * 13, "by old factors");
  newton_work work = newton_linear_work(w.ls);
  assert_int_equal(work.factored, 1);
  assert_int_equal(work.krylov, 1);
  assert_in_range(work.rounds, 2, 6); /* 1e-5 by factors of 0.01 to 0.1 each */
  for (int j = 0; j < N; ++j)         /* now eigenvalues of the preconditioned matrix lie all round 0 */
    for (int i = 0; i < N; ++i) w.a[i + N * j] = random_signed(&seed);
  w.a[0] -= 100;
  take(&w);
  assert_int_equal(SUNLinSolSetup(w.ls, w.m), 0);
  assert_int_equal(SUNLinSolSolve(w.ls, w.m, w.x, w.b, 0), 0);
  CHECK_LE(residual(&w), 1e-9, "by new ones"); /* of LU, with a condition of some 1e4 */
  work = newton_linear_work(w.ls);
  assert_int_equal(work.factored, 2);
  assert_int_equal(work.krylov_failed, 1);
  int pivot[N];
  assert_true(lu_factor(N, w.a, pivot));
  assert_int_equal(newton_linear_sign(w.ls, w.m), lu_sign(N, w.a, pivot));
  tear_down(&w);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(direct_ways_solve),
    cmocka_unit_test(krylov_uses_old_factors_while_they_serve),
};

CHECK_MAIN("numerics.newton_linear", tests, 60)
