/* test_integrate_exact.c - periods of the exact law by CVODE: against closed forms, its monodromy matrix against
 * differences, and transitions that coincide, graze or end the period. */

#include "tests/timeint/exact_periods.h"
#include "tests/timeint/integrator_failures.h"

#define tol 1e-12 /* CVODE's. A period is some 200 steps, each of which may err by it */

static integrator *integrator_of(const scaled_model *m)
{
  CHECK_MADE(integrator, in, integrate_new_events(m->base, tol, &in));
  return in;
}

/* CVODE's errors of a period, 200 tol, are carried on; where the motion is stable they do not grow for long: all the
 * periods' together, times 5. By differences half of a period's steps are seen, times Richardson's 5/3. */
static const exact_way way = {
    .make = integrator_of, .noise = 100 * tol * 5 / 3, .off = 5 * 200 * tol, .off_grows = 5 * 200 * tol};

static void they_follow_the_oracle(CHECK_STATE) { scenes_follow_the_oracle(&way); }
static void rest_stays_at_rest(CHECK_STATE) { check_rest(&way); }
static void monodromy_is_that_of_the_period(CHECK_STATE) { check_monodromies(&way); }
static void a_transition_at_the_end_of_the_period(CHECK_STATE) { check_transition_at_the_end(&way, tol, tol); }

/* Where kt cos <= mu kn sin a contact that touches sticks until it separates, T and N vanishing together: the
 * frictionless contact of the same stiffness against x, kn' = kn + kt at 45 degrees. Equality: the slip's guard is 0
 * all the time. */
static void bilinear_contacts_need_no_friction(CHECK_STATE)
{
  const double kt[] = {299.999, 256, 100};
  for (int i = 0; i < 3; ++i) {
    const double kn = i == 1 ? 1024 : 1000, mu = i == 1 ? 0.25 : 0.3; /* 0.25 * 1024 = 256, exactly */
    scaled_model m = exact_model(one(100, kt[i], kn, mu, -3, 45), 7, 10),
                 plain = exact_model(one(100, 0, kn + kt[i], 0, -3, 45), 7, 10);
    integrator *in = integrator_of(&m), *ref = integrator_of(&plain);
    double y[SCENE_MAX_STATES] = {0}, z[SCENE_MAX_STATES] = {0};
    for (int n = 0; n < 20; ++n) {
      run(in, &m, y, 1);
      run(ref, &plain, z, 1);
      CHECK_NEAR(y[0], z[0], 5 * 200 * tol * (n + 1), "x, kt %g", kt[i]);
      CHECK_NEAR(y[1], z[1], 5 * 200 * tol * (n + 1), "p, kt %g", kt[i]);
    }
    assert_true(integrate_transitions(in) >= integrate_transitions(ref) && integrate_transitions(ref) > 20);
    if (i != 1) assert_int_equal(integrate_transitions(in), integrate_transitions(ref));
    integrate_free(in);
    integrate_free(ref);
  }
}

static void two_contacts_are_one_of_double_stiffness(CHECK_STATE)
{
  scene twin = one(10, 100, 200, 0.3, -0.5, 45), single = one(10, 200, 400, 0.3, -0.5, 45);
  scene_add(&twin, 100, 200, 0.3, -0.5, 45);
  scaled_model m = exact_model(twin, 7, 1), s = exact_model(single, 7, 1);
  integrator *in = integrator_of(&m), *ref = integrator_of(&s);
  double y[SCENE_MAX_STATES] = {0}, z[SCENE_MAX_STATES] = {0};
  run(in, &m, y, 20);
  run(ref, &s, z, 20);
  CHECK_NEAR(y[0], z[0], 20 * 200 * tol, "x");
  CHECK_NEAR(y[1], z[1], 20 * 200 * tol, "p");
  CHECK_NEAR(y[2], y[3], 0, "both sliders");
  CHECK_NEAR(y[2], z[2], 20 * 200 * tol, "w");
  assert_int_equal(integrate_transitions(in), 2 * integrate_transitions(ref));
  CHECK_LE((double)integrate_steps(in), 1.05 * (double)integrate_steps(ref), "one restart for both");
  integrate_free(in);
  integrate_free(ref);
}

/* On the orbit of the separated oscillator, X = A cos(theta - phi), a contact at A(1 - d): 2 transitions if d > 0,
 * none if d < 0, for d down to 100 times CVODE's error; it is open for sqrt(2 d) to either side, far less than a
 * step. */
static void grazing_is_not_stepped_over(CHECK_STATE)
{
  for (int i = 0; i < 40; ++i) {
    const double omega = 7 + 0.05 * i;
    double complex X = linear_response(1, 0.4, 40, 100, omega);
    for (int k = 0; k < 8; ++k)
      for (int sign = -1; sign <= 1; sign += 2) {
        const double d = sign * (k < 7 ? pow(10, -3 - k) : 1e-10);
        scaled_model m = exact_model(one(100, 100, 200, 0.3, -cabs(X) * (1 - d) * sqrt(0.5), 45), omega, cabs(X));
        double y[SCENE_MAX_STATES] = {creal(X) / cabs(X), creal(I * X) / cabs(X), 0};
        integrator *in = integrator_of(&m);
        run(in, &m, y, 1);
        /* slips or, its kt cos > mu kn sin, also sticks back */
        const long want = d < 0 ? 0 : integrate_transitions(in) == 4 ? 4 : 2;
        CHECK_NEAR((double)integrate_transitions(in), (double)want, 0, "d %g omega %g", d, omega);
        integrate_free(in);
      }
  }
}

typedef struct seen {
  const scaled_model *m;
  double last, worst;
} seen;

/* Dense output obeys the law at any instant: X' = P, and P' of scaled_rhs, whose sliders are the returned ones; the
 * sliders' rates add up to their way (Simpson over a step: h^5/2880 of a fifth derivative of 50 is below 1e-6 while
 * h < 0.5). */
static hc_status look(void *self, const integrator *in, double theta0, double theta1)
{
  seen *s = self;
  CHECK_NEAR(theta0, s->last, 0, "steps follow each other");
  s->last = theta1;
  double path[SCENE_MAX_CONTACTS] = {0};
  for (int i = 0; i <= 4; ++i) {
    double theta = theta0 + (theta1 - theta0) * i / 4, y[SCENE_MAX_STATES], dy[SCENE_MAX_STATES], law[SCENE_MAX_STATES];
    assert_int_equal(integrate_dense(in, theta, 0, y), HC_OK);
    assert_int_equal(integrate_dense(in, theta, 1, dy), HC_OK);
    scaled_rhs(s->m, theta, y, law);
    s->worst = larger(s->worst, larger(fabs(dy[0] - law[0]), fabs(dy[1] - law[1])));
    for (int j = 0; i % 2 == 0 && j < s->m->n_contacts; ++j) {
      if (i == 0) path[j] = -y[SCALED_W + j];
      if (i == 4) path[j] += y[SCALED_W + j];
      path[j] -= (i == 2 ? 4 : 1) * dy[SCALED_W + j] * (theta1 - theta0) / 6;
    }
  }
  for (int j = 0; j < s->m->n_contacts; ++j) CHECK_NEAR(path[j], 0, 1e-6, "slider %d from %g to %g", j, theta0, theta1);
  return HC_OK;
}

static void watched_period_is_the_same(CHECK_STATE)
{
  scaled_model m = exact_model(three_contacts(), 7, 2), other = exact_model(three_contacts(), 8, 3);
  integrator *in = integrator_of(&m);
  double y[SCENE_MAX_STATES] = {0}, z[SCENE_MAX_STATES] = {0}, w[SCENE_MAX_STATES] = {0};
  seen s = {.m = &m};
  run(in, &m, y, 1);
  long steps = integrate_steps(in);
  run(in, &other, w, 1); /* a period is a function of the state alone */
  long both = integrate_steps(in);
  assert_int_equal(integrate_period(in, &m, z, look, &s), HC_OK);
  assert_int_equal(integrate_steps(in) - both, steps);
  for (int i = 0; i < m.n_states; ++i) CHECK_NEAR(y[i], z[i], 0, "the same bits, y%d", i);
  CHECK_NEAR(s.last, 2 * PI, 0, "the last step ends the period");
  /* The step after a restart: order 1, error h^2 |y''|/2 = tol, that of the derivative h |y''|, |y''| < 50. */
  CHECK_LE(s.worst, sqrt(2 * tol * 50), "dense output");
  integrate_free(in);
}

/* One period from many states, most of them far from any orbit: turns within a step, short slips, short contacts.
 * The oracle misses what lasts less than 2 pi/4000: a slip or contact that short moves X by its force, less than 50
 * h (its guard grows by that much) h, for h. */
static void any_start_follows_the_closed_form(CHECK_STATE)
{
  const double h = 2 * PI / SCAN;
  scene cases[] = {one(100, 300, 200, 0.3, 0.5, 0), one(30, 300, 200, 0.3, 0.5, 45), one(100, 300, 200, 0.3, -0.5, 60)};
  for (int k = 0; k < 3; ++k) {
    scaled_model m = exact_model(cases[k], 3.1, 2);
    integrator *in = integrator_of(&m);
    for (int i = 0; i < 300; ++i) {
      double y[SCENE_MAX_STATES] = {1.5 * sin(12.9898 * i), 3 * sin(78.233 * i), 0};
      y[2] = scene_cosine(&m, &m.contact[0]) * y[0];
      const bool open = scene_sine(&m, &m.contact[0]) * y[0] + m.contact[0].law.gap <= 0;
      oracle o = {.m = &m, .x = y[0], .p = y[1], .state = {open ? APART : STUCK}, .held = {y[2]}};
      oracle_period(&o);
      run(in, &m, y, 1);
      CHECK_NEAR(y[0], o.x, 50 * h * h * h, "x, case %d start %d", k, i);
      CHECK_NEAR(y[1], o.p, 50 * h * h, "p, case %d start %d", k, i);
    }
    integrate_free(in);
  }
}

static void failures_are_reported(CHECK_STATE)
{
  check_integrator_failures(integrate_new_events, exact_model(scene_c2(), 7, 10));
}

CHECK_TESTS("timeint.integrate_exact", 120, they_follow_the_oracle, bilinear_contacts_need_no_friction,
            two_contacts_are_one_of_double_stiffness, grazing_is_not_stepped_over,
            a_transition_at_the_end_of_the_period, monodromy_is_that_of_the_period, rest_stays_at_rest,
            any_start_follows_the_closed_form, watched_period_is_the_same, failures_are_reported)
