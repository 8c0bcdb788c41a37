/* test_many_contacts.c - n equal contacts of stiffness k/n are one of stiffness k: the same equations, the same
 * orbit. n beyond what a case file lists. */

#include <gsl/gsl_errno.h>

#include "tests/closed_form.h"
#include "tests/scene_parts.h"
#include "tests/timeint/scenes.h"

enum { MOST = 300 };

static const int numbers[] = {17, 40};

/* The steady state at omega from the start (x, v, w), of the scene's contact split into n. */
static timeint_result steady_state(const scene *sc, int n, double omega, const double start[3], double *y)
{
  model *m = scene_split_model(sc, n);
  CHECK_MADE(timeint, ti, timeint_new(m, &sc->transient, &ti));
  assert_int_equal(timeint_n_states(ti), TIMEINT_W + n);
  y[TIMEINT_X] = start[0], y[TIMEINT_V] = start[1];
  for (int j = 0; j < n; ++j) y[TIMEINT_W + j] = start[2];
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, omega, y, NULL, &r));
  timeint_free(ti);
  model_free(m);
  return r;
}

/* Both are within transient.tolerance, relative to the amplitude, of one orbit: their equations differ by n roundings,
 * which is nothing to that. A motion that is 1 off in (x, v/omega) at t = 0 is at most omega_stuck/omega off later
 * (free motion, its energy never growing, in the stiffest state of the contact), and so is x at every instant. */
static void check_same(const scene *sc, int n, double omega, const double start[3])
{
  double one_y[TIMEINT_W + 1], y[TIMEINT_W + MOST];
  const timeint_result one = steady_state(sc, 1, omega, start, one_y), r = steady_state(sc, n, omega, start, y);
  const double stiffest = *sc->structure->stiffness.v + scene_stuck_stiffness(&sc->structure->contacts[0].given);
  const double stretch = fmax(1, sqrt(stiffest / *sc->structure->mass.v) / omega);
  const double tol = 2 * stretch * sc->transient.tolerance * one.amplitude;
  const char *law = sc->transient.law == TRANSIENT_LAW_EXACT ? "exact" : "regularised";
  CHECK_LE(one.closure, sc->transient.tolerance, "%s, one contact", law);
  CHECK_LE(r.closure, sc->transient.tolerance, "%s, %d contacts", law, n);
  CHECK_NEAR(r.amplitude, one.amplitude, tol, "amplitude, %s, %d contacts", law, n);
  CHECK_NEAR(r.mean, one.mean, tol, "mean, %s, %d contacts", law, n);
  for (int i = 0; i < TIMEINT_WAVE; ++i) CHECK_NEAR(r.wave[i], one.wave[i], tol, "%s, %d contacts, %d", law, n, i);
  for (int j = 0; j < n; ++j)
    CHECK_NEAR(y[TIMEINT_W + j], one_y[TIMEINT_W], tol, "slider %d, %s, %d contacts", j, law, n);
  assert_int_equal(r.method, one.method);
  assert_int_equal(r.regime, one.regime);
  assert_int_equal(r.period_multiple, one.period_multiple);
  assert_int_equal(r.free_sliders, n * one.free_sliders);
  assert_int_equal(r.switches, n * one.switches);
}

/* b10 slips and separates, c2 separates and sticks where it closes. Starts next to the orbits. */
static void check_all(transient_steady steady, timeint_method method)
{
  const struct {
    scene sc;
    double start[3];
  } cases[] = {{scene_b10(), {1.04, 7, 0.6}}, {scene_c2(), {8.06, 46.2, 5}}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    for (int law = TRANSIENT_LAW_REGULARISED; law <= TRANSIENT_LAW_EXACT; ++law)
      for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        scene sc = cases[i].sc;
        double y[TIMEINT_W + 1];
        sc.transient.law = law;
        sc.transient.steady = steady;
        check_same(&sc, numbers[k], 7, cases[i].start);
        if (k == 0) assert_int_equal(steady_state(&sc, 1, 7, cases[i].start, y).method, method);
      }
}

static void shooting(CHECK_STATE) { check_all(TRANSIENT_STEADY_SHOOTING, TIMEINT_BY_SHOOTING); }

static void marching(CHECK_STATE) { check_all(TRANSIENT_STEADY_MARCH, TIMEINT_BY_MARCHING); }

/* More transitions in a period than the 1000 that are chatter for few contacts. */
static void more_transitions_than_few_contacts_may_have(CHECK_STATE)
{
  const double start[] = {1.04, 7, 0.6};
  double y[TIMEINT_W + MOST];
  scene sc = scene_b10();
  sc.transient.law = TRANSIENT_LAW_EXACT;
  sc.transient.steady = TRANSIENT_STEADY_SHOOTING;
  check_same(&sc, MOST, 7, start);
  CHECK_LE(1001, steady_state(&sc, MOST, 7, start, y).switches, "transitions");
}

/* A sweep with the regularised law uses the exact law's integrator: it, too, has room for all contacts. */
static void sweep(CHECK_STATE)
{
  const int n = 17;
  scene sc = scene_b10();
  timeint_result swept, solved;
  double y[TIMEINT_W + MOST];
  model *m = scene_split_model(&sc, n);
  timeint *ti = at_rest(m, &sc.transient, y);
  assert_int_equal(timeint_sweep(ti, 6.9, 7, y, NULL), HC_OK);
  assert_int_equal(timeint_steady(ti, 7, y, NULL, &swept), HC_OK);
  solved = steady_state(&sc, n, 7, (const double[]){1.04, 7, 0.6}, y);
  CHECK_NEAR(swept.amplitude, solved.amplitude, 4 * sc.transient.tolerance * solved.amplitude, "amplitude");
  timeint_free(ti);
  model_free(m);
}

/* As the command does: eigenvalues that do not converge are a status. */
static int without_gsl_handler(CHECK_STATE)
{
  gsl_set_error_handler_off();
  return 0;
}

CHECK_TESTS_AND_LONG_WITH("timeint.many_contacts", 300, without_gsl_handler, NULL,
                          (shooting, more_transitions_than_few_contacts_may_have, sweep), (marching))
