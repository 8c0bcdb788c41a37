/* test_rest.c - a model about its rest: every force of x = rest + y is that of y, at rest and away from it. */
#include <float.h>

#include "model/rest.h"
#include "tests/check.h"

enum { N = 4 };

/* Four masses: a stop, a slider on constant load, one on a preloaded contact, a circle, a polynomial. */
static model *example(void)
{
  CHECK_MADE(model, m, model_new(N, 2, 6, 1, &m));
  for (int i = 0; i < N; ++i) {
    m->mass[i * (N + 1)] = 1 + 0.1 * i;
    m->stiffness[i * (N + 1)] = 30 + i;
    if (i + 1 < N) m->stiffness[i * N + i + 1] = m->stiffness[(i + 1) * N + i] = -10;
    m->loads[0].cosine[i] = 900 - 400 * i;
    m->loads[1].cosine[i] = 1;
  }
  m->loads[1].harmonic = 1;
  m->responses[0] = 1;
  model_contact *c = m->contacts;
  c[0].law = (contact){.kn = 200, .gap = -20}, c[0].normal[0] = 1;
  c[1].law = (contact){.kt = 70, .mu = 0.4, .load = 50}, c[1].tangent[1] = 1;
  c[2].law = (contact){.kt = 40, .kn = 60, .mu = 0.3, .gap = 8}, c[2].tangent[2] = 1, c[2].normal[3] = 1;
  c[3].law = c[4].law = (contact){.kt = 20, .kn = 25, .mu = 1.2, .gap = 3};
  c[3].pair = CONTACT_FIRST, c[4].pair = CONTACT_SECOND, c[3].circle = c[4].circle = true;
  c[3].tangent[0] = c[4].tangent[2] = 1, c[3].normal[1] = c[4].normal[1] = 1;
  c[5].law = (contact){.smooth = CONTACT_POLYNOMIAL, .power = {0.02, 1e-3}}, c[5].normal[3] = 1;
  return m;
}

/* out[N]: K x + contacts - p_0, sliders at w[6] moved as far as the law moves them; size of all forces. */
static double forces(const model *m, const double *x, const double *w, double *out)
{
  double size = 0, T[2];
  for (int i = 0; i < N; ++i) {
    out[i] = 0;
    for (int k = 0; k < N; ++k) out[i] += m->stiffness[k * N + i] * x[k], size += fabs(m->stiffness[k * N + i] * x[k]);
    for (int l = 0; l < m->n_loads; ++l) out[i] -= m->loads[l].harmonic == 0 ? m->loads[l].cosine[i] : 0;
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const int pair = c->circle ? 2 : 1;
    const double v = dot_product(N, c->normal, x);
    double moved[2] = {w[j], pair > 1 ? w[j + 1] : 0}, u[2] = {0};
    for (int d = 0; d < pair; ++d) u[d] = dot_product(N, c[d].tangent, x);
    const bool spring = c->law.smooth == CONTACT_POLYNOMIAL;
    const double across = spring ? contact_polynomial(&c->law, v, &(double){0}) : contact_normal_change(&c->law, v);
    if (pair > 1) contact_step_planar(&c->law, u, v, moved, T);
    else contact_step(&c->law, u[0], v, moved, T);
    for (int i = 0; i < N; ++i) {
      out[i] += c->normal[i] * across + (pair > 1 ? c[1].normal[i] * across : 0);
      for (int d = 0; d < pair; ++d) out[i] += c[d].tangent[i] * T[d];
      size += fabs(out[i]);
    }
    j += pair - 1;
  }
  return size;
}

static void every_force_is_that_of_the_motion_about_rest(CHECK_STATE)
{
  model *m = example(), *about;
  double rest[N], w[6] = {0}, moved[6], F[N], G[N];
  assert_int_equal(model_about_rest(m, &about, rest), HC_OK);
  /* Rest is an equilibrium, and a load is left only for tractions. */
  double size = forces(m, rest, w, F);
  for (int i = 0; i < N; ++i) CHECK_LE(fabs(F[i]), 64 * DBL_EPSILON * size, "force %d at rest", i);
  for (int j = 0; j < 6; ++j) moved[j] = w[j] - dot_product(N, m->contacts[j].tangent, rest);
  for (int k = 0; k < 50; ++k) {
    double x[N], y[N];
    for (int i = 0; i < N; ++i) y[i] = (k % 10) * 0.7 * sin(3 * i + k), x[i] = rest[i] + y[i];
    size = forces(m, x, w, F);
    forces(about, y, moved, G);
    for (int i = 0; i < N; ++i) CHECK_NEAR(F[i], G[i], 64 * DBL_EPSILON * size, "force %d of motion %d", i, k);
  }
  /* What the polynomial carries at rest is said of the original one. */
  const double v0 = rest[3];
  CHECK_NEAR(contact_across(&about->contacts[5].law, 0.3), contact_across(&m->contacts[5].law, v0 + 0.3),
             64 * DBL_EPSILON * fabs(v0 * v0 * v0), "force across");
  model_free(m);
  model_free(about);
}

static void without_tractions_no_static_load_is_left(CHECK_STATE)
{
  model *m = example(), *about;
  double rest[N];
  for (int j = 1; j < 5; ++j) m->contacts[j].law.mu = 0;
  assert_int_equal(model_about_rest(m, &about, rest), HC_OK);
  assert_int_equal(about->n_loads, 1);
  assert_int_equal(about->loads[0].harmonic, 1);
  assert_true(about->contacts[0].law.gap != m->contacts[0].law.gap);
  model_free(m);
  model_free(about);
}

static void without_a_static_load_nothing_changes(CHECK_STATE)
{
  model *m = example(), *about;
  double rest[N];
  memset(m->loads[0].cosine, 0, N * sizeof(double));
  assert_int_equal(model_about_rest(m, &about, rest), HC_OK);
  for (int i = 0; i < N; ++i) assert_true(rest[i] == 0);
  for (int j = 0; j < 6; ++j) assert_true(about->contacts[j].law.gap == m->contacts[j].law.gap);
  assert_int_equal(about->n_loads, 2);
  model_free(m);
  model_free(about);
}

static void a_contacts_own_length_is_the_least_of_its_lengths(CHECK_STATE)
{
  /* N0 = 8 * 0.5 = 4, slip length 0.25 * 4/4 = 0.25. */
  assert_true(contact_length(&(contact){.kt = 4, .kn = 8, .mu = 0.25, .gap = 0.5}) == 0.25);
  assert_true(contact_length(&(contact){.kt = 4, .kn = 8, .mu = 0.25, .gap = -0.5}) == 0.5);
  assert_true(contact_length(&(contact){.kt = 4, .mu = 0.25, .load = 4}) == 0.25);
  assert_true(contact_length(&(contact){.kn = 8}) == 0);
}

CHECK_TESTS("model.rest", 30, every_force_is_that_of_the_motion_about_rest, without_tractions_no_static_load_is_left,
            without_a_static_load_nothing_changes, a_contacts_own_length_is_the_least_of_its_lengths)
