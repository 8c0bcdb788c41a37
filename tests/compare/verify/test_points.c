/* test_points.c - what points tell by themselves: noise, outliers, and branches; on curves of our own harmonic balance,
 * spoiled here. And the solutions that they are held against. */
#include "compare/verify/truth/solutions.h"
#include "compare/verify/truth/truth.h"
#include "numerics/random.h"
#include "tests/compare/verify/curves.h"
#include "tests/scene_runs.h"

static const char case2[] = "cases/paper/case2.yaml";
enum { POINTS = 61 };

/* A right curve of case 2, as swept upwards. */
static verify_data right_curve(const scene *sc)
{
  const spoiling how = {.harmonics = 20};
  return curve_make(sc, &how, 4, 14, POINTS);
}

/* Normal noise of this standard deviation: the sum of 12 uniform numbers of variance 1/12. */
static void add_noise(verify_data *d, double sigma)
{
  uint64_t seed = 7;
  for (int i = 0; i < d->n; ++i) {
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += random_unit(&seed);
    d->points[i].value *= 1 + sigma * sum;
  }
}

static verify_report judged(const scene *sc, const verify_data *d, const char *cause, int code)
{
  char words[VERIFY_TEXT];
  CHECK_FILLED(verify_report, r, scene_verify_run(sc, d, NULL, &r));
  if (strcmp(verify_cause_words(r.causes, words), cause))
    fail_msg("%s, expected %s", verify_sentence(&r, words), cause);
  assert_int_equal(verify_exit_code(&r), code);
  return r;
}

/* Noise that was not said is a remark, after everything else was tried. A standard deviation estimated from n = 59
 * second differences of 61 points: by the median of moduli its relative deviation is 1.17/sqrt(n) for independent ones,
 * here at most 3 times the variance as each point is in three: 26 %, and 3 of them are allowed. */
static void noise_is_remarked_and_estimated(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  for (double sigma = check_long ? 3e-3 : 9e-3; sigma < (check_long ? 0.1 : 2e-2); sigma *= 3) {
    verify_data d = right_curve(&sc);
    add_noise(&d, sigma);
    verify_report r = judged(&sc, &d, "none", 1);
    char text[VERIFY_TEXT];
    CHECK_NEAR(r.noise / sigma, 1, 0.78, "sigma = %g", sigma);
    assert_string_equal(verify_cause_words(r.nearest_guess, text), "noise");
    assert_non_null(strstr(verify_sentence(&r, text), "from one to the next). Measured, or computed?"));
    verify_clear(&r);
    verify_data_clear(&d);
  }
}

/* With the noise said the curve is right; with a tenth of it, not. */
static void noise_that_is_said_is_allowed(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  verify_data d = right_curve(&sc);
  add_noise(&d, 1e-2);
  d.noise = 1e-2;
  verify_report r = judged(&sc, &d, "none", 0);
  verify_clear(&r);
  d.noise = 1e-3;
  r = judged(&sc, &d, "noise", 1);
  verify_clear(&r);
  verify_data_clear(&d);
}

/* 3 % too high at every point is within four standard deviations of 1 %, but not on the average of 25. */
static void noise_does_not_hide_an_offset(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  verify_data d = right_curve(&sc);
  add_noise(&d, 1e-2);
  for (int i = 0; i < d.n; ++i) d.points[i].value *= 1.03;
  d.noise = 1e-2;
  CHECK_FILLED(verify_report, r, scene_verify_run(&sc, &d, NULL, &r));
  assert_false(verify_has(r.causes, CAUSE_NOISE));
  assert_true(r.count[VERDICT_DIFFERS] > POINTS / 2);
  assert_int_equal(verify_exit_code(&r), 1);
  verify_clear(&r);
  verify_data_clear(&d);
}

static void outliers_are_named(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  char text[VERIFY_TEXT];
  verify_data d = right_curve(&sc);
  d.points[20].value *= 1.3;
  verify_report r = judged(&sc, &d, "outlier", 1);
  assert_int_equal(r.count[VERDICT_DIFFERS], 1);
  assert_non_null(strstr(verify_sentence(&r, text), "(line 21: 30 % off)"));
  verify_clear(&r);
  d.points[50].value *= 0.5; /* 10, 31 and 51 too: four of 61 */
  d.points[9].value *= 1.1;
  d.points[30].value *= 1.2;
  r = judged(&sc, &d, "outlier", 1);
  assert_non_null(strstr(verify_sentence(&r, text), "line 31: 20 % off, ...)"));
  verify_clear(&r);
  d.points[31].value *= 1.2; /* two beside each other are no outliers */
  assert_int_equal(scene_verify_run(&sc, &d, NULL, &r), HC_OK);
  assert_false(verify_has(r.causes, CAUSE_OUTLIER));
  verify_clear(&r);
  verify_data_clear(&d);
}

/* Newton ended early at seven of 61 points, some beside each other: too many for outliers, and the others are right. At
 * all points, by 10 to 90 % and by chance, nothing is right, and no measured curve scatters so. */
static void points_without_convergence_are_named(CHECK_STATE)
{
  static const int early[] = {10, 11, 20, 30, 31, 40, 50};
  const scene sc = curve_scene(case2);
  char text[VERIFY_TEXT];
  uint64_t seed = 3;
  verify_data d = right_curve(&sc);
  for (size_t i = 0; i < sizeof early / sizeof *early; ++i) d.points[early[i]].value *= i % 2 ? 0.6 : 1.5;
  verify_report r = judged(&sc, &d, "not_converged", 1);
  assert_int_equal(r.count[VERDICT_DIFFERS], 7);
  assert_non_null(strstr(verify_sentence(&r, text), "(line 11: "));
  verify_clear(&r);
  for (int i = 0; i < d.n; ++i)
    d.points[i].value *= 1 + (random_unit(&seed) < 0.5 ? -1 : 1) * (0.1 + 0.8 * random_unit(&seed));
  r = judged(&sc, &d, "not_converged", 1);
  verify_clear(&r);
  verify_data_clear(&d);
}

/* Between every two points that were computed one on their chord, a third of the way. */
static void points_on_chords_are_named(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  verify_data d = right_curve(&sc);
  int n = 0;
  for (int i = 0; i + 3 < d.n; i += 3) {
    const verify_point a = d.points[i], b = d.points[i + 1], c = d.points[i + 3];
    const double part = (b.omega - a.omega) / (c.omega - a.omega);
    d.points[n++] = a;
    d.points[n++] = (verify_point){b.omega, a.value + part * (c.value - a.value), b.line};
  }
  d.n = n;
  verify_report r = judged(&sc, &d, "interpolated", 1);
  verify_clear(&r);
  verify_data_clear(&d);
}

/* What does not move lies on every chord, and was not interpolated; a straight line beside a bent truth was. */
static void no_motion_is_no_chord(CHECK_STATE)
{
  enum { ROWS = 9 };
  verify_row rows[ROWS];
  const verify_report r = {.rows = rows, .n_rows = ROWS, .gate = 1e-3};
  for (int moving = 0; moving < 2; ++moving) {
    for (int i = 0; i < ROWS; ++i)
      rows[i] = (verify_row){.omega = 1 + i,
                             .value = moving * (2.0 + i),
                             .nearest = 1 + 0.1 * i * i,
                             .scale = 1,
                             .error = 1,
                             .verdict = VERDICT_DIFFERS};
    assert_int_equal(points_interpolated(&r), moving ? VERIFY_BIT(CAUSE_INTERPOLATED) : 0);
  }
}

/* A little off is no outlier, and few points tell nothing. */
static void a_little_off_is_no_outlier(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  verify_data d = right_curve(&sc);
  d.points[20].value *= 1.01;
  verify_report r = judged(&sc, &d, "none", 1);
  verify_clear(&r);
  verify_data_clear(&d);
}

/* In [5.12, 5.55] case 2 has an unstable solution and no other. */
static void nothing_but_unstable_points_fail(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  const spoiling how = {.harmonics = 20};
  verify_data d = curve_make(&sc, &how, 5.12, 5.55, 11);
  verify_report r = judged(&sc, &d, "unstable_branch", 1);
  assert_int_equal(r.count[VERDICT_UNSTABLE], 11);
  verify_clear(&r);
  verify_data_clear(&d);
}

/* A right curve forth and back over the resonance, in steps that turn back again and again: no neighbours in the file
 * are neighbours in omega. */
static verify_data shuffled_curve(const scene *sc)
{
  verify_data d = right_curve(sc), shuffled = right_curve(sc);
  for (int i = 0; i < d.n; ++i) shuffled.points[i] = d.points[i * 17 % POINTS];
  verify_data_clear(&d);
  return shuffled;
}

static void the_order_of_the_points_does_not_matter(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  verify_data d = shuffled_curve(&sc);
  verify_report r = judged(&sc, &d, "none", 0);
  assert_true(r.reversals > VERIFY_USUAL_REVERSALS);
  verify_clear(&r);
  verify_data_clear(&d);
}

static void errors_smooth_in_omega_though_not_in_the_file_are_no_noise(CHECK_STATE)
{
  const scene sc = curve_scene(case2);
  verify_data d = shuffled_curve(&sc);
  for (int i = 0; i < d.n; ++i) d.points[i].value *= 1 + 0.05 * sin(3 * d.points[i].omega);
  verify_report r = judged(&sc, &d, "none", 1);
  verify_clear(&r);
  verify_data_clear(&d);
}

/* A, B, A: B hops if it is a branch, and its point has another solution. Between A and C, or at the end, none does. */
static void between_points_of_one_branch(CHECK_STATE)
{
  static const struct way {
    int branch[3], n; /* solutions */
    bool hops;
  } w[] = {{{0, 1, 0}, 2, true},    {{0, 1, 0}, 1, false}, {{0, -1, 0}, 2, false},
           {{-1, 1, -1}, 2, false}, {{0, 1, 2}, 2, false}, {{0, 1, 1}, 2, false}};
  for (size_t k = 0; k < sizeof w / sizeof *w; ++k) {
    verify_row rows[3];
    for (int i = 0; i < 3; ++i)
      rows[i] = (verify_row){.omega = i, .verdict = VERDICT_MATCH, .branch = w[k].branch[i], .solutions = w[k].n};
    verify_report r = {.rows = rows, .n_rows = 3};
    assert_int_equal(points_branches(&r), w[k].hops ? VERIFY_BIT(CAUSE_OTHER_BRANCH) : 0);
    assert_int_equal(rows[1].verdict, w[k].hops ? VERDICT_OTHER_BRANCH : VERDICT_MATCH);
  }
}

/* Sampled forces with many samples have a solution next to each that exact ones have: their error falls like N^-2, and
 * at N = 4096 it is far below the gate. Every solution is the start of one, not the first alone. */
static void every_exact_solution_leads_to_a_sampled_one(CHECK_STATE)
{
  enum { OMEGAS = 9 };
  const scene sc = curve_scene(case2);
  const verify_quantity amplitude = {.kind = KIND_AMPLITUDE};
  verify_equations e = {.keep_mean = true, .harmonics = 5, .factor = 1};
  const int first = 0;
  double omega[OMEGAS];
  const verify_places at = {.from = 4, .to = 14, .n = OMEGAS, .omega = omega, .n_responses = 1, .asked = &amplitude};
  int several = 0;
  for (int i = 0; i < OMEGAS; ++i) omega[i] = 6.2 + 0.5 * i;
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  CHECK_MADE(model, seen, verify_model_seen(setup.model, 1, &first, &seen));
  compare_setup own = setup;
  own.model = seen;
  CHECK_FILLED(verify_solutions, exact, verify_solutions_of(&own, &e, &at, NULL, &exact));
  e.samples = 4096;
  CHECK_FILLED(verify_solutions, sampled, verify_solutions_near(&own, &e, &exact, &at, &sampled));
  for (int i = 0; i < OMEGAS; ++i) {
    assert_int_equal(sampled.first[i + 1] - sampled.first[i], exact.first[i + 1] - exact.first[i]);
    several += exact.first[i + 1] - exact.first[i] > 1;
    for (int k = exact.first[i]; k < exact.first[i + 1]; ++k) {
      double least = INFINITY;
      for (int j = sampled.first[i]; j < sampled.first[i + 1]; ++j)
        least = fmin(least, fabs(sampled.of[j].q[0] / exact.of[k].q[0] - 1));
      CHECK_LE(least, 1e-3, "solution %d at omega = %g", k - exact.first[i], omega[i]);
    }
  }
  assert_true(several > 0);
  verify_solutions_clear(&exact);
  verify_solutions_clear(&sampled);
  model_free(seen);
  scene_setup_clear(&setup);
}

CHECK_TESTS_AND_LONG("verify.points", 300,
                     (between_points_of_one_branch, every_exact_solution_leads_to_a_sampled_one,
                      noise_is_remarked_and_estimated, noise_that_is_said_is_allowed, outliers_are_named,
                      points_without_convergence_are_named, points_on_chords_are_named, no_motion_is_no_chord,
                      a_little_off_is_no_outlier, nothing_but_unstable_points_fail,
                      the_order_of_the_points_does_not_matter),
                     (noise_is_remarked_and_estimated, noise_does_not_hide_an_offset,
                      errors_smooth_in_omega_though_not_in_the_file_are_no_noise))
