/* test_results.c - what the C API hands over is what the command prints as json: every table, row, column and remark,
 * numbers to the last bit, whatever the command; and what is for programs alone. */
#include <jansson.h>

#include "tests/folder.h"
#include "tests/library/case2.h"
#include "tests/shell.h"

#define CASES  SOURCE_DIR "/cases/"
#define CHAIN  CASES "structures/chain3.yaml"
#define PAPER  CASES "paper/case2.yaml"
#define VERIFY CASES "verify/case2.yaml"
#define CURVE  CASES "verify/no_static.csv"

typedef struct command_line {
  const char *command, *path;
  const char *options[CASE2_MOST_SET + 1]; /* up to a NULL */
} command_line;

/* Every command; oscillators, structures in a line and in space, cycles, all verdicts' sides, rows that failed, a curve
 * that stops, frequencies outside the sweep, a case and options that are wrong. */
static const command_line lines[] = {
    {"frf", PAPER, {"--set=hbm.harmonics=auto", "--set=hbm.accuracy=1e-3"}},
    {"frf", PAPER, {"--at=8", "--set=hbm.force=sampled", "--set=hbm.harmonics=5", "--contacts"}},
    {"frf", PAPER, {"--at", "2.5", "--verbose"}},
    {"frf", PAPER, {"--set=hbm.continuation=fixed_step", "--set=hbm.step=1", "--set=hbm.iterations=1"}},
    {"frf",
     PAPER,
     {"--set=sweep.omega=8.5,3", "--set=hbm.harmonics=1", "--set=hbm.static=false",
      "--set=contacts[0].normal_stiffness=1e7"}},
    {"frf", CHAIN, {"--contacts", "--set=sweep.frequency=0.19,0.32"}},
    {"frf", CASES "structures/space.yaml", {"--at=12.5", "--contacts"}},
    {"transient", PAPER, {"--at=5.11,5.3,8"}},
    {"transient",
     PAPER,
     {"--at=8", "--set=transient.start=rest", "--set=transient.max_periods=2", "--set=transient.steady_state=march"}},
    {"transient", CHAIN, {"--at=1.2,1.485", "--contacts", "--response=2"}},
    {"transient", PAPER, {NULL}},
    {"compare", PAPER, {"--at=6,8", "--set=hbm.harmonics=20"}},
    {"compare", PAPER, {"--at=6.5,8", "--set=hbm.static=false"}},
    {"compare", PAPER, {"--at=6,12", "--set=hbm.continuation=natural"}},
    {"compare", PAPER, {"--at=8", "--harmonics=3", "--samples=32"}},
    {"compare", CHAIN, {"--at=1.485", "--contacts"}},
    {"modes", CHAIN, {NULL}},
    {"modes", CASES "paper/case2.yaml", {"--count=1"}},
    {"verify", VERIFY, {"--against=" CURVE, "--columns=omega=1,harmonic_1=2"}},
    {"verify", VERIFY, {"--against=" CURVE, "--columns=omega=1,harmonic_9=2"}},
    {"verify", VERIFY, {NULL}},
    {"advise", PAPER, {"--at=8", "--error=1e-2"}},
    {"prove", PAPER, {"--at=9"}},
    {"gate", CASES "structures/jenkins2.yaml", {NULL}},
    {"contact", PAPER, {"--motion=0,8,0", "--samples=64"}},
    {"contact", CHAIN, {"--contact=wall", "--motion-u=0,1,0"}},
    {"frf", CHAIN, {"--response=4"}},
    {"frf", PAPER, {"--at=800"}},
};

/* In the table's column of that name: the same number, text, or nothing. */
static void check_value(const hbmcheck_table *t, int row, const char *name, const json_t *said, const char *where)
{
  const char *text = hbmcheck_table_text(t, row, name);
  const double number = hbmcheck_table_number(t, row, name);
  if (!strcmp(name, "seconds")) return; /* of another run */
  if (json_is_string(said)) {
    if (!text || strcmp(text, json_string_value(said)) != 0)
      fail_msg("%s, row %d: %s is '%s', expected '%s'", where, row, name, text ? text : "", json_string_value(said));
  } else if (json_is_null(said)) {
    if (text || isfinite(number)) fail_msg("%s, row %d: %s is there", where, row, name);
  } else if (!(fabs(number - json_number_value(said)) <= 1e-12 * fabs(number))) /* another run rounds otherwise */
    fail_msg("%s, row %d: %s is %.17g, expected %.17g", where, row, name, number, json_number_value(said));
}

static void check_table(const hbmcheck_table *t, const json_t *rows, const json_t *notes, const char *where)
{
  size_t i;
  json_t *row, *value, *note;
  const char *name;
  if (!t) fail_msg("%s: no table", where);
  const bool more = !strcmp(hbmcheck_table_title(t), "Hypotheses"); /* the command shows the best */
  assert_in_range(hbmcheck_table_rows(t), json_array_size(rows), more ? 1000 : json_array_size(rows));
  json_array_foreach(rows, i, row) json_object_foreach(row, name, value) check_value(t, (int)i, name, value, where);
  json_array_foreach(notes, i, note)
  {
    const char *remark = hbmcheck_table_remark(t, (int)i);
    if (!remark || strcmp(remark, json_string_value(note)) != 0)
      fail_msg("%s: '%s', expected '%s'", where, remark ? remark : "", json_string_value(note));
  }
  assert_null(hbmcheck_table_remark(t, (int)json_array_size(notes)));
}

/* What the command's json has is in the result; tables for programs are not in json. */
static void check_tables(const hbmcheck_result *r, const json_t *said, const char *where)
{
  const json_t *notes = json_object_get(said, "notes"), *rows = json_object_get(said, "rows");
  const char *title;
  json_t *value;
  if (rows) {
    check_table(hbmcheck_result_table(r, 0), rows, notes, where);
    return;
  }
  json_object_foreach((json_t *)said, title, value) if (value != notes)
      check_table(table_titled(r, title), value, json_object_get(notes, title), where);
}

/* What depends on the time that a run takes: what it is foretold to take, and what it has found until then. */
static bool is_of_time(const char *words)
{
  return words && (strstr(words, "takes about") || strstr(words, "so far: "));
}

/* Lines of standard error, without the command's name. */
static void check_remarks(const hbmcheck_result *r, const command_line *of, char *said, const char *where)
{
  char prefix[64];
  int i = 0;
  snprintf(prefix, sizeof prefix, "hbmcheck %s: ", of->command);
  for (char *line = strtok(said, "\n"); line; line = strtok(NULL, "\n")) {
    const char *words = strncmp(line, prefix, strlen(prefix)) ? line : line + strlen(prefix);
    if (is_of_time(words)) continue;
    while (is_of_time(hbmcheck_result_remark(r, i))) ++i;
    const char *remark = hbmcheck_result_remark(r, i++);
    if (!remark || strcmp(remark, words) != 0) fail_msg("%s: '%s', expected '%s'", where, remark ? remark : "", words);
  }
  while (is_of_time(hbmcheck_result_remark(r, i))) ++i;
  assert_null(hbmcheck_result_remark(r, i));
}

static void as_the_command_says(CHECK_STATE)
{
  enum { SIZE = 1 << 20 };
  char *said = malloc(SIZE), line[1024];
  for (size_t k = 0; k < sizeof lines / sizeof *lines; ++k) {
    const command_line *of = &lines[k];
    int used = snprintf(line, sizeof line, "$H %s %s --format json 2>$D/remarks", of->command, of->path);
    for (int i = 0; of->options[i]; ++i)
      used += snprintf(line + used, sizeof line - (size_t)used, " '%s'", of->options[i]);
    const int code = shell_read(line, said, SIZE);
    char *remarks = folder_read("remarks", NULL);
    json_t *found = *said ? json_loads(said, 0, NULL) : NULL;
    CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(of->path, 0, NULL, NULL, 0, &c));
    hbmcheck_result *r;
    const hbmcheck_status st = run_with(c, of->command, NULL, &r, of->options);
    hbmcheck_case_free(c); /* results do not need it any more */
    if (hbmcheck_result_exit_code(r) != code) fail_msg("%s: exit %d", line, hbmcheck_result_exit_code(r));
    assert_int_equal(st == HBMCHECK_BAD_INPUT, code == 2 || code == 64);
    if (code < 2) assert_int_equal(st, HBMCHECK_OK);
    if (found) check_tables(r, found, line);
    else assert_null(hbmcheck_result_table(r, 0));
    check_remarks(r, of, remarks, line);
    hbmcheck_result_free(r);
    json_decref(found);
    free(remarks);
  }
  free(said);
}

/* x of a response by its coefficients has its measures; a wave has those of its row. */
static void series_make_the_measures(CHECK_STATE)
{
  double X[401], x[4096];
  hbmcheck_result *r;
  CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(CHAIN, 0, NULL, NULL, 0, &c));
  assert_int_equal(RUN(c, "frf", NULL, &r, "--at=1.9"), HBMCHECK_OK);
  const hbmcheck_table *t = table_titled(r, "Response curve");
  assert_int_equal(hbmcheck_table_rows(t), 3);
  for (int i = 0; i < 3; ++i) {
    const int n = hbmcheck_table_numbers(t, i, "coefficients", 401, X);
    assert_int_equal(n, 2 * (int)hbmcheck_table_number(t, i, "harmonics") + 1);
    assert_true(X[0] == hbmcheck_table_number(t, i, "mean"));
    assert_true(hypot(X[1], X[2]) == hbmcheck_table_number(t, i, "harmonic_1"));
    X[1] = 77;
    assert_int_equal(hbmcheck_table_numbers(t, i, "coefficients", 1, X), n);
    assert_true(X[1] == 77);
  }
  hbmcheck_result_free(r);
  assert_int_equal(RUN(c, "transient", NULL, &r, "--at=1.9"), HBMCHECK_OK);
  t = table_titled(r, "Steady states");
  for (int i = 0; i < 3; ++i) {
    const int n = hbmcheck_table_numbers(t, i, "wave", 4096, x);
    double most = -INFINITY;
    assert_in_range(n, 256, 4096);
    for (int k = 0; k < n; ++k) most = fmax(most, x[k]);
    CHECK_LE(fabs(most / hbmcheck_table_number(t, i, "max") - 1), 1e-3, "of %d samples", n);
    assert_string_equal(hbmcheck_table_text(t, i, "status"), "ok");
  }
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
}

/* Of a sub-harmonic, too: what is in csv and json by one line of rows.c is here. */
static void the_period_is_that_of_the_motion(CHECK_STATE)
{
  hbmcheck_result *r;
  hbmcheck_case *c = CASE2("hbm.harmonics=10");
  double multiples = 0;
  assert_int_equal(RUN(c, "transient", NULL, &r, "--at=5.11,8"), HBMCHECK_OK);
  const hbmcheck_table *t = hbmcheck_result_table(r, 0);
  for (int i = 0; i < hbmcheck_table_rows(t); ++i) {
    const double multiple = hbmcheck_table_number(t, i, "period_multiple");
    const double period = hbmcheck_table_number(t, i, "period") * hbmcheck_table_number(t, i, "omega");
    multiples = fmax(multiples, multiple);
    CHECK_NEAR(period, TWO_PI * multiple, 8 * 0x1p-52 * multiple, "row %d", i);
  }
  assert_true(multiples == 4);
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
}

/* Two turns and two changes of the contact; the summary counts what is there. */
static void a_curve_has_special_points_and_a_summary(CHECK_STATE)
{
  hbmcheck_result *r;
  hbmcheck_case *c = CASE2("hbm.harmonics=7");
  assert_int_equal(RUN(c, "frf", NULL, &r, NULL), HBMCHECK_OK);
  const hbmcheck_table *points = hbmcheck_result_table(r, 0), *special = table_titled(r, "Special points"),
                       *whole = table_titled(r, "Curve");
  int turns = 0;
  const int n = hbmcheck_table_rows(special);
  assert_in_range(n, 4, 32);
  for (int i = 0; i < n; ++i) {
    turns += !strcmp(hbmcheck_table_text(special, i, "kind"), "turning point");
    assert_non_null(hbmcheck_table_text(special, i, "before"));
  }
  assert_int_equal(turns, hbmcheck_table_number(whole, 0, "turning_points"));
  assert_int_equal(hbmcheck_table_rows(points), hbmcheck_table_number(whole, 0, "points"));
  double amplitude[512], most = 0;
  const int rows = hbmcheck_table_numbers(points, -1, "amplitude", 512, amplitude);
  assert_int_equal(rows, hbmcheck_table_rows(points));
  for (int i = 0; i < rows; ++i) {
    assert_true(amplitude[i] == hbmcheck_table_number(points, i, "amplitude"));
    most = fmax(most, amplitude[i]);
  }
  CHECK_LE(most, hbmcheck_table_number(whole, 0, "peak_amplitude") * (1 + 1e-9), "the peak is the largest");
  assert_true(hbmcheck_table_number(whole, 0, "reached_end") == 1 &&
              hbmcheck_table_number(whole, 0, "inaccurate") == 0);
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
}

/* Agreement; without the mean, a difference; no solution past the fold: what the gate's command makes of the same. */
static void a_comparison_has_the_gates_numbers(CHECK_STATE)
{
  const struct {
    const char *at, *set;
    int code;
  } runs[] = {{"--at=6,8", "hbm.harmonics=20", 0},
              {"--at=6.5,8", "hbm.static=false", 1},
              {"--at=6,12", "hbm.continuation=natural", 3}};
  for (int k = 0; k < 3; ++k) {
    hbmcheck_result *both, *gate;
    hbmcheck_case *c = CASE2("hbm.harmonics=10", runs[k].set);
    assert_int_equal(RUN(c, "compare", NULL, &both, runs[k].at), HBMCHECK_OK);
    assert_int_equal(RUN(c, "gate", NULL, &gate, runs[k].at), HBMCHECK_OK);
    const hbmcheck_table *t = table_titled(both, "Gate"), *checks = hbmcheck_result_table(gate, 0);
    int failed = 0;
    for (int i = 0; i < hbmcheck_table_rows(checks); ++i)
      failed += !strcmp(hbmcheck_table_text(checks, i, "result"), "fail");
    assert_int_equal(hbmcheck_table_number(t, 0, "checks"), hbmcheck_table_rows(checks));
    assert_int_equal(hbmcheck_table_number(t, 0, "failed"), failed);
    assert_int_equal(hbmcheck_table_number(t, 0, "exit_code"), hbmcheck_result_exit_code(gate));
    assert_int_equal(hbmcheck_result_exit_code(gate), runs[k].code);
    assert_false(isnan(hbmcheck_table_number(hbmcheck_result_table(both, 0), 0, "multiplier")));
    hbmcheck_result_free(both);
    hbmcheck_result_free(gate);
    hbmcheck_case_free(c);
  }
}

/* Arrays in the place of a file and of fields: the same answer to the bit; points at omega <= 0 are left out. */
static void arrays_are_taken_as_files_are(CHECK_STATE)
{
  hbmcheck_result *r;
  char words[512];
  hbmcheck_case *c = CASE2("sweep.omega=3,6");
  const double omega[] = {3.5, 4, 4.5}, mass[] = {2}, at[] = {4.5, 3.5};
  assert_int_equal(hbmcheck_case_give(c, "compare.omega", 1, 2, at, words, sizeof words), HBMCHECK_OK);
  assert_int_equal(RUN(c, "transient", NULL, &r, NULL), HBMCHECK_OK);
  assert_int_equal(rows_of(r), 2);
  hbmcheck_result_free(r);
  double values[8] = {3.5, 0, 4, 4.5};
  for (int i = 0; i < 3; ++i) {
    char option[32];
    snprintf(option, sizeof option, "--at=%g", omega[i]);
    assert_int_equal(RUN(c, "frf", NULL, &r, option), HBMCHECK_OK);
    values[4 + i + (i > 0)] = 20 * log10(hbmcheck_table_number(hbmcheck_result_table(r, 0), 0, "amplitude"));
    hbmcheck_result_free(r);
  }
  assert_int_equal(hbmcheck_case_give(c, "against", 2, 4, values, NULL, 0), HBMCHECK_OK);
  assert_int_equal(RUN(c, "verify", NULL, &r, "--quantity=dB"), HBMCHECK_OK);
  const hbmcheck_table *points = hbmcheck_result_table(r, 0), *summary = table_titled(r, "Summary");
  assert_string_equal(hbmcheck_table_text(summary, 0, "cause"), "none");
  assert_int_equal(hbmcheck_table_number(summary, 0, "left_out"), 1);
  assert_int_equal(hbmcheck_table_rows(points), 3);
  CHECK_NEAR(hbmcheck_table_number(points, 1, "value"), values[6], 1e-12, "some roundings of 20 dB");
  assert_int_equal(hbmcheck_table_number(points, 1, "line"), 3); /* the third point */
  hbmcheck_result_free(r);
  /* A matrix: of a structure, as text or as numbers. */
  CHECK_MADE(hbmcheck_case, chain, hbmcheck_case_read(CHAIN, 0, NULL, NULL, 0, &chain));
  const double M[] = {1, 0, 0, 0, 1.0 / 3, 0, 0, 0, 1};
  hbmcheck_result *by_text;
  assert_int_equal(
      RUN(chain, "modes", NULL, &by_text, "--set=structure.mass=[[1,0,0],[0,0.33333333333333331,0],[0,0,1]]"),
      HBMCHECK_OK);
  assert_int_equal(hbmcheck_case_give(chain, "structure.mass", 3, 3, M, words, sizeof words), HBMCHECK_OK);
  assert_int_equal(RUN(chain, "modes", NULL, &r, NULL), HBMCHECK_OK);
  for (int i = 0; i < 3; ++i)
    assert_true(hbmcheck_table_number(hbmcheck_result_table(r, 0), i, "omega_open") ==
                hbmcheck_table_number(hbmcheck_result_table(by_text, 0), i, "omega_open"));
  hbmcheck_result_free(by_text);
  hbmcheck_result_free(r);
  /* What is none leaves the case as it was. */
  assert_int_equal(hbmcheck_case_give(chain, "structure.mass", 2, 3, M, words, sizeof words), HBMCHECK_BAD_INPUT);
  assert_non_null(strstr(words, "structure.mass"));
  assert_int_equal(hbmcheck_case_give(chain, "structure.mas", 3, 3, M, words, sizeof words), HBMCHECK_BAD_INPUT);
  assert_int_equal(hbmcheck_case_give(chain, "against", 3, 3, M, words, sizeof words), HBMCHECK_BAD_INPUT);
  assert_int_equal(RUN(chain, "modes", NULL, &r, NULL), HBMCHECK_OK);
  hbmcheck_result_free(r);
  assert_int_equal(hbmcheck_case_give(c, "oscillator.mass", 1, 1, mass, words, sizeof words), HBMCHECK_BAD_INPUT);
  hbmcheck_case_free(chain);
  hbmcheck_case_free(c);
}

static void responses_and_contacts_have_names(CHECK_STATE)
{
  hbmcheck_result *r;
  CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(CASES "structures/space.yaml", 0, NULL, NULL, 0, &c));
  assert_int_equal(RUN(c, "names", NULL, &r, NULL), HBMCHECK_OK);
  const hbmcheck_table *contacts = table_titled(r, "Contacts");
  assert_int_equal(hbmcheck_table_rows(contacts), 1);
  assert_string_equal(hbmcheck_table_text(contacts, 0, "name"), "foot");
  assert_int_equal(hbmcheck_table_number(contacts, 0, "tangents"), 2);
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
  c = CASE2(NULL);
  assert_int_equal(RUN(c, "names", NULL, &r, NULL), HBMCHECK_OK);
  assert_string_equal(hbmcheck_table_text(table_titled(r, "Responses"), 0, "response"), "x");
  assert_string_equal(hbmcheck_table_text(table_titled(r, "Contacts"), 0, "name"), "0");
  assert_int_equal(hbmcheck_table_number(table_titled(r, "Contacts"), 0, "tangents"), 1);
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
}

/* Every column of every command's rows says what it is. */
static void columns_have_units_and_meanings(CHECK_STATE)
{
  static const command_line of[] = {{"frf", CHAIN, {"--at=1.9", "--contacts"}},
                                    {"transient", CHAIN, {"--at=1.9", "--contacts"}},
                                    {"compare", CHAIN, {"--at=1.9", "--contacts"}},
                                    {"prove", PAPER, {"--at=9"}}};
  int reals = 0;
  for (size_t k = 0; k < sizeof of / sizeof *of; ++k) {
    hbmcheck_result *r;
    CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(of[k].path, 0, NULL, NULL, 0, &c));
    assert_int_equal(run_with(c, of[k].command, NULL, &r, of[k].options), HBMCHECK_OK);
    for (int i = 0; i < 1 + (k < 3); ++i) {
      hbmcheck_column column = {.size = sizeof column};
      const hbmcheck_table *t = hbmcheck_result_table(r, i);
      for (int j = 0; hbmcheck_table_column(t, j, &column) == HBMCHECK_OK; ++j) {
        if (!*column.meaning) fail_msg("%s: %s has no meaning", of[k].command, column.name);
        if (column.kind == HBMCHECK_REAL && !*column.unit) fail_msg("%s: %s has no unit", of[k].command, column.name);
        reals += column.kind == HBMCHECK_REAL;
      }
    }
    hbmcheck_result_free(r);
    hbmcheck_case_free(c);
  }
  assert_true(reals > 80);
}

/* `reduce` writes its folder, and what is there is read. */
static void a_reduction_is_written(CHECK_STATE)
{
  char path[128], option[128];
  hbmcheck_result *r;
  CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(CASES "meshes/blade.yaml", 0, NULL, NULL, 0, &c));
  snprintf(option, sizeof option, "--output=%s/reduced", folder);
  assert_int_equal(RUN(c, "reduce", NULL, &r, "--modes=4", option), HBMCHECK_OK);
  assert_int_equal(hbmcheck_table_number(hbmcheck_result_table(r, 0), 0, "modes"), 4);
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
  snprintf(path, sizeof path, "%s/reduced/blade.yaml", folder);
  assert_int_equal(hbmcheck_case_read(path, 0, NULL, NULL, 0, &c), HBMCHECK_OK);
  hbmcheck_case_free(c);
}

/* The same case from a file, from memory, and what is wrong with it in words. */
static void cases_and_messages(CHECK_STATE)
{
  const char *const set[] = {"hbm.harmonic=3"};
  char message[512], cut[9];
  CHECK_MADE(hbmcheck_case, c, hbmcheck_case_read(PAPER, 0, NULL, message, sizeof message, &c));
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

CHECK_TESTS_WITH("library.results", 300, folder_make, folder_remove, as_the_command_says, series_make_the_measures,
                 the_period_is_that_of_the_motion, a_curve_has_special_points_and_a_summary,
                 a_comparison_has_the_gates_numbers, arrays_are_taken_as_files_are, responses_and_contacts_have_names,
                 columns_have_units_and_meanings, a_reduction_is_written, cases_and_messages, version)
