/* certificate.c - see certificate.h. Proof: tests/prove/test_certificate.c. */
#include "proof/prove/certificate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/casefile/structure.h"
#include "numerics/base/message.h"
#include "numerics/base/number.h"
#include "numerics/norm.h"

static json_t *decimal(double value) { return json_string(number_write(value, (char[NUMBER_TEXT]){0})); }

/* v[n], entries `step` apart. */
static json_t *times_vector(double by, int n, const double *v, int step)
{
  json_t *list = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(list, decimal(by * v[(size_t)i * (size_t)step]));
  return list;
}

static json_t *vector(int n, const double *v, int step) { return times_vector(1, n, v, step); }

static json_t *matrix(int n, const double *A)
{
  json_t *rows = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(rows, vector(n, A + i, n));
  return rows;
}

static json_t *forcing(const model *m, double omega)
{
  json_t *loads = json_array();
  for (int l = 0; l < m->n_loads; ++l) {
    const double by = model_load_factor(m->loads[l].inertial, omega);
    json_array_append_new(loads, json_pack("{s:i,s:o,s:o}", "harmonic", m->loads[l].harmonic, "cos",
                                           times_vector(by, m->n, m->loads[l].cosine, 1), "sin",
                                           times_vector(by, m->n, m->loads[l].sine, 1)));
  }
  return loads;
}

/* The angle [deg] of contact j of the case, if its directions are given by an angle whose cosine and sine are no
 * decimals; else 0. */
static double inclined(const scene *sc, int j)
{
  if (!sc->structure->contacts[j].by_angle) return 0;
  const double angle = scene_contact_at(sc, j)->angle_deg;
  return fabs(angle) < 90 ? angle : 0;
}

/* The contact as JSON; NULL: it exerts no varying force. */
static json_t *contact_of(const model *m, const model_contact *c, double angle, bool *friction)
{
  const contact *law = &c->law;
  const bool closes = law->kn > 0 && !is_zero(m->n, c->normal);
  const double load = closes ? NAN : law->load + law->kn * fmax(law->gap, 0); /* N if it is constant, else NaN */
  *friction = contact_has_friction(law) && !is_zero(m->n, c->tangent) && (closes || load > 0);
  if (!closes && !*friction) return NULL;
  json_t *to = json_object();
  if (angle != 0) {
    json_object_set_new(to, "direction", json_pack("[s]", "1"));
    json_object_set_new(to, "angle_deg", decimal(angle));
  } else {
    if (*friction) json_object_set_new(to, "tangent", vector(m->n, c->tangent, 1));
    if (closes) json_object_set_new(to, "normal", vector(m->n, c->normal, 1));
  }
  if (*friction || angle != 0) {
    json_object_set_new(to, "tangential_stiffness", decimal(law->kt));
    json_object_set_new(to, "friction", decimal(law->mu));
  }
  if (!closes) json_object_set_new(to, "preload", decimal(load));
  else {
    json_object_set_new(to, "normal_stiffness", decimal(law->kn));
    json_object_set_new(to, "gap", decimal(law->gap));
  }
  return to;
}

hc_status certificate_model_make(const scene *sc, const model *m, int r, certificate_model *out)
{
  const size_t most = (size_t)m->n_contacts + 1;
  json_t *contacts = json_array();
  *out = (certificate_model){.of = m, .contact = calloc(most, sizeof(int)), .friction = calloc(most, sizeof(bool))};
  for (int j = 0, of_case = 0; j < m->n_contacts && out->contact && out->friction; ++j) {
    json_t *one = contact_of(m, &m->contacts[j], inclined(sc, of_case), &out->friction[out->n_contacts]);
    if (one && !json_array_append_new(contacts, one)) out->contact[out->n_contacts++] = j;
    of_case += !contact_goes_on(m->contacts[j + 1].pair); /* model_new allocates one more, empty entry */
  }
  out->response = vector(m->n, m->responses + (size_t)r * (size_t)m->n, 1);
  out->model = json_pack("{s:o,s:o,s:o,s:o,s:o}", "mass", matrix(m->n, m->mass), "damping", matrix(m->n, m->damping),
                         "stiffness", matrix(m->n, m->stiffness), "forcing", json_null(), "contacts", contacts);
  return out->model && out->response && out->contact && out->friction ? HC_OK : HC_NO_MEMORY;
}

void certificate_model_free(certificate_model *c)
{
  json_decref(c->model);
  json_decref(c->response);
  free(c->contact);
  free(c->friction);
  *c = (certificate_model){0};
}

static char letter(bool friction, contact_state state)
{
  static const char letters[] = {
      [CONTACT_SEPARATED] = 'O', [CONTACT_STICK] = 'S', [CONTACT_SLIP_PLUS] = '+', [CONTACT_SLIP_MINUS] = '-'};
  return state != CONTACT_SEPARATED && !friction ? 'N' : letters[state];
}

static json_t *event(const certificate_model *c, const orbit_events *e, int i)
{
  char *letters = calloc((size_t)c->n_contacts + 1, 1);
  for (int j = 0; letters && j < c->n_contacts; ++j)
    letters[j] = letter(c->friction[j], e->states[(size_t)i * (size_t)e->n_contacts + (size_t)c->contact[j]]);
  json_t *to = letters ? json_pack("{s:o,s:o,s:o,s:s}", "t", decimal(e->t[i]), "x",
                                   vector(e->n_dof, e->x + (size_t)i * (size_t)e->n_dof, 1), "v",
                                   vector(e->n_dof, e->v + (size_t)i * (size_t)e->n_dof, 1), "state", letters)
                       : NULL;
  free(letters);
  return to;
}

/* The model with its loads at omega, a new reference. */
static json_t *model_at(const certificate_model *c, double omega)
{
  json_t *own = json_copy(c->model);
  json_object_set_new(own, "forcing", forcing(c->of, omega));
  return own;
}

json_t *certificate_of(const certificate_model *c, double omega, int k, double amplitude, const orbit_events *e)
{
  const int n = e->n * e->n_dof;
  json_t *events = json_array(), *rest = json_object();
  for (int j = 0; j < c->n_contacts; ++j) {
    char number[NUMBER_TEXT];
    const double w = e->rest[c->contact[j]];
    if (c->friction[j] && !isnan(w)) json_object_set_new(rest, number_write(j, number), decimal(w));
  }
  for (int i = 0; i < e->n; ++i) json_array_append_new(events, event(c, e, i));
  if (e->n == 1) json_object_set_new(json_array_get(events, 0), "section", json_integer(1));
  double x = fmax(norm_max(n, e->x), amplitude), v = fmax(norm_max(n, e->v), omega * amplitude);
  if (!(x > 0)) x = v = 1; /* nothing moves */
  json_t *scales = json_pack("{s:o,s:o,s:o}", "x", decimal(x), "v", decimal(v), "t", decimal(1 / omega));
  return json_pack("{s:o,s:o,s:i,s:i,s:O,s:o,s:o,s:o}", "model", model_at(c, omega), "omega", decimal(omega),
                   "multiple", k, "precision_bits", 128, "response", c->response, "rest", rest, "scales", scales,
                   "events", events);
}

bool certificate_is_of(const json_t *certificate, const certificate_model *c, double omega, int k)
{
  char text[NUMBER_TEXT];
  const char *own = json_string_value(json_object_get(certificate, "omega"));
  json_t *own_model = model_at(c, omega);
  const bool same = json_equal(json_object_get(certificate, "model"), own_model);
  json_decref(own_model);
  return same && own && !strcmp(own, number_write(omega, text)) &&
         json_equal(json_object_get(certificate, "response"), c->response) &&
         json_integer_value(json_object_get(certificate, "multiple")) == k;
}

void certificate_letters(const json_t *certificate, char *text, size_t size)
{
  size_t i;
  json_t *at;
  message m;
  message_start(&m, text, size);
  json_array_foreach(json_object_get(certificate, "events"), i, at)
  {
    const char *letters = json_string_value(json_object_get(at, "state"));
    message_add(&m, "%s%s", i ? " " : "", letters ? letters : "?");
  }
}

double certificate_bound(const json_t *claims, const char *name, int i, int towards)
{
  const json_t *at = json_object_get(claims, name);
  const char *text = json_string_value(i < 0 ? at : json_array_get(at, (size_t)i));
  double value;
  if (!text || number_read(text, strlen(text), &value) != NUMBER_FINE) return NAN;
  return towards < 0 ? nextafter(value, -INFINITY) : towards > 0 ? nextafter(value, INFINITY) : value;
}
