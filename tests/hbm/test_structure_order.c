/* test_structure_order.c - solutions of structures with sampled contact forces tend to those with exact ones, with
 * order 2 in the samples (docs/aliasing.md: transitions at angles that no sample meets err by the square of the
 * spacing). */
#include "tests/hbm/structure_cases.h"

enum { H = 5, FEWEST = 6, MOST = 14, SIZES = MOST - FEWEST + 1, FREQUENCIES = 16 };

/* log2 of |X_N - X|/|X| at N = 2^6 .. 2^14, largest coefficient. */
static void errors(const structure_case *c, double omega, const double *X, double *error)
{
  for (int k = 0; k < SIZES; ++k) {
    structure_case sampled = *c;
    double Y[CASE_MAX_COEF], off = 0, size = 0;
    sampled.how.force = HBM_FORCE_SAMPLED;
    sampled.how.samples = 1 << (FEWEST + k);
    hbm_solver *s = structure_solver(&sampled);
    const int n = hbm_n_coefficients(s);
    memcpy(Y, X, (size_t)n * sizeof *Y);
    CHECK_FILLED(hbm_point, point, hbm_solve(s, omega, Y, &point));
    hbm_solver_free(s);
    for (int i = 0; i < n; ++i) off = larger(off, fabs(Y[i] - X[i])), size = larger(size, fabs(X[i]));
    error[k] = log2(off / size);
  }
}

/* With friction 0.6 the wedge touches down and sticks, so that where its slider then starts counts: on a sample, it
 * is order 1 (docs/aliasing.md). Of each case where its contacts slip or separate, mostly; sampled at none of the
 * frequencies does it fail to converge. */
static void sampled_tends_to_exact(CHECK_STATE)
{
  static const struct {
    const char *name;
    double from, to;
    contact_regime regime;
    double friction; /* 0: the case's */
    hbm_restart restart;
    int order;
  } at[] = {{"jenkins2", 25.85, 26.05, CONTACT_SLIPS, 0, HBM_RESTART_INTERPOLATED, 2},
            {"chain3", 1.23, 1.45, CONTACT_SEPARATES, 0, HBM_RESTART_INTERPOLATED, 2},
            {"tangent_normal_F50", 3.3, 4.2, CONTACT_SLIPS, 0, HBM_RESTART_INTERPOLATED, 2},
            {"tangent_normal_F100", 3.3, 4.2, CONTACT_SLIPS, 0, HBM_RESTART_INTERPOLATED, 2},
            {"beam16", 180, 212, CONTACT_SLIPS, 0, HBM_RESTART_INTERPOLATED, 2},
            {"wedge_F2", 34, 37, CONTACT_SLIPS, 0, HBM_RESTART_INTERPOLATED, 2},
            {"wedge_F10", 33, 35, CONTACT_SLIPS, 0, HBM_RESTART_INTERPOLATED, 2},
            {"wedge_F20", 33, 34.2, CONTACT_SEPARATES, 0, HBM_RESTART_INTERPOLATED, 2},
            {"wedge_F20", 33, 34.2, CONTACT_SEPARATES, 0.6, HBM_RESTART_INTERPOLATED, 2},
            {"wedge_F20", 33, 34.2, CONTACT_SEPARATES, 0.6, HBM_RESTART_SAMPLE, 1}};
  for (size_t q = 0; q < sizeof at / sizeof *at; ++q) {
    structure_case c = structure_case_named(at[q].name, H);
    for (int j = 0; j < c.model->n_contacts && at[q].friction > 0; ++j) c.model->contacts[j].law.mu = at[q].friction;
    c.how.restart = at[q].restart;
    hbm_solver *s = structure_solver(&c);
    double error[FREQUENCIES][SIZES];
    int as_expected = 0;
    for (int f = 0; f < FREQUENCIES; ++f) {
      const double omega = at[q].from + (at[q].to - at[q].from) * (f + 0.37) / FREQUENCIES;
      double X[CASE_MAX_COEF];
      CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
      CHECK_FILLED(hbm_measures, m, hbm_measure(s, X, &m));
      as_expected += m.contact.regime == at[q].regime;
      errors(&c, omega, X, error[f]);
    }
    assert_true(as_expected > FREQUENCIES / 2);
    /* Where on its spacing a transition falls decides the factor of the square, which scatters by 2^1 or so from one N
     * to the next. A straight line through log2 of the errors over log2 N, one slope for all frequencies and a height
     * for each: the scatter about it, over the square root of the sum of squared distances from the middle, is the
     * slope's own. Four times that is allowed, and must be little enough to tell order 2 from 1 and 3. */
    double slope = 0, weight = 0, scatter = 0;
    for (int f = 0; f < FREQUENCIES; ++f)
      for (int k = 0; k < SIZES; ++k) {
        const double x = k - 0.5 * (SIZES - 1);
        slope += x * error[f][k];
        weight += x * x;
      }
    slope /= weight;
    for (int f = 0; f < FREQUENCIES; ++f) {
      double mean = 0;
      for (int k = 0; k < SIZES; ++k) mean += error[f][k] / SIZES;
      for (int k = 0; k < SIZES; ++k) scatter += pow(error[f][k] - mean - slope * (k - 0.5 * (SIZES - 1)), 2);
    }
    const double own = sqrt(scatter / (FREQUENCIES * (SIZES - 1) - 1) / weight);
    CHECK_LE(4 * own, 0.35, "%s: the slope is known well enough", at[q].name);
    CHECK_NEAR(slope, -at[q].order, 4 * own, "%s: order %d, scatter of the slope %g", at[q].name, at[q].order, own);
    hbm_solver_free(s);
    model_free(c.model);
  }
}

CHECK_TESTS("hbm.structure_order", 120, sampled_tends_to_exact)
