/* test_growth.c - response curves that go to infinity at a finite frequency end there, and say so; others do not. The
 * frequency is the natural one of the motion that is infinitely large: of the open mass for friction, whose force is
 * bounded; of a stop at a gap that is nothing then, half a period of either stiffness. */
#include "hbm/curve/growth.h"
#include "hbm/hbm.h"
#include "tests/closed_form.h"

static const hbm_settings usual = {
    .harmonics = 15, .force = HBM_FORCE_EXACT, .keep_mean = true, .tolerance = 1e-10, .iterations = 25};

/* The end of the curve of one mass, M = K = 1, and where. */
static hc_status end_of(double damping, double force, contact law, double angle, double from, double to, double *omega)
{
  model *m;
  hbm_solver *s;
  hbm_curve c = {0};
  assert_int_equal(model_oscillator(1, damping, 1, force, 1, &m), HC_OK);
  m->contacts[0].law = law;
  model_direction(angle, m->contacts[0].tangent, m->contacts[0].normal);
  assert_int_equal(hbm_solver_new(m, &usual, &s), HC_OK);
  const hc_status st = hbm_trace(s, from, to, NULL, &c);
  assert_int_equal(st, c.end);
  CHECK_LE(c.n, 2000, "points");
  *omega = c.points[c.n - 1].omega;
  hbm_curve_free(&c);
  hbm_solver_free(s);
  model_free(m);
  return st;
}

/* With E = 1e6 W = 1e6 pi F A of E = omega^2 A^2/4 the amplitude is A = 4e6 pi F, and |1 - omega^2| <= (F + 4 mu
 * N/pi)/A: the curve ends within (1 + 4 mu N/pi/F)/(8e6 pi) of the natural frequency, or within four times that, by the
 * last step of at most half a unit. */
static const double near = 4 * 2 / (8e6 * PI);

/* Between the stuck mass's resonances of harmonics 3 and 5, at sqrt(21)/3 and sqrt(21)/5, undamped too. */
static void more_load_than_friction_takes(CHECK_STATE)
{
  const contact friction = {.kt = 20, .mu = 0.5, .load = 2}; /* mu N = 1 */
  const double most = 4 / PI, sweeps[2][2] = {{0.95, 1.4}, {1.4, 0.95}};
  for (int i = 0; i < 2; ++i) {
    double omega;
    assert_int_equal(end_of(0, 1.2 * most, friction, 0, sweeps[i][0], sweeps[i][1], &omega), HC_UNBOUNDED);
    CHECK_NEAR(omega, 1, near, "sweep %d", i);
    assert_int_equal(end_of(0, 0.8 * most, friction, 0, sweeps[i][0], sweeps[i][1], &omega), HC_OK);
    assert_int_equal(end_of(1e-4, 1.2 * most, friction, 0, sweeps[i][0], sweeps[i][1], &omega), HC_OK);
  }
}

/* K = 1 one way, 1 + kn = 4 the other: omega = 2 * 1 * 2/(1 + 2). */
static void a_stop(CHECK_STATE)
{
  const contact stop = {.kn = 3, .gap = -1};
  double omega;
  assert_int_equal(end_of(0, 1, stop, 90, 2.5, 1.1, &omega), HC_UNBOUNDED);
  CHECK_NEAR(omega, 4.0 / 3, near, "a stop");
}

static void a_line(CHECK_STATE)
{
  const contact never = {.kn = 3, .gap = -1e12};
  double omega;
  assert_int_equal(end_of(0, 1, never, 90, 0.51, 2.5, &omega), HC_UNBOUNDED);
  CHECK_NEAR(omega, 1, near, "without contact");
  assert_int_equal(end_of(1e-9, 1, never, 90, 0.51, 2.5, &omega), HC_OK); /* up to 1e9, and down again */
}

CHECK_TESTS("hbm.growth", 300, more_load_than_friction_takes, a_stop, a_line)
