/* test_memory.c - the commands with allocation number n failing, n = 1, 2, ..., with all from n on failing, and with so
 * many bytes and no more to be had once a solver is being made: they
 * end by themselves, leak nothing, and either write what an undisturbed run writes or say that memory ran out and
 * exit with 3; a file is not there, whole, or says itself what it lacks. Run with the argument "every" for each n
 * (ctest -C Thorough), else for the first ones and then in growing strides. */
#include <limits.h>

#include "tests/faults/child.h"
#include "tests/faults/memory.h"
#include "tests/faults/small.h"

enum {
  SECONDS = 600,
  DENSE = 12 /* first n tried one by one */,
  STRIDES = 6 /* then each n + n/STRIDES */,
  SHOWN = 8,
  LIMITS = 60
};

typedef struct trial {
  const char *line;
  bool timed; /* what it writes has seconds in it: only its length is compared, roughly */
  long n;
  memory_mode mode;
} trial;

static bool every;
static outcome now;
static long gave_up; /* trials that ended for want of memory */

static int work(void *self)
{
  const trial *t = self;
  memory_fail(t->n, t->mode);
  int code = child_command(t->line);
  fflush(stdout);
  *child_count = t->mode == MEMORY_LIMIT ? memory_peak() : memory_asked();
  memory_fail(0, MEMORY_ONE); /* looking for leaks takes memory, too */
  return code;
}

/* What the command wrote to "result", then removed. NULL: nothing there. */
static char *take_result(void)
{
  static char text[CHILD_TEXT];
  char *result = small_contents("result", sizeof text, text);
  unlink("result");
  return result;
}

static bool is_whole(const trial *t, const char *result, const char *good)
{
  if (t->timed)
    return strlen(result) > 0.9 * strlen(good) && !strcmp(result + strlen(result) - 2, good + strlen(good) - 2);
  return !strcmp(result, good);
}

static bool passes(const trial *t, const char *good)
{
  char what[300];
  static const char *const modes[] = {"allocation %ld", "allocation %ld and all after it", "%ld bytes and no more"};
  int n = snprintf(what, sizeof what, "hbmcheck %s, ", t->line);
  snprintf(what + n, sizeof what - (size_t)n, modes[t->mode], t->n);
  child_run(work, (void *)t, SECONDS, &now);
  const char *result = take_result();
  bool whole = result && is_whole(t, result, good), silent = !strstr(now.err, "memory");
  /* what was found is kept, if it says so itself */
  bool honest = !result || whole || strstr(result, "out of memory") || strstr(result, "solver_failed");
  bool fine = now.code == 0 ? whole : now.code == 3 && honest && !silent;
  gave_up += now.code == 3;
  if (fine && small_sweep_up() == 0) return true;
  child_show(&now, what);
  print_error("result %s\n", !result ? "absent" : whole ? "whole" : "CHANGED");
  if (result && !whole) print_error("%.2000s\n", result);
  return false;
}

/* Limits spread over all that the command takes, and one that is no limit; how many are not passed. */
static long try_limits(trial *t, const char *good)
{
  long failed = 0;
  t->mode = MEMORY_LIMIT;
  t->n = LONG_MAX;
  failed += !passes(t, good);
  const long most = now.count, step = most / (every ? 20 * LIMITS : LIMITS) + 1;
  for (t->n = 1; t->n <= most && failed < SHOWN; t->n += step) failed += !passes(t, good);
  return failed;
}

static void try_one(const char *line, bool timed)
{
  static char good[CHILD_TEXT];
  trial t = {line, timed, 0, MEMORY_ONE};
  child_run(work, &t, SECONDS, &now);
  const long n = now.count;
  const char *result = take_result();
  if (now.code != 0 || !result || n < 1) child_show(&now, line);
  assert_true(now.code == 0 && result && n >= 1);
  strcpy(good, result);
  long tried = 0, failed = 0;
  gave_up = 0;
  for (t.n = 1; t.n <= n && failed < SHOWN; t.n += every || t.n < DENSE ? 1 : 1 + t.n / STRIDES, ++tried)
    for (t.mode = MEMORY_ONE; t.mode <= MEMORY_ALL_FROM; ++t.mode) failed += !passes(&t, good);
  print_message("%ld of %ld allocations: hbmcheck %s\n", tried, n, line);
  failed += try_limits(&t, good);
  assert_int_equal(failed, 0);
  assert_true(gave_up > 0);
}

static void try(const char *line) { try_one(line, false); }

static void frf(CHECK_STATE)
{
  try("frf small.yaml -q -o result");
  try("frf small.yaml -q -o result --format json --at 6.3 --set hbm.harmonics=2 --set hbm.force=sampled --set "
      "hbm.samples=16");
  try("frf small.yaml -q -o result --format csv --set hbm.harmonics=auto --set hbm.samples=auto --set "
      "hbm.force=sampled --set hbm.accuracy=0.01");
}

/* A curve's first point from a ramp: the linear response is no guess there (tests/hbm/test_first_solution.c). */
static void first_point_from_a_ramp(CHECK_STATE)
{
  small_file(
      "ramp.yaml",
      "{oscillator: {mass: 1.8113, damping: 0, stiffness: 178.109}, forcing: {amplitude: 2.48831e-5},\n"
      " sweep: {omega: [18.9741, 18.975]}, hbm: {harmonics: 2}, contacts: [\n"
      "  {tangential_stiffness: 2.78082e+7, normal_stiffness: 2652.15, friction: 1.22005, angle_deg: 60.3603,\n"
      "   gap: -8.35954},\n"
      "  {tangential_stiffness: 1.89802e+6, normal_stiffness: 1.80238e+7, friction: 2.77875, angle_deg: 53.1828,\n"
      "   gap: 0}]}\n");
  try("frf ramp.yaml -q -o result");
  unlink("ramp.yaml");
}

static void transient(CHECK_STATE)
{
  try("transient small.yaml -q -o result");
  try("transient small.yaml -q -o result --format csv --set transient.law=exact --set transient.start=rest");
  try("transient small.yaml -q -o result --format json --set transient.law=exact --set transient.start=up");
  try("survey small.yaml -q -o result --format csv --starts 6 -j 1");
}

static void compare(CHECK_STATE)
{
  try("compare small.yaml -q -o result --set transient.law=exact");
  try_one("compare small.yaml -q -o result --format json --tables --set transient.law=exact --harmonics 1 --samples 16",
          true);
  /* other_branch, which it takes one more orbit to tell from differs */
  try("compare " SOURCE_DIR "/cases/paper/case2.yaml -q -o result --format csv --at 8 --set hbm.harmonics=2 --set "
      "transient.law=exact --set transient.start=rest");
}

static void contact_force(CHECK_STATE) { try("contact small.yaml -q -o result --motion 0,1,0 --samples 16"); }

static void gate(CHECK_STATE)
{
  try("gate small.yaml -q -o result --set transient.law=exact");
  try("gate small.yaml -q -o /dev/null --junit result --set transient.law=exact");
}

static void study(CHECK_STATE)
{
  try("study study.yaml -q --jobs 1 --results :memory: --export csv -o result");
  try("study study.yaml -q --jobs 1 --results :memory: --export json -o result");
}

static void verify(CHECK_STATE)
{
  try("verify small.yaml -q --against curve.csv --columns omega=omega,amplitude=amplitude -o result --set "
      "transient.law=exact");
}

static void advise(CHECK_STATE) { try("advise small.yaml -q -o result --error 0.1"); }

static void describe(CHECK_STATE)
{
  try("describe -o result");
  try("describe hbm.samples -q -o result");
}

CHECK_ENTRY_FUNCTION
{
  every = argc > 1 && !strcmp(argv[1], "every");
  /* at N one|all|limit "ARG ...": that failure here and now, for a debugger. */
  if (argc == 5 && !strcmp(argv[1], "at")) {
    memory_fail(strtol(argv[2], NULL, 10), !strcmp(argv[3], "all")     ? MEMORY_ALL_FROM
                                           : !strcmp(argv[3], "limit") ? MEMORY_LIMIT
                                                                       : MEMORY_ONE);
    return child_command(argv[4]);
  }
  return SMALL_MAIN("memory", every ? 3000 : 600, frf, first_point_from_a_ramp, transient, compare, contact_force, gate,
                    study, verify, advise, describe);
}
