/* yaml_directions.c - degrees of freedom, directions and responses of a structure, see case_reader.h. */
#include <stdlib.h>
#include <string.h>

#include "model/casefile/case_reader.h"
#include "numerics/base/nearest.h"
#include "numerics/base/number.h"
#include "numerics/norm.h"

/* ---- degrees of freedom and directions ---- */

static hc_status named_dof(case_reader *r, const yaml_node_t *node, int *dof)
{
  const scene_structure *s = r->sc.structure;
  if (node->type != YAML_SCALAR_NODE)
    return yaml_refuse(r, node, "%s stands where a DOF should, expected its name or number", yaml_node_what(node));
  const char *text = yaml_node_text(node);
  const size_t length = node->data.scalar.length;
  if ((*dof = structure_dof(s, text, length)) >= 0) {
    int number;
    const bool counted = number_read_integer(text, length, &number) == NUMBER_FINE; /* a name is none */
    return !counted || yaml_mention(r, node, *dof, NULL) == HC_OK ? HC_OK : case_out_of_memory(r);
  }
  const char *near = s->names ? nearest_word((const char *const *)s->names, text, length) : NULL;
  if (near) return yaml_refuse(r, node, "no DOF %s, did you mean `%s`?", QUOTED(text, length), near);
  return yaml_refuse(r, node, "no DOF %s, expected a number 1..%d%s", QUOTED(text, length), s->n,
                     s->names ? " or one of structure.names" : "");
}

/* {node: 17, direction: y}, as far as these two keys are concerned. */
static hc_status node_dof(case_reader *r, const yaml_node_t *node, int *dof)
{
  const yaml_node_t *number = yaml_find(r, node, "node"), *axis = yaml_find(r, node, "direction");
  int id = 0;
  if (number->type != YAML_SCALAR_NODE || !axis || !yaml_node_is_axis(axis) ||
      number_read_integer(yaml_node_text(number), number->data.scalar.length, &id) != NUMBER_FINE)
    return yaml_refuse(r, number,
                       "a node without its number or direction, expected {node: 17, direction: y}, with x, y or z");
  *dof = structure_node_dof(r->sc.structure, id, *yaml_node_text(axis));
  if (*dof >= 0) return HC_OK;
  return yaml_refuse(r, number, "no DOF of node %d in direction %c, expected one of structure.nodes%s", id,
                     *yaml_node_text(axis), r->sc.structure->n_nodes == 0 ? ", which is not given" : "");
}

hc_status yaml_dof(case_reader *r, const yaml_node_t *node, int *dof)
{
  const bool by_node = node->type == YAML_MAPPING_NODE && yaml_find(r, node, "node");
  return by_node ? node_dof(r, node, dof) : named_dof(r, node, dof);
}

static hc_status read_factors(case_reader *r, const char *what, const yaml_node_t *node, double *direction)
{
  unsigned char *seen = calloc((size_t)r->sc.structure->n, 1);
  hc_status st = HC_OK;
  if (!seen) return case_out_of_memory(r);
  for (int i = 0; i < yaml_keys(node) && st == HC_OK; ++i) {
    const yaml_node_t *key = yaml_key(r, node, i);
    int dof = 0;
    if ((st = named_dof(r, key, &dof)) != HC_OK) break;
    if (seen[dof]++) st = yaml_refuse(r, key, "%s gives DOF %s twice, expected each once", what, YAML_QUOTED(key));
    else st = yaml_number(r, yaml_value(r, node, i), what, &direction[dof]);
  }
  free(seen);
  return st;
}

hc_status yaml_direction(case_reader *r, const char *what, const yaml_node_t *node, double *direction)
{
  const int n = r->sc.structure->n;
  int dof = 0;
  memset(direction, 0, (size_t)n * sizeof *direction);
  if (node->type != YAML_MAPPING_NODE || yaml_find(r, node, "node")) {
    const hc_status st = yaml_dof(r, node, &dof);
    if (st == HC_OK) direction[dof] = 1;
    return st;
  }
  const hc_status st = read_factors(r, what, node, direction);
  if (st != HC_OK || !is_zero(n, direction)) return st;
  return yaml_refuse(r, node, "%s is a direction of zeros, which moves nothing, expected a factor other than 0", what);
}

/* ---- responses ---- */

hc_status yaml_responses_read(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  const size_t bytes = (size_t)s->n * sizeof(double);
  structure_clear_responses(s);
  hc_status st = HC_OK;
  if (node->type != YAML_SEQUENCE_NODE)
    return yaml_refuse(r, node, "response is %s, expected %s", yaml_node_what(node),
                       field_named("", "response")->expects);
  if (yaml_length(node) == 0)
    return yaml_refuse(r, node, "response is an empty list, expected %s", field_named("", "response")->expects);
  for (int i = 0; i < yaml_length(node); ++i) {
    const yaml_node_t *entry = yaml_entry(r, node, i);
    structure_response *new = structure_add_response(s);
    if (!new) return case_out_of_memory(r);
    new->place = yaml_place(r, entry);
    new->by_node = entry->type == YAML_MAPPING_NODE &&yaml_find(r, entry, "node");
    if ((st = yaml_direction(r, "response", entry, new->direction)) != HC_OK) return st;
    for (int k = 0; k < s->n_responses - 1; ++k)
      if (!memcmp(s->responses[k].direction, new->direction, bytes))
        return case_refuse(r, new->place, "response %d is response %d again, expected different ones", s->n_responses,
                           k + 1);
  }
  return HC_OK;
}
