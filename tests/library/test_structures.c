/* test_structures.c - structures through the C API: a result for each response, the numbers of those it calls. */
#include "tests/library/both.h"

#define CHAIN FOLDER "chain3.yaml"
enum { RESPONSES = 3, MOST = 2 * HBM_MAX_HARMONICS + 1 };
static const double at[] = {1.9};

static void responses_have_names(CHECK_STATE)
{
  both b;
  char name[32];
  read_both(CHAIN, at[0], &b);
  assert_int_equal(hbmcheck_case_responses(b.c), RESPONSES);
  assert_int_equal(hbmcheck_case_response_name(b.c, 2, name, sizeof name), HBMCHECK_OK);
  assert_string_equal(name, "3");
  assert_int_equal(hbmcheck_case_response_name(b.c, 3, name, sizeof name), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_case_response_name(b.c, -1, name, sizeof name), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_case_response_name(NULL, 0, name, sizeof name), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_case_responses(NULL), 0);
  free_both(&b);
}

static void solutions_are_of_every_response(CHECK_STATE)
{
  both b;
  hbmcheck_solution one;
  hbm_curve traced = {0}, there = {0};
  double X[MOST], expected[MOST];
  int n = 0;
  read_both(CHAIN, at[0], &b);
  CHECK_MADE(hbmcheck_curve, curve, hbmcheck_curve_trace(b.c, NULL, &curve));
  CHECK_MADE(hbmcheck_solutions, found, hbmcheck_curve_at(curve, at[0], &found));
  CHECK_MADE(hbm_solver, s, guided_hbm_solver_new(b.setup.model, &b.setup.hbm, &s));
  assert_int_equal(hbm_trace_all(s, b.setup.omega_from, b.setup.omega_to, NULL, &traced), HC_OK);
  assert_int_equal(hbm_curve_at(s, &traced, at[0], &there), HC_OK);
  assert_int_equal(hbmcheck_solutions_count(found), 1);
  for (int r = 0; r < RESPONSES; ++r) {
    CHECK_FILLED(response_row, row, response_row_of(s, &there, 0, &row));
    assert_int_equal(response_row_turn(s, &there, 0, r, &row), HC_OK);
    assert_int_equal(hbm_response(s, at[0], hbm_curve_X(&there, 0), r, expected), HC_OK);
    assert_int_equal(hbmcheck_solutions_get_response(found, 0, r, &one), HBMCHECK_OK);
    assert_true(one.amplitude == row.measures.amplitude && one.omega == at[0]);
    assert_int_equal(hbmcheck_solutions_response_coefficients(found, 0, r, MOST, X, &n), HBMCHECK_OK);
    assert_int_equal(n, 2 * b.setup.hbm.harmonics + 1);
    assert_memory_equal(X, expected, (size_t)n * sizeof *X);
    if (r > 0) continue;
    assert_int_equal(hbmcheck_solutions_coefficients(found, 0, MOST, X, &n), HBMCHECK_OK);
    assert_memory_equal(X, expected, (size_t)n * sizeof *X);
  }
  assert_int_equal(hbmcheck_solutions_get_response(found, 0, RESPONSES, &one), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_solutions_response_coefficients(found, 0, -1, MOST, X, &n), HBMCHECK_BAD_INPUT);
  hbm_curve_free(&there);
  hbm_curve_free(&traced);
  hbm_solver_free(s);
  hbmcheck_solutions_free(found);
  hbmcheck_curve_free(curve);
  free_both(&b);
}

static void steady_states_are_of_every_response(CHECK_STATE)
{
  both b;
  read_both(CHAIN, at[0], &b);
  CHECK_MADE(hbmcheck_transient, t, hbmcheck_transient_run(b.c, 1, at, NULL, &t));
  CHECK_FILLED(steady_states, expected, steady_states_run(&b.setup, NULL, &expected));
  assert_true(expected.n == RESPONSES && hbmcheck_transient_count(t) == RESPONSES);
  for (int r = 0; r < RESPONSES; ++r) {
    double x[TIMEINT_WAVE];
    int n;
    CHECK_FILLED(hbmcheck_steady, one, hbmcheck_transient_get(t, r, &one));
    assert_true(one.response == r && one.amplitude == expected.rows[r].result.amplitude);
    assert_int_equal(hbmcheck_transient_wave(t, r, TIMEINT_WAVE, x, &n), HBMCHECK_OK);
    assert_memory_equal(x, expected.rows[r].result.wave, sizeof x);
  }
  steady_states_clear(&expected);
  hbmcheck_transient_free(t);
  free_both(&b);
}

static void comparisons_are_of_every_response(CHECK_STATE)
{
  both b;
  read_both(CHAIN, at[0], &b);
  CHECK_MADE(hbmcheck_comparison, found, hbmcheck_comparison_run(b.c, 1, at, NULL, &found));
  CHECK_FILLED(comparison, expected, comparison_run(&b.setup, NULL, &expected));
  assert_true(expected.n_rows == RESPONSES && hbmcheck_comparison_count(found) == RESPONSES);
  for (int r = 0; r < RESPONSES; ++r) {
    const comparison_row *row = &expected.rows[r];
    CHECK_FILLED(hbmcheck_row, one, hbmcheck_comparison_get(found, r, &one));
    assert_true(one.response == r && (int)one.verdict == (int)row->verdict && !one.still && !one.family);
    assert_true(one.amplitude_error == row->errors.amplitude && one.hbm_predicted == row->hbm_predicted.amplitude);
    assert_true(one.from_truncation == row->budget.amplitude.truncation && one.from_truncation > 0);
  }
  assert_int_equal(hbmcheck_comparison_exit_code(found), comparison_exit_code(&expected));
  comparison_clear(&expected);
  hbmcheck_comparison_free(found);
  free_both(&b);
}

CHECK_TESTS("library.structures", 60, responses_have_names, solutions_are_of_every_response,
            steady_states_are_of_every_response, comparisons_are_of_every_response)
