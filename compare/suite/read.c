/* read.c - the suite's files, and a program's results as csv files or as one json. */
#include <dirent.h>
#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "compare/suite/suite.h"
#include "numerics/base/growing.h"
#include "numerics/base/number.h"

enum { PATH_ROOM = 4096, MOST_COLUMNS = 64, IGNORED = -1, OMEGA = SUITE_N };

#define SUITE_NAME(code, name) name,
const char *const suite_quantity[SUITE_N] = {SUITE_QUANTITIES(SUITE_NAME)};
#undef SUITE_NAME

hc_status suite_say(char *why, const char *format, ...)
{
  message m;
  va_list args;
  va_start(args, format);
  message_start(&m, why, SUITE_TEXT);
  message_add_list(&m, format, args);
  va_end(args);
  return HC_BAD_INPUT;
}

/* A json file into *out: the caller's. */
static hc_status load(const char *path, json_t **out, char *why)
{
  json_error_t e;
  struct stat about;
  if (stat(path, &about) != 0) return suite_say(why, "%s: %s, expected a json file", path, strerror(errno)), HC_IO;
  *out = json_load_file(path, JSON_REJECT_DUPLICATES, &e);
  if (*out) return HC_OK;
  const char *hint = strstr(e.text, "NaN") || strstr(e.text, "nan") ? "; a number that is none is null in json" : "";
  return suite_say(why, "%s:%d:%d: %s%s", path, e.line, e.column, e.text, hint);
}

/* ---- the suite ---- */

static hc_status read_reference(const json_t *from, suite_reference *r)
{
  const json_t *omega = json_object_get(from, "omega");
  const char *kind = json_string_value(json_object_get(from, "kind"));
  const char *stability = json_string_value(json_object_get(from, "stability"));
  if (!json_is_number(omega) || !kind || !stability) return HC_BAD_INPUT;
  r->omega = json_number_value(omega);
  r->proven = !strcmp(kind, "proven");
  r->stability = !strcmp(stability, "stable") - !strcmp(stability, "unstable");
  for (int q = 0; q < SUITE_N; ++q) {
    const json_t *bounds = json_object_get(from, suite_quantity[q]);
    const json_t *low = json_array_get(bounds, 0), *high = json_array_get(bounds, 1);
    r->low[q] = r->high[q] = NAN;
    if (json_is_null(bounds) && q != SUITE_AMPLITUDE) continue;
    if (!json_is_number(low) || !json_is_number(high)) return HC_BAD_INPUT;
    r->low[q] = json_number_value(low), r->high[q] = json_number_value(high);
  }
  return r->omega > 0 && r->low[SUITE_AMPLITUDE] > 0 ? HC_OK : HC_BAD_INPUT;
}

static char *text_of(const json_t *from, const char *key)
{
  const char *text = json_string_value(json_object_get(from, key));
  return text ? strdup(text) : NULL;
}

static hc_status read_case(const char *folder, const char *name, suite_case *c, char *why)
{
  char path[PATH_ROOM];
  json_t *from = NULL;
  snprintf(path, sizeof path, "%s/cases/%s.json", folder, name);
  hc_status st = load(path, &from, why);
  const json_t *references = json_object_get(from, "references");
  const size_t n = json_array_size(references);
  c->name = strdup(name);
  c->group = text_of(from, "group"), c->title = text_of(from, "title");
  c->tests = text_of(from, "tests"), c->goes_wrong = text_of(from, "goes_wrong");
  c->harmonics = (int)json_integer_value(json_object_get(from, "harmonics"));
  c->references = calloc(n + 1, sizeof *c->references);
  if (!c->name || !c->references) st = HC_NO_MEMORY;
  if (st == HC_OK && (!c->group || !c->title || !c->tests || !c->goes_wrong || c->harmonics < 1 || n < 1))
    st = suite_say(why, "%s: group, title, tests, goes_wrong, harmonics or references are missing", path);
  for (; st == HC_OK && c->n < (int)n; ++c->n)
    if (read_reference(json_array_get(references, (size_t)c->n), &c->references[c->n]) != HC_OK)
      st = suite_say(why, "%s: references[%d] is wrong, expected omega, kind, stability and intervals", path, c->n);
  json_decref(from);
  return st;
}

hc_status suite_read(const char *folder, suite *out, char *why)
{
  char path[PATH_ROOM];
  json_t *from = NULL;
  *out = (suite){0};
  snprintf(path, sizeof path, "%s/suite.json", folder);
  hc_status st = load(path, &from, why);
  const json_t *names = json_object_get(from, "cases");
  const size_t n = json_array_size(names);
  out->version = text_of(from, "suite");
  out->cases = calloc(n + 1, sizeof *out->cases);
  if (!out->cases) st = HC_NO_MEMORY;
  if (st == HC_OK && (!out->version || n == 0)) st = suite_say(why, "%s: suite and cases were expected", path);
  while (st == HC_OK && out->n < (int)n) {
    const char *name = json_string_value(json_array_get(names, (size_t)out->n));
    st = name ? read_case(folder, name, &out->cases[out->n++], why) : suite_say(why, "%s: cases are names", path);
  }
  json_decref(from);
  return st;
}

void suite_clear(suite *s)
{
  for (int i = 0; i < s->n; ++i) {
    const suite_case *c = &s->cases[i];
    free(c->name), free(c->group), free(c->title), free(c->tests), free(c->goes_wrong), free(c->references);
  }
  free(s->cases);
  free(s->version);
  *s = (suite){0};
}

/* ---- results ---- */

static const suite_row no_row = {.omega = NAN, .value = {NAN, NAN, NAN, NAN}};

static hc_status add_row(suite_answer *a, const suite_row *row)
{
  if (a->n == SUITE_MOST_ROWS) return suite_say(a->wrong, "%s: more than %d rows", a->path, SUITE_MOST_ROWS);
  if (!GROW(a->rows, a->n)) return HC_NO_MEMORY;
  a->rows[a->n++] = *row;
  return HC_OK;
}

/* What a column is: its place in suite_row.value, OMEGA or IGNORED. */
static int column_named(const char *name, size_t length)
{
  if (length == 5 && !memcmp(name, "omega", 5)) return OMEGA;
  for (int q = 0; q < SUITE_N; ++q)
    if (strlen(suite_quantity[q]) == length && !memcmp(name, suite_quantity[q], length)) return q;
  return IGNORED;
}

typedef struct csv_file {
  const char *path;
  long line;
  int n, meaning[MOST_COLUMNS]; /* of the columns; n = 0: the header is to come */
  suite_answer *answer;
} csv_file;

/* The field at *at, without blanks around it; *at moves behind its comma, or becomes NULL. */
static const char *next_field(const char **at, size_t *length)
{
  const char *from = *at + strspn(*at, " \t"), *comma = strchr(from, ',');
  *length = comma ? (size_t)(comma - from) : strlen(from);
  while (*length && strchr(" \t", from[*length - 1])) --*length;
  *at = comma ? comma + 1 : NULL;
  return from;
}

static hc_status read_header(csv_file *f, const char *text)
{
  int seen[SUITE_N + 1] = {0}, others = 0;
  const char *at = text;
  for (size_t length; at;) {
    const char *name = next_field(&at, &length);
    const int column = (int)(name - text) + 1, meaning = column_named(name, length);
    if (f->n == MOST_COLUMNS)
      return suite_say(f->answer->wrong, "%s:%ld:%d: more than %d columns", f->path, f->line, column, MOST_COLUMNS);
    if (meaning != IGNORED && seen[meaning]++)
      return suite_say(f->answer->wrong, "%s:%ld:%d: a second column %s", f->path, f->line, column,
                       QUOTED(name, length));
    if (meaning == IGNORED && !others++)
      suite_say(f->answer->note, "%s:%ld:%d: column %s is left out", f->path, f->line, column, QUOTED(name, length));
    f->meaning[f->n++] = meaning;
  }
  if (seen[OMEGA] && f->n > others + 1) return HC_OK;
  return suite_say(f->answer->wrong, "%s:%ld:1: no column %s, expected a header omega,amplitude,mean,a1,b1", f->path,
                   f->line, seen[OMEGA] ? "with a quantity" : "omega");
}

static hc_status read_line(csv_file *f, const char *text)
{
  suite_row row = no_row;
  const char *at = text;
  int i = 0;
  row.line = f->line;
  for (size_t length; at; ++i) {
    const char *field = next_field(&at, &length);
    double number = NAN;
    const number_fault fault = length ? number_read(field, length, &number) : NUMBER_NOT_FINITE;
    const int column = (int)(field - text) + 1, meaning = i < f->n ? f->meaning[i] : IGNORED;
    if (i == f->n)
      return suite_say(f->answer->wrong, "%s:%ld:%d: more than %d fields; a decimal comma?", f->path, f->line, column,
                       i);
    if (meaning == IGNORED) continue;
    if (fault == NUMBER_NONE)
      return suite_say(f->answer->wrong, "%s:%ld:%d: %s is not a number, expected one like 1.25e1", f->path, f->line,
                       column, QUOTED(field, length));
    if (fault != NUMBER_FINE && length && !*f->answer->note)
      suite_say(f->answer->note, "%s:%ld:%d: %s counts as missing", f->path, f->line, column, QUOTED(field, length));
    *(meaning == OMEGA ? &row.omega : &row.value[meaning]) = fault == NUMBER_FINE ? number : NAN;
  }
  if (i < f->n) return suite_say(f->answer->wrong, "%s:%ld:1: %d fields, expected %d", f->path, f->line, i, f->n);
  return add_row(f->answer, &row);
}

/* A case's csv file; HC_BAD_INPUT: it is refused. */
static hc_status read_csv(const char *path, suite_answer *a)
{
  csv_file f = {.path = path, .answer = a};
  char *text = NULL;
  size_t room = 0;
  hc_status st = HC_OK;
  FILE *from = fopen(path, "r");
  if (!from && errno == ENOENT) return HC_OK;
  a->there = true;
  suite_say(a->path, "%s", path);
  if (!from) return suite_say(a->wrong, "%s: %s", path, strerror(errno));
  while (st == HC_OK && getline(&text, &room, from) >= 0) {
    ++f.line;
    const char *line = f.line == 1 && !strncmp(text, "\xEF\xBB\xBF", 3) ? text + 3 : text;
    text[strcspn(text, "\r\n")] = '\0';
    if (line[strspn(line, " \t")] == '\0' || *line == '#') continue;
    st = f.n ? read_line(&f, line) : read_header(&f, line);
  }
  if (st == HC_OK && f.n == 0) st = suite_say(a->wrong, "%s:1:1: empty, expected omega,amplitude,mean,a1,b1", path);
  free(text);
  fclose(from);
  return st;
}

/* Rows of a case in the json file. */
static hc_status read_rows(const char *path, const char *name, const json_t *rows, suite_answer *a)
{
  suite_say(a->path, "%s: cases.%s", path, name);
  hc_status st = json_is_array(rows) ? HC_OK : suite_say(a->wrong, "%s: a list was expected", a->path);
  const json_t *value;
  const char *key;
  a->there = true;
  for (size_t i = 0; i < json_array_size(rows) && st == HC_OK; ++i) {
    suite_row row = no_row;
    json_t *from = json_array_get(rows, i);
    if (!json_is_object(from)) st = suite_say(a->wrong, "%s[%zu]: an object was expected", a->path, i);
    json_object_foreach(from, key, value)
    {
      const int meaning = column_named(key, strlen(key));
      const bool number = json_is_number(value);
      if (meaning == IGNORED && !*a->note)
        suite_say(a->note, "%s[%zu].%s is left out", a->path, i, QUOTED(key, strlen(key)));
      if (meaning != IGNORED && !number && !json_is_null(value))
        st = suite_say(a->wrong, "%s[%zu].%s: a number or null was expected", a->path, i, key);
      if (meaning != IGNORED && number)
        *(meaning == OMEGA ? &row.omega : &row.value[meaning]) = json_number_value(value);
    }
    if (st == HC_OK && isnan(row.omega)) st = suite_say(a->wrong, "%s[%zu]: no omega", a->path, i);
    if (st == HC_OK) st = add_row(a, &row);
  }
  return st;
}

static int case_named(const suite *s, const char *name, size_t length)
{
  for (int i = 0; i < s->n; ++i)
    if (strlen(s->cases[i].name) == length && !memcmp(s->cases[i].name, name, length)) return i;
  return -1;
}

static hc_status read_results_json(const char *path, const suite *s, suite_answer *answers, int *strange, char *why)
{
  json_t *from = NULL, *rows;
  const char *name;
  hc_status st = load(path, &from, why);
  json_t *cases = json_object_get(from, "cases");
  if (st == HC_OK && !json_is_object(cases)) st = suite_say(why, "%s: no object `cases` in it", path);
  json_object_foreach(cases, name, rows)
  {
    const int i = case_named(s, name, strlen(name));
    if (i < 0 && !(*strange)++) suite_say(why, "%s: the suite has no case %s", path, QUOTED(name, strlen(name)));
    if (i >= 0 && st != HC_NO_MEMORY && read_rows(path, name, rows, &answers[i]) == HC_NO_MEMORY) st = HC_NO_MEMORY;
  }
  json_decref(from);
  return st;
}

hc_status suite_results_read(const char *path, const suite *s, suite_answer *answers, int *strange, char *why)
{
  char file[PATH_ROOM];
  struct stat about;
  int there = 0;
  *strange = 0;
  if (stat(path, &about) != 0) return suite_say(why, "%s: %s", path, strerror(errno)), HC_IO;
  if (!S_ISDIR(about.st_mode)) return read_results_json(path, s, answers, strange, why);
  for (int i = 0; i < s->n; ++i) {
    snprintf(file, sizeof file, "%s/%s.csv", path, s->cases[i].name);
    if (read_csv(file, &answers[i]) == HC_NO_MEMORY) return HC_NO_MEMORY;
    there += answers[i].there;
  }
  if (!there) return suite_say(why, "%s: no results, expected files such as %s.csv", path, s->cases[0].name);
  DIR *folder = opendir(path);
  const struct dirent *entry;
  while (folder && (entry = readdir(folder))) {
    const char *dot = strrchr(entry->d_name, '.');
    if (!dot || strcmp(dot, ".csv") != 0 || case_named(s, entry->d_name, (size_t)(dot - entry->d_name)) >= 0) continue;
    if (!(*strange)++) suite_say(why, "%s/%s: the suite has no such case", path, entry->d_name);
  }
  if (folder) closedir(folder);
  return HC_OK;
}
