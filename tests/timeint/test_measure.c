/* test_measure.c - peaks, sums and regimes of a period that is known in closed form. */

#include "tests/scene_parts.h"
#include "tests/timeint/scenes.h"
#include "timeint/period/integrate_private.h"

/* Undamped, unforced: x = sum of what the start gives: x = p cos(s theta) + q sin(s theta), s^2 = k; here s = 2.5,
 * so that a period holds two and a half waves, the highest peak is sqrt(p^2 + q^2) and lies between steps, and the
 * sum over the instants is known: with e = exp(i s theta) a geometric series. */
static double complex series(double s) /* (1/n) sum_i exp(i s theta_i) */
{
  double complex step = cexp(I * s * 2 * PI / TIMEINT_WAVE);
  return (cpow(step, TIMEINT_WAVE) - 1) / (step - 1) / TIMEINT_WAVE;
}

/* (1/2 pi) of the integral of exp(i (s + harmonic) theta) over a period */
static double complex integral(double s, int harmonic)
{
  return (cexp(I * (s + harmonic) * 2 * PI) - 1) / (I * (s + harmonic) * 2 * PI);
}

/* CVODE at 1e-13 a step, 1500 steps, states up to 2.5: 4e-10 at worst for the state, the wave and the sums. A peak
 * is a root of v: x errs by the state's error, too. */
static void free_vibration(CHECK_STATE)
{
  const double s = 2.5, p = 0.6, q = -0.8, tol = 4e-10;
  scene sc = scene_linear(1, 0, s * s, 0);
  scaled_model m;
  scene_scaled(&m, &sc, 1, 1);
  CHECK_MADE(integrator, in, integrate_new_regularised(m.base, 1e-13, &in));
  double y[SCENE_MAX_STATES] = {p, s * q};
  timeint_result r;
  scene_measured_period(&sc, &m, 10, in, y, &r); /* L = 10: lengths come out ten times as large */
  double complex X = 10 * (p - I * q);           /* x = Re(X e^{i s theta}) */
  CHECK_NEAR(r.max, 10, 10 * tol, "highest peak");
  CHECK_NEAR(r.min, -10, 10 * tol, "lowest");
  CHECK_NEAR(r.amplitude, 10, 10 * tol, "amplitude");
  CHECK_NEAR(r.mean, creal(X * integral(s, 0)), 10 * tol, "mean");
  CHECK_NEAR(r.a1, creal(X * (integral(s, 1) + integral(s, -1))), 20 * tol, "a1");
  CHECK_NEAR(r.b1, creal(X * (integral(s, 1) - integral(s, -1)) / I), 20 * tol, "b1");
  CHECK_NEAR(r.rms * r.rms, 50 + 0.5 * creal(X * X * series(2 * s)), 200 * tol, "rms");
  for (int i = 0; i < TIMEINT_WAVE; ++i)
    CHECK_NEAR(r.wave[i], creal(X * cexp(I * s * 2 * PI * i / TIMEINT_WAVE)), 10 * tol, "wave[%d]", i);
  integrate_free(in);
}

/* What a contact was seen to do, and the strongest of it. */
static void regimes(CHECK_STATE)
{
  const contact kinked = {0}, polynomial = {.smooth = CONTACT_POLYNOMIAL}, rate = {.smooth = CONTACT_TANH};
  assert_int_equal(measure_seen_regime(SEEN_SEPARATED, &polynomial), CONTACT_BENDS);
  assert_int_equal(measure_seen_regime(SEEN_SEPARATED, &rate), CONTACT_LINEAR);
  assert_int_equal(measure_seen_regime(SEEN_STUCK, &rate), CONTACT_BENDS);
  assert_int_equal(measure_seen_regime(SEEN_SEPARATED | SEEN_STUCK, &rate), CONTACT_SEPARATES);
  assert_int_equal(measure_seen_regime(0, &kinked), CONTACT_LINEAR);
  assert_int_equal(measure_seen_regime(SEEN_SEPARATED, &kinked), CONTACT_LINEAR);
  assert_int_equal(measure_seen_regime(SEEN_STUCK, &kinked), CONTACT_STUCK);
  assert_int_equal(measure_seen_regime(SEEN_STUCK | SEEN_SLIPPING, &kinked), CONTACT_SLIPS);
  assert_int_equal(measure_seen_regime(SEEN_SEPARATED | SEEN_STUCK, &kinked), CONTACT_SEPARATES);
}

/* An integrator whose motion is x = sin(2 theta), and whose dense output fails at the call of that number. */
typedef struct failing {
  integrator base;
  int calls, fails_at;
} failing;

static hc_status dense(const integrator *in, double theta, int order, double *y)
{
  failing *f = (failing *)in;
  y[0] = order ? 2 * cos(2 * theta) : sin(2 * theta);
  y[1] = order ? -4 * sin(2 * theta) : 2 * cos(2 * theta);
  return ++f->calls == f->fails_at ? HC_INTEGRATOR : HC_OK;
}

static hc_status samples(const integrator *in, int r, double theta, double step, int count, double *x)
{
  (void)in, (void)r;
  for (int i = 0; i < count; ++i) x[i] = sin(2 * (theta + i * step));
  return HC_OK;
}

static bool no_fourier(const integrator *in, int r, double out[3])
{
  (void)in, (void)r, (void)out;
  return false;
}

/* Steps that hold one peak, and two: dense output is asked for at their ends and to find the peaks, and wherever it
 * fails the step says so. */
static void a_failure_of_dense_output_is_told(CHECK_STATE)
{
  static const integrator_class class = {.dense = dense, .samples = samples, .fourier = no_fourier};
  static const double ends[] = {1.2, 3.0};
  scene sc = scene_linear(1, 0, 4, 0);
  scaled_model m;
  workspace memory = {0};
  scene_scaled(&m, &sc, 1, 1);
  CHECK_FILLED(measure, me, measure_make(&me, m.n_states, 1, m.n_contacts, &memory));
  for (int i = 0; i < 2; ++i) {
    failing f = {.base = {.does = &class}};
    int calls = 1;
    for (f.fails_at = 0; f.fails_at <= calls; ++f.fails_at) {
      const double y[SCENE_MAX_STATES] = {0, 2};
      f.calls = 0;
      measure_begin(&me, &m);
      measure_period(&me, y);
      assert_int_equal(measure_step(&me, &f.base, 0, ends[i]), f.fails_at ? HC_INTEGRATOR : HC_OK);
      if (f.fails_at == 0) calls = f.calls;
    }
    assert_true(calls > 2);
  }
  workspace_free(&memory);
}

CHECK_TESTS("timeint.measure", 60, free_vibration, regimes, a_failure_of_dense_output_is_told)
