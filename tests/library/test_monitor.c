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

typedef enum work { CURVE, TRANSIENT, COMPARISON } work;

/* Do the work with that listener; what it found is counted and freed. */
static hbmcheck_status run(work what, const hbmcheck_case *c, listener *l, int *found)
{
  const double omega[] = {6, 8};
  const hbmcheck_monitor monitor = {listen, l};
  hbmcheck_curve *curve = NULL;
  hbmcheck_transient *t = NULL;
  hbmcheck_comparison *both = NULL;
  hbmcheck_status st;
  interrupted = 0;
  switch (what) {
  case CURVE: st = hbmcheck_curve_trace(c, &monitor, &curve); break;
  case TRANSIENT: st = hbmcheck_transient_run(c, 2, omega, &monitor, &t); break;
  default: st = hbmcheck_comparison_run(c, 2, omega, &monitor, &both); break;
  }
  assert_true(curve || t || both);
  *found = hbmcheck_solutions_count(hbmcheck_curve_points(curve)) + hbmcheck_transient_count(t) +
           hbmcheck_comparison_count(both);
  if (what == CURVE && st == HBMCHECK_INTERRUPTED) { /* what there is can be searched; there may be more */
    hbmcheck_solutions *at;
    assert_int_equal(hbmcheck_curve_at(curve, 3.01, &at), HBMCHECK_INTERRUPTED);
    assert_non_null(at);
    hbmcheck_solutions_free(at);
  }
  if (what == COMPARISON && st == HBMCHECK_INTERRUPTED) {
    hbmcheck_gate gate;
    assert_int_equal(hbmcheck_comparison_gate(both, &gate), HBMCHECK_INTERRUPTED);
    assert_int_equal(hbmcheck_comparison_exit_code(both), 3);
  }
  hbmcheck_curve_free(curve);
  hbmcheck_transient_free(t);
  hbmcheck_comparison_free(both);
  return st;
}

/* At the first tick, at some, at the last. After 0 those that call each other may each ask once more: a handful. */
static void stopped(work what, const char *name)
{
  hbmcheck_case *c = CASE2("hbm.harmonics=5");
  listener all = {.until = 0};
  int whole, found, before = 0;
  assert_int_equal(run(what, c, &all, &whole), HBMCHECK_OK);
  assert_true(all.heard > 8 && whole > 0);
  if (what != TRANSIENT) CHECK_LE(0.5, all.highest, "%s says how far it is", name);
  for (int part = 0; part <= 4; ++part) {
    listener l = {.until = part == 0 ? 1 : all.heard * part / 4};
    assert_int_equal(run(what, c, &l, &found), HBMCHECK_INTERRUPTED);
    CHECK_LE(l.after, 8, "%s, stopped at tick %d of %d", name, l.until, all.heard);
    assert_in_range(found, before, whole);
    before = found; /* the later, the more */
  }
  assert_true(before > 0);
  hbmcheck_case_free(c);
}

static void curve(CHECK_STATE) { stopped(CURVE, "curve"); }

static void transient(CHECK_STATE) { stopped(TRANSIENT, "transient"); }

static void comparison(CHECK_STATE) { stopped(COMPARISON, "comparison"); }

/* A monitor that has nothing to say is none. */
static void silent(CHECK_STATE)
{
  const hbmcheck_monitor nobody = {NULL, NULL};
  hbmcheck_case *c = CASE2("hbm.harmonics=3", "sweep.omega=3,6");
  CHECK_MADE(hbmcheck_curve, curve, hbmcheck_curve_trace(c, &nobody, &curve));
  hbmcheck_curve_free(curve);
  hbmcheck_case_free(c);
}

CHECK_ENTRY_FUNCTION
{
  check_watchdog(300);
  if (sigaction(SIGINT, &(struct sigaction){.sa_handler = on_interrupt}, NULL)) return 1;
  return CHECK_RUN("library.monitor", NULL, NULL, curve, transient, comparison, silent);
}
