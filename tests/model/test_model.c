/* test_model.c - a model owns its memory and takes any number of contacts: many that add up to one are one. */
#include "tests/check.h"

#include <float.h>

#include "hbm/forces/contact_forces.h"
#include "hbm/hbm.h"

enum { H = 5, N_COEF = 2 * H + 1, MANY = 40 };

/* Case 2 of the paper, its contact cut into n of stiffness k/n: the same force at every motion. */
static model *case_2_in_parts(int n)
{
  CHECK_MADE(model, m, model_oscillator(1, 0.4, 40, 100, n, &m));
  for (int j = 0; j < n; ++j) {
    m->contacts[j].law = (contact){.kt = 100.0 / n, .kn = 1000.0 / n, .mu = 0.3, .gap = -5};
    model_direction(45, m->contacts[j].tangent, m->contacts[j].normal);
  }
  return m;
}

static void a_copy_is_its_own(CHECK_STATE)
{
  model *m = case_2_in_parts(3), *copy;
  assert_int_equal(model_copy(m, &copy), HC_OK);
  assert_true(copy->contacts != m->contacts && copy->n_contacts == 3 && *copy->mass == 1 && model_force(copy) == 100);
  for (int j = 0; j < 3; ++j) {
    const model_contact *a = &m->contacts[j], *b = &copy->contacts[j];
    assert_true(b->tangent != a->tangent && *b->tangent == *a->tangent && *b->normal == *a->normal);
    assert_memory_equal(&b->law, &a->law, sizeof a->law);
  }
  m->contacts[1].law.gap = 7;
  model_free(m);
  assert_true(copy->contacts[1].law.gap == -5);
  model_free(copy);
  assert_int_equal(model_new(2, 0, 0, 0, &m), HC_OK);
  assert_int_equal(model_copy(m, &copy), HC_OK);
  assert_true(copy->n_contacts == 0 && copy->n == 2 && copy->stiffness[3] == 0);
  model_free(copy);
  model_free(m);
  model_free(NULL);
  const int wrong[][4] = {{0, 1, 1, 1}, {1, -1, 1, 1}, {1, 1, -1, 1}, {1, 1, 1, -1}};
  for (int i = 0; i < 4; ++i) {
    assert_int_equal(model_new(wrong[i][0], wrong[i][1], wrong[i][2], wrong[i][3], &m), HC_BAD_INPUT);
    assert_null(m);
  }
}

/* kt c^2 + kn s^2, all contacts and K: (100 + 1000)/2 + 40, each of MANY terms rounded a few times. */
static void stiffness_of_many_is_that_of_one(CHECK_STATE)
{
  model *m = case_2_in_parts(MANY);
  CHECK_NEAR(model_max_stiffness(m), 590, 8 * MANY * DBL_EPSILON * 590, "all stuck");
  model_free(m);
}

/* Sums of MANY equal forces: MANY rounding units of each, and those of one evaluation (about H per coefficient). */
static void forces_of_many_are_those_of_one(CHECK_STATE)
{
  const double X[N_COEF] = {-0.5, 9, 1, 0.3, -0.2, 0.1, 0, 0.05, 0, 0, 0.02};
  double F[2][N_COEF], G[2][N_COEF], w[MANY], largest = 0;
  for (int i = 0; i < 2; ++i) {
    model *m = case_2_in_parts(i == 0 ? 1 : MANY);
    const evaluator_settings how = {.n_harm = H, .n_time = 256, .slider = {.restart = HBM_RESTART_INTERPOLATED}};
    CHECK_MADE(contact_forces, e, contact_forces_new(m, NULL, HBM_FORCE_EXACT, &how, &e));
    CHECK_FILLED(contact_report, report, contact_forces_eval(e, X, F[i], false, &report));
    contact_forces_sliders(e, w);
    for (int j = 1; j < m->n_contacts; ++j) assert_true(w[j] == w[0]);
    assert_int_equal(report.transitions, 2 * m->n_contacts);
    CHECK_MADE(contact_forces, a, contact_forces_new(m, NULL, HBM_FORCE_SAMPLED, &how, &a));
    assert_int_equal(contact_forces_eval(a, X, G[i], false, &report), HC_OK);
    contact_forces_free(e);
    contact_forces_free(a);
    model_free(m);
  }
  for (int p = 0; p < N_COEF; ++p) largest = fmax(largest, fabs(F[0][p]));
  const double rounding = (MANY + 100 * H) * DBL_EPSILON * largest;
  for (int p = 0; p < N_COEF; ++p) {
    CHECK_NEAR(F[1][p], F[0][p], rounding, "exact, row %d", p);
    CHECK_NEAR(G[1][p], G[0][p], rounding, "sampled, row %d", p);
  }
}

/* The equations differ by rounding of the forces, 1e-13 of them; a solution to 1e-10 of them is met to 1e-9 here, its
 * multiplier to 1e-8: the stiffness is what it is made of, a thousandth of which moves it by about as much. */
static void solutions_with_many_are_those_with_one(CHECK_STATE)
{
  const hbm_settings how = {.harmonics = H, .keep_mean = true, .tolerance = 1e-12, .accuracy = 1e-4};
  double X[2][N_COEF], multiplier[2];
  for (int i = 0; i < 2; ++i) {
    model *m = case_2_in_parts(i == 0 ? 1 : MANY);
    memset(X[i], 0, sizeof X[i]);
    CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
    model_free(m); /* the solver has its own */
    CHECK_FILLED(hbm_point, point, hbm_first_solution(s, 6.0, NULL, X[i], &point));
    CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, 6.0, X[i], &st));
    multiplier[i] = st.multiplier;
    hbm_solver_free(s);
  }
  for (int p = 0; p < N_COEF; ++p) CHECK_NEAR(X[1][p], X[0][p], 1e-9 * fabs(X[0][1]), "coefficient %d", p);
  CHECK_NEAR(multiplier[1], multiplier[0], 1e-8, "multiplier");
}

CHECK_TESTS("model.model", 60, a_copy_is_its_own, stiffness_of_many_is_that_of_one, forces_of_many_are_those_of_one,
            solutions_with_many_are_those_with_one)
