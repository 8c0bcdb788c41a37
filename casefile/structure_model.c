/* structure_model.c - see structure_model.h. */
#include "casefile/structure_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"

contact structure_contact_law(const structure_contact *c)
{
  contact law = c->given.law;
  if (c->given.preload > 0 && law.kn > 0) law.gap = c->given.preload / law.kn;
  if (!(law.kn > 0)) law.load = c->given.preload;
  return law;
}

void structure_cosine_sine(double angle_deg, double *cosine, double *sine)
{
  static const double quarter_cosines[] = {1, 0, -1, 0};
  const double angle = remainder(angle_deg, 360); /* exact, -180..180 */
  const int quarter = ((int)rint(angle / 90) + 4) % 4;
  if (angle == 90 * rint(angle / 90)) {
    *cosine = quarter_cosines[quarter];
    *sine = quarter_cosines[(quarter + 3) % 4];
    return;
  }
  *cosine = cos(angle * (PI / 180));
  *sine = sin(angle * (PI / 180));
}

bool structure_contact_is_pair(const scene_structure *s, const structure_contact *c)
{
  for (int i = 0; i < s->n; ++i)
    if (c->tangent_2[i] != 0) return true;
  return false;
}

int structure_model_contact(const scene_structure *s, int j)
{
  int first = j;
  for (int k = 0; k < j; ++k) first += structure_contact_is_pair(s, &s->contacts[k]);
  return first;
}

/* One direction of contact c. */
static void set_contact(const scene_structure *s, const structure_contact *c, const double *tangent, model_contact *to)
{
  const size_t bytes = (size_t)s->n * sizeof *tangent;
  to->law = structure_contact_law(c);
  memcpy(to->tangent, tangent, bytes);
  memcpy(to->normal, c->normal, bytes);
  if (c->by_angle) model_direction(c->given.angle_deg, to->tangent, to->normal);
}

static void set_pair(const scene_structure *s, const structure_contact *c, model_contact to[2])
{
  const contact whole = structure_contact_law(c);
  for (int d = 0; d < 2; ++d) {
    set_contact(s, c, d == 0 ? c->tangent : c->tangent_2, &to[d]);
    to[d].law = model_half_law(&whole);
    to[d].pair = d == 0 ? CONTACT_FIRST : CONTACT_SECOND;
    to[d].circle = c->given.limit == CONTACT_LIMIT_CIRCLE;
  }
}

static void set_contacts(const scene_structure *s, model *m)
{
  model_contact *to = m->contacts;
  for (int j = 0; j < s->n_contacts; ++j) {
    const structure_contact *c = &s->contacts[j];
    if (structure_contact_is_pair(s, c)) set_pair(s, c, to), to += 2;
    else set_contact(s, c, c->tangent, to++);
  }
}

/* The loads of the model: one for every harmonic there is, in ascending order; returns how many. */
static int harmonics(const scene_structure *s, int *harmonic)
{
  int n = 0;
  for (int k = 0; k <= HBM_MAX_HARMONICS; ++k)
    for (int i = 0; i < s->n_loads; ++i)
      if (s->loads[i].harmonic == k && (n == 0 || harmonic[n - 1] != k)) harmonic[n++] = k;
  return n;
}

static void add_load(model_load *to, int n, const structure_load *load)
{
  double cosine, sine;
  structure_cosine_sine(load->phase_deg, &cosine, &sine);
  for (int i = 0; i < n; ++i) {
    to->cosine[i] += load->amplitude * cosine * load->direction[i];
    if (load->harmonic > 0) to->sine[i] -= load->amplitude * sine * load->direction[i];
  }
}

/* The response where the case names none. */
static int forced_dof(const scene_structure *s)
{
  int first = 0, most = 0;
  while (first < s->n_loads && s->loads[first].harmonic == 0) ++first;
  for (int i = 1; i < s->n && first < s->n_loads; ++i)
    if (fabs(s->loads[first].direction[i]) > fabs(s->loads[first].direction[most])) most = i;
  return most;
}

static void set_responses(const scene_structure *s, model *m)
{
  const size_t n = (size_t)s->n;
  for (int i = 0; i < s->n_responses; ++i)
    memcpy(m->responses + n * (size_t)i, s->responses[i].direction, n * sizeof(double));
  if (s->n_responses == 0) m->responses[forced_dof(s)] = 1;
}

int structure_response_count(const scene_structure *s) { return s->n_responses > 0 ? s->n_responses : 1; }

const char *structure_response_name(const scene_structure *s, int r, char *text, size_t size)
{
  char name[STRUCTURE_WORD];
  if (s->n_responses > 0) return structure_direction_name(s, s->responses[r].direction, text, size);
  snprintf(text, size, "%s", structure_dof_name(s, forced_dof(s), name));
  return text;
}

hc_status structure_model(const scene_structure *s, model **out)
{
  int harmonic[HBM_MAX_HARMONICS + 1];
  const int n_loads = harmonics(s, harmonic);
  const size_t square = (size_t)s->n * (size_t)s->n * sizeof(double);
  const int n_contacts = structure_model_contact(s, s->n_contacts);
  hc_status st = model_new(s->n, n_loads, n_contacts, structure_response_count(s), out);
  if (st != HC_OK) return st;
  model *m = *out;
  memcpy(m->mass, s->mass.v, square);
  memcpy(m->damping, s->damping.v, square);
  memcpy(m->stiffness, s->stiffness.v, square);
  for (int l = 0; l < n_loads; ++l) {
    m->loads[l].harmonic = harmonic[l];
    for (int i = 0; i < s->n_loads; ++i)
      if (s->loads[i].harmonic == harmonic[l]) add_load(&m->loads[l], s->n, &s->loads[i]);
  }
  set_contacts(s, m);
  set_responses(s, m);
  return HC_OK;
}
