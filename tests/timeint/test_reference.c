/* test_reference.c - swept up and down through frequencies whose steady state was computed by another program with
 * the exact law. */

#include "tests/timeint/reference_rows.h"
#include "tests/timeint/scenes.h"

/* Linear rows (no transition in a period): as test_steady's check_harmonic, 10 tolerances; the table has 12 digits.
 * Others: the regularised law's error, which at regularisation rho is of the order of rho kt cos(alpha) w'/(force),
 * below 1e-4 wherever the curve is not vertical: the figure asked for. */
static double allowed(const scene *sc, const steady_reference *row)
{
  return row->events == 0 ? 10 * sc->transient.tolerance : 1e-4;
}

static void follow(const scene *sc, const char *name, const char *sweep, double omega)
{
  timeint *ti;
  assert_int_equal(scene_timeint(sc, &ti), HC_OK);
  scene_state y = {.x = 0};
  timeint_result r;
  int rows = 0;
  for (int i = 0; i < N_STEADY_REFERENCES; ++i) {
    const steady_reference *row = &steady_references[i];
    if (strcmp(row->name, name) || strcmp(row->sweep, sweep)) continue;
    if (reference_is_behind_chaos(name, !strcmp(sweep, "down"), row->omega)) y = reference_behind_chaos;
    else assert_int_equal(timeint_sweep(ti, omega, row->omega, y.all, NULL), HC_OK);
    assert_int_equal(timeint_steady(ti, omega = row->omega, y.all, NULL, &r), HC_OK);
    CHECK_NEAR(r.amplitude, row->amplitude, allowed(sc, row) * row->amplitude, "%s %s amplitude at %g", name, sweep,
               omega);
    CHECK_NEAR(r.harmonic_1, row->harmonic_1, allowed(sc, row) * row->amplitude, "%s %s harmonic_1 at %g", name, sweep,
               omega);
    assert_int_equal(r.period_multiple, 1);
    assert_true((row->events == 0) == (r.regime <= CONTACT_STUCK));
    ++rows;
  }
  timeint_free(ti);
  CHECK_LE(7, rows, "%s", name);
}

static void both_ways(const char *name, double low, double high)
{
  const scene sc = scene_reference(name);
  follow(&sc, name, "up", low);
  follow(&sc, name, "down", high);
}

static void a10(CHECK_STATE) { both_ways("a10", 3, 20); }
static void b10(CHECK_STATE) { both_ways("b10", 3, 20); }
static void c2(CHECK_STATE) { both_ways("c2", 3, 20); }
static void c2kt1e4(CHECK_STATE) { both_ways("c2kt1e4", 3, 20); }
static void gap1(CHECK_STATE) { both_ways("gap1", 3, 30); }

CHECK_TESTS_WITH("timeint.reference", 600, read_steady_references, NULL, a10, b10, c2, c2kt1e4, gap1)
