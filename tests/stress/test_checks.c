/* test_checks.c - the checks of a stress run must be able to fail: each is given an answer that is wrong by a
 * little, and must call it a finding.
 *
 * The answers are spoiled where they arrive: the linker puts the functions below in front of the library's own
 * (--wrap). Unspoiled, the same scenes, case 2 of the paper and one that slips, end without a finding. */
#include <string.h>

#include "casefile/fields.h"
#include "compare/comparison.h"
#include "hbm/exact_force.h"
#include "stress/outcomes.h"
#include "tests/check.h"

typedef enum spoil {
  NOTHING,
  FORCE_SCALED,
  FORCE_FIXED,
  SOLUTION_SCALED,
  SOLUTION_MOVED,
  ORBIT_SCALED,
  MULTIPLIER,
  REGULARISED_ORBIT,
  VERDICT_MATCHED,
  VERDICT_UNSTABLED,
  NUMBER_LOST
} spoil;
static spoil spoiled;
static const double by = 1e-5; /* ten times what the checks let pass where they compare methods, 1e5 times where
                                  rounding is all there is */

hc_status __real_exact_force_eval(exact_force *e, const double *X, double *F, double *jac, contact_report *report);
hc_status __wrap_exact_force_eval(exact_force *e, const double *X, double *F, double *jac, contact_report *report);
hc_status __wrap_exact_force_eval(exact_force *e, const double *X, double *F, double *jac, contact_report *report)
{
  hc_status st = __real_exact_force_eval(e, X, F, jac, report);
  if (spoiled == FORCE_SCALED && !jac) F[2] *= 1 + by; /* the sine: not what time reflection or a shift leaves alone */
  if (spoiled == FORCE_FIXED && !jac) F[2] += 10 * by * fabs(F[1]);
  return st;
}

static void spoil_solution(double *X)
{
  if (spoiled == SOLUTION_SCALED) X[1] *= 1 + by, X[2] *= 1 + by;
  if (spoiled == SOLUTION_MOVED) X[1] += by; /* an absolute constant */
}

hc_status __real_hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point);
hc_status __wrap_hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point);
hc_status __wrap_hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  hc_status st = __real_hbm_solve(s, omega, X, point);
  spoil_solution(X);
  return st;
}

hc_status __real_hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X,
                                    hbm_point *point);
hc_status __wrap_hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X,
                                    hbm_point *point);
hc_status __wrap_hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  hc_status st = __real_hbm_first_solution(s, omega, monitor, X, point);
  spoil_solution(X);
  return st;
}

static int regularised; /* the law of the handle made last; one is made for each orbit */

hc_status __real_timeint_new(const model *m, const transient_settings *how, timeint **out);
hc_status __wrap_timeint_new(const model *m, const transient_settings *how, timeint **out);
hc_status __wrap_timeint_new(const model *m, const transient_settings *how, timeint **out)
{
  if (how->method == TRANSIENT_METHOD_CVODE) regularised = how->law == TRANSIENT_LAW_REGULARISED; /* else a scout */
  return __real_timeint_new(m, how, out);
}

hc_status __real_timeint_orbit(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                               timeint_result *r);
hc_status __wrap_timeint_orbit(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                               timeint_result *r);
hc_status __wrap_timeint_orbit(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                               timeint_result *r)
{
  hc_status st = __real_timeint_orbit(ti, omega, k, state, monitor, r);
  if (spoiled == ORBIT_SCALED)
    for (int i = 0; i < TIMEINT_WAVE; ++i) r->wave[i] *= 1 + 100 * by;
  if (spoiled == MULTIPLIER) r->multiplier *= 3;
  if (spoiled == REGULARISED_ORBIT && regularised) r->a1 += by * r->amplitude;
  if (spoiled == NUMBER_LOST) r->wave[7] = NAN;
  return st;
}

hc_status __real_comparison_run(const compare_setup *setup, const hc_monitor *monitor, comparison *out);
hc_status __wrap_comparison_run(const compare_setup *setup, const hc_monitor *monitor, comparison *out);
hc_status __wrap_comparison_run(const compare_setup *setup, const hc_monitor *monitor, comparison *out)
{
  hc_status st = __real_comparison_run(setup, monitor, out);
  for (int i = 0; i < out->n_rows; ++i) {
    if (spoiled == VERDICT_MATCHED)
      out->rows[i].verdict = VERDICT_MATCH, out->rows[i].errors.amplitude = 1.01 * setup->limits->most.amplitude;
    if (spoiled == VERDICT_UNSTABLED) out->rows[i].verdict = VERDICT_UNSTABLE;
  }
  return st;
}

/* Case 2 at 6.5, stable; mu 0 makes it conserve what the damper leaves. */
static scene case_2(void)
{
  scene sc;
  field_defaults(&sc);
  sc.mass = 1, sc.damping = 0.4, sc.stiffness = 40, sc.force = 100;
  sc.n_contacts = 1;
  sc.contacts[0] = (scene_contact){{100, 1000, 0.3, -5}, 45};
  sc.omega_from = 6, sc.omega_to = 7;
  sc.compare.omega = (number_list){1, {6.5}};
  sc.hbm.harmonics = 20;
  return sc;
}

static stress_result stressed(scene sc, spoil with)
{
  stress_result r;
  spoiled = with;
  assert_int_equal(stress_scene(&sc, 20, NULL, &r), HC_OK);
  spoiled = NOTHING;
  return r;
}

static void good_answers_are_no_findings(void **state)
{
  (void)state;
  scene slips = case_2();
  slips.contacts[0].law.gap = 0.05;
  for (int i = 0; i < 2; ++i) {
    stress_result r = stressed(i ? slips : case_2(), NOTHING);
    for (int k = 0; k < STRESS_N_CHECKS; ++k)
      if (r.check[k].outcome == STRESS_FINDING || r.check[k].outcome == STRESS_REFUSED)
        fail_msg("scene %d, %s: %s %s", i, stress_kind_name((stress_kind)k), stress_outcome_name(r.check[k].outcome),
                 stress_reason_name(r.check[k].reason));
  }
}

static void expect_finding(spoil with, stress_kind kind)
{
  stress_result r = stressed(case_2(), with);
  const stress_check *c = &r.check[kind];
  if (c->outcome != STRESS_FINDING)
    fail_msg("spoil %d: %s says %s %s, %g of %g", (int)with, stress_kind_name(kind), stress_outcome_name(c->outcome),
             stress_reason_name(c->reason), c->error, c->bound);
}

static void a_wrong_force_is_found(void **state)
{
  (void)state;
  expect_finding(FORCE_FIXED, STRESS_FORCE);
  expect_finding(FORCE_SCALED, STRESS_SHIFT);
  expect_finding(FORCE_FIXED, STRESS_REFLECTION);
}

static void a_wrong_solution_is_found(void **state)
{
  (void)state;
  expect_finding(SOLUTION_SCALED, STRESS_FREE);
  expect_finding(SOLUTION_SCALED, STRESS_STUCK);
  expect_finding(SOLUTION_SCALED, STRESS_ENERGY);
  expect_finding(SOLUTION_MOVED, STRESS_UNITS);
}

static void a_wrong_orbit_is_found(void **state)
{
  (void)state;
  expect_finding(ORBIT_SCALED, STRESS_SHOOTING);
  expect_finding(NUMBER_LOST, STRESS_SHOOTING);
  expect_finding(MULTIPLIER, STRESS_STABILITY);
  expect_finding(REGULARISED_ORBIT, STRESS_REGULARISED);
}

static void a_wrong_verdict_is_found(void **state)
{
  (void)state;
  expect_finding(VERDICT_MATCHED, STRESS_VERDICT);
  expect_finding(VERDICT_UNSTABLED, STRESS_VERDICT);
}

/* What has nothing to do with the fault goes: contacts, harmonics, digits. */
static void a_finding_is_made_small(void **state)
{
  (void)state;
  scene sc = case_2();
  sc.n_contacts = 2;
  sc.contacts[1] = (scene_contact){{1.2345, 2.3456, 0.34567, -4.5678}, 12.345};
  sc.mass = 1.0123456;
  spoiled = MULTIPLIER;
  assert_int_equal(stress_shrink(&sc, STRESS_STABILITY, 20, NULL), HC_OK);
  spoiled = NOTHING;
  assert_int_equal(sc.n_contacts, 1);
  assert_true(sc.hbm.harmonics < 20 && sc.mass == 1);
  stress_result r = stressed(sc, MULTIPLIER);
  assert_int_equal(r.check[STRESS_STABILITY].outcome, STRESS_FINDING);
}

/* A difference as large as the scene's own sensitivity allows is not called an agreement. */
static void what_only_sensitivity_allows_is_ill_conditioned(void **state)
{
  (void)state;
  static const struct {
    double error, sensitive;
    stress_outcome outcome;
    stress_reason reason;
  } rows[] = {{1e-9, 0, STRESS_AGREED, STRESS_NO_REASON},          {1e-9, 1, STRESS_AGREED, STRESS_NO_REASON},
              {1e-3, 1, STRESS_EXPLAINED, STRESS_ILL_CONDITIONED}, {1e-3, 1e-4, STRESS_FINDING, STRESS_DISAGREES},
              {1e-3, NAN, STRESS_FINDING, STRESS_DISAGREES},       {NAN, 1, STRESS_FINDING, STRESS_INTERNAL}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
    const stress_check c = stress_agree_within(rows[i].error, 1e-6, rows[i].sensitive);
    assert_int_equal(c.outcome, rows[i].outcome);
    assert_int_equal(c.reason, rows[i].reason);
  }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_only_sensitivity_allows_is_ill_conditioned),
    cmocka_unit_test(good_answers_are_no_findings),
    cmocka_unit_test(a_wrong_force_is_found),
    cmocka_unit_test(a_wrong_solution_is_found),
    cmocka_unit_test(a_wrong_orbit_is_found),
    cmocka_unit_test(a_wrong_verdict_is_found),
    cmocka_unit_test(a_finding_is_made_small),
};
CHECK_MAIN("stress.checks", tests, 300)
