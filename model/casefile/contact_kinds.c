/* contact_kinds.c - contacts whose law the case names: coefficients and points as they are read, and what
 * they need. What they are in the model: contact_model.c. */
#include <math.h>
#include <string.h>

#include "model/casefile/case_reader.h"

bool field_is_echoed(const field *f, const scene_contact *c)
{
  if (!strcmp(f->name, "law")) return c->kind != CONTACT_KINKED;
  if (!strncmp(f->name, "coefficients.", 13)) return *(const double *)field_look(f, c) != 0;
  return field_is_of_law(f, c);
}

/* ---- reading -------------------------------------------------------------------------------------- */

static hc_status read_coefficients(case_reader *r, const field *f, int j, scene_contact *c, const yaml_node_t *node)
{
  char path[FIELD_PATH], name[FIELD_PATH];
  bool seen[CONTACT_POWERS] = {false};
  if (node->type != YAML_MAPPING_NODE || yaml_keys(node) == 0)
    return yaml_refuse(r, node, "%s is %s, expected %s", field_path(f, j, path),
                       node->type == YAML_MAPPING_NODE ? "empty" : yaml_node_what(node), f->expects);
  memset(c->law.power, 0, sizeof c->law.power);
  for (int i = 0; i < yaml_keys(node); ++i) {
    const yaml_node_t *key = yaml_key(r, node, i);
    hc_status st = yaml_check_key(r, key);
    if (st != HC_OK) return st;
    snprintf(name, sizeof name, "coefficients.%.20s", yaml_node_text(key));
    const field *one = field_named("contacts", name);
    if (!one)
      return yaml_refuse(r, key, "%s has the power %s, expected one of 2..9 (a linear spring is part of the stiffness)",
                         field_path(f, j, path), YAML_QUOTED(key));
    bool *before = &seen[(double *)field_place(one, c) - c->law.power];
    if (*before) return yaml_refuse(r, key, "%s gives a power twice, expected each once", field_path(f, j, path));
    *before = true;
    if ((st = yaml_scene_value(r, one, j, c, yaml_value(r, node, i))) != HC_OK) return st;
    r->at[field_index(one)] = yaml_place(r, yaml_value(r, node, i));
  }
  return HC_OK;
}

static hc_status read_points(case_reader *r, const field *f, int j, scene_contact *c, const yaml_node_t *node)
{
  char path[FIELD_PATH];
  const int n = node->type == YAML_SEQUENCE_NODE ? yaml_length(node) : -1;
  field_path(f, j, path);
  if (n < 2 || n > SCENE_MOST_POINTS)
    return yaml_refuse(r, node, n < 0 ? "%s is %s, expected %s" : "%s is %s of too few or too many, expected %s", path,
                       yaml_node_what(node), f->expects);
  c->n_points = n;
  for (int i = 0; i < n; ++i) {
    const yaml_node_t *point = yaml_entry(r, node, i);
    double *at = c->points[i];
    if (point->type != YAML_SEQUENCE_NODE || yaml_length(point) != 2)
      return yaml_refuse(r, point, "%s has %s as a point, expected [DISTANCE, FORCE]", path, yaml_node_what(point));
    for (int k = 0; k < 2; ++k) {
      const hc_status st = yaml_number(r, yaml_entry(r, point, k), path, &at[k]);
      if (st != HC_OK) return st;
    }
    if (i == 0) continue;
    if (!(at[0] > at[-2]))
      return yaml_refuse(r, point, "%s has the distance %.10g behind %.10g, expected ascending ones", path, at[0],
                         at[-2]);
    if (!isfinite((at[1] - at[-1]) / (at[0] - at[-2])))
      return yaml_refuse(r, point, "%s has a slope too large to be held, expected a finite one", path);
  }
  return HC_OK;
}

bool yaml_is_law_part(const field *f)
{
  return f->kind == FIELD_PART && (!strcmp(f->name, "coefficients") || !strcmp(f->name, "points"));
}

hc_status yaml_law_part(case_reader *r, const field *f, int j, const yaml_node_t *node)
{
  scene_contact *c = &r->sc.structure->contacts[j].given;
  return (*f->name == 'c' ? read_coefficients : read_points)(r, f, j, c, node);
}

/* Whether contact c lacks a field that its law needs: a number that must be > 0, or points. */
static bool is_missing(const field *f, const scene_contact *c)
{
  if (!(f->flags & FIELD_IN_CONTACT) || !field_is_of_law(f, c)) return false;
  if (f->kind == FIELD_REAL && f->flags & FIELD_OPEN) return !(*(const double *)field_look(f, c) > f->low);
  return !strcmp(f->name, "points") && c->n_points < 2;
}

static bool has_field(unsigned long long has, const char *name)
{
  return has & case_field_bit(field_named("contacts", name));
}

unsigned long long case_contact_given(const case_reader *r)
{
  unsigned long long has = 0;
  for (int i = 0; i < field_count(); ++i)
    if (field_at(i)->flags & FIELD_IN_CONTACT && case_given(r, field_at(i))) has |= case_field_bit(field_at(i));
  return has;
}

bool case_contact_needs(const scene_contact *c, unsigned long long has, const field *f)
{
  const bool slides = has_field(has, "preload") && !has_field(has, "normal_stiffness") && c->angle_deg == 0;
  if (!(f->flags & FIELD_IN_CONTACT) || f->flags & FIELD_STRUCTURE || f->fallback || has & case_field_bit(f))
    return false;
  if (!field_is_of_law(f, c)) return false;
  if (f->along && !strcmp(f->along, "tangent")) return fabs(c->angle_deg) != 90;
  return !(slides && (f == field_named("contacts", "angle_deg") || f == field_named("contacts", "normal_stiffness")));
}

hc_status case_check_law_given(case_reader *r, int j, const scene_contact *c, case_place place)
{
  for (int i = 0; i < field_count(); ++i) {
    if (!is_missing(field_at(i), c)) continue;
    message *m = case_blame(r, place);
    message_add(m, "contacts[%d] is a %s without `%s`, expected ", j, field_named("contacts", "law")->choices[c->kind],
                field_at(i)->name);
    field_expected(field_at(i), m);
    return HC_BAD_INPUT;
  }
  return HC_OK;
}

hc_status case_check_law(case_reader *r, int j, const scene_contact *c, case_place place)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (!(f->flags & FIELD_IN_CONTACT) || !case_given(r, f) || field_is_of_law(f, c)) continue;
    const field *law = field_named("contacts", "law");
    message *m = case_blame(r, r->at[i]);
    message_add(m, "%s in `contacts[%d]`, whose law is %s, expected one of", f->name, j, law->choices[c->kind]);
    for (int k = 0, n = 0; k < field_count(); ++k)
      if (field_at(k)->flags & FIELD_IN_CONTACT && field_is_of_law(field_at(k), c) && !strchr(field_at(k)->name, '.'))
        message_add(m, "%s %s", n++ ? "," : "", field_at(k)->name);
    return HC_BAD_INPUT;
  }
  return case_check_law_given(r, j, c, place);
}
