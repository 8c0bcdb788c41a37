/* yaml_lists.c - the loads of a structure, and contacts, see case_reader.h. */
#include <string.h>

#include "model/casefile/case_reader.h"
#include "numerics/norm.h"

/* Where a field of the entry being read was given, line = 0: not at all. */
static case_place place(const case_reader *r, const char *section, const char *name)
{
  return r->at[field_index(field_named(section, name))];
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
static hc_status not_of_one(case_reader *r, const yaml_node_t *node, const char *name)
{
  return yaml_refuse(r, node, "%s of a single contact, expected `pairs` and `axes` together in an entry of the list",
                     name);
}

static bool is_of_pairs(const field *f)
{
  return f == field_named("contacts", "pairs") || f == field_named("contacts", "axes");
}

hc_status yaml_entry_part(case_reader *r, const field *f, int j, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  char path[FIELD_PATH];
  if (is_of_pairs(f)) return not_of_one(r, node, f->name);
  if (yaml_is_law_part(f)) return yaml_law_part(r, f, j, node);
  if (f->flags & FIELD_IN_LOAD) s->loads[j].by_node = false;
  const void *entry = f->flags & FIELD_IN_LOAD ? (const void *)&s->loads[j] : (const void *)&s->contacts[j];
  return yaml_direction(r, field_path(f, j, path), node, field_direction(f, entry));
}

hc_status yaml_field_read(case_reader *r, const field *f, const yaml_node_t *key, const yaml_node_t *value, int j,
                          void *base)
{
  if (scene_is_oscillator(&r->sc) && f->flags & FIELD_STRUCTURE)
    return yaml_refuse(r, key, "%s is for a structure, expected `structure` instead of `oscillator` with it",
                       YAML_QUOTED(key));
  if (is_of_pairs(f)) return not_of_one(r, key, f->name);
  const hc_status st = yaml_give(r, f, key, value);
  if (st != HC_OK) return st;
  if (f->flags & FIELD_OSCILLATOR) base = r->sc.structure;
  if (f->kind != FIELD_PART) return yaml_scene_value(r, f, j, base, value);
  return field_is_in_list(f) ? yaml_entry_part(r, f, j, value) : yaml_structure_part(r, f, value);
}

hc_status yaml_fields_read(case_reader *r, const yaml_node_t *node, const char *section, int j, void *base,
                           bool by_node)
{
  hc_status st = HC_OK;
  for (int i = 0; i < yaml_keys(node) && st == HC_OK; ++i) {
    const yaml_node_t *key = yaml_key(r, node, i);
    if (by_node && (yaml_node_is(key, "node") || yaml_node_is(key, "direction"))) continue;
    const field *f = yaml_key_field(r, key, section);
    st = f ? yaml_field_read(r, f, key, yaml_value(r, node, i), j, base) : HC_BAD_INPUT;
  }
  return st;
}

/* ---- loads ---- */

/* One place of attack, which goes without saying where there is one DOF. */
static hc_status check_load(case_reader *r, int j, bool by_node)
{
  const scene_structure *s = r->sc.structure;
  const structure_load *load = &s->loads[j];
  const int places = by_node + (place(r, "forcing[]", "dof").line > 0) + (place(r, "forcing[]", "direction").line > 0);
  if (places == 0 && s->n == 1) load->direction[0] = 1;
  if (places > 1)
    return case_refuse(r, load->place,
                       "forcing[%d] acts on `dof` and something else, expected one place or `direction`", j);
  if (places == 0 && s->n > 1)
    return case_refuse(r, load->place,
                       "missing key `dof` in `forcing[%d]`, expected a DOF, or `direction`: factors of DOFs", j);
  if (place(r, "forcing[]", "amplitude").line > 0) return HC_OK;
  return case_refuse(r, load->place, "missing key `amplitude` in `forcing[%d]`, expected a number", j);
}

hc_status yaml_load_read(case_reader *r, const yaml_node_t *node, int j)
{
  scene_structure *s = r->sc.structure;
  hc_status st = check_mapping(r, node, "forcing", j, "{dof: 1, amplitude: 100}");
  if (st != HC_OK) return st;
  if (j == s->n_loads && !structure_add_load(s)) return case_out_of_memory(r);
  yaml_forget_fields(r, FIELD_IN_LOAD);
  field_load_defaults(&s->loads[j]);
  memset(s->loads[j].direction, 0, (size_t)s->n * sizeof(double));
  s->loads[j].place = yaml_place(r, node);
  const bool by_node = s->loads[j].by_node = yaml_find(r, node, "node") != NULL;
  st = yaml_fields_read(r, node, "forcing[]", j, &s->loads[j], by_node);
  if (st == HC_OK && by_node) st = yaml_direction(r, "forcing", node, s->loads[j].direction);
  return st == HC_OK ? check_load(r, j, by_node) : st;
}

hc_status yaml_loads_read(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  structure_clear_loads(s);
  if (node->type == YAML_MAPPING_NODE && s->n == 1) return yaml_load_read(r, node, 0);
  hc_status st = check_list(r, node, "forcing", "a list of loads such as [{dof: 1, amplitude: 100}]");
  if (st != HC_OK) return st;
  for (int i = 0; i < yaml_length(node) && st == HC_OK; ++i) st = yaml_load_read(r, yaml_entry(r, node, i), s->n_loads);
  return st;
}

/* ---- contacts ---- */

static hc_status missing(case_reader *r, int j, const field *f, const char *has)
{
  message *m = case_blame(r, r->sc.structure->contacts[j].place);
  message_add(m, "missing key `%s` in `contacts[%d]`, ", f->name, j);
  if (!scene_is_oscillator(&r->sc)) message_add(m, "which has a %s, ", has ? has : "law");
  message_add(m, "expected ");
  field_expected(f, m);
  return HC_BAD_INPUT;
}

/* What a contact with such a direction must have, of NULL every one of its law; what it has without: case_check. */
static hc_status check_needed(case_reader *r, int j, const char *direction)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    const structure_contact *c = &r->sc.structure->contacts[j];
    if (c->by_angle && case_contact_needs(&c->given, case_contact_given(r), f)) return missing(r, j, f, f->along);
    if (c->by_angle || !field_is_of_law(f, &c->given)) continue;
    if (!(f->flags & FIELD_IN_CONTACT) || f->fallback || case_given(r, f)) continue;
    if (direction ? f->along && !strcmp(f->along, direction) : !f->along) return missing(r, j, f, direction);
  }
  return HC_OK;
}

static hc_status check_contact(case_reader *r, int j)
{
  structure_contact *c = &r->sc.structure->contacts[j];
  const bool one_dof = r->sc.structure->n == 1;
  const bool normal = place(r, "contacts", "normal").line > 0;
  bool tangent = place(r, "contacts", "tangent").line > 0;
  const case_place angle = place(r, "contacts", "angle_deg"), tangent_2 = place(r, "contacts", "tangent_2"),
                   limit = place(r, "contacts", "limit");
  c->by_angle = angle.line > 0;
  hc_status st = case_check_law(r, j, &c->given, c->place);
  if (st != HC_OK) return st;
  const field *across = field_named("contacts", "direction");
  if (field_is_of_law(across, &c->given)) {
    if (one_dof && !case_given(r, across)) *c->normal = 1;
    if (is_zero(r->sc.structure->n, c->normal)) st = missing(r, j, across, "law");
    return st == HC_OK ? check_needed(r, j, NULL) : st;
  }
  if (c->by_angle && (tangent || normal || !one_dof))
    return case_refuse(r, angle, "angle_deg in `contacts[%d]`, expected `tangent` and `normal`%s", j,
                       one_dof ? " or `angle_deg`, not both" : ": an angle is for one DOF");
  if (tangent_2.line > 0 && !tangent)
    return case_refuse(r, tangent_2, "tangent_2 in `contacts[%d]`, which has no tangent, expected `tangent` first", j);
  if (limit.line > 0 && tangent_2.line == 0)
    return case_refuse(r, limit, "limit in `contacts[%d]`, which has one tangent, expected it beside `tangent_2` only",
                       j);
  const field *preload = field_named("contacts", "preload"), *kn = field_named("contacts", "normal_stiffness");
  if (one_dof && !tangent && !normal && !c->by_angle && case_given(r, preload) && !case_given(r, kn))
    *c->tangent = 1, tangent = true;
  if (!tangent && !normal && !c->by_angle)
    return case_refuse(r, c->place, "contacts[%d] moves nothing, expected `tangent`, `normal` or both", j);
  st = tangent || c->by_angle ? check_needed(r, j, "tangent") : HC_OK;
  if (st != HC_OK || normal || c->by_angle) return st == HC_OK && normal ? check_needed(r, j, "normal") : st;
  return case_given(r, preload) ? HC_OK : missing(r, j, preload, "tangent but no normal");
}

hc_status yaml_contact_read(case_reader *r, const yaml_node_t *node, int j)
{
  scene_structure *s = r->sc.structure;
  hc_status st = check_mapping(r, node, "contacts", j,
                               s->is_oscillator ? "{name: ..., tangential_stiffness: ..., ...}"
                                                : "{tangential_stiffness: 100, friction: 0.3, preload: 5, tangent: 1}");
  if (st != HC_OK) return st;
  if (j == s->n_contacts && !structure_add_contact(s)) return case_out_of_memory(r);
  structure_contact *c = &s->contacts[j];
  yaml_forget_fields(r, FIELD_IN_CONTACT);
  field_contact_defaults(&c->given);
  memset(c->tangent, 0, 3 * (size_t)s->n * sizeof *c->tangent); /* with the others behind it */
  c->place = yaml_place(r, node);
  if (s->is_oscillator) r->contact_has[j] = ~0ull; /* what is missing is found here and now */
  st = yaml_fields_read(r, node, "contacts", j, &c->given, false);
  if (!s->is_oscillator) return st == HC_OK ? check_contact(r, j) : st;
  if (st == HC_OK) st = check_needed(r, j, NULL);
  if (st == HC_OK) st = case_check_law(r, j, &c->given, c->place);
  memcpy(r->contact_field_at[j], r->at, sizeof r->at);
  return st;
}

hc_status yaml_contacts_read(case_reader *r, const yaml_node_t *node)
{
  scene_structure *s = r->sc.structure;
  structure_clear_contacts(s);
  hc_status st = check_list(r, node, "contacts", "a list of contacts, or [] for none");
  if (st != HC_OK) return st;
  for (int i = 0; i < yaml_length(node) && st == HC_OK; ++i) {
    const yaml_node_t *entry = yaml_entry(r, node, i);
    const bool pairs = !s->is_oscillator && entry->type == YAML_MAPPING_NODE &&
                       (yaml_find(r, entry, "pairs") || yaml_find(r, entry, "axes"));
    if (s->is_oscillator && s->n_contacts == SCENE_MAX_CONTACTS)
      return yaml_refuse(r, entry, "one contact too many, expected at most %d", SCENE_MAX_CONTACTS);
    st = pairs ? yaml_pairs_read(r, entry) : yaml_contact_read(r, entry, s->n_contacts);
  }
  return st;
}
