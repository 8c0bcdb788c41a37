/* case_echo.c - the resolved scene as a case file, one field a line, through the table of fields. */
#include <string.h>

#include "casefile/case_values.h"
#include "casefile/echo_structure.h"

static bool choices_are_known(const scene *sc)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (f->kind != FIELD_CHOICE || f->flags & FIELD_ELSEWHERE) continue;
    int n = 0, value = *(const int *)field_look(f, sc);
    while (f->choices[n]) ++n;
    if (value < 0 || value >= n) return false;
  }
  return sc->n_contacts >= 0 && sc->n_contacts <= SCENE_MAX_CONTACTS;
}

/* Of rivals the one in force is written: of those that give the sweep the one that did; else the list if it is not
 * empty (compare.omega), else the other (compare.points). */
bool case_field_counts(const field *f, const scene *sc)
{
  if (f->flags & (FIELD_NO_ECHO | FIELD_STRUCTURE | FIELD_IN_CONTACT)) return false; /* those have ways of their own */
  if (f->in_cycles) return (f->scale != 0) == sc->in_cycles;
  if (f->kind == FIELD_REALS || f->kind == FIELD_INTEGERS) return ((const number_list *)field_look(f, sc))->n > 0;
  const field *rival;
  for (int i = 0; (rival = field_rival(f, i)) != NULL; ++i)
    if (case_field_counts(rival, sc)) return false;
  return true;
}

static void write_contact(const scene_contact *c, FILE *to)
{
  const char *before = "  - ";
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (!(f->flags & FIELD_IN_CONTACT) || f->flags & FIELD_STRUCTURE) continue;
    fprintf(to, "%s%s: ", before, f->name);
    field_write(f, c, to);
    putc('\n', to);
    before = "    ";
  }
}

static void write_section(const field_section *s, const scene *sc, FILE *to)
{
  bool begun = !*s->name;
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (strcmp(f->section, s->name) || !case_field_counts(f, sc)) continue;
    if (!begun) fprintf(to, "%s:\n", s->name);
    begun = true;
    fprintf(to, "%s%s: ", *s->name ? "  " : "", f->name);
    field_write(f, sc, to);
    putc('\n', to);
  }
}

hc_status case_echo(const scene *sc, FILE *to)
{
  if (!choices_are_known(sc)) return HC_BAD_INPUT;
  const field_section *s;
  for (int i = 0; (s = field_section_at(i)) != NULL; ++i) {
    if (sc->structure && echo_structure(sc->structure, s->name, to)) continue;
    if (strcmp(s->name, "contacts")) {
      write_section(s, sc, to);
      continue;
    }
    fprintf(to, sc->n_contacts > 0 ? "contacts:\n" : "contacts: []\n");
    for (int j = 0; j < sc->n_contacts; ++j) write_contact(&sc->contacts[j], to);
  }
  return ferror(to) ? HC_IO : HC_OK;
}
