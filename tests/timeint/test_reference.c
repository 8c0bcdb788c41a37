/* test_reference.c - the regularised law, swept up and down through frequencies whose steady state was computed by
 * another program with the exact law. */

#include "tests/timeint/reference_rows.h"

/* Linear rows (no transition in a period): as test_steady's check_harmonic, 10 tolerances. Others: the regularised
 * law's error, which at regularisation rho is of the order of rho kt cos(alpha) w'/(force), below 1e-4 wherever the
 * curve is not vertical: the figure asked for. */
static void both_ways(const char *name)
{
  const scene sc = scene_reference(name);
  follow_reference(name, sc, 1e-4, 10 * sc.transient.tolerance);
}

static void a10(CHECK_STATE) { both_ways("a10"); }
static void b10(CHECK_STATE) { both_ways("b10"); }
static void c2(CHECK_STATE) { both_ways("c2"); }
static void c2kt1e4(CHECK_STATE) { both_ways("c2kt1e4"); }
static void gap1(CHECK_STATE) { both_ways("gap1"); }

CHECK_TESTS_WITH("timeint.reference", 600, read_steady_references, NULL, a10, b10, c2, c2kt1e4, gap1)
