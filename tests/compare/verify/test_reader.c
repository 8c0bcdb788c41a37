/* test_reader.c - files of columns as people have them, and what is said about those that are wrong:
 * FILE:LINE:COLUMN, what, expected what. */
#include "compare/verify/search/search.h"
#include "tests/check.h"

static const double two_pi = 2 * PI;

/* The file `text` read with --columns and --quantity; HC_OK or not, the message in *words. */
static hc_status read_text_as(const char *text, size_t length, const char *columns, const char *quantity,
                              verify_data *d, char words[VERIFY_TEXT])
{
  char path[] = "/tmp/hbmcheck-verify-XXXXXX";
  int fd = mkstemp(path);
  assert_true(fd >= 0 && write(fd, text, length) == (ssize_t)length);
  close(fd);
  CHECK_FILLED(verify_columns, where, verify_columns_read(columns, quantity, &where, words));
  hc_status st = verify_data_read(path, &where, d, words);
  unlink(path);
  return st;
}

static hc_status read_text(const char *text, size_t length, const char *columns, verify_data *d,
                           char words[VERIFY_TEXT])
{
  return read_text_as(text, length, columns, "amplitude", d, words);
}

/* Three points (5, 1), (6, 2), (7, 3), whatever the file looks like. */
static void reads(const char *text, const char *columns)
{
  verify_data d;
  char words[VERIFY_TEXT];
  if (read_text(text, strlen(text), columns, &d, words) != HC_OK) fail_msg("%s\nin: %s", words, text);
  assert_int_equal(d.n, 3);
  for (int i = 0; i < 3; ++i) {
    CHECK_NEAR(d.points[i].omega, 5 + i, 0, "point %d of %s", i, text);
    CHECK_NEAR(d.points[i].value, 1 + i, 0, "point %d of %s", i, text);
  }
  verify_data_clear(&d);
}

static void files_as_people_have_them(CHECK_STATE)
{
  reads("5,1\n6,2\n7,3\n", "omega=1,amplitude=2");
  reads("5,1\n6,2\n7,3", "omega=1,amplitude=2");
  reads("5,1\r\n6,2\r\n7,3\r\n", "omega=1,amplitude=2");
  reads("\xEF\xBB\xBFw,A\n5,1\n6,2\n7,3\n", "omega=w,amplitude=A");
  reads("# made by\n\n  # us\nA; remark; w\n1;a,b;5\n\n2;;6\n# end\n3; ;7.0e0\n", "omega=w,value=A");
  reads("  5   1\n 6\t2  \n+7 3\n", "omega=1,amplitude=2");
  reads("5\t\t1\n6\tx y\t2\n7\t\t3\n", "omega=1,amplitude=3");
  reads("omega,branch,amplitude\n5,0,1\n6,1,2\n7,2,3\n", "amplitude=amplitude,omega=omega");
  reads("\"w, forced\",\"A \"\"x\"\"\"\n\"5\",1\n6, \"2\" \n7,3\n", "omega=1,value=2");
  reads("\"ascii quotes are part of a name\",w\n1,5\n2,6\n3,7\n", "omega=2,value=1");
  reads("5 1\n6 2\n7 3", "value=2,omega=1");
}

/* Without --columns: what a header calls the three points' columns. */
static void plain_names_need_no_columns(CHECK_STATE)
{
  static const struct {
    const char *header, *quantity, *found; /* --quantity, NULL: none; what the values are taken for */
    double omega;                          /* [rad/time] of the first point, 5 in the file */
  } list[] = {
      {"omega,amplitude", NULL, "amplitude", 5},
      {"W,AMP", NULL, "amplitude", 5},
      {"\"omega [rad/s]\",\"|X1|\"", NULL, "harmonic_1", 5},
      {"Frequency [Hz],rms", NULL, "rms", 10 * PI},
      {"Frequency [rad/s],Peak", NULL, "peak", 5},
      {"Hz,H3", NULL, "harmonic_3", 10 * PI},
      {"freq,x_rms", NULL, "rms", 10 * PI},
      {"f,norm", NULL, "norm", 10 * PI},
      {"w;acceleration_harmonic_1", NULL, "acceleration_harmonic_1", 5},
      {"omega,dB", NULL, "dB_amplitude", 5},
      {"omega,velocity (dB)", NULL, "dB_velocity", 5},
      {"omega,amplitude,rms,max", "rms", "rms", 5},
      {"omega,value", "norm", "norm", 5},
      {"frequency,omega,max", NULL, "max", 5}, /* side by side they say the same */
  };
  for (size_t i = 0; i < sizeof list / sizeof *list; ++i) {
    char text[256], row[3][64] = {{0}}, words[VERIFY_TEXT], name[VERIFY_QUANTITY_TEXT];
    const char separator = strchr(list[i].header, ';') ? ';' : ',';
    int columns = 1;
    for (const char *c = list[i].header; *c; ++c) columns += *c == separator;
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < columns; ++c)
        snprintf(row[k] + strlen(row[k]), 16, "%s%d", c ? (separator == ';' ? ";" : ",") : "", 5 + k);
    snprintf(text, sizeof text, "%s\n%s\n%s\n%s\n", list[i].header, row[0], row[1], row[2]);
    verify_data d;
    if (read_text_as(text, strlen(text), NULL, list[i].quantity, &d, words) != HC_OK)
      fail_msg("%s\nin: %s", words, text);
    assert_string_equal(verify_quantity_name(&d.quantity, name), list[i].found);
    CHECK_NEAR(d.points[0].omega, list[i].omega, 1e-14, "%s", list[i].header);
    verify_data_clear(&d);
  }
}

static void ambiguous_names_need_columns(CHECK_STATE)
{
  static const struct {
    const char *text, *fragment;
  } list[] = {
      {"omega,amplitude,rms\n5,1,1\n", "more than one column of values among 'omega', 'amplitude', 'rms'"},
      {"frequency,branch,rms,max\n5,0,1,1\n", "'max', expected --columns frequency=1,rms=3 (or"},
      {"amplitude,time\n5,1\n", "'time', expected --columns omega=2,amplitude=1 (or"},
      {"omega,thing\n5,1\n", "no column named like values among 'omega', 'thing'"},
      {"time,amplitude\n5,1\n", "no column named like frequencies"},
      {"omega [Hz],amplitude\n5,1\n", "no column named like frequencies"},
      {"5,1\n6,2\n7,3\n", "no header"},
  };
  for (size_t i = 0; i < sizeof list / sizeof *list; ++i) {
    verify_data d;
    char words[VERIFY_TEXT];
    assert_int_equal(read_text_as(list[i].text, strlen(list[i].text), NULL, NULL, &d, words), HC_BAD_INPUT);
    if (!strstr(words, list[i].fragment) || !strstr(words, "expected"))
      fail_msg("'%s', expected '%s'", words, list[i].fragment);
    assert_non_null(strstr(words, "--columns"));
    verify_data_clear(&d);
  }
}

/* 20 log10 of 10 is 20 dB; and 0 and below are numbers in dB. */
static void decibels_become_numbers(CHECK_STATE)
{
  char words[VERIFY_TEXT];
  const char text[] = "1 20\n2 0\n3 -40\n0 7\n-1 7\n";
  CHECK_FILLED(verify_data, d, read_text_as(text, strlen(text), "omega=1,dB=2", NULL, &d, words));
  assert_int_equal(d.n, 3);
  assert_int_equal(d.left_out, 2); /* omega <= 0 */
  CHECK_NEAR(d.points[0].value, 10, 1e-14, "20 dB");
  CHECK_NEAR(d.points[1].value, 1, 0, "0 dB");
  CHECK_NEAR(d.points[2].value, 0.01, 1e-17, "-40 dB");
  verify_data_clear(&d);
}

/* x = 0.5 + 3 cos - 4 sin, omega = 2: by hand. max and min are 0.5 +- 5. */
static void quantities_by_hand(CHECK_STATE)
{
  static const double X[] = {0.5, 3, -4};
  static const struct {
    const char *name;
    double value;
  } list[] = {
      {"amplitude", 5},
      {"double_amplitude", 10},
      {"peak", 5.5},
      {"max", 5.5},
      {"min", -4.5},
      {"mean", 0.5},
      {"rms", 3.570714214271425},  /* sqrt(0.25 + 12.5) */
      {"norm", 5.024937810560445}, /* sqrt(25.25) */
      {"harmonic_0", 0.5},
      {"harmonic_1", 5},
      {"harmonic_2", 0},
      {"velocity", 10},
      {"acceleration", 20},
      {"velocity_harmonic_1", 10},
      {"acceleration_harmonic_1", 20},
  };
  const verify_motion m = verify_motion_of(2, 1, X);
  for (size_t i = 0; i < sizeof list / sizeof *list; ++i) {
    verify_quantity q;
    char name[VERIFY_QUANTITY_TEXT];
    assert_true(verify_quantity_read(list[i].name, strlen(list[i].name), &q));
    CHECK_NEAR(verify_quantity_of(&q, &m), list[i].value, 4e-15 * (1 + fabs(list[i].value)), "%s", list[i].name);
    assert_string_equal(verify_quantity_name(&q, name), list[i].name);
  }
}

static void cycles_become_radians(CHECK_STATE)
{
  char words[VERIFY_TEXT];
  const char text[] = "1 1\n0.5 0\n3 3\n";
  CHECK_FILLED(verify_data, d, read_text(text, strlen(text), "frequency=1,value=2", &d, words));
  CHECK_NEAR(d.points[0].omega, two_pi, 4e-16 * two_pi, "1 a unit of time");
  CHECK_NEAR(d.points[1].omega, PI, 4e-16 * PI, "half");
  assert_int_equal(d.points[2].line, 3);
  verify_data_clear(&d);
}

static void refused(const char *text, size_t length, const char *columns, const char *place, const char *fragment)
{
  verify_data d;
  char words[VERIFY_TEXT];
  hc_status st = read_text(text, length, columns, &d, words);
  const char *at = strstr(words, place);
  if (st != HC_BAD_INPUT || !at || !strstr(at, fragment) || !strstr(at, "expected"))
    fail_msg("status %d, message '%s'; expected '%s ... %s' for:\n%s", st, words, place, fragment, text);
  verify_data_clear(&d);
}
#define REFUSED(text, columns, place, fragment) refused(text, sizeof text - 1, columns, place, fragment)

static void mistakes_have_a_place(CHECK_STATE)
{
  REFUSED("", "omega=1,value=2", ":1:1: ", "0 points");
  REFUSED("# nothing\n", "omega=1,value=2", ":1:1: ", "0 points");
  REFUSED("w,A\n5,1\n6,2\n", "omega=w,value=A", ":3:1: ", "2 points");
  REFUSED("5,1\n6,x\n7,3\n", "omega=1,value=2", ":2:3: ", "'x' is not a number");
  REFUSED("5,1\n6,\n7,3\n", "omega=1,value=2", ":2:3: ", "'' is not a number");
  REFUSED("5;1\n6;2,5\n7;3\n", "omega=1,value=2", ":2:3: ", "'2,5' is not a number");
  REFUSED("5,1\n6,nan\n7,3\n", "omega=1,value=2", ":2:3: ", "'nan' is not finite");
  REFUSED("5,1\n6,inf\n7,3\n", "omega=1,value=2", ":2:3: ", "not finite");
  REFUSED("5,1\n6,1e999\n7,3\n", "omega=1,value=2", ":2:3: ", "too large");
  REFUSED("5,1\n6,-2\n7,3\n", "omega=1,value=2", ":2:3: ", "too small");
  REFUSED("5,1\n0,2\n7,3\n", "omega=1,value=2", ":3:1: ", "2 points in the file at omega > 0");
  REFUSED("5;1\n6;2,5\n7;3\n", "omega=1,value=2", ":2:3: ", "a decimal comma?");
  REFUSED("w,A\n5,5,1,5\n6,2\n7,3\n", "omega=1,value=2", ":2:1: ", "decimal commas?");
  REFUSED("\"w,A\n5,1\n6,2\n7,3\n", "omega=1,value=2", ":1:1: ", "not closed");
  REFUSED("\"w\"a,A\n5,1\n6,2\n7,3\n", "omega=1,value=2", ":1:4: ", "behind the closing quote");
  REFUSED("5,1\n6,2,9\n7,3\n", "omega=1,value=2", ":2:1: ", "3 fields, expected 2 as in line 1");
  REFUSED("w,A\n5\n6,2\n7,3\n", "omega=1,value=2", ":2:1: ", "1 field");
  REFUSED("w,A\n5,1\n6,2\n7,3\n", "omega=1,value=3", ":1:1: ", "no column 3");
  REFUSED("w,A\n5,1\n6,2\n7,3\n", "omega=w,value=B", ":1:1: ", "one of w, A");
  REFUSED("A,A\n5,1\n6,2\n7,3\n", "omega=1,value=A", ":1:1: ", "more than one");
  REFUSED("5,1\n6,2\n7,3\n", "omega=w,value=2", ":1:1: ", "header");
  REFUSED("w,A\nu,v\n6,2\n7,3\n", "omega=w,value=A", ":2:1: ", "'u'"); /* a line of units is not a point */
  REFUSED("5,1\n6,\x01\xFF\n7,3\n", "omega=1,value=2", ":2:3: ", "\\x01\\xFF");
  REFUSED("5,1\0\n6,2\n7,3\n", "omega=1,value=2", ":1:3: ", "not a number");
  REFUSED("\xC3\xA4 ,1\n6,2\n7,3\n", "omega=1,value=2", ":1:1: ", "not a number");         /* half a header is none */
  REFUSED("a,1\n\xC3\xA4 , \xC3\xA4\n7,3\n", "omega=2,value=2", ":2:5: ", "not a number"); /* columns are characters */
}

static void limits_hold(CHECK_STATE)
{
  size_t size = (size_t)(VERIFY_MOST_POINTS + 1) * 4;
  char *text = malloc(size + 1), words[VERIFY_TEXT];
  assert_non_null(text);
  for (size_t i = 0; i < size; i += 4) memcpy(text + i, "5 1\n", 4);
  refused(text, size, "omega=1,value=2", ":100001:1: ", "too many");
  CHECK_FILLED(verify_data, d, read_text(text, size - 4, "omega=1,value=2", &d, words));
  assert_int_equal(d.n, VERIFY_MOST_POINTS);
  verify_data_clear(&d);
  memset(text, ',', 1000);
  refused(text, 1000, "omega=1,value=2", ":1:257: ", "at most 256");
  free(text);
}

static void no_such_file(CHECK_STATE)
{
  verify_data d;
  char words[VERIFY_TEXT];
  CHECK_FILLED(verify_columns, where, verify_columns_read("omega=1,peak=2", NULL, &where, words));
  assert_int_equal(verify_data_read("/nonexistent.csv", &where, &d, words), HC_IO);
  assert_non_null(strstr(words, "/nonexistent.csv: "));
  assert_int_equal(verify_data_read("/tmp", &where, &d, words), HC_IO);
}

static void unclear(const char *columns, const char *quantity, const char *fragment)
{
  verify_columns where;
  char words[VERIFY_TEXT] = "";
  if (verify_columns_read(columns, quantity, &where, words) != HC_BAD_INPUT || !strstr(words, fragment))
    fail_msg("--columns '%s': '%s', expected '%s'", columns, words, fragment);
}

static void columns_say_what_they_mean(CHECK_STATE)
{
  unclear("", NULL, "NAME=COLUMN");
  unclear("omega", NULL, "NAME=COLUMN");
  unclear("omega=1", NULL, "no column of values");
  unclear("amplitude=1", NULL, "no column of frequencies");
  unclear("omega=1,amplitud=2", NULL, "did you mean amplitude");
  unclear("omega=1,frequency=2,peak=3", NULL, "a second column of frequencies");
  unclear("omega=1,amplitude=2,peak=3", NULL, "a second column of values");
  unclear("omega=1,value=2", NULL, "--quantity");
  unclear("omega=1,value=2", "size", "'size' is unknown, expected one of amplitude, double_amplitude, peak");
  unclear("omega=1,value=2", "harmonic_201", "unknown");
  unclear("omega=1,value=2", "harmonic_-1", "unknown");
  unclear("omega=1,value=2", "dBamplitude", "unknown");
  unclear("omega=1,amplitude=2", "peak", "contradicts");
  unclear("omega=0,amplitude=2", NULL, "'0' is no column");
  unclear("omega=1.5,amplitude=2", NULL, "'1.5' is no column");
  unclear("omega=,amplitude=2", NULL, "'' is no column");
  unclear("omega=1,amplitude=2,", NULL, "NAME=COLUMN");
}

/* A hypothesis fits within 1 %, or the gate if that is larger, and a fifth of the truth's distance; one that is no
 * number does not. */
static void what_is_left_decides_a_fit(CHECK_STATE)
{
  static verify_report r;
  r.truth_distance = 1;
  r.gate = 1e-3;
  assert_false(verify_fits(&r)); /* no hypothesis */
  r.n_hypotheses = 1;
  r.hypotheses[0].distance = 0.0099;
  assert_true(verify_fits(&r));
  r.hypotheses[0].distance = 0.0101;
  assert_false(verify_fits(&r));
  r.gate = 0.02;
  assert_true(verify_fits(&r));
  r.gate = 1e-3;
  r.hypotheses[0].distance = 0.0099;
  r.hypotheses[0].fitted = true;
  assert_false(verify_fits(&r)); /* a factor that was fitted has to bring it within the gate */
  r.hypotheses[0].distance = 0.00099;
  assert_true(verify_fits(&r));
  r.hypotheses[0].fitted = false;
  r.hypotheses[0].distance = 0.0101;
  r.gate = 0.02;
  r.truth_distance = 0.05;
  assert_false(verify_fits(&r));
  r.truth_distance = 1;
  r.hypotheses[0].distance = NAN;
  assert_false(verify_fits(&r));
}

CHECK_TESTS("verify.reader", 60, what_is_left_decides_a_fit, files_as_people_have_them, plain_names_need_no_columns,
            ambiguous_names_need_columns, decibels_become_numbers, quantities_by_hand, cycles_become_radians,
            mistakes_have_a_place, limits_hold, no_such_file, columns_say_what_they_mean)
