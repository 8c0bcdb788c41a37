/* test_survey.c - the motions that starts come to: those of case 2 that other programs know (AUTO-07p, closed
 * forms), families, mirror images, a solution beside the curve, and that threads change nothing. */
#include "compare/survey.h"

#include <float.h>

#include "compare/gate_limits.h"
#include "compare/survey_starts.h"
#include "tests/case_scene.h"
#include "tests/scene_runs.h"
#include "timeint/timeint.h"

/* What a survey of one frequency found, with the solutions that HBM has there. */
typedef struct surveyed {
  survey found;
  hbm_curve at;
  int first_branch;
  hc_status status;
} surveyed;

static surveyed run(const scene *sc, double omega, int starts, int jobs, const hc_monitor *monitor)
{
  surveyed s = {0};
  compare_setup setup;
  response_curve response;
  const number_list asked = {.n = 1, .v = {omega}};
  assert_int_equal(scene_setup(sc, &setup), HC_OK);
  assert_int_equal(response_trace(&setup, &asked, NULL, &response), HC_OK);
  s.first_branch = survey_first_branch(&response.curve);
  const survey_settings how = {starts, SURVEY_SEED, jobs, s.first_branch};
  assert_int_equal(hbm_curve_at(response.hbm, &response.curve, omega, &s.at), HC_OK);
  s.status = survey_at(&setup, response.hbm, &s.at, omega, &how, monitor, &s.found);
  response_curve_free(&response);
  scene_setup_clear(&setup);
  return s;
}

static void clear(surveyed *s)
{
  survey_clear(&s->found);
  hbm_curve_free(&s->at);
}

/* Motions, each by its first response: "settled period_3", by falling share. */
static const char *verdicts(const survey *s, char text[256])
{
  char one[24];
  *text = 0;
  for (int i = 0; i < s->n_rows; ++i)
    if (s->rows[i].steady.response == 0)
      sprintf(text + strlen(text), "%s%s", i ? " " : "", steady_verdict_text(&s->rows[i].steady, one));
  return text;
}

static const survey_row *row_of(const survey *s, const char *name)
{
  char text[24];
  for (int i = 0; i < s->n_rows; ++i)
    if (strcmp(steady_verdict_text(&s->rows[i].steady, text), name) == 0) return &s->rows[i];
  fail_msg("no motion is %s", name);
  return NULL;
}

/* Every start is counted once, the largest share comes first, and the range of amplitudes holds the motion's. */
static void check_shares(const surveyed *s, int starts)
{
  double share = 0;
  int n = 0;
  assert_int_equal(s->status, HC_OK);
  for (int i = 0; i < s->found.n_rows; ++i) {
    const survey_row *r = &s->found.rows[i];
    assert_int_equal(r->motion, i);
    assert_true(i == 0 || r->starts <= r[-1].starts);
    assert_true(r->amplitude_low <= r->steady.result.amplitude && r->steady.result.amplitude <= r->amplitude_high);
    share += r->share;
    n += r->starts;
  }
  assert_int_equal(n, starts);
  for (int i = 0; i < s->found.n_rows && s->found.n_starts; ++i)
    for (int k = 0; k < s->found.n_starts; ++k) n -= s->found.starts[k].motion == i;
  assert_int_equal(n, s->found.n_starts ? 0 : starts);
  CHECK_NEAR(share, 1, s->found.n_rows * DBL_EPSILON, "sum of %d shares", s->found.n_rows);
}

/* Period 4 at 5.11, reached by sweeping up, and period 3 beside it; aperiodic at 5.2. All phases of a motion of k
 * periods are one row. */
static void sub_harmonics_of_case_2(CHECK_STATE)
{
  const scene sc = case_scene("paper/case2", 0, NULL);
  char text[256];
  surveyed s = run(&sc, 5.11, SURVEY_STARTS, 2, NULL);
  assert_string_equal(verdicts(&s.found, text), "period_3 period_4");
  check_shares(&s, SURVEY_STARTS);
  assert_int_equal(s.found.beside.n, 0);
  assert_int_equal(survey_others(&s.found, 0), 2);
  clear(&s);
  s = run(&sc, 5.2, SURVEY_STARTS, 2, NULL);
  row_of(&s.found, "aperiodic");
  check_shares(&s, SURVEY_STARTS);
  clear(&s);
}

/* Where they began, not where they ended: at rest the first one; a start on the orbit of a solution comes to it. */
static void starts_are_kept(CHECK_STATE)
{
  const scene sc = case_scene("paper/case2", 0, NULL), pair = case_scene("bands/bilinear_pair", 0, NULL);
  const double w = 9, re = 40 - w * w, im = 0.4 * w, size = 100 / (re * re + im * im);
  surveyed s = run(&sc, w, 40, 2, NULL), of_two = run(&pair, 2.473, 4, 1, NULL);
  int at_rest = 0, on_orbit = 0;
  assert_int_equal(s.found.n_starts, 40);
  for (int i = 0; i < s.found.n_starts; ++i) {
    const survey_start *b = &s.found.starts[i];
    assert_true(b->omega == w && b->motion >= 0 && b->motion < s.found.n_rows);
    at_rest += b->x == 0 && b->v == 0;
    /* x = Re(X e^{i w t}), X = F/(K - M w^2 + i C w), which never touches */
    if (!(fabs(b->x - size * re) <= 1e-8 && fabs(b->v - w * size * im) <= 1e-8)) continue;
    CHECK_NEAR(s.found.rows[b->motion].steady.result.amplitude, 100 / hypot(re, im), 1e-8, "amplitude");
    ++on_orbit;
  }
  assert_int_equal(at_rest, 1);
  assert_int_equal(on_orbit, 1);
  assert_int_equal(of_two.found.n_starts, 0);
  clear(&s);
  clear(&of_two);
}

/* Two stable branches from the grazing turn 7.337183 to the fold 9.2098, one outside. The lower one never touches:
 * A = F/|K - M w^2 + i C w|, to the tolerance of the transient, 1e-9 (and rounding). Each runs on its HBM solution. */
static void two_branches_of_case_2(CHECK_STATE)
{
  static const double omega[] = {7.3, 7.4, 8, 9, 9.3};
  const scene sc = case_scene("paper/case2", 0, NULL);
  for (int i = 0; i < 5; ++i) {
    const double w = omega[i], free = 100 / hypot(40 - w * w, 0.4 * w);
    surveyed s = run(&sc, w, 100, 2, NULL);
    check_shares(&s, 100);
    assert_int_equal(s.found.n_rows, w > 7.337183 && w < 9.2098 ? 2 : 1);
    bool separated = false;
    for (int k = 0; k < s.found.n_rows; ++k) {
      const survey_row *r = &s.found.rows[k];
      assert_int_equal(r->steady.status, HC_OK);
      assert_true(r->hbm_branch >= 0);
      separated |= fabs(r->steady.result.amplitude - free) <= 2e-9 * free;
    }
    assert_int_equal(separated, w > 7.337183);
    assert_int_equal(survey_others(&s.found, 0), 0);
    clear(&s);
  }
}

static void threads_change_nothing(CHECK_STATE)
{
  const scene sc = case_scene("paper/case2", 0, NULL);
  surveyed one = run(&sc, 9, 60, 1, NULL), three = run(&sc, 9, 60, 3, NULL);
  assert_int_equal(one.found.n_rows, three.found.n_rows);
  for (int i = 0; i < one.found.n_rows; ++i) {
    const survey_row *a = &one.found.rows[i], *b = &three.found.rows[i];
    assert_true(a->starts == b->starts && a->hbm_branch == b->hbm_branch && a->hbm_error == b->hbm_error);
    assert_true(a->amplitude_low == b->amplitude_low && a->amplitude_high == b->amplitude_high);
    assert_memory_equal(a->steady.result.wave, b->steady.result.wave, sizeof a->steady.result.wave);
  }
  clear(&one);
  clear(&three);
}

/* A Jenkins element that sticks under a constant load: every start ends with its slider elsewhere, and with it the
 * mean; the amplitude is F/|K + kt - M w^2 + i C w| in each, within the tolerance 1e-9. One family has all starts. */
static void a_family_is_one_motion(CHECK_STATE)
{
  const double w = 5;
  scene sc = scene_oscillator(1, 0.4, 40, 20);
  compare_setup setup;
  scene_add_contact(&sc, (scene_contact){.law = {.kt = 100, .mu = 1}, .preload = 30});
  const scene of_case = case_scene("paper/case2", 0, NULL); /* settings */
  sc.hbm = of_case.hbm, sc.transient = of_case.transient, sc.compare = of_case.compare, sc.gate = of_case.gate;
  sc.omega_from = 4, sc.omega_to = 6;
  assert_int_equal(scene_setup(&sc, &setup), HC_OK);
  survey s = {0};
  const survey_settings how = {50, SURVEY_SEED, 2, 0};
  assert_int_equal(survey_at(&setup, NULL, &(hbm_curve){0}, w, &how, NULL, &s), HC_OK);
  const double stuck = 20 / hypot(140 - w * w, 0.4 * w);
  assert_int_equal(s.n_rows, 1);
  assert_int_equal(s.rows[0].steady.result.free_sliders, 1);
  assert_int_equal(s.rows[0].starts, 50);
  assert_int_equal(s.rows[0].hbm_branch, -1);
  CHECK_NEAR(s.rows[0].amplitude_low, stuck, 2e-9 * stuck, "least of the family");
  CHECK_NEAR(s.rows[0].amplitude_high, stuck, 2e-9 * stuck, "largest of the family");
  survey_clear(&s);
  scene_setup_clear(&setup);
}

/* At 16 two motions exist. Of the sweep 15.8 to 16.2 the curve has the lower one, from both ends; the other is handed
 * to HBM, and what that finds is the solution of the whole sweep's curve, which passes it behind the fold: the same
 * equations, solved to hbm.tolerance 1e-10, next to no fold. */
static void a_solution_beside_the_curve(CHECK_STATE)
{
  static const char *const narrow[] = {"sweep.omega=[15.8, 16.2]"};
  const scene whole = case_scene("adversarial/isolated", 0, NULL), sc = case_scene("adversarial/isolated", 1, narrow);
  surveyed known = run(&whole, 16, 1, 1, NULL), s = run(&sc, 16, 60, 2, NULL);
  assert_int_equal(known.at.n, 3);
  assert_int_equal(s.at.n, 1);
  check_shares(&s, 60);
  assert_int_equal(s.found.n_rows, 2);
  assert_int_equal(s.found.beside.n, 1);
  const survey_row *upper = s.found.rows[0].steady.result.amplitude > 1 ? &s.found.rows[0] : &s.found.rows[1];
  assert_int_equal(upper->hbm_branch, s.first_branch);
  CHECK_LE(upper->hbm_error, 5e-3, "the gate's waveform");
  hbm_curve all = {0};
  assert_int_equal(survey_append_beside(&s.found, 0, &all), HC_OK);
  assert_int_equal(all.n, 1);
  const double *X = hbm_curve_X(&known.at, 2), *Y = hbm_curve_X(&all, 0);
  CHECK_LE(distance_2(known.at.n_coef, X, Y), 1e-8 * norm_2(known.at.n_coef, X), "of the two solutions");
  hbm_curve_free(&all);
  clear(&known);
  clear(&s);
}

/* Motions that fly onto a contact like a wall, of 4e9: with damping they stay bounded, however large they began. */
static void a_large_start_is_no_escape(CHECK_STATE)
{
  const scene sc = case_scene("adversarial/hard", 0, NULL);
  surveyed s = run(&sc, 6.5, 60, 2, NULL);
  check_shares(&s, 60);
  for (int i = 0; i < s.found.n_rows; ++i) assert_int_equal(s.found.rows[i].steady.status, HC_OK);
  clear(&s);
}

/* An isola: the curve of the whole sweep is linear there, A = F/|K - M w^2 + i C w|; the other motion of one period
 * touches the stops, and HBM has it, too, within the gate. Nearly half of the starts end there: not one of 60 does so
 * with a probability of 0.6^60 = 5e-14. Outside 3.4 to 3.8 there is none. */
static void a_solution_on_an_isola(CHECK_STATE)
{
  const scene sc = case_scene("adversarial/isola", 0, NULL);
  for (int k = 0; k < 2; ++k) {
    const double w = k ? 3.3 : 3.6, free = 200 / hypot(40 - w * w, 0.4 * w);
    surveyed s = run(&sc, w, 60, 2, NULL);
    check_shares(&s, 60);
    assert_int_equal(s.at.n, 1);
    assert_int_equal(s.found.n_rows, k ? 1 : 2);
    assert_int_equal(s.found.beside.n, k ? 0 : 1);
    for (int i = 0; i < s.found.n_rows; ++i) {
      const survey_row *r = &s.found.rows[i];
      const bool isola = fabs(r->steady.result.amplitude - free) > 2e-9 * free;
      assert_int_equal(r->hbm_branch, isola ? s.first_branch : 0);
      assert_int_equal(r->steady.result.regime, isola ? CONTACT_SEPARATES : CONTACT_LINEAR);
      CHECK_LE(r->hbm_error, 5e-3, "the gate's waveform");
    }
    clear(&s);
  }
}

/* The same mass as the second of two: harmonic balance solves for other coordinates than the degrees of freedom. */
static void a_solution_on_an_isola_of_a_structure(CHECK_STATE)
{
  static const char text[] =
      "structure: {mass: [1, 1], damping: [1, 0.4], stiffness: [300, 40]}\n"
      "forcing: [{dof: 2, amplitude: 200}]\n"
      "contacts:\n"
      "  - {tangential_stiffness: 3, normal_stiffness: 180, friction: 0.1, gap: -8, tangent: {2: 0.5},\n"
      "     normal: {2: 0.8660254037844386}}\n"
      "  - {tangential_stiffness: 350, normal_stiffness: 1400, friction: 0.1, gap: -8, tangent: {2: 0.5},\n"
      "     normal: {2: -0.8660254037844386}}\n"
      "response: [2]\nsweep: {omega: [1, 30]}\nhbm: {harmonics: 40}\n";
  case_error err;
  CHECK_FILLED(scene, sc, case_parse("case", text, strlen(text), 0, NULL, &sc, &err));
  surveyed s = run(&sc, 3.6, 60, 2, NULL);
  assert_int_equal(s.found.beside.n, 1);
  bool found = false;
  for (int i = 0; i < s.found.n_rows; ++i) found |= s.found.rows[i].hbm_branch == s.first_branch;
  assert_true(found);
  clear(&s);
  case_clear(&sc);
}

/* The comparison with a survey has a row of the isola's solution, and says of each that there is one motion
 * elsewhere. */
static void a_comparison_lists_the_isola(CHECK_STATE)
{
  scene sc = case_scene("adversarial/isola", 0, NULL);
  compare_setup setup;
  comparison c;
  sc.compare.omega = (number_list){.n = 1, .v = {3.6}};
  assert_int_equal(scene_setup(&sc, &setup), HC_OK);
  for (int starts = 0; starts <= 40; starts += 40) {
    setup.survey = starts;
    assert_int_equal(comparison_run(&setup, NULL, &c), HC_OK);
    assert_int_equal(c.n_rows, starts ? 2 : 1);
    for (int i = 0; i < c.n_rows; ++i) {
      assert_true(comparison_agrees(&c.rows[i]));
      assert_int_equal(c.rows[i].others, starts ? 1 : -1);
    }
    comparison_clear(&c);
  }
  scene_setup_clear(&setup);
}

/* Stopped: what was made is kept, with shares of that. */
static void a_stop_keeps_what_was_made(CHECK_STATE)
{
  const scene sc = case_scene("paper/case2", 0, NULL);
  int left = 300; /* ticks: one a period */
  surveyed s = run(&sc, 9, 10000, 1, &(hc_monitor){check_stop, &left});
  assert_int_equal(s.status, HC_INTERRUPTED);
  assert_true(s.found.n_rows > 0);
  double share = 0;
  for (int i = 0; i < s.found.n_rows; ++i) share += s.found.rows[i].share;
  CHECK_NEAR(share, 1, s.found.n_rows * DBL_EPSILON, "sum");
  clear(&s);
}

/* Sliders lie within what friction allows; draws differ by the seed, are the same for the same one, and begin at rest.
 */
static void starts_are_admissible(CHECK_STATE)
{
  const scene sc = case_scene("paper/case2", 0, NULL);
  const double rest[3] = {0}, c = sqrt(0.5);
  double y[3], z[3], largest = 0;
  compare_setup setup;
  assert_int_equal(scene_setup(&sc, &setup), HC_OK);
  CHECK_MADE(survey_starts, s, survey_starts_new(setup.model, 16, rest, 1000, 1, &s));
  CHECK_MADE(survey_starts, other, survey_starts_new(setup.model, 16, rest, 1000, 2, &other));
  survey_starts_draw(s, 0, y);
  assert_true(is_zero(3, y));
  for (int i = 1; i < 1000; ++i) {
    survey_starts_draw(s, i, y);
    survey_starts_draw(other, i, z);
    assert_true(y[TIMEINT_X] != z[TIMEINT_X] && y[TIMEINT_V] != z[TIMEINT_V]);
    const double N = fmax(1000 * (c * y[TIMEINT_X] - 5), 0), T = 100 * (c * y[TIMEINT_X] - y[TIMEINT_W]);
    CHECK_LE(fabs(T), 0.3 * N + 1e-12 * fabs(100 * c * y[TIMEINT_X]), "start %d", i);
    largest = fmax(largest, fabs(y[TIMEINT_V]));
  }
  /* v_rms <= F_rms/C: a peak of 250 of what the load keeps up; the draw comes to within a few percent of that */
  CHECK_LE(largest, 100 / 0.4, "largest velocity");
  CHECK_LE(0.8 * 100 / 0.4, largest, "largest velocity");
  survey_starts_free(s);
  survey_starts_free(other);
  scene_setup_clear(&setup);
}

CHECK_TESTS("compare.survey", 60, sub_harmonics_of_case_2, starts_are_kept, two_branches_of_case_2,
            threads_change_nothing, a_family_is_one_motion, a_solution_beside_the_curve, a_solution_on_an_isola,
            a_solution_on_an_isola_of_a_structure, a_comparison_lists_the_isola, a_large_start_is_no_escape,
            a_stop_keeps_what_was_made, starts_are_admissible)
