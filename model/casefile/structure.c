/* structure.c - see structure.h. */
#include "model/casefile/structure.h"

#include <stdio.h>
#include <string.h>

#include "hbm/hbm_settings.h"
#include "numerics/base/constants.h"
#include "numerics/base/growing.h"
#include "numerics/base/message.h"
#include "numerics/base/number.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

scene_structure *structure_new(void) { return calloc(1, sizeof(scene_structure)); }

scene_structure *structure_new_oscillator(double mass, double damping, double stiffness, double force)
{
  scene_structure *s = structure_new();
  if (!s) return NULL;
  s->n = 1;
  s->is_oscillator = true;
  const double numbers[] = {mass, damping, stiffness};
  structure_matrix *const matrices[] = {&s->mass, &s->damping, &s->stiffness};
  structure_load *load = structure_add_load(s);
  for (int i = 0; load && i < 3; ++i) {
    if ((matrices[i]->v = malloc(sizeof *numbers))) *matrices[i]->v = numbers[i];
    else load = NULL;
  }
  if (!load) return structure_free(s), NULL;
  *load->direction = 1;
  load->amplitude = force;
  load->harmonic = 1;
  return s;
}

void structure_free_matrix(structure_matrix *m)
{
  free(m->v);
  sparse_free(&m->kept);
  free(m->file);
  free(m->labels);
}

/* Free a list of *n entries, each of which begins with a pointer to memory of its own. Returns NULL. */
static void *cleared(void *list, size_t size, int *n)
{
  for (int i = 0; list && i < *n; ++i) free(*(double **)(void *)((char *)list + size * (size_t)i));
  free(list);
  *n = 0;
  return NULL;
}

void structure_clear_loads(scene_structure *s) { s->loads = cleared(s->loads, sizeof *s->loads, &s->n_loads); }

void structure_clear_contacts(scene_structure *s)
{
  s->contacts = cleared(s->contacts, sizeof *s->contacts, &s->n_contacts);
  free(s->notes);
  s->notes = NULL;
}

hc_status structure_note(scene_structure *s, const char *line)
{
  const size_t used = s->notes ? strlen(s->notes) : 0, more = strlen(line);
  char *longer = realloc(s->notes, used + more + 2);
  if (!longer) return HC_NO_MEMORY;
  snprintf(longer + used, more + 2, "%s\n", line);
  s->notes = longer;
  return HC_OK;
}

void structure_clear_responses(scene_structure *s)
{
  s->responses = cleared(s->responses, sizeof *s->responses, &s->n_responses);
}

void structure_free(scene_structure *s)
{
  if (!s) return;
  structure_free_matrix(&s->mass);
  structure_free_matrix(&s->stiffness);
  structure_free_matrix(&s->damping);
  free(s->ratios);
  for (int i = 0; s->names && i < s->n; ++i) free(s->names[i]);
  free(s->names);
  free(s->nodes);
  free(s->mesh);
  free(s->base);
  structure_clear_loads(s);
  structure_clear_contacts(s);
  structure_clear_responses(s);
  free(s);
}

/* ---- lists that grow ---- */

/* The list with one more entry of zeros but for its pointer to vector[length]; NULL: no memory, nothing changed. */
static void *with_entry(void *list, size_t size, int n, size_t length)
{
  double *vector = calloc(length, sizeof *vector);
  char *longer = vector ? growing(list, n, size) : NULL;
  if (!longer) return free(vector), NULL;
  char *entry = memset(longer + size * (size_t)n, 0, size);
  *(double **)(void *)entry = vector;
  return longer;
}

structure_load *structure_add_load(scene_structure *s)
{
  structure_load *list = with_entry(s->loads, sizeof *list, s->n_loads, (size_t)s->n);
  return list ? &(s->loads = list)[s->n_loads++] : NULL;
}

structure_response *structure_add_response(scene_structure *s)
{
  structure_response *list = with_entry(s->responses, sizeof *list, s->n_responses, (size_t)s->n);
  return list ? &(s->responses = list)[s->n_responses++] : NULL;
}

structure_contact *structure_add_contact(scene_structure *s)
{
  structure_contact *list = with_entry(s->contacts, sizeof *list, s->n_contacts, 3 * (size_t)s->n);
  if (!list) return NULL;
  structure_contact *c = &(s->contacts = list)[s->n_contacts++];
  c->tangent_2 = c->tangent + s->n, c->normal = c->tangent_2 + s->n;
  c->by_angle = s->is_oscillator;
  return c;
}

void structure_drop_contact(scene_structure *s, int j)
{
  free(s->contacts[j].tangent); /* with the others behind it */
  --s->n_contacts;
  memmove(s->contacts + j, s->contacts + j + 1, (size_t)(s->n_contacts - j) * sizeof *s->contacts);
}

void structure_keep_response(scene_structure *s, int r)
{
  if (s->n_responses == 0) return;
  for (int i = 0; i < s->n_responses; ++i)
    if (i != r) free(s->responses[i].direction);
  s->responses[0] = s->responses[r];
  s->n_responses = 1;
}

/* ---- copies ---- */

/* A copy of from[bytes]; NULL where there is nothing, or, with *failed, no memory. */
static void *copied(const void *from, size_t bytes, bool *failed)
{
  if (!from) return NULL;
  void *to = malloc(bytes);
  if (to) memcpy(to, from, bytes);
  else *failed = true;
  return to;
}

static structure_matrix copied_matrix(const structure_matrix *from, size_t n, bool *failed)
{
  structure_matrix to = *from;
  to.kept = (sparse){0};
  to.v = copied(from->v, n * n * sizeof *to.v, failed);
  to.file = copied(from->file, from->file ? strlen(from->file) + 1 : 0, failed);
  to.labels = copied(from->labels, n * sizeof *to.labels, failed);
  return to;
}

/* The same of a list whose entries each begin with a pointer to bytes of their own. */
static void *copied_list(const void *from, size_t size, int n, size_t bytes, bool *failed)
{
  char *list = n > 0 ? growing_by(NULL, 0, n, size) : NULL;
  *failed |= n > 0 && !list;
  if (list) memcpy(list, from, size * (size_t)n);
  for (char *entry = list; list && entry < list + size * (size_t)n; entry += size) {
    void *own;
    memcpy(&own, entry, sizeof own);
    own = copied(own, bytes, failed);
    memcpy(entry, &own, sizeof own);
  }
  return list;
}

scene_structure *structure_copy(const scene_structure *s)
{
  scene_structure *to = structure_new();
  const size_t n = (size_t)s->n, vector = n * sizeof(double);
  bool failed = false;
  if (!to) return NULL;
  *to = *s;
  to->names = NULL;
  to->base = copied(s->base, vector, &failed);
  to->mesh = copied(s->mesh, s->mesh ? strlen(s->mesh) + 1 : 0, &failed);
  to->notes = copied(s->notes, s->notes ? strlen(s->notes) + 1 : 0, &failed);
  to->loads = copied_list(s->loads, sizeof *to->loads, s->n_loads, vector, &failed);
  to->contacts = copied_list(s->contacts, sizeof *to->contacts, s->n_contacts, 3 * vector, &failed);
  to->responses = copied_list(s->responses, sizeof *to->responses, s->n_responses, vector, &failed);
  for (int j = 0; to->contacts && j < s->n_contacts && to->contacts[j].tangent; ++j) {
    structure_contact *c = &to->contacts[j]; /* of what has lost degrees of freedom its vectors stand apart */
    c->tangent_2 = memcpy(c->tangent + n, s->contacts[j].tangent_2, vector);
    c->normal = memcpy(c->tangent_2 + n, s->contacts[j].normal, vector);
  }
  to->mass = copied_matrix(&s->mass, n, &failed);
  to->stiffness = copied_matrix(&s->stiffness, n, &failed);
  to->damping = copied_matrix(&s->damping, n, &failed);
  to->ratios = copied(s->ratios, n * sizeof *to->ratios, &failed);
  to->nodes = copied(s->nodes, (size_t)s->n_nodes * sizeof *to->nodes, &failed);
  if (s->names) failed |= !(to->names = calloc(n + 1, sizeof *to->names));
  for (int i = 0; to->names && i < s->n; ++i) to->names[i] = copied(s->names[i], strlen(s->names[i]) + 1, &failed);
  if (!failed) return to;
  structure_free(to);
  return NULL;
}

/* ---- degrees of freedom ---- */

int structure_dof(const scene_structure *s, const char *text, size_t length)
{
  int number;
  for (int i = 0; s->names && i < s->n; ++i)
    if (strlen(s->names[i]) == length && !memcmp(s->names[i], text, length)) return i;
  const bool counted = number_read_integer(text, length, &number) == NUMBER_FINE;
  return counted && number >= 1 && number <= s->n ? number - 1 : -1;
}

/* The first of the nodes that is not before this one. */
static int node_place(const scene_structure *s, int node, char direction)
{
  int low = 0, high = s->n_nodes;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    const structure_node *is = &s->nodes[middle];
    if (is->node < node || (is->node == node && is->direction < direction)) low = middle + 1;
    else high = middle;
  }
  return low;
}

int structure_node_dof(const scene_structure *s, int node, char direction)
{
  const int i = node_place(s, node, direction);
  const bool found = i < s->n_nodes && s->nodes[i].node == node && s->nodes[i].direction == direction;
  return found ? s->nodes[i].dof : -1;
}

hc_status nodes_add(scene_structure *s, int dof, int node, char direction)
{
  if (!GROW(s->nodes, s->n_nodes)) return HC_NO_MEMORY;
  structure_node *at = s->nodes + node_place(s, node, direction);
  memmove(at + 1, at, (size_t)(s->nodes + s->n_nodes++ - at) * sizeof *at);
  *at = (structure_node){.dof = dof, .node = node, .direction = direction};
  return HC_OK;
}

const structure_node *structure_node_of(const scene_structure *s, int dof)
{
  for (int i = 0; i < s->n_nodes; ++i)
    if (s->nodes[i].dof == dof) return &s->nodes[i];
  return NULL;
}

int structure_contact_named(const scene_structure *s, const char *name, size_t length)
{
  for (int j = 0; j < s->n_contacts && length > 0; ++j) {
    const char *own = s->contacts[j].given.name;
    if (strlen(own) == length && !memcmp(own, name, length)) return j;
  }
  return -1;
}

const char *structure_dof_name(const scene_structure *s, int dof, char text[STRUCTURE_WORD])
{
  if (s->names) snprintf(text, STRUCTURE_WORD, "%s", s->names[dof]);
  else snprintf(text, STRUCTURE_WORD, "%d", dof + 1);
  return text;
}

const char *structure_direction_name(const scene_structure *s, const double *direction, char *text, size_t size)
{
  char word[STRUCTURE_WORD], number[NUMBER_TEXT];
  message m;
  message_start(&m, text, size);
  for (int i = 0; i < s->n; ++i) {
    if (direction[i] == 0) continue;
    message_add(&m, "%s", direction[i] < 0 ? "-" : m.used > 0 ? "+" : "");
    if (fabs(direction[i]) != 1) message_add(&m, "%s*", number_write(fabs(direction[i]), number));
    message_add(&m, "%s", structure_dof_name(s, i, word));
  }
  return text;
}

/* ---- the model ---- */

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

/* Has the contact two tangents? In the model it is two contacts then (contact_pair, model.h). */
static bool is_pair(const scene_structure *s, const structure_contact *c) { return !is_zero(s->n, c->tangent_2); }

int structure_model_contact(const scene_structure *s, int j)
{
  int first = j;
  for (int k = 0; k < j; ++k) first += is_pair(s, &s->contacts[k]) + scene_contact_parts(&s->contacts[k].given) - 1;
  return first;
}

/* One direction of contact c. */
static void set_contact(const scene_structure *s, const structure_contact *c, const double *tangent, model_contact *to)
{
  const size_t bytes = (size_t)s->n * sizeof *tangent;
  to->law = scene_contact_law(&c->given);
  memcpy(to->tangent, tangent, bytes);
  memcpy(to->normal, c->normal, bytes);
  to->rest = c->given.rest[0];
  if (!c->by_angle) return;
  const moving_contact one = scene_moving_contact(&c->given);
  *to->tangent = *one.cu, *to->normal = *one.cv;
}

static void set_pair(const scene_structure *s, const structure_contact *c, model_contact to[2])
{
  const contact whole = scene_contact_law(&c->given);
  for (int d = 0; d < 2; ++d) {
    set_contact(s, c, d == 0 ? c->tangent : c->tangent_2, &to[d]);
    to[d].law = model_half_law(&whole);
    to[d].rest = c->given.rest[d];
    to[d].pair = d == 0 ? CONTACT_FIRST : CONTACT_SECOND;
    to[d].circle = c->given.limit == CONTACT_LIMIT_CIRCLE;
  }
}

/* The loads of the model: one for every harmonic there is, in ascending order; returns how many. Beside a base that
 * moves an oscillator's own load is 0, and none. */
static int harmonics(const scene_structure *s, int *harmonic)
{
  int n = 0;
  const int n_loads = s->is_oscillator && s->base ? 0 : s->n_loads;
  for (int k = 0; k <= HBM_MAX_HARMONICS; ++k)
    for (int i = 0; i < n_loads; ++i)
      if (s->loads[i].harmonic == k && (n == 0 || harmonic[n - 1] != k)) harmonic[n++] = k;
  return n;
}

/* The load whose place is the response where the case names none; n_loads: there is none. */
static int first_load(const scene_structure *s)
{
  int first = 0;
  while (first < s->n_loads && s->loads[first].harmonic == 0) ++first;
  return first;
}

static int forced_dof(const scene_structure *s)
{
  const int first = first_load(s);
  int most = 0;
  for (int i = 1; i < s->n && first < s->n_loads; ++i)
    if (fabs(s->loads[first].direction[i]) > fabs(s->loads[first].direction[most])) most = i;
  return most;
}

int structure_response_count(const scene_structure *s) { return s->n_responses > 0 ? s->n_responses : 1; }

const char *structure_response_name(const scene_structure *s, int r, char *text, size_t size)
{
  char name[STRUCTURE_WORD];
  int dof = 0;
  if (s->is_oscillator) return snprintf(text, size, "x"), text;
  if (s->n_responses > 0 && !s->responses[r].by_node)
    return structure_direction_name(s, s->responses[r].direction, text, size);
  if (s->n_responses == 0) dof = forced_dof(s);
  else
    while (s->responses[r].direction[dof] == 0) ++dof;
  const int load = first_load(s);
  const bool by_node = s->n_responses > 0 || (load < s->n_loads && s->loads[load].by_node);
  const structure_node *node = by_node ? structure_node_of(s, dof) : NULL;
  if (node) snprintf(text, size, "%d %c", node->node, node->direction);
  else snprintf(text, size, "%s", structure_dof_name(s, dof, name));
  return text;
}

bool structure_unsymmetric(int n, const double *A, int *row, int *column)
{
  const double tolerance = STRUCTURE_SYMMETRY;
  const size_t ld = (size_t)n;
  for (size_t j = 0; j < ld; ++j)
    for (size_t i = j + 1; i < ld; ++i) {
      const double both = sqrt(fabs(A[i * (ld + 1)])) * sqrt(fabs(A[j * (ld + 1)]));
      if (fabs(A[i + ld * j] - A[j + ld * i]) <= tolerance * both) continue;
      *row = (int)i, *column = (int)j;
      return true;
    }
  return false;
}

/* A matrix, or its symmetric part where no more than the rounding of a reduction is between the two: the methods for
 * symmetric structures (modes of their own, exact to rounding and faster) ask for equal halves. */
static void put_matrix(int n, const double *given, double *to)
{
  const size_t ld = (size_t)n;
  int row, column;
  memcpy(to, given, ld * ld * sizeof *to);
  if (structure_unsymmetric(n, given, &row, &column)) return;
  for (size_t j = 0; j < ld; ++j)
    for (size_t i = 0; i < ld; ++i) to[i + ld * j] = 0.5 * given[i + ld * j] + 0.5 * given[j + ld * i];
}

hc_status structure_model(const scene_structure *s, model **out)
{
  int harmonic[HBM_MAX_HARMONICS + 1];
  const int n_loads = harmonics(s, harmonic), n_contacts = structure_model_contact(s, s->n_contacts);
  const size_t n = (size_t)s->n, vector = n * sizeof(double);
  hc_status st = model_new(s->n, n_loads + (s->base != NULL), n_contacts, structure_response_count(s), out);
  if (st != HC_OK) return st;
  model *m = *out;
  put_matrix(s->n, s->mass.v, m->mass);
  put_matrix(s->n, s->damping.v, m->damping);
  put_matrix(s->n, s->stiffness.v, m->stiffness);
  for (int l = 0; l < n_loads; ++l) {
    model_load *to = &m->loads[l];
    to->harmonic = harmonic[l];
    for (int k = 0; k < s->n_loads; ++k) {
      const structure_load *load = &s->loads[k];
      double cosine, sine;
      structure_cosine_sine(load->phase_deg, &cosine, &sine);
      for (int i = 0; i < s->n && load->harmonic == to->harmonic; ++i) {
        to->cosine[i] += load->amplitude * cosine * load->direction[i];
        if (load->harmonic > 0) to->sine[i] -= load->amplitude * sine * load->direction[i];
      }
    }
  }
  if (s->base) {
    m->loads[n_loads].harmonic = 1;
    dense_multiply(s->n, 1, s->n, m->mass, s->base, m->loads[n_loads].cosine);
  }
  model_contact *to = m->contacts;
  for (int j = 0; j < s->n_contacts; ++j) {
    const structure_contact *c = &s->contacts[j];
    static const double along[1] = {1};
    const double *across = c->by_angle ? along : c->normal; /* by_angle: n = 1 */
    add_outer(c->by_angle ? 1 : s->n, scene_contact_slope(&c->given), across, across, m->stiffness);
    if (scene_contact_is_composed(&c->given))
      scene_contact_put(&c->given, s->n, across, to), to += scene_contact_parts(&c->given);
    else if (is_pair(s, c)) set_pair(s, c, to), to += 2;
    else set_contact(s, c, c->tangent, to++);
  }
  for (int i = 0; i < s->n_responses; ++i) memcpy(m->responses + n * (size_t)i, s->responses[i].direction, vector);
  if (s->n_responses == 0) m->responses[forced_dof(s)] = 1;
  return HC_OK;
}
