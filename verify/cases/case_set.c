/* case_set.c - assignments PATH=VALUE on top of a case file.
 *   hbm.samples=2048   title=Any text   sweep.omega=[3,20] or 3,20
 *   contacts[0].gap=-1   contacts[0]={...}   contacts=[...]
 * An index one past the last contact appends one. Of rivals (sweep.omega, sweep.frequency) the one assigned last
 * counts. */
#include <string.h>

#include "cases/case_reader.h"

static hc_status unknown_path(case_reader *r, const char *path, size_t length)
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
  message_add(m, "unknown field `");
  message_add_input(m, path, length, 60);
  message_add(m, "`");
  suggestion guess = suggest_path(path, length);
  if (!case_suggest(m, guess, NULL, 0))
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

static hc_status find_in_contacts(case_reader *r, const char *path, size_t length, case_target *t)
{
  const char *stop = path + length, *s = path + 8;
  *t = (case_target){.contact = -1};
  if (s == stop) return HC_OK;
  t->contact = read_index(s, stop, &s);
  if (t->contact < 0) return unknown_path(r, path, length);
  if (s < stop) {
    t->f = *s == '.' ? field_find("contacts", s + 1, (size_t)(stop - s - 1)) : NULL;
    if (!t->f) return unknown_path(r, path, length);
  }
  int last = r->sc.n_contacts < SCENE_MAX_CONTACTS ? r->sc.n_contacts : SCENE_MAX_CONTACTS - 1;
  if (t->contact <= last) return HC_OK;
  message_add(case_blame(r, r->here), "the case has %d contacts, expected an index 0..%d%s", r->sc.n_contacts, last,
              last == r->sc.n_contacts ? " (the last one appends)" : "");
  return HC_BAD_INPUT;
}

hc_status case_find_target(case_reader *r, const char *path, size_t length, case_target *t)
{
  *t = (case_target){.contact = -1};
  if (length >= 8 && !memcmp(path, "contacts", 8) && (length == 8 || path[8] == '['))
    return find_in_contacts(r, path, length, t);
  const char *dot = memchr(path, '.', length);
  const field_section *s = dot ? field_find_section(path, (size_t)(dot - path)) : field_section_at(0);
  const char *name = dot ? dot + 1 : path;
  if (s) t->f = field_find(s->name, name, (size_t)(path + length - name));
  if (t->f && t->f->flags & FIELD_IN_CONTACT) t->f = NULL; /* contacts.gap: of which one? */
  return t->f ? HC_OK : unknown_path(r, path, length);
}

static void append_contact_if_new(case_reader *r, int j)
{
  if (j < r->sc.n_contacts) return;
  field_contact_defaults(&r->sc.contacts[j]);
  r->contact_has[j] = 0;
  memset(r->contact_field_at[j], 0, sizeof r->contact_field_at[j]);
  r->contact_at[j] = r->here;
  r->sc.n_contacts = j + 1;
}

void *case_target_base(case_reader *r, case_target t)
{
  if (t.contact < 0) return &r->sc;
  append_contact_if_new(r, t.contact);
  return &r->sc.contacts[t.contact];
}

void case_target_given(case_reader *r, case_target t)
{
  if (t.contact < 0) {
    r->at[field_index(t.f)] = r->here;
    return;
  }
  r->contact_has[t.contact] |= 1ull << field_index(t.f);
  r->contact_field_at[t.contact][field_index(t.f)] = r->here;
}

void case_drop_rivals(case_reader *r, const field *f)
{
  const field *rival;
  for (int i = 0; (rival = field_rival(f, i)) != NULL; ++i) {
    field_reset(rival, &r->sc);
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
  case_drop_rivals(r, t.f);
  field_split(t.f, text, strlen(text), &v);
  if (!field_store(t.f, base, &v, &why, &bad)) {
    message_add(case_blame(r, r->here), "%s%s", field_path(t.f, t.contact, path), why.text);
    return HC_BAD_INPUT;
  }
  case_target_given(r, t);
  return HC_OK;
}

static hc_status set_contacts(case_reader *r, case_target t, const char *text)
{
  yaml_document_t doc;
  hc_status st = yaml_text_load(r, text, strlen(text), &doc);
  if (st != HC_OK) return st;
  yaml_node_t *root = yaml_document_get_root_node(&doc);
  if (t.contact < 0) {
    st = yaml_scene_contacts(r, &doc, root);
  } else {
    case_target_base(r, t);
    st = yaml_scene_contact(r, &doc, root, t.contact);
  }
  yaml_document_delete(&doc);
  return st;
}

hc_status case_set_apply(case_reader *r, int k)
{
  const char *path = r->set[k - 1], *equals = strchr(path, '=');
  case_target t;
  r->set_now = k;
  r->here = (case_place){.set = k, .line = 1, .column = 1};
  if (!equals) {
    message_add(case_blame(r, r->here), "no `=`, expected PATH=VALUE such as hbm.harmonics=10");
    return HC_BAD_INPUT;
  }
  size_t length = (size_t)(equals - path);
  while (length > 0 && *path == ' ') ++path, --length;
  while (length > 0 && path[length - 1] == ' ') --length;
  hc_status st = case_find_target(r, path, length, &t);
  if (st != HC_OK) return st;
  return t.f ? set_field(r, t, equals + 1) : set_contacts(r, t, equals + 1);
}
