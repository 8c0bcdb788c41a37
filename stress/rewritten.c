/* rewritten.c - see rewritten.h. */
#include "stress/rewritten.h"

#include <stdlib.h>
#include <string.h>

#include "numerics/base/constants.h"
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

void rewritten_clear(rewritten *w)
{
  model_free(w->model);
  free(w->map);
}

void rewritten_motion(const rewritten *w, int n, const double *x, double *out)
{
  if (w->map) dense_multiply(w->model->n, 1, n, w->map, x, out);
  else memcpy(out, x, vector(n));
}

static const rewritten same = {.length = 1, .force = 1, .time = 1};

hc_status rewritten_with_all_responses(const model *m, model **out)
{
  const size_t n = (size_t)m->n;
  hc_status st = model_copy_sized(m, m->n_contacts, 1 + m->n, out);
  for (size_t i = 0; i < n * n && st == HC_OK; ++i) (*out)->responses[n + i] = i % (n + 1) == 0;
  return st;
}

/* ---- coordinates --------------------------------------------------------------------------------- */

/* out = Q^T A Q; a symmetric A gives one, to the last bit. */
static void turn_matrix(int n, const double *Q, const double *A, double *work, double *out)
{
  dense_congruence(n, n, Q, A, work, out);
  for (int j = 0; j < n && dense_is_symmetric(n, A); ++j)
    for (int i = 0; i < j; ++i) out[i * n + j] = out[j * n + i];
}

/* m in y, x = Q y. */
static hc_status turn(const model *m, void (*draw)(uint64_t *, int, double *), uint64_t *random, rewritten *out)
{
  const int n = m->n;
  double *Q = calloc((size_t)n, vector(n)), *work = malloc((size_t)n * vector(2 * n)), *map;
  *out = same;
  out->map = map = malloc((size_t)n * vector(n));
  hc_status st = Q && work && map ? model_copy(m, &out->model) : HC_NO_MEMORY;
  if (st == HC_OK) {
    model *t = out->model;
    draw(random, n, Q);
    dense_transpose(n, n, Q, map);
    turn_matrix(n, Q, m->mass, work, t->mass);
    turn_matrix(n, Q, m->damping, work, t->damping);
    turn_matrix(n, Q, m->stiffness, work, t->stiffness);
    for (int l = 0; l < m->n_loads; ++l) {
      dense_multiply(n, 1, n, map, m->loads[l].cosine, t->loads[l].cosine);
      dense_multiply(n, 1, n, map, m->loads[l].sine, t->loads[l].sine);
    }
    for (int j = 0; j < m->n_contacts; ++j) {
      dense_multiply(n, 1, n, map, m->contacts[j].tangent, t->contacts[j].tangent);
      dense_multiply(n, 1, n, map, m->contacts[j].normal, t->contacts[j].normal);
    }
    dense_multiply(n, m->n_responses, n, map, m->responses, t->responses);
  }
  free(Q);
  free(work);
  return st;
}

/* Householder's reflection by one random vector, then by another. */
static void draw_rotation(uint64_t *random, int n, double *Q)
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

static void draw_permutation(uint64_t *random, int n, double *Q)
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

hc_status rewritten_permuted(const model *m, uint64_t *random, rewritten *out)
{
  return turn(m, draw_permutation, random, out);
}

hc_status rewritten_rotated(const model *m, uint64_t *random, rewritten *out)
{
  return turn(m, draw_rotation, random, out);
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

hc_status rewritten_in_units(const model *m, double length, double force, double time, rewritten *out)
{
  const int n = m->n;
  *out = (rewritten){.length = length, .force = force, .time = time};
  hc_status st = model_copy(m, &out->model);
  if (st != HC_OK) return st;
  model *u = out->model;
  scale(u->mass, n * n, force * time * time / length);
  scale(u->damping, n * n, force * time / length);
  scale(u->stiffness, n * n, force / length);
  for (int l = 0; l < m->n_loads; ++l) scale(u->loads[l].cosine, n, force), scale(u->loads[l].sine, n, force);
  for (int j = 0; j < m->n_contacts; ++j) {
    contact *law = &u->contacts[j].law;
    *law = contact_in_units(law, length / force, 1 / length, time / length);
  }
  return HC_OK;
}

/* Room for m's degrees of freedom and `more`, with m's contacts once or twice, filled with m once. */
static hc_status beside(const model *m, int more, int times, model **out)
{
  hc_status st = model_new(m->n + more, m->n_loads, times * m->n_contacts, m->n_responses, out);
  if (st != HC_OK) return st;
  put_part(m, *out, 0, 0);
  for (int r = 0; r < m->n_responses; ++r)
    memcpy((*out)->responses + r * (m->n + more), m->responses + r * m->n, vector(m->n));
  return HC_OK;
}

hc_status rewritten_split(const model *m, double part, rewritten *out)
{
  *out = same;
  hc_status st = beside(m, 0, 2, &out->model);
  if (st == HC_OK) put_part(m, out->model, 0, m->n_contacts);
  for (int j = 0; j < 2 * m->n_contacts && st == HC_OK; ++j) {
    contact *law = &out->model->contacts[j].law;
    const double its = j < m->n_contacts ? part : 1 - part;
    law->kt *= its, law->kn *= its, law->load *= its;
    scale(law->power, CONTACT_POWERS, its);
  }
  return st;
}

hc_status rewritten_copies(const model *m, rewritten *out)
{
  const int n = m->n;
  *out = same;
  out->map = calloc((size_t)n, vector(2 * n));
  hc_status st = out->map ? beside(m, n, 2, &out->model) : HC_NO_MEMORY;
  if (st == HC_OK) put_part(m, out->model, n, m->n_contacts);
  for (int k = 0; k < n && st == HC_OK; ++k) out->map[2 * n * k + k] = out->map[2 * n * k + n + k] = 1;
  return st;
}

hc_status rewritten_bystander(const model *m, uint64_t *random, rewritten *out)
{
  const int n = m->n, last = n * (n + 2);
  model *straight;
  *out = same;
  hc_status st = beside(m, 1, 1, &straight);
  if (st != HC_OK) return st;
  straight->mass[last] = largest(m->mass, n * n);
  /* The largest entry of K; where there is none, of a contact: far stiffer, it would only bring rounding. */
  double most = largest(m->stiffness, m->n * m->n);
  const bool none = most == 0;
  for (int j = 0; j < m->n_contacts && none; ++j) most = fmax(most, fmax(m->contacts[j].law.kt, m->contacts[j].law.kn));
  straight->stiffness[last] = most;
  straight->damping[last] = largest(m->damping, n * n);
  st = turn(straight, draw_rotation, random, out);
  model_free(straight);
  return st;
}

void rewritten_turn(int n, double angle, double *a, double *b)
{
  const double c = cos(angle), s = sin(angle);
  for (int i = 0; i < n; ++i) {
    const double cosine = a[i];
    a[i] = c * cosine + s * b[i];
    b[i] = c * b[i] - s * cosine;
  }
}

hc_status rewritten_delayed(const model *m, double delay, rewritten *out)
{
  *out = same;
  out->delay = delay;
  hc_status st = model_copy(m, &out->model);
  for (int l = 0; l < m->n_loads && st == HC_OK; ++l) {
    model_load *load = &out->model->loads[l];
    if (load->harmonic > 0) rewritten_turn(m->n, load->harmonic * delay, load->cosine, load->sine);
  }
  return st;
}

hc_status rewritten_other_tangents(const model *m, uint64_t *random, rewritten *out)
{
  *out = same;
  hc_status st = model_copy(m, &out->model);
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    model_contact *c = &out->model->contacts[j];
    if (c->circle && c->pair == CONTACT_FIRST)
      rewritten_turn(m->n, TWO_PI * random_unit(random), c->tangent, c[1].tangent);
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

hc_status rewritten_nudged(const model *m, double part, uint64_t *random, rewritten *out)
{
  const int n = m->n;
  const uint64_t seed = random_bits(random);
  *out = same;
  hc_status st = model_copy(m, &out->model);
  if (st != HC_OK) return st;
  model *t = out->model;
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
    for (int i = 0; i < CONTACT_POWERS && c->law.smooth != CONTACT_KINKED; ++i)
      nudge_vector(random, part, 1, &c->law.power[i]);
    if (c->law.smooth == CONTACT_TANH) nudge_vector(random, part, 1, &c->law.epsilon);
    uint64_t again = seed;
    nudge_direction(&again, part, n, c->tangent, m->contacts[j].tangent);
    again = seed;
    nudge_direction(&again, part, n, c->normal, m->contacts[j].normal);
  }
  return HC_OK;
}
