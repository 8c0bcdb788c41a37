/* test_monitor.c - a monitor hears how far the work is, and stops it with what was found. */
#include "tests/library/case2.h"

#include <signal.h>

static volatile sig_atomic_t interrupted;

static void on_interrupt(int signal)
{
  (void)signal;
  interrupted = 1;
}

/* What a monitor is told; it goes on until `until` ticks were heard, then somebody presses Ctrl-C. */
typedef struct listener {
  int heard, until, after; /* after: ticks in spite of the answer 0 */
  double highest;
} listener;

static int listen(void *self, double done)
{
  listener *l = self;
  l->after += interrupted != 0;
  if (!(done <= 1)) fail_msg("done = %g", done); /* NaN is wrong, too */
  if (done > l->highest) l->highest = done;
  if (++l->heard == l->until) raise(SIGINT);
  return !interrupted;
}

/* Do the work with that listener; its rows are counted. */
static hbmcheck_status run(const char *command, const hbmcheck_case *c, listener *l, int *found)
{
  const hbmcheck_monitor monitor = {sizeof monitor, listen, l};
  hbmcheck_result *r;
  interrupted = 0;
  const hbmcheck_status st = RUN(c, command, &monitor, &r, strcmp(command, "frf") ? "--at=6,8" : NULL);
  assert_non_null(r);
  *found = rows_of(r);
  if (st == HBMCHECK_INTERRUPTED) {
    assert_null(table_titled(r, "Gate"));
    assert_int_equal(hbmcheck_result_exit_code(r), 3);
    assert_non_null(hbmcheck_result_remark(r, 0));
  }
  hbmcheck_result_free(r);
  return st;
}

/* At the first tick, at some, at the last. After 0 those that call each other may each ask once more: a handful. */
static void stopped(const char *name)
{
  hbmcheck_case *c = CASE2("hbm.harmonics=5");
  listener all = {.until = 0};
  int whole, found, before = 0;
  assert_int_equal(run(name, c, &all, &whole), HBMCHECK_OK);
  assert_true(all.heard > 8 && whole > 0);
  if (strcmp(name, "transient") != 0) CHECK_LE(0.5, all.highest, "%s says how far it is", name);
  for (int part = 0; part <= 4; ++part) {
    listener l = {.until = part == 0 ? 1 : all.heard * part / 4};
    assert_int_equal(run(name, c, &l, &found), HBMCHECK_INTERRUPTED);
    CHECK_LE(l.after, 8, "%s, stopped at tick %d of %d", name, l.until, all.heard);
    assert_in_range(found, before, whole);
    before = found; /* the later, the more */
  }
  assert_true(before > 0);
  hbmcheck_case_free(c);
}

static void curve(CHECK_STATE) { stopped("frf"); }

static void transient(CHECK_STATE) { stopped("transient"); }

static void comparison(CHECK_STATE) { stopped("compare"); }

/* A monitor that has nothing to say is none. */
static void silent(CHECK_STATE)
{
  const hbmcheck_monitor nobody = {.size = sizeof nobody};
  hbmcheck_result *r;
  hbmcheck_case *c = CASE2("hbm.harmonics=3", "sweep.omega=3,6");
  assert_int_equal(RUN(c, "frf", &nobody, &r, NULL), HBMCHECK_OK);
  hbmcheck_result_free(r);
  hbmcheck_case_free(c);
}

CHECK_ENTRY_FUNCTION
{
  check_watchdog(300);
  if (sigaction(SIGINT, &(struct sigaction){.sa_handler = on_interrupt}, NULL)) return 1;
  return CHECK_RUN("library.monitor", NULL, NULL, curve, transient, comparison, silent);
}
