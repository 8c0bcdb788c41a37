/* test_search.c - what a search makes of points that are known to be right, and of what could not be computed: by
 * samples and solutions that are written down here, and by functions that keep solutions back. */
#include <string.h>

#include "compare/first_guess.h"
#include "compare/verify/search/search.h"
#include "tests/compare/verify/curves.h"
#include "tests/scene_runs.h"
#include "tests/wrap.h"

static double refused; /* [1] equations with this damping cannot be solved */

WRAP(hc_status, guided_hbm_solver_new, (const model *m, const hbm_settings *how, hbm_solver **out))
{
  *out = NULL;
  return refused > 0 && fabs(*m->damping / refused - 1) < 0.2 ? HC_STALLED : __real_guided_hbm_solver_new(m, how, out);
}

static bool hidden; /* unstable solutions are not found, and it is said that one is not */

WRAP(hc_status, hbm_curve_at, (hbm_solver * s, const hbm_curve *curve, double omega, hbm_curve *at))
{
  const int before = at->n;
  const hc_status st = __real_hbm_curve_at(s, curve, omega, at);
  if (!hidden || at->n != before + 3) return st;
  const size_t bytes = (size_t)at->n_coef * sizeof *at->X;
  memcpy(hbm_curve_X(at, before + 1), hbm_curve_X(at, before + 2), bytes);
  memcpy(hbm_curve_dX(at, before + 1), hbm_curve_dX(at, before + 2), bytes);
  at->points[before + 1] = at->points[before + 2];
  --at->n;
  return HC_STALLED;
}

/* Rows that match, 1 on the truth 1, and after them rows that differ, 2 beside the truth 1. */
enum { MATCH = 16, DIFFER = 6, ROWS = MATCH + DIFFER };

typedef struct made {
  verify_row row[ROWS];
  verify_data data;
  verify_report report;
  verify_sample sample;
  verify_solution of[ROWS];
  int first[ROWS + 1];
  verify_solutions solutions; /* one at each omega: the row's value; other readings have another */
} made;

static void make(made *m)
{
  *m = (made){.data = {.n = ROWS}};
  m->report = (verify_report){.n_rows = ROWS, .rows = m->row, .gate = 1e-3, .harmonics = 20};
  for (int i = 0; i < ROWS; ++i) {
    const double value = i < MATCH ? 1 : 2;
    m->row[i] = (verify_row){.omega = i + 1, .value = value, .nearest = 1, .scale = 1, .line = i};
    m->row[i].verdict = i < MATCH ? VERDICT_MATCH : VERDICT_DIFFERS;
    for (int q = 0; q < VERIFY_READINGS; ++q) m->of[i].q[q] = m->of[i].scale[q] = q ? 77 * value : value;
  }
}

static void sample(made *m)
{
  const verify_judged judged = {&m->data, &m->report, true};
  int n = 0;
  assert_int_equal(verify_sample_of(1, &judged, &m->sample), HC_OK);
  assert_int_equal(m->sample.n, ROWS);
  for (int i = 0; i < ROWS; ++i) m->first[i + 1] = n += m->of[i].q[0] > 0; /* 0: no solution there */
  for (int i = 0, k = 0; i < ROWS; ++i)
    if (m->of[i].q[0] > 0) m->of[k++] = m->of[i];
  m->solutions = (verify_solutions){.n = ROWS, .n_responses = 1, .first = m->first, .count = n, .of = m->of};
}

/* A search over the made points, to free. */
static search *search_of(made *m)
{
  search *s = calloc(1, sizeof *s);
  assert_non_null(s);
  sample(m);
  s->points = m->sample;
  s->out = &m->report;
  return s;
}

/* One of sixteen points that match, by half: what nine of ten are within is 0, and it counts all the same. By less than
 * a hundredth it may be another branch's. */
static void no_cause_takes_a_right_point_away(CHECK_STATE)
{
  made m;
  make(&m);
  sample(&m);
  assert_true(verify_read_plain(&m.sample, &m.solutions) == 0);
  m.of[3].q[0] = 2;
  CHECK_NEAR(verify_read_plain(&m.sample, &m.solutions), 0.5, 1e-15, "(2 - 1)/2");
  m.of[3].q[0] = 1.005;
  assert_true(verify_read_plain(&m.sample, &m.solutions) == 0);
  make(&m);
  m.of[3].q[0] = 0; /* not solved for */
  sample(&m);
  assert_true(verify_read_plain(&m.sample, &m.solutions) == 0);
}

/* The truth is what the rows were held against, curve or orbit. Rows that differ are 1 off 2; one is not known. */
static void the_truth_is_what_the_rows_have(CHECK_STATE)
{
  made m;
  make(&m);
  m.row[ROWS - 1].nearest = m.row[ROWS - 1].scale = NAN;
  m.row[ROWS - 1].verdict = VERDICT_SOLVER_FAILED;
  sample(&m);
  CHECK_NEAR(verify_truth_distance(&m.sample), 0.5, 1e-15, "(2 - 1)/2");
}

/* Solutions of a change that fit wherever they are, and are missing at one point that differs: it does not win, nor
 * lose unheard. */
static void missing_solutions_are_said(CHECK_STATE)
{
  static const verify_equations damped = {.change = CHANGE_DAMPING, .factor = 2, .keep_mean = true, .harmonics = 20};
  for (int missing = 0; missing < 2; ++missing) {
    made m;
    make(&m);
    if (missing) m.of[ROWS - 1].q[0] = 0;
    search *s = search_of(&m);
    search_read(s, &damped, 0, &m.solutions);
    assert_true(m.report.unsolved == (missing ? VERIFY_BIT(CAUSE_DAMPING) : 0));
    assert_true(m.report.n_hypotheses > 0 && (m.report.hypotheses[0].distance == 0) == !missing);
    free(s);
  }
}

/* Two sets of solutions that are the same where both have one. */
static void what_is_not_solved_is_not_far(CHECK_STATE)
{
  static made a, b;
  make(&a), make(&b);
  a.of[MATCH].q[0] = b.of[ROWS - 1].q[0] = 0;
  sample(&a), sample(&b);
  assert_true(verify_apart(&a.sample, &a.solutions, &b.solutions) == 0);
  b.of[MATCH + 1].q[0] = 4;
  a.sample.part = 1;
  CHECK_NEAR(verify_apart(&a.sample, &a.solutions, &b.solutions), 0.5, 1e-15, "(4 - 2)/4");
}

/* What does no better than the same equations without it is none. */
static void what_changes_nothing_is_no_hypothesis(CHECK_STATE)
{
  static const verify_equations damped = {.change = CHANGE_DAMPING, .factor = 2, .keep_mean = true, .harmonics = 1};
  for (int better = 0; better < 2; ++better) {
    made m;
    make(&m);
    search *s = search_of(&m);
    s->floor = 1e-4;
    s->orders[s->n_orders++] = (order){.harmonics = 1, .keep_mean = true};
    for (int k = 0; k < SEARCH_DISTANCES; ++k) s->orders[0].distance[0][k] = better ? 2e-4 : 1e-4;
    search_read(s, &damped, 0, &m.solutions);
    assert_int_equal(m.report.n_hypotheses > 0, better);
    free(s);
  }
}

/* A curve along the unstable branch of case 2, where the truth's solution is not found: that is no difference. */
static void what_was_not_found_is_no_difference(CHECK_STATE)
{
  const scene sc = curve_scene("cases/paper/case2.yaml");
  const spoiling how = {.harmonics = 20, .branch = -1};
  verify_data d = curve_make(&sc, &how, 7.6, 9, 4);
  for (int k = 0; k < 2; ++k) {
    hidden = k;
    CHECK_FILLED(verify_report, r, scene_verify_run(&sc, &d, NULL, &r));
    assert_int_equal(r.count[VERDICT_UNSTABLE], k ? 0 : 4);
    assert_int_equal(r.count[VERDICT_SOLVER_FAILED], k ? 4 : 0);
    verify_clear(&r);
  }
  hidden = false;
  verify_data_clear(&d);
}

static void twice_the_damping(scene *sc) { *sc->structure->damping.v *= 2; }

/* Twice the damping, which cannot be solved for: nothing else is named, and it is said that this was not judged. */
static void what_cannot_be_solved_is_said(CHECK_STATE)
{
  const scene sc = curve_scene("cases/paper/case2.yaml");
  const spoiling how = {.change = twice_the_damping};
  verify_data d = curve_make(&sc, &how, 4, 14, 9);
  for (int k = 0; k < 2; ++k) {
    refused = k ? 2 * *sc.structure->damping.v : 0;
    CHECK_FILLED(verify_report, r, scene_verify_run(&sc, &d, NULL, &r));
    assert_true(r.causes == (k ? 0 : VERIFY_BIT(CAUSE_DAMPING)));
    assert_int_equal(verify_has(r.unsolved, CAUSE_DAMPING), k);
    verify_clear(&r);
  }
  refused = 0;
  verify_data_clear(&d);
}

CHECK_TESTS("verify.search", 120, what_cannot_be_solved_is_said, no_cause_takes_a_right_point_away,
            the_truth_is_what_the_rows_have, missing_solutions_are_said, what_is_not_solved_is_not_far,
            what_changes_nothing_is_no_hypothesis, what_was_not_found_is_no_difference)
