/* case_echo.c - the resolved scene as a case file, one field a line, through the table of fields. */
#include <stdlib.h>
#include <string.h>

#include "model/casefile/case_values.h"
#include "numerics/base/number.h"
#include "numerics/norm.h"

/* ---- values ---- */

static int choice_at(const void *at)
{
  int i;
  memcpy(&i, at, sizeof i);
  return i;
}

void case_write_text(const char *text, FILE *to)
{
  putc('"', to);
  for (; *text; ++text) {
    if (*text == '"' || *text == '\\') putc('\\', to);
    putc(*text, to);
  }
  putc('"', to);
}

static void write_number(double x, FILE *to)
{
  char text[NUMBER_TEXT];
  fputs(number_write(x, text), to);
}

/* As it was written: of the numbers that a scale of 2 pi makes x, to the bit, one of 15 digits where there is one (125,
 * not 124.99999999999999), else the quotient (tests/cases/test_echo.c: random scenes). */
static double unscaled(double x, double scale)
{
  char text[NUMBER_TEXT];
  if (scale == 0) return x;
  snprintf(text, sizeof text, "%.15g", x / scale);
  const double rounded = strtod(text, NULL);
  return scale * rounded == x ? rounded : x / scale;
}

/* Entries v[stride i]. */
static void write_list(const double *v, int n, size_t stride, double scale, FILE *to)
{
  for (int i = 0; i < n; ++i) {
    fputs(i == 0 ? "[" : ", ", to);
    write_number(unscaled(v[stride * (size_t)i], scale), to);
  }
  putc(']', to);
}

void field_write(const field *f, const void *base, FILE *to)
{
  const void *at = field_look(f, base);
  switch (f->kind) {
  case FIELD_REAL: write_number(*(const double *)at, to); return;
  case FIELD_INTEGER:
    if (f->flags & FIELD_AUTO && *(const int *)at == HBM_AUTO) fputs("auto", to);
    else fprintf(to, "%d", *(const int *)at);
    return;
  case FIELD_FLAG: fputs(*(const bool *)at ? "true" : "false", to); return;
  case FIELD_CHOICE: fputs(f->choices[choice_at(at)], to); return;
  case FIELD_TEXT: case_write_text(at, to); return;
  case FIELD_PAIR: write_list(at, 2, 1, f->scale, to); return;
  case FIELD_PART: return;
  default: write_list(((const number_list *)at)->v, ((const number_list *)at)->n, 1, f->scale, to); return;
  }
}

/* ---- a structure ---- */

/* A diagonal as such, else row by row. */
static void write_matrix(const char *name, const double *v, int n, FILE *to)
{
  const size_t rows = (size_t)n;
  const bool diagonal = structure_is_diagonal(v, n);
  fprintf(to, "  %s: ", name);
  if (diagonal) write_list(v, n, rows + 1, 0, to);
  for (int i = 0; i < n && !diagonal; ++i) {
    fputs(i == 0 ? "[\n    " : ",\n    ", to);
    write_list(v + i, n, rows, 0, to);
  }
  fputs(diagonal ? "\n" : "]\n", to);
}

static void write_dof(const scene_structure *s, int dof, FILE *to)
{
  if (s->names) case_write_text(s->names[dof], to);
  else fprintf(to, "%d", dof + 1);
}

static void write_direction(const scene_structure *s, const double *direction, FILE *to)
{
  const char *before = "{";
  for (int i = 0; i < s->n; ++i) {
    if (direction[i] == 0) continue;
    fputs(before, to);
    write_dof(s, i, to);
    fputs(": ", to);
    write_number(direction[i], to);
    before = ", ";
  }
  putc('}', to);
}

/* The node that a direction was given by, or NULL. */
static const structure_node *node_of(const scene_structure *s, bool by_node, const double *direction)
{
  int dof = 0;
  while (direction[dof] == 0) ++dof;
  return by_node ? structure_node_of(s, dof) : NULL;
}

void case_write_damping(const scene_structure *s, int n, FILE *to)
{
  if (s->how == STRUCTURE_DAMPING_RAYLEIGH) {
    fputs("{rayleigh: ", to);
    write_list(s->rayleigh, 2, 1, 0, to);
  } else {
    fputs("{modal: ", to);
    if (s->how == STRUCTURE_DAMPING_MODAL) write_number(s->modal, to);
    else write_list(s->ratios, n, 1, 0, to);
  }
  putc('}', to);
}

void case_write_reduction(double error, double at, FILE *to)
{
  fputs("reduction: {error: ", to);
  write_number(error, to);
  fputs(", at: ", to);
  write_number(at, to);
  putc('}', to);
}

static void write_structure(const scene_structure *s, FILE *to)
{
  fputs("structure:\n", to);
  write_matrix("mass", s->mass.v, s->n, to);
  write_matrix("stiffness", s->stiffness.v, s->n, to);
  if (s->how == STRUCTURE_DAMPING_MATRIX) write_matrix("damping", s->damping.v, s->n, to);
  else {
    fputs("  damping: ", to);
    case_write_damping(s, s->n, to);
    putc('\n', to);
  }
  for (int i = 0; s->names && i < s->n; ++i) {
    fputs(i == 0 ? "  names: [" : ", ", to);
    case_write_text(s->names[i], to);
  }
  if (s->names) fputs("]\n", to);
  for (int i = 0; i < s->n_nodes; ++i) {
    fputs(i == 0 ? "  nodes: [[" : ", [", to);
    write_dof(s, s->nodes[i].dof, to);
    fprintf(to, ", %d, %c]", s->nodes[i].node, s->nodes[i].direction);
  }
  if (s->n_nodes > 0) fputs("]\n", to);
  if (s->reduction_error > 0) {
    fputs("  ", to);
    case_write_reduction(s->reduction_error, s->reduction_at, to);
    putc('\n', to);
  }
  for (int i = 0; i < s->n_responses; ++i) {
    fputs(i == 0 ? "response: [" : ", ", to);
    const structure_response *response = &s->responses[i];
    const structure_node *node = node_of(s, response->by_node, response->direction);
    if (node) fprintf(to, "{node: %d, direction: %c}", node->node, node->direction);
    else write_direction(s, response->direction, to);
  }
  if (s->n_responses > 0) fputs("]\n", to);
}

/* Has the contact that direction? One given by its angle has a tangent and a normal. */
static bool has_direction(const scene_structure *s, const structure_contact *c, const char *along)
{
  if (c->by_angle) return strcmp(along, "tangent_2") != 0;
  const field *f = field_named("contacts", along);
  return !is_zero(s->n, field_direction(f, c));
}

bool case_contact_field_counts(const scene_structure *s, const structure_contact *c, const field *f)
{
  const bool preload = !strcmp(f->name, "preload");
  if (!field_is_echoed(f, &c->given) || (s->is_oscillator && f->flags & FIELD_STRUCTURE)) return false;
  if (!strcmp(f->name, "angle_deg")) return c->by_angle;
  if (!strcmp(f->name, "name")) return *c->given.name;
  if (f->along && !has_direction(s, c, f->along)) return false;
  return !f->group || !has_direction(s, c, "normal") || preload == (c->given.preload > 0);
}

static void begin_line(const char **before, const field *f, FILE *to)
{
  fprintf(to, "%s%s: ", *before, f->name);
  *before = "    ";
}

static void write_coefficients(const scene_contact *c, FILE *to)
{
  const char *before = "{";
  for (int i = 0; i < CONTACT_POWERS; ++i) {
    if (c->law.power[i] == 0 && !(i == 0 && contact_degree(&c->law) == 0)) continue;
    fprintf(to, "%s%d: ", before, i + CONTACT_LEAST_POWER);
    write_number(c->law.power[i], to);
    before = ", ";
  }
  putc('}', to);
}

void case_write_points(const scene_contact *c, FILE *to)
{
  for (int i = 0; i < c->n_points; ++i) {
    fputs(i ? ", " : "[", to);
    write_list(c->points[i], 2, 1, 0, to);
  }
  fputs("]", to);
}

/* An entry of a list: directions that are not 0, then scalars in base. c NULL: a load. */
static void write_entry(const char *section, const scene_structure *s, const structure_contact *c, const void *entry,
                        const void *base, FILE *to)
{
  const char *before = "  - ";
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    const bool is_direction = f->kind == FIELD_PART && f->size > 0 && strcmp(f->name, "dof") != 0;
    if (c && !field_is_of_law(f, &c->given)) continue;
    if (!is_direction || strcmp(f->section, section) || is_zero(s->n, field_direction(f, entry))) continue;
    const structure_node *node =
        c ? NULL : node_of(s, ((const structure_load *)entry)->by_node, field_direction(f, entry));
    if (node) fprintf(to, "%snode: %d\n", before, node->node), before = "    ";
    begin_line(&before, f, to);
    if (node) putc(node->direction, to);
    else write_direction(s, field_direction(f, entry), to);
    putc('\n', to);
  }
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (strcmp(f->section, section)) continue;
    if (f->kind == FIELD_PART) {
      const bool points = !strcmp(f->name, "points");
      if (!(points || !strcmp(f->name, "coefficients")) || !field_is_of_law(f, base)) continue;
      begin_line(&before, f, to);
      (points ? case_write_points : write_coefficients)(base, to);
      putc('\n', to);
      continue;
    }
    if (f->flags & FIELD_NO_ECHO || (c && !case_contact_field_counts(s, c, f))) continue;
    begin_line(&before, f, to);
    field_write(f, base, to);
    putc('\n', to);
  }
}

static void begin_list(const char *name, int n, FILE *to) { fprintf(to, n > 0 ? "%s:\n" : "%s: []\n", name); }

static void write_loads(const scene_structure *s, FILE *to)
{
  begin_list("forcing", s->n_loads, to);
  for (int j = 0; s->loads && j < s->n_loads; ++j) write_entry("forcing[]", s, NULL, &s->loads[j], &s->loads[j], to);
}

static void write_contacts(const scene_structure *s, FILE *to)
{
  for (const char *note = s->notes; note && *note; note = strchr(note, '\n') + 1)
    fprintf(to, "# %.*s\n", (int)strcspn(note, "\n"), note);
  begin_list("contacts", s->n_contacts, to);
  for (int j = 0; s->contacts && j < s->n_contacts; ++j)
    write_entry("contacts", s, &s->contacts[j], &s->contacts[j], &s->contacts[j].given, to);
}

/* ---- the scene ---- */

static bool choices_are_known(const scene *sc)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (f->kind != FIELD_CHOICE || f->flags & FIELD_ELSEWHERE) continue;
    int n = 0, value = *(const int *)field_look(f, sc);
    while (f->choices[n]) ++n;
    if (value < 0 || value >= n) return false;
  }
  return !scene_is_oscillator(sc) || scene_contact_count(sc) <= SCENE_MAX_CONTACTS;
}

/* Whether the field is written. Where one of two fields replaces the other, it is the one that was given: the sweep's,
 * a list that is not empty, else the other. */
bool case_field_counts(const field *f, const scene *sc)
{
  if (f->flags & (FIELD_NO_ECHO | FIELD_STRUCTURE | FIELD_IN_CONTACT) || !field_is_of_case(f, sc)) return false;
  if (!strcmp(f->section, "base")) return *(const double *)field_look(f, sc) != 0;
  if (!strcmp(f->section, "forcing")) return !scene_base_moves(sc);
  if (f->in_cycles) return (f->scale != 0) == sc->in_cycles;
  if (f->kind == FIELD_REALS || f->kind == FIELD_INTEGERS) return ((const number_list *)field_look(f, sc))->n > 0;
  const field *rival;
  for (int i = 0; (rival = field_rival(f, i)) != NULL; ++i)
    if (case_field_counts(rival, sc)) return false;
  return true;
}

static void write_section(const field_section *s, const scene *sc, FILE *to)
{
  bool begun = !*s->name;
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    if (strcmp(f->section, s->name) || !case_field_counts(f, sc)) continue;
    if (!begun) fprintf(to, "%s:\n", s->name);
    if (!begun && !scene_is_oscillator(sc) && sc->structure->base && !strcmp(s->name, "base")) {
      fputs("  direction: ", to);
      write_direction(sc->structure, sc->structure->base, to);
      putc('\n', to);
    }
    begun = true;
    fprintf(to, "%s%s: ", *s->name ? "  " : "", f->name);
    field_write(f, field_base(f, sc), to);
    putc('\n', to);
  }
}

hc_status case_echo(const scene *sc, FILE *to)
{
  if (!choices_are_known(sc)) return HC_BAD_INPUT;
  const field_section *s;
  for (int i = 0; (s = field_section_at(i)) != NULL; ++i) {
    const bool is_structure = !scene_is_oscillator(sc); /* responses stand with `structure` */
    if (is_structure && !strcmp(s->name, "structure")) write_structure(sc->structure, to);
    else if (is_structure && !strcmp(s->name, "forcing[]")) write_loads(sc->structure, to);
    else if (!strcmp(s->name, "contacts")) write_contacts(sc->structure, to);
    else write_section(s, sc, to);
  }
  return ferror(to) ? HC_IO : HC_OK;
}
