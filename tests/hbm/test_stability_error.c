/* test_stability_error.c - what the words about stability are worth: the multipliers' predicted error, the special
 * points' error in omega, and whether either end of a sweep finds the same ones. */
#include "compare/study/scene_solvers.h"
#include "hbm/hbm.h"
#include "model/casefile/case_file.h"
#include "tests/hbm/structure_cases.h"

/* Two masses and a stop (NLvib's example 03). Of the exact orbit's upper branch at 0.7 the multiplier is 0.8586, proven
 * (proof/), and it doubles its period at 0.7388, which Runge and Kutta's integration gives, too. The solution's own
 * multiplier there is 4.7 with 10 harmonics, 2.7 with 15, 1.6 with 21, 1.03 with 30. */
static const double exact_multiplier = 0.8586, exact_doubling = 0.7388;
static const int orders[] = {7, 10, 15, 21, 30, 60};
enum { N_ORDERS = sizeof orders / sizeof *orders };

static hbm_solver *trace_stop(int n_harm, hbm_curve *curve)
{
  structure_case c = structure_case_named("stop2", n_harm);
  hbm_solver *s = structure_solver(&c);
  assert_int_equal(hbm_trace(s, c.from, c.to, NULL, curve), HC_OK);
  model_free(c.model);
  return s;
}

/* Unknown or right, and right where 60 harmonics say it. Seven digits of the closed form are not asked for: 0.8586 is
 * what is between low and high, to its own last digit. */
static void a_word_is_unknown_where_its_error_reaches_one(CHECK_STATE)
{
  for (int i = 0; i < N_ORDERS; ++i) {
    hbm_curve curve = {0}, at = {0};
    hbm_solver *s = trace_stop(orders[i], &curve);
    assert_int_equal(hbm_curve_at(s, &curve, 0.7, &at), HC_OK);
    assert_int_equal(at.n, 3);
    const double *X = hbm_curve_X(&at, 2);
    CHECK_FILLED(hbm_stability, own, hbm_stability_at(s, 0.7, X, &own));
    CHECK_FILLED(hbm_stability, st, hbm_stability_with_error(s, 0.7, X, false, &st));
    CHECK_LE(st.low, exact_multiplier + 5e-5, "H = %d", orders[i]);
    CHECK_LE(exact_multiplier - 5e-5, st.high, "H = %d", orders[i]);
    assert_true(st.multiplier == own.multiplier && own.low == own.multiplier && own.high == own.multiplier);
    assert_true(orders[i] < 60 ? hbm_stability_verdict(&st) >= 0 : hbm_stability_verdict(&st) == 1);
    if (orders[i] < 30) assert_int_equal(hbm_stability_verdict(&own), -1); /* what the word was without its error */
    /* the branch below touches nothing: its multipliers are the structure's, whatever the motion */
    CHECK_FILLED(hbm_stability, linear, hbm_stability_with_error(s, 0.7, hbm_curve_X(&at, 0), false, &linear));
    assert_true(!linear.of_motion && linear.low == linear.high);
    assert_int_equal(hbm_stability_verdict(&linear), 1);
    hbm_curve_free(&at);
    hbm_curve_free(&curve);
    hbm_solver_free(s);
  }
}

/* The last doubling of the sweep, on the upper branch; turning points and contact changes have no such error. */
static void a_doubling_is_placed_to_its_error(CHECK_STATE)
{
  double last = INFINITY;
  for (int i = 1; i < N_ORDERS; ++i) {
    hbm_curve curve = {0};
    hbm_solver *s = trace_stop(orders[i], &curve);
    hbm_special *special, doubling = {.omega = NAN};
    int n;
    assert_int_equal(hbm_specials(s, &curve, &special, &n), HC_OK);
    for (int k = 0; k < n; ++k) {
      if (special[k].kind == HBM_PERIOD_DOUBLING) doubling = special[k];
      if (special[k].kind == HBM_TURNING_POINT || special[k].kind == HBM_CONTACT_CHANGE)
        assert_true(special[k].omega_error == 0);
    }
    CHECK_LE(fabs(doubling.omega - exact_doubling), doubling.omega_error + 5e-5, "H = %d: %g", orders[i],
             doubling.omega);
    CHECK_LE(doubling.omega_error, 0.1, "H = %d", orders[i]);
    last = doubling.omega_error;
    free(special);
    hbm_curve_free(&curve);
    hbm_solver_free(s);
  }
  CHECK_LE(last, 0.01, "60 harmonics know better");
}

/* Two masses, a contact that opens and one that does not. Between 8 and 8.3 a multiplier goes through -1 and back
 * within one step of the sweep upwards. */
static const char two_masses[] =
    "title: t\nstructure:\n  mass: [[1, 0], [0, 2]]\n  stiffness: [[90, -30], [-30, 150]]\n"
    "  damping: [[0.3, -0.1], [-0.1, 0.3]]\nforcing:\n  - {direction: {1: 1}, amplitude: 4, harmonic: 1}\n"
    "  - {direction: {2: 1}, amplitude: 2, phase_deg: 50, harmonic: 2}\ncontacts:\n"
    "  - {tangential_stiffness: 80, normal_stiffness: 120, friction: 0.4, gap: 0.03, tangent: {1: 1, 2: -0.3}, "
    "normal: {2: 1, 1: 0.2}}\n  - {tangential_stiffness: 40, friction: 0.3, preload: 3, tangent: {2: 1}}\n"
    "response: [1, 2]\nsweep: {omega: [7, 12]}\nhbm: {harmonics: 11}\ncompare: {omega: [9]}\n";

/* omega of all that are no contact changes, ascending. */
static int changes_of_stability(double from, double to, double *omega, int *contact_changes)
{
  scene sc;
  case_error err;
  if (case_parse("f", two_masses, strlen(two_masses), 0, NULL, &sc, &err) != HC_OK) fail_msg("%s", err.message);
  hbm_curve curve = {0};
  hbm_special *special;
  int n, kept = 0;
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  assert_int_equal(hbm_trace(s, from, to, NULL, &curve), HC_OK);
  assert_int_equal(hbm_specials(s, &curve, &special, &n), HC_OK);
  for (int k = 0; k < n && kept < 8; ++k)
    if (special[k].kind != HBM_CONTACT_CHANGE) omega[kept++] = special[k].omega;
  *contact_changes = n - kept;
  qsort(omega, (size_t)kept, sizeof *omega, ascending);
  free(special);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  case_clear(&sc);
  return kept;
}

/* Located to 1e-9 from either end (special_points.h). From 5 upwards the steps about 8 are 0.27 long. */
static void either_end_finds_the_same(CHECK_STATE)
{
  static const double from_below[] = {5, 7};
  for (int i = 0; i < 2; ++i) {
    double up[8], down[8];
    int changes;
    const int n = changes_of_stability(from_below[i], 12, up, &changes),
              m = changes_of_stability(12, 7, down, &changes);
    int first = 0; /* from 5 on there is one doubling and two turning points more, below 7 */
    while (first < n && up[first] < 7) ++first;
    assert_int_equal(m, 4);
    assert_int_equal(n - first, m);
    for (int k = 0; k < m; ++k)
      CHECK_NEAR(up[first + k], down[k], 2e-9 * down[k], "from %g, point %d", from_below[i], k);
    assert_true(i > 0 || first == 3);
  }
}

CHECK_TESTS("hbm.stability_error", 100, a_word_is_unknown_where_its_error_reaches_one,
            a_doubling_is_placed_to_its_error, either_end_finds_the_same)
