/* case_set.c - assignments PATH=VALUE on top of a case file.
 *   hbm.samples=2048   title=Any text   sweep.omega=[3,20] or 3,20
 *   contacts[0].gap=-1   contacts[joint].gap=-1   contacts[0]={...}   contacts=[...]   forcing[0].amplitude=3
 *   contacts[face].gap=-1, of all contacts that an entry of pairs with that name made: face-1, face-2, ...
 *   structure.damping.modal=0.02   structure.mass=mass.mtx
 * An index one past the last contact appends one. Of rivals (sweep.omega, sweep.frequency) the one assigned last
 * counts. */
#include <string.h>

#include "model/casefile/case_reader.h"
#include "numerics/base/nearest.h"

/* j: the entry of a list that the path begins with, for what is suggested. */
static hc_status unknown_path(case_reader *r, const char *path, size_t length, int j)
{
  message *m = case_blame(r, r->here);
  const field_section *s = field_find_section(path, length);
  if (s) {
    message_add(m, "`%s` is a section, expected one of its fields:", s->name);
    for (int i = 0, n = 0; i < field_count(); ++i)
      if (!strcmp(field_at(i)->section, s->name))
        message_add(m, "%s %s.%s", n++ ? "," : "", s->name, field_at(i)->name);
    return HC_BAD_INPUT;
  }
  if (field_was_removed(m, path, length)) return HC_BAD_INPUT;
  message_add(m, "unknown field %s", QUOTED(path, length));
  if (!case_suggest(m, suggest_path(path, length), NULL, j))
    message_add(m, ", expected a path such as hbm.samples (`hbmcheck describe` lists them)");
  return HC_BAD_INPUT;
}

/* "[12]" at s, with *end behind it; -1 if it is no index of at most four digits. */
static int read_index(const char *s, const char *stop, const char **end)
{
  int index = 0, n = 0;
  if (s == stop || *s++ != '[') return -1;
  for (; s < stop && *s >= '0' && *s <= '9' && n < 4; ++s, ++n) index = 10 * index + (*s - '0');
  if (n == 0 || s == stop || *s != ']') return -1;
  *end = s + 1;
  return index;
}

/* The first contact from number `from` on that an entry of that name has made, NAME-1, NAME-2, ...; -1: none. */
static int find_of_entry(const scene_structure *s, int from, const char *name, size_t length)
{
  for (int j = from; j < s->n_contacts; ++j) {
    const char *own = s->contacts[j].given.name;
    if (strlen(own) <= length + 1 || memcmp(own, name, length) != 0 || own[length] != '-') continue;
    if (!own[length + 1 + strspn(own + length + 1, "0123456789")]) return j;
  }
  return -1;
}

bool case_target_next(const case_reader *r, case_target *t)
{
  if (!t->whole) return false;
  const char *name = r->sc.structure->contacts[t->index].given.name;
  const int next = find_of_entry(r->sc.structure, t->index + 1, name, (size_t)(strrchr(name, '-') - name));
  if (next >= 0) t->index = next;
  return next >= 0;
}

/* "[joint]" at s, up to *end: that contact, or with *whole the first of that entry; *index = -1: no such word. */
static hc_status read_name(case_reader *r, const char *s, const char *stop, const char **end, int *index, bool *whole)
{
  const scene_structure *own = r->sc.structure;
  const char *close = s < stop && *s == '[' ? memchr(s, ']', (size_t)(stop - s)) : NULL;
  *index = -1;
  if (!close || own->is_oscillator || close == s + 1 || (s[1] >= '0' && s[1] <= '9') || s[1] == '-') return HC_OK;
  *end = close + 1;
  const size_t length = (size_t)(close - s - 1);
  *index = structure_contact_named(own, s + 1, length);
  if (*index >= 0) return HC_OK;
  *index = find_of_entry(own, 0, s + 1, length);
  *whole = *index >= 0;
  if (*whole) return HC_OK;
  int near = -1, least = NEAREST_FAR;
  for (int j = 0; j < own->n_contacts; ++j) {
    const char *name = own->contacts[j].given.name;
    const int d = *name ? nearest_distance(s + 1, length, name) : NEAREST_FAR;
    if (d < least) near = j, least = d;
  }
  if (near >= 0)
    return case_refuse(r, r->here, "no contact is named %s, did you mean `%s`?", QUOTED(s + 1, length),
                       own->contacts[near].given.name);
  return case_refuse(r, r->here, "no contact is named %s, expected an index or a name that the case gives",
                     QUOTED(s + 1, length));
}

/* An entry one past the last is new, but a structure's has no field yet: it is to be given as a whole. */
static hc_status check_index(case_reader *r, case_target t)
{
  const int n = t.list == CASE_LOADS ? r->sc.structure->n_loads : scene_contact_count(&r->sc);
  const bool one_more = scene_is_oscillator(&r->sc) ? n < SCENE_MAX_CONTACTS : !t.f;
  if (t.index < n + one_more) return HC_OK;
  return case_refuse(r, r->here, "the case has %d %s, expected an index 0..%d%s", n,
                     t.list == CASE_LOADS ? "loads" : "contacts", n - 1 + one_more,
                     one_more ? " (the last one appends)" : "");
}

/* A list and what follows: nothing, an index or name, a field of that entry. */
static hc_status find_in_list(case_reader *r, const char *path, size_t length, case_list list, case_target *t)
{
  const char *stop = path + length, *s = path + (list == CASE_LOADS ? 7 : 8);
  *t = (case_target){.list = list, .index = -1};
  if (s == stop) return HC_OK;
  const char *bracket = s;
  t->index = read_index(bracket, stop, &s);
  hc_status st = HC_OK;
  if (t->index < 0 && list == CASE_CONTACTS) st = read_name(r, bracket, stop, &s, &t->index, &t->whole);
  if (st != HC_OK) return st;
  if (t->index < 0) return unknown_path(r, path, length, 0);
  if (s < stop) {
    const char *section = list == CASE_LOADS ? "forcing[]" : "contacts";
    t->f = *s == '.' ? field_find(section, s + 1, (size_t)(stop - s - 1)) : NULL;
    if (!t->f) return unknown_path(r, path, length, t->index);
  }
  if (t->whole && (!t->f || t->f == field_named("contacts", "name"))) {
    return case_refuse(r, r->here, "%s is several contacts, expected a field of them, or one by its own name or number",
                       QUOTED(path, length));
  }
  return check_index(r, *t);
}

/* A structure has no field of an oscillator, and an oscillator none of a structure. */
static hc_status check_kind(case_reader *r, const field *f, const char *path, size_t length)
{
  if (field_is_of_case(f, &r->sc)) return HC_OK;
  if (!scene_is_oscillator(&r->sc))
    return case_refuse(r, r->here, "%s is an oscillator's, and the case has a structure, expected %s.%s",
                       QUOTED(path, length), *f->section == 'f' ? "forcing[0]" : "structure", f->name);
  return case_refuse(r, r->here, "%s is a structure's, and the case has an oscillator, expected a field of that",
                     QUOTED(path, length));
}

static bool begins_list(const char *path, size_t length, const char *word)
{
  const size_t n = strlen(word);
  return length >= n && !memcmp(path, word, n) && (length == n || path[n] == '[');
}

hc_status case_find_target(case_reader *r, const char *path, size_t length, case_target *t)
{
  *t = (case_target){.index = -1};
  hc_status st = HC_OK;
  if (begins_list(path, length, "contacts")) {
    st = find_in_list(r, path, length, CASE_CONTACTS, t);
  } else if (!scene_is_oscillator(&r->sc) && begins_list(path, length, "forcing")) {
    st = find_in_list(r, path, length, CASE_LOADS, t);
  } else {
    const char *dot = memchr(path, '.', length);
    const field_section *s = dot ? field_find_section(path, (size_t)(dot - path)) : field_section_at(0);
    const char *name = dot ? dot + 1 : path;
    if (s) t->f = field_find(s->name, name, (size_t)(path + length - name));
    if (t->f && field_is_in_list(t->f)) t->f = NULL; /* contacts.gap: of which one? */
    if (!t->f) st = unknown_path(r, path, length, 0);
  }
  return st == HC_OK && t->f ? check_kind(r, t->f, path, length) : st;
}

hc_status case_own_structure(case_reader *r)
{
  if (r->owns_structure) return HC_OK;
  scene_structure *own = structure_copy(r->sc.structure);
  if (!own) return case_out_of_memory(r);
  r->sc.structure = own;
  r->owns_structure = true;
  return HC_OK;
}

static bool is_in_structure(case_target t)
{
  return t.list != CASE_NO_LIST || t.f->flags & (FIELD_STRUCTURE | FIELD_OSCILLATOR);
}

void *case_target_base(case_reader *r, case_target t)
{
  if (!is_in_structure(t)) return &r->sc;
  if (case_own_structure(r) != HC_OK) return NULL;
  scene_structure *s = r->sc.structure;
  if (t.list == CASE_NO_LIST) return s;
  if (t.list == CASE_LOADS) return &s->loads[t.index];
  if (t.index < s->n_contacts) return &s->contacts[t.index].given;
  structure_contact *appended = structure_add_contact(s);
  if (!appended) return case_out_of_memory(r), NULL;
  field_contact_defaults(&appended->given);
  appended->place = r->here;
  r->contact_has[t.index] = 0;
  memset(r->contact_field_at[t.index], 0, sizeof r->contact_field_at[t.index]);
  return &appended->given;
}

void case_target_given(case_reader *r, case_target t)
{
  scene_structure *s = r->sc.structure;
  if (is_in_structure(t)) s->place = r->here; /* what it is wrong about as a whole, it is from here on */
  if (t.list == CASE_NO_LIST) r->at[field_index(t.f)] = r->here;
  if (t.list == CASE_LOADS) s->loads[t.index].place = r->here;
  if (t.list == CASE_CONTACTS && s->is_oscillator) {
    r->contact_has[t.index] |= case_field_bit(t.f);
    r->contact_field_at[t.index][field_index(t.f)] = r->here;
  } else if (t.list == CASE_CONTACTS) {
    structure_contact *c = &s->contacts[t.index];
    c->place = r->here;
    if (t.whole && t.f == field_named("contacts", "tangential_stiffness") && c->area > 0) c->given.law.kt *= c->area;
    if (t.whole && t.f == field_named("contacts", "normal_stiffness") && c->area > 0) c->given.law.kn *= c->area;
  }
  if (!(t.f->flags & FIELD_IN_STRUCTURE)) return;
  structure_damping_given(s, t.f);
  s->damping.place = r->here;
}

void case_drop_rivals(case_reader *r, const field *f, void *base)
{
  const field *rival;
  for (int i = 0; (rival = field_rival(f, i)) != NULL; ++i) {
    field_reset(rival, base);
    r->at[field_index(rival)] = (case_place){0};
  }
}

static hc_status set_field(case_reader *r, case_target t, const char *text)
{
  char path[FIELD_PATH], why_text[512];
  field_value v;
  message why;
  int bad;
  message_start(&why, why_text, sizeof why_text);
  void *base = case_target_base(r, t);
  if (!base) return HC_NO_MEMORY;
  case_drop_rivals(r, t.f, base);
  field_split(t.f, text, strlen(text), &v);
  if (!field_store(t.f, base, &v, &why, &bad))
    return case_refuse(r, r->here, "%s%s", field_path(t.f, t.index, path), why.text);
  case_target_given(r, t);
  return HC_OK;
}

/* A list of contacts or loads, or an entry of one. */
static hc_status read_list(case_reader *r, case_target t, const yaml_node_t *node)
{
  if (t.list == CASE_LOADS) return t.index < 0 ? yaml_loads_read(r, node) : yaml_load_read(r, node, t.index);
  return t.index < 0 ? yaml_contacts_read(r, node) : yaml_contact_read(r, node, t.index);
}

/* A field stored by its kind alone; the others have forms of their own. */
static bool is_plain(const field *f) { return f && f->kind != FIELD_PART && !(f->flags & FIELD_IN_STRUCTURE); }

hc_status case_target_read(case_reader *r, case_target t, const yaml_node_t *node)
{
  if (is_plain(t.f)) {
    void *base = case_target_base(r, t);
    if (!base) return HC_NO_MEMORY;
    case_drop_rivals(r, t.f, base);
    const hc_status st = yaml_scene_value(r, t.f, t.index, base, node);
    if (st == HC_OK) case_target_given(r, t);
    return st;
  }
  hc_status st = case_own_structure(r);
  if (st != HC_OK) return st;
  if (t.f && yaml_is_law_part(t.f) && !case_target_base(r, t)) return HC_NO_MEMORY;
  r->sc.structure->place = r->here;
  if (!t.f) return read_list(r, t, node);
  if (t.list == CASE_NO_LIST) {
    st = yaml_structure_part(r, t.f, node);
    return st == HC_OK ? yaml_rests_read(r) : st;
  }
  st = yaml_entry_part(r, t.f, t.index, node);
  if (st == HC_OK) case_target_given(r, t);
  return st;
}

static hc_status set_document(case_reader *r, case_target t, const char *text)
{
  const yaml_document_t around = r->doc; /* a study's, which is still being read */
  hc_status st = yaml_text_load(r, text, strlen(text));
  if (st == HC_OK) {
    st = case_target_read(r, t, yaml_document_get_root_node(&r->doc));
    yaml_document_delete(&r->doc);
  }
  r->doc = around;
  return st;
}

hc_status case_set_apply(case_reader *r, int k)
{
  const char *path = r->set[k - 1], *equals = strchr(path, '=');
  case_target t;
  r->set_now = k;
  r->here = (case_place){.set = k, .line = 1, .column = 1};
  if (!equals) return case_refuse(r, r->here, "no `=`, expected PATH=VALUE such as hbm.harmonics=10");
  size_t length = (size_t)(equals - path);
  while (length > 0 && *path == ' ') ++path, --length;
  while (length > 0 && path[length - 1] == ' ') --length;
  hc_status st = case_find_target(r, path, length, &t);
  if (st != HC_OK) return st;
  do st = is_plain(t.f) ? set_field(r, t, equals + 1) : set_document(r, t, equals + 1);
  while (st == HC_OK && case_target_next(r, &t));
  return st;
}
