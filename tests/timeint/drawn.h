/* drawn.h - random structures as time integration sees them, and what is asked of their regularised law in the plane
 * as on a line. */
#pragma once

#include "tests/closed_form.h"
#include "tests/hbm/random_structures.h"
#include "timeint/closed_form/interval_modes.h"
#include "timeint/cvode/structure_newton.h"
#include "timeint/period/integrate.h"

enum { MOST = 100 /* states */, MOST_CONTACTS = 12 };

typedef struct drawn {
  model *m;
  modal_base *base;
  scaled_contact contacts[MOST_CONTACTS];
  scaled_model scaled;
} drawn;

static inline void scale_drawn(drawn *d, transient_law law, double omega)
{
  const transient_settings how = {.law = law, .regularisation = 1e-2};
  assert_true(d->m->n_contacts <= MOST_CONTACTS);
  assert_int_equal(modal_base_new(d->m, &d->base), HC_OK);
  d->scaled = (scaled_model){.contact = d->contacts, .base = d->base};
  scaled_make(&d->scaled, d->m, &how, omega, 1);
}

static inline void undraw(drawn *d)
{
  modal_base_free(d->base);
  model_free(d->m);
}

/* The Jacobian of the regularised law at y, column by column. */
static inline void jacobian_of(const scaled_model *m, const double *y, double *jac)
{
  workspace memory = {0};
  const size_t n = (size_t)m->n_states;
  double *unit = workspace_doubles(&memory, n);
  CHECK_FILLED(structure_newton, s, structure_newton_make(&s, m->base, &memory));
  structure_newton_linearise(&s, m, y);
  for (size_t q = 0; q < n; ++q) {
    unit[q] = 1;
    structure_newton_multiply(&s, m, unit, jac + q * n);
    unit[q] = 0;
  }
  workspace_free(&memory);
}

/* The Jacobian at y against differences: h^2/6 of the third derivative of softplus over its width, 1e-2 of a motion of
 * 1 or less. */
static inline void check_jacobian(drawn *d, double *y, const double *jac, int trial)
{
  double f[2][MOST];
  const int n = d->scaled.n_states;
  for (int q = 0; q < n; ++q) {
    double size = 1;
    const double at = y[q], h = 1e-6;
    for (int side = 0; side < 2; ++side) {
      y[q] = at + (side ? h : -h);
      assert_true(scaled_rhs(&d->scaled, 1, y, f[side]));
    }
    y[q] = at;
    for (int i = 0; i < n; ++i) size = fmax(size, fabs(jac[i + q * n]));
    for (int i = 0; i < n; ++i)
      CHECK_NEAR((f[1][i] - f[0][i]) / (2 * h), jac[i + q * n], 1e-4 * size, "trial %d [%d, %d]", trial, i, q);
  }
}

/* Newton's matrix of the regularised law: J is the derivative, and elimination solves (I - gamma J) z = r, to rounding
 * times the entries. Also with damping that the modes diagonalise, and with the dashpot's force. */
static inline void check_newton(void (*draw)(uint64_t *seed, transient_law law, drawn *d))
{
  uint64_t seed = 9;
  for (int trial = 0; trial < 100; ++trial) {
    drawn d;
    workspace memory = {0};
    double y[MOST], r[MOST], z[MOST], jac[MOST * MOST];
    draw(&seed, TRANSIENT_LAW_REGULARISED, &d);
    const int n = d.scaled.n_states;
    if (trial % 2) {
      for (int i = 0; i < d.m->n * d.m->n; ++i) d.m->damping[i] = 0.3 * d.m->mass[i];
      modal_base_free(d.base);
      assert_int_equal(modal_base_new(d.m, &d.base), HC_OK);
      assert_true(d.base->diagonal_C);
      d.scaled.base = d.base;
    }
    for (int j = 0; j < d.scaled.n_contacts; ++j) d.contacts[j].law.overstress = trial % 4 < 2;
    const double gamma = pow(10, -4 + 4 * random_unit(&seed));
    for (int i = 0; i < n; ++i) y[i] = random_signed(&seed), r[i] = z[i] = random_signed(&seed);
    jacobian_of(&d.scaled, y, jac);
    check_jacobian(&d, y, jac, trial);
    CHECK_FILLED(structure_newton, s, structure_newton_make(&s, d.base, &memory));
    structure_newton_linearise(&s, &d.scaled, y);
    assert_true(structure_newton_factor(&s, &d.scaled, gamma));
    structure_newton_solve(&s, z);
    for (int i = 0; i < n; ++i) {
      double sum = 0, size = 1;
      for (int q = 0; q < n; ++q) sum += jac[i + q * n] * z[q], size += fabs(jac[i + q * n] * z[q]);
      CHECK_NEAR(z[i] - gamma * sum, r[i], 1e-9 * (1 + gamma * size), "trial %d, row %d, gamma %g", trial, i, gamma);
    }
    workspace_free(&memory);
    undraw(&d);
  }
}

/* The same period by series and by CVODE, which carries the angle of a planar T as a state, at 1e-13 a step; and its
 * matrix, that starts at each transition from CVODE's motion. The first opening of a touch-down is off by 1e-12 of T,
 * and a period magnifies what steps leave by up to 1e3: `off`. Transitions by series, and trials with some. */
static inline int check_series_and_events(void (*draw)(uint64_t *seed, transient_law law, drawn *d), int trials,
                                          double off, int *changing)
{
  uint64_t seed = 16;
  int transitions = 0;
  *changing = 0;
  for (int trial = 0; trial < trials; ++trial) {
    drawn d;
    double y[MOST] = {0}, z[MOST];
    static double phi[2][MOST * MOST];
    draw(&seed, TRANSIENT_LAW_EXACT, &d);
    const int n = d.scaled.n_states;
    CHECK_MADE(integrator, series, integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &series));
    CHECK_MADE(integrator, events, integrate_new_events(d.base, 1e-13, &events));
    for (int period = 0; period < 4; ++period) {
      const bool varies = period == 3;
      memcpy(z, y, sizeof y);
      assert_int_equal(varies ? integrate_monodromy(series, &d.scaled, y, phi[0])
                              : integrate_period(series, &d.scaled, y, NULL, NULL),
                       HC_OK);
      assert_int_equal(varies ? integrate_monodromy(events, &d.scaled, z, phi[1])
                              : integrate_period(events, &d.scaled, z, NULL, NULL),
                       HC_OK);
      for (int i = 0; i < n; ++i) CHECK_NEAR(z[i], y[i], off, "trial %d, period %d, state %d", trial, period, i);
      for (int i = 0; i < n * n && varies; ++i) CHECK_NEAR(phi[1][i], phi[0][i], 1e-6, "trial %d, %d", trial, i);
    }
    transitions += (int)integrate_transitions(series);
    *changing += integrate_transitions(series) > 0;
    integrate_free(series);
    integrate_free(events);
    undraw(&d);
  }
  return transitions;
}
