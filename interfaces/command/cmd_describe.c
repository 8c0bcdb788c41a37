/* cmd_describe.c - hbmcheck describe: what a case file may say, from the table of fields; with --case what one says,
 * where each value is from, and what follows from them before anything is solved. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compare/output/output.h"
#include "interfaces/command/commands.h"
#include "model/casefile/case_values.h"
#include "model/casefile/structure.h"
#include "model/modes.h"
#include "numerics/base/constants.h"
#include "numerics/norm.h"

/* ---- what the parts of a structure resolved to ----------------------------------------------------- */

/* How many values f has in the scene: of a list, one an entry. */
static int count_values(const scene *sc, const field *f)
{
  return f->flags & FIELD_IN_CONTACT ? scene_contact_count(sc) : f->flags & FIELD_IN_LOAD ? sc->structure->n_loads : 1;
}

/* ---- texts ---------------------------------------------------------------------------------------- */

/* "3 x 3, diagonal", "16 x 16 of beam16_M.mtx" */
static void write_matrix(int n, const structure_matrix *m, FILE *to)
{
  fprintf(to, "%d x %d", n, n);
  if (m->file) fprintf(to, " of %s", m->file);
  else if (structure_is_diagonal(m->v, n)) fputs(", diagonal", to);
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
  else if (!strcmp(f->name, "direction") && s->base) write_direction(s, s->base, to);
  else if (!strcmp(f->name, "nodes") && s->n_nodes > 0) fprintf(to, "%d", s->n_nodes);
}

static void write_of_load(const scene_structure *s, const field *f, const structure_load *load, FILE *to)
{
  if (!strcmp(f->name, "direction")) write_direction(s, load->direction, to);
  else if (f->kind != FIELD_PART) field_write(f, load, to);
}

/* Nothing where the field does not count; but an oscillator's contacts always name their law. */
static void write_of_contact(const scene_structure *s, const field *f, const structure_contact *c, FILE *to)
{
  const bool without = !strcmp(f->name, "preload") && !(c->given.preload > 0);
  const bool says_law = s->is_oscillator && !strcmp(f->name, "law");
  if (!strcmp(f->name, "points")) case_write_points(&c->given, to);
  else if (f->kind == FIELD_PART && f->size > 0) write_direction(s, field_direction(f, c), to);
  else if (!strcmp(f->name, "name")) fputs(c->given.name, to);
  else if (f->kind != FIELD_PART && !without && (says_law || case_contact_field_counts(s, c, f)))
    field_write(f, &c->given, to);
}

/* ---- one value ------------------------------------------------------------------------------------- */

/* Of contact c, NULL: of none; or of load j. */
static case_place place_of(const scene_structure *s, const field *f, const structure_contact *c, int j)
{
  if (c) return c->place;
  if (f->flags & FIELD_IN_LOAD) return s->loads[j].place;
  if (!strcmp(f->name, "mass")) return s->mass.place;
  if (!strcmp(f->name, "stiffness")) return s->stiffness.place;
  if (!strncmp(f->name, "damping", 7)) return s->damping.place;
  if (!strcmp(f->name, "response")) return s->n_responses > 0 ? s->responses[0].place : (case_place){0};
  return s->place;
}

/* ---- what follows ---------------------------------------------------------------------------------- */

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
  const case_derived all[] = {
      {"degrees_of_freedom", s->n, "1", "the size of M, C and K"},
      {"loads", s->n_loads, "1", "in the list `forcing`"},
      {"contacts", s->n_contacts, "1", "in the list `contacts`"},
      {"responses", structure_response_count(s), "1", "what is reported"},
      {"omega_open", open, "rad/time", "the lowest natural frequency, every contact open; all: hbmcheck modes"},
      {"omega_stuck", stuck, "rad/time", "the lowest natural frequency, every contact stuck"},
      {"frequency_open", open / TWO_PI, "cycles/time", "omega_open / (2 pi)"},
      {"frequency_stuck", stuck / TWO_PI, "cycles/time", "omega_stuck / (2 pi)"}};
  memcpy(out, all, sizeof all);
  *n = sizeof all / sizeof *all;
  return HC_OK;
}

static const char help[] =
    "You write a case file: every field, or one FIELD or section, with unit, default, range and meaning. With --case "
    "what that file says: every value, where it is from, and natural frequencies and preloads that follow."
    "\vColumns: default is empty where the field is required, low and high where there is no such end; from = default, "
    "file or --set, and where a field of several is in force, the others have no value.\n"
    "exit: 0 done  2 case file wrong  64 usage, or no such field\n"
    "example: hbmcheck describe hbm.samples\n"
    "example: hbmcheck describe --case cases/paper/case2.yaml --format json";

typedef struct describe_options {
  const char *case_file; /* NULL: not given */
  bool columns;
} describe_options;

static const cli_option options[] = {
    {CLI_TEXT, "case", "CASE", "Also the values of this case file, with --set, and what follows from them",
     offsetof(describe_options, case_file), .file = "the case file", .use = CLI_INPUT},
    {CLI_FLAG, "columns", NULL, "What the columns of results are, with their units",
     offsetof(describe_options, columns)},
    {0},
};

/* ---- the columns of results ---- */

static int write_columns(const cli_common *common)
{
  static const table_column columns[] = {TEXT("table"), TEXT("column"), TEXT("unit"), TEXT("meaning")};
  table *t = table_new("Columns", CLI_COLUMNS(columns));
  for (int kind = 0; kind < ROWS_KINDS; ++kind) {
    table_column of[ROWS_MOST];
    const int n = rows_columns((rows_kind)kind, ROWS_IN_CYCLES | ROWS_RESPONSES | ROWS_IN_MEMORY | ROWS_BANDS, of);
    for (int i = 0; i < n; ++i)
      TABLE_ROW(t, CELL(rows_name((rows_kind)kind)), CELL(of[i].name), CELL_IF(*of[i].unit, of[i].unit),
                CELL(of[i].meaning));
  }
  return cli_write_all(common, 1, &t);
}

/* ---- the table of fields ---- */

static const table_column field_columns[] = {TEXT("field"),    TEXT("symbol"),   TEXT("unit"),   TEXT("kind"),
                                             TEXT("expected"), TEXT("choices"),  REAL("low"),    REAL("high"),
                                             TEXT("default"),  TEXT("required"), TEXT("meaning")};

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
      TABLE_ROW(t, CELL(field_path(f, -1, path)), CELL_IF(*f->symbol, f->symbol), CELL_IF(*f->unit, f->unit),
                CELL(kinds[f->kind]), CELL(expected), CELL_IF(f->kind == FIELD_CHOICE, choices),
                CELL_IF(ranged && isfinite(f->low), f->low), CELL_IF(ranged && isfinite(f->high), f->high),
                CELL(f->fallback), CELL(f->fallback || field_rival(f, 0) ? "no" : "yes"), CELL(f->meaning));
    }
  return cli_write_all(common, 1, &t);
}

/* ---- one case ---- */

static const table_column value_columns[] = {TEXT("field"),   TEXT("value"),   TEXT("unit"),
                                             TEXT("from"),    INTEGER("line"), INTEGER("column"),
                                             TEXT("default"), TEXT("symbol"),  TEXT("meaning")};
static const char *const spare_value_columns[] = {"meaning", "column", "symbol", "default", NULL};
static const table_column derived_columns[] = {TEXT("quantity"), REAL("value"), TEXT("unit"), TEXT("meaning")};

typedef struct described {
  const scene *sc;
  const case_places *places;
  const char *asked; /* NULL: everything */
} described;

/* A row for f, of entry j if it is one of a list's; without a value where the field does not count. HC_NO_MEMORY. */
static hc_status put_value(table *t, const described *d, const field *f, int j)
{
  const scene_structure *s = d->sc->structure;
  const structure_contact *c = f->flags & FIELD_IN_CONTACT ? &s->contacts[j] : NULL;
  char path[FIELD_PATH], *text = NULL;
  size_t size = 0;
  if (!case_field_asked(f, d->asked) || !field_is_of_case(f, d->sc)) return HC_OK;
  if (c && !strcmp(f->name, "coefficients")) return HC_OK; /* each has a row */
  if (c && !strcmp(f->name, "points") && !field_is_of_law(f, &c->given)) return HC_OK;
  if (c && strcmp(f->name, "points") && strcmp(f->name, "law") && !field_is_echoed(f, &c->given)) return HC_OK;
  const bool part = c || f->flags & FIELD_STRUCTURE, its_place = part && !s->is_oscillator;
  const case_place at = its_place ? place_of(s, f, c, j) : case_field_place(d->places, f, c ? j : -1);
  bool counts = part || case_field_counts(f, d->sc);
  FILE *to = open_memstream(&text, &size);
  /* The value of f as a case file has it, text without quotes; of entry j of a list. */
  if (to && counts) {
    if (c) write_of_contact(s, f, c, to);
    else if (f->flags & FIELD_IN_LOAD) write_of_load(s, f, &s->loads[j], to);
    else if (part) write_part(s, f, to);
    else if (f->kind == FIELD_TEXT) fputs(field_look(f, d->sc), to);
    else field_write(f, field_base(f, d->sc), to);
  }
  const bool written = to && fclose(to) == 0;
  counts = counts && (size > 0 || !part);
  const bool in_file = counts && at.line > 0 && at.set == 0;
  const char *from = at.line == 0 ? "default" : in_file ? "file" : "--set";
  TABLE_ROW(t, CELL(field_path(f, j, path)), CELL_IF(counts && written, text), CELL_IF(*f->unit, f->unit),
            CELL_IF(counts, from), CELL_IF(in_file, (long)at.line), CELL_IF(in_file, (long)at.column),
            CELL(f->fallback), CELL_IF(*f->symbol, f->symbol), CELL(f->meaning));
  free(text);
  return written ? HC_OK : HC_NO_MEMORY;
}

static hc_status put_derived(table *t, const scene *sc)
{
  case_derived all[CASE_DERIVED_MAX];
  int n = 0;
  hc_status st = HC_OK;
  if (scene_is_oscillator(sc)) n = case_derive(sc, all);
  else st = describe_structure_derive(sc, all, &n);
  for (const case_derived *d = all; d < all + n; ++d)
    TABLE_ROW(t, CELL(d->name), CELL(d->value), CELL(d->unit), CELL(d->meaning));
  return st;
}

static int write_values(const cli_common *common, const described *d)
{
  table *tables[2] = {table_new("Values", CLI_COLUMNS(value_columns)),
                      table_new("Derived", CLI_COLUMNS(derived_columns))};
  /* In the order of the table of fields, entry after entry of its lists. */
  hc_status st = HC_OK;
  for (int i = 0, end; i < field_count() && st == HC_OK; i = end) {
    const unsigned list = field_at(i)->flags & (FIELD_IN_CONTACT | FIELD_IN_LOAD);
    for (end = i + 1; list && end < field_count() && field_at(end)->flags & list;) ++end;
    for (int j = 0; j < count_values(d->sc, field_at(i)); ++j)
      for (int k = i; k < end && st == HC_OK; ++k) st = put_value(tables[0], d, field_at(k), j);
  }
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
  if (st == HC_OK) cli_say_notes(common, &sc);
  const int code = st == HC_OK ? write_values(common, &d) : cli_not_read(common, st, &err);
  case_clear(&sc);
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
  if (own->columns) return write_columns(common);
  if (common->n_set && !own->case_file)
    return cli_failed(common, EXIT_USAGE, "--set has no case file to set anything in; expected --case CASE, too");
  if (common->format == FORMAT_TABLE && !own->case_file) return write_text(common, common->output);
  if (common->arguments[0] && (code = write_text(common, "/dev/null")) != 0) return code;
  return own->case_file ? describe_case(common, own->case_file) : write_fields(common);
}

CLI_COMMAND(describe, describe_options, "[FIELD]",
            "what a case file may say, or with --case what one says and where each value is from");
