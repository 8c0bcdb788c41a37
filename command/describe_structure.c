/* describe_structure.c - see describe_structure.h. */
#include "command/describe_structure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "casefile/structure_model.h"
#include "model/modes.h"

bool describes_structure(const field *f)
{
  return f->flags & FIELD_STRUCTURE || f->flags & FIELD_IN_CONTACT || !strcmp(f->section, "oscillator") ||
         !strcmp(f->section, "forcing");
}

int describe_structure_count(const scene_structure *s, const field *f)
{
  if (f->flags & FIELD_IN_LOAD) return s->n_loads;
  if (f->flags & FIELD_IN_CONTACT) return s->n_contacts;
  return f->flags & FIELD_STRUCTURE ? 1 : 0; /* the others are an oscillator's */
}

/* ---- texts ---------------------------------------------------------------------------------------- */

static bool is_zero(int n, const double *direction)
{
  for (int i = 0; i < n; ++i)
    if (direction[i] != 0) return false;
  return true;
}

static bool is_diagonal(int n, const double *v)
{
  for (size_t i = 0; i < (size_t)n * (size_t)n; ++i)
    if (v[i] != 0 && i % ((size_t)n + 1)) return false;
  return true;
}

/* "3 x 3, diagonal", "16 x 16 of beam16_M.mtx" */
static void write_matrix(int n, const structure_matrix *m, FILE *to)
{
  fprintf(to, "%d x %d", n, n);
  if (m->file) fprintf(to, " of %s", m->file);
  else if (is_diagonal(n, m->v)) fputs(", diagonal", to);
}

static void write_damping(const scene_structure *s, FILE *to)
{
  if (s->how == STRUCTURE_DAMPING_MATRIX) write_matrix(s->n, &s->damping, to);
  else fputs(s->how == STRUCTURE_DAMPING_RAYLEIGH ? "rayleigh" : "modal", to);
}

static void write_modal(const scene_structure *s, const field *f, FILE *to)
{
  if (s->how == STRUCTURE_DAMPING_MODAL) field_write(f, s, to);
  else if (s->how == STRUCTURE_DAMPING_MODES) fprintf(to, "a list, one for each of %d modes", s->n);
}

static void write_names(const scene_structure *s, FILE *to)
{
  for (int i = 0; s->names && i < s->n; ++i) fprintf(to, "%s%s", i ? ", " : "", s->names[i]);
}

static void write_direction(const scene_structure *s, const double *direction, FILE *to)
{
  char text[512];
  if (!is_zero(s->n, direction)) fputs(structure_direction_name(s, direction, text, sizeof text), to);
}

static void write_responses(const scene_structure *s, FILE *to)
{
  char text[512];
  for (int r = 0; r < structure_response_count(s); ++r)
    fprintf(to, "%s%s", r ? ", " : "", structure_response_name(s, r, text, sizeof text));
}

static void write_part(const scene_structure *s, const field *f, FILE *to)
{
  if (!strcmp(f->name, "mass")) write_matrix(s->n, &s->mass, to);
  else if (!strcmp(f->name, "stiffness")) write_matrix(s->n, &s->stiffness, to);
  else if (!strcmp(f->name, "damping")) write_damping(s, to);
  else if (!strcmp(f->name, "damping.modal")) write_modal(s, f, to);
  else if (!strcmp(f->name, "names")) write_names(s, to);
  else if (!strcmp(f->name, "response")) write_responses(s, to);
  else if (!strcmp(f->name, "nodes") && s->n_nodes > 0) fprintf(to, "%d", s->n_nodes);
  else if (!strncmp(f->name, "damping.rayleigh", 16) && s->how == STRUCTURE_DAMPING_RAYLEIGH) field_write(f, s, to);
}

/* The direction of a load stands beside `direction`, also where the case gave a DOF. */
static void write_of_load(const scene_structure *s, const field *f, const structure_load *load, FILE *to)
{
  if (!strcmp(f->name, "direction")) write_direction(s, load->direction, to);
  else if (f->kind != FIELD_PART) field_write(f, load, to);
}

static void write_of_contact(const scene_structure *s, const field *f, const structure_contact *c, FILE *to)
{
  const bool tangent = c->by_angle || !is_zero(s->n, c->tangent), normal = c->by_angle || !is_zero(s->n, c->normal);
  const bool across = !strcmp(f->name, "normal_stiffness") || !strcmp(f->name, "gap");
  const bool along = !strcmp(f->name, "tangential_stiffness") || !strcmp(f->name, "friction");
  const bool other = !strcmp(f->name, c->given.preload > 0 ? "gap" : "preload") || /* of the two the one not given */
                     (!strcmp(f->name, "limit") && !structure_contact_is_pair(s, c));
  if (!strcmp(f->name, "tangent")) write_direction(s, c->tangent, to);
  else if (!strcmp(f->name, "tangent_2")) write_direction(s, c->tangent_2, to);
  else if (!strcmp(f->name, "normal")) write_direction(s, c->normal, to);
  else if (!strcmp(f->name, "name")) fputs(c->given.name, to);
  else if (!strcmp(f->name, "angle_deg") ? !c->by_angle : (across && !normal) || (along && !tangent) || other) return;
  else if (f->kind != FIELD_PART) field_write(f, &c->given, to);
}

/* ---- one value ------------------------------------------------------------------------------------- */

static case_place place_of(const scene_structure *s, const field *f, int j)
{
  if (f->flags & FIELD_IN_LOAD) return s->loads[j].place;
  if (f->flags & FIELD_IN_CONTACT) return s->contacts[j].place;
  if (!strcmp(f->name, "mass")) return s->mass.place;
  if (!strcmp(f->name, "stiffness")) return s->stiffness.place;
  if (!strncmp(f->name, "damping", 7)) return s->damping.place;
  if (!strcmp(f->name, "response")) return s->n_responses > 0 ? s->responses[0].place : (case_place){0};
  return s->place;
}

hc_status describe_structure_value(const scene_structure *s, const field *f, int j, char **text, case_place *at)
{
  size_t size;
  FILE *to = open_memstream(text, &size);
  *at = place_of(s, f, j);
  if (!to) return *text = NULL, HC_NO_MEMORY;
  if (f->flags & FIELD_IN_LOAD) write_of_load(s, f, &s->loads[j], to);
  else if (f->flags & FIELD_IN_CONTACT) write_of_contact(s, f, &s->contacts[j], to);
  else write_part(s, f, to);
  if (fclose(to) != 0) return free(*text), *text = NULL, HC_NO_MEMORY;
  if (size > 0) return HC_OK;
  free(*text);
  *text = NULL;
  return HC_OK;
}

/* ---- what follows ---------------------------------------------------------------------------------- */

static void add(case_derived *out, int *n, const char *name, double value, const char *unit, const char *meaning)
{
  case_derived *d = &out[(*n)++];
  *d = (case_derived){.value = value, .unit = unit, .meaning = meaning};
  snprintf(d->name, sizeof d->name, "%s", name);
}

/* The lowest natural frequency; NaN where that motion is driven away. */
static hc_status lowest(const model *m, bool stuck, double *omega)
{
  const size_t n = (size_t)m->n;
  double *room = malloc(n * (n + 1) * sizeof *room);
  hc_status st = room ? model_modes(m, stuck, room, room + n) : HC_NO_MEMORY;
  if (st == HC_OK) *omega = sqrt(room[0]);
  free(room);
  return st;
}

hc_status describe_structure_derive(const scene *sc, case_derived *out, int *n)
{
  const scene_structure *s = sc->structure;
  double open = NAN, stuck = NAN;
  model *m;
  *n = 0;
  hc_status st = structure_model(s, &m);
  if (st == HC_OK) st = lowest(m, false, &open);
  if (st == HC_OK) st = lowest(m, true, &stuck);
  model_free(m);
  if (st != HC_OK) return st;
  add(out, n, "degrees_of_freedom", s->n, "1", "the size of M, C and K");
  add(out, n, "loads", s->n_loads, "1", "in the list `forcing`");
  add(out, n, "contacts", s->n_contacts, "1", "in the list `contacts`");
  add(out, n, "responses", structure_response_count(s), "1", "what is reported");
  add(out, n, "omega_open", open, "rad/time", "the lowest natural frequency, every contact open; all: hbmcheck modes");
  add(out, n, "omega_stuck", stuck, "rad/time", "the lowest natural frequency, every contact stuck");
  add(out, n, "frequency_open", open / TWO_PI, "cycles/time", "omega_open / (2 pi)");
  add(out, n, "frequency_stuck", stuck / TWO_PI, "cycles/time", "omega_stuck / (2 pi)");
  return HC_OK;
}
