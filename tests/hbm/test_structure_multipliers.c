/* test_structure_multipliers.c - Floquet multipliers of structures with contacts against the derivative of a period map
 * that the test marches itself (period_map.h). */
#include "tests/hbm/period_map.h"
#include "tests/hbm/structure_cases.h"

enum { H = 7 };

/* Differences by 1e-5 of the state's size are good to rounding over 1e-5, 1e-10 or so, and multipliers to what the
 * monodromy's condition makes of that: 1e-7 of 1, or of the largest, of which 3e-9 is seen. flip and fold are products
 * of 1 +- multiplier: each factor is off by that. */
static void check_solution(const char *name, hbm_solver *s, const model *m, double omega, const double *X)
{
  static period_map p;
  double start[MAP_MAX_STATES] = {0}, end[MAP_MAX_STATES], most = 0, factors = 1;
  double complex lambda[MAP_MAX_STATES], flip = 1, fold = 1;
  const double tolerance = 1e-7;
  hbm_stability st;
  p.f = (full_motion){.m = m, .n_harm = H, .omega = omega};
  for (int i = 0; i < m->n; ++i) assert_int_equal(hbm_response(s, omega, X, i, p.f.x[i]), HC_OK);
  map_settle(&p, start);
  map_period(&p, start, end);
  for (int q = 0; q < p.n_states; ++q)
    CHECK_NEAR(end[q], start[q], 1e-12 * p.size[q], "%s at %g: state %d comes back", name, omega, q);
  map_multipliers(&p, start, 1e-5, lambda);
  for (int i = 0; i < p.n_states; ++i) {
    most = fmax(most, cabs(lambda[i]));
    factors *= 1 + cabs(lambda[i]);
    flip *= 1 + lambda[i];
    fold *= 1 - lambda[i];
  }
  assert_int_equal(hbm_stability_at(s, omega, X, &st), HC_OK);
  CHECK_NEAR(st.multiplier, most, tolerance * fmax(1, most), "%s at %g, largest", name, omega);
  CHECK_NEAR(st.flip, creal(flip), p.n_states * tolerance * factors, "%s at %g, flip", name, omega);
  CHECK_NEAR(st.fold, creal(fold), p.n_states * tolerance * factors, "%s at %g, fold", name, omega);
}

/* Slipping, separating, with sliders that never slip, and unstable ones. */
static void multipliers_are_those_of_the_period_map(void **state)
{
  (void)state;
  static const struct {
    const char *name;
    double omega[7];
  } at[] = {{"jenkins2", {24, 25.9068, 25.95, 26}},
            {"chain3", {0.8, 1.2585, 1.2684, 1.485, 1.5, 1.514, 1.9}},
            {"tangent_normal_F50", {3.6, 4, 4.3}},
            {"tangent_normal_F100", {3.6, 4, 5}},
            {"wedge_F0.5", {34.2, 35}},
            {"wedge_F2", {32, 35, 37}},
            {"wedge_F10", {32, 33, 34}},
            {"wedge_F20", {34, 36}}};
  int compared = 0;
  for (size_t q = 0; q < sizeof at / sizeof *at; ++q) {
    structure_case c = structure_case_named(at[q].name, H);
    model *given = c.model;
    c.model = with_all_responses(given);
    hbm_solver *s = structure_solver(&c);
    hbm_curve curve = {0};
    assert_int_equal(hbm_trace(s, c.from, c.to, NULL, &curve), HC_OK);
    for (int k = 0; k < 7 && at[q].omega[k] > 0; ++k) {
      hbm_curve here = {0};
      assert_int_equal(hbm_curve_at(s, &curve, at[q].omega[k], &here), HC_OK);
      for (int i = 0; i < here.n; ++i, ++compared)
        check_solution(at[q].name, s, c.model, at[q].omega[k], hbm_curve_X(&here, i));
      hbm_curve_free(&here);
    }
    hbm_curve_free(&curve);
    hbm_solver_free(s);
    model_free(c.model);
    model_free(given);
  }
  assert_true(compared >= 35);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(multipliers_are_those_of_the_period_map),
};

CHECK_MAIN("hbm.structure_multipliers", tests, 120)
