/* yaml_lists.c - the loads, contacts and responses of a structure, see yaml_structure.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest.h"
#include "base/number.h"
#include "casefile/yaml_structure.h"

static const field *part(const char *section, const char *name) { return field_find(section, name, strlen(name)); }

static bool given(const case_reader *r, const char *section, const char *name)
{
  return case_given(r, part(section, name));
}

/* Is it a list, of which `what` tells? */
static hc_status check_list(case_reader *r, const yaml_node_t *node, const char *what, const char *expected)
{
  if (node->type == YAML_SEQUENCE_NODE) return HC_OK;
  return yaml_refuse(r, node, "%s is %s, expected %s", what, yaml_node_what(node), expected);
}

static hc_status check_mapping(case_reader *r, const yaml_node_t *node, const char *what, int j, const char *expected)
{
  if (node->type == YAML_MAPPING_NODE) return HC_OK;
  return yaml_refuse(r, node, "%s[%d] is %s, expected a mapping such as %s", what, j, yaml_node_what(node), expected);
}

/* `pairs` and `axes` make contacts; of one they say nothing. */
static hc_status not_of_one(case_reader *r, case_place at, const char *name)
{
  return case_refuse(r, at, "%s of a single contact, expected `pairs` and `axes` together in an entry of the list",
                     name);
}

static bool is_of_pairs(const field *f) { return f == part("contacts", "pairs") || f == part("contacts", "axes"); }

hc_status yaml_entry_part(case_reader *r, yaml_document_t *doc, const field *f, int j, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  char path[FIELD_PATH];
  if (is_of_pairs(f)) return not_of_one(r, case_place_of(r, node->start_mark), f->name);
  const void *entry = f->flags & FIELD_IN_LOAD ? (const void *)&s->loads[j] : (const void *)&s->contacts[j];
  return yaml_direction(r, doc, field_path(f, j, path), node, field_direction(f, entry));
}

/* A part given in a mapping, once. */
static hc_status read_part(case_reader *r, yaml_document_t *doc, const field *f, int j, const yaml_node_pair_t *pair)
{
  const yaml_node_t *key = yaml_document_get_node(doc, pair->key), *value = yaml_document_get_node(doc, pair->value);
  if (case_given(r, f)) return yaml_duplicate_key(r, key, r->at[field_index(f)]);
  r->at[field_index(f)] = case_place_of(r, value->start_mark);
  return yaml_entry_part(r, doc, f, j, value);
}

/* ---- loads ---- */

static hc_status read_load_keys(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int j, bool by_node)
{
  structure_load *load = &r->sc.structure->loads[j];
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key);
    if (!yaml_check_key(r, key)) return HC_BAD_INPUT;
    if (by_node && (yaml_node_is(key, "node") || yaml_node_is(key, "direction"))) continue;
    const field *f = field_find("forcing[]", yaml_node_text(key), key->data.scalar.length);
    if (!f) return yaml_unknown_key(r, key, "forcing[]");
    const hc_status st = f->kind == FIELD_PART ? read_part(r, doc, f, j, p) : yaml_scene_field(r, doc, f, j, load, p);
    if (st != HC_OK) return st;
  }
  return HC_OK;
}

/* One place of attack, which goes without saying where there is one DOF. */
static hc_status check_load(case_reader *r, int j, bool by_node)
{
  scene_structure *s = r->sc.structure;
  const int places = by_node + given(r, "forcing[]", "dof") + given(r, "forcing[]", "direction");
  message *m = case_blame(r, s->loads[j].place);
  if (places == 0 && s->n == 1) s->loads[j].direction[0] = 1;
  if (places > 1) message_add(m, "forcing[%d] acts on `dof` and something else, expected one place or `direction`", j);
  else if (places == 0 && s->n > 1)
    message_add(m, "missing key `dof` in `forcing[%d]`, expected a DOF, or `direction`: factors of DOFs", j);
  else if (!given(r, "forcing[]", "amplitude"))
    message_add(m, "missing key `amplitude` in `forcing[%d]`, expected a number", j);
  else message_start(m, m->text, m->size);
  return m->used > 0 ? HC_BAD_INPUT : HC_OK;
}

hc_status yaml_load_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int j)
{
  scene_structure *s = r->sc.structure;
  hc_status st = check_mapping(r, node, "forcing", j, "{dof: 1, amplitude: 100}");
  if (st != HC_OK) return st;
  if (j == s->n_loads && !structure_add_load(s)) return case_out_of_memory(r);
  yaml_forget_fields(r, FIELD_IN_LOAD);
  field_load_defaults(&s->loads[j]);
  memset(s->loads[j].direction, 0, (size_t)s->n * sizeof(double));
  s->loads[j].place = case_place_of(r, node->start_mark);
  const bool by_node = yaml_find(doc, node, "node") != NULL;
  st = read_load_keys(r, doc, node, j, by_node);
  if (st == HC_OK && by_node) st = yaml_direction(r, doc, "forcing", node, s->loads[j].direction);
  return st == HC_OK ? check_load(r, j, by_node) : st;
}

hc_status yaml_loads_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  structure_clear_loads(s);
  if (node->type == YAML_MAPPING_NODE && s->n == 1) return yaml_load_read(r, doc, node, 0);
  hc_status st = check_list(r, node, "forcing", "a list of loads such as [{dof: 1, amplitude: 100}]");
  if (st != HC_OK) return st;
  for (int i = 0; i < yaml_length(node) && st == HC_OK; ++i)
    st = yaml_load_read(r, doc, yaml_entry(doc, node, i), s->n_loads);
  return st;
}

/* ---- contacts ---- */

static hc_status read_contact_keys(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int j)
{
  structure_contact *c = &r->sc.structure->contacts[j];
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key);
    if (!yaml_check_key(r, key)) return HC_BAD_INPUT;
    const field *f = field_find("contacts", yaml_node_text(key), key->data.scalar.length);
    if (!f) return yaml_unknown_key(r, key, "contacts");
    if (is_of_pairs(f)) return not_of_one(r, case_place_of(r, key->start_mark), f->name);
    const hc_status st =
        f->kind == FIELD_PART ? read_part(r, doc, f, j, p) : yaml_scene_field(r, doc, f, j, &c->given, p);
    if (st != HC_OK) return st;
  }
  return HC_OK;
}

static hc_status missing(case_reader *r, int j, const field *f, const char *has)
{
  message *m = case_blame(r, r->sc.structure->contacts[j].place);
  message_add(m, "missing key `%s` in `contacts[%d]`, which has a %s, expected ", f->name, j, has);
  field_expected(f, m);
  return HC_BAD_INPUT;
}

/* What a contact with such a direction must have; what it has without one: case_check. */
static hc_status check_needed(case_reader *r, int j, const char *direction)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (f->along && !strcmp(f->along, direction) && !f->fallback && !case_given(r, f))
      return missing(r, j, f, direction);
  }
  return HC_OK;
}

static hc_status check_contact(case_reader *r, int j)
{
  structure_contact *c = &r->sc.structure->contacts[j];
  const bool tangent = given(r, "contacts", "tangent"), normal = given(r, "contacts", "normal");
  c->by_angle = given(r, "contacts", "angle_deg");
  if (c->by_angle && (tangent || normal || r->sc.structure->n > 1))
    return case_refuse(r, r->at[field_index(part("contacts", "angle_deg"))],
                       "angle_deg in `contacts[%d]`, expected `tangent` and `normal`%s", j,
                       r->sc.structure->n > 1 ? ": an angle is for one DOF" : " or `angle_deg`, not both");
  if (given(r, "contacts", "tangent_2") && !tangent)
    return case_refuse(r, r->at[field_index(part("contacts", "tangent_2"))],
                       "tangent_2 in `contacts[%d]`, which has no tangent, expected `tangent` first", j);
  if (given(r, "contacts", "limit") && !given(r, "contacts", "tangent_2"))
    return case_refuse(r, r->at[field_index(part("contacts", "limit"))],
                       "limit in `contacts[%d]`, which has one tangent, expected it beside `tangent_2` only", j);
  if (!tangent && !normal && !c->by_angle)
    return case_refuse(r, c->place, "contacts[%d] moves nothing, expected `tangent`, `normal` or both", j);
  hc_status st = tangent || c->by_angle ? check_needed(r, j, "tangent") : HC_OK;
  if (st != HC_OK || normal || c->by_angle) return st == HC_OK ? check_needed(r, j, "normal") : st;
  const field *preload = part("contacts", "preload");
  return case_given(r, preload) ? HC_OK : missing(r, j, preload, "tangent but no normal");
}

hc_status yaml_contact_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int j)
{
  scene_structure *s = r->sc.structure;
  hc_status st =
      check_mapping(r, node, "contacts", j, "{tangential_stiffness: 100, friction: 0.3, preload: 5, tangent: 1}");
  if (st != HC_OK) return st;
  if (j == s->n_contacts && !structure_add_contact(s)) return case_out_of_memory(r);
  structure_contact *c = &s->contacts[j];
  yaml_forget_fields(r, FIELD_IN_CONTACT);
  field_contact_defaults(&c->given);
  memset(c->tangent, 0, 3 * (size_t)s->n * sizeof *c->tangent); /* with the others behind it */
  c->place = case_place_of(r, node->start_mark);
  st = read_contact_keys(r, doc, node, j);
  return st == HC_OK ? check_contact(r, j) : st;
}

hc_status yaml_contacts_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  structure_clear_contacts(s);
  hc_status st = check_list(r, node, "contacts", "a list of contacts, or [] for none");
  if (st != HC_OK) return st;
  for (int i = 0; i < yaml_length(node) && st == HC_OK; ++i) {
    const yaml_node_t *entry = yaml_entry(doc, node, i);
    const bool pairs =
        entry->type == YAML_MAPPING_NODE && (yaml_find(doc, entry, "pairs") || yaml_find(doc, entry, "axes"));
    st = pairs ? yaml_pairs_read(r, doc, entry) : yaml_contact_read(r, doc, entry, s->n_contacts);
  }
  return st;
}

/* ---- responses ---- */

hc_status yaml_responses_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  const size_t bytes = (size_t)s->n * sizeof(double);
  structure_clear_responses(s);
  hc_status st = check_list(r, node, "response", part("", "response")->expects);
  if (st != HC_OK) return st;
  if (yaml_length(node) == 0)
    return yaml_refuse(r, node, "response is an empty list, expected %s", part("", "response")->expects);
  for (int i = 0; i < yaml_length(node); ++i) {
    const yaml_node_t *entry = yaml_entry(doc, node, i);
    structure_response *new = structure_add_response(s);
    if (!new) return case_out_of_memory(r);
    new->place = case_place_of(r, entry->start_mark);
    if ((st = yaml_direction(r, doc, "response", entry, new->direction)) != HC_OK) return st;
    for (int k = 0; k < s->n_responses - 1; ++k)
      if (!memcmp(s->responses[k].direction, new->direction, bytes))
        return case_refuse(r, new->place, "response %d is response %d again, expected different ones", s->n_responses,
                           k + 1);
  }
  return HC_OK;
}

static hc_status no_such_dof(case_reader *r, case_place at, const char *text, size_t length)
{
  const scene_structure *s = r->sc.structure;
  const char *near = s->names ? nearest_word((const char *const *)s->names, text, length) : NULL;
  message *m = case_blame(r, at);
  message_add(m, "no DOF ");
  message_add_quoted(m, text, length);
  if (near) message_add(m, ", did you mean `%s`?", near);
  else message_add(m, ", expected a number 1..%d%s", s->n, s->names ? " or one of structure.names" : "");
  return HC_BAD_INPUT;
}

static hc_status named_dof(case_reader *r, const yaml_node_t *node, int *dof)
{
  if (node->type != YAML_SCALAR_NODE)
    return yaml_refuse(r, node,
                       "%s stands where a DOF should, expected its name or "
                       "number",
                       yaml_node_what(node));
  const char *text = yaml_node_text(node);
  const size_t length = node->data.scalar.length;
  *dof = structure_dof(r->sc.structure, text, length);
  return *dof >= 0 ? HC_OK : no_such_dof(r, case_place_of(r, node->start_mark), text, length);
}

static bool is_axis(const yaml_node_t *n)
{
  return n->type == YAML_SCALAR_NODE && n->data.scalar.length == 1 && structure_is_axis(*yaml_node_text(n));
}

/* {node: 17, direction: y}, as far as these two keys are concerned. */
static hc_status node_dof(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int *dof)
{
  const yaml_node_t *number = yaml_find(doc, node, "node"), *axis = yaml_find(doc, node, "direction");
  int id = 0;
  message *m;
  if (number->type != YAML_SCALAR_NODE || !axis || !is_axis(axis) ||
      number_read_integer(yaml_node_text(number), number->data.scalar.length, &id) != NUMBER_FINE)
    return yaml_refuse(r, number,
                       "a node without its number or direction, expected {node: 17, direction: y}, with x, y or z");
  *dof = structure_node_dof(r->sc.structure, id, *yaml_node_text(axis));
  if (*dof >= 0) return HC_OK;
  m = case_blame(r, case_place_of(r, number->start_mark));
  message_add(m, "no DOF of node %d in direction %c, expected one of structure.nodes%s", id, *yaml_node_text(axis),
              r->sc.structure->n_nodes == 0 ? ", which is not given" : "");
  return HC_BAD_INPUT;
}

hc_status yaml_dof(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int *dof)
{
  const bool by_node = node->type == YAML_MAPPING_NODE && yaml_find(doc, node, "node");
  return by_node ? node_dof(r, doc, node, dof) : named_dof(r, node, dof);
}

static hc_status read_factors(case_reader *r, yaml_document_t *doc, const char *what, const yaml_node_t *node,
                              double *direction)
{
  unsigned char *seen = calloc((size_t)r->sc.structure->n, 1);
  hc_status st = HC_OK;
  if (!seen) return case_out_of_memory(r);
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top && st == HC_OK; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key);
    int dof = 0;
    if ((st = named_dof(r, key, &dof)) != HC_OK) break;
    if (seen[dof]++) {
      message *m = case_blame(r, case_place_of(r, key->start_mark));
      message_add(m, "%s gives DOF ", what);
      message_add_quoted(m, yaml_node_text(key), key->data.scalar.length);
      message_add(m, " twice, expected each once");
      st = HC_BAD_INPUT;
      break;
    }
    st = yaml_number(r, yaml_document_get_node(doc, p->value), what, &direction[dof]);
  }
  free(seen);
  return st;
}

hc_status yaml_direction(case_reader *r, yaml_document_t *doc, const char *what, const yaml_node_t *node,
                         double *direction)
{
  const int n = r->sc.structure->n;
  int dof = 0;
  memset(direction, 0, (size_t)n * sizeof *direction);
  if (node->type != YAML_MAPPING_NODE || yaml_find(doc, node, "node")) {
    const hc_status st = yaml_dof(r, doc, node, &dof);
    if (st == HC_OK) direction[dof] = 1;
    return st;
  }
  const hc_status st = read_factors(r, doc, what, node, direction);
  if (st != HC_OK) return st;
  for (int i = 0; i < n; ++i)
    if (direction[i] != 0) return HC_OK;
  return yaml_refuse(r, node, "%s is a direction of zeros, which moves nothing, expected a factor other than 0", what);
}
