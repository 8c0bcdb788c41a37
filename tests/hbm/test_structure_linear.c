/* test_structure_linear.c - the linear limits of every case of cases/structures: contacts that stay stuck, and contacts
 * that stay open, against the closed form, solved here by Gauss in long double; and a structure that nothing holds. */
#include "tests/hbm/structure_cases.h"
#include "tests/hbm/stuck_response.h"

enum { H = 3, LENGTH = 2 * H + 1 };

/* What the responses must be: series, and the largest entry of each harmonic; `all` of all of them. */
typedef struct expectation {
  double x[STUCK_MAX_DOFS][LENGTH], size[H + 1], all;
} expectation;

/* The load of harmonic 0, if there is one, stands before that of harmonic 1. */
static expectation expect(const model *m, const bool *stuck, double omega, double off)
{
  expectation e = {.all = 0};
  number x[2][STUCK_MAX_DOFS];
  const int last = m->n_loads - 1;
  for (int l = 0; l <= last; ++l) closed_form(m, stuck, omega, l, off, x[l]);
  if (last > 0) shake_down(m, stuck, x[1], x[0]);
  for (int l = 0; l <= last; ++l) {
    const int h = m->loads[l].harmonic;
    assert_true(l == last ? h == 1 : h == 0);
    for (int i = 0; i < m->n; ++i) {
      e.x[i][h] = (double)creall(x[l][i]); /* h = 0: the mean, 1: the cosine */
      if (h) e.x[i][2] = -(double)cimagl(x[l][i]);
      e.size[h] = fmax(e.size[h], (double)cabsl(x[l][i]));
    }
    e.all = fmax(e.all, e.size[h]);
  }
  return e;
}

/* Every DOF and every coefficient of the solution at omega, of the size of the largest in its harmonic, to 1e-12 or
 * to what the entries of the matrices, off by a rounding unit, make of it. */
static void check_closed_form(const char *name, const structure_case *c, const bool *stuck, double omega,
                              contact_regime regime)
{
  hbm_solver *s = structure_solver(c);
  hbm_point point;
  double X[CASE_MAX_COEF], got[LENGTH];
  const expectation e = expect(c->model, stuck, omega, 0), near = expect(c->model, stuck, omega, 0x1p-52);
  if (hbm_first_solution(s, omega, NULL, X, &point) != HC_OK) fail_msg("%s: no solution at %g", name, omega);
  for (int k = 0; k < hbm_n_coefficients(s) && !c->how.skip_linear; ++k) X[k] *= 0.9; /* so that Newton has to solve */
  if (!c->how.skip_linear) assert_int_equal(hbm_solve(s, omega, X, &point), HC_OK);
  CHECK_FILLED(hbm_measures, measures, hbm_measure(s, X, &measures));
  if (measures.contact.regime != regime)
    fail_msg("%s at %g: %s", name, omega, contact_regime_name(measures.contact.regime));
  double sensitivity = 0;
  for (int i = 0; i < c->model->n; ++i)
    for (int k = 0; k < LENGTH; ++k) sensitivity = fmax(sensitivity, fabs(near.x[i][k] - e.x[i][k]) / e.size[1]);
  for (int i = 0; i < c->model->n; ++i) {
    assert_int_equal(hbm_response(s, omega, X, i, got), HC_OK);
    for (int k = 0; k < LENGTH; ++k) {
      const double of = e.size[(k + 1) / 2] > 0 ? e.size[(k + 1) / 2] : e.all;
      CHECK_NEAR(got[k], e.x[i][k], fmax(1e-12, 10 * sensitivity) * of,
                 "%s at %g, skip_linear %d: DOF %d, coefficient %d", name, omega, c->how.skip_linear, i + 1, k);
    }
  }
  hbm_solver_free(s);
}

/* At nine frequencies of the sweep, from the closed form and by Newton. */
static void check_over_sweep(const char *name, structure_case *c, const bool *stuck, contact_regime regime)
{
  model *given = c->model;
  c->model = with_all_responses(given);
  for (int skip = 0; skip < 2; ++skip) {
    c->how.skip_linear = skip;
    for (int k = 0; k < 9; ++k) check_closed_form(name, c, stuck, c->from + (c->to - c->from) * k / 8, regime);
  }
  model_free(c->model);
  model_free(given);
}

static void stuck_contacts(CHECK_STATE)
{
  for (int k = 0; k < N_STRUCTURE_CASES; ++k) {
    structure_case c = structure_case_named(STRUCTURE_CASES[k], H);
    bool stuck[4];
    for (int j = 0; j < c.model->n_contacts; ++j) stuck[j] = c.model->contacts[j].law.gap >= 0; /* not chain3's stop */
    scale_dynamic_loads(c.model, 1e-5);
    check_over_sweep(STRUCTURE_CASES[k], &c, stuck, CONTACT_STUCK);
  }
}

static void open_contacts(CHECK_STATE)
{
  for (int k = 0; k < N_STRUCTURE_CASES; ++k) {
    structure_case c = structure_case_named(STRUCTURE_CASES[k], H);
    const bool stuck[4] = {false};
    for (int j = 0; j < c.model->n_contacts; ++j) {
      contact *law = &c.model->contacts[j].law;
      if (law->kn > 0) law->gap = -1e9;
      else law->load = 0; /* a Jenkins element without a normal load pulls at nothing */
    }
    if (strstr(STRUCTURE_CASES[k], "wedge")) /* the damper needs something that holds it */
      c.model->stiffness[4] = c.model->stiffness[8] = 50;
    check_over_sweep(STRUCTURE_CASES[k], &c, stuck, CONTACT_LINEAR);
  }
}

/* pyHarm's example "jenkins": the 2-norm of the harmonics of its first mass at omega = 24, as it prints it. */
static void pyharm_prints_the_same(CHECK_STATE)
{
  structure_case c = structure_case_named("jenkins2", 7);
  hbm_solver *s = structure_solver(&c);
  double X[CASE_MAX_COEF], x[15], squares = 0;
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, 24, NULL, X, &point));
  assert_int_equal(hbm_response(s, 24, X, 0, x), HC_OK);
  for (int k = 0; k < 15; ++k) squares += x[k] * x[k];
  CHECK_NEAR(sqrt(squares), 0.010306893196, 0.5e-12, "its last digit");
  hbm_solver_free(s);
  model_free(c.model);
}

CHECK_TESTS("hbm.structure_linear", 60, stuck_contacts, open_contacts, pyharm_prints_the_same)
