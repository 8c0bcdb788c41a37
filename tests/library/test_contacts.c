/* test_contacts.c - --contacts by the C API: the numbers of those it calls, of each solution, steady state and row. */
#include "tests/library/both.h"

enum { MOST = 4 };

static bool same(const hbmcheck_contact_period *p, const contact_period *q)
{
  return (int)p->regime == (int)q->regime && p->normal_min == q->normal_min && p->normal_max == q->normal_max &&
         p->traction_max == q->traction_max && p->slip_distance == q->slip_distance && p->work == q->work;
}

/* One contact with two tangents, whose halves the model counts apart, and three with one. */
static void every_solution_has_its_contacts(CHECK_STATE)
{
  const char *const path[] = {FOLDER "space.yaml", FOLDER "chain3.yaml"};
  const double omega[] = {12.5, 1.9};
  const int contacts[] = {1, 3};
  for (int i = 0; i < 2; ++i) {
    both b;
    read_both(path[i], omega[i], &b);
    hbm_curve traced = {0}, there = {0};
    contact_period expected[2 * MOST];
    hbmcheck_contact_period found[MOST];
    int n = -1;
    CHECK_MADE(hbmcheck_curve, curve, hbmcheck_curve_trace(b.c, NULL, &curve));
    CHECK_MADE(hbmcheck_solutions, at, hbmcheck_curve_at(curve, omega[i], &at));
    CHECK_MADE(hbm_solver, s, guided_hbm_solver_new(b.setup.model, &b.setup.hbm, &s));
    assert_int_equal(hbm_trace_all(s, b.setup.omega_from, b.setup.omega_to, NULL, &traced), HC_OK);
    assert_int_equal(hbm_curve_at(s, &traced, omega[i], &there), HC_OK);
    assert_in_range(there.n, 1, 8);
    for (int k = 0; k < there.n; ++k) {
      assert_int_equal(hbm_measure_contacts(s, there.points[k].omega, hbm_curve_X(&there, k), expected), HC_OK);
      assert_int_equal(hbmcheck_curve_contacts(curve, at, k, MOST, found, &n), HBMCHECK_OK);
      assert_int_equal(n, contacts[i]);
      for (int j = 0; j < n; ++j) assert_true(same(&found[j], &expected[j]));
    }
    const int last = traced.n - 1;
    assert_int_equal(hbm_measure_contacts(s, traced.points[last].omega, hbm_curve_X(&traced, last), expected), HC_OK);
    assert_int_equal(hbmcheck_curve_contacts(curve, hbmcheck_curve_points(curve), last, MOST, found, &n), HBMCHECK_OK);
    assert_true(same(&found[0], &expected[0]) && found[0].normal_max > 0);
    hbm_curve_free(&there);
    hbm_curve_free(&traced);
    hbm_solver_free(s);
    hbmcheck_solutions_free(at);
    hbmcheck_curve_free(curve);
    free_both(&b);
  }
}

/* Several states at one frequency, equal starts at two: each finds its own; every response has its state's. */
static void every_steady_state_has_its_contacts(CHECK_STATE)
{
  const double omega[] = {1.2, 1.3, 1.485};
  both b;
  read_both(FOLDER "chain3.yaml", omega[0], &b);
  b.setup.compare.omega = (number_list){3, {omega[0], omega[1], omega[2]}};
  hbmcheck_contact_period found[MOST];
  int n = -1, seen = 0;
  hbmcheck_case_watch_contacts(b.c, 1);
  CHECK_MADE(hbmcheck_transient, t, hbmcheck_transient_run(b.c, 3, omega, NULL, &t));
  b.setup.contacts = true;
  CHECK_FILLED(steady_states, expected, steady_states_run(&b.setup, NULL, &expected));
  assert_int_equal(expected.n, hbmcheck_transient_count(t));
  assert_true(expected.n > 12 && expected.rows[6].result.omega == expected.rows[9].result.omega);
  assert_string_equal(expected.rows[0].start, expected.rows[3].start);
  for (int k = 0; k < expected.n; ++k) {
    assert_int_equal(hbmcheck_transient_contacts(t, k, MOST, found, &n), HBMCHECK_OK);
    assert_int_equal(n, 3);
    const int first = 3 * (k / 3); /* of a state: three responses, three contacts */
    for (int j = 0; j < n; ++j, ++seen) {
      assert_true(expected.contacts[first + j].omega == expected.rows[k].result.omega);
      assert_true(same(&found[j], &expected.contacts[first + j].period));
    }
  }
  assert_int_equal(seen, 3 * expected.n_contacts);
  steady_states_clear(&expected);
  hbmcheck_transient_free(t);
  free_both(&b);
}

/* Three solutions at one frequency, three responses and three contacts each. */
static void every_row_has_its_contacts(CHECK_STATE)
{
  both b;
  read_both(FOLDER "chain3.yaml", 1.485, &b);
  hbmcheck_contact_row row[MOST];
  int n = -1, made = 0;
  hbmcheck_case_watch_contacts(b.c, 1);
  CHECK_MADE(hbmcheck_comparison, found, hbmcheck_comparison_run(b.c, 1, (double[]){1.485}, NULL, &found));
  b.setup.contacts = true;
  CHECK_FILLED(comparison, expected, comparison_run(&b.setup, NULL, &expected));
  assert_true(expected.n_contacts == 9 && hbmcheck_comparison_count(found) == 9);
  for (int k = 0; k < 9; ++k) {
    assert_int_equal(hbmcheck_comparison_contacts(found, k, MOST, row, &n), HBMCHECK_OK);
    assert_int_equal(n, 3);
    for (int j = 0; j < n; ++j) {
      const contact_comparison *c = &expected.contacts[3 * (k / 3) + j];
      assert_true(c->hbm_status == HC_OK && c->transient_status == HC_OK);
      assert_true(row[j].hbm_status == HBMCHECK_OK && row[j].transient_status == HBMCHECK_OK);
      assert_true(same(&row[j].hbm, &c->hbm) && same(&row[j].transient, &c->transient));
      assert_true(row[j].work_error == c->work_error && row[j].differs == c->differs);
      assert_true((row[j].normal_error == c->normal_error) || (isnan(row[j].normal_error) && isnan(c->normal_error)));
      assert_int_equal(row[j].compared, contact_comparison_made(c));
      made += row[j].compared;
    }
  }
  assert_true(made > 0);
  comparison_clear(&expected);
  hbmcheck_comparison_free(found);
  free_both(&b);
}

/* For the pair that stands for two tangents, harmonic balance and time integration each put the halves together: half
 * of the contact on one side would be off by a half. The two are 8e-5 apart by truncation and a regularised law. */
static void two_tangents_are_one_contact(CHECK_STATE)
{
  both b;
  read_both(FOLDER "space.yaml", 12.5, &b);
  hbmcheck_contact_row row[MOST];
  int n = -1;
  hbmcheck_case_watch_contacts(b.c, 1);
  CHECK_MADE(hbmcheck_comparison, found, hbmcheck_comparison_run(b.c, 1, (double[]){12.5}, NULL, &found));
  assert_int_equal(hbmcheck_comparison_contacts(found, 0, MOST, row, &n), HBMCHECK_OK);
  assert_int_equal(n, 1);
  CHECK_LE(fabs(row[0].hbm.normal_max / row[0].transient.normal_max - 1), 1e-3, "%g", row[0].hbm.normal_max);
  CHECK_LE(fabs(row[0].hbm.traction_max / row[0].transient.traction_max - 1), 1e-3, "%g", row[0].hbm.traction_max);
  CHECK_LE(fabs(row[0].hbm.work / row[0].transient.work - 1), 1e-3, "%g", row[0].hbm.work);
  hbmcheck_comparison_free(found);
  free_both(&b);
}

/* And switched off again. */
static void none_unless_asked_for(CHECK_STATE)
{
  both b;
  read_both(FOLDER "chain3.yaml", 1.9, &b);
  hbmcheck_comparison *c;
  int n = -1;
  hbmcheck_case_watch_contacts(b.c, 1);
  hbmcheck_case_watch_contacts(b.c, 0);
  hbmcheck_case_watch_contacts(NULL, 1);
  CHECK_MADE(hbmcheck_transient, t, hbmcheck_transient_run(b.c, 1, (double[]){1.9}, NULL, &t));
  assert_int_equal(hbmcheck_comparison_run(b.c, 1, (double[]){1.9}, NULL, &c), HBMCHECK_OK);
  assert_int_equal(hbmcheck_transient_contacts(t, 0, 0, NULL, &n), HBMCHECK_OK);
  assert_int_equal(n, 0);
  n = -1;
  assert_int_equal(hbmcheck_comparison_contacts(c, 0, 0, NULL, &n), HBMCHECK_OK);
  assert_int_equal(n, 0);
  hbmcheck_transient_free(t);
  hbmcheck_comparison_free(c);
  free_both(&b);
}

static void what_is_no_place_is_refused(CHECK_STATE)
{
  both b;
  read_both(FOLDER "stop2.yaml", 1, &b);
  hbmcheck_contact_period one = {.work = -1};
  hbmcheck_contact_row row = {.work_error = -1};
  int n = -1;
  CHECK_MADE(hbmcheck_curve, curve, hbmcheck_curve_trace(b.c, NULL, &curve));
  CHECK_MADE(hbmcheck_curve, other, hbmcheck_curve_trace(b.c, NULL, &other));
  const hbmcheck_solutions *s = hbmcheck_curve_points(curve);
  assert_int_equal(hbmcheck_curve_contacts(NULL, s, 0, 1, &one, &n), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_curve_contacts(curve, NULL, 0, 1, &one, &n), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_curve_contacts(other, s, 0, 1, &one, &n), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_curve_contacts(curve, s, -1, 1, &one, &n), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_curve_contacts(curve, s, hbmcheck_solutions_count(s), 1, &one, &n), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_curve_contacts(curve, s, 0, -1, &one, &n), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_curve_contacts(curve, s, 0, 1, NULL, &n), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_curve_contacts(curve, s, 0, 1, &one, NULL), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_transient_contacts(NULL, 0, 1, &one, &n), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_comparison_contacts(NULL, 0, 1, &row, &n), HBMCHECK_BAD_INPUT);
  assert_true(n == -1 && one.work == -1 && row.work_error == -1);
  assert_int_equal(hbmcheck_curve_contacts(curve, s, 0, 0, NULL, &n), HBMCHECK_OK);
  assert_int_equal(n, hbmcheck_case_contacts(b.c));
  hbmcheck_curve_free(curve);
  hbmcheck_curve_free(other);
  free_both(&b);
}

CHECK_TESTS("library.contacts", 60, every_solution_has_its_contacts, every_steady_state_has_its_contacts,
            every_row_has_its_contacts, two_tangents_are_one_contact, none_unless_asked_for,
            what_is_no_place_is_refused)
