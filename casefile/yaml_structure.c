/* yaml_structure.c - the section `structure` and its parts, see yaml_structure.h. */
#include "casefile/yaml_structure.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/utf8.h"
#include "casefile/matrices/text_file.h"
#include "casefile/nodes_file.h"
#include "casefile/structure_check.h"

static const field *part(const char *name) { return field_find("structure", name, strlen(name)); }

/* ---- matrices ---- */

/* The motion that has no mass, and what to do about it; nothing where M is not singular but indefinite. */
static hc_status add_massless_motion(const scene_structure *s, const structure_matrix *mass, int n, message *m)
{
  scene_structure named = *s; /* which has its n only when its mass matrix has been accepted */
  bool massless;
  double *x = malloc((size_t)n * sizeof *x);
  if (!x || structure_massless_motion(n, mass->v, x, &massless) != HC_OK) {
    free(x);
    return HC_NO_MEMORY;
  }
  named.n = n;
  if (massless) {
    message_add(m, "; {");
    structure_describe_motion(&named, x, m);
    message_add(m, "} has none: condense it statically onto the others, or give it a small one");
  }
  free(x);
  return HC_OK;
}

/* Nothing of the methods here holds for a mass matrix that is not symmetric and positive definite. */
static hc_status check_mass(case_reader *r, const structure_matrix *mass, int n)
{
  char a[NUMBER_TEXT], b[NUMBER_TEXT];
  int i, j, order;
  if (structure_unsymmetric(n, mass->v, &i, &j)) {
    message_add(
        yaml_matrix_blame(r, mass, i, j),
        "structure.mass is not symmetric: entry (%d, %d) is %s, but (%d, %d) is %s, expected a symmetric matrix", i + 1,
        j + 1, number_write(mass->v[i + j * (size_t)n], a), j + 1, i + 1, number_write(mass->v[j + i * (size_t)n], b));
    return HC_BAD_INPUT;
  }
  if (structure_not_definite(n, mass->v, &order) == HC_NO_MEMORY) return case_out_of_memory(r);
  if (order == 0) return HC_OK;
  message *m = yaml_matrix_blame(r, mass, order - 1, order - 1);
  message_add(m,
              "structure.mass is not positive definite: its leading minor of order %d is not positive, expected a mass "
              "for every motion",
              order);
  return add_massless_motion(r->sc.structure, mass, n, m) == HC_OK ? HC_BAD_INPUT : case_out_of_memory(r);
}

/* Files that say what their rows are say the same. */
static hc_status check_labels(case_reader *r, const structure_matrix *m, const char *what)
{
  const scene_structure *s = r->sc.structure;
  const matrix_label *own = m->labels, *mass = s->mass.labels;
  for (int i = 0; own && mass && i < s->n; ++i) {
    if (own[i].node == mass[i].node && own[i].dof == mass[i].dof) continue;
    message_add(yaml_matrix_blame(r, m, i, i),
                "row %d of %s is DOF %d of node %d, but of structure.mass DOF %d of node %d, expected the same rows",
                i + 1, what, own[i].dof, own[i].node, mass[i].dof, mass[i].node);
    return HC_BAD_INPUT;
  }
  return HC_OK;
}

static hc_status read_mass(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  structure_matrix mass = {0};
  int n = s->n;
  hc_status st = yaml_matrix_read(r, doc, "structure.mass", node, s->n, &n, &mass);
  if (st == HC_OK) st = check_mass(r, &mass, n);
  structure_free_matrix(st == HC_OK ? &s->mass : &mass);
  if (st == HC_OK) s->mass = mass, s->n = n;
  if (st == HC_OK) st = check_labels(r, &s->stiffness, "structure.stiffness"); /* of before */
  return st;
}

/* ---- damping ---- */

static hc_status read_ratios(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  const int n = yaml_length(node);
  const case_place at = case_place_of(r, node->start_mark);
  if (n != s->n)
    return case_refuse(r, at, "structure.damping.modal has %d entries, expected one number, or %d, one a mode", n,
                       s->n);
  double *ratios = calloc((size_t)n, sizeof *ratios);
  hc_status st = HC_OK;
  if (!ratios) return case_out_of_memory(r);
  for (int i = 0; i < n && st == HC_OK; ++i) {
    const yaml_node_t *entry = yaml_entry(doc, node, i);
    st = yaml_number(r, entry, "an entry of structure.damping.modal", &ratios[i]);
    if (st != HC_OK || ratios[i] >= 0) continue;
    message_add(case_blame(r, case_place_of(r, entry->start_mark)),
                "an entry of structure.damping.modal is negative, expected numbers >= 0");
    st = HC_BAD_INPUT;
  }
  free(st == HC_OK ? s->ratios : ratios);
  if (st != HC_OK) return st;
  s->ratios = ratios;
  s->how = STRUCTURE_DAMPING_MODES;
  return HC_OK;
}

void structure_damping_given(scene_structure *s, const field *f)
{
  const char *index = strchr(f->name, '[');
  if (index && s->how != STRUCTURE_DAMPING_RAYLEIGH) s->rayleigh[index[1] == '0'] = 0;
  s->how = !strcmp(f->name, "damping.modal") ? STRUCTURE_DAMPING_MODAL : STRUCTURE_DAMPING_RAYLEIGH;
}

/* rayleigh: [alpha, beta], modal: 0.01 or modal: [0.01, ...] */
static hc_status read_damping_value(case_reader *r, yaml_document_t *doc, const field *f, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  const bool modal = !strcmp(f->name, "damping.modal");
  s->damping.place = case_place_of(r, node->start_mark);
  if (modal && node->type == YAML_SEQUENCE_NODE) return read_ratios(r, doc, node);
  const hc_status st = yaml_scene_value(r, doc, f, -1, s, node);
  if (st == HC_OK) structure_damping_given(s, f);
  return st;
}

static hc_status read_damping(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  if (node->type != YAML_MAPPING_NODE) {
    int n;
    const hc_status st = yaml_matrix_read(r, doc, "structure.damping", node, s->n, &n, &s->damping);
    if (st == HC_OK) s->how = STRUCTURE_DAMPING_MATRIX;
    return st == HC_OK ? check_labels(r, &s->damping, "structure.damping") : st;
  }
  const yaml_node_pair_t *p = node->data.mapping.pairs.start;
  const bool one = node->data.mapping.pairs.top == p + 1;
  const yaml_node_t *key = one ? yaml_document_get_node(doc, p->key) : NULL;
  char name[FIELD_PATH] = "damping.";
  if (key && key->type == YAML_SCALAR_NODE && key->data.scalar.length < 20)
    snprintf(name, sizeof name, "damping.%s", yaml_node_text(key));
  const field *f = part(name);
  if (f) return read_damping_value(r, doc, f, yaml_document_get_node(doc, p->value));
  return yaml_refuse(
      r, key ? key : node,
      "structure.damping is a mapping of something else, expected {rayleigh: [alpha, beta]}, {modal: 0.01} or "
      "{modal: [...]}, or a matrix");
}

/* ---- names and nodes ---- */

/* Why a name is none, or NULL. */
static const char *objection(const yaml_node_t *node)
{
  static const char *const reserved[] = {"dof", "node", "direction", NULL};
  int number;
  if (node->type != YAML_SCALAR_NODE || node->data.scalar.length == 0) return "is none";
  const char *text = yaml_node_text(node);
  const size_t length = node->data.scalar.length;
  if (length >= STRUCTURE_WORD) return "is too long";
  if (number_read_integer(text, length, &number) == NUMBER_FINE) return "is a number, which means a DOF already";
  for (int i = 0; reserved[i]; ++i)
    if (!strcmp(text, reserved[i])) return "is a word of the case file";
  for (size_t i = 0, step; i < length; i += step) {
    unsigned long code;
    step = utf8_character(text + i, length - i, &code);
    if (step == 0 || utf8_is_control(code)) return "has control characters";
  }
  return NULL;
}

static hc_status read_names(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  const bool list = node->type == YAML_SEQUENCE_NODE;
  const int n = list ? yaml_length(node) : 0;
  if (n != s->n) {
    message *m = case_blame(r, case_place_of(r, node->start_mark));
    if (list) message_add(m, "structure.names has %d names, expected %d, one a DOF", n, s->n);
    else message_add(m, "structure.names is %s, expected a list of %d names", yaml_node_what(node), s->n);
    return HC_BAD_INPUT;
  }
  char **old = s->names;
  for (int i = 0; old && i < n; ++i) free(old[i]);
  free(old);
  if (!(s->names = calloc((size_t)n + 1, sizeof *s->names))) return case_out_of_memory(r);
  for (int i = 0; i < n; ++i) {
    const yaml_node_t *entry = yaml_entry(doc, node, i);
    const char *why = objection(entry);
    for (int k = 0; !why && k < i; ++k)
      if (!strcmp(s->names[k], yaml_node_text(entry))) why = "is there twice";
    if (why) {
      message_add(case_blame(r, case_place_of(r, entry->start_mark)),
                  "name %d of structure.names %s, expected %d different names of at most %d bytes", i + 1, why, n,
                  STRUCTURE_WORD - 1);
      for (int k = i; k < n; ++k) s->names[k] = NULL;
      return HC_BAD_INPUT;
    }
    if (!(s->names[i] = strdup(yaml_node_text(entry)))) return case_out_of_memory(r);
  }
  return HC_OK;
}

/* [dof, node, direction], as in a line of the file. */
static hc_status read_node(case_reader *r, yaml_document_t *doc, const yaml_node_t *entry)
{
  const yaml_node_t *at[3] = {NULL, NULL, NULL};
  int dof, id = 0;
  const bool list = entry->type == YAML_SEQUENCE_NODE;
  for (int i = 0; list && i < 3 && entry->data.sequence.items.start + i < entry->data.sequence.items.top; ++i)
    at[i] = yaml_entry(doc, entry, i);
  const bool whole =
      at[2] && yaml_length(entry) == 3 && at[1]->type == YAML_SCALAR_NODE && at[2]->type == YAML_SCALAR_NODE;
  const char *axis = whole ? yaml_node_text(at[2]) : "";
  if (!whole || number_read_integer(yaml_node_text(at[1]), at[1]->data.scalar.length, &id) != NUMBER_FINE ||
      at[2]->data.scalar.length != 1 || !structure_is_axis(*axis) ||
      structure_node_dof(r->sc.structure, id, *axis) >= 0)
    return yaml_refuse(
        r, entry,
        "an entry of structure.nodes, expected [DOF, NODE, x or y or z] such as [tip, 17, y], each node and "
        "direction once");
  const hc_status st = yaml_dof(r, doc, at[0], &dof);
  if (st != HC_OK) return st;
  return nodes_add(r->sc.structure, dof, id, *axis) == HC_OK ? HC_OK : case_out_of_memory(r);
}

static hc_status read_nodes_file(case_reader *r, const yaml_node_t *node)
{
  char words[160], *path = text_file_path(r->name, yaml_node_text(node), node->data.scalar.length);
  message told;
  message_start(&told, words, sizeof words);
  if (!path) return case_out_of_memory(r);
  hc_status st = nodes_file_read(path, r->sc.structure, &r->msg);
  if (st == HC_NO_MEMORY) st = case_out_of_memory(r);
  if (st == HC_IO) {
    message_add(&told, "%s", r->msg.text);
    message *m = case_blame(r, case_place_of(r, node->start_mark));
    message_add(m, "structure.nodes: ");
    message_add_input(m, path, strlen(path), 160);
    message_add(m, " %s, expected a csv file dof,node,direction, or the .dof of CalculiX or a matrix of Abaqus", words);
    st = HC_BAD_INPUT;
  }
  free(path);
  return st;
}

static hc_status read_nodes(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  free(s->nodes);
  s->nodes = NULL;
  s->n_nodes = 0;
  if (node->type == YAML_SCALAR_NODE && node->data.scalar.length > 0) return read_nodes_file(r, node);
  if (node->type != YAML_SEQUENCE_NODE)
    return yaml_refuse(r, node, "structure.nodes is %s, expected %s", yaml_node_what(node), part("nodes")->expects);
  hc_status st = HC_OK;
  for (int i = 0; i < yaml_length(node) && st == HC_OK; ++i) st = read_node(r, doc, yaml_entry(doc, node, i));
  return st;
}

/* ---- the section ---- */

static hc_status read_stiffness(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  int n;
  const hc_status st = yaml_matrix_read(r, doc, "structure.stiffness", node, s->n, &n, &s->stiffness);
  return st == HC_OK ? check_labels(r, &s->stiffness, "structure.stiffness") : st;
}

hc_status yaml_structure_part(case_reader *r, yaml_document_t *doc, const field *f, const yaml_node_t *node)
{
  static const struct {
    const char *name;
    hc_status (*read)(case_reader *, yaml_document_t *, const yaml_node_t *);
  } parts[] = {{"mass", read_mass},   {"stiffness", read_stiffness}, {"damping", read_damping},
               {"names", read_names}, {"nodes", read_nodes},         {"response", yaml_responses_read}};
  size_t i = 0;
  if (f->flags & FIELD_IN_STRUCTURE) return read_damping_value(r, doc, f, node);
  while (strcmp(parts[i].name, f->name)) ++i;
  return parts[i].read(r, doc, node);
}

/* What each key of the section is given, value[field_index]. */
static hc_status collect(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, const yaml_node_t **value)
{
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key);
    if (!yaml_check_key(r, key)) return HC_BAD_INPUT;
    const field *f = field_find("structure", yaml_node_text(key), key->data.scalar.length);
    if (!f || f->kind != FIELD_PART) return yaml_unknown_key(r, key, "structure");
    if (value[field_index(f)]) return yaml_duplicate_key(r, key, r->at[field_index(f)]);
    value[field_index(f)] = yaml_document_get_node(doc, p->value);
    r->at[field_index(f)] = case_place_of(r, value[field_index(f)]->start_mark);
  }
  return HC_OK;
}

hc_status yaml_structure_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  const yaml_node_t *value[FIELD_MAX] = {NULL};
  const case_place at = case_place_of(r, node->start_mark);
  if (node->type != YAML_MAPPING_NODE)
    return case_refuse(r, at, "structure is %s, expected a mapping {mass: ..., damping: ..., stiffness: ...}",
                       yaml_node_what(node));
  if (!(r->sc.structure = structure_new())) return case_out_of_memory(r);
  r->owns_structure = true;
  r->sc.structure->place = at;
  hc_status st = collect(r, doc, node, value);
  /* The order of the table: the mass matrix says how many degrees of freedom there are. */
  for (int i = 0; i < field_count() && st == HC_OK; ++i) {
    const field *f = field_at(i);
    if (strcmp(f->section, "structure") || f->kind != FIELD_PART) continue;
    if (value[i]) {
      st = yaml_structure_part(r, doc, f, value[i]);
    } else if (!f->fallback) {
      message_add(case_blame(r, at), "missing key `%s` in `structure`, expected %s", f->name, f->expects);
      st = HC_BAD_INPUT;
    }
  }
  return st;
}
