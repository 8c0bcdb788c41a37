/* cmd_describe.c - hbmcheck describe: what a case file may say, from the table of fields; with --case what one says,
 * where each value is from, and what follows from them before anything is solved. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/constants.h"
#include "casefile/case_values.h"
#include "casefile/structure.h"
#include "command/commands.h"
#include "model/modes.h"
#include "output/output.h"

/* ---- what the parts of a structure resolved to ----------------------------------------------------- */

/* Does f say something of a structure, or of one of its loads or contacts? Then it has no place in the scene itself. */
static bool describes_structure(const field *f)
{
  return f->flags & FIELD_STRUCTURE || f->flags & FIELD_IN_CONTACT || !strcmp(f->section, "oscillator") ||
         !strcmp(f->section, "forcing");
}

/* How many values f has: of a list, one an entry. */
static int describe_structure_count(const scene_structure *s, const field *f)
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

static void write_direction(const scene_structure *s, const double *direction, FILE *to)
{
  char text[512];
  if (!is_zero(s->n, direction)) fputs(structure_direction_name(s, direction, text, sizeof text), to);
}

static void write_part(const scene_structure *s, const field *f, FILE *to)
{
  char text[512];
  if (!strcmp(f->name, "mass")) write_matrix(s->n, &s->mass, to);
  else if (!strcmp(f->name, "stiffness")) write_matrix(s->n, &s->stiffness, to);
  else if (!strcmp(f->name, "damping") && s->how == STRUCTURE_DAMPING_MATRIX) write_matrix(s->n, &s->damping, to);
  else if (!strcmp(f->name, "damping")) fputs(s->how == STRUCTURE_DAMPING_RAYLEIGH ? "rayleigh" : "modal", to);
  else if (!strcmp(f->name, "damping.modal") && s->how == STRUCTURE_DAMPING_MODES)
    fprintf(to, "a list, one for each of %d modes", s->n);
  else if ((!strcmp(f->name, "damping.modal") && s->how == STRUCTURE_DAMPING_MODAL) ||
           (!strncmp(f->name, "damping.rayleigh", 16) && s->how == STRUCTURE_DAMPING_RAYLEIGH))
    field_write(f, s, to);
  else if (!strcmp(f->name, "names"))
    for (int i = 0; s->names && i < s->n; ++i) fprintf(to, "%s%s", i ? ", " : "", s->names[i]);
  else if (!strcmp(f->name, "response"))
    for (int r = 0; r < structure_response_count(s); ++r)
      fprintf(to, "%s%s", r ? ", " : "", structure_response_name(s, r, text, sizeof text));
  else if (!strcmp(f->name, "nodes") && s->n_nodes > 0) fprintf(to, "%d", s->n_nodes);
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

/* The value of f, of entry j if it is one of a list's, as text to free, or NULL where it does not count; and where it
 * is from. HC_NO_MEMORY. */
static hc_status describe_structure_value(const scene_structure *s, const field *f, int j, char **text, case_place *at)
{
  size_t size;
  FILE *to = open_memstream(text, &size);
  *at = place_of(s, f, j);
  if (!to) return *text = NULL, HC_NO_MEMORY;
  if (f->flags & FIELD_IN_LOAD) {
    const structure_load *load = &s->loads[j];
    if (!strcmp(f->name, "direction")) write_direction(s, load->direction, to);
    else if (f->kind != FIELD_PART) field_write(f, load, to);
  } else if (f->flags & FIELD_IN_CONTACT) write_of_contact(s, f, &s->contacts[j], to);
  else write_part(s, f, to);
  if (fclose(to) != 0) return free(*text), *text = NULL, HC_NO_MEMORY;
  if (size > 0) return HC_OK;
  free(*text);
  *text = NULL;
  return HC_OK;
}

/* ---- what follows ---------------------------------------------------------------------------------- */

static void add_derived(case_derived *out, int *n, const char *name, double value, const char *unit,
                        const char *meaning)
{
  case_derived *d = &out[(*n)++];
  *d = (case_derived){.value = value, .unit = unit, .meaning = meaning};
  snprintf(d->name, sizeof d->name, "%s", name);
}

/* The lowest natural frequency; NaN where that motion is driven away. */
static hc_status lowest(const model *m, bool stuck, double *omega)
{
  const size_t n = (size_t)m->n;
  double *modes = malloc(n * (n + 1) * sizeof *modes);
  hc_status st = modes ? model_modes(m, stuck, modes, modes + n) : HC_NO_MEMORY;
  if (st == HC_OK) *omega = sqrt(modes[0]);
  free(modes);
  return st;
}

/* Sizes, and the lowest natural frequencies, into out[CASE_DERIVED_MAX]; *n of them. Errors of model_modes. */
static hc_status describe_structure_derive(const scene *sc, case_derived *out, int *n)
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
  add_derived(out, n, "degrees_of_freedom", s->n, "1", "the size of M, C and K");
  add_derived(out, n, "loads", s->n_loads, "1", "in the list `forcing`");
  add_derived(out, n, "contacts", s->n_contacts, "1", "in the list `contacts`");
  add_derived(out, n, "responses", structure_response_count(s), "1", "what is reported");
  add_derived(out, n, "omega_open", open, "rad/time",
              "the lowest natural frequency, every contact open; all: hbmcheck modes");
  add_derived(out, n, "omega_stuck", stuck, "rad/time", "the lowest natural frequency, every contact stuck");
  add_derived(out, n, "frequency_open", open / TWO_PI, "cycles/time", "omega_open / (2 pi)");
  add_derived(out, n, "frequency_stuck", stuck / TWO_PI, "cycles/time", "omega_stuck / (2 pi)");
  return HC_OK;
}

static const char help[] =
    "What a case file may say: every field, or one FIELD or section, with unit, default, range and meaning. With "
    "--case what that file says: every value, where it is from, and natural frequencies and preloads that follow."
    "\vColumns: default is empty where the field is required, low and high where there is no such end; from = default, "
    "file or --set, and where a field of several is in force, the others have no value.\n"
    "exit: 0 done  2 case file wrong  64 usage, or no such field\n"
    "example: hbmcheck describe hbm.samples\n"
    "example: hbmcheck describe --case cases/paper/case2.yaml --format json";

typedef struct describe_options {
  const char *case_file; /* NULL: not given */
} describe_options;

static const cli_option options[] = {
    {CLI_TEXT, "case", "CASE", "Also the values of this case file, with --set, and what follows from them",
     offsetof(describe_options, case_file), .file = "the case file", .use = CLI_INPUT},
    {0},
};

/* ---- the table of fields ---- */

static const table_column field_columns[] = {
    {"field", TABLE_TEXT},    {"symbol", TABLE_TEXT},   {"unit", TABLE_TEXT},    {"kind", TABLE_TEXT},
    {"expected", TABLE_TEXT}, {"choices", TABLE_TEXT},  {"low", TABLE_REAL},     {"high", TABLE_REAL},
    {"default", TABLE_TEXT},  {"required", TABLE_TEXT}, {"meaning", TABLE_TEXT},
};

static const char *text_or_nothing(const char *text) { return text && *text ? text : NULL; }

static int write_fields(const cli_common *common)
{
  static const char *const kinds[] = {[FIELD_REAL] = "number",   [FIELD_INTEGER] = "integer",   [FIELD_FLAG] = "flag",
                                      [FIELD_CHOICE] = "choice", [FIELD_TEXT] = "text",         [FIELD_PAIR] = "pair",
                                      [FIELD_REALS] = "numbers", [FIELD_INTEGERS] = "integers", [FIELD_PART] = "part"};
  table *t = table_new("Fields", CLI_COLUMNS(field_columns));
  for (int i = 0; i < field_count(); ++i)
    if (case_field_asked(field_at(i), common->arguments[0])) {
      const field *f = field_at(i);
      char path[FIELD_PATH], expected[128], choices[128]; /* "exact|sampled" */
      const bool ranged = f->kind != FIELD_FLAG && f->kind != FIELD_CHOICE && f->kind != FIELD_TEXT;
      message m;
      message_start(&m, expected, sizeof expected);
      field_expected(f, &m);
      message_start(&m, choices, sizeof choices);
      for (int k = 0; f->choices && f->choices[k]; ++k) message_add(&m, "%s%s", k ? "|" : "", f->choices[k]);
      table_put_text(t, field_path(f, -1, path));
      table_put_text(t, text_or_nothing(f->symbol));
      table_put_text(t, text_or_nothing(f->unit));
      table_put_text(t, kinds[f->kind]);
      table_put_text(t, expected);
      table_put_text(t, f->kind == FIELD_CHOICE ? choices : NULL);
      table_put_real(t, ranged && isfinite(f->low) ? f->low : NAN);
      table_put_real(t, ranged && isfinite(f->high) ? f->high : NAN);
      table_put_text(t, f->fallback);
      table_put_text(t, f->fallback || field_rival(f, 0) ? "no" : "yes");
      table_put_text(t, f->meaning);
    }
  int code = cli_write(common, 1, &t);
  table_free(t);
  return code;
}

/* ---- one case ---- */

static const table_column value_columns[] = {
    {"field", TABLE_TEXT},   {"value", TABLE_TEXT},   {"unit", TABLE_TEXT},
    {"from", TABLE_TEXT},    {"line", TABLE_INTEGER}, {"column", TABLE_INTEGER},
    {"default", TABLE_TEXT}, {"symbol", TABLE_TEXT},  {"meaning", TABLE_TEXT},
};
static const char *const spare_value_columns[] = {"meaning", "column", "symbol", "default", NULL};
static const table_column derived_columns[] = {
    {"quantity", TABLE_TEXT}, {"value", TABLE_REAL}, {"unit", TABLE_TEXT}, {"meaning", TABLE_TEXT}};

/* The value of f as a case file would have it, text without its quotes; nothing where the field does not count. */
static hc_status put_text_of(table *t, const field *f, const void *base, bool counts)
{
  char *text = NULL;
  size_t size;
  if (!counts || f->kind == FIELD_TEXT) {
    table_put_text(t, counts ? field_look(f, base) : NULL);
    return HC_OK;
  }
  FILE *to = open_memstream(&text, &size);
  if (to) field_write(f, base, to);
  const bool written = to && fclose(to) == 0;
  table_put_text(t, written ? text : NULL);
  free(text);
  return written ? HC_OK : HC_NO_MEMORY;
}

/* What is shown of one case. */
typedef struct described {
  const scene *sc;
  const case_places *places;
  const char *asked; /* NULL: everything */
} described;

static void put_rest(table *t, const field *f, case_place at, bool counts)
{
  table_put_text(t, text_or_nothing(f->unit));
  const bool in_file = counts && at.line > 0 && at.set == 0;
  table_put_text(t, !counts ? NULL : at.line == 0 ? "default" : in_file ? "file" : "--set");
  table_put_integer_if(t, in_file, (long)at.line);
  table_put_integer_if(t, in_file, (long)at.column);
  table_put_text(t, f->fallback);
  table_put_text(t, text_or_nothing(f->symbol));
  table_put_text(t, f->meaning);
}

/* j: the contact, if f is one of a contact's; else -1. */
static hc_status put_value(table *t, const described *d, const field *f, int j)
{
  char path[FIELD_PATH];
  const bool counts = j >= 0 || case_field_counts(f, d->sc);
  if (f->flags & FIELD_STRUCTURE || !case_field_asked(f, d->asked)) return HC_OK; /* an oscillator has none */
  table_put_text(t, field_path(f, j, path));
  hc_status st = put_text_of(t, f, j >= 0 ? (const void *)&d->sc->contacts[j] : d->sc, counts);
  put_rest(t, f, case_field_place(d->places, f, j), counts);
  return st;
}

/* The parts of a structure that f is about. j: the entry of a list. */
static hc_status put_part(table *t, const described *d, const field *f, int j)
{
  char path[FIELD_PATH], *text;
  case_place at;
  if (!case_field_asked(f, d->asked)) return HC_OK;
  hc_status st = describe_structure_value(d->sc->structure, f, j, &text, &at);
  table_put_text(t, field_path(f, field_is_in_list(f) ? j : -1, path));
  table_put_text(t, text);
  put_rest(t, f, at, text != NULL);
  free(text);
  return st;
}

/* In the order of the table of fields, contact after contact. */
static hc_status put_values(table *t, const described *d)
{
  /* In the order of the table of fields, entry after entry of its lists. */
  if (d->sc->structure) {
    const unsigned lists = FIELD_IN_CONTACT | FIELD_IN_LOAD;
    hc_status st = HC_OK;
    for (int i = 0, end; i < field_count() && st == HC_OK; i = end) {
      const unsigned list = field_at(i)->flags & lists;
      for (end = i + 1; list && end < field_count() && field_at(end)->flags & list;) ++end;
      if (!describes_structure(field_at(i))) st = put_value(t, d, field_at(i), -1);
      else
        for (int j = 0; j < describe_structure_count(d->sc->structure, field_at(i)); ++j)
          for (int k = i; k < end && st == HC_OK; ++k) st = put_part(t, d, field_at(k), j);
    }
    return st;
  }
  hc_status st = HC_OK;
  for (int i = 0, end; i < field_count() && st == HC_OK; i = end) {
    const bool in_contact = field_at(i)->flags & FIELD_IN_CONTACT;
    for (end = i + 1; in_contact && end < field_count() && field_at(end)->flags & FIELD_IN_CONTACT;) ++end;
    for (int j = in_contact ? 0 : -1; j < (in_contact ? d->sc->n_contacts : 0); ++j)
      for (int k = i; k < end && st == HC_OK; ++k) st = put_value(t, d, field_at(k), j);
  }
  return st;
}

static hc_status put_derived(table *t, const scene *sc)
{
  case_derived all[CASE_DERIVED_MAX];
  int n = 0;
  hc_status st = HC_OK;
  if (sc->structure) st = describe_structure_derive(sc, all, &n);
  else n = case_derive(sc, all);
  for (int i = 0; i < n; ++i) {
    table_put_text(t, all[i].name);
    table_put_real(t, all[i].value);
    table_put_text(t, all[i].unit);
    table_put_text(t, all[i].meaning);
  }
  return st;
}

static int write_values(const cli_common *common, const described *d)
{
  table *tables[2] = {table_new("Values", CLI_COLUMNS(value_columns)),
                      table_new("Derived", CLI_COLUMNS(derived_columns))};
  hc_status st = put_values(tables[0], d);
  table_spare(tables[0], spare_value_columns);
  table_note(tables[0], "%s", d->sc->title);
  const hc_status derived = put_derived(tables[1], d->sc);
  if (derived == HC_NO_MEMORY) st = derived;
  else if (derived != HC_OK) table_note(tables[1], "natural frequencies: %s", hc_status_text(derived));
  int code = st == HC_OK ? cli_write(common, 2, tables) : cli_file_failed(common, common->output, st);
  for (int i = 0; i < 2; ++i) table_free(tables[i]);
  return code;
}

static int describe_case(const cli_common *common, const char *path)
{
  case_error err = {{0}};
  scene sc = {.structure = NULL};
  case_places *places = malloc(sizeof *places);
  hc_status st = places ? case_read_placed(path, common->n_set, common->set, &sc, places, &err) : HC_NO_MEMORY;
  const described d = {&sc, places, common->arguments[0]};
  int code = st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
  if (st == HC_OK) code = write_values(common, &d);
  case_clear(&sc);
  if (st != HC_OK) fprintf(stderr, "%s\n", err.message[0] ? err.message : hc_status_text(st));
  free(places);
  return code;
}

/* ---- for people ---- */

/* case_describe to `path`, or with NULL to nowhere: is there such a field? 0 or the exit code after the message. */
static int write_text(const cli_common *common, const char *path)
{
  case_error err = {{0}};
  output *out = NULL;
  hc_status st = output_open(path, &out);
  if (st == HC_OK) st = output_finish(out, case_describe(common->arguments[0], output_stream(out), &err));
  if (st == HC_OK) return 0;
  if (!err.message[0]) return cli_file_failed(common, path, st);
  const bool is_file = access(common->arguments[0], F_OK) == 0;
  cli_message(common, "%s%s%s", err.message, is_file ? "; what that file says: hbmcheck describe --case " : "",
              is_file ? common->arguments[0] : "");
  return EXIT_USAGE;
}

static int run_describe(cli_common *common, void *given, scene *sc)
{
  const describe_options *own = given;
  int code;
  (void)sc;
  if (common->n_set && !own->case_file)
    return cli_failed(common, EXIT_USAGE, "--set has no case file to set anything in; expected --case CASE, too");
  if (common->format == FORMAT_TABLE && !own->case_file) return write_text(common, common->output);
  if (common->arguments[0] && (code = write_text(common, "/dev/null")) != 0) return code;
  return own->case_file ? describe_case(common, own->case_file) : write_fields(common);
}

CLI_COMMAND(describe, describe_options, "[FIELD]",
            "what a case file may say, or with --case what one says and where each value is from");
