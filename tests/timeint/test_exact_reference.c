/* test_exact_reference.c - the exact law, swept up and down, against tests/reference/transient_exact.csv: every row
 * of all eight cases. */

#include "tests/timeint/reference_rows.h"
#include "tests/timeint/scenes.h"

/* Amplitude and first harmonic to 1e-8: the table's 12 digits, "good to about 1e-9", and ours, transient.tolerance =
 * 1e-9 of the motion. The mean where it is unique: it is not where a slider never slips (free_sliders), and then
 * both programs' histories differ. */
static void follow(const scene *sc, const char *name, const char *sweep, double from)
{
  timeint *ti;
  timeint_result r;
  int seen = 0;
  assert_int_equal(scene_timeint(sc, &ti), HC_OK);
  scene_state y = {.x = 0};
  for (int i = 0; i < N_STEADY_REFERENCES; ++i) {
    const steady_reference *want = &steady_references[i];
    if (strcmp(want->name, name) || strcmp(want->sweep, sweep)) continue;
    assert_int_equal(timeint_sweep(ti, from, want->omega, y.all, NULL), HC_OK);
    assert_int_equal(timeint_steady(ti, from = want->omega, y.all, NULL, &r), HC_OK);
    CHECK_NEAR(r.amplitude, want->amplitude, 1e-8 * want->amplitude, "%s %s amplitude at %g", name, sweep, want->omega);
    CHECK_NEAR(r.harmonic_1, want->harmonic_1, 1e-8 * want->amplitude, "%s %s harmonic_1 at %g", name, sweep,
               want->omega);
    if (r.free_sliders == 0)
      CHECK_NEAR(r.mean, want->mean, 1e-8 * want->amplitude, "%s %s mean at %g", name, sweep, want->omega);
    assert_true((r.switches > 0) == (want->events > 0));
    assert_int_equal(r.period_multiple, 1);
    CHECK_LE(r.multiplier, 1, "%s %s is stable at %g", name, sweep, want->omega);
    ++seen;
  }
  timeint_free(ti);
  CHECK_LE(4, seen, "%s %s", name, sweep);
}

static void both_ways(const char *name, scene sc, double low, double high)
{
  sc.transient.law = TRANSIENT_LAW_EXACT;
  sc.transient.start = TRANSIENT_START_UP;
  follow(&sc, name, "up", low);
  follow(&sc, name, "down", high);
}

static void paper_scenes(CHECK_STATE)
{
  both_ways("a10", scene_a10(), 3, 20);
  both_ways("b10", scene_b10(), 3, 20);
  both_ways("c2", scene_c2(), 3, 20);
  both_ways("c2kn1e4", scene_c2kn1e4(), 3, 20);
  both_ways("c2kt1e4", scene_c2kt1e4(), 3, 20);
  both_ways("gap1", scene_gap1(), 3, 30);
}

static void blades(CHECK_STATE)
{
  both_ways("r1", scene_r1(), 600, 1100);
  both_ways("r2", scene_r2(), 600, 1100);
}

CHECK_TESTS_WITH("timeint.exact_reference", 300, read_steady_references, NULL, paper_scenes, blades)
