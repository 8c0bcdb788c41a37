/* test_reference.c - swept up and down through frequencies whose steady state was computed by another program with
 * the exact law. */
#include "tests/check.h"

#include "tests/timeint/reference_rows.h"
#include "tests/timeint/scenes.h"

static const char *const names[REF_CASES] = {"a10", "b10", "c2", "c2kt1e4", "gap1"};

/* Linear rows (no transition in a period): as test_steady's check_harmonic, 10 tolerances; the table has 12 digits.
 * Others: the regularised law's error, which at regularisation rho is of the order of rho kt cos(alpha) w'/(force),
 * below 1e-4 wherever the curve is not vertical: the figure asked for. */
static double allowed(const scene *sc, const reference_row *row)
{
  return row->events == 0 ? 10 * sc->transient.tolerance : 1e-4;
}

static void follow(const scene *sc, int which, int sweep, double omega)
{
  timeint *ti;
  assert_int_equal(scene_timeint(sc, &ti), HC_OK);
  scene_state y = {.x = 0};
  timeint_result r;
  int rows = 0;
  for (size_t i = 0; i < sizeof reference_rows / sizeof *reference_rows; ++i) {
    const reference_row *row = &reference_rows[i];
    if (row->which != which || row->sweep != sweep) continue;
    const char *way = sweep == REF_UP ? "up" : "down";
    if (reference_is_behind_chaos(names[which], sweep == REF_DOWN, row->omega)) y = reference_behind_chaos;
    else assert_int_equal(timeint_sweep(ti, omega, row->omega, y.all, NULL), HC_OK);
    assert_int_equal(timeint_steady(ti, omega = row->omega, y.all, NULL, &r), HC_OK);
    CHECK_NEAR(r.amplitude, row->amplitude, allowed(sc, row) * row->amplitude, "%s %s amplitude at %g", names[which],
               way, omega);
    CHECK_NEAR(r.harmonic_1, row->harmonic_1, allowed(sc, row) * row->amplitude, "%s %s harmonic_1 at %g", names[which],
               way, omega);
    assert_int_equal(r.period_multiple, 1);
    assert_true((row->events == 0) == (r.regime <= CONTACT_STUCK));
    ++rows;
  }
  timeint_free(ti);
  CHECK_LE(7, rows, "%s", names[which]);
}

static void both_ways(const scene *sc, int which, double low, double high)
{
  follow(sc, which, REF_UP, low);
  follow(sc, which, REF_DOWN, high);
}

static void a10(void **state)
{
  scene sc = scene_a10();
  (void)state;
  both_ways(&sc, REF_A10, 3, 20);
}
static void b10(void **state)
{
  scene sc = scene_b10();
  (void)state;
  both_ways(&sc, REF_B10, 3, 20);
}
static void c2(void **state)
{
  scene sc = scene_c2();
  (void)state;
  both_ways(&sc, REF_C2, 3, 20);
}
static void c2kt1e4(void **state)
{
  scene sc = scene_c2kt1e4();
  (void)state;
  both_ways(&sc, REF_C2KT1E4, 3, 20);
}
static void gap1(void **state)
{
  scene sc = scene_gap1();
  (void)state;
  both_ways(&sc, REF_GAP1, 3, 30);
}

CHECK_TESTS("timeint.reference", 600, a10, b10, c2, c2kt1e4, gap1)
