/* test_page.c - the page of report: whole or not there, small, self-contained, the same twice, safe with any title. */
#include <jansson.h>

#include "tests/command/report/run.h"

enum { MOST_BYTES = 1000000 }; /* "under 1 MB" */

static void count(const char *text, const char *what, int expected)
{
  int n = 0;
  for (const char *at = text; (at = strstr(at, what)); at += strlen(what)) ++n;
  if (n != expected) fail_msg("'%s' occurs %d times, expected %d", what, n, expected);
}

/* The data block as it would be read by the page; to be released. */
static json_t *data_of(const char *page)
{
  static const char before[] = "<script type=\"application/json\" id=\"data\">";
  const char *from = strstr(page, before);
  assert_non_null(from);
  from += strlen(before);
  const char *to = strstr(from, "</script>");
  assert_non_null(to);
  json_error_t error;
  json_t *data = json_loadb(from, (size_t)(to - from), JSON_REJECT_DUPLICATES, &error);
  if (!data) print_error("the data block: %s\n", error.text);
  assert_non_null(data);
  return data;
}

/* The page of `report ARGS`, which ends with that exit code; to be freed. */
static char *page_of(const char *args, int code, size_t *length)
{
  char line[512];
  snprintf(line, sizeof line, "report %s -o $D/page.html 2>&1", args);
  expect(line, code, "");
  char *page = folder_read("page.html", length);
  assert_int_equal(system("rm $D/page.html"), 0);
  return page;
}

/* Its data; to be released. */
static json_t *data_of_page(const char *args)
{
  char *page = page_of(args, 0, NULL);
  json_t *data = data_of(page);
  free(page);
  return data;
}

static void page_is_small_and_complete(CHECK_STATE)
{
  size_t length[2];
  expect("report " CASE2 SMALL "-o $D/0.html 2>&1", 0, "");
  char *page[] = {folder_read("0.html", &length[0]), page_of(CASE2 SMALL, 0, &length[1])};
  assert_int_equal(length[0], length[1]);
  assert_memory_equal(page[0], page[1], length[0]); /* same input, same bytes */
  CHECK_LE((double)length[0], MOST_BYTES, "bytes of the page");
  assert_int_equal(strncmp(page[0], "<!doctype html>", 15), 0);
  assert_non_null(strstr(page[0] + length[0] - 16, "</html>"));
  count(page[0], "<script", 3);
  count(page[0], "</script>", 3);
  static const char *const words[] = {"They agree.",
                                      "within the gate",
                                      "exact forces need none",
                                      "<code>unstable</code>",
                                      "contact goes from linear to separation",
                                      "turning point",
                                      "from_<wbr>truncation",
                                      "normal_stiffness: 1000",
                                      "hbmcheck report " CASE2 " --at 8,9 --harmonics 1,5 --samples 32,512",
                                      "<code>hbmcheck lab --case " CASE2 "</code>",
                                      "href=\"lab.html#case=title%3A%20",
                                      "&amp;omega=8\"", /* the largest error, of the two */
                                      "SUNDIALS ",
                                      "Chart.js ",
                                      "Permission is hereby granted"};
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
    if (!strstr(page[0], words[i])) fail_msg("the page does not say '%s'", words[i]);
  /* Nothing is loaded: no element with an address, and the browser is told to allow none. */
  static const char *const loads[] = {
      "src=\"",  "src='",          "href=\"http", "href=\"//", "@import", "url(", "<link rel=\"stylesheet",
      "<iframe", "XMLHttpRequest", "fetch("};
  for (size_t i = 0; i < sizeof loads / sizeof *loads; ++i)
    if (strstr(page[0], loads[i])) fail_msg("the page holds '%s'", loads[i]);
  assert_non_null(strstr(page[0], "default-src 'none'"));
  assert_null(strstr(page[0], "{{"));
  json_t *data = data_of(page[0]), *curve = json_object_get(json_object_get(data, "response"), "curve"),
         *aliasing = json_object_get(data, "aliasing");
  size_t n = json_array_size(json_object_get(curve, "omega")), turns = 0;
  assert_true(n > 50);
  assert_int_equal(json_array_size(json_object_get(curve, "amplitude")), n);
  for (size_t i = 1; i < n; ++i) /* a folded curve stays in its own order */
    turns += json_number_value(json_array_get(json_object_get(curve, "omega"), i)) <
             json_number_value(json_array_get(json_object_get(curve, "omega"), i - 1));
  assert_true(turns > 5);
  assert_int_equal(json_array_size(json_object_get(aliasing, "omega")), 2);
  assert_int_equal(json_array_size(json_object_get(aliasing, "samples")), 9);
  const json_t *curves = json_object_get(aliasing, "curves"),
               *curve_of_case = json_array_get(json_array_get(curves, 0), 0);
  assert_int_equal(json_array_size(curves), 2); /* stiffnesses */
  assert_int_equal(json_array_size(json_array_get(curves, 0)), 4);
  assert_int_equal(json_array_size(json_object_get(curve_of_case, "states")), 2);
  json_decref(data);
  free(page[0]);
  free(page[1]);
}

/* 2 folds and 2 contact changes are open; with 128 samples the curve has many false turning points. */
static void a_long_table_of_special_points_is_closed(CHECK_STATE)
{
  char *few = page_of(CASE2 SMALL, 0, NULL),
       *many = page_of(CASE2 SMALL "--set hbm.force=sampled --set hbm.samples=64", 1, NULL);
  assert_non_null(strstr(few, "<details open><summary>What happens on the curve, "));
  assert_non_null(strstr(many, "<details><summary>What happens on the curve, "));
  free(few);
  free(many);
}

/* With the case's stiffness, the h-th H and the omega-th omega. */
static const json_t *state_of(const json_t *data, size_t h, size_t omega)
{
  const json_t *curves = json_object_get(json_object_get(data, "aliasing"), "curves");
  return json_array_get(json_object_get(json_array_get(json_array_get(curves, 0), h), "states"), omega);
}

static double entry(const json_t *of, const char *name, size_t i)
{
  return json_number_value(json_array_get(json_object_get(of, name), i));
}

/* The sampled spectrum is the true one plus what folds onto it: F_h + conj(F_{N-h}) + F_{N+h} + ..., here for the
 * mean of 32 samples, where sampled - true = Re(F_N + F_2N + ...). The first term is in the page to 1e-6 of the
 * largest force; the rest falls like 1/n^2, at most sum_{m>=2} |F_N|/m^2 < 0.65 times the kinks' bound, for which 3
 * times the largest of |F_N|, |F_{N-1}|, |F_{N+1}| stands. */
static void sampled_mean_is_what_folds_onto_it(CHECK_STATE)
{
  json_t *data = data_of_page(CASE2 " -q --harmonics 1 --samples 32 --at 8,9");
  const json_t *one = state_of(data, 2, 1), /* H = 5, omega 9 */
      *sampled = json_array_get(json_object_get(one, "sampled"), 1);
  double off = entry(sampled, "difference", 0) * 1e-9, first = entry(one, "harmonics", 2 * 32 - 1) * 1e-6, most = 0;
  for (size_t i = 0; i < 4; ++i) most = fmax(most, entry(sampled, "folds", i) * 1e-9);
  CHECK_LE(fabs(off - first), 3 * 0.65 * most + 1e-6, "sampled mean - true mean = %g, Re F_32 = %g", off, first);
  CHECK_LE(1e-5, fabs(off), "something does fold");
  json_decref(data);
}

/* The harmonics are those of the force that is drawn: the trapezoidal sum over its 128 times is F_h + what folds from
 * 128 - h and 128 + h on, of which the page has the first two of each kept harmonic, and the rest at most 0.65 times
 * three times as much (above); the times are known to 1e-4 of the largest force, which bounds their mean's error. */
static void harmonics_are_those_of_the_force_that_is_drawn(CHECK_STATE)
{
  enum { TIMES = 128 };
  json_t *data = data_of_page(CASE2 " -q --harmonics 1 --samples 32 --at 8,9");
  const json_t *one = state_of(data, 2, 1), *sampled = json_array_get(json_object_get(one, "sampled"), 3);
  for (int h = 1; h <= 5; ++h) {
    double cosine = 0, sine = 0;
    for (int i = 0; i < TIMES; ++i) {
      const double f = entry(one, "force", (size_t)i) * 1e-4, th = TWO_PI * h * i / TIMES;
      cosine += 2 * f * cos(th) / TIMES;
      sine += 2 * f * sin(th) / TIMES;
    }
    const size_t j = 2 * (size_t)h;
    const double off = hypot(cosine - entry(one, "harmonics", j - 1) * 1e-6, sine - entry(one, "harmonics", j) * 1e-6),
                 folds = (entry(sampled, "folds", j) + entry(sampled, "folds", j + 1)) * 1e-9;
    CHECK_LE(off, (1 + 3 * 0.65) * folds + 2e-4, "harmonic %d", h);
  }
  json_decref(data);
}

/* The branch on which the contact works ends at 8.877 with H = 1, and with H = 3 it is there at 8.9: Newton, started on
 * that solution, finds a motion that touches with 16 samples and with no more, an accident of sampling. */
static void sampling_gains_a_branch_that_truncation_lost(CHECK_STATE)
{
  json_t *data = data_of_page(CASE2 " -q --harmonics 1 --samples 32 --at 8,8.9");
  const json_t *lost = state_of(data, 0, 1), *kept = state_of(data, 1, 1),
               *few = json_array_get(json_object_get(lost, "sampled"), 0),
               *many = json_array_get(json_object_get(lost, "sampled"), 8);
  assert_false(json_is_true(json_object_get(lost, "touches")));
  assert_true(json_is_true(json_object_get(kept, "touches")));
  assert_true(json_is_true(json_object_get(few, "touches")));
  assert_false(json_is_true(json_object_get(many, "touches")));
  json_decref(data);
}

static void hostile_titles_are_text(CHECK_STATE)
{
  char *page =
      page_of(CASE2 SMALL "--set 'title=</script></title><b>x</b>{{data}}&' --set 'units.length=</scr'", 0, NULL);
  count(page, "</script>", 3);
  count(page, "</title>", 1);
  assert_null(strstr(page, "<b>x</b>"));
  assert_null(strstr(page, "</scr\"")); /* the unit, in the data block */
  assert_non_null(
      strstr(page, "href=\"lab.html#case=title%3A%20%22%3C%2Fscript%3E%3C%2Ftitle%3E%3Cb%3E")); /* the lab's address */
  assert_non_null(strstr(page, "<h1>&lt;/script&gt;&lt;/title&gt;&lt;b&gt;x&lt;/b&gt;{{data}}&amp;</h1>"));
  json_t *data = data_of(page);
  assert_string_equal(json_string_value(json_object_get(json_object_get(data, "units"), "length")), "</scr");
  json_decref(data);
  free(page);
}

/* Without contacts, and where they do nothing, there is nothing to alias; a page comes all the same. */
static void linear_cases_have_a_page(CHECK_STATE)
{
  static const char *const args[] = {CASE2 SMALL "--set contacts=[]", CASE2 SMALL "--set forcing.amplitude=0.001"};
  for (size_t i = 0; i < sizeof args / sizeof *args; ++i) {
    json_t *data = data_of_page(args[i]);
    assert_true(json_is_null(json_object_get(data, "aliasing")));
    json_decref(data);
  }
}

/* The area that a loop encloses, by the trapezoidal rule. */
static double area(const json_t *loop)
{
  const json_t *x = json_object_get(loop, "x"), *y = json_object_get(loop, "y");
  double sum = 0;
  for (size_t i = 1; i < json_array_size(x); ++i)
    sum += 0.5 * (json_number_value(json_array_get(y, i)) + json_number_value(json_array_get(y, i - 1))) *
           (json_number_value(json_array_get(x, i)) - json_number_value(json_array_get(x, i - 1)));
  return sum;
}

/* The loop of a slider that slips encloses the work that is told; chords cut what lies between two of 240 samples at
 * each of its four corners, (2 pi/240)^2/2 of the amplitude at the most: 1.4e-3 in all of a loop as wide as that, and
 * this one's slip is a third of its width. A structure has no section on aliasing, one degree of freedom no other
 * responses. */
static void a_structure_shows_its_shape_and_its_loops(CHECK_STATE)
{
  char *page = page_of("cases/structures/jenkins2.yaml -q --set contacts[0].friction=0.3 --set hbm.harmonics=auto "
                       "--at 25.9 --harmonics 5 --samples 64",
                       0, NULL);
  json_t *data = data_of(page), *structure = json_object_get(data, "structure"),
         *solution = json_array_get(json_object_get(structure, "solutions"), 0),
         *loop = json_array_get(json_object_get(solution, "loops"), 0);
  assert_int_equal(json_array_size(json_object_get(structure, "responses")), 1);
  assert_string_equal(json_string_value(json_array_get(json_object_get(structure, "dofs"), 1)), "root");
  assert_string_equal(json_string_value(json_object_get(loop, "of")), "T over u");
  const double work = json_number_value(json_object_get(loop, "work"));
  CHECK_LE(1e-3, work, "it slips");
  CHECK_LE(fabs(area(loop) - work), 5e-3 * work, "area %g, work %g", area(loop), work);
  const json_t *first = json_array_get(json_object_get(json_object_get(data, "response"), "transient"), 0);
  const double amplitude = json_number_value(json_array_get(json_object_get(solution, "amplitude"), 0)),
               transient = json_number_value(json_object_get(first, "amplitude"));
  CHECK_LE(fabs(amplitude - transient), 1e-3 * transient, "the tip's bar and its transient");
  assert_non_null(strstr(page, "<body class=\"structure\">"));
  assert_non_null(strstr(page, "<th scope=\"col\">damping_<wbr>stuck</th>"));
  assert_non_null(strstr(page, "<th scope=\"col\">transient_<wbr>work</th>"));
  assert_int_equal(json_array_size(json_object_get(data, "accuracy")), 2); /* exact, and 64 samples */
  assert_true(json_is_null(json_object_get(data, "aliasing")));
  assert_null(strstr(page, "lab.html#")); /* the lab has no structures */
  json_decref(data);
  free(page);
}

/* The curve with harmonic 0 dropped, which would drop a static load too, and with it what presses the contact. */
static void without_harmonic_0_only_what_is_comparable(CHECK_STATE)
{
  static const char *const cases[] = {"tangent_normal_F50.yaml --at 32",
                                      "jenkins2.yaml --at 25.9 --set contacts[0].friction=0.3 --set hbm.harmonics=15"};
  for (int i = 0; i < 2; ++i) {
    char args[160];
    snprintf(args, sizeof args, "cases/structures/%s -q --harmonics 5 --samples 64", cases[i]);
    json_t *data = data_of_page(args);
    assert_int_equal(json_object_size(json_object_get(json_object_get(data, "response"), "turned")) > 0, i);
    json_decref(data);
  }
}

/* A page of these settings holds these words. */
static void expect_words(const char *args, int code, const char *const *words)
{
  char *page = page_of(args, code, NULL);
  for (; *words; ++words)
    if (!strstr(page, *words)) fail_msg("%s: the page does not say '%s'", args, *words);
  free(page);
}

static void cycles_are_spoken_where_the_sweep_is_in_cycles(CHECK_STATE)
{
  static const char *const words[] = {
      "\"cycles\":true", "<th scope=\"col\">at frequency</th>", "Largest error at frequency = 1.2 (omega = 7.5398",
      /* of the budget, of the curve's events */
      "<th scope=\"col\">omega</th><th scope=\"col\">frequency</th><th scope=\"col\">branch",
      "<th scope=\"col\">omega</th><th scope=\"col\">frequency</th><th scope=\"col\">amplitude", "--at 1,1.2", NULL};
  expect_words(CASE2 " --set sweep.frequency=0.5,3.2 --at 1,1.2 --harmonics 1,5 --samples 32 -q", 0, words);
}

/* Preloaded so much that the slider never slips: where it rests is a matter of history. */
static void what_is_not_unique_is_said(CHECK_STATE)
{
  static const char *const words[] = {"2 rows without a mean to compare (<code>mean_free</code>)",
                                      "not compared: a matter of history",
                                      "\"mean_free\":[\"yes\"",
                                      "\"mean_free\":true",
                                      "<strong>Linear.</strong> nothing nonlinear was compared",
                                      NULL};
  expect_words(CASE2 SMALL "--set contacts[0].gap=100", 0, words);
}

/* Exact forces are not advised to who has them. */
static void advice_on_samples_knows_the_forces_in_use(CHECK_STATE)
{
  static const char *const in_use[] = {"Sampling: not even 32 samples", "the exact forces in use need none.", NULL},
                           *const advised[] = {"Sampling: not even 32 samples", ": use exact forces.", NULL};
  expect_words(CASE2 " --at 8 --harmonics 5 --samples 32 -q", 0, in_use);
  expect_words(CASE2 " --at 8 --harmonics 5 --samples 32 -q --set hbm.force=sampled --set hbm.samples=64", 0, advised);
}

/* Exit codes are compare's; a page that could not be written leaves what was there. */
static void failures_touch_no_file(CHECK_STATE)
{
  assert_int_equal(system("mkdir $D/old"), 0);
  folder_put("old/page.html", "before");
  expect("report " CASE2 " --set hbm.harmonics=0 -o $D/old/page.html 2>&1", 2, "hbm.harmonics");
  expect("report " CASE2 " --format csv -o $D/old/page.html 2>&1", 64, "HTML");
  char *text = folder_read("old/page.html", NULL);
  assert_string_equal(text, "before");
  free(text);
  shell_read("ls -A $D/old", out, sizeof out);
  assert_string_equal(out, "page.html\n"); /* nothing else was left */
  expect("report " CASE2 SMALL "-o /nonexistent/page.html 2>&1", 3, "/nonexistent/page.html: No such file");
  expect("report 2>&1", 64, "CASE");
  expect("report --help", 0, "example");
}

/* Without harmonic 0 case 2 is far off: the page says so, names the cure, and the exit code is compare's. */
static void disagreement_is_said(CHECK_STATE)
{
  static const char *const words[] = {"They do not agree.", "use hbm.static: true", "no number of harmonics mends it",
                                      NULL};
  expect_words(CASE2 SMALL "--set hbm.static=false", 1, words);
}

/* Built without Chart.js, the command names what is missing. */
static void missing_charts_are_named(CHECK_STATE) { expect("report " CASE2 " 2>&1", 64, "libjs-chart.js"); }

CHECK_ENTRY_FUNCTION
{
  check_watchdog(600);
  return HAVE_CHARTJS
             ? CHECK_RUN("compare_report.page", folder_make, folder_remove, page_is_small_and_complete,
                         sampled_mean_is_what_folds_onto_it, harmonics_are_those_of_the_force_that_is_drawn,
                         sampling_gains_a_branch_that_truncation_lost, hostile_titles_are_text,
                         a_long_table_of_special_points_is_closed, a_structure_shows_its_shape_and_its_loops,
                         without_harmonic_0_only_what_is_comparable, linear_cases_have_a_page, failures_touch_no_file,
                         disagreement_is_said, cycles_are_spoken_where_the_sweep_is_in_cycles,
                         what_is_not_unique_is_said, advice_on_samples_knows_the_forces_in_use)
             : CHECK_RUN("compare_report.page", NULL, NULL, missing_charts_are_named);
}
