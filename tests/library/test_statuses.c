/* test_statuses.c - every status comes out as its public counterpart; what was found is kept, but not after
 * HBMCHECK_BAD_INPUT and HBMCHECK_NO_MEMORY. Inner functions do their work, then answer what the test says (--wrap). */
#include "tests/library/case2.h"

#include "compare/gate/gate.h"
#include "compare/steady_states.h"
#include "model/casefile/case_file.h"
#include "tests/library/same.h"
#include "tests/wrap.h"

/* X(function, parameters, arguments) */
#define WRAPPED(X)                                                                                                     \
  X(case_parse,                                                                                                        \
    (const char *name, const char *text, size_t length, int n, const char *const *set, scene *out, case_error *err),   \
    (name, text, length, n, set, out, err))                                                                            \
  X(case_read, (const char *path, int n, const char *const *set, scene *out, case_error *err),                         \
    (path, n, set, out, err))                                                                                          \
  X(hbm_solver_new, (const model *m, const hbm_settings *how, hbm_solver **out), (m, how, out))                        \
  X(hbm_curve_at, (hbm_solver * s, const hbm_curve *c, double omega, hbm_curve *at), (s, c, omega, at))                \
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

#define ANSWER(name, parameters, arguments)                                                                            \
  WRAP(hc_status, name, parameters)                                                                                    \
  {                                                                                                                    \
    hc_status st = __real_##name arguments;                                                                            \
    return forced.name != HC_OK ? forced.name : st;                                                                    \
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

static bool keeps(int st) { return st != HC_BAD_INPUT && st != HC_NO_MEMORY; }

/* The answer is the public form of st, and there is a result or there is none. */
static void expect(hbmcheck_status found, int st, bool has_result, int line)
{
  if ((int)found != st) fail_msg("line %d: %s, expected %s", line, hbmcheck_status_text(found), hc_status_text(st));
  assert_string_equal(hbmcheck_status_text(found), hc_status_text((hc_status)st));
  if (has_result != keeps(st)) fail_msg("line %d: %s a result", line, has_result ? "there is" : "there is not");
}

/* After the call `result` is looked at. */
#define EXPECT(call, st, result)                                                                                       \
  do {                                                                                                                 \
    hbmcheck_status found_ = (call);                                                                                   \
    expect(found_, st, (result) != NULL, __LINE__);                                                                    \
  } while (0)

static hbmcheck_case *small(void) { return CASE2("sweep.omega=3,4", "hbm.harmonics=1", "compare.omega=3.5"); }

static void cases(CHECK_STATE)
{
  EACH(st)
  {
    char message[64];
    hbmcheck_case *c = (hbmcheck_case *)&forced;
    forced.case_parse = forced.case_read = st;
    assert_int_equal(hbmcheck_case_parse("x", case2_text, strlen(case2_text), 0, NULL, message, sizeof message, &c),
                     st);
    assert_null(c);
    c = (hbmcheck_case *)&forced;
    assert_int_equal(hbmcheck_case_read("x", 0, NULL, message, sizeof message, &c), st);
    assert_null(c);
    UNFORCED;
  }
}

static void curve(CHECK_STATE)
{
  hbmcheck_case *c = small();
  hbmcheck_curve *curve;
  EACH(st)
  {
    forced.hbm_trace_all = st;
    EXPECT(hbmcheck_curve_trace(c, NULL, &curve), st, curve);
    if (curve) { /* solutions may be missing, and the status says why */
      hbmcheck_solutions *at;
      EXPECT(hbmcheck_curve_at(curve, 3.5, &at), st, at);
      assert_int_equal(hbmcheck_solutions_count(at), 1);
      hbmcheck_solutions_free(at);
    }
    assert_int_equal(hbmcheck_solutions_count(hbmcheck_curve_points(curve)) > 2, keeps(st));
    hbmcheck_curve_free(curve);
    UNFORCED;
    forced.scene_setup = st; /* also: what was made there is freed */
    EXPECT(hbmcheck_curve_trace(c, NULL, &curve), st, curve);
    hbmcheck_curve_free(curve);
    UNFORCED;
    forced.hbm_solver_new = st;
    EXPECT(hbmcheck_curve_trace(c, NULL, &curve), st, curve);
    hbmcheck_curve_free(curve);
    UNFORCED;
  }
  hbmcheck_case_free(c);
}

/* Points before the one that could not be measured are kept. Why the curve stops comes first, but for no memory. */
static void measures(CHECK_STATE)
{
  hbmcheck_case *c = small();
  hbmcheck_curve *curve;
  forced.rows_before = 2;
  EACH(st)
  {
    forced.response_row_of = st;
    EXPECT(hbmcheck_curve_trace(c, NULL, &curve), st, curve);
    assert_int_equal(hbmcheck_solutions_count(hbmcheck_curve_points(curve)), keeps(st) ? 2 : 0);
    hbmcheck_curve_free(curve);
    forced.hbm_trace_all = HC_STALLED;
    EXPECT(hbmcheck_curve_trace(c, NULL, &curve), st == HC_NO_MEMORY ? HC_NO_MEMORY : HC_STALLED, curve);
    hbmcheck_curve_free(curve);
    forced.hbm_trace_all = HC_OK;
  }
  UNFORCED;
  hbmcheck_case_free(c);
}

static void searches(CHECK_STATE)
{
  hbmcheck_case *c = small();
  hbmcheck_solutions *at;
  hbmcheck_special special;
  CHECK_MADE(hbmcheck_curve, curve, hbmcheck_curve_trace(c, NULL, &curve));
  EACH(st)
  {
    hbmcheck_summary whole = {.points = -1};
    int n = -1;
    forced.hbm_curve_at = forced.hbm_specials = forced.response_summarise = st;
    EXPECT(hbmcheck_curve_at(curve, 3.5, &at), st, at);
    assert_int_equal(hbmcheck_solutions_count(at), keeps(st));
    hbmcheck_solutions_free(at);
    assert_int_equal(hbmcheck_curve_specials(curve, 1, &special, &n), st);
    assert_int_equal(n, keeps(st) ? 0 : -1); /* there are none between 3 and 4 */
    assert_int_equal(hbmcheck_curve_summary(curve, &whole), st);
    assert_int_equal(whole.points, -1);
    UNFORCED;
  }
  hbmcheck_curve_free(curve);
  hbmcheck_case_free(c);
}

static void runs(CHECK_STATE)
{
  hbmcheck_case *c = small();
  hbmcheck_transient *t;
  hbmcheck_comparison *both;
  EACH(st)
  {
    hbmcheck_gate gate = {.checks = -1};
    forced.steady_states_run = forced.comparison_run = st;
    EXPECT(hbmcheck_transient_run(c, 0, NULL, NULL, &t), st, t);
    assert_int_equal(hbmcheck_transient_count(t), keeps(st));
    EXPECT(hbmcheck_comparison_run(c, 0, NULL, NULL, &both), st, both);
    assert_int_equal(hbmcheck_comparison_count(both), keeps(st));
    if (both) assert_int_equal(hbmcheck_comparison_gate(both, &gate), st); /* half a comparison is not judged */
    assert_int_equal(gate.checks, -1);
    assert_int_equal(hbmcheck_comparison_exit_code(both), 3);
    hbmcheck_transient_free(t);
    hbmcheck_comparison_free(both);
    UNFORCED;
    forced.scene_setup = st;
    EXPECT(hbmcheck_transient_run(c, 0, NULL, NULL, &t), st, t);
    EXPECT(hbmcheck_comparison_run(c, 0, NULL, NULL, &both), st, both);
    hbmcheck_transient_free(t);
    hbmcheck_comparison_free(both);
    UNFORCED;
  }
  forced.gate_judge = HC_NO_MEMORY;
  EXPECT(hbmcheck_comparison_run(c, 0, NULL, NULL, &both), HC_NO_MEMORY, both);
  UNFORCED;
  hbmcheck_case_free(c);
}

/* Single rows with every status in every place: what was not computed is NaN, or 0 where there is no NaN. */
static void rows(CHECK_STATE)
{
  hbmcheck_case *c = small();
  hbmcheck_transient *t;
  hbmcheck_comparison *both;
  for (int st = HC_OK; st <= HC_BUG; ++st) {
    const bool ok = st == HC_OK, moves = ok || st == HC_NOT_SETTLED || st == HC_APERIODIC;
    int n = -1;
    row_status = (hc_status)st;
    assert_int_equal(hbmcheck_transient_run(c, 0, NULL, NULL, &t), HBMCHECK_OK);
    assert_int_equal(hbmcheck_comparison_run(c, 0, NULL, NULL, &both), HBMCHECK_OK);
    row_status = HC_OK;
    CHECK_FILLED(hbmcheck_steady, s, hbmcheck_transient_get(t, 0, &s));
    const double measured[] = {s.amplitude, s.max, s.min, s.rms, s.mean, s.harmonic_1, s.closure};
    for (int i = 0; i < 7; ++i) assert_int_equal(!isnan(measured[i]), moves);
    SAME(PAIR(s.status, st), PAIR(s.without_hbm, st), PAIR(!isnan(s.multiplier), ok),
         PAIR(!isnan(s.from_regularisation), ok), PAIR(s.period_multiple, ok), PAIR(s.stable, ok));
    assert_int_equal(hbmcheck_transient_wave(t, 0, 0, NULL, &n), HBMCHECK_OK);
    assert_int_equal(n > 0, moves);
    CHECK_FILLED(hbmcheck_row, row, hbmcheck_comparison_get(both, 0, &row));
    SAME(PAIR(row.hbm_status, st), PAIR(row.transient_status, st), PAIR(row.orbit_status, st),
         PAIR(!isnan(row.hbm_amplitude), ok), PAIR(!isnan(row.multiplier), ok), PAIR(row.stable, ok),
         PAIR(!isnan(row.transient_amplitude), moves), PAIR(!isnan(row.orbit_amplitude), ok),
         PAIR(row.period_multiple, ok));
    hbmcheck_transient_free(t);
    hbmcheck_comparison_free(both);
  }
  hbmcheck_case_free(c);
}

CHECK_TESTS("library.statuses", 300, cases, curve, measures, searches, runs, rows)
