/* random_structures.h - structures drawn at random, and the same structure written in another way. */
#pragma once

#include "model/model.h"
#include "numerics/random.h"
#include "tests/check.h"

/* A += scale v v^T for `terms` random v: symmetric, definite if there are n of them. */
static inline void add_random_outer(uint64_t *seed, int n, int terms, double scale, double *A)
{
  for (int k = 0; k < terms; ++k) {
    double v[64];
    for (int i = 0; i < n; ++i) v[i] = random_signed(seed);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) A[j * n + i] += scale * v[i] * v[j];
  }
}

/* Two or three DOFs of n, by random weights. */
static inline void random_direction(uint64_t *seed, int n, double *d)
{
  memset(d, 0, (size_t)n * sizeof *d);
  for (int k = random_int(seed, 2, 3); k > 0; --k) d[random_int(seed, 0, n - 1)] = random_signed(seed);
}

/* A structure of n DOFs and n_contacts contacts, some of which share directions with others, with a static load and
 * one of harmonic 1; damping that no modes diagonalise. kt and kn are of the order of K. To free with model_free. */
static inline model *random_structure(uint64_t *seed, int n, int n_contacts)
{
  CHECK_MADE(model, m, model_new(n, 2, n_contacts, 2, &m));
  for (int i = 0; i < n; ++i) m->mass[i * (n + 1)] = 1 + random_unit(seed);
  add_random_outer(seed, n, n, 0.2 / n, m->mass);
  for (int i = 0; i < n; ++i) m->stiffness[i * (n + 1)] = 20 + 100 * random_unit(seed);
  add_random_outer(seed, n, n, 10.0 / n, m->stiffness);
  for (int i = 0; i < n; ++i) m->damping[i * (n + 1)] = 0.5 + random_unit(seed);
  add_random_outer(seed, n, n, 0.2 / n, m->damping);
  m->loads[0].harmonic = 0;
  m->loads[1].harmonic = 1;
  for (int i = 0; i < n; ++i) {
    m->loads[0].cosine[i] = random_signed(seed);
    m->loads[1].cosine[i] = 20 * random_signed(seed);
    m->loads[1].sine[i] = 20 * random_signed(seed);
    m->responses[i] = random_signed(seed);
    m->responses[n + i] = i == n - 1;
  }
  for (int j = 0; j < n_contacts; ++j) {
    model_contact *c = &m->contacts[j];
    const double kind = random_unit(seed);
    random_direction(seed, n, c->tangent);
    random_direction(seed, n, c->normal);
    if (j > 0 && random_unit(seed) < 0.3)
      memcpy(c->tangent, m->contacts[j - 1].tangent, (size_t)n * sizeof *c->tangent);
    if (j > 0 && random_unit(seed) < 0.3) memcpy(c->normal, m->contacts[j - 1].normal, (size_t)n * sizeof *c->normal);
    c->law = (contact){.kt = 10 + 50 * random_unit(seed), .kn = 10 + 50 * random_unit(seed)};
    c->law.mu = 0.1 + 0.5 * random_unit(seed);
    c->law.gap = 0.2 * random_signed(seed);
    if (kind < 0.2) { /* a Jenkins element */
      c->law.load = random_unit(seed);
      c->law.kn = c->law.gap = 0;
      memset(c->normal, 0, (size_t)n * sizeof *c->normal);
    } else if (kind < 0.4) { /* a unilateral spring */
      c->law.kt = c->law.mu = 0;
      memset(c->tangent, 0, (size_t)n * sizeof *c->tangent);
    }
  }
  return m;
}

/* Contacts j and j + 1 become the two directions of one of that law under the law of the circle, along the normal of
 * contact j. */
static inline void make_circle(model *m, int j, contact whole)
{
  for (int d = 0; d < 2; ++d) {
    model_contact *c = &m->contacts[j + d];
    c->law = model_half_law(&whole);
    c->pair = d ? CONTACT_SECOND : CONTACT_FIRST;
    c->circle = true;
  }
  memcpy(m->contacts[j + 1].normal, m->contacts[j].normal, (size_t)m->n * sizeof *m->contacts->normal);
}

/* to = Q^T from, of a vector. */
static inline void turn_vector(int n, const double *Q, const double *from, double *to)
{
  for (int i = 0; i < n; ++i) {
    to[i] = 0;
    for (int k = 0; k < n; ++k) to[i] += Q[i * n + k] * from[k];
  }
}

/* to = Q^T from Q, of a matrix by columns. */
static inline void turn_matrix(int n, const double *Q, const double *from, double *to)
{
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l) sum += Q[i * n + k] * from[l * n + k] * Q[j * n + l];
      to[j * n + i] = sum;
    }
}

/* The same structure in y, x = Q y, Q[n][n] by columns and not singular. */
static inline model *turned_structure(const model *m, const double *Q)
{
  const int n = m->n;
  CHECK_MADE(model, t, model_copy(m, &t));
  turn_matrix(n, Q, m->mass, t->mass);
  turn_matrix(n, Q, m->damping, t->damping);
  turn_matrix(n, Q, m->stiffness, t->stiffness);
  for (int l = 0; l < m->n_loads; ++l) {
    turn_vector(n, Q, m->loads[l].cosine, t->loads[l].cosine);
    turn_vector(n, Q, m->loads[l].sine, t->loads[l].sine);
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    turn_vector(n, Q, m->contacts[j].tangent, t->contacts[j].tangent);
    turn_vector(n, Q, m->contacts[j].normal, t->contacts[j].normal);
  }
  for (int r = 0; r < m->n_responses; ++r) turn_vector(n, Q, m->responses + r * n, t->responses + r * n);
  return t;
}
