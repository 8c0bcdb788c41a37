/* test_many_unknowns.c - harmonic balance of many contacts: a request to stop is heard at every evaluation, and what is
 * foretold of it is foretold at a price that can be paid. Scene: 36 node pairs in space, 327 unknowns at H = 1. */
#include "casefile/case_file.h"
#include "study/scene_solvers.h"
#include "tests/check.h"

typedef struct visitor {
  int ticks, stop_at; /* and from then on */
  double done;        /* the last that was known */
} visitor;

static bool tick(void *self, double done)
{
  visitor *v = self;
  if (done >= 0) {
    assert_true(done >= v->done);
    v->done = done;
  }
  return ++v->ticks < v->stop_at;
}

/* A curve asks at least once an iteration, and how far it is never falls back. Told to stop in the midst of a step it
 * asks a few times more, of Newton's own retries, and keeps its points. */
static void a_request_to_stop_is_heard_in_a_step(CHECK_STATE)
{
  enum { AT = 40, MOST_RETRIES = 60 };
  visitor through = {.stop_at = 1 << 30}, stops = {.stop_at = AT};
  scene sc;
  hbm_solver *s;
  const char *const set[] = {"hbm.harmonics=1"};
  case_error err;
  if (case_read(SOURCE_DIR "/cases/structures/blade_damper.yaml", 1, set, &sc, &err) != HC_OK)
    fail_msg("%s", err.message);
  assert_int_equal(scene_hbm_solver(&sc, &s), HC_OK);
  const double to = sc.omega_from + 0.3 * (sc.omega_to - sc.omega_from);
  hbm_curve whole = {0}, part = {0};
  assert_int_equal(hbm_trace(s, sc.omega_from, to, &(hc_monitor){tick, &through}, &whole), HC_OK);
  assert_true(through.ticks > whole.iterations && whole.iterations > 0);
  assert_int_equal(hbm_trace(s, sc.omega_from, sc.omega_to, &(hc_monitor){tick, &stops}, &part), HC_INTERRUPTED);
  assert_int_equal(part.end, HC_INTERRUPTED);
  assert_true(part.n > 0 && stops.ticks < AT + MOST_RETRIES);
  hbm_curve_free(&part);
  assert_int_equal(hbm_trace(s, sc.omega_from, to, NULL, &part), HC_OK); /* it works on */
  assert_int_equal(part.n, whole.n);
  hbm_curve_free(&part);
  hbm_curve_free(&whole);
  hbm_solver_free(s);
  case_clear(&sc);
}

CHECK_TESTS("hbm.many_unknowns", 120, a_request_to_stop_is_heard_in_a_step)
