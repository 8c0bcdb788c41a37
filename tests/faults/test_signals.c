/* test_signals.c - SIGINT, SIGTERM, SIGHUP and SIGKILL at moments of the work (moments.h) drawn from a fixed
 * sequence: an output file is as it was, whole, or says that it was stopped; the exit code is 3 with a remark, or
 * that of a run that was over before; the catchable ones leave no other file behind; a study that was killed again
 * and again goes on to the same export. */
#include "numerics/random.h"
#include "tests/faults/moments.h"
#include "tests/faults/small.h"

enum { TEXT = 1 << 16 };

static const char before[] = "what stood there before\n";
static int times = 2; /* moments a command and signal; 20 with the argument "every" */
static outcome o;

static bool was_stopped(void) { return o.signal || o.code == 3; }

/* Is that an honest end? `good`: what an undisturbed run writes to "result". */
static bool honest(int number, int good_code, const char *good)
{
  static char result[TEXT];
  const char *there = small_contents("result", TEXT, result);
  const bool whole = there && !strcmp(there, good), untouched = there && !strcmp(there, before),
             nothing_beside = small_sweep_up() == 0;
  if (o.signal) return o.signal == number && number == SIGKILL && (whole || untouched);
  if (!nothing_beside) return false;
  if (o.code == good_code && whole) return true;
  return o.code == 3 && strstr(o.err, "stopped") &&
         (untouched || whole || (there && (strstr(there, "STOPPED") || strstr(there, "stopped"))));
}

static void try_with(const char *line, int moments)
{
  static char good[TEXT], result[TEXT];
  static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGKILL};
  int stopped = 0;
  uint64_t seed = 1;
  unlink("result");
  moments_run(line, 0, 0, &o);
  const long whole = o.count;
  const int code = o.code;
  assert_true(o.signal == 0 && code >= 0 && code <= 1 && whole >= 10 && small_contents("result", TEXT, good));
  for (int i = 0; i < 4 * moments; ++i) {
    const int number = numbers[i % 4];
    const long n = 1 + (long)((double)whole * random_unit(&seed));
    small_file("result", before);
    moments_run(line, number, n, &o);
    stopped += was_stopped();
    assert_true(number != SIGKILL || was_stopped());
    if (honest(number, code, good)) continue;
    const char *there = small_contents("result", TEXT, result);
    print_error("signal %d at moment %ld of %ld; result %.2000s\n", number, n, whole, there ? there : "absent");
    child_show(&o, line);
    fail();
  }
  print_message("%d of %d were stopped at one of %ld moments: hbmcheck %s\n", stopped, 4 * moments, whole, line);
  assert_true(stopped > moments);
}

static void frf(CHECK_STATE) { try_with("frf small.yaml -o result --set hbm.harmonics=40", times); }

static void compare(CHECK_STATE)
{
  try_with("compare small.yaml -o result --set compare.omega=6.2,6.3,6.4,6.5,6.6", times);
}

static void transient(CHECK_STATE)
{
  try_with("transient small.yaml -o result --set compare.omega=6.2,6.3,6.4,6.5,6.6", times);
}

static void gate(CHECK_STATE)
{
  try_with("gate small.yaml --junit result --set compare.omega=6.2,6.3,6.4,6.5,6.6", times);
}

static void report(CHECK_STATE)
{
  if (!system("$H report small.yaml -q -o result --samples 16 2>&1 | grep -q 'built without Chart.js'")) skip();
  try_with("report small.yaml -o result --harmonics 1 --samples 16", times > 2 ? times : 1);
}

/* Each time a little is added, whatever ended it; then the export is that of an undisturbed run. The moments are drawn
 * from the first ones, so that scenes are left for all runs: each of them is ended by its signal. */
static void study(CHECK_STATE)
{
  static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGKILL};
  small_file("many.yaml", "study: many\nbase: small.yaml\nrun: frf\nset: {compare.omega: [6.2, 6.8]}\n"
                          "vary: [{oscillator.damping: {from: 1, to: 3, count: 40}}, {hbm.harmonics: [2, 3, 4]}]\n");
  moments_run("study many.yaml -q --jobs 1 --results whole.sqlite --export csv -o whole.csv", 0, 0, &o);
  assert_int_equal(o.code, 0);
  uint64_t seed = 2;
  const double most = (double)o.count / (4 * times);
  assert_true(most > 10);
  for (int i = 0; i < 4 * times; ++i) {
    moments_run("study many.yaml --jobs 2 --results killed.sqlite", numbers[i % 4],
                1 + (long)(most * random_unit(&seed)), &o);
    if (numbers[i % 4] == SIGKILL ? o.signal == SIGKILL : o.code == 3) continue;
    child_show(&o, "study many.yaml, to be stopped");
    fail();
  }
  assert_int_equal(system("$H study many.yaml -q --results killed.sqlite --export csv -o killed.csv"), 0);
  assert_int_equal(system("cmp whole.csv killed.csv"), 0);
}

CHECK_ENTRY_FUNCTION
{
  if (argc > 1 && !strcmp(argv[1], "every")) times = 20;
  setenv("H", HBMCHECK_COMMAND, 1);
  return SMALL_MAIN("signals", times > 4 ? 3000 : 300, frf, compare, transient, gate, report, study);
}
