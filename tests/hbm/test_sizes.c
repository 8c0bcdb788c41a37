/* test_sizes.c - a structure of some size, the bladed disk of cases/structures: its symmetry, and that it does not
 * matter how Newton's linear equations are solved. */
#include <complex.h>

#include "tests/hbm/structure_cases.h"

enum { H = 5, LENGTH = 2 * H + 1, SECTORS = 24, ORDER = 3 };

static void check_found(const structure_case *c, double omega, double *X, hbm_solver **s)
{
  hbm_point point;
  hbm_measures measures;
  *s = structure_solver(c);
  assert_int_equal(hbm_solve_first(*s, omega, X, &point), HC_OK);
  assert_int_equal(hbm_measure(*s, X, &measures), HC_OK);
  assert_int_equal(measures.contact.regime, CONTACT_SLIPS);
  assert_int_equal(measures.contact.free_sliders, 0);
}

/* Sector k does what sector 0 does, 3 k/24 of a period later: harmonic h is turned by exp(-2 pi i h 3 k/24). All
 * contacts slip, so that there is one motion. The residual is 1e-13 of the forces; at a resonance of 0.3 % damping
 * motions are off by up to 1/0.006 times as much, and higher harmonics are measured by the largest: 1e-10. */
static void sectors_follow_each_other(void **state)
{
  (void)state;
  static const int sectors[] = {1, 5, 18};
  for (size_t q = 0; q < sizeof sectors / sizeof *sectors; ++q) {
    structure_case c = structure_case_named("bladed_disk", H);
    const int n = c.model->n, k = sectors[q];
    hbm_solver *s;
    double X[CASE_MAX_COEF], x[2][LENGTH];
    assert_int_equal(n, 4 * SECTORS);
    for (int i = 0; i < n; ++i) c.model->responses[n + i] = i == 3 * k + 2; /* the tip of sector k */
    check_found(&c, 985, X, &s);
    for (int r = 0; r < 2; ++r) assert_int_equal(hbm_response(s, 985, X, r, x[r]), HC_OK);
    const double size = hypot(x[0][1], x[0][2]);
    assert_true(size > 2e-3 && hypot(x[0][5], x[0][6]) > 1e-6 * size);
    for (int h = 1; h <= H; ++h) {
      const double complex first = x[0][2 * h - 1] - I * x[0][2 * h], later = x[1][2 * h - 1] - I * x[1][2 * h];
      CHECK_LE(cabs(later - first * cexp(-2 * PI * I * (h * ORDER * k % SECTORS) / SECTORS)), 1e-10 * size,
               "sector %d, harmonic %d", k, h);
    }
    hbm_solver_free(s);
    model_free(c.model);
  }
}

/* The same solutions of the curve through the onset of slip by every way, to 1e-10 of their size; each way is the one
 * that was asked for, and SPGMR factors less often than Newton iterates. */
static void ways_of_newton_lead_to_the_same(void **state)
{
  (void)state;
  static const double omegas[] = {964, 966, 967.5};
  static double X[3][3][CASE_MAX_COEF];
  int size = 0;
  for (newton_way way = NEWTON_OWN_LU; way <= NEWTON_KRYLOV; ++way) {
    structure_case c = structure_case_named("bladed_disk", H);
    hbm_curve curve = {0};
    c.how.newton = way;
    hbm_solver *s = structure_solver(&c);
    assert_int_equal(hbm_trace(s, 963, 968, NULL, &curve), HC_OK);
    for (int k = 0; k < 3; ++k) {
      hbm_curve at = {0};
      assert_int_equal(hbm_curve_at(s, &curve, omegas[k], &at), HC_OK);
      assert_int_equal(at.n, 1);
      size = at.n_coef;
      memcpy(X[way - NEWTON_OWN_LU][k], at.X, (size_t)size * sizeof(double));
      hbm_curve_free(&at);
    }
    const hbm_newton_report report = hbm_newton_work(s);
    assert_int_equal(report.work.way, way);
    if (way == NEWTON_KRYLOV) assert_true(report.work.krylov > 0 && report.work.factored < curve.iterations);
    hbm_curve_free(&curve);
    hbm_solver_free(s);
    model_free(c.model);
  }
  for (int way = 1; way < 3; ++way)
    for (int k = 0; k < 3; ++k) {
      double off = 0, largest = 0;
      for (int i = 0; i < size; ++i) {
        off = fmax(off, fabs(X[way][k][i] - X[0][k][i]));
        largest = fmax(largest, fabs(X[0][k][i]));
      }
      CHECK_LE(off, 1e-10 * largest, "way %d at %g", way, omegas[k]);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(sectors_follow_each_other),
    cmocka_unit_test(ways_of_newton_lead_to_the_same),
};

CHECK_MAIN("hbm.sizes", tests, 120)
