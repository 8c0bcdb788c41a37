/* test_allocation.c - neither marching nor shooting allocates. */

#include "numerics/sundials_compat.h"
#include "tests/counted.h"
#include "tests/scene_parts.h"
#include "tests/timeint/scenes.h"

typedef struct count {
  int ticks;
  long at_three, at_fifty;
} count;

static bool tick(void *self, double done)
{
  count *c = self;
  (void)done;
  if (c->ticks == 3) c->at_three = allocations;
  if (c->ticks == 50) c->at_fifty = allocations;
  ++c->ticks;
  return true;
}

/* More contacts than a case file lists: what is allocated is for as many as the model has. */
enum { CONTACTS = 17 };

static timeint *made(transient_steady steady, bool scout, transient_law law)
{
  scene sc = scene_b10();
  model *m = scene_split_model(&sc, CONTACTS);
  long before = allocations;
  sc.transient.steady = steady;
  sc.transient.scout = scout;
  sc.transient.law = law;
  CHECK_MADE(timeint, ti, timeint_new(m, &sc.transient, &ti));
  CHECK_LE(10, allocations - before, "the counter counts SUNDIALS, too");
  model_free(m);
  return ti;
}

static void marching_allocates_nothing(CHECK_STATE)
{
  if (!COUNTED) skip();
  count c = {0};
  hc_monitor monitor = {.tick = tick, .self = &c};
  timeint *ti = made(TRANSIENT_STEADY_MARCH, false, TRANSIENT_LAW_REGULARISED);
  double y[TIMEINT_W + CONTACTS] = {0};
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, 7, y, &monitor, &r));
  CHECK_LE(50, c.ticks, "enough periods");
  assert_int_equal(c.at_fifty - c.at_three, 0);
  timeint_free(ti);
}

/* Where Newton succeeds: SUNDIALS 7 composes a message, and frees it, when it does not. */
static void shooting_and_sweeping_allocate_nothing(CHECK_STATE)
{
  if (!COUNTED) skip();
  timeint *ti = made(TRANSIENT_STEADY_AUTO, false, TRANSIENT_LAW_REGULARISED);
  double y[TIMEINT_W + CONTACTS] = {1.04, 7}; /* next to the orbit */
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, 7, y, NULL, &r));
  assert_int_equal(timeint_sweep(ti, 7, 7.01, y, NULL), HC_OK); /* CVODE makes itself ready in the first period of
                                                                    each law */
  long settled = allocations;
  assert_int_equal(timeint_sweep(ti, 7.01, 7.2, y, NULL), HC_OK);
  assert_int_equal(timeint_steady(ti, 7.2, y, NULL, &r), HC_OK);
  assert_int_equal(r.method, TIMEINT_BY_SHOOTING);
  assert_int_equal(allocations - settled, 0);
  timeint_free(ti);
}

/* SUNDIALS 7 allocates, and frees, a message in each KINSol call that fails; Newton calls it twice, for each of the few
 * orbits that a motion on its way is tried for. */
enum { MESSAGES = SUNDIALS_VERSION_MAJOR >= 7 ? 12 : 0 };

/* From rest: marching in closed form, its Newton, CVODE's periods that confirm it. */
static void a_scout_allocates_nothing(CHECK_STATE)
{
  if (!COUNTED) skip();
  for (int law = 0; law < 2; ++law) {
    timeint *ti = made(TRANSIENT_STEADY_AUTO, true, law ? TRANSIENT_LAW_EXACT : TRANSIENT_LAW_REGULARISED);
    timeint_result r;
    for (int i = 0; i < 3; ++i) {
      double y[TIMEINT_W + CONTACTS] = {0};
      const long before = allocations;
      assert_int_equal(timeint_steady(ti, 7 + 0.1 * i, y, NULL, &r), HC_OK);
      CHECK_LE(5, r.closed_form_periods, "scouted");
      assert_int_equal(r.method, TIMEINT_BY_SHOOTING);
      const long made = allocations - before;
      if (i > 0) CHECK_LE(made, MESSAGES, "allocations"); /* CVODE makes itself ready in the first period */
    }
    timeint_free(ti);
  }
}

CHECK_TESTS("timeint.allocation", 120, marching_allocates_nothing, shooting_and_sweeping_allocate_nothing,
            a_scout_allocates_nothing)
