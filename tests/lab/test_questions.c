/* test_questions.c - the lab's questions against those they come from, and against what the numbers must be. */
#include <float.h>

#include "compare/first_guess.h"
#include "compare/output/rows.h"
#include "model/casefile/case_file.h"
#include "tests/lab/answer.h"

enum { MOST = 2 * HBM_MAX_HARMONICS + 1, CONTACT = 2 /* of a signal: th, x, then u, v, N, T */ };

static const char text[] =
    "oscillator: {mass: 1.0, damping: 0.4, stiffness: 40}\n"
    "forcing: {amplitude: 100}\n"
    "contacts:\n"
    "  - {tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.08, angle_deg: 45, gap: -5}\n"
    "sweep: {omega: [5, 12]}\n"
    "hbm: {harmonics: 5, samples: 128}\n"
    "compare: {harmonics: [1, 3], samples: [64, 4096]}\n";

static lab *lab_with_case(void)
{
  lab *l = lab_new();
  assert_non_null(l);
  if (lab_read(l, text) != HC_OK) fail_msg("%s", lab_message(l));
  return l;
}

/* Row i becomes the lab's motion. */
static void take(lab *l, int i)
{
  const int n_harm = (int)number(l, i, "harmonics");
  memcpy(lab_motion(l, n_harm), cell(l, i, "coefficients"), (size_t)(2 * n_harm + 1) * sizeof(double));
}

/* That of the curve's largest amplitude; returns its number. */
static int take_largest(lab *l)
{
  int largest = 0;
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  for (int i = 1; i < lab_rows(l); ++i)
    if (number(l, i, "amplitude") > number(l, largest, "amplitude")) largest = i;
  take(l, largest);
  return largest;
}

/* ---- the case ---- */

static void mistakes_are_named(CHECK_STATE)
{
  lab *l = lab_with_case();
  assert_int_equal(lab_read(l, "oscillator: {mass: -1, damping: 0.4, stiffness: 40}\n"), HC_BAD_INPUT);
  assert_non_null(strstr(lab_message(l), "case:1:20: "));
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK); /* of the case before */
  assert_true(lab_rows(l) > 0);
  assert_string_equal(lab_message(l), "");
  lab_free(l);
}

static void a_new_case_forgets_the_old_ones_answers(CHECK_STATE)
{
  lab *l = lab_with_case();
  take_largest(l);
  assert_int_equal(lab_read(l, text), HC_OK);
  assert_int_equal(lab_rows(l), 0);
  assert_int_equal(lab_specials(l, LAB_EXACT), HC_BAD_INPUT);
  assert_int_equal(lab_work(l), HC_BAD_INPUT);
  lab_free(l);
}

static void a_case_is_had_back_in_numbers(CHECK_STATE)
{
  static const char other[] =
      "title: 'a: b'\n"
      "oscillator: {mass: 2, damping: 0.5, stiffness: 30}\n"
      "forcing: {amplitude: 7}\n"
      "contacts:\n"
      "  - {tangential_stiffness: 1, normal_stiffness: 2, friction: 0.3, angle_deg: 40, gap: -5}\n"
      "  - {tangential_stiffness: 6, normal_stiffness: 7, friction: 0.8, angle_deg: 90, gap: 10}\n"
      "sweep: {omega: [9, 4]}\n"
      "hbm: {harmonics: 3, samples: 99, static: false, slider_restart: sample}\n";
  static const double numbers[] = {2, 0.5, 30, 7, 9, 4, 3, 99, 0, 0, 1};
  static const double contacts[2][5] = {{1, 2, 0.3, 40, -5}, {6, 7, 0.8, 90, 10}};
  lab *l = lab_new();
  assert_int_equal(lab_case(l), HC_BAD_INPUT);
  assert_int_equal(lab_rows(l), 0);
  assert_string_equal(lab_title(l), "");
  assert_int_equal(lab_read(l, other), HC_OK);
  assert_string_equal(lab_title(l), "a: b");
  assert_int_equal(lab_case(l), HC_OK);
  assert_int_equal(lab_rows(l), 3);
  for (int i = 0; i < 11; ++i) assert_true(row(l, 0)[i] == numbers[i]);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 5; ++i) assert_true(row(l, j + 1)[i] == contacts[j][i]);
  assert_true(isnan(row(l, 1)[5]) && row(l, 1)[LAB_LAW] == 0);
  lab_free(l);
}

static void structures_are_refused(CHECK_STATE)
{
  static const char structure[] = "structure: {mass: [1, 1], stiffness: [[2, -1], [-1, 2]], damping: {modal: 0.01}}\n"
                                  "forcing: [{dof: 1, amplitude: 1}]\n"
                                  "sweep: {omega: [0.5, 2]}\n";
  lab *l = lab_new();
  assert_int_equal(lab_read(l, structure), HC_BAD_INPUT);
  assert_non_null(strstr(lab_message(l), "one degree of freedom"));
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_BAD_INPUT);
  lab_free(l);
}

static void questions_without_an_answer_are_refused(CHECK_STATE)
{
  lab *l = lab_with_case();
  const double no_omega[] = {-1};
  assert_int_equal(lab_curve(l, 2), HC_BAD_INPUT);
  assert_int_equal(lab_curve_at(l, LAB_EXACT, 7), HC_BAD_INPUT); /* no curve */
  assert_int_equal(lab_specials(l, LAB_SAMPLED), HC_BAD_INPUT);
  assert_int_equal(lab_errors(l, 7), HC_BAD_INPUT);
  assert_int_equal(lab_signal(l, LAB_EXACT, 16), HC_BAD_INPUT); /* no motion */
  assert_int_equal(lab_spectrum(l, 16, 20), HC_BAD_INPUT);
  assert_int_equal(lab_work(l), HC_BAD_INPUT);
  assert_int_equal(lab_transients(l, 1, no_omega), HC_BAD_INPUT);
  assert_int_equal(lab_transients(l, 0, no_omega), HC_BAD_INPUT);
  assert_null(lab_motion(l, 0));
  assert_null(lab_motion(l, HBM_MAX_HARMONICS + 1));
  assert_int_equal(lab_rows(l), 0);
  lab_free(l);
}

/* ---- harmonic balance ---- */

/* Row i of the table is *of: every column that other interfaces have, by name. */
static void check_result(const lab *l, int i, rows_kind kind, const void *of)
{
  table_column columns[ROWS_MOST];
  row_cell cells[ROWS_MOST];
  const int n = rows_columns(kind, ROWS_IN_MEMORY, columns);
  rows_cells(kind, of, ROWS_IN_MEMORY, cells);
  for (int c = 0; c < n; ++c) {
    const row_cell *expected = &cells[c];
    const double *value = cell(l, i, columns[c].name);
    assert_string_equal(lab_name(l, c), columns[c].name);
    if (!expected->there) assert_true(isnan(*value));
    else if (expected->kind == TABLE_TEXT) assert_string_equal(lab_word(l, (int)*value), expected->as.text);
    else if (expected->kind == TABLE_INTEGER) assert_true(*value == (double)expected->as.integer);
    else if (expected->kind == TABLE_REAL) assert_true(*value == expected->as.real);
    else assert_memory_equal(value, expected->as.series.v, (size_t)expected->as.series.n * sizeof *value);
  }
  assert_null(lab_name(l, n));
}

static void curve_is_the_librarys(CHECK_STATE)
{
  lab *l = lab_with_case();
  case_error err;
  hbm_curve curve = {0};
  hbm_special *specials;
  response_row r;
  int n_specials;
  CHECK_FILLED(scene, sc, case_parse("case", text, strlen(text), 0, NULL, &sc, &err));
  sc.hbm.force = HBM_FORCE_SAMPLED;
  CHECK_MADE(model, m, scene_model(&sc, &m));
  CHECK_MADE(hbm_solver, s, guided_hbm_solver_new(m, &sc.hbm, &s));
  assert_int_equal(hbm_trace(s, sc.omega_from, sc.omega_to, NULL, &curve), HC_OK);
  assert_int_equal(lab_curve(l, LAB_SAMPLED), HC_OK);
  assert_int_equal(lab_rows(l), curve.n);
  assert_int_equal(lab_columns(l), lab_column(l, "coefficients") + curve.n_coef);
  for (int k = 0; k < curve.n; ++k) {
    assert_int_equal(response_row_of(s, &curve, k, &r), HC_OK);
    r.series = hbm_curve_X(&curve, k);
    check_result(l, k, ROWS_FRF, &r);
  }
  assert_int_equal(hbm_specials(s, &curve, &specials, &n_specials), HC_OK);
  assert_int_equal(lab_specials(l, LAB_SAMPLED), HC_OK);
  assert_int_equal(lab_rows(l), n_specials);
  for (int i = 0; i < n_specials; ++i) check_result(l, i, ROWS_SPECIALS, &specials[i]);
  assert_true(n_specials > 0);
  free(specials);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  model_free(m);
  case_clear(&sc);
  lab_free(l);
}

static void solutions_at_an_omega_lie_there(CHECK_STATE)
{
  lab *l = lab_with_case();
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  assert_int_equal(lab_curve_at(l, LAB_EXACT, 8), HC_OK);
  assert_int_equal(lab_rows(l), 3); /* two stable ones, an unstable one between them */
  for (int i = 0; i < 3; ++i) assert_true(number(l, i, "omega") == 8);
  assert_true(says(l, 0, "stable", "yes") && says(l, 1, "stable", "no") && says(l, 2, "stable", "yes"));
  assert_int_equal(lab_specials(l, LAB_EXACT), HC_OK);
  int turning_points = 0;
  for (int i = 0; i < lab_rows(l); ++i) turning_points += says(l, i, "kind", "turning point");
  assert_int_equal(turning_points, 2);
  lab_free(l);
}

/* ---- one motion ---- */

/* The loop's area is the work. Trapezoids miss it by (2 pi/N)^2/12 of what |T u'' + T' u'| is on average: taken to be
 * as large as the rectangle around the loop. Samples know the times of transitions to 2 pi/N, which costs as much. */
static void loop_encloses_the_work(CHECK_STATE)
{
  enum { N = 4096 };
  lab *l = lab_with_case();
  take_largest(l);
  assert_int_equal(lab_work(l), HC_OK);
  const double work = row(l, 0)[5], limit = row(l, 0)[3], step = TWO_PI / N;
  assert_true(work > 0);
  for (int force = LAB_EXACT; force <= LAB_SAMPLED; ++force) {
    double area = 0, widest = 0;
    assert_int_equal(lab_signal(l, force, N), HC_OK);
    for (int i = 0; i < N; ++i) {
      const double *a = row(l, i) + CONTACT, *b = row(l, (i + 1) % N) + CONTACT;
      area += 0.5 * (a[3] + b[3]) * (b[0] - a[0]);
      widest = fmax(widest, fabs(a[0]));
      CHECK_LE(fabs(a[3]), 0.08 * a[2] * (1 + 1e-12), "force %d, instant %d", force, i);
    }
    CHECK_LE(fabs(area - work), step * step / 12 * 4 * widest * limit, "force %d", force);
  }
  lab_free(l);
}

/* Sampled n times a period: the sum of all harmonics k n + h, to what the shown ones leave out. */
static void sampled_harmonics_fold(CHECK_STATE)
{
  enum { N = 64, SHOWN = 200 };
  lab *l = lab_with_case();
  take_largest(l);
  assert_int_equal(lab_spectrum(l, N, SHOWN), HC_OK);
  for (int h = 1; h <= 5; ++h) {
    double c = row(l, h)[1], s = row(l, h)[2];
    for (int k = 1; k * N + h <= SHOWN; ++k) {
      c += row(l, k * N + h)[1] + row(l, k * N - h)[1];
      s += row(l, k * N + h)[2] - row(l, k * N - h)[2];
    }
    const double alias = hypot(row(l, h)[3] - row(l, h)[1], row(l, h)[4] - row(l, h)[2]);
    CHECK_LE(hypot(row(l, h)[3] - c, row(l, h)[4] - s), 0.5 * alias, "h=%d", h);
  }
  lab_free(l);
}

static void motion_is_the_curves(CHECK_STATE)
{
  lab *l = lab_with_case();
  const int k = take_largest(l);
  double max = -INFINITY;
  const double expected = number(l, k, "max");
  assert_int_equal(lab_signal(l, LAB_EXACT, 4096), HC_OK);
  for (int i = 0; i < lab_rows(l); ++i) max = larger(max, row(l, i)[1]);
  CHECK_LE(fabs(max - expected), 1e-5 * expected, "the largest x");
  lab_free(l);
}

/* ---- other laws ---- */

static const char of_laws[] = "oscillator: {mass: 1, damping: 0.1, stiffness: 1}\n"
                              "forcing: {amplitude: 0.5}\n"
                              "contacts:\n"
                              "  - {law: polynomial, coefficients: {3: 0.5, 2: 0.1}}\n"
                              "%s"
                              "sweep: {omega: [0.5, 2]}\n"
                              "hbm: {harmonics: 5, samples: 21}\n"
                              "compare: {harmonics: [3, 9], samples: [37]}\n";
static const char stops[] = "  - {law: table, points: [[-1, -2.5], [-0.5, 0], [0.25, 0], [1, 3]]}\n";

/* With a table or not; its largest motion is the lab's. */
static lab *lab_with_laws(bool has_table)
{
  char of[1024];
  lab *l = lab_new();
  assert_non_null(l);
  snprintf(of, sizeof of, of_laws, has_table ? stops : "");
  if (lab_read(l, of) != HC_OK) fail_msg("%s", lab_message(l));
  take_largest(l);
  return l;
}

static double table_at(double d) { return d < -0.5 ? 5 * (d + 0.5) : d > 0.25 ? 4 * (d - 0.25) : 0; }

static void laws_are_had_back_with_their_forces(CHECK_STATE)
{
  lab *l = lab_with_laws(true);
  double most[2] = {-INFINITY, -INFINITY}, least[2] = {INFINITY, INFINITY};
  assert_int_equal(lab_signal(l, LAB_EXACT, 4096), HC_OK);
  for (int i = 0; i < lab_rows(l); ++i) {
    const double x = row(l, i)[1], f[] = {(0.5 * x + 0.1) * x * x, table_at(x)};
    for (int j = 0; j < 2; ++j) {
      const double *at = row(l, i) + CONTACT + 4 * j;
      CHECK_LE(fabs(at[2] - f[j]), 16 * DBL_EPSILON * (1 + fabs(f[j])), "contact %d at x = %g", j, x);
      assert_true(at[3] == 0);
      most[j] = fmax(most[j], f[j]), least[j] = fmin(least[j], f[j]);
    }
  }
  assert_int_equal(lab_work(l), HC_OK);
  assert_int_equal(lab_rows(l), 2);
  for (int j = 0; j < 2; ++j) { /* between 4096 instants an extremum is off by f'' h^2/8 */
    CHECK_LE(fabs(row(l, j)[2] - most[j]), 1e-4 * most[j], "largest of contact %d", j);
    CHECK_LE(fabs(row(l, j)[1] - least[j]), 1e-4 * fabs(least[j]), "least of contact %d", j);
    CHECK_LE(fabs(row(l, j)[5]), 0, "an elastic law does no work");
  }
  assert_int_equal(lab_case(l), HC_OK);
  assert_true(row(l, 1)[LAB_LAW] == LAB_POLYNOMIAL && row(l, 1)[0] == 0.1 && row(l, 1)[1] == 0.5 && row(l, 1)[2] == 0);
  static const double points[] = {-1, -2.5, -0.5, 0, 0.25, 0, 1, 3};
  assert_memory_equal(row(l, 2) + LAB_POINTS, points, sizeof points);
  assert_true(row(l, 2)[LAB_LAW] == LAB_TABLE && isnan(row(l, 2)[LAB_POINTS + 8]));
  lab_free(l);
}

/* A law of degree 3, H = 5: 21 samples are exact, 20 are not. Harmonics beyond 3 H are 0. */
static void enough_samples_are_exact_for_a_polynomial(CHECK_STATE)
{
  lab *l = lab_with_laws(false);
  for (int n = 20; n <= 21; ++n) {
    double off = 0, size = 0, beyond = 0;
    assert_int_equal(lab_spectrum(l, n, 40), HC_OK);
    for (int h = 0; h <= 40; ++h) {
      const double *at = row(l, h);
      if (h > 5) beyond = h > 15 ? larger(beyond, hypot(at[1], at[2])) : beyond;
      else off = larger(off, hypot(at[1] - at[3], at[2] - at[4])), size = larger(size, hypot(at[1], at[2]));
    }
    CHECK_LE(beyond, 1e-14 * size, "N = %d", n);
    if (n == 21) CHECK_LE(off, 1e-14 * size, "N = %d", n);
    else CHECK_LE(1e-11 * size, off, "N = %d: 3 H folds onto H", n);
  }
  lab_free(l);
}

/* The table's slope beside its stops is 0: f is that of its kinks. */
static void laws_have_transients_and_errors(CHECK_STATE)
{
  const double omega[] = {1.6};
  for (int has_table = 0; has_table < 2; ++has_table) {
    lab *l = lab_with_laws(has_table);
    assert_int_equal(lab_curve_at(l, LAB_EXACT, *omega), HC_OK);
    const double hbm = number(l, 0, "amplitude");
    take(l, 0);
    assert_int_equal(lab_errors(l, *omega), HC_OK);
    assert_int_equal(lab_rows(l), 4);
    CHECK_LE(row(l, 2)[4], 0.1 * row(l, 0)[4], "H = 9 and 3, table %d", has_table);
    if (!has_table) CHECK_LE(fabs(row(l, 3)[3] - row(l, 2)[3]), 1e-10 * hbm, "37 samples are exact");
    assert_int_equal(lab_transients(l, 1, omega), HC_OK);
    assert_true(says(l, 0, "status", "ok"));
    lab_free(l);
  }
}

static void a_law_without_fields_is_refused(CHECK_STATE)
{
  char of[1024];
  lab *l = lab_new();
  snprintf(of, sizeof of, of_laws,
           "  - {law: tanh, normal_stiffness: 1, friction: 0.3, angle_deg: 45, epsilon: 0.1}\n");
  assert_int_equal(lab_read(l, of), HC_BAD_INPUT);
  assert_non_null(strstr(lab_message(l), "polynomial or table"));
  lab_free(l);
}

/* ---- the truth ---- */

static void more_harmonics_and_samples_come_closer(CHECK_STATE)
{
  lab *l = lab_with_case();
  const double omega = 7;
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  assert_int_equal(lab_curve_at(l, LAB_EXACT, omega), HC_OK);
  take(l, 0);
  assert_int_equal(lab_errors(l, omega), HC_OK);
  assert_int_equal(lab_rows(l), 6); /* H = 1, 3; exact, 64, 4096 */
  for (int i = 0; i < 6; ++i) assert_int_equal((int)row(l, i)[2], HC_OK);
  CHECK_LE(10 * row(l, 3)[4], row(l, 0)[4], "H = 3 and 1");
  const double orbit = row(l, 0)[3] / (1 + row(l, 0)[4]); /* with H = 1 the amplitude is too large */
  CHECK_LE(fabs(fabs(row(l, 3)[3] - orbit) / orbit - row(l, 3)[4]), 1e-12, "of the same orbit");
  const double coarse = fabs(row(l, 4)[3] - row(l, 3)[3]), fine = fabs(row(l, 5)[3] - row(l, 3)[3]);
  CHECK_LE(100 * fine, coarse, "N = 4096 and 64");
  assert_true(fine > 0);
  lab_free(l);
}

static void transients_are_steady(CHECK_STATE)
{
  const double omega[] = {6};
  lab *l = lab_with_case();
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  assert_int_equal(lab_curve_at(l, LAB_EXACT, omega[0]), HC_OK);
  const double hbm = number(l, 0, "amplitude");
  assert_int_equal(lab_transients(l, 1, omega), HC_OK);
  assert_int_equal(lab_rows(l), 1);
  assert_true(says(l, 0, "status", "ok") && says(l, 0, "verdict", "settled") && says(l, 0, "stable", "yes"));
  CHECK_LE(fabs(number(l, 0, "amplitude") - hbm), 1e-2 * hbm, "H = 5 against the closed form");
  double max = -INFINITY;
  for (const double *x = cell(l, 0, "wave"); x < row(l, 1); ++x) max = larger(max, *x);
  CHECK_LE(fabs(max - number(l, 0, "max")), 1e-3 * max, "the largest of the wave");
  lab_free(l);
}

CHECK_TESTS("lab.questions", 120, a_case_is_had_back_in_numbers, mistakes_are_named,
            a_new_case_forgets_the_old_ones_answers, structures_are_refused, questions_without_an_answer_are_refused,
            curve_is_the_librarys, solutions_at_an_omega_lie_there, loop_encloses_the_work, sampled_harmonics_fold,
            motion_is_the_curves, more_harmonics_and_samples_come_closer, transients_are_steady,
            laws_are_had_back_with_their_forces, enough_samples_are_exact_for_a_polynomial,
            laws_have_transients_and_errors, a_law_without_fields_is_refused)
