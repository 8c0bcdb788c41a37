/* test_table.c - the three formats, byte for byte; csv and json give back every double bit for bit. */
#include <jansson.h>
#include <locale.h>

#include "compare/output/table_private.h"
#include "numerics/base/utf8.h"
#include "numerics/random.h"
#include "tests/check.h"

static const table_column columns[] = {
    {"omega", TABLE_REAL}, {"verdict", TABLE_TEXT}, {"steps", TABLE_INTEGER}, {"error", TABLE_REAL}};
static const table_column one_real[] = {{"value", TABLE_REAL}};
static const table_column two_texts[] = {{"a", TABLE_TEXT}, {"b", TABLE_TEXT}};

/* What table_write writes; free() it. */
static char *written(int n, table *const *tables, table_format format)
{
  char *text = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&text, &size);
  assert_non_null(to);
  assert_int_equal(table_write(n, tables, format, to), HC_OK);
  assert_int_equal(fclose(to), 0);
  assert_true(uselocale((locale_t)0) == LC_GLOBAL_LOCALE); /* as it was */
  return text;
}

static void expect(int n, table *const *tables, table_format format, const char *expected)
{
  char *text = written(n, tables, format);
  assert_string_equal(text, expected);
  free(text);
}

static void put(table *t, double omega, const char *verdict, long steps, double error)
{
  table_put_real(t, omega);
  table_put_text(t, verdict);
  table_put_integer(t, steps);
  table_put_real(t, error);
}

static table *small_table(const char *title)
{
  table *t = table_new(title, 4, columns);
  put(t, 5, "match", 1200, 1.25e-6);
  put(t, 12.5, "not, \"yet\"", -7, NAN);
  table_put_missing(t);
  table_put_text(t, NULL);
  table_put_missing(t);
  table_put_real(t, -INFINITY);
  table_note(t, "%d of %s, tolerance %.1e", 2, "3", 0.05);
  return t;
}

/* Left out on the screen, kept for machines; the last one shown ends the line. */
static void hidden_columns_are_for_machines(CHECK_STATE)
{
  table *t = table_new(NULL, 4, columns);
  put(t, 5, "match", 1200, 1.25e-6);
  table_hide(t, "error");
  table_hide(t, "omega");
  table_hide(t, "no such column");
  expect(1, &t, FORMAT_TABLE, "verdict  steps\nmatch     1200\n");
  expect(1, &t, FORMAT_CSV, "omega,verdict,steps,error\n5,match,1200,1.2500000000000001e-06\n");
  table_free(t);
}

/* Lines too long lose what can be spared, the empty ones and then the first ones first, and say so; what is left is
 * broken into blocks that begin with the first column; --wide has all of it, csv always. */
static void lines_fit_the_screen(CHECK_STATE)
{
  static const char *const spare[] = {"verdict", "error", "no such column", NULL}, *const none[] = {NULL};
  table *t = table_new(NULL, 4, columns);
  put(t, 5, "match", 1200, 1.25e-6);
  put(t, 6, "match", 1300, NAN);
  table_spare(t, spare);
  expect(1, &t, FORMAT_TABLE,
         "omega  verdict  steps       error\n    5  match     1200  0.00000125\n    6  match     1300\n");
  table_fit(t, 33); /* as long as the longest line */
  expect(1, &t, FORMAT_TABLE,
         "omega  verdict  steps       error\n    5  match     1200  0.00000125\n    6  match     1300\n");
  table_fit(t, 32);
  expect(
      1, &t, FORMAT_TABLE,
      "omega  steps       error\n    5   1200  0.00000125\n    6   1300\n\n3 of 4 columns shown; --wide shows all\n");
  expect(1, &t, FORMAT_CSV, "omega,verdict,steps,error\n5,match,1200,1.2500000000000001e-06\n6,match,1300,\n");
  table_spare(t, none);
  expect(1, &t, FORMAT_TABLE,
         "omega  verdict  steps\n    5  match     1200\n    6  match     1300\n"
         "\n"
         "omega       error\n    5  0.00000125\n    6\n");
  table_fit(t, 3); /* nothing is that narrow: two columns a block */
  expect(1, &t, FORMAT_TABLE,
         "omega  verdict\n    5  match\n    6  match\n\nomega  steps\n    5   1200\n    6   1300\n\n"
         "omega       error\n    5  0.00000125\n    6\n");
  table_fit(t, 0);
  table_hide(t, "omega");
  table_hide(t, "error");
  table_show_all(t);
  expect(1, &t, FORMAT_TABLE,
         "omega  verdict  steps       error\n    5  match     1200  0.00000125\n    6  match     1300\n");
  table_free(t);
}

static void empty_columns_are_spared_first(CHECK_STATE)
{
  static const char *const spare[] = {"verdict", "error", NULL};
  table *t = table_new(NULL, 4, columns);
  put(t, 5, "match", 1200, NAN);
  table_spare(t, spare);
  table_fit(t, 27);
  expect(1, &t, FORMAT_TABLE,
         "omega  verdict  steps\n    5  match     1200\n\n3 of 4 columns shown; --wide shows all\n");
  table_free(t);
}

/* Words are not broken while anything else can be narrowed, and hidden columns take no room. */
static void wrapped_columns_keep_their_words(CHECK_STATE)
{
  table *t = table_new(NULL, 2, two_texts);
  table_put_text(t, "cases/bracket.yaml");
  table_put_text(t, "one two three four five");
  table_put_text(t, "x");
  table_put_text(t, "y");
  table_put_text(t, "z");
  table_put_text(t, NULL);
  table_wrap(t, 30);
  expect(1, &t, FORMAT_TABLE,
         "a                   b\ncases/bracket.yaml  one two\n                    three four\n"
         "                    five\n\nx                   y\nz\n");
  table_hide(t, "a");
  expect(1, &t, FORMAT_TABLE, "b\none two three four five\ny\n\n");
  table_free(t);
}

static void three_formats(CHECK_STATE)
{
  table *t = small_table("Small");
  assert_int_equal(table_rows(t), 3);
  expect(1, &t, FORMAT_TABLE,
         "Small\n"
         "omega  verdict     steps       error\n"
         "  5.0  match        1200  0.00000125\n"
         " 12.5  not, \"yet\"     -7\n"
         "                                -inf\n"
         "\n"
         "2 of 3, tolerance 5.0e-02\n");
  expect(1, &t, FORMAT_CSV,
         "# 2 of 3, tolerance 5.0e-02\n"
         "omega,verdict,steps,error\n"
         "5,match,1200,1.2500000000000001e-06\n"
         "12.5,\"not, \"\"yet\"\"\",-7,\n"
         ",,,-inf\n");
  expect(1, &t, FORMAT_JSON,
         "{\n  \"rows\": [\n"
         "    {\"omega\": 5.0, \"verdict\": \"match\", \"steps\": 1200, \"error\": 1.2500000000000001e-6},\n"
         "    {\"omega\": 12.5, \"verdict\": \"not, \\\"yet\\\"\", \"steps\": -7, \"error\": null},\n"
         "    {\"omega\": null, \"verdict\": null, \"steps\": null, \"error\": null}\n"
         "  ],\n  \"notes\": [\n    \"2 of 3, tolerance 5.0e-02\"\n  ]\n}\n");
  table_free(t);
}

static void no_rows_and_no_title(CHECK_STATE)
{
  table *t = table_new(NULL, 4, columns);
  expect(1, &t, FORMAT_TABLE, "omega  verdict  steps  error\n");
  expect(1, &t, FORMAT_CSV, "omega,verdict,steps,error\n");
  expect(1, &t, FORMAT_JSON, "{\n  \"rows\": [],\n  \"notes\": []\n}\n");
  expect(0, NULL, FORMAT_TABLE, "");
  expect(0, NULL, FORMAT_CSV, "");
  expect(0, NULL, FORMAT_JSON, "{\n  \"notes\": {}\n}\n");
  table_free(t);
}

/* Titles that collide, with each other and with "notes", must not hide a table. */
static void several_tables(CHECK_STATE)
{
  table *t[4] = {small_table("A"), table_new("A", 1, one_real), table_new("notes", 1, one_real),
                 table_new(NULL, 1, one_real)};
  table_put_real(t[1], 2);
  table_put_missing(t[2]);
  char *text = written(4, t, FORMAT_JSON);
  json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
  assert_non_null(root);
  assert_int_equal(json_object_size(root), 5);
  assert_int_equal(json_array_size(json_object_get(root, "A")), 3);
  assert_true(json_real_value(json_object_get(json_array_get(json_object_get(root, "A (2)"), 0), "value")) == 2);
  assert_int_equal(json_array_size(json_object_get(root, "notes (2)")), 1);
  assert_true(json_is_array(json_object_get(root, "table")));
  json_t *notes = json_object_get(root, "notes");
  assert_int_equal(json_object_size(notes), 1);
  assert_string_equal(json_string_value(json_array_get(json_object_get(notes, "A"), 0)), "2 of 3, tolerance 5.0e-02");
  json_decref(root);
  free(text);
  expect(3, t + 1, FORMAT_CSV, "# A\nvalue\n2\n\n# notes\nvalue\n\"\"\n\n# table\nvalue\n");
  expect(2, t + 1, FORMAT_TABLE, "A\nvalue\n    2\n\nnotes\nvalue\n\n");
  for (int k = 0; k < 4; ++k) table_free(t[k]);
}

static void csv_quotes_what_a_reader_could_misread(CHECK_STATE)
{
  static const char *const pairs[][2] = {
      {"plain text", "plain text"},
      {"", "\"\""},
      {"a,b", "\"a,b\""},
      {"a\nb", "\"a\nb\""},
      {"a\rb", "\"a\rb\""},
      {"\"", "\"\"\"\""},
      {"#1", "\"#1\""},
      {"no #1", "no #1"},
      {" a", "\" a\""},
      {"a ", "\"a \""},
      {"\ta", "\"\ta\""},
      {"M\xc3\xbcller", "M\xc3\xbcller"},
  };
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
    table *t = table_new(NULL, 2, two_texts);
    table_put_text(t, "x");
    table_put_text(t, pairs[i][0]);
    char expected[64];
    snprintf(expected, sizeof expected, "a,b\nx,%s\n", pairs[i][1]);
    expect(1, &t, FORMAT_CSV, expected);
    table_free(t);
  }
}

/* A column of reals, its lines right-aligned and without the header, `|` between them. */
static void expect_reals(int n, const double *values, const char *expected)
{
  table *t = table_new(NULL, 1, one_real);
  for (int i = 0; i < n; ++i) table_put_real(t, values[i]);
  char *text = written(1, &t, FORMAT_TABLE), *rows = strchr(text, '\n') + 1;
  for (char *p = rows; *p; ++p)
    if (*p == '\n') *p = '|';
  assert_string_equal(rows, expected);
  free(text);
  table_free(t);
}
#define EXPECT_REALS(expected, ...)                                                                                    \
  expect_reals((int)(sizeof(double[]){__VA_ARGS__} / sizeof(double)), (const double[]){__VA_ARGS__}, expected)

static void reals_get_one_notation_a_column(CHECK_STATE)
{
  EXPECT_REALS("    3|   10|  200|", 3, 10, 200);
  EXPECT_REALS(" 3.00|12.25|-0.50|    0|", 3, 12.25, -0.5, -0.0);
  EXPECT_REALS("  0.1|  0.3|", 0.1, 0.1 + 0.2);
  EXPECT_REALS("  0.01|100.00|", 0.01, 100);
  EXPECT_REALS("0.3333333|6.6666667|", 1.0 / 3, 20.0 / 3);
  EXPECT_REALS("1234567|", 1234567);
  EXPECT_REALS("1.234568e+07|", 12345678.0);
  EXPECT_REALS("1.0e-12|2.5e-01|      0|", 1e-12, 0.25, 0);
  EXPECT_REALS("1.234568e-05|", 1.23456789e-5);
  EXPECT_REALS("1e+300|1e-300|   inf|  -inf||", 1e300, 1e-300, INFINITY, -INFINITY, NAN);
  EXPECT_REALS("    0|", 0);
  EXPECT_REALS("   10|", 9.99999996);
}

static void text_is_utf8_and_safe(CHECK_STATE)
{
  table *t = table_new("Stra\xc3\x9f"
                       "e\x1b[31m\n",
                       2, two_texts);
  table_put_text(t, "M\xc3\xbcller");
  table_put_text(t, "e\xcc\x81 \xe6\xa2\x81  ");
  table_put_text(t, "bad\xff\xc0\xaf\xed\xa0\x80");
  table_put_text(t, "\x1b[2J\nx");
  table_put_text(t, "abcdefgh");
  table_put_text(t, "");
  table_note(t, "two\nlines\n");
  expect(1, &t, FORMAT_TABLE,
         "Stra\xc3\x9f"
         "e [31m\n"
         "a          b\n"
         "M\xc3\xbcller     e\xcc\x81 \xe6\xa2\x81\n"
         "bad\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd   [2J x\n"
         "abcdefgh\n"
         "\n"
         "two lines\n");
  char *text = written(1, &t, FORMAT_JSON);
  json_t *root = json_loads(text, 0, NULL);
  assert_non_null(root); /* json that is not UTF-8 does not parse */
  assert_string_equal(json_string_value(json_object_get(json_array_get(json_object_get(root, "rows"), 1), "b")),
                      "\x1b[2J\nx");
  json_decref(root);
  free(text);
  table_free(t);
}

static void utf8_is_decoded_strictly(CHECK_STATE)
{
  static const struct {
    const char *text;
    unsigned code;
    int bytes;
  } part[] = {
      {"a", 'a', 1},
      {"\xc2\x80", 0x80, 2},
      {"\xe0\xa0\x80", 0x800, 3},
      {"\xf0\x90\x80\x80", 0x10000, 4},
      {"\xf4\x8f\xbf\xbf", 0x10ffff, 4},
      /* overlong */
      {"\x80", 0xfffd, 1},
      {"\xc1\xbf", 0xfffd, 1},
      {"\xe0\x9f\xbf", 0xfffd, 1},
      {"\xf0\x8f\xbf\xbf", 0xfffd, 1},
      /* not characters */
      {"\xed\xa0\x80", 0xfffd, 1},
      {"\xf4\x90\x80\x80", 0xfffd, 1},
      {"\xff", 0xfffd, 1},
      /* cut short */
      {"\xc3", 0xfffd, 1},
      {"\xe2\x82", 0xfffd, 1},
      {"\xf0\x9f\x98", 0xfffd, 1},
      {"\xc3(", 0xfffd, 1},
  };
  for (size_t i = 0; i < sizeof part / sizeof *part; ++i) {
    const char *p = part[i].text;
    assert_int_equal(utf8_next(&p), part[i].code);
    assert_int_equal(p - part[i].text, part[i].bytes);
  }
  assert_int_equal(utf8_width("M\xc3\xbcller"), 6);
  assert_int_equal(utf8_width("e\xcc\x81"), 1);        /* e, combining acute */
  assert_int_equal(utf8_width("\xe6\xa2\x81x"), 3);    /* a wide one */
  assert_int_equal(utf8_width("\xf0\x9f\x98\x80"), 2); /* an emoji */
}

/* A text of more than 60 columns goes on in the next line; the last one only where lines have a longest. */
static void long_texts_go_on_in_the_next_line(CHECK_STATE)
{
  char longest[101], expected[512];
  memset(longest, 'x', 100);
  longest[100] = 0;
  table *t = table_new(NULL, 2, two_texts);
  for (int i = 0; i < 2; ++i) table_put_text(t, longest);
  snprintf(expected, sizeof expected, "a%61sb\n%.60s  %s\n%.40s\n", "", longest, longest, longest);
  expect(1, &t, FORMAT_TABLE, expected);
  table_free(t);
}

/* What tells rows apart stands before every block: here the first two columns, for each has rows that are alike. */
static void blocks_repeat_the_keys(CHECK_STATE)
{
  static const table_column of[] = {{"omega", TABLE_REAL},
                                    {"hidden", TABLE_TEXT},
                                    {"branch", TABLE_INTEGER},
                                    {"amplitude", TABLE_REAL},
                                    {"why", TABLE_TEXT}};
  table *t = table_new(NULL, 5, of);
  for (int i = 0; i < 4; ++i) {
    const double omega[] = {1, 2, 1, 2};
    table_put_real(t, omega[i]);
    table_put_text(t, "same");
    table_put_integer(t, i / 2);
    table_put_real(t, 0.5);
    table_put_text(t, i == 2 ? "one two, three" : "four");
  }
  table_hide(t, "hidden");
  table_fit(t, 24);
  expect(1, &t, FORMAT_TABLE,
         "omega  branch  amplitude\n    1       0        0.5\n    2       0        0.5\n    1       1        0.5\n"
         "    2       1        0.5\n"
         "\n"
         "omega  branch  why\n    1       0  four\n    2       0  four\n    1       1  one two,\n               three\n"
         "\n    2       1  four\n");
  table_fit(t, 23); /* no room beside both */
  expect(1, &t, FORMAT_TABLE,
         "omega  branch\n    1       0\n    2       0\n    1       1\n    2       1\n"
         "\n"
         "omega  amplitude\n    1        0.5\n    2        0.5\n    1        0.5\n    2        0.5\n"
         "\n"
         "omega  why\n    1  four\n    2  four\n    1  one two, three\n    2  four\n");
  table_free(t);
}

enum { N_RANDOM = 20000 };

static void doubles_come_back_bit_for_bit(CHECK_STATE)
{
  double *values = calloc(N_RANDOM, sizeof *values);
  assert_non_null(values);
  /* All bit patterns are equally likely: every exponent, both signs; the first ones are the extremes. */
  static const double extreme[] = {0.0, -0.0, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 0.1, 1e23};
  const int n_extreme = (int)(sizeof extreme / sizeof *extreme);
  uint64_t s = 88172645463325252u;
  table *t = table_new(NULL, 1, one_real);
  for (int i = 0; i < N_RANDOM; ++i) {
    if (i < n_extreme) values[i] = extreme[i];
    else do {
        uint64_t bits = random_bits(&s);
        memcpy(&values[i], &bits, sizeof bits);
      } while (!isfinite(values[i]));
    table_put_real(t, values[i]);
  }
  char *csv = written(1, &t, FORMAT_CSV), *json = written(1, &t, FORMAT_JSON), *p = strchr(csv, '\n');
  json_t *root = json_loads(json, 0, NULL);
  assert_non_null(root);
  for (int i = 0; i < N_RANDOM; ++i) {
    double from_csv = strtod(p, &p);
    double from_json =
        json_real_value(json_object_get(json_array_get(json_object_get(root, "rows"), (size_t)i), "value"));
    assert_int_equal(*p, '\n');
    assert_memory_equal(&from_csv, &values[i], sizeof(double));
    assert_memory_equal(&from_json, &values[i], sizeof(double));
  }
  json_decref(root);
  free(csv);
  free(json);
  free(values);
  table_free(t);
}

static bool set_comma_locale(void)
{
  static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8",  "de_DE",       "fr_FR.UTF-8",
                                      "fr_FR",       "nl_NL.UTF-8", "es_ES.UTF-8", "ru_RU.UTF-8"};
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
    if (setlocale(LC_ALL, names[i]) && strcmp(localeconv()->decimal_point, ",") == 0) return true;
  setlocale(LC_ALL, "C");
  return false;
}

static void a_comma_locale_changes_nothing(CHECK_STATE)
{
  char *before[3], *after[3];
  for (int f = 0; f < 3; ++f) {
    table *t = small_table("Small");
    before[f] = written(1, &t, (table_format)f);
    table_free(t);
  }
  bool comma = set_comma_locale();
  for (int f = 0; f < 3; ++f) {
    table *t = small_table("Small");
    after[f] = written(1, &t, (table_format)f);
    table_free(t);
  }
  bool kept = strcmp(localeconv()->decimal_point, comma ? "," : ".") == 0; /* the host's locale is as it was */
  setlocale(LC_ALL, "C");
  for (int f = 0; f < 3; ++f) {
    assert_string_equal(before[f], after[f]);
    free(before[f]);
    free(after[f]);
  }
  assert_true(kept);
  if (!comma) skip(); /* no such locale here: the comparison above says little */
}

static void failures_are_reported(CHECK_STATE)
{
  table *t = small_table(NULL), *none = NULL;
  FILE *full = fopen("/dev/full", "w");
  assert_non_null(full);
  setvbuf(full, NULL, _IONBF, 0);
  for (int f = 0; f < 3; ++f) assert_int_equal(table_write(1, &t, (table_format)f, full), HC_IO);
  fclose(full);
  put(none, 1, "x", 1, 1); /* table_new ran out of memory */
  table_note(none, "x");
  assert_int_equal(table_rows(none), 0);
  assert_int_equal(table_write(1, &none, FORMAT_CSV, stdout), HC_NO_MEMORY);
  t->status = HC_NO_MEMORY; /* as after a failed realloc */
  put(t, 1, "x", 1, 1);
  assert_int_equal(table_rows(t), 3);
  assert_int_equal(table_write(1, &t, FORMAT_JSON, stdout), HC_NO_MEMORY);
  table_free(t);
  table_free(none);
}

/* The status of writing what `misuse` has made of a fresh table, in each format, with nothing written. */
static hc_status status_after(void (*misuse)(table *), int n_columns, const table_column *with)
{
  hc_status st = HC_OK;
  for (int f = 0; f < 3; ++f) {
    table *t = table_new(NULL, n_columns, with);
    if (misuse) misuse(t);
    FILE *to = tmpfile();
    assert_non_null(to);
    hc_status now = table_write(1, &t, (table_format)f, to);
    assert_int_equal(ftell(to), 0);
    if (f) assert_int_equal(now, st);
    st = now;
    fclose(to);
    table_free(t);
  }
  return st;
}

static void integer_for_text(table *t) { table_put_integer(t, 5); }
static void text_for_integer(table *t)
{
  table_put_text(t, "a");
  table_put_text(t, "5");
}
static void integer_for_real(table *t)
{
  table_put_text(t, "a");
  table_put_integer(t, 5);
  table_put_integer(t, 5);
}
static void incomplete_row(table *t) { table_put_missing(t); }
static void wrong_before_the_end(table *t)
{
  table_put_real(t, 5);
  for (int i = 0; i < 12; ++i) table_put_missing(t);
  table_note(t, "x");
  assert_int_equal(table_rows(t), 0);
}

/* Also where assert is nothing. */
static void misuse_is_a_bug(CHECK_STATE)
{
  static const table_column kinds[] = {{"t", TABLE_TEXT}, {"i", TABLE_INTEGER}, {"r", TABLE_REAL}},
                            twice[] = {{"t", TABLE_TEXT}, {"i", TABLE_INTEGER}, {"t", TABLE_REAL}},
                            no_kind[] = {{"t", (table_kind)(TABLE_REAL + 1)}};
  static void (*const misuses[])(table *) = {integer_for_text, text_for_integer, integer_for_real, incomplete_row,
                                             wrong_before_the_end};
  for (size_t i = 0; i < sizeof misuses / sizeof *misuses; ++i)
    assert_int_equal(status_after(misuses[i], 3, kinds), HC_BUG);
  assert_int_equal(status_after(NULL, 3, twice), HC_BUG);
  assert_int_equal(status_after(integer_for_text, 1, no_kind), HC_BUG);
  assert_int_equal(status_after(wrong_before_the_end, 0, NULL), HC_BUG);
}

/* Rows written one at a time, then the rest: the bytes of a table that is written whole. */
static void rows_that_are_shown_at_once(CHECK_STATE)
{
  for (int i = 0; i < 8; ++i) {
    const bool several = i & 1;
    const table_format format = i & 2 ? FORMAT_JSON : FORMAT_CSV;
    const int before = i & 4 ? 2 : 0; /* so many rows at once */
    table *t[2] = {table_new("A", 4, columns), small_table("B")};
    table_begun begun = {.several = several};
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    assert_non_null(to);
    table_note(t[0], "first");
    table_notes_of_rows(t[0]);
    assert_int_equal(table_write_begun(t[0], format, to, &begun), HC_OK);
    assert_false(begun.begun); /* without a row nothing is written */
    for (int k = 0; k < 3; ++k) {
      put(t[0], k, "match", k, NAN);
      if (k >= before) assert_int_equal(table_write_begun(t[0], format, to, &begun), HC_OK);
    }
    put(t[0], 9, "differs", 9, 1);
    table_note(t[0], "last");
    assert_int_equal(table_write_rest(several ? 2 : 1, t, format, to, &begun), HC_OK);
    assert_int_equal(fclose(to), 0);
    expect(several ? 2 : 1, t, format, text);
    free(text);
    table_free(t[0]);
    table_free(t[1]);
  }
}

static void notes_of_rows_stand_behind_them(CHECK_STATE)
{
  table *t = table_new("A", 1, one_real);
  table_note(t, "first");
  table_notes_of_rows(t);
  table_put_real(t, 2);
  table_note(t, "last");
  expect(1, &t, FORMAT_CSV, "# first\nvalue\n2\n# last\n");
  expect(1, &t, FORMAT_JSON,
         "{\n  \"rows\": [\n    {\"value\": 2.0}\n  ],\n  \"notes\": [\n    \"first\",\n    \"last\"\n  ]\n}\n");
  table_free(t);
}

CHECK_TESTS("compare.table", 60, hidden_columns_are_for_machines, lines_fit_the_screen, empty_columns_are_spared_first,
            wrapped_columns_keep_their_words, three_formats, no_rows_and_no_title, several_tables,
            rows_that_are_shown_at_once, notes_of_rows_stand_behind_them, csv_quotes_what_a_reader_could_misread,
            reals_get_one_notation_a_column, text_is_utf8_and_safe, utf8_is_decoded_strictly,
            long_texts_go_on_in_the_next_line, blocks_repeat_the_keys, doubles_come_back_bit_for_bit,
            a_comma_locale_changes_nothing, failures_are_reported, misuse_is_a_bug)
