/* test_families.c - steady states that are members of a family: a slider that never slips rests where the start put it.
 * From rest, and swept up and down, against an independent program. */
#include "tests/timeint/structure_rows.h"

enum { STATES = 16 };

static const transient_settings closed_form = CLOSED_FORM(1e-10, 20000);

/* From rest and swept both ways. Left out are sweeps of chain3 between 1.485 and 1.52, of wedge_F0.5 at 35 and of
 * wedge_F2 at 37, where members differ in everything (from rest these are unique), or two branches are stable: where a
 * sweep leaves one of them depends on its steps. Period 2 at 32 of wedge_F10. The reference's marching stops at 1e-9 of
 * the state or better where a mean creeps. */
static void every_row(CHECK_STATE)
{
  static const char *const named[] = {"jenkins2", "chain3", "wedge_F0.5", "wedge_F2", "wedge_F10", "wedge_F20"};
  int checked = 0;
  for (size_t k = 0; k < sizeof named / sizeof *named; ++k) {
    const structure_case c = structure_case_named(named[k], 3);
    for (transient_start start = TRANSIENT_START_REST; start <= TRANSIENT_START_DOWN; ++start)
      checked += check_structure_rows(c.model, named[k], start, true, closed_form, 2e-9);
    model_free(c.model);
  }
  assert_int_equal(checked, 87);
}

/* At 1.485 two motions of chain3 are stable, and a sweep down in small steps stays on the other one: the reference
 * finds it from two of its three HBM solutions, x3 = 1.1445, and the first from rest and from the third. */
static void two_stable_motions(CHECK_STATE)
{
  const structure_case c = structure_case_named("chain3", 3);
  transient_settings how = closed_form;
  how.start = TRANSIENT_START_DOWN;
  double y[STATES] = {0};
  CHECK_MADE(timeint, ti, timeint_new(c.model, &how, &ti));
  assert_int_equal(timeint_sweep(ti, 1.9, 1.485, y, NULL), HC_OK);
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, 1.485, y, NULL, &r));
  CHECK_LE(r.multiplier, 1 - 1e-3, "down at 1.485");
  CHECK_NEAR(r.amplitude, 0.0530509414153658, 2e-9, "down at 1.485, x1");
  assert_int_equal(timeint_response(ti, 2, &r), HC_OK);
  CHECK_NEAR(r.amplitude, 1.14453458651279, 2e-9, "down at 1.485, x3");
  timeint_free(ti);
  model_free(c.model);
}

/* Marched from rest, without the multipliers that tell free sliders where an orbit is solved for. */
static void marching_counts_them_too(CHECK_STATE)
{
  static const struct {
    const char *name;
    double omega;
    int free_sliders;
  } marched[] = {{"wedge_F0.5", 37, 2}, {"wedge_F2", 37, 1}, {"wedge_F2", 35, 0}};
  for (size_t i = 0; i < sizeof marched / sizeof *marched; ++i) {
    const structure_case c = structure_case_named(marched[i].name, 3);
    transient_settings how = closed_form;
    how.steady = TRANSIENT_STEADY_MARCH;
    double y[STATES];
    timeint *ti = at_rest(c.model, &how, y);
    CHECK_FILLED(timeint_result, r, timeint_steady(ti, marched[i].omega, y, NULL, &r));
    assert_int_equal(r.method, TIMEINT_BY_MARCHING);
    assert_int_equal(r.free_sliders, marched[i].free_sliders);
    timeint_free(ti);
    model_free(c.model);
  }
}

/* A motion that nothing holds or damps: wherever the structure stands is an orbit, but for the rounding of K. An orbit
 * that is known to no digit of its own size is not told. */
static void what_floats_does_not_settle(CHECK_STATE)
{
  static const char *const rows[][2] = {
      {"structure.mass=[1.61, 1.84, 1]", "structure.stiffness=[[12.5,-12.5,0],[-12.5,31.76,-19.26],[0,-19.26,19.26]]"},
      {"structure.mass=[0.33, 1.35, 0.87]",
       "structure.stiffness=[[28.05,-28.05,0],[-28.05,40.17,-12.12],[0,-12.12,12.12]]"},
      {"structure.mass=[1.74, 1.1, 1.5]", "structure.stiffness=[[14.5,-14.5,0],[-14.5,17.55,-3.05],[0,-3.05,3.05]]"}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
    const char *const set[] = {rows[i][0], rows[i][1], "structure.damping={modal: 0.007}",
                               "contacts=[{normal_stiffness: 1, gap: -10, normal: {3: 1}, tangent: {1: 1}, "
                               "tangential_stiffness: 9, friction: 0.5}]",
                               "forcing=[{dof: 1, amplitude: 0.3}, {dof: 2, amplitude: 1, phase_deg: 30}]"};
    const structure_case c = structure_case_with("chain3", 1, 5, set);
    transient_settings how = CLOSED_FORM(1e-9, 300);
    how.start = TRANSIENT_START_HBM;
    timeint_result r;
    double y[STATES] = {0}, X[CASE_MAX_COEF] = {0};
    hbm_solver *s = structure_solver(&c);
    CHECK_MADE(timeint, ti, timeint_new(c.model, &how, &ti));
    CHECK_FILLED(hbm_point, point, hbm_first_solution(s, 0.95, NULL, X, &point));
    assert_int_equal(hbm_state(s, 0.95, X, y, y + 3), HC_OK);
    assert_int_not_equal(timeint_steady(ti, 0.95, y, NULL, &r), HC_OK);
    hbm_solver_free(s);
    timeint_free(ti);
    model_free(c.model);
  }
}

CHECK_TESTS_WITH("timeint.families", 100, read_structure_rows, NULL, every_row, two_stable_motions,
                 marching_counts_them_too, what_floats_does_not_settle)
