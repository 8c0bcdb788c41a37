/* test_judge.c - what passes the gate, on comparisons whose answer is plain; and their JUnit. */
#include "tests/scene_runs.h"

enum { MOST = 4 };

/* A comparison of up to MOST rows, by hand. */
typedef struct made {
  scene sc;
  comparison c;
  comparison_row rows[MOST];
  hbm_point point; /* the curve's last one */
  gate_case g;
} made;

static made *start(int n)
{
  made *m = calloc(1, sizeof *m);
  m->sc = scene_oscillator(1, 1, 1, 1);
  m->sc.gate.most = (discrepancy){1e-3, 1e-3, 1e-3, 5e-3};
  m->sc.transient.tolerance = 1e-9;
  m->c = (comparison){.n_rows = n, .rows = m->rows};
  m->c.curve.points = &m->point;
  for (int i = 0; i < n; ++i) {
    comparison_row *r = &m->rows[i];
    *r = (comparison_row){.omega = 7, .branch = i, .verdict = VERDICT_MATCH, .accounted = true};
    r->transient.amplitude = r->orbit.amplitude = r->hbm.amplitude = 2;
    r->transient.period_multiple = r->orbit.period_multiple = 1;
    r->errors = r->orbit_errors = (discrepancy){1e-4, 1e-4, 1e-4, 1e-4};
  }
  return m;
}

static int judged(made *m)
{
  gate_clear(&m->g);
  assert_int_equal(scene_gate_judge("made", &m->sc, &m->c, &m->g), HC_OK);
  return gate_exit_code(1, &m->g);
}

static void end(made *m)
{
  gate_clear(&m->g);
  free(m);
}

static const gate_check *find(const made *m, int branch, const char *quantity)
{
  for (int i = 0; i < m->g.n; ++i)
    if (m->g.checks[i].branch == branch && !strcmp(m->g.checks[i].quantity, quantity)) return &m->g.checks[i];
  fail_msg("no check of %s on branch %d", quantity, branch);
  return NULL;
}

static void every_quantity_has_its_limit(CHECK_STATE)
{
  made *m = start(1);
  assert_int_equal(judged(m), 0);
  assert_int_equal(m->g.n, 4);
  static const char *const names[] = {"amplitude", "harmonic_1", "mean", "waveform"};
  double *errors[] = {&m->rows[0].errors.amplitude, &m->rows[0].errors.harmonic_1, &m->rows[0].errors.mean,
                      &m->rows[0].errors.waveform};
  for (int q = 0; q < 4; ++q) {
    *errors[q] = 6e-3; /* beyond each */
    assert_int_equal(judged(m), 1);
    assert_int_equal(m->g.failures, 1);
    const gate_check *c = find(m, 0, names[q]);
    assert_true(c->result == GATE_FAIL && c->found == 6e-3 && c->allowed == (q == 3 ? 5e-3 : 1e-3) &&
                !strcmp(c->against, "transient"));
    *errors[q] = 1e-4;
  }
  m->rows[0].errors.mean = 1, m->rows[0].transient.free_sliders = 1; /* the mean is history */
  assert_int_equal(judged(m), 0);
  assert_int_equal(m->g.n, 4);
  assert_int_equal(m->g.not_applicable, 1);
  assert_int_equal(find(m, 0, "mean")->result, GATE_NOT_APPLICABLE);
  assert_non_null(strstr(find(m, 0, "mean")->reason, "not applicable: a slider never slips"));
  m->rows[0].errors.amplitude = NAN;
  assert_int_equal(judged(m), 3);
  end(m);
}

static void rounding_at_the_limit_decides_nothing(CHECK_STATE)
{
  made *m = start(1);
  for (int side = -1; side <= 1; ++side) {
    m->rows[0].errors.amplitude = 1e-3 * (1 + side * 1e-9);
    assert_int_equal(judged(m), 0);
    assert_true(gate_shown(find(m, 0, "amplitude")) == 1e-3);
  }
  m->rows[0].errors.amplitude = 1e-3 * (1 + 2 * GATE_SLACK);
  assert_int_equal(judged(m), 1);
  CHECK_LE(1e-3 + 1e-10, gate_shown(find(m, 0, "amplitude")), "a failure is not shown as within the limit");
  m->rows[0].errors.amplitude = 0.00031459;
  judged(m);
  assert_true(gate_shown(find(m, 0, "amplitude")) == 0.000315);
  m->rows[0].errors.amplitude = 2.7e-16;
  judged(m);
  assert_true(gate_shown(find(m, 0, "amplitude")) == 0);
  end(m);
}

static void limits_may_differ_in_ranges(CHECK_STATE)
{
  made *m = start(3);
  gate_ranges *g = &m->sc.gate.ranges;
  *g = (gate_ranges){.ends = {4, {7, 9, 8, 12}}, .amplitude = {2, {1e-2, 1e-5}}};
  /* below; at the lower end; in both: the last one counts */
  m->rows[0].omega = 6.99, m->rows[1].omega = 7, m->rows[2].omega = 8;
  for (int i = 0; i < 3; ++i) m->rows[i].errors.amplitude = 2e-3;
  assert_int_equal(judged(m), 1);
  assert_true(find(m, 0, "amplitude")->allowed == 1e-3 && find(m, 1, "amplitude")->allowed == 1e-2 &&
              find(m, 2, "amplitude")->allowed == 1e-5);
  assert_true(find(m, 1, "amplitude")->result == GATE_PASS && find(m, 1, "mean")->allowed == 1e-3 &&
              m->g.failures == 2);
  m->rows[0].omega = 12, m->rows[1].omega = 9, m->rows[2].omega = 12.01; /* at both upper ends; above */
  g->ends.v[2] = 9.5;
  judged(m);
  assert_true(find(m, 0, "amplitude")->allowed == 1e-5 && find(m, 1, "amplitude")->allowed == 1e-2 &&
              find(m, 2, "amplitude")->allowed == 1e-3);
  end(m);
}

static void an_unstable_solution_is_held_against_its_orbit(CHECK_STATE)
{
  made *m = start(1);
  comparison_row *r = &m->rows[0];
  r->verdict = VERDICT_UNSTABLE;
  r->errors = (discrepancy){0.3, 0.3, 0.3, 1.7}; /* the transient is somewhere else */
  assert_int_equal(judged(m), 0);
  assert_int_equal(m->g.n, 5);
  assert_string_equal(find(m, 0, "waveform")->against, "orbit");
  r->orbit_errors.amplitude = 2e-3; /* its limit: 1e-3 */
  assert_int_equal(judged(m), 1);
  assert_true(find(m, 0, "amplitude")->found == 2e-3);
  r->orbit_errors.amplitude = 1e-4, r->orbit_errors.waveform = 6e-3; /* its limit: 5e-3 */
  assert_int_equal(judged(m), 1);
  r->orbit_errors.waveform = 1e-4, r->orbit_errors.mean = 1;
  assert_int_equal(judged(m), 1);
  r->orbit.free_sliders = 1; /* means are not compared then; the transient's sliders have no say in it */
  assert_int_equal(judged(m), 0);
  r->orbit.free_sliders = 0, r->transient.free_sliders = 1;
  assert_int_equal(judged(m), 1);
  r->orbit_errors.mean = 1e-4;
  r->orbit_status = HC_NOT_CONVERGED;
  assert_int_equal(judged(m), 3);
  assert_non_null(strstr(find(m, 0, "orbit")->reason, hc_status_text(HC_NOT_CONVERGED)));
  end(m);
}

static void a_transient_of_its_own_fails_in_words(CHECK_STATE)
{
  static const struct {
    verdict v;
    hc_status st;
    int k;
    const char *words;
  } all[] = {{VERDICT_PERIOD_K, HC_OK, 2, "repeats only after 2 forcing periods"},
             {VERDICT_APERIODIC, HC_APERIODIC, 0, "never repeats"},
             {VERDICT_OTHER_BRANCH, HC_OK, 1, "no HBM solution at this omega is within the limits"},
             {VERDICT_UNSTABLE, HC_OK, 1, "no HBM solution at this omega is within the limits"}};
  for (int i = 0; i < 4; ++i) {
    made *m = start(1);
    m->rows[0].verdict = all[i].v, m->rows[0].accounted = false;
    m->rows[0].transient_status = all[i].st, m->rows[0].transient.period_multiple = all[i].k;
    m->rows[0].errors.amplitude = 0.3;
    assert_int_equal(judged(m), 1);
    assert_int_equal(m->g.failures, 1);
    assert_non_null(strstr(find(m, 0, "transient")->reason, all[i].words));
    end(m);
  }
}

/* Wider limits in a range account for a transient too, if that is where another solution's transient runs. */
static void what_could_not_be_compared_is_an_error(CHECK_STATE)
{
  made *m = start(2);
  m->rows[0].verdict = VERDICT_NOT_SETTLED, m->rows[0].transient_status = HC_NOT_SETTLED;
  assert_int_equal(judged(m), 3);
  m->rows[0].verdict = VERDICT_SOLVER_FAILED, m->rows[0].hbm_status = HC_STALLED, m->rows[0].branch = -1;
  assert_int_equal(judged(m), 3);
  assert_non_null(strstr(find(m, -1, "solution")->reason, hc_status_text(HC_STALLED)));
  m->rows[1].errors.mean = 1; /* a failure goes before an error */
  assert_int_equal(judged(m), 1);
  assert_true(m->g.failures == 1 && m->g.errors == 1);
  end(m);
  m = start(0);
  assert_int_equal(judged(m), 3);
  end(m);
  m = start(1);
  m->c.curve.end = HC_STEP_TOO_SMALL, m->c.curve.n = 1, m->c.curve.ends_at = 9.25;
  assert_int_equal(judged(m), 3);
  assert_non_null(strstr(find(m, -1, "curve")->reason, "9.25"));
  end(m);
}

/* The JUnit file of a case; to be freed. */
static char *junit(const gate_case *g)
{
  char *text = NULL;
  size_t size;
  FILE *to = open_memstream(&text, &size);
  assert_int_equal(gate_write_junit(1, g, to), HC_OK);
  fclose(to);
  return text;
}

/* Two responses of one solution, the second off; then one that hardly moves, of which there is nothing to hold. */
static void each_response_is_held_by_itself(CHECK_STATE)
{
  static const char names[][RESPONSE_NAME] = {"tip", "a<b"};
  made *m = start(2);
  m->rows[1].branch = 0, m->rows[1].response = 1;
  m->rows[1].errors.amplitude = 2e-3;
  assert_int_equal(judged(m), 1);
  assert_int_equal(m->g.n, 8);
  assert_int_equal(m->g.failures, 1);
  assert_null(gate_response(&m->g, &m->g.checks[4]));
  m->g.responses = names;
  assert_string_equal(gate_response(&m->g, &m->g.checks[0]), "tip");
  assert_string_equal(gate_response(&m->g, &m->g.checks[4]), "a<b");
  char *text = junit(&m->g);
  assert_non_null(strstr(text, "name=\"omega 7 branch 0 response a&lt;b: amplitude\">\n      <failure"));
  free(text);
  m->rows[1].still = true;
  m->rows[1].errors = (discrepancy){NAN, NAN, NAN, NAN};
  assert_int_equal(judged(m), 0);
  assert_int_equal(m->g.not_applicable, 4);
  end(m);
}

static void costs_are_whole_numbers_with_limits(CHECK_STATE)
{
  made *m = start(1);
  m->c.summary.iterations = 2000000, m->c.summary.evaluations = 500;
  assert_int_equal(judged(m), 0);
  assert_int_equal(m->g.n, 4); /* no limit, no check */
  m->sc.gate.iterations = 2000000, m->sc.gate.evaluations = 500;
  assert_int_equal(judged(m), 0);
  ++m->c.summary.iterations; /* one in two million is no rounding */
  assert_int_equal(judged(m), 1);
  assert_true(find(m, -1, "iterations")->result == GATE_FAIL && find(m, -1, "evaluations")->result == GATE_PASS);
  ++m->c.summary.evaluations;
  judged(m);
  assert_int_equal(m->g.failures, 2);
  end(m);
}

static void one_check_of_a_quantity_is_the_worst(CHECK_STATE)
{
  made *m = start(3);
  m->rows[1].errors.amplitude = 5e-4;
  m->rows[2].errors.waveform = 2e-3;
  judged(m);
  int worst = 0;
  for (int i = 0; i < m->g.n; ++i) worst += gate_is_worst(&m->g, i);
  assert_int_equal(worst, 4);
  assert_true(gate_is_worst(&m->g, (int)(find(m, 1, "amplitude") - m->g.checks)));
  assert_true(gate_is_worst(&m->g, (int)(find(m, 2, "waveform") - m->g.checks)));
  assert_true(gate_is_worst(&m->g, (int)(find(m, 0, "mean") - m->g.checks))); /* of equals the first */
  for (int i = 0; i < 3; ++i) m->rows[i].errors.mean = (i + 1) * 1e-16;
  judged(m);
  assert_true(gate_is_worst(&m->g, (int)(find(m, 0, "mean") - m->g.checks))); /* and noise is equal */
  end(m);
}

static void junit_escapes_what_it_is_given(CHECK_STATE)
{
  made *m = start(1);
  judged(m);
  m->g.name = "a&b<c>\"d'\n\x01\xFF\xEF\xBF\xBF.yaml";
  char *text = junit(&m->g);
  assert_non_null(strstr(
      text,
      "<testsuite name=\"a&amp;b&lt;c&gt;&quot;d'  \xEF\xBF\xBD .yaml\" tests=\"4\" failures=\"0\" errors=\"0\""));
  free(text);
  end(m);
}

/* Settings that no case file can hold, so that harmonic balance cannot even begin. */
static void a_comparison_that_cannot_begin_is_an_error(CHECK_STATE)
{
  scene sc = scene_oscillator(1, 1, 1, 1);
  sc.omega_from = 1;
  sc.omega_to = 2;
  sc.hbm.harmonics = HBM_MAX_HARMONICS + 1;
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  CHECK_FILLED(gate_case, g, gate_run("no.yaml", &setup, NULL, &g));
  char *text = junit(&g);
  assert_int_equal(gate_exit_code(1, &g), 3);
  assert_non_null(strstr(text, "<error message=\"it could not be made: an argument is outside its documented range\" "
                               "type=\"comparison\">"));
  free(text);
  gate_clear(&g);
  scene_setup_clear(&setup);
}

/* What a verdict asks: all four within their limits, where they are equal, too; the mean has none where it is free. */
static void limits_hold_for_every_quantity(CHECK_STATE)
{
  const gate_limits l = {.most = {1, 2, 3, 4}};
  for (int i = -1; i < 4; ++i)
    for (int free = 0; free < 2; ++free)
      for (int nan = 0; nan < 2; ++nan) {
        discrepancy d = l.most;
        double *of[] = {&d.amplitude, &d.harmonic_1, &d.mean, &d.waveform};
        if (i >= 0) *of[i] = nan ? NAN : 1.001 * *of[i];
        assert_int_equal(gate_limits_hold(&l, 7, &d, free), i < 0 || (i == 2 && free));
      }
}

CHECK_TESTS("gate.judge", 60, every_quantity_has_its_limit, limits_hold_for_every_quantity,
            rounding_at_the_limit_decides_nothing, limits_may_differ_in_ranges,
            an_unstable_solution_is_held_against_its_orbit, a_transient_of_its_own_fails_in_words,
            what_could_not_be_compared_is_an_error, each_response_is_held_by_itself,
            costs_are_whole_numbers_with_limits, one_check_of_a_quantity_is_the_worst, junit_escapes_what_it_is_given,
            a_comparison_that_cannot_begin_is_an_error)
