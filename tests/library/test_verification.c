/* test_verification.c - another program's curve by the C API: verdicts, words; bad arrays; a monitor that stops. */
#include "compare/verify/verify.h"
#include "model/casefile/case_file.h"
#include "tests/library/case2.h"
#include "tests/library/same.h"

#define FOLDER SOURCE_DIR "/cases/verify/"

enum { MOST = 512 };
typedef struct curve {
  int n;
  double omega[MOST], value[MOST];
} curve;

/* The curve of a program that drops harmonic 0, as the file has it. */
static verify_data read_no_static(curve *c)
{
  char words[VERIFY_TEXT];
  CHECK_FILLED(verify_columns, columns, verify_columns_read("omega=1,harmonic_1=2", NULL, &columns, words));
  CHECK_FILLED(verify_data, data, verify_data_read(FOLDER "no_static.csv", &columns, &data, words));
  assert_in_range(data.n, 3, MOST);
  c->n = data.n;
  for (int i = 0; i < data.n; ++i) c->omega[i] = data.points[i].omega, c->value[i] = data.points[i].value;
  return data;
}

/* Numbers of what the command writes as its table of hypotheses; the first stands for the cause. */
static void check_hypotheses(const hbmcheck_verification *v, const verify_report *r)
{
  hbmcheck_hypothesis h;
  char cause[VERIFY_TEXT], quantity[VERIFY_QUANTITY_TEXT], words[VERIFY_TEXT];
  assert_int_equal(hbmcheck_verification_hypotheses(v), r->n_hypotheses);
  assert_true(r->n_hypotheses > 4);
  for (int k = 0; k < r->n_hypotheses; ++k) {
    const verify_hypothesis *inner = &r->hypotheses[k];
    assert_int_equal(hbmcheck_verification_hypothesis(v, k, &h), HBMCHECK_OK);
    SAME(PAIR(h.distance, inner->distance), PAIR(h.omega_factor, inner->omega_factor),
         PAIR(h.value_factor, inner->value_factor), PAIR(h.samples, inner->equations.samples));
    const bool linear = verify_equations_linear(&inner->equations); /* K alone, sliders stuck */
    assert_int_equal(h.harmonics, linear ? 0 : inner->equations.harmonics);
    assert_int_equal(h.keep_mean, !linear && inner->equations.keep_mean);
    assert_int_equal(hbmcheck_verification_hypothesis_text(v, k, cause, sizeof cause, quantity, sizeof quantity),
                     HBMCHECK_OK);
    assert_string_equal(cause, verify_cause_words(inner->causes, words));
    assert_string_equal(quantity, verify_quantity_name(&inner->quantity, words));
  }
  assert_int_equal(hbmcheck_verification_hypothesis_text(v, 0, cause, 5, NULL, 0), HBMCHECK_OK);
  assert_string_equal(cause, "no_s");
  h.distance = -1;
  assert_int_equal(hbmcheck_verification_hypothesis(v, -1, &h), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_verification_hypothesis(v, r->n_hypotheses, &h), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_verification_hypothesis(NULL, 0, &h), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_verification_hypothesis(v, 0, NULL), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_verification_hypothesis_text(v, -1, cause, 5, NULL, 0), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_verification_hypotheses(NULL), 0);
  SAME(PAIR(h.distance, -1));
}

static void the_cause_is_named(CHECK_STATE)
{
  curve c;
  verify_data data = read_no_static(&c);
  char why[512];
  CHECK_MADE(hbmcheck_case, public_case,
             hbmcheck_case_read(FOLDER "case2.yaml", 0, NULL, why, sizeof why, &public_case));
  const hbmcheck_foreign theirs = {.quantity = "harmonic_1", .n = c.n, .omega = c.omega, .value = c.value};
  CHECK_MADE(hbmcheck_verification, v, hbmcheck_verification_run(public_case, &theirs, NULL, why, sizeof why, &v));
  assert_string_equal(why, "");
  assert_string_equal(hbmcheck_verification_cause(v), "no_static_harmonic");
  assert_string_equal(hbmcheck_verification_guess(v), "none");
  case_error err;
  CHECK_FILLED(scene, sc, case_read(FOLDER "case2.yaml", 0, NULL, &sc, &err));
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  CHECK_FILLED(verify_report, expected, verify_run(&setup, 1, &data, NULL, NULL, &expected));
  hbmcheck_point p;
  assert_int_equal(hbmcheck_verification_count(v), expected.n_rows);
  for (int i = 0; i < expected.n_rows; ++i) {
    assert_int_equal(hbmcheck_verification_get(v, i, &p), HBMCHECK_OK);
    SAME(PAIR(p.omega, expected.rows[i].omega), PAIR(p.value, expected.rows[i].value),
         PAIR(p.nearest, expected.rows[i].nearest), PAIR(p.error, expected.rows[i].error),
         PAIR(p.verdict, expected.rows[i].verdict), PAIR(p.branch, expected.rows[i].branch),
         PAIR(p.stable, expected.rows[i].stable), PAIR(p.skipped, expected.rows[i].skipped), PAIR(p.index, i));
  }
  p.omega = -1;
  assert_int_equal(hbmcheck_verification_get(v, expected.n_rows, &p), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_verification_get(v, -1, &p), HBMCHECK_BAD_INPUT);
  SAME(PAIR(p.omega, -1));
  char words[VERIFY_TEXT];
  CHECK_FILLED(hbmcheck_findings, f, hbmcheck_verification_findings(v, &f));
  SAME(PAIR(f.points, expected.n_rows), PAIR(f.match, expected.count[VERDICT_MATCH]),
       PAIR(f.differs, expected.count[VERDICT_DIFFERS]), PAIR(f.unstable, expected.count[VERDICT_UNSTABLE]),
       PAIR(f.other_branch, expected.count[VERDICT_OTHER_BRANCH]),
       PAIR(f.solver_failed, expected.count[VERDICT_SOLVER_FAILED]), PAIR(f.skipped, expected.skipped),
       PAIR(f.reversals, expected.reversals), PAIR(f.harmonics, expected.harmonics), PAIR(f.checked, expected.checked),
       PAIR(f.unchecked, expected.unchecked), PAIR(f.exit_code, verify_exit_code(&expected)),
       PAIR(f.gate, expected.gate), PAIR(f.checked_error, expected.checked_error),
       PAIR(f.truth_distance, expected.truth_distance), PAIR(f.noise, expected.noise));
  assert_string_equal(hbmcheck_verification_cause(v), verify_word(&expected, words));
  assert_string_equal(hbmcheck_verification_sentence(v), verify_sentence(&expected, words));
  check_hypotheses(v, &expected);
  verify_clear(&expected);
  verify_data_clear(&data);
  scene_setup_clear(&setup);
  case_clear(&sc);
  hbmcheck_verification_free(v);
  hbmcheck_case_free(public_case);
}

/* Three points of a solution, one at omega = 0: dB comes back; that one is counted, the others keep their places. */
static void decibels_and_points_left_out(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("sweep.omega=3,6", "hbm.harmonics=10");
  double omega[4] = {3.5, 0, 4, 4.5}, value[4] = {0};
  CHECK_MADE(hbmcheck_curve, ours, hbmcheck_curve_trace(c, NULL, &ours));
  for (int i = 0; i < 4; ++i) {
    if (omega[i] <= 0) continue;
    CHECK_MADE(hbmcheck_solutions, at, hbmcheck_curve_at(ours, omega[i], &at));
    CHECK_FILLED(hbmcheck_solution, s, hbmcheck_solutions_get(at, 0, &s));
    value[i] = 20 * log10(s.amplitude);
    hbmcheck_solutions_free(at);
  }
  const hbmcheck_foreign theirs = {.quantity = "dB", .n = 4, .omega = omega, .value = value};
  CHECK_MADE(hbmcheck_verification, v, hbmcheck_verification_run(c, &theirs, NULL, NULL, 0, &v));
  assert_string_equal(hbmcheck_verification_cause(v), "none");
  CHECK_FILLED(hbmcheck_findings, f, hbmcheck_verification_findings(v, &f));
  SAME(PAIR(f.left_out, 1), PAIR(f.exit_code, 0), PAIR(hbmcheck_verification_count(v), 3));
  CHECK_FILLED(hbmcheck_point, p, hbmcheck_verification_get(v, 1, &p));
  assert_int_equal(p.index, 2);
  CHECK_LE(fabs(p.value - value[2]), 1e-12, "%.17g", p.value); /* 20 log10 of 10^(dB/20): some roundings of 20 dB */
  CHECK_LE(fabs(p.nearest - value[2]), 8.7 * f.gate, "%.17g", p.nearest); /* d dB = 20/ln 10 of the relative error */
  hbmcheck_verification_free(v);
  hbmcheck_curve_free(ours);
  hbmcheck_case_free(c);
}

static void refuse(const hbmcheck_case *c, hbmcheck_foreign theirs, const char *words)
{
  char why[512] = "";
  hbmcheck_verification *v = (void *)&v;
  assert_int_equal(hbmcheck_verification_run(c, &theirs, NULL, why, sizeof why, &v), HBMCHECK_BAD_INPUT);
  assert_null(v);
  if (!strstr(why, words)) fail_msg("'%s' does not say '%s'", why, words);
}

static void wrong_curves_are_refused_in_words(CHECK_STATE)
{
  hbmcheck_case *c = CASE2("sweep.omega=3,6", "hbm.harmonics=3");
  const double omega[] = {3.5, 4, 4.5}, value[] = {1, 2, 3}, negative[] = {1, -2, 3}, nan[] = {1, 2, NAN},
               loud[] = {1, 2, 1e6};
  const hbmcheck_foreign good = {.quantity = "amplitude", .n = 3, .omega = omega, .value = value};
#define BUT(member, wrong, words)                                                                                      \
  bad = good, bad.member = (wrong);                                                                                    \
  refuse(c, bad, words)
  hbmcheck_foreign bad;
  BUT(quantity, "amplitud", "quantity 'amplitud' is unknown, expected one of amplitude");
  BUT(quantity, NULL, "");
  BUT(n, 2, "2 points, expected at least 3");
  BUT(n, -1, "");
  BUT(n, 100001, "100001 points, expected at most 100000");
  BUT(value, negative, "value[1] = -2 is too small, expected a number >= 0; is it in dB?");
  BUT(value, nan, "value[2] = nan is not finite");
  BUT(omega, nan, "omega[2] = nan is not finite");
  BUT(omega, NULL, "");
  BUT(noise, NAN, "noise = nan");
  BUT(noise, 1.5, "noise = 1.5 is no scatter");
  BUT(response, 1, "response 1: there is none, expected 0 to 0");
  bad = good, bad.value = loud;
  refuse(c, (bad.quantity = "dB", bad), "value[2] = 1e+06 is too large");
  hbmcheck_verification *v = (void *)&v;
  assert_int_equal(hbmcheck_verification_run(NULL, &good, NULL, NULL, 0, &v), HBMCHECK_BAD_INPUT);
  assert_null(v);
  assert_int_equal(hbmcheck_verification_run(c, NULL, NULL, NULL, 0, &v), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_verification_run(c, &good, NULL, NULL, 0, NULL), HBMCHECK_BAD_INPUT);
  hbmcheck_case_free(c);
}

static void accelerations_of_structures_are_refused(CHECK_STATE)
{
  const double omega[] = {1, 1.1, 1.2}, value[] = {1, 2, 3};
  CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(SOURCE_DIR "/cases/structures/chain3.yaml", 0, NULL, NULL, 0, &c));
  refuse(c, (hbmcheck_foreign){.quantity = "acceleration", .n = 3, .omega = omega, .value = value},
         "acceleration is known of one degree of freedom alone");
  hbmcheck_case_free(c);
}

static int stop_at_third(void *self, double done)
{
  (void)done;
  return ++*(int *)self < 3;
}

static void a_monitor_stops_it(CHECK_STATE)
{
  curve c;
  verify_data data = read_no_static(&c);
  hbmcheck_case *public_case = CASE2("hbm.harmonics=10");
  hbmcheck_verification *v;
  int ticks = 0;
  const hbmcheck_monitor monitor = {stop_at_third, &ticks};
  const hbmcheck_foreign theirs = {.quantity = "harmonic_1", .n = c.n, .omega = c.omega, .value = c.value};
  assert_int_equal(hbmcheck_verification_run(public_case, &theirs, &monitor, NULL, 0, &v), HBMCHECK_INTERRUPTED);
  assert_non_null(v);
  CHECK_FILLED(hbmcheck_findings, f, hbmcheck_verification_findings(v, &f));
  SAME(PAIR(f.exit_code, 3), PAIR(f.points, hbmcheck_verification_count(v)));
  hbmcheck_verification_free(v);
  hbmcheck_case_free(public_case);
  verify_data_clear(&data);
}

static void nothing_is_harmless(CHECK_STATE)
{
  hbmcheck_findings f;
  hbmcheck_point p;
  assert_int_equal(hbmcheck_verification_count(NULL), 0);
  assert_int_equal(hbmcheck_verification_get(NULL, 0, &p), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_verification_findings(NULL, &f), HBMCHECK_BAD_INPUT);
  assert_string_equal(hbmcheck_verification_cause(NULL), "");
  assert_string_equal(hbmcheck_verification_guess(NULL), "");
  assert_string_equal(hbmcheck_verification_sentence(NULL), "");
  hbmcheck_verification_free(NULL);
}

CHECK_TESTS("library.verification", 300, the_cause_is_named, decibels_and_points_left_out,
            wrong_curves_are_refused_in_words, accelerations_of_structures_are_refused, a_monitor_stops_it,
            nothing_is_harmless)
