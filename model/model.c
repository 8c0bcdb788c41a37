/* model.c - see model.h. */
#include "model/model.h"

#include <stdlib.h>
#include <string.h>

static double *take(double **next, size_t length)
{
  double *taken = *next;
  *next += length;
  return taken;
}

hc_status model_new(int n, int n_loads, int n_contacts, int n_responses, model **out)
{
  *out = NULL;
  if (n < 1 || n_loads < 0 || n_contacts < 0 || n_responses < 0) return HC_BAD_INPUT;
  model *m = calloc(1, sizeof *m);
  if (!m) return HC_NO_MEMORY;
  m->n = n;
  m->n_loads = n_loads;
  m->n_contacts = n_contacts;
  m->n_responses = n_responses;
  /* Three matrices, two vectors a load and a contact, one a response. */
  const size_t length = (size_t)n,
               vectors = 3 * length + 2 * (size_t)n_loads + 2 * (size_t)n_contacts + (size_t)n_responses;
  m->numbers = calloc(vectors * length, sizeof *m->numbers);
  m->loads = calloc((size_t)n_loads + 1, sizeof *m->loads);
  m->contacts = calloc((size_t)n_contacts + 1, sizeof *m->contacts);
  if (!m->numbers || !m->loads || !m->contacts) {
    model_free(m);
    return HC_NO_MEMORY;
  }
  /* Places all vectors and matrices in the block. */
  double *next = m->numbers;
  m->mass = take(&next, length * length);
  m->damping = take(&next, length * length);
  m->stiffness = take(&next, length * length);
  for (int i = 0; i < m->n_loads; ++i) {
    m->loads[i].cosine = take(&next, length);
    m->loads[i].sine = take(&next, length);
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    m->contacts[j].tangent = take(&next, length);
    m->contacts[j].normal = take(&next, length);
  }
  m->responses = take(&next, length * (size_t)m->n_responses);
  *out = m;
  return HC_OK;
}

hc_status model_oscillator(double mass, double damping, double stiffness, double force, int n_contacts, model **out)
{
  hc_status st = model_new(1, 1, n_contacts, 1, out);
  if (st != HC_OK) return st;
  model *m = *out;
  *m->mass = mass;
  *m->damping = damping;
  *m->stiffness = stiffness;
  m->loads[0].harmonic = 1;
  *m->loads[0].cosine = force;
  *m->responses = 1;
  return HC_OK;
}

hc_status model_copy(const model *m, model **out) { return model_copy_sized(m, m->n_contacts, m->n_responses, out); }

hc_status model_copy_sized(const model *m, int n_contacts, int n_responses, model **out)
{
  hc_status st = model_new(m->n, m->n_loads, n_contacts, n_responses, out);
  if (st != HC_OK) return st;
  model *copy = *out;
  const size_t vector = (size_t)m->n * sizeof(double), matrix = (size_t)m->n * vector;
  memcpy(copy->mass, m->mass, matrix);
  memcpy(copy->damping, m->damping, matrix);
  memcpy(copy->stiffness, m->stiffness, matrix);
  for (int i = 0; i < m->n_loads; ++i) {
    copy->loads[i].harmonic = m->loads[i].harmonic;
    copy->loads[i].inertial = m->loads[i].inertial;
    memcpy(copy->loads[i].cosine, m->loads[i].cosine, vector);
    memcpy(copy->loads[i].sine, m->loads[i].sine, vector);
  }
  for (int j = 0; j < m->n_contacts && j < n_contacts; ++j) {
    copy->contacts[j].law = m->contacts[j].law;
    copy->contacts[j].pair = m->contacts[j].pair;
    copy->contacts[j].circle = m->contacts[j].circle;
    copy->contacts[j].rest = m->contacts[j].rest;
    memcpy(copy->contacts[j].tangent, m->contacts[j].tangent, vector);
    memcpy(copy->contacts[j].normal, m->contacts[j].normal, vector);
  }
  memcpy(copy->responses, m->responses, (size_t)(m->n_responses < n_responses ? m->n_responses : n_responses) * vector);
  return HC_OK;
}

hc_status model_copy_all_seen(const model *m, model **out)
{
  hc_status st = model_copy_sized(m, m->n_contacts, m->n, out);
  if (st != HC_OK) return st;
  const size_t n = (size_t)m->n;
  memset((*out)->responses, 0, n * n * sizeof(double));
  for (size_t i = 0; i < n; ++i) (*out)->responses[i * n + i] = 1;
  return HC_OK;
}

void model_free(model *m)
{
  if (!m) return;
  free(m->numbers);
  free(m->loads);
  free(m->contacts);
  free(m);
}

int model_whole_contacts(const model *m)
{
  int n = 0;
  for (int j = 0; j < m->n_contacts; ++j) n += !contact_goes_on(m->contacts[j].pair);
  return n;
}

bool model_has_circle(const model *m)
{
  for (int j = 0; j < m->n_contacts; ++j)
    if (m->contacts[j].circle) return true;
  return false;
}

bool model_is_smooth(const model *m)
{
  for (int j = 0; j < m->n_contacts; ++j)
    if (m->contacts[j].law.smooth != CONTACT_KINKED) return true;
  return false;
}

bool model_has_kinks(const model *m)
{
  for (int j = 0; j < m->n_contacts; ++j)
    if (m->contacts[j].law.smooth == CONTACT_KINKED) return true;
  return false;
}

static bool law_is_odd(const contact *c)
{
  bool odd = c->kn == 0 && c->across[0] == 0;
  for (int i = 0; i < CONTACT_POWERS; ++i) odd = odd && (c->power[i] == 0 || (i + CONTACT_LEAST_POWER) % 2);
  return odd;
}

/* True if a = sign b exactly. */
static bool along_one_line(int n, const double *a, double sign, const double *b)
{
  for (int i = 0; i < n; ++i)
    if (!(a[i] == sign * b[i])) return false;
  return true;
}

static bool same_law(const contact *a, const contact *b)
{
  bool same = a->kt == b->kt && a->kn == b->kn && a->mu == b->mu && a->gap == b->gap && a->load == b->load &&
              a->smooth == b->smooth && a->epsilon == b->epsilon;
  for (int i = 0; i < 2; ++i) same = same && a->across[i] == b->across[i];
  for (int i = 0; i < CONTACT_POWERS; ++i) same = same && a->power[i] == b->power[i];
  return same;
}

static bool face_each_other(int n, const model_contact *a, const model_contact *b)
{
  const bool tangents = !contact_rubs(&a->law) || along_one_line(n, a->tangent, 1, b->tangent) ||
                        along_one_line(n, a->tangent, -1, b->tangent);
  return tangents && a->circle == b->circle && same_law(&a->law, &b->law) &&
         along_one_line(n, a->normal, -1, b->normal);
}

bool model_is_symmetric(const model *m)
{
  for (int l = 0; l < m->n_loads; ++l)
    if (m->loads[l].harmonic % 2 == 0) return false;
  for (int j = 0; j < m->n_contacts; ++j) {
    if (m->contacts[j].rest != 0) return false;
    bool symmetric = law_is_odd(&m->contacts[j].law);
    for (int k = 0; k < m->n_contacts && !symmetric; ++k)
      symmetric = k != j && face_each_other(m->n, &m->contacts[j], &m->contacts[k]);
    if (!symmetric) return false;
  }
  return true;
}

contact model_half_law(const contact *whole)
{
  contact half = *whole;
  half.kn /= 2;
  half.load /= 2;
  half.mu *= 2;
  return half;
}

void model_direction(double angle_deg, double *tangent, double *normal)
{
  const double deg = 0.017453292519943295769; /* pi/180 */
  *tangent = fabs(angle_deg) == 90 ? 0.0 : cos(angle_deg * deg);
  *normal = angle_deg == 0 ? 0.0 : sin(angle_deg * deg);
}

bool model_is_oscillator(const model *m)
{
  const bool one = m->n == 1 && m->n_loads == 1 && m->loads[0].harmonic == 1 && *m->loads[0].sine == 0;
  return one && !m->loads[0].inertial && m->n_responses == 1 && *m->responses == 1;
}

double model_force(const model *m) { return *m->loads[0].cosine; }

int model_highest_load(const model *m)
{
  int most = 0;
  for (int l = 0; l < m->n_loads; ++l)
    if (m->loads[l].harmonic > most) most = m->loads[l].harmonic;
  return most;
}

double model_max_stiffness(const model *m)
{
  double k = *m->stiffness;
  for (const model_contact *c = m->contacts; c < m->contacts + m->n_contacts; ++c)
    k += c->law.kt * *c->tangent * *c->tangent + c->law.kn * *c->normal * *c->normal;
  return k;
}
