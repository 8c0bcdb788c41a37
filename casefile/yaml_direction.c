/* yaml_direction.c - degrees of freedom and directions of a structure, as a case file means them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest.h"
#include "base/number.h"
#include "casefile/yaml_structure.h"

hc_status yaml_no_such_dof(case_reader *r, case_place at, const char *text, size_t length)
{
  const scene_structure *s = r->sc.structure;
  const char *near = s->names ? nearest_word((const char *const *)s->names, text, length) : NULL;
  message *m = case_blame(r, at);
  message_add(m, "no DOF `");
  message_add_input(m, text, length, 60);
  if (near) message_add(m, "`, did you mean `%s`?", near);
  else message_add(m, "`, expected a number 1..%d%s", s->n, s->names ? " or one of structure.names" : "");
  return HC_BAD_INPUT;
}

static hc_status named_dof(case_reader *r, const yaml_node_t *node, int *dof)
{
  if (node->type != YAML_SCALAR_NODE) {
    message_add(case_blame(r, case_place_of(r, node->start_mark)),
                "%s stands where a DOF should, expected its name or "
                "number",
                yaml_node_what(node));
    return HC_BAD_INPUT;
  }
  const char *text = yaml_node_text(node);
  const size_t length = node->data.scalar.length;
  *dof = structure_dof(r->sc.structure, text, length);
  return *dof >= 0 ? HC_OK : yaml_no_such_dof(r, case_place_of(r, node->start_mark), text, length);
}

/* The value of `key` in a mapping, or NULL. */
static const yaml_node_t *value_of(yaml_document_t *doc, const yaml_node_t *node, const char *key)
{
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top; ++p) {
    const yaml_node_t *k = yaml_document_get_node(doc, p->key);
    if (k->type == YAML_SCALAR_NODE && k->data.scalar.length == strlen(key) && !strcmp(yaml_node_text(k), key))
      return yaml_document_get_node(doc, p->value);
  }
  return NULL;
}

static bool is_axis(const yaml_node_t *n)
{
  return n->type == YAML_SCALAR_NODE && n->data.scalar.length == 1 && structure_is_axis(*yaml_node_text(n));
}

/* {node: 17, direction: y}, as far as these two keys are concerned. */
static hc_status node_dof(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int *dof)
{
  const yaml_node_t *number = value_of(doc, node, "node"), *axis = value_of(doc, node, "direction");
  int id = 0;
  message *m;
  if (number->type != YAML_SCALAR_NODE || !axis || !is_axis(axis) ||
      number_read_integer(yaml_node_text(number), number->data.scalar.length, &id) != NUMBER_FINE) {
    message_add(case_blame(r, case_place_of(r, number->start_mark)),
                "a node without its number or direction, expected {node: 17, direction: y}, with x, y or z");
    return HC_BAD_INPUT;
  }
  *dof = structure_node_dof(r->sc.structure, id, *yaml_node_text(axis));
  if (*dof >= 0) return HC_OK;
  m = case_blame(r, case_place_of(r, number->start_mark));
  message_add(m, "no DOF of node %d in direction %c, expected one of structure.nodes%s", id, *yaml_node_text(axis),
              r->sc.structure->n_nodes == 0 ? ", which is not given" : "");
  return HC_BAD_INPUT;
}

hc_status yaml_dof(case_reader *r, yaml_document_t *doc, const yaml_node_t *node, int *dof)
{
  const bool by_node = node->type == YAML_MAPPING_NODE && value_of(doc, node, "node");
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
    int dof;
    if ((st = named_dof(r, key, &dof)) != HC_OK) break;
    if (seen[dof]++) {
      message *m = case_blame(r, case_place_of(r, key->start_mark));
      message_add(m, "%s gives DOF `", what);
      message_add_input(m, yaml_node_text(key), key->data.scalar.length, 60);
      message_add(m, "` twice, expected each once");
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
  int dof;
  memset(direction, 0, (size_t)n * sizeof *direction);
  if (node->type != YAML_MAPPING_NODE || value_of(doc, node, "node")) {
    const hc_status st = yaml_dof(r, doc, node, &dof);
    if (st == HC_OK) direction[dof] = 1;
    return st;
  }
  const hc_status st = read_factors(r, doc, what, node, direction);
  if (st != HC_OK) return st;
  for (int i = 0; i < n; ++i)
    if (direction[i] != 0) return HC_OK;
  message_add(case_blame(r, case_place_of(r, node->start_mark)),
              "%s is a direction of zeros, which moves nothing, expected a factor other than 0", what);
  return HC_BAD_INPUT;
}
