/* drawn.h - random structures as time integration sees them, and what is asked of their regularised law in the plane
 * as on a line. */
#pragma once

#include "tests/hbm/random_structures.h"
#include "timeint/cvode/structure_newton.h"

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

/* The Jacobian at y against differences: h^2/6 of the third derivative of softplus over its width, 1e-2 of a motion of
 * 1 or less. */
static inline void check_jacobian(drawn *d, double *y, int trial)
{
  double jac[MOST * MOST], f[2][MOST];
  const int n = d->scaled.n_states;
  scaled_jacobian(&d->scaled, y, jac);
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

static inline void check_jacobians(void (*draw)(uint64_t *seed, transient_law law, drawn *d))
{
  uint64_t seed = 3;
  for (int trial = 0; trial < 100; ++trial) {
    drawn d;
    double y[MOST];
    draw(&seed, TRANSIENT_LAW_REGULARISED, &d);
    for (int i = 0; i < d.scaled.n_states; ++i) y[i] = random_signed(&seed);
    check_jacobian(&d, y, trial);
    undraw(&d);
  }
}

/* z: (I - gamma J)^-1 z by elimination; product: J times that. */
static inline void eliminate(const drawn *d, const double *y, double gamma, double *z, double *product)
{
  structure_newton s;
  assert_int_equal(structure_newton_make(&s, d->base), HC_OK);
  structure_newton_linearise(&s, &d->scaled, y);
  assert_true(structure_newton_factor(&s, &d->scaled, gamma));
  structure_newton_solve(&s, z);
  structure_newton_multiply(&s, &d->scaled, z, product);
  structure_newton_free(&s);
}
