/* test_structure_stability.c - multipliers of structures: of oscillators side by side they are those of each, which a
 * closed form has; where eigenvectors fail, those of the matrix exponential; and a structure that has none to go by. */
#include <complex.h>

#include "hbm/hbm.h"
#include "hbm/hbm_solver_impl.h"
#include "hbm/stretch_flow.h"
#include "tests/hbm/random_structures.h"

enum { H = 7, LENGTH = 2 * H + 1 };

static const hbm_settings how = {.harmonics = H, .keep_mean = true, .tolerance = 1e-13, .accuracy = 1e-4};

static hbm_stability stability_of(const model *m, double omega, double *X)
{
  hbm_solver *s;
  hbm_point point;
  hbm_stability st;
  assert_int_equal(hbm_solver_new(m, &how, &s), HC_OK);
  assert_int_equal(hbm_solve(s, omega, X, &point), HC_OK);
  assert_int_equal(hbm_stability_at(s, omega, X, &st), HC_OK);
  hbm_solver_free(s);
  return st;
}

/* Case 2 of the paper at 8, whose solutions slip, separate and are unstable, and a linear oscillator beside it; written
 * in x = Q y, so that nothing is decoupled. Multipliers of the linear one: exp((-c/2 +- i w) T/m). */
static void oscillators_side_by_side(void **state)
{
  (void)state;
  const double omega = 8, mass = 2, damping = 0.7, stiffness = 30, turn = 0.6;
  const double Q[4] = {cos(turn), sin(turn), -sin(turn), cos(turn)};
  const contact laws[] = {{.kt = 100, .kn = 1000, .mu = 0.3, .gap = -5}, {.kt = 100, .kn = 200, .mu = 0.3, .gap = 0.5}};
  for (int k = 0; k < 2; ++k) {
    model *one, *two;
    double X[LENGTH] = {0}, both[2 * LENGTH];
    assert_int_equal(model_oscillator(1, 0.4, 40, k ? 10 : 100, 1, &one), HC_OK);
    one->contacts[0].law = laws[k];
    model_direction(45, one->contacts[0].tangent, one->contacts[0].normal);
    assert_int_equal(model_new(2, 1, 1, 1, &two), HC_OK);
    two->mass[0] = 1, two->mass[3] = mass;
    two->damping[0] = 0.4, two->damping[3] = damping;
    two->stiffness[0] = 40, two->stiffness[3] = stiffness;
    two->loads[0].harmonic = 1;
    two->loads[0].cosine[0] = k ? 10 : 100;
    two->contacts[0].law = laws[k];
    model_direction(45, two->contacts[0].tangent, two->contacts[0].normal);
    two->responses[0] = 1;
    model *turned = turned_structure(two, Q);
    const double at = k ? 13 : omega, period = TWO_PI / at;
    const hbm_stability alone = stability_of(one, at, X);
    hbm_solver *s;
    assert_int_equal(hbm_solver_new(turned, &how, &s), HC_OK);
    const int dim = s->sys.dim; /* q is one motion of x_0, or both */
    memset(both, 0, sizeof both);
    const double *row = condensation_first_response(s->sys.linear);
    for (int c = 0; c < LENGTH; ++c)
      for (int d = 0; d < dim; ++d) both[c * dim + d] = X[c] * (dim == 1 ? 1 / row[0] : row[d]);
    hbm_solver_free(s);
    const hbm_stability beside = stability_of(turned, at, both);
    const double decay = exp(-damping / (2 * mass) * period);
    const double swing = sqrt(stiffness / mass - damping * damping / (4 * mass * mass));
    const double complex pair = decay * cexp(I * swing * period);
    CHECK_NEAR(beside.multiplier, fmax(alone.multiplier, decay), 1e-9 * alone.multiplier, "largest, %d", k);
    CHECK_NEAR(beside.determinant, alone.determinant * decay * decay, 1e-9 * fabs(alone.determinant), "all, %d", k);
    CHECK_NEAR(beside.fold, alone.fold * creal((1 - pair) * conj(1 - pair)), 1e-9 * fabs(alone.fold) + 1e-9, "fold");
    CHECK_NEAR(beside.flip, alone.flip * creal((1 + pair) * conj(1 + pair)), 1e-9 * fabs(alone.flip) + 1e-9, "flip");
    model_free(one);
    model_free(two);
    model_free(turned);
  }
}

/* A free body without damping has A = [0 1; 0 0], which has one eigenvector: x moves by v t, under a stuck slider's
 * pull by t^2/2 more. */
static void a_free_body_has_no_eigenvectors(void **state)
{
  (void)state;
  model *m;
  stretch_flow *f;
  assert_int_equal(model_new(2, 0, 1, 1, &m), HC_OK);
  m->mass[0] = m->mass[3] = 2;
  m->contacts[0].law = (contact){.kt = 1e-300, .mu = 1, .load = 1};
  m->contacts[0].tangent[0] = 1;
  assert_int_equal(stretch_flow_new(m, &f), HC_OK);
  const contact_piece stuck = {.state = CONTACT_STICK};
  const contact_piece *piece[] = {&stuck};
  double phi[25] = {0};
  for (int i = 0; i < 5; ++i) phi[i * 6] = 1;
  assert_int_equal(stretch_flow_advance(f, piece, 0.5, phi), HC_OK);
  const double expected[25] = {1, 0,    0.5, 0, 0.125 / 2, 0, 1, 0, 0.5, 0, 0, 0, 1,
                               0, 0.25, 0,   0, 0,         1, 0, 0, 0,   0, 0, 1};
  for (int i = 0; i < 25; ++i) CHECK_NEAR(phi[i], expected[i], 1e-14, "entry %d", i);
  stretch_flow_free(f);
  model_free(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(oscillators_side_by_side),
      cmocka_unit_test(a_free_body_has_no_eigenvectors),
  };
  check_watchdog(60);
  return cmocka_run_group_tests_name("hbm.structure_stability", tests, NULL, NULL);
}
