/* test_sizes.c - a structure of some size, the bladed disk of cases/structures: its symmetry, and that it does not
 * matter how Newton's linear equations are solved. */
#include <complex.h>

#include "tests/hbm/structure_cases.h"

enum { H = 5, LENGTH = 2 * H + 1, SECTORS = 24, ORDER = 3 };

static void check_found(const structure_case *c, double omega, double *X, hbm_solver **s)
{
  *s = structure_solver(c);
  CHECK_FILLED(hbm_point, point, hbm_first_solution(*s, omega, NULL, X, &point));
  CHECK_FILLED(hbm_measures, measures, hbm_measure(*s, X, &measures));
  assert_int_equal(measures.contact.regime, CONTACT_SLIPS);
  assert_int_equal(measures.contact.free_sliders, 0);
}

/* Sector k does what sector 0 does, 3 k/24 of a period later: harmonic h is turned by exp(-2 pi i h 3 k/24). All
 * contacts slip, so that there is one motion. The residual is 1e-13 of the forces; at a resonance of 0.3 % damping
 * motions are off by up to 1/0.006 times as much, and higher harmonics are measured by the largest: 1e-10. */
static void sectors_follow_each_other(CHECK_STATE)
{
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

CHECK_TESTS("hbm.sizes", 120, sectors_follow_each_other)
