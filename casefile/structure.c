/* structure.c - see structure.h. */
#include "casefile/structure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/number.h"

scene_structure *structure_new(void) { return calloc(1, sizeof(scene_structure)); }

void structure_free_matrix(structure_matrix *m)
{
  free(m->v);
  free(m->file);
  free(m->labels);
}

void structure_clear_loads(scene_structure *s)
{
  for (int i = 0; i < s->n_loads; ++i) free(s->loads[i].direction);
  free(s->loads);
  s->loads = NULL;
  s->n_loads = 0;
}

void structure_clear_contacts(scene_structure *s)
{
  for (int j = 0; j < s->n_contacts; ++j) free(s->contacts[j].tangent); /* with the others behind it */
  free(s->contacts);
  s->contacts = NULL;
  s->n_contacts = 0;
}

void structure_clear_responses(scene_structure *s)
{
  for (int i = 0; i < s->n_responses; ++i) free(s->responses[i].direction);
  free(s->responses);
  s->responses = NULL;
  s->n_responses = 0;
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
  structure_clear_loads(s);
  structure_clear_contacts(s);
  structure_clear_responses(s);
  free(s);
}

/* ---- lists that grow ---- */

/* Room for one more entry than the `count` there are; they double in size at powers of two. NULL: out of memory, and
 * the list is as it was. */
static void *with_room(void *list, int count, size_t size)
{
  if (count & (count - 1)) return list; /* not at a power of two, so there is room */
  return realloc(list, size * (count > 0 ? 2 * (size_t)count : 1));
}

structure_load *structure_add_load(scene_structure *s)
{
  double *direction = calloc((size_t)s->n, sizeof *direction);
  structure_load *grown = direction ? with_room(s->loads, s->n_loads, sizeof *grown) : NULL;
  if (!grown) {
    free(direction);
    return NULL;
  }
  s->loads = grown;
  grown[s->n_loads] = (structure_load){.direction = direction};
  return &grown[s->n_loads++];
}

void structure_keep_response(scene_structure *s, int r)
{
  if (s->n_responses == 0) return;
  for (int i = 0; i < s->n_responses; ++i)
    if (i != r) free(s->responses[i].direction);
  s->responses[0] = s->responses[r];
  s->n_responses = 1;
}

structure_response *structure_add_response(scene_structure *s)
{
  double *direction = calloc((size_t)s->n, sizeof *direction);
  structure_response *grown = direction ? with_room(s->responses, s->n_responses, sizeof *grown) : NULL;
  if (!grown) {
    free(direction);
    return NULL;
  }
  s->responses = grown;
  grown[s->n_responses] = (structure_response){.direction = direction};
  return &grown[s->n_responses++];
}

structure_contact *structure_add_contact(scene_structure *s)
{
  const size_t n = (size_t)s->n;
  double *directions = calloc(3 * n, sizeof *directions);
  structure_contact *grown = directions ? with_room(s->contacts, s->n_contacts, sizeof *grown) : NULL;
  if (!grown) {
    free(directions);
    return NULL;
  }
  s->contacts = grown;
  grown[s->n_contacts] = (structure_contact){
      .tangent = directions, .tangent_2 = directions + n, .normal = directions + 2 * n, .place = {0}};
  return &grown[s->n_contacts++];
}

/* ---- copies ---- */

static bool copy_numbers(double **to, const double *from, size_t count)
{
  *to = NULL;
  if (!from) return true;
  if (!(*to = malloc(count * sizeof **to))) return false;
  memcpy(*to, from, count * sizeof **to);
  return true;
}

static bool copy_text(char **to, const char *from)
{
  *to = NULL;
  if (!from) return true;
  return (*to = strdup(from)) != NULL;
}

static bool copy_labels(matrix_label **to, const matrix_label *from, size_t count)
{
  *to = NULL;
  if (!from) return true;
  if (!(*to = malloc(count * sizeof **to))) return false;
  memcpy(*to, from, count * sizeof **to);
  return true;
}

static bool copy_matrix(structure_matrix *to, const structure_matrix *from, size_t n)
{
  to->place = from->place;
  to->part = from->part;
  return copy_numbers(&to->v, from->v, n * n) && copy_text(&to->file, from->file) &&
         copy_labels(&to->labels, from->labels, n);
}

static bool copy_names(scene_structure *to, const scene_structure *from)
{
  if (!from->names) return true;
  if (!(to->names = calloc((size_t)from->n + 1, sizeof *to->names))) return false;
  for (int i = 0; i < from->n; ++i)
    if (!copy_text(&to->names[i], from->names[i])) return false;
  return true;
}

static bool copy_nodes(scene_structure *to, const scene_structure *from)
{
  if (from->n_nodes == 0) return true;
  if (!(to->nodes = malloc((size_t)from->n_nodes * sizeof *to->nodes))) return false;
  memcpy(to->nodes, from->nodes, (size_t)from->n_nodes * sizeof *to->nodes);
  to->n_nodes = from->n_nodes;
  return true;
}

static bool copy_lists(scene_structure *to, const scene_structure *from)
{
  const size_t bytes = (size_t)from->n * sizeof(double);
  for (int i = 0; i < from->n_loads; ++i) {
    structure_load *load = structure_add_load(to);
    if (!load) return false;
    double *own = memcpy(load->direction, from->loads[i].direction, bytes);
    *load = from->loads[i];
    load->direction = own;
  }
  for (int j = 0; j < from->n_contacts; ++j) {
    structure_contact *c = structure_add_contact(to);
    if (!c) return false;
    const structure_contact own = *c;
    *c = from->contacts[j];
    c->tangent = memcpy(own.tangent, c->tangent, bytes);
    c->tangent_2 = memcpy(own.tangent_2, c->tangent_2, bytes);
    c->normal = memcpy(own.normal, c->normal, bytes);
  }
  for (int i = 0; i < from->n_responses; ++i) {
    structure_response *r = structure_add_response(to);
    if (!r) return false;
    memcpy(r->direction, from->responses[i].direction, bytes);
    r->place = from->responses[i].place;
  }
  return true;
}

scene_structure *structure_copy(const scene_structure *s)
{
  scene_structure *to = structure_new();
  const size_t n = (size_t)s->n;
  if (!to) return NULL;
  to->n = s->n;
  to->how = s->how;
  memcpy(to->rayleigh, s->rayleigh, sizeof to->rayleigh);
  to->modal = s->modal;
  to->place = s->place;
  if (copy_matrix(&to->mass, &s->mass, n) && copy_matrix(&to->stiffness, &s->stiffness, n) &&
      copy_matrix(&to->damping, &s->damping, n) && copy_numbers(&to->ratios, s->ratios, n) && copy_names(to, s) &&
      copy_nodes(to, s) && copy_lists(to, s))
    return to;
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

int structure_node_dof(const scene_structure *s, int node, char direction)
{
  for (int i = 0; i < s->n_nodes; ++i)
    if (s->nodes[i].node == node && s->nodes[i].direction == direction) return s->nodes[i].dof;
  return -1;
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
