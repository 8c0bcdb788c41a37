/* test_circle_edge.c - a structure whose contact with two tangents is at the edge of slip: its curve stops there, and
 * what lies beyond is found at a given omega. */
#include "hbm/hbm.h"
#include "tests/hbm/circle_scenes.h"

/* Case space_F0.1 of the reference: three degrees of freedom, force F (1, 0, 0.8) cos + F (0, 0.6, 0) sin. */
static model *space(double F)
{
  static const double K[9] = {100, 0, 15, 0, 130, 0, 15, 0, 180},
                      C[9] = {0.29938196180258764,  0, 0.019246842526345592, 0, 0.34205262752974136, 0,
                              0.019246842526345592, 0, 0.4020317886097642};
  const contact half = circle_half((contact){.kt = 60, .kn = 80, .mu = 0.5, .gap = 0.02});
  model *m;
  assert_int_equal(model_new(3, 1, 2, 1, &m), HC_OK);
  for (int i = 0; i < 3; ++i) m->mass[4 * i] = 1;
  memcpy(m->damping, C, sizeof C);
  memcpy(m->stiffness, K, sizeof K);
  m->loads[0].harmonic = 1;
  m->loads[0].cosine[0] = F, m->loads[0].cosine[2] = 0.8 * F, m->loads[0].sine[1] = 0.6 * F;
  for (int j = 0; j < 2; ++j) {
    m->contacts[j].law = half;
    m->contacts[j].pair = j ? CONTACT_SECOND : CONTACT_FIRST;
    m->contacts[j].circle = true;
    m->contacts[j].tangent[j] = 1;
    m->contacts[j].normal[2] = 1;
  }
  m->responses[0] = 1;
  return m;
}

/* Amplitude and mean of x1 at 12.5, H = 3: reference hbm.csv (an independent program; located transitions). 1e-9: what
 * the reference asks of exact forces. */
static void a_solution_beyond_the_edge_is_found(void **state)
{
  (void)state;
  const hbm_settings how = {
      .harmonics = 3, .keep_mean = true, .force = HBM_FORCE_EXACT, .tolerance = 1e-10, .accuracy = 1e-4};
  const double amplitude = 0.0136788720187776, mean = 0.000723689017065682;
  model *m = space(0.1);
  hbm_solver *s;
  hbm_curve curve = {0}, at = {0};
  hbm_measures found;
  assert_int_equal(hbm_solver_new(m, &how, &s), HC_OK);
  hbm_trace(s, 9.45, 12.6, NULL, &curve); /* whether it stops or passes */
  assert_int_equal(hbm_curve_at(s, &curve, 12.5, &at), HC_OK);
  assert_true(at.n >= 1);
  assert_int_equal(hbm_measure_response(s, 12.5, at.X, 0, &found), HC_OK);
  CHECK_NEAR(found.amplitude, amplitude, 1e-9 * amplitude, "amplitude");
  CHECK_NEAR(found.mean, mean, 1e-9 * amplitude, "mean");
  hbm_curve_free(&curve);
  hbm_curve_free(&at);
  hbm_solver_free(s);
  model_free(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_solution_beyond_the_edge_is_found)};
  check_watchdog(60);
  return cmocka_run_group_tests_name("hbm.circle_edge", tests, NULL, NULL);
}
