/* test_model.c - the equations without dimensions, and their Jacobian for smooth laws. */

#include <float.h>

#include "numerics/random.h"
#include "tests/scene_parts.h"
#include "tests/timeint/drawn.h"
#include "tests/timeint/scenes.h"

/* Against the printed equation in the scene's own units, where both laws are exact (no corner within 40 widths):
 * rounding only, of the largest term. */
static void rhs_is_the_printed_equation(CHECK_STATE)
{
  scene sc = scene_gap1();
  scene_add(&sc, 20, 30, 0.5, -0.1, 30);
  const double omega = 7, L = 3, theta = 0.7, x = 0.4, v = -5, w[2] = {0.25, 0.1};
  double force =
      sc.structure->loads->amplitude * cos(theta) - *sc.structure->damping.v * v - *sc.structure->stiffness.v * x;
  for (int j = 0; j < 2; ++j) {
    const contact *c = &sc.structure->contacts[j].given.law;
    double a = sc.structure->contacts[j].given.angle_deg * PI / 180, at = w[j], t,
           largest = c->mu * contact_normal(c, x * sin(a));
    t = fmin(fmax(c->kt * (x * cos(a) - at), -largest), largest);
    force -= t * cos(a) + (contact_normal(c, x * sin(a)) - contact_preload(c)) * sin(a);
  }
  scaled_model m;
  scene_scaled(&m, &sc, omega, L);
  double y[4] = {x / L, v / (omega * L), w[0] / L, w[1] / L}, dy[4];
  CHECK_LE(1, scaled_rhs(&m, theta, y, dy), "finite");
  CHECK_NEAR(dy[1] * *sc.structure->mass.v * omega * omega * L, force, 64 * DBL_EPSILON * 1000, "M x''");
  CHECK_NEAR(dy[0] * omega * L, v, 4 * DBL_EPSILON * 5, "x'");
}

/* Smooth laws, of numbers of the order of 1 and third derivatives of the order of 10: differences are 1e-9 off. */
static void jacobian_of_smooth_laws_is_the_derivative(CHECK_STATE)
{
  const contact laws[] = {{.smooth = CONTACT_POLYNOMIAL, .power = {0.1, 0.2, 0, -0.1}},
                          {.smooth = CONTACT_TANH, .mu = 0.3, .load = 2, .epsilon = 3},
                          {.smooth = CONTACT_TANH, .mu = 0.3, .kn = 2, .gap = -0.2, .epsilon = 3}};
  const transient_settings how = {.law = TRANSIENT_LAW_REGULARISED, .regularisation = 0.3};
  scaled_contact scaled_contacts[3];
  CHECK_MADE(model, m, model_oscillator(1, 0.4, 2, 1, 3, &m));
  for (int j = 0; j < 3; ++j) {
    m->contacts[j].law = laws[j];
    *m->contacts[j].tangent = 0.8, *m->contacts[j].normal = j == 1 ? 0 : 0.6;
  }
  CHECK_MADE(modal_base, base, modal_base_new(m, &base));
  scaled_model scaled = {.base = base, .contact = scaled_contacts};
  scaled_make(&scaled, m, &how, 1.3, 0.9);
  uint64_t seed = 5;
  for (int i = 0; i < 50; ++i) {
    double y[5], jac[25], f[2][5];
    for (int k = 0; k < 5; ++k) y[k] = random_signed(&seed);
    jacobian_of(&scaled, y, jac);
    for (int k = 0; k < 5; ++k) {
      const double at = y[k], h = 1e-5;
      for (int s = 0; s < 2; ++s) y[k] = at + (s ? -h : h), assert_true(scaled_rhs(&scaled, 1, y, f[s]));
      y[k] = at;
      for (int r = 0; r < 5; ++r) CHECK_NEAR(jac[5 * k + r], (f[0][r] - f[1][r]) / (2 * h), 1e-8, "%d by %d", r, k);
    }
  }
  modal_base_free(base);
  model_free(m);
}

/* x -> 1e9 x and 1e-9 x: scaling force, gaps and L scales nothing that the solver sees; rounding of the quotients
 * only. */
static void scale_drops_out(CHECK_STATE)
{
  scaled_model one, other;
  scene sc = scene_c2();
  scene_scaled(&one, &sc, 7, 10);
  for (int big = 0; big < 2; ++big) {
    double s = big ? 1e9 : 1e-9;
    scene scaled = scene_own(&sc);
    scaled.structure->loads->amplitude *= s, scaled.structure->contacts[0].given.law.gap *= s;
    scene_scaled(&other, &scaled, 7, 10 * s);
    CHECK_NEAR(scene_f(&other), scene_f(&one), 8 * DBL_EPSILON * scene_f(&one), "force");
    CHECK_NEAR(other.contact[0].law.gap, one.contact[0].law.gap, 8 * DBL_EPSILON, "gap");
    CHECK_NEAR(other.contact[0].law.width, one.contact[0].law.width, 8 * DBL_EPSILON, "width");
  }
}

static void not_finite_is_noticed(CHECK_STATE)
{
  scene sc = scene_c2();
  scaled_model m;
  scene_scaled(&m, &sc, 7, 10);
  double dy[3];
  for (int i = 0; i < 3; ++i) {
    double y[3] = {0.1, 0.2, 0.3};
    y[i] = NAN;
    CHECK_LE(scaled_rhs(&m, 0, y, dy), 0, "NaN in state %d", i);
    y[i] = INFINITY;
    CHECK_LE(scaled_rhs(&m, 0, y, dy), 0, "infinity in state %d", i);
  }
}

CHECK_TESTS("timeint.model", 60, rhs_is_the_printed_equation, jacobian_of_smooth_laws_is_the_derivative,
            scale_drops_out, not_finite_is_noticed)
