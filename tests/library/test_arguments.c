/* test_arguments.c - HBMCHECK_BAD_INPUT: nothing is written but NULL into the place of a handle. */
#include "tests/library/case2.h"

#define BAD(call) assert_int_equal((call), HBMCHECK_BAD_INPUT)

/* The place of a handle is NULL afterwards; it is made to be something else before. */
#define BAD_AND_NULL(place, call)                                                                                      \
  do {                                                                                                                 \
    *(void **)&(place) = &(place);                                                                                     \
    BAD(call);                                                                                                         \
    assert_null(place);                                                                                                \
  } while (0)

static void cases(CHECK_STATE)
{
  const char *const set[] = {"hbm.harmonics=3", NULL};
  const size_t length = strlen(case2_text);
  char message[64] = "";
  hbmcheck_case *c;
  BAD(hbmcheck_case_read("x.yaml", 0, NULL, message, sizeof message, NULL));
  assert_string_not_equal(message, "");
  BAD_AND_NULL(c, hbmcheck_case_read(NULL, 0, NULL, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_read("x.yaml", -1, set, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_read("x.yaml", 1, NULL, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_read("x.yaml", 2, set, NULL, 0, &c));
  BAD(hbmcheck_case_parse("x", case2_text, length, 0, NULL, NULL, 0, NULL));
  BAD_AND_NULL(c, hbmcheck_case_parse(NULL, case2_text, length, 0, NULL, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", NULL, length, 0, NULL, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", NULL, 0, 0, NULL, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", case2_text, length, -1, set, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", case2_text, length, 1, NULL, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", case2_text, length, 2, set, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", case2_text, length, 1, (const char *[]){"hbm.harmonics=0x"}, NULL, 0, &c));
}

static void curves(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("sweep.omega=3,6", "hbm.harmonics=3");
  hbmcheck_curve *curve;
  hbmcheck_solutions *at;
  hbmcheck_solution s;
  hbmcheck_special special;
  hbmcheck_summary whole;
  double X[8];
  int n = -1;
  BAD(hbmcheck_curve_trace(c, NULL, NULL));
  BAD_AND_NULL(curve, hbmcheck_curve_trace(NULL, NULL, &curve));
  assert_int_equal(hbmcheck_curve_trace(c, NULL, &curve), HBMCHECK_OK);
  BAD(hbmcheck_curve_at(curve, 4, NULL));
  BAD_AND_NULL(at, hbmcheck_curve_at(NULL, 4, &at));
  BAD_AND_NULL(at, hbmcheck_curve_at(curve, 0, &at));
  BAD_AND_NULL(at, hbmcheck_curve_at(curve, -4, &at));
  BAD_AND_NULL(at, hbmcheck_curve_at(curve, NAN, &at));
  BAD_AND_NULL(at, hbmcheck_curve_at(curve, INFINITY, &at));
  BAD(hbmcheck_curve_specials(NULL, 1, &special, &n));
  BAD(hbmcheck_curve_specials(curve, -1, &special, &n));
  BAD(hbmcheck_curve_specials(curve, 1, NULL, &n));
  BAD(hbmcheck_curve_specials(curve, 1, &special, NULL));
  BAD(hbmcheck_curve_summary(NULL, &whole));
  BAD(hbmcheck_curve_summary(curve, NULL));
  const hbmcheck_solutions *points = hbmcheck_curve_points(curve);
  const int count = hbmcheck_solutions_count(points);
  BAD(hbmcheck_solutions_get(NULL, 0, &s));
  BAD(hbmcheck_solutions_get(points, -1, &s));
  BAD(hbmcheck_solutions_get(points, count, &s));
  BAD(hbmcheck_solutions_get(points, 0, NULL));
  BAD(hbmcheck_solutions_coefficients(NULL, 0, 8, X, &n));
  BAD(hbmcheck_solutions_coefficients(points, -1, 8, X, &n));
  BAD(hbmcheck_solutions_coefficients(points, count, 8, X, &n));
  BAD(hbmcheck_solutions_coefficients(points, 0, -1, X, &n));
  BAD(hbmcheck_solutions_coefficients(points, 0, 8, NULL, &n));
  BAD(hbmcheck_solutions_coefficients(points, 0, 8, X, NULL));
  assert_int_equal(n, -1);
  X[3] = 77; /* room for three of seven */
  assert_int_equal(hbmcheck_solutions_coefficients(points, 0, 3, X, &n), HBMCHECK_OK);
  assert_int_equal(n, 7);
  assert_true(X[3] == 77);
  X[7] = 78; /* room for eight */
  assert_int_equal(hbmcheck_solutions_coefficients(points, 0, 8, X, &n), HBMCHECK_OK);
  assert_true(X[3] != 77 && X[7] == 78);
  assert_int_equal(hbmcheck_solutions_coefficients(points, 0, 0, NULL, &n), HBMCHECK_OK);
  hbmcheck_curve_free(curve);
  hbmcheck_case_free(c);
}

/* No frequencies are asked for without compare.omega in the case: the transient has none to choose from. */
static void runs(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("hbm.harmonics=3");
  hbmcheck_transient *t;
  hbmcheck_comparison *both;
  hbmcheck_steady s;
  hbmcheck_row row;
  hbmcheck_gate gate;
  double many[HBMCHECK_MAX_OMEGAS + 1], x[4];
  int n = -1;
  for (int i = 0; i <= HBMCHECK_MAX_OMEGAS; ++i) many[i] = 4;
  BAD_AND_NULL(t, hbmcheck_transient_run(c, 0, NULL, NULL, &t));
  const struct {
    const hbmcheck_case *c;
    int n;
    const double *omega;
  } bad[] = {{NULL, 1, many},
             {c, -1, many},
             {c, HBMCHECK_MAX_OMEGAS + 1, many},
             {c, 1, NULL},
             {c, 1, (double[]){0}},
             {c, 2, (double[]){4, -4}},
             {c, 1, (double[]){NAN}},
             {c, 1, (double[]){INFINITY}}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
    BAD_AND_NULL(t, hbmcheck_transient_run(bad[i].c, bad[i].n, bad[i].omega, NULL, &t));
    BAD_AND_NULL(both, hbmcheck_comparison_run(bad[i].c, bad[i].n, bad[i].omega, NULL, &both));
  }
  BAD(hbmcheck_transient_run(c, 1, many, NULL, NULL));
  BAD(hbmcheck_comparison_run(c, 1, many, NULL, NULL));
  assert_int_equal(hbmcheck_transient_run(c, HBMCHECK_MAX_OMEGAS, many, NULL, &t), HBMCHECK_OK); /* all the same one */
  assert_int_equal(hbmcheck_comparison_run(c, 1, many, NULL, &both), HBMCHECK_OK);
  assert_int_equal(hbmcheck_transient_count(t), 1);
  assert_int_equal(hbmcheck_comparison_count(both), 1);
  BAD(hbmcheck_transient_get(NULL, 0, &s));
  BAD(hbmcheck_transient_get(t, -1, &s));
  BAD(hbmcheck_transient_get(t, 1, &s));
  BAD(hbmcheck_transient_get(t, 0, NULL));
  BAD(hbmcheck_transient_wave(NULL, 0, 4, x, &n));
  BAD(hbmcheck_transient_wave(t, 1, 4, x, &n));
  BAD(hbmcheck_transient_wave(t, 0, -1, x, &n));
  BAD(hbmcheck_transient_wave(t, 0, 4, NULL, &n));
  BAD(hbmcheck_transient_wave(t, 0, 4, x, NULL));
  BAD(hbmcheck_comparison_get(NULL, 0, &row));
  BAD(hbmcheck_comparison_get(both, -1, &row));
  BAD(hbmcheck_comparison_get(both, 1, &row));
  BAD(hbmcheck_comparison_get(both, 0, NULL));
  BAD(hbmcheck_comparison_gate(NULL, &gate));
  BAD(hbmcheck_comparison_gate(both, NULL));
  hbmcheck_transient_free(t);
  hbmcheck_comparison_free(both);
  hbmcheck_case_free(c);
}

/* What counts, names or frees takes NULL and values that are none. */
static void harmless(CHECK_STATE)
{
  hbmcheck_case_free(NULL);
  hbmcheck_solutions_free(NULL);
  hbmcheck_curve_free(NULL);
  hbmcheck_transient_free(NULL);
  hbmcheck_comparison_free(NULL);
  assert_null(hbmcheck_curve_points(NULL));
  assert_int_equal(hbmcheck_solutions_count(NULL), 0);
  assert_int_equal(hbmcheck_transient_count(NULL), 0);
  assert_int_equal(hbmcheck_comparison_count(NULL), 0);
  assert_int_equal(hbmcheck_comparison_exit_code(NULL), 3);
  for (int v = -1; v < 64; ++v) {
    assert_non_null(hbmcheck_status_text((hbmcheck_status)v));
    assert_non_null(hbmcheck_contact_name((hbmcheck_contact)v));
    assert_non_null(hbmcheck_verdict_name((hbmcheck_verdict)v));
  }
  assert_string_equal(hbmcheck_verdict_name(HBMCHECK_VERDICT_SOLVER_FAILED), "solver_failed");
}

CHECK_TESTS("library.arguments", 300, cases, curves, runs, harmless)
