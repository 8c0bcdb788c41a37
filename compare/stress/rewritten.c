/* rewritten.c - see rewritten.h. */
#include "compare/stress/rewritten.h"

#include <stdlib.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/dense.h"
#include "numerics/norm.h"
#include "numerics/random.h"

static size_t vector(int n) { return (size_t)n * sizeof(double); }

/* A[n][n] into the block of B[N][N] from (at, at) on. */
static void put_block(int n, const double *A, int N, int at, double *B)
{
  for (int j = 0; j < n; ++j) memcpy(B + (size_t)(at + j) * (size_t)N + at, A + (size_t)j * (size_t)n, vector(n));
}

/* NULL: there is none. */
static model_load *load_of(const model *m, int harmonic)
{
  for (int l = 0; l < m->n_loads; ++l)
    if (m->loads[l].harmonic == harmonic) return &m->loads[l];
  return NULL;
}

/* m's loads, contacts and matrices into those of `to`, which has loads of the same harmonics, from its DOF `at` and its
 * contact `first` on. */
static void put_part(const model *m, model *to, int at, int first)
{
  const int n = m->n;
  put_block(n, m->mass, to->n, at, to->mass);
  put_block(n, m->damping, to->n, at, to->damping);
  put_block(n, m->stiffness, to->n, at, to->stiffness);
  for (int l = 0; l < m->n_loads; ++l) {
    model_load *load = load_of(to, m->loads[l].harmonic);
    memcpy(load->cosine + at, m->loads[l].cosine, vector(n));
    memcpy(load->sine + at, m->loads[l].sine, vector(n));
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
  model_free(w->company);
  free(w->map);
  free(w->offset);
}

void rewritten_motion(const rewritten *w, int n, const double *x, double *out)
{
  if (w->map) dense_multiply(w->model->n, 1, n, w->map, x, out);
  else memcpy(out, x, vector(n));
}

static const rewritten same = {.length = 1, .force = 1, .time = 1, .ratio = 1};

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

/* m in y, x = Q y; out->map is Q^T, which is Q^-1 of an orthogonal Q. */
static hc_status change(const model *m, const double *Q, rewritten *out)
{
  const int n = m->n;
  double *work = malloc((size_t)n * vector(2 * n)), *back;
  *out = same;
  out->map = back = malloc((size_t)n * vector(n));
  hc_status st = work && back ? model_copy(m, &out->model) : HC_NO_MEMORY;
  if (st == HC_OK) {
    model *t = out->model;
    dense_transpose(n, n, Q, back);
    turn_matrix(n, Q, m->mass, work, t->mass);
    turn_matrix(n, Q, m->damping, work, t->damping);
    turn_matrix(n, Q, m->stiffness, work, t->stiffness);
    for (int l = 0; l < m->n_loads; ++l) {
      dense_multiply(n, 1, n, back, m->loads[l].cosine, t->loads[l].cosine);
      dense_multiply(n, 1, n, back, m->loads[l].sine, t->loads[l].sine);
    }
    for (int j = 0; j < m->n_contacts; ++j) {
      dense_multiply(n, 1, n, back, m->contacts[j].tangent, t->contacts[j].tangent);
      dense_multiply(n, 1, n, back, m->contacts[j].normal, t->contacts[j].normal);
    }
    dense_multiply(n, m->n_responses, n, back, m->responses, t->responses);
  }
  free(work);
  return st;
}

static hc_status turn(const model *m, void (*draw)(uint64_t *, int, double *), uint64_t *random, rewritten *out)
{
  double *Q = calloc((size_t)m->n, vector(m->n));
  *out = same;
  if (!Q) return HC_NO_MEMORY;
  draw(random, m->n, Q);
  hc_status st = change(m, Q, out);
  free(Q);
  return st;
}

hc_status rewritten_stretched(const model *m, const double *by, rewritten *out)
{
  const int n = m->n;
  double *Q = calloc((size_t)n, vector(n));
  *out = same;
  if (!Q) return HC_NO_MEMORY;
  for (int i = 0; i < n; ++i) Q[i * n + i] = by[i];
  hc_status st = change(m, Q, out);
  for (int i = 0; i < n && st == HC_OK; ++i) out->map[i * n + i] = 1 / by[i];
  free(Q);
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
  *out = (rewritten){.length = length, .force = force, .time = time, .ratio = 1};
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

enum { NO_LOAD = -1 };

/* Room for m's degrees of freedom and contacts and so many more, and for a load of that harmonic; filled with m. */
static hc_status larger_model(const model *m, int dofs, int contacts, int harmonic, model **out)
{
  const bool loaded = harmonic == NO_LOAD || load_of(m, harmonic);
  hc_status st = model_new(m->n + dofs, m->n_loads + !loaded, m->n_contacts + contacts, m->n_responses, out);
  if (st != HC_OK) return st;
  for (int l = 0; l < m->n_loads; ++l) (*out)->loads[l].harmonic = m->loads[l].harmonic;
  if (!loaded) (*out)->loads[m->n_loads].harmonic = harmonic;
  put_part(m, *out, 0, 0);
  for (int r = 0; r < m->n_responses; ++r)
    memcpy((*out)->responses + r * (m->n + dofs), m->responses + r * m->n, vector(m->n));
  return HC_OK;
}

hc_status rewritten_split(const model *m, double part, rewritten *out)
{
  *out = same;
  hc_status st = larger_model(m, 0, m->n_contacts, NO_LOAD, &out->model);
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
  hc_status st = out->map ? larger_model(m, n, m->n_contacts, NO_LOAD, &out->model) : HC_NO_MEMORY;
  if (st == HC_OK) put_part(m, out->model, n, m->n_contacts);
  for (int k = 0; k < n && st == HC_OK; ++k) out->map[2 * n * k + k] = out->map[2 * n * k + n + k] = 1;
  return st;
}

hc_status rewritten_bystander(const model *m, uint64_t *random, rewritten *out)
{
  const int n = m->n, last = n * (n + 2);
  model *straight;
  *out = same;
  hc_status st = larger_model(m, 1, 0, NO_LOAD, &straight);
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
  out->history = true;
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

/* ---- other sizes -------------------------------------------------------------------------------------- */

/* d without its part in the span of basis[k][n], orthonormal; its length before and after in *kept [1]. */
static void remove_span(int n, int k, const double *basis, double *d, double *kept)
{
  const double before = norm_2(n, d);
  for (int pass = 0; pass < 2; ++pass) /* the second removes what rounding left */
    for (int b = 0; b < k; ++b) {
      const double along = dot_product(n, basis + b * n, d);
      for (int i = 0; i < n; ++i) d[i] -= along * basis[b * n + i];
    }
  *kept = before > 0 ? norm_2(n, d) / before : 0;
}

/* A random position x[n], largest entry 1, that moves no polynomial, and no slider where `sliders` says so; false if
 * there is none. basis: room for [2 n_contacts][n]. */
static bool free_position(const model *m, bool sliders, uint64_t *random, double *basis, double *x)
{
  const int n = m->n;
  int k = 0;
  double kept;
  for (int j = 0; j < 2 * m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j / 2];
    double *d = basis + k * n;
    if (j % 2 ? !contact_never_opens(&c->law) : !sliders || !contact_has_friction(&c->law)) continue;
    memcpy(d, j % 2 ? c->normal : c->tangent, vector(n));
    remove_span(n, k, basis, d, &kept);
    if (kept > 1e-9) scale(d, n, 1 / norm_2(n, d)), ++k;
  }
  for (int i = 0; i < n; ++i) x[i] = random_signed(random);
  remove_span(n, k, basis, x, &kept);
  if (k >= n || kept < 1e-3) return false;
  scale(x, n, 1 / largest(x, n));
  return true;
}

hc_status rewritten_shifted(const model *m, double size, uint64_t *random, rewritten *out)
{
  const int n = m->n;
  double *basis = malloc(2 * (size_t)m->n_contacts * vector(n)), *x = malloc(vector(n)), *held = malloc(vector(n));
  *out = same;
  out->offset = x;
  hc_status st = basis && x && held ? larger_model(m, 0, 0, 0, &out->model) : HC_NO_MEMORY;
  if (st == HC_OK) out->history = !free_position(m, true, random, basis, x);
  if (st == HC_OK && out->history && !free_position(m, false, random, basis, x)) st = HC_BAD_INPUT;
  if (st == HC_OK) {
    double *load = load_of(out->model, 0)->cosine;
    scale(x, n, size);
    dense_multiply(n, 1, n, m->stiffness, x, held);
    for (int i = 0; i < n; ++i) load[i] += held[i];
    for (int j = 0; j < m->n_contacts; ++j) {
      model_contact *c = &out->model->contacts[j];
      if (contact_never_opens(&c->law)) continue;
      /* N0 - N0' of a preload far above the vibration would be rounding only as a difference of these */
      const double moved = dot_product(n, c->normal, x), before = contact_preload(&c->law);
      c->law.gap -= moved;
      const double after = contact_preload(&c->law),
                   change = before > 0 && after > 0 ? c->law.kn * moved : before - after;
      for (int i = 0; i < n; ++i) load[i] += c->normal[i] * change;
    }
  }
  free(basis);
  free(held);
  return st;
}

/* 2.3 times below its resonance, 0.4 of critical: no harmonic makes it move much, and one motion is all it has. */
static hc_status company_of(double mass, double omega, double moves, rewritten_company kind, model **out)
{
  const double own = 2.3 * omega, k = mass * own * own, c = 0.8 * own * mass, held = kind == COMPANY_STUCK ? 2 * k : k;
  hc_status st = model_oscillator(mass, c, k, moves * hypot(held - mass * omega * omega, c * omega), 1, out);
  if (st != HC_OK) return st;
  model_contact *contact_of = (*out)->contacts;
  if (kind == COMPANY_STOPPED) {
    contact_of->law = (contact){.kn = k, .gap = -0.3 * moves};
    contact_of->normal[0] = 1;
  } else {
    contact_of->law = (contact){.kt = k, .mu = 0.5, .load = k * moves * (kind == COMPANY_STUCK ? 20 : 0.4)};
    contact_of->tangent[0] = 1;
  }
  return HC_OK;
}

hc_status rewritten_beside(const model *m, double omega, double moves, rewritten_company kind, rewritten *out)
{
  const int n = m->n;
  *out = same;
  out->regime = kind == COMPANY_STUCK ? CONTACT_STUCK : kind == COMPANY_SLIPS ? CONTACT_SLIPS : CONTACT_SEPARATES;
  out->map = calloc((size_t)n, vector(n + 1));
  hc_status st = out->map ? company_of(largest(m->mass, n * n), omega, moves, kind, &out->company) : HC_NO_MEMORY;
  if (st == HC_OK) st = larger_model(m, 1, 1, 1, &out->model);
  if (st != HC_OK) return st;
  put_part(out->company, out->model, n, m->n_contacts);
  for (int i = 0; i < n; ++i) out->map[i * (n + 1) + i] = 1;
  return HC_OK;
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
