/* test_statuses.c - every status comes out as its public counterpart; what was found is kept, but not after
 * HBMCHECK_NO_MEMORY. Inner functions do their work, then answer what the test says (--wrap). */
#include "tests/library/case2.h"

#include "compare/gate/gate.h"
#include "compare/steady_states.h"
#include "model/casefile/case_file.h"
#include "tests/wrap.h"

/* X(function, parameters, arguments) */
#define WRAPPED(X)                                                                                                     \
  X(case_parse,                                                                                                        \
    (const char *name, const char *text, size_t length, int n, const char *const *set, scene *out, case_error *err),   \
    (name, text, length, n, set, out, err))                                                                            \
  X(case_read_sparse,                                                                                                  \
    (const char *path, int n, const char *const *set, int most, scene *out, case_source *source, case_error *err),     \
    (path, n, set, most, out, source, err))                                                                            \
  X(hbm_solver_new, (const model *m, const hbm_settings *how, hbm_solver **out), (m, how, out))                        \
  X(hbm_specials, (hbm_solver * s, const hbm_curve *c, hbm_special **out, int *n), (s, c, out, n))                     \
  X(response_summarise, (hbm_solver * s, const hbm_curve *c, response_summary *out), (s, c, out))                      \
  X(gate_judge, (const char *name, const compare_setup *setup, const comparison *c, gate_case *out),                   \
    (name, setup, c, out))                                                                                             \
  X(scene_setup, (const scene *sc, compare_setup *out), (sc, out))

/* What each is to answer in the place of HC_OK. */
#define FIELD(name, parameters, arguments) hc_status name;
static struct {
  WRAPPED(FIELD) hc_status hbm_trace_all, response_row_of, steady_states_run, comparison_run;
  int rows_before; /* response_row_of: rows that are measured before */
} forced;

/* What fails has made nothing: a scene, a solver. */
static void release_case_parse(scene *sc) { case_clear(sc); }
static void release_case_read_sparse(scene *sc) { case_clear(sc); }
static void release_hbm_solver_new(hbm_solver **s) { hbm_solver_free(*s), *s = NULL; }
static void release_nothing(void *out) { (void)out; }
#define release_hbm_specials       release_nothing
#define release_response_summarise release_nothing
#define release_gate_judge         release_nothing
#define release_scene_setup        release_nothing

#define ANSWER(name, parameters, arguments)                                                                            \
  WRAP(hc_status, name, parameters)                                                                                    \
  {                                                                                                                    \
    hc_status st = __real_##name arguments;                                                                            \
    if (forced.name == HC_OK) return st;                                                                               \
    if (st == HC_OK) release_##name(out);                                                                              \
    return forced.name;                                                                                                \
  }
WRAPPED(ANSWER)

WRAP(hc_status, hbm_trace_all, (hbm_solver * s, double from, double to, const hc_monitor *monitor, hbm_curve *curve))
{
  hc_status st = __real_hbm_trace_all(s, from, to, monitor, curve);
  return forced.hbm_trace_all != HC_OK ? (curve->end = forced.hbm_trace_all) : st;
}

WRAP(hc_status, response_row_of, (hbm_solver * s, const hbm_curve *c, int k, response_row *out))
{
  if (forced.response_row_of != HC_OK && k >= forced.rows_before) return forced.response_row_of;
  return __real_response_row_of(s, c, k, out);
}

static hc_status row_status; /* of the rows that are found; HC_OK: what it is */

WRAP(hc_status, steady_states_run, (const compare_setup *setup, const hc_monitor *monitor, steady_states *out))
{
  hc_status st = __real_steady_states_run(setup, monitor, out);
  for (int k = 0; k < out->n && row_status != HC_OK; ++k) out->rows[k].status = out->rows[k].without_hbm = row_status;
  return forced.steady_states_run != HC_OK ? forced.steady_states_run : st;
}

WRAP(hc_status, comparison_run, (const compare_setup *setup, const hc_monitor *monitor, comparison *out))
{
  hc_status st = __real_comparison_run(setup, monitor, out);
  for (int k = 0; k < out->n_rows && row_status != HC_OK; ++k)
    out->rows[k].hbm_status = out->rows[k].transient_status = out->rows[k].orbit_status = row_status;
  return forced.comparison_run != HC_OK ? forced.comparison_run : st;
}

#define UNFORCED memset(&forced, 0, sizeof forced)

/* Every status but HC_OK (0). */
#define EACH(st) for (int st = HC_BAD_INPUT; st <= HC_JUMPED; ++st)

/* The run ends with the public form of st, with a result that has so many rows, or none. */
static void expect(const hbmcheck_case *c, const char *command, int st, int rows, int line)
{
  hbmcheck_result *r;
  const hbmcheck_status found = RUN(c, command, NULL, &r, NULL);
  if ((int)found != st) fail_msg("line %d: %s, expected %s", line, hbmcheck_status_text(found), hc_status_text(st));
  assert_string_equal(hbmcheck_status_text(found), hc_status_text((hc_status)st));
  if ((r != NULL) != (st != HC_NO_MEMORY)) fail_msg("line %d: %s a result", line, r ? "there is" : "there is not");
  if (r && rows_of(r) != rows) fail_msg("line %d: %d rows, expected %d", line, rows_of(r), rows);
  if (r && st != HC_OK) assert_non_null(hbmcheck_result_remark(r, 0)); /* says why */
  if (r && st != HC_OK) assert_in_range(hbmcheck_result_exit_code(r), 2, 70);
  hbmcheck_result_free(r);
}
#define EXPECT(c, command, st, rows) expect(c, command, st, rows, __LINE__)

static hbmcheck_case *small(void) { return CASE2("sweep.omega=3,4", "hbm.harmonics=1", "compare.omega=3.5"); }

static void cases(CHECK_STATE)
{
  EACH(st)
  {
    char message[64];
    hbmcheck_case *c = (hbmcheck_case *)&forced;
    forced.case_parse = forced.case_read_sparse = st;
    assert_int_equal(hbmcheck_case_parse("x", case2_text, strlen(case2_text), 0, NULL, message, sizeof message, &c),
                     st);
    assert_null(c);
    c = (hbmcheck_case *)&forced;
    assert_int_equal(hbmcheck_case_read(SOURCE_DIR "/cases/paper/case2.yaml", 0, NULL, message, sizeof message, &c),
                     st);
    assert_null(c);
    UNFORCED;
  }
}

/* A curve that stops keeps its points; special points that cannot be located are a remark; where it cannot begin there
 * is no row. */
static void curve(CHECK_STATE)
{
  hbmcheck_case *c = small();
  hbmcheck_result *r;
  assert_int_equal(RUN(c, "frf", NULL, &r, NULL), HBMCHECK_OK);
  const int rows = rows_of(r);
  hbmcheck_result_free(r);
  assert_true(rows > 2);
  EACH(st)
  {
    forced.hbm_trace_all = st;
    EXPECT(c, "frf", st, rows);
    UNFORCED;
    forced.hbm_solver_new = st;
    EXPECT(c, "frf", st, 0);
    UNFORCED;
    forced.response_summarise = st;
    EXPECT(c, "frf", st, rows);
    UNFORCED;
    forced.hbm_specials = st;
    EXPECT(c, "frf", st == HC_NO_MEMORY ? st : HC_OK, rows);
    UNFORCED;
    forced.rows_before = 2; /* points before the one that could not be measured are kept */
    forced.response_row_of = st;
    EXPECT(c, "frf", st, 2);
    UNFORCED;
  }
  hbmcheck_case_free(c);
}

static void runs(CHECK_STATE)
{
  hbmcheck_case *c = small();
  EACH(st)
  {
    forced.steady_states_run = forced.comparison_run = st;
    EXPECT(c, "transient", st, 1);
    EXPECT(c, "compare", st, 1); /* half a comparison is not judged: */
    hbmcheck_result *r;
    RUN(c, "compare", NULL, &r, NULL);
    assert_null(table_titled(r, "Gate"));
    hbmcheck_result_free(r);
    UNFORCED;
    forced.scene_setup = st; /* also: what was made there is freed */
    EXPECT(c, "transient", st, 0);
    EXPECT(c, "compare", st, 0);
    UNFORCED;
  }
  forced.gate_judge = HC_NO_MEMORY;
  EXPECT(c, "compare", HC_NO_MEMORY, 0);
  UNFORCED;
  hbmcheck_case_free(c);
}

/* Single rows with every status in every place: what was not computed is NaN, or 0 where there is no NaN. */
static void rows(CHECK_STATE)
{
  hbmcheck_case *c = small();
  hbmcheck_result *t, *both;
  for (int st = HC_OK; st <= HC_BUG; ++st) {
    static const char *const measures[] = {"amplitude", "max", "min", "rms", "mean", "harmonic_1", "closure"};
    const bool ok = st == HC_OK, moves = ok || st == HC_NOT_SETTLED || st == HC_APERIODIC;
    if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) continue; /* of rows the command leaves out; of the whole run */
    row_status = (hc_status)st;
    assert_int_equal(RUN(c, "transient", NULL, &t, NULL), HBMCHECK_OK);
    assert_int_equal(RUN(c, "compare", NULL, &both, NULL), HBMCHECK_OK);
    row_status = HC_OK;
    const hbmcheck_table *s = hbmcheck_result_table(t, 0), *row = hbmcheck_result_table(both, 0);
    for (int i = 0; i < 7; ++i) assert_int_equal(!isnan(hbmcheck_table_number(s, 0, measures[i])), moves);
    assert_string_equal(hbmcheck_table_text(s, 0, "status"), hc_status_text((hc_status)st));
    assert_string_equal(hbmcheck_table_text(s, 0, "without_hbm"), hc_status_text((hc_status)st));
    assert_int_equal(!isnan(hbmcheck_table_number(s, 0, "multiplier")), ok);
    assert_int_equal(!isnan(hbmcheck_table_number(s, 0, "from_regularisation")), ok);
    assert_true(hbmcheck_table_number(s, 0, "period_multiple") == ok);
    assert_string_equal(hbmcheck_table_text(s, 0, "stable"), ok ? "yes" : "unknown");
    assert_int_equal(hbmcheck_table_numbers(s, 0, "wave", 0, NULL) > 0, moves);
    static const char *const sides[] = {"hbm_status", "transient_status", "orbit_status"};
    for (int i = 0; i < 3; ++i)
      assert_string_equal(hbmcheck_table_text(row, 0, sides[i]), hc_status_text((hc_status)st));
    assert_int_equal(!isnan(hbmcheck_table_number(row, 0, "hbm_amplitude")), ok);
    assert_int_equal(!isnan(hbmcheck_table_number(row, 0, "multiplier")), ok);
    assert_int_equal(!isnan(hbmcheck_table_number(row, 0, "transient_amplitude")), moves);
    assert_int_equal(!isnan(hbmcheck_table_number(row, 0, "orbit_amplitude")), ok);
    assert_true(hbmcheck_table_number(row, 0, "period_multiple") == ok);
    hbmcheck_result_free(t);
    hbmcheck_result_free(both);
  }
  hbmcheck_case_free(c);
}

CHECK_TESTS("library.statuses", 300, cases, curve, runs, rows)
