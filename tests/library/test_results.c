/* test_results.c - what the C API hands out are the numbers of those it calls, bit for bit and each in its place; what
 * was not computed is NaN. The scenes show every verdict's side: stable, unstable, period k, aperiodic, failed. */
#include "tests/library/case2.h"

#include "compare/gate/gate.h"
#include "compare/steady_states.h"
#include "model/casefile/case_file.h"
#include "tests/library/same.h"

/* The inner form of CASE2(set...). */
static compare_setup setup_of(scene *sc, const char *const *set)
{
  case_error err;
  int n = 0;
  while (set[n]) ++n;
  assert_int_equal(case_parse("case 2", case2_text, strlen(case2_text), n, set, sc, &err), HC_OK);
  CHECK_FILLED(compare_setup, setup, scene_setup(sc, &setup));
  return setup;
}

static void check_solution(const hbmcheck_solutions *list, hbm_solver *s, const hbm_curve *curve, int k)
{
  double X[2 * HBM_MAX_HARMONICS + 1];
  int n = 0;
  CHECK_FILLED(response_row, r, response_row_of(s, curve, k, &r));
  CHECK_FILLED(hbmcheck_solution, found, hbmcheck_solutions_get(list, k, &found));
  SAME(PAIR(found.omega, r.point.omega), PAIR(found.amplitude, r.measures.amplitude), PAIR(found.max, r.measures.max),
       PAIR(found.min, r.measures.min), PAIR(found.rms, r.measures.rms), PAIR(found.mean, r.measures.mean),
       PAIR(found.harmonic_1, r.measures.harmonic_1), PAIR(found.multiplier, r.stability.multiplier),
       PAIR(found.residual, r.point.residual), PAIR(found.stable, hbm_stability_verdict(&r.stability)),
       PAIR(found.branch, r.point.branch), PAIR(found.harmonics, r.point.harmonics),
       PAIR(found.iterations, r.point.iterations));
  assert_string_equal(hbmcheck_contact_name(found.contact), contact_regime_name(r.measures.contact.regime));
  assert_int_equal(hbmcheck_solutions_coefficients(list, k, 2 * HBM_MAX_HARMONICS + 1, X, &n), HBMCHECK_OK);
  assert_int_equal(n, 2 * r.point.harmonics + 1);
  for (int i = 0; i < n; ++i) SAME(PAIR(X[i], curve->X[(size_t)k * (size_t)curve->n_coef + (size_t)i]));
}

static void check_specials(hbmcheck_curve *curve, hbm_solver *s, const hbm_curve *c)
{
  hbm_special *expected;
  hbmcheck_special found[32];
  int n_expected = 0, n = 0, again = 0;
  assert_int_equal(hbm_specials(s, c, &expected, &n_expected), HC_OK);
  assert_int_equal(hbmcheck_curve_specials(curve, 32, found, &n), HBMCHECK_OK);
  assert_int_equal(n, n_expected);
  assert_in_range(n, 4, 32); /* two turns, two changes of the contact */
  for (int i = 0; i < n; ++i)
    SAME(PAIR(found[i].omega, expected[i].omega), PAIR(found[i].amplitude, expected[i].amplitude),
         PAIR(found[i].branch, expected[i].branch), PAIR(found[i].kind, expected[i].kind),
         PAIR(found[i].before, expected[i].before), PAIR(found[i].after, expected[i].after));
  found[1].omega = -1; /* room for one: the second is not written */
  assert_int_equal(hbmcheck_curve_specials(curve, 1, found, &again), HBMCHECK_OK);
  assert_int_equal(again, n);
  SAME(PAIR(found[0].omega, expected[0].omega), PAIR(found[1].omega, -1));
  assert_int_equal(hbmcheck_curve_specials(curve, 0, NULL, &again), HBMCHECK_OK);
  assert_int_equal(again, n);
  free(expected);
}

static void check_curve(const char *const *set)
{
  scene sc;
  compare_setup setup = setup_of(&sc, set);
  hbm_curve expected = {0}, at = {0};
  hbmcheck_case *c = case2_with(set);
  CHECK_MADE(hbm_solver, s, hbm_solver_new(setup.model, &setup.hbm, &s));
  assert_int_equal(hbm_trace_all(s, setup.omega_from, setup.omega_to, NULL, &expected), HC_OK);
  CHECK_MADE(hbmcheck_curve, curve, hbmcheck_curve_trace(c, NULL, &curve));
  hbmcheck_case_free(c); /* results do not need it any more */
  const hbmcheck_solutions *points = hbmcheck_curve_points(curve);
  assert_int_equal(hbmcheck_solutions_count(points), expected.n);
  for (int k = 0; k < expected.n; ++k) check_solution(points, s, &expected, k);
  assert_int_equal(hbm_curve_at(s, &expected, 8, &at), HC_OK);
  CHECK_MADE(hbmcheck_solutions, three, hbmcheck_curve_at(curve, 8, &three));
  assert_int_equal(at.n, 3); /* two stable solutions and an unstable one between them */
  assert_int_equal(hbmcheck_solutions_count(three), 3);
  for (int k = 0; k < 3; ++k) check_solution(three, s, &at, k);
  hbmcheck_solutions_free(three);
  assert_int_equal(hbmcheck_curve_at(curve, 21, &three), HBMCHECK_OK); /* beyond the sweep: none */
  assert_int_equal(hbmcheck_solutions_count(three), 0);
  hbmcheck_solutions_free(three);
  check_specials(curve, s, &expected);
  CHECK_FILLED(response_summary, r, response_summarise(s, &expected, &r));
  CHECK_FILLED(hbmcheck_summary, found, hbmcheck_curve_summary(curve, &found));
  SAME(PAIR(found.peak_omega, r.peak_omega), PAIR(found.peak_amplitude, r.peak_amplitude),
       PAIR(found.peak_harmonic_1, r.peak_harmonic_1), PAIR(found.points, r.points),
       PAIR(found.turning_points, r.turning_points), PAIR(found.harmonics, r.harmonics), PAIR(found.samples, r.samples),
       PAIR(found.rejected, r.rejected), PAIR(found.iterations, r.iterations), PAIR(found.evaluations, r.evaluations),
       PAIR(found.reached_end, r.reached_end), PAIR(found.left_at_start, r.left_at_start),
       PAIR(found.inaccurate, expected.inaccurate));
  hbmcheck_curve_free(curve);
  hbm_curve_free(&at);
  hbm_curve_free(&expected);
  hbm_solver_free(s);
  scene_setup_clear(&setup);
}

static void curve(CHECK_STATE)
{
  check_curve((const char *[]){"hbm.harmonics=7", NULL});
  check_curve((const char *[]){"hbm.harmonics=auto", "hbm.accuracy=1e-3", NULL});
  check_curve((const char *[]){"hbm.harmonics=5", "hbm.force=sampled", "hbm.samples=2048", NULL});
}

/* Nearly rigid, no harmonic 0: the fold is beyond the cut at 4 times the start (hbm.trace.a_branch_that_leaves). */
static void curve_that_leaves(CHECK_STATE)
{
  hbmcheck_case *c =
      CASE2("sweep.omega=8.5,3", "hbm.harmonics=1", "hbm.static=false", "contacts[0].normal_stiffness=1e7");
  CHECK_MADE(hbmcheck_curve, curve, hbmcheck_curve_trace(c, NULL, &curve));
  CHECK_FILLED(hbmcheck_summary, whole, hbmcheck_curve_summary(curve, &whole));
  SAME(PAIR(whole.reached_end, 0), PAIR(whole.left_at_start, 1), PAIR(whole.turning_points, 1));
  hbmcheck_curve_free(curve);
  hbmcheck_case_free(c);
}

static void check_steady(const hbmcheck_transient *t, const steady_states *all, int k)
{
  double wave[TIMEINT_WAVE];
  const steady_row *row = &all->rows[k];
  const timeint_result *r = &row->result;
  const bool settled = row->status == HC_OK,
             moves = settled || row->status == HC_NOT_SETTLED || row->status == HC_APERIODIC;
  int n = -1;
  CHECK_FILLED(hbmcheck_steady, found, hbmcheck_transient_get(t, k, &found));
  SAME(PAIR(found.status, row->status), PAIR(found.without_hbm, row->without_hbm), PAIR(found.omega, r->omega),
       PAIR(found.amplitude, moves ? r->amplitude : NAN), PAIR(found.max, moves ? r->max : NAN),
       PAIR(found.min, moves ? r->min : NAN), PAIR(found.rms, moves ? r->rms : NAN),
       PAIR(found.mean, moves ? r->mean : NAN), PAIR(found.harmonic_1, moves ? r->harmonic_1 : NAN),
       PAIR(found.closure, moves ? r->closure : NAN), PAIR(found.multiplier, settled ? r->multiplier : NAN),
       PAIR(found.from_regularisation, settled ? row->from_regularisation : NAN),
       PAIR(found.stable, settled ? timeint_stability(r) : 0),
       PAIR(found.period_multiple, settled ? r->period_multiple : 0), PAIR(found.periods, r->periods),
       PAIR(found.steps, r->steps), PAIR(found.free_sliders, r->free_sliders), PAIR(found.left_orbit, r->left_orbit),
       PAIR(found.contact, r->regime));
  assert_int_equal(hbmcheck_transient_wave(t, k, TIMEINT_WAVE, wave, &n), HBMCHECK_OK);
  assert_int_equal(n, moves ? TIMEINT_WAVE : 0);
  assert_memory_equal(wave, r->wave, (size_t)n * sizeof *wave);
}

/* What the scenes are to show at least once. */
static struct {
  bool aperiodic, period_4, unstable, not_settled, at_rest;
} seen;

static void look(const steady_row *row)
{
  seen.aperiodic |= row->status == HC_APERIODIC;
  seen.period_4 |= row->status == HC_OK && row->result.period_multiple == 4;
  seen.unstable |= row->status == HC_OK && timeint_stability(&row->result) < 0;
  seen.not_settled |= row->status == HC_NOT_SETTLED;
  seen.at_rest |= row->without_hbm != HC_OK;
}

static void check_transient(const char *const *set, int n, const double *omega)
{
  scene sc;
  compare_setup setup = setup_of(&sc, set);
  hbmcheck_case *c = case2_with(set);
  setup.compare.omega.n = n;
  memcpy(setup.compare.omega.v, omega, (size_t)n * sizeof *omega);
  CHECK_FILLED(steady_states, expected, steady_states_run(&setup, NULL, &expected));
  CHECK_MADE(hbmcheck_transient, t, hbmcheck_transient_run(c, n, omega, NULL, &t));
  hbmcheck_case_free(c);
  assert_int_equal(hbmcheck_transient_count(t), expected.n);
  for (int k = 0; k < expected.n; ++k) check_steady(t, &expected, k), look(&expected.rows[k]);
  hbmcheck_transient_free(t);
  steady_states_clear(&expected);
  scene_setup_clear(&setup);
}

/* Case 2: period 4 at 5.11, aperiodic at 5.3 (docs/measurements), where shooting finds the unstable orbit; from rest
 * nothing settles in two periods; where the HBM curve stops before omega (natural continuation, at the fold), the start
 * is at rest. */
static void transient(CHECK_STATE)
{
  check_transient((const char *[]){"hbm.harmonics=10", NULL}, 3, (double[]){5.11, 5.3, 8});
  check_transient(
      (const char *[]){"transient.start=rest", "transient.max_periods=2", "transient.steady_state=march", NULL}, 1,
      (double[]){8});
  check_transient((const char *[]){"hbm.harmonics=10", "transient.steady_state=shooting", NULL}, 1, (double[]){5.3});
  check_transient((const char *[]){"transient.law=regularised", "transient.tolerance=1e-6", NULL}, 1, (double[]){7});
  check_transient((const char *[]){"hbm.continuation=natural", NULL}, 1, (double[]){12});
  assert_true(seen.aperiodic && seen.period_4 && seen.unstable && seen.not_settled && seen.at_rest);
}

static void check_comparison(const char *const *set, int exit_code, int gate_code)
{
  scene sc;
  compare_setup setup = setup_of(&sc, set);
  hbmcheck_case *c = case2_with(set);
  setup.multipliers = true; /* as the library asks for them */
  CHECK_FILLED(comparison, expected, comparison_run(&setup, NULL, &expected));
  CHECK_FILLED(gate_case, judged, gate_judge("case 2", &setup, &expected, &judged));
  CHECK_MADE(hbmcheck_comparison, both, hbmcheck_comparison_run(c, 0, NULL, NULL, &both));
  hbmcheck_case_free(c);
  assert_int_equal(hbmcheck_comparison_count(both), expected.n_rows);
  for (int k = 0; k < expected.n_rows; ++k) {
    const comparison_row *r = &expected.rows[k];
    const bool hbm = r->branch >= 0 && r->hbm_status == HC_OK, orbit = r->orbit_status == HC_OK;
    const bool moves =
        r->transient_status == HC_OK || r->transient_status == HC_NOT_SETTLED || r->transient_status == HC_APERIODIC;
    CHECK_FILLED(hbmcheck_row, found, hbmcheck_comparison_get(both, k, &found));
    assert_string_equal(hbmcheck_verdict_name(found.verdict), verdict_name(r->verdict));
    SAME(PAIR(found.omega, r->omega), PAIR(found.hbm_status, r->hbm_status),
         PAIR(found.transient_status, r->transient_status), PAIR(found.orbit_status, r->orbit_status),
         PAIR(found.branch, r->branch), PAIR(found.stable, hbm ? hbm_stability_verdict(&r->stability) : 0),
         PAIR(found.period_multiple, r->transient_status == HC_OK ? r->transient.period_multiple : 0),
         PAIR(found.accounted, r->accounted), PAIR(found.multiplier, hbm ? r->stability.multiplier : NAN),
         PAIR(found.hbm_amplitude, hbm ? r->hbm.amplitude : NAN),
         PAIR(found.transient_amplitude, moves ? r->transient.amplitude : NAN),
         PAIR(found.orbit_amplitude, orbit ? r->orbit.amplitude : NAN),
         PAIR(found.amplitude_error, r->errors.amplitude), PAIR(found.harmonic_1_error, r->errors.harmonic_1),
         PAIR(found.mean_error, r->errors.mean), PAIR(found.waveform_error, r->errors.waveform),
         PAIR(found.orbit_error, r->orbit_errors.waveform), PAIR(found.from_aliasing, r->budget.amplitude.aliasing),
         PAIR(found.from_truncation, r->budget.amplitude.truncation),
         PAIR(found.from_regularisation, r->budget.amplitude.regularisation),
         PAIR(found.from_integration, r->budget.amplitude.integration),
         PAIR(found.from_settling, r->budget.amplitude.settling), PAIR(found.hbm_predicted, r->hbm_predicted.amplitude),
         PAIR(found.transient_predicted, r->transient_predicted.amplitude), PAIR(found.unexpected, r->unexpected));
  }
  assert_int_equal(hbmcheck_comparison_exit_code(both), exit_code);
  assert_int_equal(comparison_exit_code(&expected), exit_code);
  CHECK_FILLED(hbmcheck_gate, gate, hbmcheck_comparison_gate(both, &gate));
  SAME(PAIR(gate.checks, judged.n), PAIR(gate.failed, judged.failures), PAIR(gate.errors, judged.errors),
       PAIR(gate.exit_code, gate_code));
  hbmcheck_comparison_free(both);
  gate_clear(&judged);
  comparison_clear(&expected);
  scene_setup_clear(&setup);
}

/* Agreement (0); without the mean, a difference (1); natural continuation, which cannot pass the fold, so that there is
 * no solution at 12 (3); a transient of another period, and none (1); from rest nothing settles in two periods (3). */
static void comparison_and_gate(CHECK_STATE)
{
  check_comparison((const char *[]){"compare.omega=6,8", "hbm.harmonics=20", NULL}, 0, 0);
  check_comparison((const char *[]){"compare.omega=6.5,8", "hbm.static=false", NULL}, 1, 1);
  check_comparison((const char *[]){"compare.omega=6,12", "hbm.harmonics=10", "hbm.continuation=natural", NULL}, 3, 3);
  check_comparison((const char *[]){"compare.omega=5.11,5.3", "hbm.harmonics=10", NULL}, 1, 1);
  check_comparison((const char *[]){"compare.omega=8", "hbm.harmonics=10", "transient.start=rest",
                                    "transient.max_periods=2", "transient.steady_state=march", NULL},
                   3, 3);
  check_comparison((const char *[]){"compare.points=3", "hbm.harmonics=20", "sweep.omega=10,20", NULL}, 0, 0);
}

/* Frequencies given in the call take the place of the case's; each once, ascending. */
static void omegas_of_the_call(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("compare.omega=5,6");
  CHECK_MADE(hbmcheck_comparison, both, hbmcheck_comparison_run(c, 3, (double[]){4, 3.5, 4}, NULL, &both));
  assert_int_equal(hbmcheck_comparison_count(both), 2);
  CHECK_FILLED(hbmcheck_row, row, hbmcheck_comparison_get(both, 0, &row));
  SAME(PAIR(row.omega, 3.5));
  assert_int_equal(hbmcheck_comparison_get(both, 1, &row), HBMCHECK_OK);
  SAME(PAIR(row.omega, 4));
  hbmcheck_comparison_free(both);
  hbmcheck_case_free(c);
}

/* The same case from a file, from memory, and what is wrong with it in words. */
static void cases_and_messages(CHECK_STATE)
{
  const char *const set[] = {"hbm.harmonic=3"};
  char message[512], cut[9];
  CHECK_MADE(hbmcheck_case, c,
             hbmcheck_case_read(SOURCE_DIR "/cases/paper/case2.yaml", 0, NULL, message, sizeof message, &c));
  assert_string_equal(message, "");
  hbmcheck_case_free(c);
  assert_int_equal(hbmcheck_case_parse("two", case2_text, strlen(case2_text), 1, set, message, sizeof message, &c),
                   HBMCHECK_BAD_INPUT);
  assert_null(c);
  assert_non_null(strstr(message, "hbm.harmonics")); /* a suggestion */
  assert_int_equal(hbmcheck_case_parse("two", "mass: 1", 7, 0, NULL, cut, sizeof cut, &c), HBMCHECK_BAD_INPUT);
  assert_string_equal(cut, "two:1:1:");
  assert_int_equal(hbmcheck_case_parse("two", "mass: 1", 7, 0, NULL, NULL, 0, &c), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_case_read("no/such/file.yaml", 0, NULL, message, sizeof message, &c), HBMCHECK_IO);
  assert_null(c);
  assert_non_null(strstr(message, "no/such/file.yaml"));
}

/* The numbers and the text of the version say the same. */
static void version(CHECK_STATE)
{
  char text[32];
  snprintf(text, sizeof text, "%d.%d.%d", HBMCHECK_VERSION_MAJOR, HBMCHECK_VERSION_MINOR, HBMCHECK_VERSION_PATCH);
  assert_string_equal(text, HBMCHECK_VERSION);
  assert_string_equal(hbmcheck_version(), HBMCHECK_VERSION);
}

CHECK_TESTS("library.results", 300, curve, curve_that_leaves, transient, comparison_and_gate, omegas_of_the_call,
            cases_and_messages, version)
