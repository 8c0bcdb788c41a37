/* test_escape.c - motions without a steady state: a body that creeps, with its drift in each period in closed form, and
 * growth without bound. What is near to either settles. */
#include "tests/closed_form.h"
#include "timeint/steady/steady.h"
#include "timeint/timeint.h"

static const double mu_N = 1;

/* One mass, a slider of limit mu N = 1 along it; static load and amplitude of cos(omega t). */
static model *slider(double damping, double stiffness, double load, double amplitude)
{
  model *m;
  assert_int_equal(model_new(1, 2, 1, 1, &m), HC_OK);
  *m->mass = 1, *m->damping = damping, *m->stiffness = stiffness, *m->responses = 1;
  *m->loads[0].cosine = load;
  m->loads[1].harmonic = 1, *m->loads[1].cosine = amplitude;
  m->contacts[0].law = (contact){.kt = 20, .mu = 0.5, .load = mu_N / 0.5};
  *m->contacts[0].tangent = 1;
  return m;
}

static hc_status from_rest(const model *m, const transient_settings *how, double omega, timeint_result *r)
{
  timeint *ti;
  double state[3];
  assert_int_equal(timeint_new(m, how, &ti), HC_OK);
  timeint_rest(ti, state);
  const hc_status st = timeint_steady(ti, omega, state, NULL, r);
  timeint_free(ti);
  return st;
}

static const transient_settings ways[] = {
    {.tolerance = 1e-9, .regularisation = 1e-4, .max_periods = 20000, .start = TRANSIENT_START_REST, .scout = true},
    {.tolerance = 1e-9, .regularisation = 1e-4, .max_periods = 20000, .start = TRANSIENT_START_REST},
    {.tolerance = 1e-9,
     .regularisation = 1e-4,
     .max_periods = 20000,
     .start = TRANSIENT_START_REST,
     .law = TRANSIENT_LAW_EXACT},
    {.tolerance = 1e-9,
     .regularisation = 1e-4,
     .max_periods = 20000,
     .start = TRANSIENT_START_REST,
     .steady = TRANSIENT_STEADY_MARCH}};
enum { WAYS = sizeof ways / sizeof *ways };

/* While it slides forward all the time, friction is the constant mu N, and m v' + c v = F0 - mu N + F1 cos(omega t):
 *     v = (F0 - mu N)/c + F1/|c + i m omega| cos(...) > 0,      drift = T (F0 - mu N)/c
 * The regularised law has |T| < mu N, by less than half its regularisation in these units; what is left of the way to
 * the mean speed dies out as exp(-c t/m): said once a period changes it by 1e-6, it is 1e-6/(c T/m) off. */
static void a_body_that_slides_on_is_said_to_creep(CHECK_STATE)
{
  const double c = 0.5, F0 = 1.5, F1 = 1, omega = 2, T = TWO_PI / omega, drift = T * (F0 - mu_N) / c;
  model *m = slider(c, 0, F0, F1);
  assert_true((F0 - mu_N) / c > F1 / hypot(c, omega));
  for (int i = 0; i < WAYS; ++i) {
    timeint_result r;
    assert_int_equal(from_rest(m, &ways[i], omega, &r), HC_CREEPS);
    CHECK_NEAR(r.drift, drift, (1e-6 + 1e-6 / (c * T)) * drift, "way %d", i);
    CHECK_LE(r.periods, 100, "way %d", i);
  }
  model_free(m);
}

/* Friction holds the load during a part of the period, in one direction: the body moves on in jerks, the same by every
 * integrator. */
static void stick_and_slip_in_one_direction_is_creep(CHECK_STATE)
{
  model *m = slider(0, 0, 0.4, 0.8);
  timeint_result exact, r;
  assert_int_equal(from_rest(m, &ways[2], 2, &exact), HC_CREEPS);
  assert_true(exact.drift > 0.1);
  for (int i = check_long ? 0 : 2; i < (check_long ? WAYS : 3); ++i) { /* by CVODE it takes seconds */
    assert_int_equal(from_rest(m, &ways[i], 2, &r), HC_CREEPS);
    CHECK_NEAR(r.drift, exact.drift, 1e-4 * exact.drift, "way %d", i); /* the regularisation */
  }
  model_free(m);
}

/* Where friction holds it at all times, and where a spring does, however weak. */
static void what_something_holds_settles(CHECK_STATE)
{
  model *held = slider(0.5, 0, 0.1, 0.1), *sprung = slider(0.5, 0.05, 1.5, 1);
  for (int i = 0; i < WAYS - 1; ++i) {
    timeint_result r;
    assert_int_equal(from_rest(held, &ways[i], 2, &r), HC_OK);
    assert_true(isnan(r.drift));
    assert_int_equal(from_rest(sprung, &ways[i], 2, &r), HC_OK);
    assert_true(isnan(r.drift));
  }
  model_free(held);
  model_free(sprung);
}

/* Den Hartog: at resonance without damping the load puts in pi F x a period, friction takes 4 mu N x at most. */
static void more_load_than_friction_takes_grows_without_bound(CHECK_STATE)
{
  const double most = 4 * mu_N / PI;
  for (int above = 0; above <= 1; ++above) {
    model *m = slider(0, 1, 0, most * (above ? 1.2 : 0.8));
    timeint_result r;
    assert_int_equal(from_rest(m, &ways[0], 1, &r), above ? HC_UNBOUNDED : HC_OK);
    model_free(m);
  }
}

/* Negative damping; and a spring that pushes, so fast that numbers overflow within a period. */
static void instability_grows_without_bound(CHECK_STATE)
{
  static const double damping[] = {-0.05, 0.05, 0.05}, stiffness[] = {1, -1, -1e6};
  for (int k = 0; k < 3; ++k) {
    model *m = slider(damping[k], stiffness[k], 0, 5);
    m->contacts[0].law.load = 0.1;
    for (int i = 0; i < WAYS; ++i) {
      timeint_result r;
      const hc_status st = from_rest(m, &ways[i], 1.3, &r);
      if (st != HC_UNBOUNDED) fail_msg("case %d, way %d: %s", k, i, hc_status_text(st));
    }
    model_free(m);
  }
}

CHECK_TESTS_AND_LONG("timeint.escape", 600,
                     (a_body_that_slides_on_is_said_to_creep, stick_and_slip_in_one_direction_is_creep,
                      what_something_holds_settles, more_load_than_friction_takes_grows_without_bound,
                      instability_grows_without_bound),
                     (stick_and_slip_in_one_direction_is_creep))
