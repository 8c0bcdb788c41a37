/* echo_structure.c - see echo_structure.h. Matrices stand in the case itself, whatever file they came from. */
#include "casefile/echo_structure.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "casefile/fields.h"

static void write_number(double x, FILE *to)
{
  char text[NUMBER_TEXT];
  fputs(number_write(x, text), to);
}

static void write_text(const char *text, FILE *to)
{
  putc('"', to);
  for (; *text; ++text) {
    if (*text == '"' || *text == '\\') putc('\\', to);
    putc(*text, to);
  }
  putc('"', to);
}

static void write_numbers(const double *v, int n, size_t stride, FILE *to)
{
  for (int i = 0; i < n; ++i) {
    fputs(i == 0 ? "[" : ", ", to);
    write_number(v[stride * (size_t)i], to);
  }
  putc(']', to);
}

/* A diagonal as such, else row by row. */
static void write_matrix(const char *name, const double *v, int n, FILE *to)
{
  const size_t rows = (size_t)n;
  bool diagonal = true;
  for (size_t i = 0; i < rows * rows && diagonal; ++i) diagonal = v[i] == 0 || i % (rows + 1) == 0;
  fprintf(to, "  %s: ", name);
  if (diagonal) write_numbers(v, n, rows + 1, to);
  for (int i = 0; i < n && !diagonal; ++i) {
    fputs(i == 0 ? "[\n    " : ",\n    ", to);
    write_numbers(v + i, n, rows, to);
  }
  fputs(diagonal ? "\n" : "]\n", to);
}

static void write_dof(const scene_structure *s, int dof, FILE *to)
{
  if (s->names) write_text(s->names[dof], to);
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

static void write_damping(const scene_structure *s, FILE *to)
{
  switch (s->how) {
  case STRUCTURE_DAMPING_MATRIX: write_matrix("damping", s->damping.v, s->n, to); return;
  case STRUCTURE_DAMPING_RAYLEIGH:
    fputs("  damping: {rayleigh: ", to);
    write_numbers(s->rayleigh, 2, 1, to);
    break;
  case STRUCTURE_DAMPING_MODAL:
    fputs("  damping: {modal: ", to);
    write_number(s->modal, to);
    break;
  case STRUCTURE_DAMPING_MODES:
    fputs("  damping: {modal: ", to);
    write_numbers(s->ratios, s->n, 1, to);
    break;
  }
  fputs("}\n", to);
}

static void write_structure(const scene_structure *s, FILE *to)
{
  fputs("structure:\n", to);
  write_matrix("mass", s->mass.v, s->n, to);
  write_matrix("stiffness", s->stiffness.v, s->n, to);
  write_damping(s, to);
  for (int i = 0; s->names && i < s->n; ++i) {
    fputs(i == 0 ? "  names: [" : ", ", to);
    write_text(s->names[i], to);
  }
  if (s->names) fputs("]\n", to);
  for (int i = 0; i < s->n_nodes; ++i) {
    fputs(i == 0 ? "  nodes: [[" : ", [", to);
    write_dof(s, s->nodes[i].dof, to);
    fprintf(to, ", %d, %c]", s->nodes[i].node, s->nodes[i].direction);
  }
  if (s->n_nodes > 0) fputs("]\n", to);
  for (int i = 0; i < s->n_responses; ++i) {
    fputs(i == 0 ? "response: [" : ", ", to);
    write_direction(s, s->responses[i].direction, to);
  }
  if (s->n_responses > 0) fputs("]\n", to);
}

/* The scalars of an entry through the table of fields, but those that say nothing of it. */
static void write_scalars(const char *section, const void *base, const char *const *left_out, FILE *to)
{
  for (int i = 0; i < field_count(); ++i) {
    const field *f = field_at(i);
    bool out = strcmp(f->section, section) != 0 || f->kind == FIELD_PART;
    for (int k = 0; left_out[k] && !out; ++k) out = !strcmp(f->name, left_out[k]);
    if (out) continue;
    fprintf(to, "    %s: ", f->name);
    field_write(f, base, to);
    putc('\n', to);
  }
}

static void write_loads(const scene_structure *s, FILE *to)
{
  static const char *const nothing[] = {NULL};
  fputs(s->n_loads > 0 ? "forcing:\n" : "forcing: []\n", to);
  for (int i = 0; i < s->n_loads; ++i) {
    fputs("  - direction: ", to);
    write_direction(s, s->loads[i].direction, to);
    putc('\n', to);
    write_scalars("forcing[]", &s->loads[i], nothing, to);
  }
}

static bool is_zero(const double *direction, int n)
{
  for (int i = 0; i < n; ++i)
    if (direction[i] != 0) return false;
  return true;
}

static void write_contact(const scene_structure *s, const structure_contact *c, FILE *to)
{
  const char *left_out[10];
  const char *before = "  - ";
  const bool tangent = !is_zero(c->tangent, s->n), normal = !is_zero(c->normal, s->n);
  int n = 0;
  if (!c->by_angle) left_out[n++] = "angle_deg";
  if (!*c->given.name) left_out[n++] = "name";
  if (!c->by_angle && !tangent) left_out[n++] = "tangential_stiffness", left_out[n++] = "friction";
  if (is_zero(c->tangent_2, s->n)) left_out[n++] = "limit";
  if (!c->by_angle && !normal) left_out[n++] = "normal_stiffness", left_out[n++] = "gap";
  else left_out[n++] = c->given.preload > 0 ? "gap" : "preload";
  left_out[n] = NULL;
  if (tangent) {
    fprintf(to, "%stangent: ", before);
    write_direction(s, c->tangent, to);
    putc('\n', to);
    before = "    ";
  }
  if (!is_zero(c->tangent_2, s->n)) {
    fprintf(to, "%stangent_2: ", before);
    write_direction(s, c->tangent_2, to);
    putc('\n', to);
  }
  if (normal) {
    fprintf(to, "%snormal: ", before);
    write_direction(s, c->normal, to);
    putc('\n', to);
  }
  if (c->by_angle) fputs("  -\n", to);
  write_scalars("contacts", &c->given, left_out, to);
}

bool echo_structure(const scene_structure *s, const char *section, FILE *to)
{
  const bool contacts = !strcmp(section, "contacts");
  if (!strcmp(section, "structure")) write_structure(s, to);
  else if (!strcmp(section, "forcing[]")) write_loads(s, to);
  else if (contacts) fputs(s->n_contacts > 0 ? "contacts:\n" : "contacts: []\n", to);
  else return !strcmp(section, "oscillator") || !strcmp(section, "forcing");
  for (int j = 0; j < s->n_contacts && contacts; ++j) write_contact(s, &s->contacts[j], to);
  return true;
}
