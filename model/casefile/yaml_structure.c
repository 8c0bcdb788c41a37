/* yaml_structure.c - the section `structure` and its parts, see case_reader.h. */
#include "model/casefile/case_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/number.h"
#include "numerics/base/path.h"
#include "numerics/base/utf8.h"
#include "numerics/norm.h"

/* ---- matrices ---- */

/* Nothing of the methods here holds for a mass matrix that is not symmetric and positive definite. Of one that is
 * singular, not indefinite, the motion that has no mass is told, and what to do about it. */
static hc_status check_mass(case_reader *r, const structure_matrix *mass, int n)
{
  int order;
  const hc_status symmetric = yaml_matrix_symmetric(r, "structure.mass", mass, n);
  if (symmetric != HC_OK || !mass->v) return symmetric;
  if (structure_not_definite(n, mass->v, &order) == HC_NO_MEMORY) return case_out_of_memory(r);
  if (order == 0) return HC_OK;
  message *m = yaml_matrix_blame(r, mass, order - 1, order - 1);
  message_add(m,
              "structure.mass is not positive definite: its leading minor of order %d is not positive, expected a mass "
              "for every motion",
              order);
  scene_structure named = *r->sc.structure; /* which has its n only when its mass matrix has been accepted */
  named.n = n;
  bool massless;
  double *x = malloc((size_t)n * sizeof *x);
  const hc_status st = x ? structure_massless_motion(n, mass->v, x, &massless) : HC_NO_MEMORY;
  if (st == HC_OK && massless) {
    message_add(m, "; {");
    structure_describe_motion(&named, x, m);
    message_add(m, "} has none: condense it statically onto the others, or give it a small one");
  }
  free(x);
  return st == HC_OK ? HC_BAD_INPUT : case_out_of_memory(r);
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

static hc_status read_mass(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  structure_matrix mass = {0};
  int n = s->n;
  hc_status st = yaml_matrix_read(r, "structure.mass", node, s->n, &n, &mass);
  if (st == HC_OK) st = check_mass(r, &mass, n);
  structure_free_matrix(st == HC_OK ? &s->mass : &mass);
  if (st == HC_OK) s->mass = mass, s->n = n, s->is_sparse = !mass.v;
  if (st == HC_OK) st = check_labels(r, &s->stiffness, "structure.stiffness"); /* of before */
  return st;
}

/* ---- damping ---- */

static hc_status read_ratios(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  const int n = yaml_length(node);
  const case_place at = yaml_place(r, node);
  if (n != s->n)
    return case_refuse(r, at, "structure.damping.modal has %d entries, expected one number, or %d, one a mode", n,
                       s->n);
  double *ratios = calloc((size_t)n, sizeof *ratios);
  hc_status st = HC_OK;
  if (!ratios) return case_out_of_memory(r);
  for (int i = 0; i < n && st == HC_OK; ++i) {
    const yaml_node_t *entry = yaml_entry(r, node, i);
    st = yaml_number(r, entry, "an entry of structure.damping.modal", &ratios[i]);
    if (st == HC_OK && ratios[i] < 0)
      st = yaml_refuse(r, entry, "an entry of structure.damping.modal is negative, expected numbers >= 0");
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
static hc_status read_damping_value(case_reader *r, const field *f, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  const bool modal = !strcmp(f->name, "damping.modal");
  s->damping.place = yaml_place(r, node);
  if (modal && node->type == YAML_SEQUENCE_NODE) return read_ratios(r, node);
  const hc_status st = yaml_scene_value(r, f, -1, s, node);
  if (st == HC_OK) structure_damping_given(s, f);
  return st;
}

/* `stiffness` or `damping` as a matrix. */
static hc_status read_matrix(case_reader *r, const char *what, const yaml_node_t *node, structure_matrix *to)
{
  int n;
  hc_status st = yaml_matrix_read(r, what, node, r->sc.structure->n, &n, to);
  if (st == HC_OK && !to->v && to == &r->sc.structure->stiffness) st = yaml_matrix_symmetric(r, what, to, n);
  return st == HC_OK ? check_labels(r, to, what) : st;
}

static hc_status read_stiffness(case_reader *r, const yaml_node_t *node)
{
  return read_matrix(r, "structure.stiffness", node, &r->sc.structure->stiffness);
}

static hc_status read_damping(case_reader *r, const yaml_node_t *node)
{
  if (node->type != YAML_MAPPING_NODE) {
    const hc_status st = read_matrix(r, "structure.damping", node, &r->sc.structure->damping);
    if (st == HC_OK) r->sc.structure->how = STRUCTURE_DAMPING_MATRIX;
    return st;
  }
  const yaml_node_t *key = yaml_keys(node) == 1 ? yaml_key(r, node, 0) : NULL;
  char name[FIELD_PATH] = "damping.";
  if (key && key->type == YAML_SCALAR_NODE && key->data.scalar.length < 20)
    snprintf(name, sizeof name, "damping.%s", yaml_node_text(key));
  const field *f = field_named("structure", name);
  if (f) return read_damping_value(r, f, yaml_value(r, node, 0));
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

static hc_status read_names(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  if (node->type != YAML_SEQUENCE_NODE)
    return yaml_refuse(r, node, "structure.names is %s, expected a list of %d names", yaml_node_what(node), s->n);
  const int n = yaml_length(node);
  if (n != s->n) return yaml_refuse(r, node, "structure.names has %d names, expected %d, one a DOF", n, s->n);
  char **old = s->names;
  for (int i = 0; old && i < n; ++i) free(old[i]);
  free(old);
  if (!(s->names = calloc((size_t)n + 1, sizeof *s->names))) return case_out_of_memory(r);
  for (int i = 0; i < n; ++i) {
    const yaml_node_t *entry = yaml_entry(r, node, i);
    const char *why = objection(entry);
    for (int k = 0; !why && k < i; ++k)
      if (!strcmp(s->names[k], yaml_node_text(entry))) why = "is there twice";
    if (why)
      return yaml_refuse(r, entry, "name %d of structure.names %s, expected %d different names of at most %d bytes",
                         i + 1, why, n, STRUCTURE_WORD - 1);
    if (!(s->names[i] = strdup(yaml_node_text(entry)))) return case_out_of_memory(r);
  }
  return HC_OK;
}

/* [dof, node, direction], as in a line of the file. */
static hc_status read_node(case_reader *r, const yaml_node_t *entry)
{
  scene_structure *s = r->sc.structure;
  const bool whole = entry->type == YAML_SEQUENCE_NODE && yaml_length(entry) == 3;
  const yaml_node_t *node = whole ? yaml_entry(r, entry, 1) : NULL, *axis = whole ? yaml_entry(r, entry, 2) : NULL;
  int dof, id = 0;
  if (!whole || node->type != YAML_SCALAR_NODE || !yaml_node_is_axis(axis) ||
      number_read_integer(yaml_node_text(node), node->data.scalar.length, &id) != NUMBER_FINE ||
      structure_node_dof(s, id, *yaml_node_text(axis)) >= 0)
    return yaml_refuse(
        r, entry,
        "an entry of structure.nodes, expected [DOF, NODE, x or y or z] such as [tip, 17, y], each node and "
        "direction once");
  const hc_status st = yaml_dof(r, yaml_entry(r, entry, 0), &dof);
  if (st != HC_OK) return st;
  return nodes_add(s, dof, id, *yaml_node_text(axis)) == HC_OK ? HC_OK : case_out_of_memory(r);
}

static hc_status read_nodes(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  free(s->nodes);
  s->nodes = NULL;
  s->n_nodes = 0;
  if (node->type == YAML_SCALAR_NODE && node->data.scalar.length > 0) {
    char *path = yaml_file_beside(r, node);
    hc_status st = path ? nodes_file_read(path, r->sc.structure, &r->msg) : HC_NO_MEMORY;
    if (st == HC_NO_MEMORY) case_out_of_memory(r);
    if (st == HC_IO)
      st = yaml_file_failed(r, node, "structure.nodes", path,
                            "a csv file dof,node,direction, or the .dof of CalculiX or a matrix of Abaqus");
    free(path);
    return st;
  }
  if (node->type != YAML_SEQUENCE_NODE)
    return yaml_refuse(r, node, "structure.nodes is %s, expected %s", yaml_node_what(node),
                       field_named("structure", "nodes")->expects);
  hc_status st = HC_OK;
  for (int i = 0; i < yaml_length(node) && st == HC_OK; ++i) st = read_node(r, yaml_entry(r, node, i));
  return st;
}

/* ---- the mesh ---- */

static hc_status read_mesh(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  mesh_free(r->mesh);
  r->mesh = NULL;
  free(s->mesh);
  s->mesh = NULL;
  if (node->type != YAML_SCALAR_NODE || node->data.scalar.length == 0)
    return yaml_refuse(r, node, "structure.mesh is %s, expected %s", yaml_node_what(node),
                       field_named("structure", "mesh")->expects);
  s->mesh = path_beside(r->name, yaml_node_text(node), node->data.scalar.length);
  return s->mesh ? case_mesh_read(r, node) : case_out_of_memory(r);
}

/* ---- what a reduction stated ---- */

static hc_status read_reduction(case_reader *r, const yaml_node_t *node)
{
  static const char *const names[] = {"error", "at"};
  scene_structure *s = r->sc.structure;
  double *const to[] = {&s->reduction_error, &s->reduction_at};
  for (int i = 0; i < 2; ++i) {
    const yaml_node_t *value =
        node->type == YAML_MAPPING_NODE && yaml_keys(node) == 2 ? yaml_find(r, node, names[i]) : NULL;
    if (!value)
      return yaml_refuse(r, node, "structure.reduction, expected %s", field_named("structure", "reduction")->expects);
    const hc_status st = yaml_number(r, value, i == 0 ? "structure.reduction.error" : "structure.reduction.at", to[i]);
    if (st != HC_OK) return st;
    if (*to[i] < 0)
      return yaml_refuse(r, value, "structure.reduction.%s is negative, expected a number >= 0", names[i]);
  }
  return HC_OK;
}

/* ---- the way of the base ---- */

static hc_status read_base(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  if (!s->base && !(s->base = calloc((size_t)s->n, sizeof *s->base))) return case_out_of_memory(r);
  if (!yaml_node_is_axis(node) || s->n_nodes == 0) return yaml_direction(r, "base.direction", node, s->base);
  memset(s->base, 0, (size_t)s->n * sizeof *s->base);
  for (int i = 0; i < s->n_nodes; ++i)
    if (s->nodes[i].direction == *yaml_node_text(node)) s->base[s->nodes[i].dof] = 1;
  if (!is_zero(s->n, s->base)) return HC_OK;
  return yaml_refuse(r, node, "base.direction is %s, in which no node of structure.nodes moves, expected another",
                     yaml_node_text(node));
}

/* ---- the section ---- */

/* The character behind the last one of what a node says; libyaml has a block end where the next key stands. */
static size_t content_end(case_reader *r, const yaml_node_t *node)
{
  const bool mapping = node->type == YAML_MAPPING_NODE;
  const bool block = mapping
                         ? node->data.mapping.style != YAML_FLOW_MAPPING_STYLE
                         : node->type == YAML_SEQUENCE_NODE && node->data.sequence.style != YAML_FLOW_SEQUENCE_STYLE;
  const int n = !block ? 0 : mapping ? yaml_keys(node) : yaml_length(node);
  if (n == 0) return node->end_mark.index;
  return content_end(r, mapping ? yaml_value(r, node, n - 1) : yaml_entry(r, node, n - 1));
}

/* transient.rest, which may stand before the contacts. */
static hc_status keep_rests(case_reader *r, const yaml_node_t *node)
{
  r->rests = node;
  return HC_OK;
}

hc_status yaml_structure_part(case_reader *r, const field *f, const yaml_node_t *node)
{
  static const struct {
    const char *name;
    hc_status (*read)(case_reader *, const yaml_node_t *);
  } parts[] = {{"mass", read_mass},           {"stiffness", read_stiffness},
               {"damping", read_damping},     {"names", read_names},
               {"nodes", read_nodes},         {"mesh", read_mesh},
               {"direction", read_base},      {"response", yaml_responses_read},
               {"reduction", read_reduction}, {"rest", keep_rests}};
  size_t i = 0;
  if (f->flags & FIELD_IN_STRUCTURE) return read_damping_value(r, f, node);
  while (strcmp(parts[i].name, f->name)) ++i;
  return parts[i].read(r, node);
}

hc_status yaml_structure_read(case_reader *r, const yaml_node_t *node)
{
  const yaml_node_t *value[FIELD_MAX] = {NULL}; /* [field_index] */
  const case_place at = yaml_place(r, node);
  hc_status st = HC_OK;
  if (node->type != YAML_MAPPING_NODE)
    return case_refuse(r, at, "structure is %s, expected a mapping {mass: ..., damping: ..., stiffness: ...}",
                       yaml_node_what(node));
  if (!(r->sc.structure = structure_new())) return case_out_of_memory(r);
  r->owns_structure = true;
  r->sc.structure->place = at;
  if (r->source) r->source->from = node->start_mark.index, r->source->to = content_end(r, node);
  for (int i = 0; i < yaml_keys(node) && st == HC_OK; ++i) {
    const yaml_node_t *key = yaml_key(r, node, i);
    const field *f = yaml_key_field(r, key, "structure");
    if (!f) return HC_BAD_INPUT;
    if (f->kind != FIELD_PART) return yaml_unknown_key(r, key, "structure");
    st = yaml_give(r, f, key, value[field_index(f)] = yaml_value(r, node, i));
  }
  /* The order of the table: the mass matrix says how many degrees of freedom there are. */
  for (int i = 0; i < field_count() && st == HC_OK; ++i) {
    const field *f = field_at(i);
    if (strcmp(f->section, "structure") || f->kind != FIELD_PART) continue;
    if (value[i]) st = yaml_structure_part(r, f, value[i]);
    else if (!f->fallback) st = case_refuse(r, at, "missing key `%s` in `structure`, expected %s", f->name, f->expects);
  }
  return st;
}
