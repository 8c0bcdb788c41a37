/* yaml_scene.c - from a YAML document to a scene, every key through the table of fields. The first mistake ends it. */
#include <string.h>

#include "casefile/yaml_structure.h"

static hc_status check_missing(case_reader *r, const field_section *s, const yaml_node_t *node, int j)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i), *rival = field_rival(f, 0);
    if (strcmp(f->section, s->name) || f->fallback || f->flags & FIELD_STRUCTURE) continue;
    if (case_given(r, f) || yaml_given_rival(r, f)) continue;
    message *m = case_blame(r, case_place_of(r, node->start_mark));
    message_add(m, "missing key `%s` in `%s", f->name, s->name);
    if (j >= 0) message_add(m, "[%d]", j);
    message_add(m, "`, expected ");
    field_expected(f, m);
    if (rival) message_add(m, ", or `%s`", rival->name);
    return HC_BAD_INPUT;
  }
  return HC_OK;
}

static hc_status of_structure(case_reader *r, const yaml_node_t *key)
{
  message *m = case_blame(r, case_place_of(r, key->start_mark));
  message_add_quoted(m, yaml_node_text(key), key->data.scalar.length);
  message_add(m, " is for a structure, expected `structure` instead of `oscillator` with it");
  return HC_BAD_INPUT;
}

/* A section that is a mapping, or one contact of an oscillator. */
static hc_status read_section(case_reader *r, yaml_document_t *doc, const field_section *s, int j, void *base,
                              const yaml_node_t *node)
{
  if (node->type != YAML_MAPPING_NODE) {
    message *m = case_blame(r, case_place_of(r, node->start_mark));
    message_add(m, "%s", s->name);
    if (j >= 0) message_add(m, "[%d]", j);
    message_add(m, " is %s, expected a mapping such as {", yaml_node_what(node));
    for (int i = 0, n = 0; i < field_count() && n < 2; ++i)
      if (!strcmp(field_at(i)->section, s->name)) message_add(m, "%s: ..., ", field_at(i)->name), ++n;
    message_add(m, "...}");
    return HC_BAD_INPUT;
  }
  hc_status st = HC_OK;
  for (yaml_node_pair_t *p = node->data.mapping.pairs.start; p < node->data.mapping.pairs.top && st == HC_OK; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key);
    if (!yaml_check_key(r, key)) return HC_BAD_INPUT;
    const field *f = field_find(s->name, yaml_node_text(key), key->data.scalar.length);
    if (f && f->flags & FIELD_STRUCTURE) return of_structure(r, key);
    st = f ? yaml_scene_field(r, doc, f, j, base, p) : yaml_unknown_key(r, key, s->name);
  }
  return st == HC_OK ? check_missing(r, s, node, j) : st;
}

hc_status yaml_scene_contact(case_reader *r, yaml_document_t *doc, yaml_node_t *node, int j)
{
  yaml_forget_fields(r, FIELD_IN_CONTACT);
  field_contact_defaults(&r->sc.contacts[j]);
  r->contact_has[j] = ~0ull; /* what is missing is found here and now */
  r->contact_at[j] = case_place_of(r, node->start_mark);
  hc_status st = read_section(r, doc, field_find_section("contacts", 8), j, &r->sc.contacts[j], node);
  memcpy(r->contact_field_at[j], r->at, sizeof r->at);
  return st;
}

hc_status yaml_scene_contacts(case_reader *r, yaml_document_t *doc, yaml_node_t *node)
{
  if (node->type != YAML_SEQUENCE_NODE)
    return yaml_refuse(r, node, "contacts is %s, expected a list of contacts, or [] for none", yaml_node_what(node));
  memset(r->sc.contacts, 0, sizeof r->sc.contacts);
  r->sc.n_contacts = 0;
  for (int i = 0; i < yaml_length(node); ++i) {
    yaml_node_t *entry = yaml_entry(doc, node, i);
    if (r->sc.n_contacts == SCENE_MAX_CONTACTS)
      return yaml_refuse(r, entry, "one contact too many, expected at most %d", SCENE_MAX_CONTACTS);
    hc_status st = yaml_scene_contact(r, doc, entry, r->sc.n_contacts++);
    if (st != HC_OK) return st;
  }
  return HC_OK;
}

/* Does a case do without the section? A structure has neither mass nor force as an oscillator has. */
static bool may_be_missing(const case_reader *r, const field_section *s)
{
  return r->sc.structure && (!strcmp(s->name, "oscillator") || !strcmp(s->name, "forcing"));
}

static hc_status check_sections(case_reader *r, const case_place *given, const yaml_node_t *root)
{
  const field_section *s;
  for (int i = 1; (s = field_section_at(i)) != NULL; ++i) {
    message *m = NULL;
    for (int j = 0; j < field_count() && given[i].line == 0 && !may_be_missing(r, s); ++j) {
      const field *f = field_at(j);
      if (strcmp(f->section, s->name) || f->fallback || f->scale != 0) continue;
      if (f->flags & (FIELD_ELSEWHERE | FIELD_STRUCTURE)) continue;
      if (!m)
        message_add(m = case_blame(r, case_place_of(r, root->start_mark)), "missing section `%s`, expected `%s: {",
                    s->name, s->name);
      else message_add(m, ", ");
      message_add(m, "%s: ...", f->name);
    }
    if (m) message_add(m, "}`%s", !strcmp(s->name, "oscillator") ? ", or `structure`" : "");
    if (m) return HC_BAD_INPUT;
  }
  return HC_OK;
}

static int section_index(const char *name)
{
  int i = 0;
  while (strcmp(field_section_at(i)->name, name)) ++i;
  return i;
}

/* What a section holds, wherever it stands. */
static hc_status read_section_value(case_reader *r, yaml_document_t *doc, const field_section *s, yaml_node_t *value)
{
  const bool contacts = !strcmp(s->name, "contacts");
  if (!strcmp(s->name, "structure")) return yaml_structure_read(r, doc, value);
  if (r->sc.structure && contacts) return yaml_contacts_read(r, doc, value);
  if (r->sc.structure && !strcmp(s->name, "forcing")) return yaml_loads_read(r, doc, value);
  if (contacts) return yaml_scene_contacts(r, doc, value);
  return read_section(r, doc, s, -1, &r->sc, value);
}

static hc_status read_top_level(case_reader *r, yaml_document_t *doc, const yaml_node_pair_t *pair, case_place *given)
{
  const yaml_node_t *key = yaml_document_get_node(doc, pair->key);
  yaml_node_t *value = yaml_document_get_node(doc, pair->value);
  if (!yaml_check_key(r, key)) return HC_BAD_INPUT;
  const field *f = field_find("", yaml_node_text(key), key->data.scalar.length);
  if (f && f->kind == FIELD_PART) { /* response */
    if (case_given(r, f)) return yaml_duplicate_key(r, key, r->at[field_index(f)]);
    r->at[field_index(f)] = case_place_of(r, value->start_mark);
    return r->sc.structure ? yaml_structure_part(r, doc, f, value) : of_structure(r, key);
  }
  if (f) return yaml_scene_field(r, doc, f, -1, &r->sc, pair);
  const field_section *s = field_find_section(yaml_node_text(key), key->data.scalar.length);
  if (!s || strchr(s->name, '[')) return yaml_unknown_key(r, key, "");
  case_place *at = &given[section_index(s->name)];
  if (at->line > 0) return yaml_duplicate_key(r, key, *at);
  *at = case_place_of(r, key->start_mark);
  return read_section_value(r, doc, s, value);
}

/* The first pair with that key, or NULL. */
static const yaml_node_pair_t *find_key(yaml_document_t *doc, const yaml_node_t *root, const char *name)
{
  for (yaml_node_pair_t *p = root->data.mapping.pairs.start; p < root->data.mapping.pairs.top; ++p) {
    const yaml_node_t *key = yaml_document_get_node(doc, p->key);
    if (key->type == YAML_SCALAR_NODE && !strcmp(yaml_node_text(key), name)) return p;
  }
  return NULL;
}

static hc_status refuse_both(case_reader *r, yaml_document_t *doc, const yaml_node_pair_t *a, const yaml_node_pair_t *b)
{
  const yaml_node_pair_t *first = a < b ? a : b, *last = a < b ? b : a;
  const yaml_node_t *before = yaml_document_get_node(doc, first->key), *key = yaml_document_get_node(doc, last->key);
  return yaml_refuse(r, key, "both `%s` (line %zu) and `%s`, expected one of them", yaml_node_text(before),
                     case_place_of(r, before->start_mark).line, yaml_node_text(key));
}

hc_status yaml_scene_read(case_reader *r, yaml_document_t *doc, const yaml_node_t *root)
{
  case_place given[FIELD_MAX] = {{0}}; /* [section] */
  if (root->type != YAML_MAPPING_NODE)
    return yaml_refuse(r, root, "the case is %s, expected a mapping with `oscillator`, `forcing` and `sweep`",
                       yaml_node_what(root));
  const yaml_node_pair_t *structure = find_key(doc, root, "structure"), *oscillator = find_key(doc, root, "oscillator");
  if (structure && oscillator) return refuse_both(r, doc, oscillator, structure);
  hc_status st = structure ? read_top_level(r, doc, structure, given) : HC_OK;
  for (yaml_node_pair_t *p = root->data.mapping.pairs.start; p < root->data.mapping.pairs.top && st == HC_OK; ++p)
    if (p != structure) st = read_top_level(r, doc, p, given);
  return st == HC_OK ? check_sections(r, given, root) : st;
}
