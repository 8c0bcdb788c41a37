/* test_exact_reference.c - the exact law by CVODE, swept up and down, against every row of
 * tests/reference/transient_exact.csv. */

#include "tests/timeint/reference_rows.h"

/* Of every third scene; in the long run of all. To 1e-8: the table is "good to about 1e-9", and so is ours,
 * transient.tolerance = 1e-9 of the motion. */
static void every_row(CHECK_STATE)
{
  for (int i = 0; i < N_REFERENCE_SCENES; i += check_long ? 1 : 3) {
    scene sc = scene_reference(reference_scenes[i].name);
    sc.transient.law = TRANSIENT_LAW_EXACT;
    sc.transient.start = TRANSIENT_START_UP;
    follow_reference(reference_scenes[i].name, sc, 1e-8, 1e-8);
  }
}

CHECK_TESTS_AND_LONG_WITH("timeint.exact_reference", 300, read_steady_references, NULL, (every_row), (every_row))
