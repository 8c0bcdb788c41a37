/* hbmcheck.c - see hbmcheck.h: the commands of interfaces/command, called with a case that is handed in; what they
 * write is the result. Here: statuses, cases, which commands there are, and how a table is read. No numerics. */
#include "interfaces/library/hbmcheck.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "interfaces/command/call.h"
#include "interfaces/command/commands.h"
#include "model/casefile/structure.h"
#include "numerics/base/number.h"

/* ---- enumerations: the public ones have the values of the inner ones, all of them ---- */

/* clang-format off */
#define STATUSES(X)                                                                                              \
  X(OK) X(BAD_INPUT) X(NO_MEMORY) X(IO) X(STALLED) X(NOT_CONVERGED) X(SINGULAR) X(NOT_FINITE) X(STEP_TOO_SMALL)  \
  X(TOO_MANY_POINTS) X(NOT_CLOSED) X(INTEGRATOR) X(CHATTER) X(NOT_SETTLED) X(APERIODIC) X(INTERRUPTED)           \
  X(UNSUPPORTED) X(BUG) X(JUMPED) X(UNBOUNDED) X(CREEPS)
/* clang-format on */

#define ONE(...)          "." /* as many as the list is long: sizeof counts them */
#define SAME(ours, inner) _Static_assert((int)(ours) == (int)(inner), "hbmcheck.h and " #inner " differ");
#define SAME_STATUS(name) SAME(HBMCHECK_##name, HC_##name)
STATUSES(SAME_STATUS)
SAME(sizeof(STATUSES(ONE)), sizeof(HC_STATUS_LIST(ONE)))
SAME(HBMCHECK_TEXT, TABLE_TEXT)
SAME(HBMCHECK_INTEGER, TABLE_INTEGER)
SAME(HBMCHECK_REAL, TABLE_REAL)
SAME(HBMCHECK_SERIES, TABLE_SERIES)

const char *hbmcheck_version(void) { return HBMCHECK_VERSION; }

const char *hbmcheck_status_text(hbmcheck_status status) { return hc_status_text((hc_status)status); }

/* ---- a case ---- */

struct hbmcheck_case {
  char *name, *text; /* text NULL: of the file `name` */
  size_t length;
  int n_set;
  char **set;     /* [n_set] */
  int n_points;   /* for verify */
  double *points; /* [2][n_points] */
};

static hbmcheck_status say(hc_status st, char *words, size_t size, const char *why)
{
  if (words && size > 0) snprintf(words, size, "%s", st == HC_OK ? "" : *why ? why : hc_status_text(st));
  return (hbmcheck_status)st;
}

void hbmcheck_case_free(hbmcheck_case *c)
{
  if (!c) return;
  for (int i = 0; i < c->n_set; ++i) free(c->set[i]);
  free(c->set);
  free(c->name);
  free(c->text);
  free(c->points);
  free(c);
}

static bool are_strings(int n, const char *const *texts)
{
  if (n < 0 || (n > 0 && !texts)) return false;
  for (int i = 0; i < n; ++i)
    if (!texts[i]) return false;
  return true;
}

/* Is it a case? Large sparse matrices are taken as such. */
static hc_status try_case(const hbmcheck_case *c, case_error *err)
{
  scene sc = {.structure = NULL};
  const char *const *set = (const char *const *)c->set;
  *err = (case_error){{0}};
  const hc_status st = c->text ? case_parse(c->name, c->text, c->length, c->n_set, set, &sc, err)
                               : case_read_sparse(c->name, c->n_set, set, MATRIX_MOST_DENSE, &sc, NULL, err);
  if (st == HC_OK) case_clear(&sc);
  return st;
}

/* From text[length], or from the file `name` without text. */
static hbmcheck_status new_case(const char *name, const char *text, size_t length, int n_set, const char *const *set,
                                char *words, size_t size, hbmcheck_case **out)
{
  case_error err = {{0}};
  if (out) *out = NULL;
  if (!out || !name || !are_strings(n_set, set)) return say(HC_BAD_INPUT, words, size, "");
  hbmcheck_case *c = calloc(1, sizeof *c);
  bool whole = c && (c->name = strdup(name)) && (c->set = calloc((size_t)n_set + 1, sizeof *c->set));
  if (whole && text) whole = (c->text = malloc(length + 1)) != NULL;
  if (whole && text) memcpy(c->text, text, length), c->text[length] = 0, c->length = length;
  for (; whole && c->n_set < n_set; c->n_set += whole) whole = (c->set[c->n_set] = strdup(set[c->n_set])) != NULL;
  const hc_status st = whole ? try_case(c, &err) : HC_NO_MEMORY;
  if (st == HC_OK) *out = c;
  else hbmcheck_case_free(c);
  return say(st, words, size, err.message);
}

hbmcheck_status hbmcheck_case_read(const char *path, int n_set, const char *const *set, char *words, size_t size,
                                   hbmcheck_case **out)
{
  return new_case(path, NULL, 0, n_set, set, words, size, out);
}

hbmcheck_status hbmcheck_case_parse(const char *name, const char *text, size_t length, int n_set,
                                    const char *const *set, char *words, size_t size, hbmcheck_case **out)
{
  return new_case(text ? name : NULL, text, length, n_set, set, words, size, out);
}

/* "NAME=[[1,2],[3,4]]", of one row "NAME=[1,2]", so that it reads back bit for bit; to free, NULL without memory. */
static char *assignment_of(const char *name, int rows, int columns, const double *values)
{
  char *text = NULL, number[NUMBER_TEXT];
  size_t size;
  FILE *to = open_memstream(&text, &size);
  if (!to) return NULL;
  fprintf(to, "%s=%s", name, rows > 1 ? "[" : "");
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      fprintf(to, "%s%s%s",
              j   ? ","
              : i ? ",["
                  : "[",
              number_write(values[(size_t)i * (size_t)columns + (size_t)j], number), j < columns - 1 ? "" : "]");
  if (rows > 1) fputs("]", to);
  const bool failed = ferror(to);
  if (fclose(to) == 0 && !failed) return text;
  free(text);
  return NULL;
}

static hc_status give_points(hbmcheck_case *c, int rows, int columns, const double *values)
{
  const size_t n = 2 * (size_t)columns;
  if (rows != 2) return HC_BAD_INPUT;
  double *points = malloc(n * sizeof *points);
  if (!points) return HC_NO_MEMORY;
  memcpy(points, values, n * sizeof *points);
  free(c->points);
  c->points = points;
  c->n_points = columns;
  return HC_OK;
}

hbmcheck_status hbmcheck_case_give(hbmcheck_case *c, const char *name, int rows, int columns, const double *values,
                                   char *words, size_t size)
{
  if (!c || !name || !values || rows < 1 || columns < 1) return say(HC_BAD_INPUT, words, size, "");
  if (!strcmp(name, "against"))
    return say(give_points(c, rows, columns, values), words, size, "against: expected two rows, omega and values");
  case_error err = {{0}};
  char **set = realloc(c->set, ((size_t)c->n_set + 2) * sizeof *set);
  if (set) c->set = set;
  char *text = set ? assignment_of(name, rows, columns, values) : NULL;
  if (!text) return say(HC_NO_MEMORY, words, size, "");
  c->set[c->n_set++] = text;
  const hc_status st = try_case(c, &err);
  if (st != HC_OK) free(c->set[--c->n_set]);
  return say(st, words, size, err.message);
}

/* ---- `names`, which a shell does not need ---- */

static int run_names(cli_common *common, void *own, scene *sc)
{
  static const table_column responses[] = {TEXT("response")},
                            contacts[] = {INTEGER("contact"), TEXT("name"), INTEGER("tangents")},
                            sweep[] = {TEXT("title"), INTEGER("in_cycles")};
  (void)own;
  const int code = cli_load_sparse_case(common, sc);
  if (code) return code;
  table *tables[] = {table_new("Responses", CLI_COLUMNS(responses)), table_new("Contacts", CLI_COLUMNS(contacts)),
                     table_new("Case", CLI_COLUMNS(sweep))};
  const int n = structure_response_count(sc->structure);
  char name[RESPONSE_NAME], number[NUMBER_TEXT];
  for (int r = 0; r < n; ++r) {
    structure_response_name(sc->structure, r, name, sizeof name);
    TABLE_ROW(tables[0], CELL((char *)name));
  }
  for (int j = 0; j < scene_contact_count(sc); ++j) {
    const scene_contact *c = scene_contact_at(sc, j);
    TABLE_ROW(tables[1], CELL(j), CELL(*c->name ? (const char *)c->name : number_write(j, number)),
              CELL(scene_contact_is_composed(c) ? 1 : scene_model_contact(sc, j + 1) - scene_model_contact(sc, j)));
  }
  TABLE_ROW(tables[2], CELL((const char *)sc->title), CELL((int)sc->in_cycles));
  return cli_write_all(common, 3, tables);
}

static const cli_command names = {.name = "names", .arguments = "CASE", .starts_itself = true, .run = run_names};

/* ---- commands ---- */

struct hbmcheck_result {
  cli_call call;
  int code;
};

static const cli_command *const commands[] = {&cmd_compare, &cmd_frf,    &cmd_transient, &cmd_survey,
                                              &cmd_modes,   &cmd_verify, &cmd_advise,    &cmd_prove,
                                              &cmd_reduce,  &cmd_gate,   &cmd_contact,   &names};
enum { N_COMMANDS = sizeof commands / sizeof *commands };

static bool tick(void *self, double done)
{
  const hbmcheck_monitor *m = self;
  return m->tick(m->self, done) != 0;
}

/* A pipe to a child that has ended is an error of its write, not a signal; in this thread alone, as it was before. */
typedef struct quiet_pipes {
  sigset_t pipe, before;
  bool pending;
} quiet_pipes;

static void pipes_begin(quiet_pipes *q)
{
  sigset_t pending;
  sigemptyset(&q->pipe);
  sigaddset(&q->pipe, SIGPIPE);
  q->pending = sigpending(&pending) == 0 && sigismember(&pending, SIGPIPE) == 1;
  pthread_sigmask(SIG_BLOCK, &q->pipe, &q->before);
}

static void pipes_end(const quiet_pipes *q)
{
  if (!q->pending) sigtimedwait(&q->pipe, NULL, &(struct timespec){0});
  pthread_sigmask(SIG_SETMASK, &q->before, NULL);
}

/* How it ended: as the call says, else as the exit code does. */
static hc_status end_of(const hbmcheck_result *r)
{
  if (r->call.status != HC_OK) return r->call.status;
  return r->code == EXIT_BAD_CASE || r->code == EXIT_USAGE ? HC_BAD_INPUT : r->code == EXIT_BUG ? HC_BUG : HC_OK;
}

hbmcheck_status hbmcheck_run(const hbmcheck_case *c, const char *command, int n, const char *const *options,
                             const hbmcheck_monitor *monitor, hbmcheck_result **out)
{
  int k = 0;
  if (out) *out = NULL;
  if (!c || !command || !out || !are_strings(n, options)) return HBMCHECK_BAD_INPUT;
  while (k < N_COMMANDS && strcmp(commands[k]->name, command) != 0) ++k;
  if (k == N_COMMANDS) return HBMCHECK_BAD_INPUT;
  hbmcheck_result *r = calloc(1, sizeof *r);
  if (!r) return HBMCHECK_NO_MEMORY;
  r->call = (cli_call){.name = c->name,
                       .text = c->text,
                       .length = c->length,
                       .n_set = c->n_set,
                       .set = (const char *const *)c->set,
                       .n_points = c->n_points,
                       .points = c->points};
  if (monitor && monitor->size >= sizeof *monitor && monitor->tick)
    r->call.monitor = (hc_monitor){tick, (void *)monitor};
  quiet_pipes q;
  pipes_begin(&q);
  r->code = cli_call_command(commands[k], &r->call, n, options);
  pipes_end(&q);
  const hc_status st = end_of(r);
  if (st != HC_NO_MEMORY) *out = r;
  else hbmcheck_result_free(r);
  return (hbmcheck_status)st;
}

int hbmcheck_result_exit_code(const hbmcheck_result *r) { return r ? r->code : EXIT_BUG; }

const char *hbmcheck_result_remark(const hbmcheck_result *r, int i)
{
  return r && i >= 0 && i < r->call.n_remarks ? r->call.remarks[i] : NULL;
}

const hbmcheck_table *hbmcheck_result_table(const hbmcheck_result *r, int i)
{
  return r && i >= 0 && i < r->call.n_tables ? (const hbmcheck_table *)r->call.tables[i] : NULL;
}

void hbmcheck_result_free(hbmcheck_result *r)
{
  if (!r) return;
  cli_call_clear(&r->call);
  free(r);
}

/* ---- tables: those of compare/output/table.h ---- */

static const table *inner(const hbmcheck_table *t) { return (const table *)t; }

static int column_named(const hbmcheck_table *t, const char *name)
{
  const table_column *c;
  for (int j = 0; t && name && (c = table_column_at(inner(t), j)); ++j)
    if (!strcmp(c->name, name)) return j;
  return -1;
}

const char *hbmcheck_table_title(const hbmcheck_table *t) { return t ? table_title(inner(t)) : NULL; }

const char *hbmcheck_table_remark(const hbmcheck_table *t, int i) { return t ? table_note_at(inner(t), i) : NULL; }

int hbmcheck_table_rows(const hbmcheck_table *t) { return t ? table_rows(inner(t)) : 0; }

hbmcheck_status hbmcheck_table_column(const hbmcheck_table *t, int j, hbmcheck_column *out)
{
  const table_column *c = t ? table_column_at(inner(t), j) : NULL;
  if (!c || !out || out->size < offsetof(hbmcheck_column, meaning) + sizeof out->meaning) return HBMCHECK_BAD_INPUT;
  out->kind = (hbmcheck_kind)c->kind;
  out->name = c->name;
  out->unit = c->unit ? c->unit : "";
  out->meaning = c->meaning ? c->meaning : "";
  return HBMCHECK_OK;
}

double hbmcheck_table_number(const hbmcheck_table *t, int row, const char *column)
{
  return t ? table_number_at(inner(t), row, column_named(t, column)) : NAN;
}

const char *hbmcheck_table_text(const hbmcheck_table *t, int row, const char *column)
{
  return t ? table_text_at(inner(t), row, column_named(t, column)) : NULL;
}

int hbmcheck_table_numbers(const hbmcheck_table *t, int row, const char *column, int cap, double *values)
{
  const int j = column_named(t, column);
  const double *series;
  if (j < 0 || cap < 0 || (cap > 0 && !values)) return 0;
  const table_kind kind = table_column_at(inner(t), j)->kind;
  if (row >= 0 && kind == TABLE_SERIES) {
    const int n = table_series_at(inner(t), row, j, &series);
    if (n > 0 && cap > 0) memcpy(values, series, (size_t)(cap < n ? cap : n) * sizeof *values);
    return n;
  }
  if (row != -1 || (kind != TABLE_REAL && kind != TABLE_INTEGER)) return 0;
  const int n = table_rows(inner(t));
  for (int i = 0; i < n && i < cap; ++i) values[i] = table_number_at(inner(t), i, j);
  return n;
}
