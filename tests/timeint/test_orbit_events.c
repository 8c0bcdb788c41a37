/* test_orbit_events.c - events of orbits that are known: between two of them the motion is linear. */
#include "model/linear.h"
#include "tests/closed_form.h"
#include "tests/scene_parts.h"
#include "tests/timeint/scenes.h"
#include "timeint/steady/orbit_events.h"

static const transient_settings closed = CLOSED_FORM(1e-10, 2000);

static void settle(const model *m, double omega, orbit_events *e)
{
  double state[8];
  timeint *ti = at_rest(m, &closed, state);
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, omega, state, NULL, &r));
  assert_int_equal(timeint_events(ti, r.period_multiple, e), HC_OK);
  timeint_free(ti);
}

/* x, v after `tau` of a motion that begins at event i, stiffness k, a constant force c beside the load. */
static void linear_motion(const orbit_events *e, int i, double omega, double k, double c, double tau, double out[2])
{
  const double complex X = linear_response(1, 0.4, k, 100, omega);
  double free[2][2];
  const double complex here = X * cexp(I * omega * e->t[i]), there = X * cexp(I * omega * (e->t[i] + tau));
  const double x = e->x[i] - c / k - creal(here), v = e->v[i] - creal(I * omega * here);
  linear_free_motion(1, 0.4, k, tau, free);
  out[0] = c / k + creal(there) + free[0][0] * x + free[0][1] * v;
  out[1] = creal(I * omega * there) + free[1][0] * x + free[1][1] * v;
}

/* Case 2 of the paper, its contact as `n` equal ones. At omega = 6 it touches once and sticks (PHYSICS, 1: kt <
 * mu kn tan 45): at x = gap/sin 45. Open the stiffness is K; closed it is K + (kt + kn)/2, both springs unstrained at
 * that x. All exact: rounding of motions of 10 over a period, some 1e-14 of v = 50, through events and Newton to
 * 1e-12. */
static void check_case_2(int n)
{
  const scene sc = scene_c2();
  model *m = scene_split_model(&sc, n);
  orbit_events e;
  const double omega = 6, at = 5 * sqrt(2), period = TWO_PI / omega, stuck = (100 + 1000) / 2.0;
  settle(m, omega, &e);
  assert_int_equal(e.n, 2);
  for (int i = 0; i < 2; ++i) {
    const bool touches = e.states[i * n] == CONTACT_STICK;
    const double tau = i == 0 ? e.t[1] - e.t[0] : e.t[0] + period - e.t[1], *v = e.v;
    double next[2];
    for (int j = 1; j < n; ++j) assert_int_equal(e.states[i * n + j], e.states[i * n]);
    assert_true(e.t[i] >= 0 && e.t[i] < period);
    CHECK_NEAR(e.x[i], at, 1e-11, "event %d", i);
    assert_true(touches ? v[i] > 1 : v[i] < -1);
    linear_motion(&e, i, omega, 40 + (touches ? stuck : 0), touches ? stuck * at : 0, tau, next);
    CHECK_NEAR(next[0], at, 1e-11, "x after event %d", i);
    CHECK_NEAR(next[1], v[1 - i], 1e-9, "v after event %d", i);
  }
  for (int j = 0; j < n; ++j) assert_true(isnan(e.rest[j]));
  orbit_events_free(&e);
  model_free(m);
}

static void one_contact_and_two_equal_ones(CHECK_STATE)
{
  check_case_2(1);
  check_case_2(2);
}

/* A slider under a constant load that never slips: x = X cos(omega t - phase), w between X - R and R - X about 0, here
 * at 0, R = mu N/kt. Seen at 256 instants a period the extrema of x are off by (pi/256)^2/2 of X at most. */
static void a_slider_that_never_slips_has_room(CHECK_STATE)
{
  orbit_events e;
  const double omega = 3, X = cabs(linear_response(1, 0.4, 40 + 100, 10, omega)), R = 0.5 * 40 / 100;
  CHECK_MADE(model, m, model_oscillator(1, 0.4, 40, 10, 1, &m));
  m->contacts[0].law = (contact){.kt = 100, .mu = 0.5, .load = 40};
  m->contacts[0].tangent[0] = 1;
  settle(m, omega, &e);
  assert_int_equal(e.n, 1);
  assert_int_equal(e.states[0], CONTACT_STICK);
  assert_true(e.t[0] == 0);
  CHECK_NEAR(e.rest[0], 0, 1e-13, "rest");
  CHECK_NEAR(e.lowest[0], X - R, X * 7.6e-5, "X = %g, R = %g", X, R);
  CHECK_NEAR(e.highest[0], R - X, X * 7.6e-5, "X = %g, R = %g", X, R);
  orbit_events_free(&e);
  model_free(m);
}

CHECK_TESTS("timeint.orbit_events", 60, one_contact_and_two_equal_ones, a_slider_that_never_slips_has_room)
