/* test_once.c - nothing is solved twice: case 2's comparison, counted. More: something is, or a step was too long. */
#include "compare/comparison.h"
#include "tests/case_scene.h"

enum { ROWS = 10, AT_ANOTHER = 2, LINEAR = 3 }; /* of the rows: from unstable solutions; where nothing touches */

static comparison compared(int n_set, const char *const *set, bool spare)
{
  const scene sc = case_scene("paper/case2", n_set, set);
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  setup.spare = spare;
  CHECK_FILLED(comparison, c, comparison_run(&setup, NULL, &c));
  scene_setup_clear(&setup);
  assert_int_equal(c.n_rows, ROWS);
  return c;
}

/* What the rows themselves say they took. */
static int reported(const comparison *c)
{
  int periods = 0;
  for (int i = 0; i < c->n_rows; ++i) periods += c->rows[i].transient.periods;
  return periods;
}

/* The exact law: one period of CVODE's for each orbit, and that only once: the referee is the transient, a second
 * solution's motion goes to the first's orbit. The unstable solutions have orbits of their own beside them. */
static void exact_law(CHECK_STATE)
{
  static const char *const exact[] = {"transient.law=exact"};
  comparison c = compared(1, exact, true);
  assert_int_equal(reported(&c), ROWS - LINEAR - AT_ANOTHER);
  assert_int_equal(c.cost.periods, ROWS - LINEAR);
  comparison_clear(&c);
}

/* Regularised: at most three periods an orbit, one or two for the prediction, one for the exact orbit. */
static void regularised_law(CHECK_STATE)
{
  comparison c = compared(0, NULL, true);
  const int orbits = ROWS - LINEAR - AT_ANOTHER;
  CHECK_LE(reported(&c), 3 * orbits, "transients");
  CHECK_LE(c.cost.periods, reported(&c) + 2 * orbits + ROWS - LINEAR, "with predictions and referees");
  CHECK_LE(2 * orbits, reported(&c), "each is confirmed");
  comparison_clear(&c);
}

/* What csv shows in addition: the same orbits with finer steps, two periods each. */
static void finer_steps_only_where_shown(CHECK_STATE)
{
  comparison spare = compared(0, NULL, true), full = compared(0, NULL, false);
  const int orbits = ROWS - LINEAR - AT_ANOTHER;
  CHECK_LE(spare.cost.periods + orbits, full.cost.periods, "finer steps");
  CHECK_LE(full.cost.periods, spare.cost.periods + 2 * orbits + 1, "two periods each, one a third where they scatter");
  assert_true(spare.cost.hbm_solves == full.cost.hbm_solves);
  for (int i = 0; i < ROWS; ++i) {
    assert_int_equal(spare.rows[i].verdict, full.rows[i].verdict);
    assert_true(spare.rows[i].transient.amplitude == full.rows[i].transient.amplitude);
    assert_true(isnan(spare.rows[i].budget.amplitude.integration) ||
                full.rows[i].transient.method == TIMEINT_BY_CLOSED_FORM);
  }
  comparison_clear(&spare);
  comparison_clear(&full);
}

/* HBM: the curve, and what lies between its points; nothing for budgets and verdicts. */
static void systems_solved(CHECK_STATE)
{
  comparison c = compared(0, NULL, false);
  CHECK_LE(c.cost.hbm_solves, c.curve.n + c.curve.rejected + 12 * ROWS, "Newton solves");
  print_message("case 2: %ld HBM solves, %d points, %d rejected; %ld periods by CVODE, %ld in closed form\n",
                c.cost.hbm_solves, c.curve.n, c.curve.rejected, c.cost.periods, c.cost.closed_form);
  comparison_clear(&c);
}

/* HBM's multipliers are computed only where the exact orbit does not decide; verdicts are the same with all of them. */
static void multipliers_only_where_they_decide(CHECK_STATE)
{
  comparison c[2];
  const scene sc = case_scene("paper/fig09_gap_0", 1, (const char *const[]){"compare.omega=4.969845253019276"});
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  for (int k = 0; k < 2; ++k) setup.multipliers = k, assert_int_equal(comparison_run(&setup, NULL, &c[k]), HC_OK);
  assert_true(c[0].n_rows == 3 && c[1].n_rows == 3);
  for (int i = 0; i < 3; ++i) {
    assert_true((i == 0) == (c[0].rows[i].orbit_status == HC_OK) &&
                (i > 0) == (isnan(c[0].rows[i].stability.multiplier) == 0));
    assert_true(!isnan(c[1].rows[i].stability.multiplier) && c[0].rows[i].verdict == c[1].rows[i].verdict);
  }
  for (int k = 0; k < 2; ++k) comparison_clear(&c[k]);
  scene_setup_clear(&setup);
}

CHECK_TESTS("compare.once", 60, exact_law, regularised_law, finer_steps_only_where_shown, systems_solved,
            multipliers_only_where_they_decide)
