/* yaml_scene.c - from a YAML document to a scene, every key through the table of fields. The first mistake ends it. */
#include <stdlib.h>
#include <string.h>

#include "model/casefile/case_reader.h"
#include "numerics/norm.h"

/* A section that is a mapping. */
static hc_status read_section(case_reader *r, const field_section *s, const yaml_node_t *node)
{
  if (node->type != YAML_MAPPING_NODE) {
    message *m = yaml_blame(r, node);
    message_add(m, "%s is %s, expected a mapping such as {", s->name, yaml_node_what(node));
    for (int i = 0, n = 0; i < field_count() && n < 2; ++i)
      if (!strcmp(field_at(i)->section, s->name)) message_add(m, "%s: ..., ", field_at(i)->name), ++n;
    message_add(m, "...}");
    return HC_BAD_INPUT;
  }
  const hc_status st = yaml_fields_read(r, node, s->name, -1, &r->sc, false);
  if (st != HC_OK) return st;
  const field *amplitude = field_named("base", "amplitude");
  if (!strcmp(s->name, "base") && !case_given(r, amplitude) && !yaml_given_rival(r, amplitude))
    return yaml_refuse(r, node, "missing key `amplitude` in `base`, expected a number >= 0, or `acceleration`");
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i), *rival = field_rival(f, 0);
    if (strcmp(f->section, s->name) || f->fallback || f->flags & FIELD_STRUCTURE) continue;
    if (case_given(r, f) || yaml_given_rival(r, f)) continue;
    message *m = yaml_blame(r, node);
    message_add(m, "missing key `%s` in `%s`, expected ", f->name, s->name);
    field_expected(f, m);
    if (rival) message_add(m, ", or `%s`", rival->name);
    return HC_BAD_INPUT;
  }
  return HC_OK;
}

/* The contact that a key of transient.rest means; -1: none. */
static int contact_of(const scene_structure *s, const yaml_node_t *key)
{
  const char *text = yaml_node_text(key);
  char *end;
  const int named = structure_contact_named(s, text, key->data.scalar.length);
  const long index = named < 0 ? strtol(text, &end, 10) : named;
  const bool is_index = named >= 0 || (end != text && !*end);
  return is_index && index >= 0 && index < s->n_contacts ? (int)index : -1;
}

hc_status yaml_rests_read(case_reader *r)
{
  const yaml_node_t *node = r->rests;
  const field *fields[] = {field_named("contacts", "rest"), field_named("contacts", "rest_2")};
  hc_status st = HC_OK;
  r->rests = NULL;
  if (!node) return HC_OK;
  if (node->type != YAML_MAPPING_NODE)
    return yaml_refuse(r, node, "transient.rest is %s, expected a mapping {CONTACT: W, ...}", yaml_node_what(node));
  for (int i = 0; i < yaml_keys(node) && st == HC_OK; ++i) {
    const yaml_node_t *key = yaml_key(r, node, i), *value = yaml_value(r, node, i);
    const int j = key->type == YAML_SCALAR_NODE ? contact_of(r->sc.structure, key) : -1;
    if (j < 0) return yaml_refuse(r, key, "transient.rest: no such contact, expected a name or a number from 0");
    const bool both = value->type == YAML_SEQUENCE_NODE && yaml_length(value) == 2;
    const structure_contact *c = &r->sc.structure->contacts[j];
    const contact law = scene_contact_law(&c->given);
    if (!field_is_of_law(fields[0], &c->given) || !contact_has_friction(&law))
      return yaml_refuse(r, key, "transient.rest: contact %d has no slider, expected one with friction", j);
    if (both && (scene_is_oscillator(&r->sc) || is_zero(r->sc.structure->n, c->tangent_2)))
      return yaml_refuse(r, value, "transient.rest: contact %d has one tangent, expected one number", j);
    for (int d = 0; d < 1 + both && st == HC_OK; ++d)
      st = yaml_scene_value(r, fields[d], j, &r->sc.structure->contacts[j].given,
                            both ? yaml_entry(r, value, d) : value);
  }
  return st;
}

static hc_status read_top_level(case_reader *r, const yaml_node_t *key, const yaml_node_t *value, case_place *given)
{
  hc_status st = yaml_check_key(r, key);
  if (st != HC_OK) return st;
  const field *f = field_find("", yaml_node_text(key), key->data.scalar.length);
  if (f && f->kind == FIELD_PART && !scene_is_oscillator(&r->sc)) { /* response */
    st = yaml_give(r, f, key, value);
    return st == HC_OK ? yaml_structure_part(r, f, value) : st;
  }
  if (f) return yaml_field_read(r, f, key, value, -1, &r->sc);
  const field_section *s = field_find_section(yaml_node_text(key), key->data.scalar.length);
  if (!s || strchr(s->name, '[')) return yaml_unknown_key(r, key, "");
  case_place *at = &given[s - field_section_at(0)];
  if (at->line > 0) return yaml_duplicate_key(r, key, *at);
  *at = yaml_place(r, key);
  /* What a section holds, wherever it stands. */
  if (!strcmp(s->name, "structure")) return yaml_structure_read(r, value);
  if (!strcmp(s->name, "contacts")) return yaml_contacts_read(r, value);
  if (!scene_is_oscillator(&r->sc) && !strcmp(s->name, "forcing")) return yaml_loads_read(r, value);
  return read_section(r, s, value);
}

/* The first key of that name, -1 if there is none. */
static int find_key(case_reader *r, const yaml_node_t *root, const char *name)
{
  for (int i = 0; i < yaml_keys(root); ++i) {
    const yaml_node_t *key = yaml_key(r, root, i);
    if (key->type == YAML_SCALAR_NODE && !strcmp(yaml_node_text(key), name)) return i;
  }
  return -1;
}

hc_status yaml_scene_read(case_reader *r, const yaml_node_t *root)
{
  case_place given[FIELD_MAX] = {{0}}; /* [section] */
  if (root->type != YAML_MAPPING_NODE)
    return yaml_refuse(r, root, "the case is %s, expected a mapping with `oscillator`, `forcing` and `sweep`",
                       yaml_node_what(root));
  const int structure = find_key(r, root, "structure"), oscillator = find_key(r, root, "oscillator");
  if (structure >= 0 && oscillator >= 0) {
    const yaml_node_t *first = yaml_key(r, root, structure < oscillator ? structure : oscillator),
                      *last = yaml_key(r, root, structure < oscillator ? oscillator : structure);
    return yaml_refuse(r, last, "both `%s` (line %zu) and `%s`, expected one of them", yaml_node_text(first),
                       yaml_place(r, first).line, yaml_node_text(last));
  }
  hc_status st = HC_OK;
  if (structure < 0) {
    if (!(r->sc.structure = structure_new_oscillator(0, 0, 0, 0))) return case_out_of_memory(r);
    r->owns_structure = true;
  }
  if (structure >= 0) st = read_top_level(r, yaml_key(r, root, structure), yaml_value(r, root, structure), given);
  for (int i = 0; i < yaml_keys(root) && st == HC_OK; ++i)
    if (i != structure) st = read_top_level(r, yaml_key(r, root, i), yaml_value(r, root, i), given);
  if (st == HC_OK) st = yaml_rests_read(r);
  if (st != HC_OK) return st;
  const field_section *s;
  for (int i = 1; (s = field_section_at(i)) != NULL; ++i) {
    message *m = NULL;
    /* a structure has neither mass nor force as an oscillator has */
    const bool forcing = !strcmp(s->name, "forcing"), of_oscillator = !strcmp(s->name, "oscillator") || forcing;
    if (given[i].line > 0 || (structure >= 0 && of_oscillator)) continue;
    if (forcing && given[field_find_section("base", 4) - field_section_at(0)].line > 0) continue;
    for (int j = 0; j < field_count(); ++j) {
      const field *f = field_at(j);
      if (strcmp(f->section, s->name) || f->fallback || f->scale != 0) continue;
      if (f->flags & (FIELD_IN_CONTACT | FIELD_STRUCTURE)) continue;
      if (!m) message_add(m = yaml_blame(r, root), "missing section `%s`, expected `%s: {", s->name, s->name);
      else message_add(m, ", ");
      message_add(m, "%s: ...", f->name);
    }
    if (m) message_add(m, "}`%s", !strcmp(s->name, "oscillator") ? ", or `structure`" : "");
    if (m) return HC_BAD_INPUT;
  }
  return HC_OK;
}
