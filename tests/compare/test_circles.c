/* test_circles.c - the comparison of contacts with two tangents under the law of the circle: both sides agree, and
 * where they are made to differ the cause is named and as large as it must be. */
#include "tests/scene_runs.h"

enum { SETTINGS = 4 };

static void compare(const char *name, const char *const set[SETTINGS], scene *sc, comparison *c)
{
  int n = 0;
  while (n < SETTINGS && set[n]) ++n;
  *sc = case_scene(name, n, set);
  assert_int_equal(scene_comparison_run(sc, NULL, c), HC_OK);
}

/* With 15 harmonics nothing of four frequencies, creep, slip round, lift-off, is beyond a thousandth. */
static void all_rows_match(CHECK_STATE)
{
  static const struct {
    const char *name;
    int responses;
  } scenes[] = {{"structures/plane", 2}, {"structures/space", 3}};
  static const char *const laws[][SETTINGS] = {
      {"hbm.harmonics=15", "transient.law=exact", "transient.method=closed_form"},
      {"hbm.harmonics=15", "transient.law=exact"},
      {"hbm.harmonics=15"}};
  for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i)
    for (size_t k = 0; k < sizeof laws / sizeof *laws; ++k) {
      scene sc;
      comparison c;
      compare(scenes[i].name, laws[k], &sc, &c);
      assert_int_equal(c.n_rows, 4 * scenes[i].responses);
      for (int j = 0; j < c.n_rows; ++j) {
        const comparison_row *r = &c.rows[j];
        if (!comparison_agrees(r)) fail_msg("%s, law %zu, at %g: no match", scenes[i].name, k, r->omega);
        assert_true(r->transient.regime > CONTACT_STUCK && !r->unexpected && r->budget.known);
      }
      comparison_clear(&c);
      case_clear(&sc);
    }
}

/* 32 samples a period miss where slip begins and ends: what is off is aliasing, which is said.
 * Nothing else of the difference is a hundredth of that: 15 harmonics suffice (above), the transient is exact. */
static void too_few_samples_are_named(CHECK_STATE)
{
  static const char *const set[SETTINGS] = {"hbm.harmonics=15", "hbm.force=sampled", "hbm.samples=32",
                                            "transient.law=exact"};
  scene sc;
  comparison c;
  int differ = 0;
  compare("structures/plane", set, &sc, &c);
  for (int j = 0; j < c.n_rows; ++j) {
    double share = 0;
    const comparison_row *r = &c.rows[j];
    if (r->verdict != VERDICT_DIFFERS) continue;
    ++differ;
    assert_string_equal(budget_largest(&r->budget, &share), "aliasing");
    assert_true(share > 0.98);
  }
  assert_true(differ >= 4);
  comparison_clear(&c);
  case_clear(&sc);
}

/* e(rho) = a rho + b rho^2 + ...: half the parameter leaves half of the error, and e(rho)/e(rho/2) tends to 2. */
static void the_regularisation_is_of_first_order(CHECK_STATE)
{
  enum { STEPS = 3, MOST_ROWS = 8 };
  static const char *const steps[STEPS] = {"transient.regularisation=4e-3", "transient.regularisation=2e-3",
                                           "transient.regularisation=1e-3"};
  double e[STEPS][MOST_ROWS];
  int rows = 0;
  for (int i = 0; i < STEPS; ++i) {
    const char *const set[SETTINGS] = {"hbm.harmonics=5", "transient.law=regularised", steps[i]};
    scene sc;
    comparison c;
    compare("structures/plane", set, &sc, &c);
    rows = c.n_rows;
    assert_true(rows <= MOST_ROWS);
    for (int j = 0; j < rows; ++j) e[i][j] = c.rows[j].budget.waveform.regularisation;
    comparison_clear(&c);
    case_clear(&sc);
  }
  assert_int_equal(rows, MOST_ROWS);
  for (int j = 0; j < rows; ++j) {
    const double first = e[0][j] / e[1][j], second = e[1][j] / e[2][j];
    CHECK_NEAR(first, 2, 0.2, "row %d", j);
    CHECK_LE(fabs(second - 2), 0.8 * fabs(first - 2) + 1e-3, "row %d", j);
  }
}

static bool never_falls_back(void *self, double done)
{
  double *last = self;
  if (done < 0) return true;
  if (!(done >= *last && done <= 1)) fail_msg("%g after %g", done, *last);
  *last = done;
  return true;
}

/* The curve first, then the frequencies: what is done is a part of all of it. */
static void progress_goes_on_from_the_curve(CHECK_STATE)
{
  static const char *const set[] = {"compare.omega=[10.5]", "transient.law=exact", "transient.method=closed_form"};
  scene sc = case_scene("structures/plane", 3, set);
  double last = 0;
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, &(hc_monitor){never_falls_back, &last}, &c));
  CHECK_NEAR(last, 1, 1e-12, "at the end");
  comparison_clear(&c);
  case_clear(&sc);
}

CHECK_TESTS("compare.circles", 120, progress_goes_on_from_the_curve, all_rows_match, too_few_samples_are_named,
            the_regularisation_is_of_first_order)
