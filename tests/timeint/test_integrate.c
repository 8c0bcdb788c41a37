/* test_integrate.c - one period by CVODE: against a closed form, bit for bit again, and what its flags become. */

#include "tests/timeint/integrator_failures.h"
#include "tests/timeint/scenes.h"

/* x'' + c x' + k x = f cos(theta) from x = x' = 0: the forced motion plus the free one that cancels it at 0. */
static double complex linear_state(const scaled_model *m, double theta)
{
  double complex X = scene_f(m) / (scene_k(m) - 1 + I * scene_c(m)),
                 r = -scene_c(m) / 2 + csqrt(scene_c(m) * scene_c(m) / 4 - scene_k(m));
  double x0 = creal(X), v0 = creal(I * X); /* x = Re(X e^{i theta}); the free part starts from (-x0, -v0) */
  double b = (-v0 - creal(r) * -x0) / cimag(r), decay = exp(creal(r) * theta), w = cimag(r) * theta;
  double free_x = decay * (-x0 * cos(w) + b * sin(w));
  double free_v = decay * (creal(r) * (-x0 * cos(w) + b * sin(w)) + cimag(r) * (x0 * sin(w) + b * cos(w)));
  return creal(X * cexp(I * theta)) + free_x + I * (creal(I * X * cexp(I * theta)) + free_v);
}

/* Every step's error is kept below the tolerance (of states of size 1); `steps` of them add up, damping only shrinks
 * them: steps * tolerance. */
static void linear_period_is_the_closed_form(CHECK_STATE)
{
  scene sc = scene_linear(1, 0.4, 40, 40);
  scaled_model m;
  scene_scaled(&m, &sc, 5, 1);
  for (double tol = 1e-6; tol > 1e-14; tol *= 1e-2) {
    CHECK_MADE(integrator, in, integrate_new_regularised(m.base, tol, &in));
    double y[SCENE_MAX_STATES] = {0};
    assert_int_equal(integrate_period(in, &m, y, NULL, NULL), HC_OK);
    double bound = (double)integrate_steps(in) * tol * 2.5; /* |states| <= 2.5: the tolerance is relative, too */
    CHECK_NEAR(y[0], creal(linear_state(&m, 2 * PI)), bound, "x at %g", tol);
    CHECK_NEAR(y[1], cimag(linear_state(&m, 2 * PI)), bound, "v at %g", tol);
    integrate_free(in);
  }
}

typedef struct seen {
  const scaled_model *m;
  double last, worst;
} seen;

static hc_status look(void *self, const integrator *in, double theta0, double theta1)
{
  seen *s = self;
  double y[SCENE_MAX_STATES], mid = 0.5 * (theta0 + theta1);
  CHECK_LE(fabs(theta0 - s->last), 0, "steps follow each other");
  s->last = theta1;
  hc_status st = integrate_dense(in, mid, 0, y);
  s->worst = larger(s->worst, fabs(y[0] - creal(linear_state(s->m, mid))));
  return st;
}

/* A watched period takes the same steps to the same end; its dense output is as good as the steps (bound as above;
 * between steps the polynomial of the same order: the same size again). */
static void watched_period_is_the_same(CHECK_STATE)
{
  scene sc = scene_linear(1, 0.4, 40, 40);
  scaled_model m;
  scene_scaled(&m, &sc, 5, 1);
  CHECK_MADE(integrator, in, integrate_new_regularised(m.base, 1e-10, &in));
  double y[SCENE_MAX_STATES] = {0}, z[SCENE_MAX_STATES] = {0};
  seen s = {.m = &m};
  assert_int_equal(integrate_period(in, &m, y, NULL, NULL), HC_OK);
  long steps = integrate_steps(in);
  assert_int_equal(integrate_period(in, &m, z, look, &s), HC_OK);
  assert_int_equal(integrate_steps(in), 2 * steps);
  CHECK_LE(fabs(y[0] - z[0]) + fabs(y[1] - z[1]), 0, "the same bits");
  CHECK_NEAR(s.last, 2 * PI, 0, "the last step ends the period");
  CHECK_LE(s.worst, 2 * (double)steps * 1e-10 * 2.5, "dense output");
  integrate_free(in);
}

/* Settling relies on it: a period is a function of the state alone, whatever was integrated before. */
static void a_period_has_no_memory(CHECK_STATE)
{
  scene sc = scene_c2();
  scaled_model m, other;
  scene_scaled(&m, &sc, 7, 10);
  scene_scaled(&other, &sc, 8, 3);
  CHECK_MADE(integrator, in, integrate_new_regularised(m.base, 1e-10, &in));
  double y[SCENE_MAX_STATES] = {0.8, 0.6, 0.5}, z[SCENE_MAX_STATES] = {0.8, 0.6, 0.5}, w[SCENE_MAX_STATES] = {0};
  assert_int_equal(integrate_period(in, &m, y, NULL, NULL), HC_OK);
  assert_int_equal(integrate_period(in, &other, w, NULL, NULL), HC_OK);
  assert_int_equal(integrate_period(in, &m, z, NULL, NULL), HC_OK);
  CHECK_LE(fabs(y[0] - z[0]) + fabs(y[1] - z[1]) + fabs(y[2] - z[2]), 0, "the same bits");
  integrate_free(in);
}

/* x'' = ... + 0.2 x^3 beyond its saddle at 2.24 ends in finite time as 3.2/(t* - t): CVODE's step is a fixed part of
 * t* - t, 1/30 at this tolerance, so that a factor e takes 30 steps and ln 1e9 of them 600. Without a bound it walks on
 * through the ten million steps a period may have. */
static void what_escapes_ends_in_few_steps(CHECK_STATE)
{
  scene sc = scene_linear(1, 0.05, 1, 0.25);
  scaled_model m;
  scene_add_contact(&sc, (scene_contact){.kind = CONTACT_POLYNOMIAL, .law = {.power = {0, -0.2}}});
  scene_scaled(&m, &sc, 0.5, 1);
  CHECK_MADE(integrator, in, integrate_new_regularised(m.base, 1e-8, &in));
  double y[SCENE_MAX_STATES] = {10};
  assert_int_equal(integrate_period(in, &m, y, NULL, NULL), HC_UNBOUNDED);
  CHECK_LE(integrate_steps(in), 6000, "steps");
  CHECK_LE(fabs(y[0] - 10) + fabs(y[1]), 0, "the state stays");
  integrate_free(in);
}

static void failures_are_reported(CHECK_STATE)
{
  scene sc = scene_c2();
  scaled_model m;
  scene_scaled(&m, &sc, 7, 10);
  check_integrator_failures(integrate_new_regularised, m);
}

CHECK_TESTS("timeint.integrate", 120, linear_period_is_the_closed_form, watched_period_is_the_same,
            a_period_has_no_memory, what_escapes_ends_in_few_steps, failures_are_reported)
