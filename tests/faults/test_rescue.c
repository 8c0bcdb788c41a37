/* test_rescue.c - `compare` or `transient` is stopped inside a period of time integration that never ends, `frf` where
 * the stability of a point is never found, timeint_steady and hbm_stability_at being wrapped by the linker: the rows
 * that were found before are written as in a run that is not stopped, the first table says that it is not whole, the
 * exit code is 3; however many signals come. Where no row was found yet, it ends as everything does. */
#include <jansson.h>

#include "hbm/hbm.h"
#include "tests/faults/child.h"
#include "tests/faults/small.h"
#include "tests/wrap.h"
#include "timeint/steady/steady.h"

enum { HANGS = 600 /* [s] of a child, to end hangs */ };

static double stalls_at; /* from this omega on the wrapped functions do not come back */
static int stop_by = SIGINT;
static int signals = 1;   /* how many are sent there */
static bool hangs = true; /* there; else the work goes on */

static void stop_there(void)
{
  for (int i = 0; i < signals; ++i) raise(stop_by);
  while (hangs) pause();
}

WRAP(hc_status, timeint_steady,
     (timeint * ti, double omega, double *state, const hc_monitor *monitor, timeint_result *r))
{
  if (omega >= stalls_at) stop_there();
  return __real_timeint_steady(ti, omega, state, monitor, r);
}

WRAP(hc_status, hbm_stability_at, (hbm_solver * s, double omega, const double *X, hbm_stability *out))
{
  if (omega >= stalls_at) stop_there();
  return __real_hbm_stability_at(s, omega, X, out);
}

static int obey(void *self)
{
  signal(SIGINT, SIG_DFL); /* who started the tests may ignore it */
  return child_command(self);
}

static outcome whole, stopped;

static void run(const char *line, double omega, outcome *o)
{
  char own[256];
  snprintf(own, sizeof own, "%s", line);
  snprintf(small_doing, sizeof small_doing, "stalled at %g: hbmcheck %s\n", omega, line);
  stalls_at = omega;
  child_run(obey, own, HANGS, o);
}

static void read_whole(const char *path, char *text, size_t size)
{
  FILE *from = fopen(path, "r");
  assert_non_null(from);
  text[fread(text, 1, size - 1, from)] = 0;
  fclose(from);
}

#define LINE "compare small.yaml -q --format csv --set compare.omega=6.2,6.4,6.6"

/* From the header of the csv on, without its notes. */
static const char *rows_of(const char *text)
{
  const char *header = strstr(text, "omega,branch");
  if (!header) header = strstr(text, "omega,verdict");
  return header ? header : "";
}

/* The length of the header and rows, without the notes behind them. */
static size_t length_of(const char *rows)
{
  const char *note = strstr(rows, "\n#");
  return note ? (size_t)(note + 1 - rows) : strlen(rows);
}

static int lines_of(const char *rows)
{
  int n = 0;
  for (size_t i = 0; i < length_of(rows); ++i) n += rows[i] == '\n';
  return n;
}

/* The header and the rows before the stalled one are those of the whole table. */
static void rows_found_before_are_written(CHECK_STATE)
{
  run(LINE, INFINITY, &whole);
  assert_int_equal(whole.code, 0);
  assert_int_equal(lines_of(rows_of(whole.out)), 1 + 3);
  for (int found = 1; found <= 2; ++found) {
    run(LINE, 6.1 + 0.2 * found, &stopped);
    const char *rows = rows_of(stopped.out);
    const int lines = lines_of(rows);
    if (stopped.code == 3 && lines == found + 1 && !strncmp(rows, rows_of(whole.out), length_of(rows)) &&
        strstr(stopped.out, "INCOMPLETE: stopped on request") && strstr(stopped.err, "what was found is kept"))
      continue;
    child_show(&stopped, LINE);
    fail_msg("%d lines where %d rows were found", lines, found);
  }
}

#define STATES "transient small.yaml -q --format csv --set compare.omega=6.2,6.4,6.6"

static void steady_states_are_kept_too(CHECK_STATE)
{
  run(STATES, INFINITY, &whole);
  assert_int_equal(whole.code, 0);
  assert_int_equal(lines_of(rows_of(whole.out)), 1 + 3);
  run(STATES, 6.5, &stopped);
  const char *rows = rows_of(stopped.out);
  if (stopped.code != 3 || lines_of(rows) != 1 + 2 || strncmp(rows, rows_of(whole.out), length_of(rows)) != 0 ||
      !strstr(stopped.out, "INCOMPLETE: stopped on request"))
    child_show(&stopped, STATES), fail();
}

#define CURVE "frf small.yaml -q --format csv --set sweep.omega=4,8"

/* All rows before the stalled point are those of the whole curve; the last remark says where it was stopped. */
static void points_of_a_curve_are_kept_too(CHECK_STATE)
{
  static const char *const lines[] = {CURVE, CURVE " --contacts", CURVE " -o curve.csv", CURVE " --at 5,5.5,7"};
  for (int i = 0; i < 4; ++i) {
    static char file[2][1 << 16];
    run(lines[i], INFINITY, &whole);
    assert_int_equal(whole.code, 0);
    if (i == 2) read_whole("curve.csv", file[0], sizeof file[0]);
    const bool hung = hangs = i != 1;
    run(lines[i], 6.5, &stopped);
    hangs = true;
    if (i == 2) read_whole("curve.csv", file[1], sizeof file[1]);
    const char *all = rows_of(i == 2 ? file[0] : whole.out), *some = rows_of(i == 2 ? file[1] : stopped.out);
    int before = 1;        /* rows up to the stalled one, and the header */
    const char *row = all; /* the end of the last of them */
    while ((row = strchr(row, '\n') + 1) && *row != '#' && strtod(row, NULL) < 6.5) ++before;
    const int found = lines_of(some);
    if (stopped.code == 3 && (hung ? found == before : found >= before) && before > 2 &&
        !strncmp(some, all, (size_t)(row - all)) && strstr(some, "STOPPED at omega = ") &&
        strstr(some, ": stopped on request") && strstr(stopped.err, "what was found is kept"))
      continue;
    child_show(&stopped, lines[i]);
    fail_msg("%d lines where %d were found", lines_of(some), before);
  }
}

/* Without rows to keep it would kill: tests/output/test_progress.c. */
static void a_second_signal_loses_none_of_them(CHECK_STATE)
{
  signals = 3;
  rows_found_before_are_written(state);
  steady_states_are_kept_too(state);
  signals = 1;
}

/* SIGKILL leaves no time to write what was found before: in csv and json it has been written, into a pipe, too. */
static void rows_appear_when_they_are_found(CHECK_STATE)
{
  static const char *const commands[] = {"compare", "transient"}, *const formats[] = {"csv", "json"},
                           *const contacts[] = {"", "--contacts"};
  static const struct {
    const char *found[2], *not_yet;
  } expected[] = {{{"\n6.2", "\n6.4"}, "\n6.6"}, {{"{\"omega\": 6.2", "{\"omega\": 6.4"}, "{\"omega\": 6.6"}};
  stop_by = SIGKILL;
  for (int i = 0; i < 8; ++i) {
    char line[128];
    const int f = i / 2 % 2;
    snprintf(line, sizeof line, "%s small.yaml -q --format %s %s --set compare.omega=6.2,6.4,6.6", commands[i % 2],
             formats[f], contacts[i / 4]);
    run(line, 6.5, &stopped);
    if (stopped.signal == SIGKILL && strstr(stopped.out, expected[f].found[0]) &&
        strstr(stopped.out, expected[f].found[1]) && !strstr(stopped.out, expected[f].not_yet))
      continue;
    child_show(&stopped, line);
    fail();
  }
  /* not in a file, which is written whole or not at all */
  run(LINE " -o killed", 6.5, &stopped);
  assert_int_equal(access("killed", F_OK), -1);
  run(CURVE, INFINITY, &whole);
  run(CURVE, 6.5, &stopped);
  assert_int_equal(stopped.signal, SIGKILL);
  assert_true(lines_of(stopped.out) > 2 && !strncmp(stopped.out, rows_of(whole.out), strlen(stopped.out)));
  stop_by = SIGINT;
}

/* What was shown at once and what is written after the signal are one document. */
static void json_is_closed(CHECK_STATE)
{
  run("compare small.yaml -q --format json --contacts --set compare.omega=6.2,6.4,6.6", 6.5, &stopped);
  assert_int_equal(stopped.code, 3);
  json_t *root = json_loads(stopped.out, JSON_REJECT_DUPLICATES, NULL);
  assert_non_null(root);
  assert_int_equal(json_array_size(json_object_get(root, "HBM against time integration")), 2);
  assert_int_equal(json_array_size(json_object_get(root, "Contacts")), 2 * 2); /* each has two */
  json_decref(root);
}

static void the_table_says_that_it_is_not_whole(CHECK_STATE)
{
  run("compare small.yaml -q --contacts -o result --set compare.omega=6.2,6.4,6.6", 6.3, &stopped);
  static char text[1 << 14];
  read_whole("result", text, sizeof text);
  assert_int_equal(stopped.code, 3);
  assert_non_null(strstr(text, "INCOMPLETE: stopped on request"));
  assert_non_null(strstr(text, "Contacts"));
}

static void nothing_found_yet(CHECK_STATE)
{
  run(LINE, 6, &stopped);
  assert_int_equal(stopped.code, 3);
  assert_int_equal(strlen(stopped.out), 0);
  assert_non_null(strstr(stopped.err, "stopped on request; what was under way is lost"));
}

CHECK_ENTRY_FUNCTION
{
  return SMALL_MAIN("rescue", 600, rows_found_before_are_written, steady_states_are_kept_too,
                    points_of_a_curve_are_kept_too, a_second_signal_loses_none_of_them, rows_appear_when_they_are_found,
                    json_is_closed, the_table_says_that_it_is_not_whole, nothing_found_yet);
}
