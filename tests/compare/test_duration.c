/* test_duration.c - a run's time foretold: the arithmetic; times of the very model; nothing measured of a small one. */
#include "compare/duration.h"
#include "tests/scene_runs.h"

/* Rounding of some ten operations. */
static const double rounding = 1e-14;

#define CHECK_SECONDS(value, expected) CHECK_NEAR((value) / (expected), 1, rounding, #value)

/* A Newton step of 10 ms with 7 harmonics: 250 of them a curve, 2.5 s; with 22, three times the unknowns, 27 times
 * that. Orbits by chord steps: 5 x 0.5 + 10 x 0.2 + 2 x 1.5 = 7.5 s a solution; by Newton 2.5 + 20 x 1.5 = 32.5 s. */
static const duration_units chords = {
    .newton = 0.01,
    .harmonics = 7,
    .period = {.by_cvode = 0.5, .closed_form = 0.2, .matrix = 1.5, .cvodes_matrix = 4, .chords = true}};

static void times_are_multiplied_by_how_many(CHECK_STATE)
{
  duration_units newton = chords;
  newton.period.chords = false;
  CHECK_SECONDS(duration_of_curve(&chords, 7), 2.5);
  CHECK_SECONDS(duration_of_curve(&chords, 22), 67.5);
  CHECK_SECONDS(duration_of_comparison(&chords, 3), 2.5 + 3 * 7.5);
  CHECK_SECONDS(duration_of_comparison(&newton, 3), 2.5 + 3 * 32.5);
  CHECK_SECONDS(duration_of_steady_states(&chords, 3), 2.5 + 0.7 * 3 * 7.5);
  /* With 7 and 22 harmonics, exact and by two rates; compared with the curve of 22; 24 orbits, 0.3 of a solution. */
  const compare_settings lists = {.harmonics = {.n = 2, .v = {7, 22}}, .samples = {.n = 2, .v = {64, 128}}};
  const double tables = 67.5 + 3 * (2.5 + 67.5) + 8 * 0.3 * 7.5;
  CHECK_SECONDS(duration_of_tables(&chords, &lists), tables);
  CHECK_SECONDS(duration_of_report(&chords, 3, &lists), 2.5 + 3 * 7.5 + 7 * 2.5 + tables);
  CHECK_SECONDS(duration_of_tables(&newton, &lists), 67.5 + 3 * (2.5 + 67.5) + 24 * 0.3 * 32.5 + 30 * 4);
  const compare_settings few = {.harmonics = {.n = 1, .v = {7}}};
  newton.reference = 22;
  CHECK_SECONDS(duration_of_tables(&newton, &few), 67.5 + 2.5 + 24 * 0.3 * 32.5 + 30 * 4);
  /* 20 harmonics; 5 steps a point; at most 20 points are held against time integration. */
  const double more = pow(41.0 / 15, 3);
  CHECK_SECONDS(duration_of_verification(&chords, 8), more * (2.5 + 8 * 0.05) + 8 * 0.3 * 7.5);
  CHECK_SECONDS(duration_of_verification(&chords, 100), more * (2.5 + 100 * 0.05) + 20 * 0.3 * 7.5);
}

static duration_units units_of(const char *name)
{
  scene sc = case_scene(name, 0, NULL);
  duration_units u;
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  duration_measure(&setup, &u);
  scene_setup_clear(&setup);
  case_clear(&sc);
  return u;
}

static void only_what_can_last_is_measured(CHECK_STATE)
{
  static const char *const small[] = {"paper/case2", "structures/chain3", "structures/space"};
  for (size_t i = 0; i < sizeof small / sizeof *small; ++i) {
    const duration_units u = units_of(small[i]);
    assert_true(u.newton == 0 && duration_of_comparison(&u, 256) == 0);
  }
  const duration_units beam = units_of("structures/beam16"), plates = units_of("structures/plates");
  assert_true(beam.newton > 0 && beam.period.by_cvode > 0 && beam.period.closed_form > 0);
  assert_true(beam.period.matrix > 0 && beam.period.cvodes_matrix > 0);
  assert_true(!beam.period.chords && plates.period.chords);         /* 16 modes, 84 */
  const duration_units blade = units_of("structures/blade_damper"); /* 534 states, nothing changes */
  CHECK_LE(blade.period.matrix, 11 * blade.period.closed_form, "6 periods, 22 if all change; both times vary by half");
  CHECK_LE(10 * beam.period.closed_form, plates.period.closed_form, "a period of 84 modes and 24 contact rows");
}

/* CVODE_PERIODS also where steps with the closed form's matrix stop a sixth of the change away from the orbit of half
 * the regularisation. By Newton 6.59956e-5, by three more periods, of which each has a matrix by CVODES, as dear as 50.
 * Half of the regularisation is half of the change: known to a quarter, to a half of itself. */
static void predictions_take_no_matrix_by_cvode(CHECK_STATE)
{
  scene sc = case_scene("structures/beam_pairs", 0, NULL);
  sc.compare.omega = (number_list){1, {112.38146907313845}};
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  assert_int_equal(c.n_rows, 2);
  CHECK_LE((double)c.cost.periods, 12, "periods by CVODE");
  CHECK_NEAR(c.rows[1].transient_predicted.amplitude / 6.59956e-5, 1, 0.5, "what was predicted by Newton");
  comparison_clear(&c);
  case_clear(&sc);
}

/* A large structure whose contacts all stick: time integration and HBM have the same linear multipliers, 1e-8 as found
 * by a map of chord steps; the regularised law differs by some of its 1e-4. Sliders that slip on the way to the orbit,
 * or that slowed modes shake, are not in its matrix. */
static void what_rests_has_the_multipliers_of_hbm(CHECK_STATE)
{
  scene sc = case_scene("structures/blade_damper", 0, NULL);
  sc.compare.omega = (number_list){1, {300 * TWO_PI}};
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  assert_int_equal(c.n_rows, 1);
  CHECK_NEAR(c.rows[0].orbit.multiplier, c.rows[0].stability.multiplier, 1e-8, "of the orbit");
  CHECK_LE(c.rows[0].transient_predicted.amplitude, 1e-4, "what the regularisation is expected to do");
  CHECK_LE((double)c.cost.periods, 8, "periods by CVODE");
  comparison_clear(&c);
  case_clear(&sc);
}

CHECK_TESTS("compare.duration", 60, times_are_multiplied_by_how_many, only_what_can_last_is_measured,
            predictions_take_no_matrix_by_cvode, what_rests_has_the_multipliers_of_hbm)
