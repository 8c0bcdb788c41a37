/* test_predict.c - what a steady state expects to be off by, against what it is: the regularised law's amplitude
 * against the exact law's in closed form, which the prediction has not seen. */
#include "tests/check.h"

#include "tests/timeint/scenes.h"

static timeint *made(scene sc, transient_law law, transient_method method, bool scout, double regularisation)
{
  sc.transient.law = law;
  sc.transient.method = method;
  sc.transient.scout = scout;
  sc.transient.regularisation = regularisation;
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  return ti;
}

/* The steady state next to *y, what it expects, and how far its amplitude is off. */
static void predicted(scene sc, double omega, double regularisation, bool scout, scene_state y, motion_error *said,
                      double *off)
{
  timeint *ti = made(sc, TRANSIENT_LAW_REGULARISED, TRANSIENT_METHOD_CVODE, scout, regularisation);
  timeint *exact = made(sc, TRANSIENT_LAW_EXACT, TRANSIENT_METHOD_CLOSED_FORM, false, regularisation);
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, omega, y.all, NULL, &r));
  assert_true(isnan(r.predicted.amplitude)); /* not before it is asked */
  assert_int_equal(timeint_predict(ti, y.all, NULL, 1, &r), HC_OK);
  CHECK_FILLED(timeint_result, truth, timeint_steady(exact, omega, y.all, NULL, &truth));
  *said = r.predicted;
  *off = fabs(r.amplitude - truth.amplitude);
  timeint_free(exact);
  timeint_free(ti);
}

/* Where the error is of first order (c2: contact returns in stick) the change by half is half the error, and twice that
 * is it; where of second (b10) twice the change is 1.5 times the error. A tenth more for the orders that are left out,
 * with regularisation 1e-3 at most, and 1000 tolerances of 1e-12 that BDF may scatter by; and the prediction names no
 * more than ten times what is found. */
static void regularisation_is_predicted(CHECK_STATE)
{
  const struct {
    scene sc;
    double omega;
  } at[] = {{scene_c2(), 6}, {scene_c2(), 7}, {scene_c2(), 8}, {scene_b10(), 7}};
  for (size_t i = 0; i < sizeof at / sizeof *at; ++i)
    for (double rho = 1e-3; rho > 1e-5; rho /= 10)
      for (int scout = 0; scout < 2; ++scout) {
        scene_state y = {.x = 0};
        timeint *ti = made(at[i].sc, TRANSIENT_LAW_EXACT, TRANSIENT_METHOD_CLOSED_FORM, false, rho);
        motion_error said;
        double off;
        CHECK_FILLED(timeint_result, r, timeint_steady(ti, at[i].omega, y.all, NULL, &r));
        timeint_free(ti);
        predicted(at[i].sc, at[i].omega, rho, scout, y, &said, &off);
        CHECK_LE(off, 1.1 * said.amplitude + 1e-9 * r.amplitude, "scene %d at %g, %g, scout %d", (int)i, at[i].omega,
                 rho, scout);
        CHECK_LE(said.amplitude, 10 * off + 1e-7 * r.amplitude, "scene %d at %g, %g, scout %d", (int)i, at[i].omega,
                 rho, scout);
        CHECK_LE(said.amplitude, said.waveform, "the waveform is off by no less");
      }
}

/* The exact law by CVODE: no more than its closure and scatter, and no less than what it is off by. */
static void integration_is_predicted(CHECK_STATE)
{
  for (int scout = 0; scout < 2; ++scout) {
    timeint *ti = made(scene_c2(), TRANSIENT_LAW_EXACT, TRANSIENT_METHOD_CVODE, scout, 1e-4);
    timeint *closed = made(scene_c2(), TRANSIENT_LAW_EXACT, TRANSIENT_METHOD_CLOSED_FORM, false, 1e-4);
    scene_state y = {.x = 0}, z = {.x = 0};
    CHECK_FILLED(timeint_result, r, timeint_steady(ti, 7, y.all, NULL, &r));
    assert_int_equal(timeint_predict(ti, y.all, NULL, 1, &r), HC_OK);
    CHECK_FILLED(timeint_result, truth, timeint_steady(closed, 7, z.all, NULL, &truth));
    CHECK_LE(fabs(r.amplitude - truth.amplitude), r.predicted.amplitude, "scout %d", scout);
    CHECK_LE(r.predicted.amplitude, 1e-8 * r.amplitude, "scout %d", scout);
    timeint_free(ti);
    timeint_free(closed);
  }
}

CHECK_TESTS("timeint.predict", 120, regularisation_is_predicted, integration_is_predicted)
