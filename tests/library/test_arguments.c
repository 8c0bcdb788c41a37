/* test_arguments.c - HBMCHECK_BAD_INPUT: nothing is written but NULL into the place of a handle; what asks takes
 * NULL. */
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
  const double one[] = {1, NAN};
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
  BAD_AND_NULL(c, hbmcheck_case_parse("x", case2_text, length, -1, set, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", case2_text, length, 1, NULL, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", case2_text, length, 2, set, NULL, 0, &c));
  BAD_AND_NULL(c, hbmcheck_case_parse("x", case2_text, length, 1, (const char *[]){"hbm.harmonics=0x"}, NULL, 0, &c));
  c = CASE2(NULL);
  BAD(hbmcheck_case_give(NULL, "compare.omega", 1, 1, one, NULL, 0));
  BAD(hbmcheck_case_give(c, NULL, 1, 1, one, NULL, 0));
  BAD(hbmcheck_case_give(c, "compare.omega", 0, 1, one, NULL, 0));
  BAD(hbmcheck_case_give(c, "compare.omega", 1, 0, one, NULL, 0));
  BAD(hbmcheck_case_give(c, "compare.omega", 1, 1, NULL, NULL, 0));
  BAD(hbmcheck_case_give(c, "compare.omega", 1, 2, one, message, sizeof message)); /* NaN */
  assert_string_not_equal(message, "");
  hbmcheck_case_free(c);
}

static void runs(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("hbm.harmonics=3", "sweep.omega=3,6");
  const char *const none[] = {"--at=4", NULL};
  hbmcheck_result *r;
  BAD(hbmcheck_run(c, "frf", 0, NULL, NULL, NULL));
  BAD_AND_NULL(r, hbmcheck_run(NULL, "frf", 0, NULL, NULL, &r));
  BAD_AND_NULL(r, hbmcheck_run(c, NULL, 0, NULL, NULL, &r));
  BAD_AND_NULL(r, hbmcheck_run(c, "study", 0, NULL, NULL, &r));
  BAD_AND_NULL(r, hbmcheck_run(c, "frf", -1, NULL, NULL, &r));
  BAD_AND_NULL(r, hbmcheck_run(c, "frf", 1, NULL, NULL, &r));
  BAD_AND_NULL(r, hbmcheck_run(c, "frf", 2, none, NULL, &r));
  /* In words; the exit code is the command's. */
  const struct {
    const char *option, *words;
  } bad[] = {{"at=4", "'at=4' is no option"},
             {"--att=4", "unrecognized option '--att', did you mean"},
             {"--at", "--at: a value is missing"},
             {"--at=", "--at: '' is not a positive number"},
             {"--at=4,x", "--at: 'x' is not a positive number"},
             {"--contacts=yes", "--contacts takes no value"},
             {"--plot=a.svg", "unrecognized option '--plot'"},
             {"--format=csv", "unrecognized option '--format'"},
             {"--response=y", "--response: the case has no `y`; expected x"},
             {"--set=hbm.harmonics=0", "hbm.harmonics"}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
    BAD(RUN(c, "frf", NULL, &r, bad[i].option));
    const char *said = hbmcheck_result_remark(r, 0);
    if (!said || !strstr(said, bad[i].words)) fail_msg("'%s' does not say '%s'", said ? said : "", bad[i].words);
    assert_null(hbmcheck_result_table(r, 0));
    assert_in_range(hbmcheck_result_exit_code(r), 2, 64);
    hbmcheck_result_free(r);
  }
  hbmcheck_case_free(c);
}

static void tables(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("hbm.harmonics=3");
  hbmcheck_result *r;
  hbmcheck_column column = {.size = sizeof column};
  double X[8] = {0};
  assert_int_equal(RUN(c, "frf", NULL, &r, "--at", "4"), HBMCHECK_OK);
  const hbmcheck_table *t = hbmcheck_result_table(r, 0);
  assert_null(hbmcheck_result_table(r, -1));
  assert_null(hbmcheck_result_table(r, 99));
  assert_null(hbmcheck_result_remark(r, -1));
  BAD(hbmcheck_table_column(t, -1, &column));
  BAD(hbmcheck_table_column(t, 99, &column));
  BAD(hbmcheck_table_column(t, 0, NULL));
  column.size = 8; /* of a struct that is none */
  BAD(hbmcheck_table_column(t, 0, &column));
  assert_true(isnan(hbmcheck_table_number(t, 1, "omega")));
  assert_true(isnan(hbmcheck_table_number(t, -1, "omega")));
  assert_true(isnan(hbmcheck_table_number(t, 0, "omeg")));
  assert_true(isnan(hbmcheck_table_number(t, 0, NULL)));
  assert_true(isnan(hbmcheck_table_number(t, 0, "stable"))); /* a text */
  assert_null(hbmcheck_table_text(t, 0, "omega"));
  assert_null(hbmcheck_table_text(t, 7, "stable"));
  assert_string_equal(hbmcheck_table_text(t, 0, "stable"), "yes");
  assert_int_equal(hbmcheck_table_numbers(t, 0, "coefficients", 0, NULL), 7);
  assert_int_equal(hbmcheck_table_numbers(t, 0, "coefficients", 8, NULL), 0);
  assert_int_equal(hbmcheck_table_numbers(t, 0, "coefficients", -1, X), 0);
  assert_int_equal(hbmcheck_table_numbers(t, -1, "coefficients", 8, X), 0);
  assert_int_equal(hbmcheck_table_numbers(t, 0, "omega", 8, X), 0);
  assert_int_equal(hbmcheck_table_numbers(t, 1, "coefficients", 8, X), 0);
  assert_true(X[0] == 0);
  assert_int_equal(hbmcheck_table_numbers(t, -1, "omega", 8, X), 1);
  assert_true(X[0] == 4);
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
}

/* What counts, names or frees takes NULL and values that are none. */
static void harmless(CHECK_STATE)
{
  hbmcheck_case_free(NULL);
  hbmcheck_result_free(NULL);
  assert_int_equal(hbmcheck_result_exit_code(NULL), 70);
  assert_null(hbmcheck_result_remark(NULL, 0));
  assert_null(hbmcheck_result_table(NULL, 0));
  assert_null(hbmcheck_table_title(NULL));
  assert_null(hbmcheck_table_remark(NULL, 0));
  assert_int_equal(hbmcheck_table_rows(NULL), 0);
  assert_null(hbmcheck_table_text(NULL, 0, "omega"));
  assert_true(isnan(hbmcheck_table_number(NULL, 0, "omega")));
  assert_int_equal(hbmcheck_table_numbers(NULL, 0, "omega", 0, NULL), 0);
  for (int v = -1; v < 64; ++v) assert_non_null(hbmcheck_status_text((hbmcheck_status)v));
}

CHECK_TESTS("library.arguments", 300, cases, runs, tables, harmless)
