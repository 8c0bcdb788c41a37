/* rewritten.c - see rewritten.h. */
#include "stress/rewritten.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/dense.h"
#include "numerics/random.h"

static size_t vector(int n) { return (size_t)n * sizeof(double); }

/* A[n][n] into the block of B[N][N] from (at, at) on. */
static void put_block(int n, const double *A, int N, int at, double *B)
{
  for (int j = 0; j < n; ++j) memcpy(B + (size_t)(at + j) * (size_t)N + at, A + (size_t)j * (size_t)n, vector(n));
}

/* m's loads, contacts and matrices into those of `to`, from its DOF `at` and its contact `first` on. */
static void put_part(const model *m, model *to, int at, int first)
{
  const int n = m->n;
  put_block(n, m->mass, to->n, at, to->mass);
  put_block(n, m->damping, to->n, at, to->damping);
  put_block(n, m->stiffness, to->n, at, to->stiffness);
  for (int l = 0; l < m->n_loads; ++l) {
    to->loads[l].harmonic = m->loads[l].harmonic;
    memcpy(to->loads[l].cosine + at, m->loads[l].cosine, vector(n));
    memcpy(to->loads[l].sine + at, m->loads[l].sine, vector(n));
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    model_contact *c = &to->contacts[first + j];
    c->law = m->contacts[j].law;
    c->pair = m->contacts[j].pair;
    c->circle = m->contacts[j].circle;
    memcpy(c->tangent + at, m->contacts[j].tangent, vector(n));
    memcpy(c->normal + at, m->contacts[j].normal, vector(n));
  }
}

static void put_responses(const model *m, model *to)
{
  for (int r = 0; r < m->n_responses && r < to->n_responses; ++r)
    memcpy(to->responses + (size_t)r * (size_t)to->n, m->responses + (size_t)r * (size_t)m->n, vector(m->n));
}

hc_status rewritten_with_all_responses(const model *m, model **out)
{
  hc_status st = model_new(m->n, m->n_loads, m->n_contacts, 1 + m->n, out);
  if (st != HC_OK) return st;
  put_part(m, *out, 0, 0);
  put_responses(m, *out);
  for (int i = 0; i < m->n; ++i) (*out)->responses[(size_t)(i + 1) * (size_t)m->n + (size_t)i] = 1;
  return HC_OK;
}

/* ---- coordinates --------------------------------------------------------------------------------- */

void turned_vector(int n, const double *Q, const double *x, double *out)
{
  for (int i = 0; i < n; ++i) {
    out[i] = 0;
    for (int k = 0; k < n; ++k) out[i] += Q[(size_t)i * (size_t)n + (size_t)k] * x[k];
  }
}

/* out = Q^T A Q; a symmetric A gives one, to the last bit. */
static void turned_matrix(int n, const double *Q, const double *A, double *work, double *out)
{
  const bool symmetric = dense_is_symmetric(n, A);
  for (int j = 0; j < n; ++j) turned_vector(n, Q, A + j * n, work + j * n); /* Q^T A */
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      out[j * n + i] = 0;
      for (int k = 0; k < n; ++k) out[j * n + i] += work[k * n + i] * Q[j * n + k];
    }
  for (int j = 0; j < n && symmetric; ++j)
    for (int i = 0; i < j; ++i) out[i * n + j] = out[j * n + i];
}

hc_status rewritten_turned(const model *m, const double *Q, model **out)
{
  const int n = m->n;
  double *work = malloc((size_t)n * vector(n));
  hc_status st = work ? model_copy(m, out) : HC_NO_MEMORY;
  if (st == HC_OK) {
    model *t = *out;
    turned_matrix(n, Q, m->mass, work, t->mass);
    turned_matrix(n, Q, m->damping, work, t->damping);
    turned_matrix(n, Q, m->stiffness, work, t->stiffness);
    for (int l = 0; l < m->n_loads; ++l) {
      turned_vector(n, Q, m->loads[l].cosine, t->loads[l].cosine);
      turned_vector(n, Q, m->loads[l].sine, t->loads[l].sine);
    }
    for (int j = 0; j < m->n_contacts; ++j) {
      turned_vector(n, Q, m->contacts[j].tangent, t->contacts[j].tangent);
      turned_vector(n, Q, m->contacts[j].normal, t->contacts[j].normal);
    }
    for (int r = 0; r < m->n_responses; ++r) turned_vector(n, Q, m->responses + r * n, t->responses + r * n);
  } else *out = NULL;
  free(work);
  return st;
}

/* Householder's reflection by one random vector, then by another. */
void random_rotation(uint64_t *random, int n, double *Q)
{
  for (int i = 0; i < n * n; ++i) Q[i] = i % (n + 1) == 0;
  for (int turn = 0; turn < 2; ++turn) {
    const uint64_t seed = random_bits(random);
    uint64_t again = seed;
    double size = 0;
    for (int i = 0; i < n; ++i) {
      const double v = random_signed(&again);
      size += v * v;
    }
    for (int j = 0; j < n; ++j) {
      double along = 0;
      again = seed;
      for (int i = 0; i < n; ++i) along += random_signed(&again) * Q[j * n + i];
      again = seed;
      for (int i = 0; i < n; ++i) Q[j * n + i] -= 2 * along / size * random_signed(&again);
    }
  }
}

void random_permutation(uint64_t *random, int n, double *Q)
{
  for (int i = 0; i < n * n; ++i) Q[i] = i % (n + 1) == 0;
  for (int j = n - 1; j > 0; --j) {
    const int k = random_int(random, 0, j);
    for (int i = 0; i < n; ++i) {
      const double kept = Q[j * n + i];
      Q[j * n + i] = Q[k * n + i];
      Q[k * n + i] = kept;
    }
  }
}

/* ---- units, contacts, copies, time ------------------------------------------------------------------ */

static double largest(const double *v, int n)
{
  double most = 0;
  for (int i = 0; i < n; ++i) most = fmax(most, fabs(v[i]));
  return most;
}

static void scale(double *v, int n, double by)
{
  for (int i = 0; i < n; ++i) v[i] *= by;
}

hc_status rewritten_in_units(const model *m, double length, double force, double time, model **out)
{
  const int n = m->n;
  hc_status st = model_copy(m, out);
  if (st != HC_OK) return st;
  model *u = *out;
  scale(u->mass, n * n, force * time * time / length);
  scale(u->damping, n * n, force * time / length);
  scale(u->stiffness, n * n, force / length);
  for (int l = 0; l < m->n_loads; ++l) scale(u->loads[l].cosine, n, force), scale(u->loads[l].sine, n, force);
  for (int j = 0; j < m->n_contacts; ++j) {
    contact *law = &u->contacts[j].law;
    law->kt *= force / length, law->kn *= force / length;
    law->gap *= length, law->load *= force;
  }
  return HC_OK;
}

static void take_part(contact *law, double part) { law->kt *= part, law->kn *= part, law->load *= part; }

hc_status rewritten_split(const model *m, double part, model **out)
{
  hc_status st = model_new(m->n, m->n_loads, 2 * m->n_contacts, m->n_responses, out);
  if (st != HC_OK) return st;
  put_part(m, *out, 0, 0);
  put_part(m, *out, 0, m->n_contacts);
  put_responses(m, *out);
  for (int j = 0; j < 2 * m->n_contacts; ++j) take_part(&(*out)->contacts[j].law, j < m->n_contacts ? part : 1 - part);
  return HC_OK;
}

/* The largest entry of K; where there is none, of a contact: far stiffer, it would only bring rounding. */
static double some_stiffness(const model *m)
{
  double most = largest(m->stiffness, m->n * m->n);
  const bool none = most == 0;
  for (int j = 0; j < m->n_contacts && none; ++j) most = fmax(most, fmax(m->contacts[j].law.kt, m->contacts[j].law.kn));
  return most;
}

hc_status rewritten_beside(const model *m, int more, bool twice, model **out)
{
  const int n = m->n;
  hc_status st = model_new(n + more, m->n_loads, (twice ? 2 : 1) * m->n_contacts, m->n_responses, out);
  if (st != HC_OK) return st;
  put_part(m, *out, 0, 0);
  put_responses(m, *out);
  if (twice) put_part(m, *out, n, m->n_contacts);
  for (int i = n; i < n + more && !twice; ++i) {
    const size_t at = (size_t)i * (size_t)(n + more + 1);
    (*out)->mass[at] = largest(m->mass, n * n);
    (*out)->stiffness[at] = some_stiffness(m);
    (*out)->damping[at] = largest(m->damping, n * n);
  }
  return HC_OK;
}

/* (a, b) of a cos + b sin, seen from `angle` later; of two tangents those turned by it. */
static void turn_pair(int n, double angle, double *a, double *b)
{
  const double c = cos(angle), s = sin(angle);
  for (int i = 0; i < n; ++i) {
    const double cosine = a[i];
    a[i] = c * cosine + s * b[i];
    b[i] = c * b[i] - s * cosine;
  }
}

hc_status rewritten_delayed(const model *m, double delay, model **out)
{
  hc_status st = model_copy(m, out);
  for (int l = 0; l < m->n_loads && st == HC_OK; ++l) {
    model_load *load = &(*out)->loads[l];
    if (load->harmonic > 0) turn_pair(m->n, load->harmonic * delay, load->cosine, load->sine);
  }
  return st;
}

hc_status rewritten_other_tangents(const model *m, uint64_t *random, model **out)
{
  hc_status st = model_copy(m, out);
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    model_contact *c = &(*out)->contacts[j];
    if (c->circle && c->pair == CONTACT_FIRST) turn_pair(m->n, TWO_PI * random_unit(random), c->tangent, c[1].tangent);
  }
  return st;
}

/* ---- nudges ---------------------------------------------------------------------------------------- */

static void nudge_vector(uint64_t *random, double part, int n, double *v)
{
  const double size = part * largest(v, n);
  for (int i = 0; i < n; ++i) v[i] += size * random_signed(random);
}

static void nudge_matrix(uint64_t *random, double part, int n, double *A)
{
  const double size = part * largest(A, n * n);
  const bool symmetric = dense_is_symmetric(n, A);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= j; ++i) {
      const double up = size * random_signed(random), down = symmetric ? up : size * random_signed(random);
      A[j * n + i] += up;
      if (i != j) A[i * n + j] += down;
    }
}

/* to = (1 + part A) d, A random: directions that depended on each other still do. */
static void nudge_direction(uint64_t *random, double part, int n, double *to, const double *d)
{
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) to[i] += part * random_signed(random) * d[k];
}

hc_status rewritten_nudged(const model *m, double part, uint64_t *random, model **out)
{
  const int n = m->n;
  const uint64_t seed = random_bits(random);
  hc_status st = model_copy(m, out);
  if (st != HC_OK) return st;
  model *t = *out;
  nudge_matrix(random, part, n, t->mass);
  nudge_matrix(random, part, n, t->damping);
  nudge_matrix(random, part, n, t->stiffness);
  for (int l = 0; l < m->n_loads; ++l) {
    nudge_vector(random, part, n, t->loads[l].cosine);
    nudge_vector(random, part, n, t->loads[l].sine);
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    model_contact *c = &t->contacts[j];
    double *const numbers[] = {&c->law.kt, &c->law.kn, &c->law.mu, &c->law.gap, &c->law.load};
    if (c->pair == CONTACT_SECOND) c->law = t->contacts[j - 1].law; /* one law for both */
    else
      for (int i = 0; i < 5; ++i) nudge_vector(random, part, 1, numbers[i]);
    uint64_t again = seed;
    nudge_direction(&again, part, n, c->tangent, m->contacts[j].tangent);
    again = seed;
    nudge_direction(&again, part, n, c->normal, m->contacts[j].normal);
  }
  return HC_OK;
}
