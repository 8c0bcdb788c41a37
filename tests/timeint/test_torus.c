/* test_torus.c - motions that repeat after no number of periods: tori beyond a Neimark-Sacker bifurcation, their second
 * frequency, what is none; a motion without bound; and chaos that ends. */
#include "numerics/random.h"
#include "tests/closed_form.h"
#include "tests/hbm/structure_cases.h"
#include "timeint/steady/aperiodic.h"
#include "timeint/steady/sweep.h"
#include "timeint/steady/timeint_private.h"

enum { N = 1024, STATES = 16 };

static const transient_settings closed_form = CLOSED_FORM(1e-9, 20000);

/* ---- sequences whose rotation is known ------------------------------------------------------------------- */

/* What is seen of z_n = G(nu n), G with a corner as of a contact. */
static double on_curve(double nu, int i)
{
  const double turn = TWO_PI * nu * i;
  return 0.3 + cos(turn) + 0.2 * sin(2 * turn) + 0.1 * fabs(cos(turn));
}

static double rotation_of(double (*seen)(double nu, int i), double nu)
{
  static double x[2 * N], size[2 * N];
  for (int i = 0; i < 2 * N; ++i) x[i] = seen(nu, i), size[i] = 2 + 0.1 * x[i] * x[i];
  return torus_rotation(N, x, size);
}

static double growing(double nu, int i) { return exp(1e-5 * i) * on_curve(nu, i); }
static double decaying(double nu, int i) { return exp(-1e-5 * i) * on_curve(nu, i); }
static double drifting(double nu, int i) { return 0.01 * i / N + on_curve(nu, i); }
static double standing(double nu, int i) { return nu + 1e-9 * i / N; }
static double noisy(double nu, int i)
{
  static uint64_t seed = 5;
  return on_curve(nu, i) + random_signed(&seed);
}

/* The whole of a drawn line is one frequency: that of the curve, to the hundredth of a bin at least. Cycles of k
 * periods, growth by 1 % a window and noise are none. */
static void a_curve_has_one_rotation(CHECK_STATE)
{
  const double golden = 0.5 * (sqrt(5) - 1);
  CHECK_NEAR(rotation_of(on_curve, 1 - golden), 1 - golden, 1e-6, "the golden mean, from below");
  CHECK_NEAR(rotation_of(on_curve, 0.2034567), 0.2034567, 1e-6, "a fifth or so");
  CHECK_NEAR(rotation_of(on_curve, 1.2034567), 0.2034567, 1e-6, "a turn more is not seen");
  assert_true(isnan(rotation_of(on_curve, 0.8)));       /* five points */
  assert_true(isnan(rotation_of(on_curve, 7.0 / 64)));  /* 64 points */
  assert_true(isnan(rotation_of(growing, 0.2034567)));  /* on its way outwards */
  assert_true(isnan(rotation_of(decaying, 0.2034567))); /* on its way inwards */
  assert_true(isnan(rotation_of(drifting, 0.2034567))); /* on its way to the side */
  assert_true(isnan(rotation_of(noisy, 0.2034567)));    /* noise */
  assert_true(isnan(rotation_of(standing, 0.2034567))); /* no motion */
}

/* ---- the brake's ------------------------------------------------------------------------------------------ */

static hc_status steady_from_rest(const model *m, const transient_settings *how, double omega, timeint_result *r)
{
  double y[STATES];
  timeint *ti = at_rest(m, how, y);
  hc_status st = timeint_steady(ti, omega, y, NULL, r);
  timeint_free(ti);
  return st;
}

/* The angle of the multipliers, in turns, of the orbit of one period, followed from where it is stable. */
static double angle_of_multiplier(const model *m, double omega, double *modulus)
{
  const double from = 8.8;
  double y[STATES];
  timeint *ti = at_rest(m, &closed_form, y);
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, from, y, NULL, &r));
  for (int i = 1; i <= 10; ++i)
    assert_int_equal(timeint_orbit(ti, from + (omega - from) * i / 10, 1, y, NULL, &r), HC_OK);
  timeint_free(ti);
  *modulus = r.multiplier;
  return atan2(fabs(r.multiplier_im), r.multiplier_re) / TWO_PI;
}

/* Where the pair leaves the unit circle, at 9.042, the torus is small and turns as its angle says: to second order in
 * the torus' size, whose square is proportional to what the modulus is above 1. So the difference over that is the same
 * at two frequencies, to a tenth: it changes with omega itself. CVODE's own steps end on the same torus. */
static void a_torus_turns_as_its_multipliers(CHECK_STATE)
{
  const structure_case c = structure_case_named("brake", 3);
  const double omegas[] = {9.05, 9.06};
  double ratio[2];
  for (int i = 0; i < 2; ++i) {
    timeint_result r;
    double modulus;
    const double angle = angle_of_multiplier(c.model, omegas[i], &modulus);
    CHECK_LE(1 + 1e-5, modulus, "at %g", omegas[i]);
    assert_int_equal(steady_from_rest(c.model, &closed_form, omegas[i], &r), HC_APERIODIC);
    assert_int_equal(r.period_multiple, 0);
    CHECK_LE(fabs(r.lyapunov), 0.01, "at %g", omegas[i]);
    ratio[i] = (r.second_frequency / omegas[i] - angle) / (modulus - 1);
    CHECK_LE(fabs(r.second_frequency / omegas[i] - angle), 0.5 * (modulus - 1), "at %g", omegas[i]);
  }
  CHECK_NEAR(ratio[1], ratio[0], 0.1 * fabs(ratio[0]), "shift of the angle over modulus - 1");
  model_free(c.model);
}

static void by_whichever_way(CHECK_STATE)
{
  const structure_case c = structure_case_named("brake", 3);
  transient_settings how = closed_form;
  timeint_result series, events;
  assert_int_equal(steady_from_rest(c.model, &how, 9.1, &series), HC_APERIODIC);
  how.method = TRANSIENT_METHOD_CVODE;
  how.tolerance = 1e-7;
  how.max_periods = 8000;
  assert_int_equal(steady_from_rest(c.model, &how, 9.1, &events), HC_APERIODIC);
  CHECK_NEAR(events.second_frequency, series.second_frequency, 1e-5 * 9.1, "by CVODE alone");
  how.law = TRANSIENT_LAW_REGULARISED;
  how.scout = true;
  assert_int_equal(steady_from_rest(c.model, &how, 9.1, &events), HC_APERIODIC);
  CHECK_NEAR(events.second_frequency, series.second_frequency, 1e-5 * 9.1, "scouted");
  model_free(c.model);
}

/* Said as soon as the motion is beyond every resonance, whatever the contacts do there. */
static void growth_without_bound_is_told(CHECK_STATE)
{
  const structure_case c = structure_case_named("brake", 3);
  for (int i = 0; i < 3; ++i) {
    timeint_result r;
    assert_int_equal(steady_from_rest(c.model, &closed_form, (const double[]){9.5, 10, 11.2}[i], &r), HC_UNBOUNDED);
    CHECK_LE(r.periods, 2000, "case %d", i);
  }
  model_free(c.model);
}

/* ---- chaos that ends -------------------------------------------------------------------------------------- */

/* Motions of the wedge at 31.909 are chaotic for thousands of periods, and then go to an orbit of one period; when, is
 * a matter of rounding. Here one does so while it is measured that neighbours drift apart, the first or the second
 * time. */
static struct {
  const double *orbit; /* a state of it; NULL: nothing is put in the way */
  int at, measured;    /* which measurement; how many there were */
} lands;

hc_status __real_chaos_test(timeint *ti, const hc_monitor *monitor, bool *chaos, double *rate);
hc_status __wrap_chaos_test(timeint *ti, const hc_monitor *monitor, bool *chaos, double *rate);
hc_status __wrap_chaos_test(timeint *ti, const hc_monitor *monitor, bool *chaos, double *rate)
{
  hc_status st = __real_chaos_test(ti, monitor, chaos, rate);
  if (lands.orbit && *chaos && ++lands.measured == lands.at) timeint_take_state(ti, lands.orbit, ti->y);
  return st;
}

static void what_has_come_to_an_orbit_is_not_chaos(CHECK_STATE)
{
  const structure_case c = structure_case_named("wedge_F10", 3);
  double swept[STATES], y[STATES], orbit[STATES];
  timeint_result r, of_orbit;
  timeint *ti = at_rest(c.model, &closed_form, swept);
  assert_int_equal(timeint_sweep(ti, 34, 31.95, swept, NULL), HC_OK);
  bool stable = false;
  for (int i = 0; i < 400 && !stable; ++i) { /* the motion passes by the stable orbit sooner or later */
    assert_true(timeint_begin(ti, 31.909, swept) == HC_OK && timeint_period(ti, false) == HC_OK);
    timeint_get_state(ti, swept);
    memcpy(orbit, swept, sizeof orbit);
    stable = timeint_orbit(ti, 31.909, 1, orbit, NULL, &of_orbit) == HC_OK && of_orbit.multiplier < 0.99;
  }
  assert_true(stable);
  for (lands.at = 1; lands.at <= 2; ++lands.at) {
    memcpy(y, swept, sizeof y);
    lands.measured = 0;
    lands.orbit = orbit;
    assert_int_equal(timeint_steady(ti, 31.909, y, NULL, &r), HC_OK);
    lands.orbit = NULL;
    assert_int_equal(lands.measured, lands.at);
    CHECK_NEAR(r.amplitude, of_orbit.amplitude, 1e-8, "in measurement %d", lands.at);
  }
  timeint_free(ti);
  model_free(c.model);
}

CHECK_TESTS("timeint.torus", 300, a_curve_has_one_rotation, a_torus_turns_as_its_multipliers, by_whichever_way,
            growth_without_bound_is_told, what_has_come_to_an_orbit_is_not_chaos)
