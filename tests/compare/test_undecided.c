/* test_undecided.c - searches that fail decide nothing. The linker gives this program timeint_orbit, timeint_steady and
 * hbm_solve by other names: they fail when they are told to. */
#include "tests/hbm/scenes.h"
#include "tests/scene_runs.h"
#include "tests/wrap.h"

static bool no_orbit, no_exact_solution;
static hc_status perturbed; /* of each transient of a motion pushed off its orbit, marched; HC_OK: its own */

WRAP(hc_status, timeint_orbit,
     (timeint * ti, double omega, int k, double *state, const hc_monitor *monitor, timeint_result *r))
{
  return no_orbit ? HC_NOT_CONVERGED : __real_timeint_orbit(ti, omega, k, state, monitor, r);
}

static bool marches; /* the handle made last */

WRAP(hc_status, timeint_new, (const model *m, const transient_settings *how, timeint **out))
{
  marches = how->steady == TRANSIENT_STEADY_MARCH;
  return __real_timeint_new(m, how, out);
}

WRAP(hc_status, timeint_steady,
     (timeint * ti, double omega, double *state, const hc_monitor *monitor, timeint_result *r))
{
  const bool fails = marches && perturbed != HC_OK;
  marches = false;
  return fails ? perturbed : __real_timeint_steady(ti, omega, state, monitor, r);
}

WRAP(hc_status, hbm_solve, (hbm_solver * s, double omega, double *X, hbm_point *point))
{
  return no_exact_solution && hbm_n_samples(s) == 0 ? HC_NOT_CONVERGED : __real_hbm_solve(s, omega, X, point);
}

static void run(scene *sc, double omega, comparison *c)
{
  sc->gate.most = (discrepancy){1e-3, 1e-3, 1e-3, 5e-3};
  sc->compare.omega = (number_list){1, {omega}};
  assert_int_equal(scene_comparison_run(sc, NULL, c), HC_OK);
}

/* A transient swept up to 9 runs elsewhere than on the small solution: whether that has an orbit is not known. */
static void an_orbit_that_is_not_found_is_no_disagreement(CHECK_STATE)
{
  scene sc = exact_scene("c2", 3, false);
  comparison c;
  int undecided = 0;
  sc.transient = (transient_settings){.law = TRANSIENT_LAW_EXACT,
                                      .start = TRANSIENT_START_UP,
                                      .regularisation = 1e-4,
                                      .tolerance = 1e-9,
                                      .max_periods = 200};
  no_orbit = true;
  run(&sc, 9, &c);
  no_orbit = false;
  for (int i = 0; i < c.n_rows; ++i) {
    const comparison_row *r = &c.rows[i];
    assert_true(r->verdict != VERDICT_DIFFERS);
    undecided += r->verdict == VERDICT_UNDECIDED;
    if (r->verdict == VERDICT_UNDECIDED) assert_false(r->budget.known);
  }
  assert_true(undecided > 0);
  assert_int_equal(comparison_exit_code(&c), 1); /* where the transient went, no solution is */
  comparison_clear(&c);
}

/* Without the solution with exact forces, aliasing and truncation are not told apart. */
static void parts_without_a_solution_between_are_not_known(CHECK_STATE)
{
  scene sc = exact_scene("c2", 3, true);
  comparison c;
  sc.hbm.force = HBM_FORCE_SAMPLED, sc.hbm.samples = 32;
  sc.transient =
      (transient_settings){.law = TRANSIENT_LAW_EXACT, .regularisation = 1e-4, .tolerance = 1e-9, .max_periods = 200};
  no_exact_solution = true;
  run(&sc, 7, &c);
  no_exact_solution = false;
  assert_int_equal(c.n_rows, 1);
  const error_budget *b = &c.rows[0].budget;
  double share;
  char text[BUDGET_TEXT];
  assert_true(b->known && isnan(b->amplitude.aliasing) && isnan(b->amplitude.truncation));
  assert_null(budget_largest(b, &share));
  assert_non_null(strstr(budget_text(b, &sc.gate.most, text), "of parts that are not known"));
  comparison_clear(&c);
}

/* The second solution of chain3 at 1.514 has sliders at their limits, where motions are pushed to both sides. */
static verdict at_corner(hc_status of_perturbed)
{
  const char *const sets[] = {"hbm.harmonics=31", "compare.omega=1.514"};
  scene sc = case_scene("structures/chain3", 2, sets);
  comparison c;
  perturbed = of_perturbed;
  assert_int_equal(scene_comparison_run(&sc, NULL, &c), HC_OK);
  perturbed = HC_OK;
  int k = 1;
  while (k < c.n_rows && c.rows[k].response > 0) ++k;
  assert_true(k < c.n_rows);
  const verdict v = c.rows[k].verdict;
  comparison_clear(&c);
  case_clear(&sc);
  return v;
}

static void a_perturbed_motion_that_is_not_found_proves_no_stability(CHECK_STATE)
{
  assert_int_equal(at_corner(HC_OK), VERDICT_UNSTABLE);
  assert_int_equal(at_corner(HC_UNBOUNDED), VERDICT_UNSTABLE);
  assert_int_equal(at_corner(HC_INTEGRATOR), VERDICT_UNDECIDED);
}

CHECK_TESTS("compare.undecided", 60, an_orbit_that_is_not_found_is_no_disagreement,
            parts_without_a_solution_between_are_not_known, a_perturbed_motion_that_is_not_found_proves_no_stability)
