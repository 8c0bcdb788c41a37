/* table.c - the table itself, and csv. The other formats: table_aligned.c, table_json.c. */
#include "compare/output/table.h"

#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "compare/output/table_private.h"
#include "numerics/base/growing.h"
#include "numerics/base/utf8.h"

/* The C locale for this thread alone; printf and jansson then write '.'. */
static bool enter_c_locale(locale_t *c, locale_t *before)
{
  *c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (!*c) return false;
  *before = uselocale(*c);
  return true;
}

static void leave_c_locale(locale_t c, locale_t before)
{
  uselocale(before);
  freelocale(c);
}

/* At least one column, all of a known kind, no two of one name? */
static bool columns_are_sound(int n, const table_column *columns)
{
  if (n < 1 || !columns) return false;
  for (int i = 0; i < n; ++i) {
    table_kind kind = columns[i].kind;
    if (kind != TABLE_TEXT && kind != TABLE_INTEGER && kind != TABLE_REAL && kind != TABLE_SERIES) return false;
    for (int j = 0; j < i; ++j)
      if (!strcmp(columns[i].name, columns[j].name)) return false;
  }
  return true;
}

/* The first failure is kept: nothing is appended after it. */
static void give_up(table *t, hc_status why)
{
  if (t->status == HC_OK) t->status = why;
}

table *table_new(const char *title, int n_columns, const table_column *columns)
{
  table *t = calloc(1, sizeof *t);
  if (!t) return NULL;
  t->holders = 1;
  t->title = utf8_clean(title ? title : "", true);
  if (!t->title) give_up(t, HC_NO_MEMORY);
  if (!columns_are_sound(n_columns, columns)) {
    give_up(t, HC_BUG);
    return t;
  }
  t->columns = malloc((size_t)n_columns * sizeof *columns);
  t->hidden = calloc((size_t)n_columns, sizeof *t->hidden);
  bool named = t->columns != NULL;
  for (; named && t->n_columns < n_columns; t->n_columns += named) {
    table_column *c = &t->columns[t->n_columns];
    *c = columns[t->n_columns];
    named = (c->name = strdup(c->name)) != NULL;
  }
  if (!named || !t->hidden) give_up(t, HC_NO_MEMORY);
  return t;
}

table *table_keep(table *t)
{
  if (t) ++t->holders;
  return t;
}

void table_free(table *t)
{
  if (!t || --t->holders > 0) return;
  for (size_t i = 0; i < t->n_cells; ++i) {
    const table_kind kind = t->columns[i % (size_t)t->n_columns].kind;
    if (kind == TABLE_TEXT) free(t->cells[i].as.text);
    if (kind == TABLE_SERIES) free(t->cells[i].as.series);
  }
  for (size_t i = 0; i < t->n_notes; ++i) free(t->notes[i]);
  for (int j = 0; j < t->n_columns; ++j) free((char *)t->columns[j].name);
  free(t->cells);
  free(t->notes);
  free(t->title);
  free(t->hidden);
  free(t->columns);
  free(t);
}

/* The next cell, appended as missing; NULL if the table failed before or memory runs out. */
static table_cell *next_cell(table *t)
{
  if (!t || t->status != HC_OK) return NULL;
  table_cell *cells = t->n_cells < INT_MAX ? growing(t->cells, (int)t->n_cells, sizeof *cells) : NULL;
  if (!cells) {
    give_up(t, HC_NO_MEMORY);
    return NULL;
  }
  t->cells = cells;
  table_cell *cell = &t->cells[t->n_cells++];
  *cell = (table_cell){.there = false};
  return cell;
}

/* The same for a value of that kind, which has to be its column's: the writers read the cell by the column's kind. */
static table_cell *next_cell_of(table *t, table_kind kind)
{
  if (!t || t->status != HC_OK) return NULL;
  if (t->columns[t->n_cells % (size_t)t->n_columns].kind != kind) {
    give_up(t, HC_BUG);
    return NULL;
  }
  return next_cell(t);
}

void table_put_text(table *t, const char *value)
{
  table_cell *cell = next_cell_of(t, TABLE_TEXT);
  if (!cell || !value) return;
  cell->as.text = utf8_clean(value, false);
  cell->there = cell->as.text != NULL;
  if (!cell->there) give_up(t, HC_NO_MEMORY);
}

void table_put_integer(table *t, long value)
{
  table_cell *cell = next_cell_of(t, TABLE_INTEGER);
  if (cell) *cell = (table_cell){.there = true, .as.integer = value};
}

void table_put_real(table *t, double value)
{
  table_cell *cell = next_cell_of(t, TABLE_REAL);
  if (cell && !isnan(value)) *cell = (table_cell){.there = true, .as.real = value};
}

void table_put_series(table *t, int n, const double *values)
{
  table_cell *cell = next_cell_of(t, TABLE_SERIES);
  double *series = cell ? malloc(((size_t)n + 1) * sizeof *series) : NULL;
  if (cell && !series) give_up(t, HC_NO_MEMORY);
  if (!series) return;
  series[0] = n;
  memcpy(series + 1, values, (size_t)n * sizeof *series);
  *cell = (table_cell){.there = true, .as.series = series};
}

void table_put_missing(table *t) { next_cell(t); }

void table_put_values(table *t, int n, const table_value *values)
{
  for (const table_value *v = values; v < values + n; ++v) {
    if (!v->has) continue;
    if (!v->there) table_put_missing(t);
    else if (v->kind == TABLE_TEXT) table_put_text(t, v->as.text);
    else if (v->kind == TABLE_INTEGER) table_put_integer(t, v->as.integer);
    else table_put_real(t, v->as.real);
  }
}

/* printf into new memory, with '.' for the decimal point. */
__attribute__((format(printf, 1, 0))) static char *print_to_memory(const char *format, va_list args)
{
  locale_t c, before;
  if (!enter_c_locale(&c, &before)) return NULL;
  va_list again;
  va_copy(again, args);
  int n = vsnprintf(NULL, 0, format, args);
  char *text = n < 0 ? NULL : malloc((size_t)n + 1);
  if (text) vsnprintf(text, (size_t)n + 1, format, again);
  va_end(again);
  leave_c_locale(c, before);
  return text;
}

void table_note(table *t, const char *format, ...)
{
  if (!t || t->status != HC_OK) return;
  va_list args;
  va_start(args, format);
  char *text = print_to_memory(format, args);
  va_end(args);
  char *note = text ? utf8_clean(text, true) : NULL;
  free(text);
  char **notes = note && t->n_notes < INT_MAX ? growing(t->notes, (int)t->n_notes, sizeof *notes) : NULL;
  if (!notes) {
    free(note);
    give_up(t, HC_NO_MEMORY);
    return;
  }
  t->notes = notes;
  t->notes[t->n_notes++] = note;
}

void table_notes_of_rows(table *t)
{
  if (t) t->notes_split = true, t->n_first_notes = t->n_notes;
}

void table_wrap(table *t, int width)
{
  if (t) t->wrap = width > 0 ? width : 0;
}

void table_hide(table *t, const char *column)
{
  for (int i = 0; t && t->hidden && i < t->n_columns; ++i)
    if (!strcmp(t->columns[i].name, column)) t->hidden[i] = true;
}

void table_spare(table *t, const char *const *spare)
{
  if (t) t->spare = spare;
}

void table_fit(table *t, int width)
{
  if (t) t->fit = width > 0 ? width : 0;
}

void table_show_all(table *t)
{
  if (!t || !t->hidden) return;
  memset(t->hidden, 0, (size_t)t->n_columns * sizeof *t->hidden);
  t->spare = NULL;
}

int table_rows(const table *t) { return table_row_count(t); }

const char *table_title(const table *t) { return t->title; }

const table_column *table_column_at(const table *t, int j)
{
  return j >= 0 && j < t->n_columns ? &t->columns[j] : NULL;
}

/* That cell, NULL where it is not there, or of another kind. */
static const table_cell *cell_of_kind(const table *t, int row, int column, table_kind kind)
{
  if (row < 0 || row >= table_row_count(t) || column < 0 || column >= t->n_columns) return NULL;
  const table_cell *cell = table_at(t, row, column);
  return cell->there && t->columns[column].kind == kind ? cell : NULL;
}

const char *table_text_at(const table *t, int row, int column)
{
  const table_cell *cell = cell_of_kind(t, row, column, TABLE_TEXT);
  return cell ? cell->as.text : NULL;
}

double table_number_at(const table *t, int row, int column)
{
  const table_cell *real = cell_of_kind(t, row, column, TABLE_REAL);
  const table_cell *integer = cell_of_kind(t, row, column, TABLE_INTEGER);
  return real ? real->as.real : integer ? (double)integer->as.integer : NAN;
}

int table_series_at(const table *t, int row, int column, const double **values)
{
  const table_cell *cell = cell_of_kind(t, row, column, TABLE_SERIES);
  *values = cell ? cell->as.series + 1 : NULL;
  return cell ? (int)cell->as.series[0] : 0;
}

const char *table_note_at(const table *t, int i) { return i >= 0 && (size_t)i < t->n_notes ? t->notes[i] : NULL; }

void table_write_csv_text(const char *s, FILE *to)
{
  bool plain = *s && !strpbrk(s, ",\"\r\n") && !strchr("# \t", *s) && !strchr(" \t", s[strlen(s) - 1]);
  if (plain) {
    fputs(s, to);
    return;
  }
  putc('"', to);
  for (; *s; ++s) {
    if (*s == '"') putc('"', to);
    putc(*s, to);
  }
  putc('"', to);
}

static void write_csv_cell(const table *t, int row, int column, FILE *to)
{
  const table_cell *cell = table_at(t, row, column);
  if (!cell->there) {
    if (t->n_columns == 1) fputs("\"\"", to); /* an empty line would end the table */
    return;
  }
  switch (t->columns[column].kind) {
  case TABLE_TEXT: table_write_csv_text(cell->as.text, to); break;
  case TABLE_INTEGER: fprintf(to, "%ld", cell->as.integer); break;
  case TABLE_REAL: fprintf(to, "%.17g", cell->as.real); break; /* inf and -inf, too */
  case TABLE_SERIES: break;                                    /* for programs: rows.h */
  }
}

static void write_csv_notes(const table *t, size_t from, size_t to_note, FILE *to)
{
  for (size_t i = from; i < to_note; ++i) fprintf(to, *t->notes[i] ? "# %s\n" : "#\n", t->notes[i]);
}

/* The rows of t that have not been written, and what stands before the first one. */
static void write_csv_begun(const table *t, FILE *to, const table_begun *begun)
{
  if (!begun->begun) {
    if (begun->several) fprintf(to, *t->title ? "# %s\n" : "# table\n", t->title);
    write_csv_notes(t, 0, t->notes_split ? t->n_first_notes : t->n_notes, to);
    for (int j = 0; j < t->n_columns; ++j) {
      if (j) putc(',', to);
      table_write_csv_text(t->columns[j].name, to);
    }
    putc('\n', to);
  }
  for (int i = begun->rows; i < table_rows(t); ++i) {
    for (int j = 0; j < t->n_columns; ++j) {
      if (j) putc(',', to);
      write_csv_cell(t, i, j, to);
    }
    putc('\n', to);
  }
}

hc_status table_status(const table *t)
{
  if (!t) return HC_NO_MEMORY;
  if (t->status != HC_OK) return t->status;
  return t->n_cells % (size_t)t->n_columns == 0 ? HC_OK : HC_BUG;
}

hc_status table_write(int n, table *const *tables, table_format format, FILE *to)
{
  return table_write_rest(n, tables, format, to, &(table_begun){.several = n != 1});
}

hc_status table_write_begun(const table *t, table_format format, FILE *to, table_begun *begun)
{
  locale_t c, before;
  hc_status st = table_status(t);
  if (st != HC_OK || format == FORMAT_TABLE || table_rows(t) <= begun->rows) return st;
  if (!enter_c_locale(&c, &before)) return HC_NO_MEMORY;
  if (format == FORMAT_JSON) st = table_write_json_begun(t, to, begun);
  else write_csv_begun(t, to, begun);
  leave_c_locale(c, before);
  begun->begun = true;
  begun->rows = table_rows(t);
  return ferror(to) ? HC_IO : st;
}

hc_status table_write_rest(int n, table *const *tables, table_format format, FILE *to, const table_begun *begun)
{
  hc_status st = HC_OK;
  for (int k = 0; k < n && st == HC_OK; ++k) st = table_status(tables[k]);
  if (st != HC_OK) return st;
  locale_t c, before;
  if (!enter_c_locale(&c, &before)) return HC_NO_MEMORY;
  if (format == FORMAT_JSON) st = table_write_json(n, tables, to, begun);
  for (int k = 0; k < n && format != FORMAT_JSON && st == HC_OK; ++k) {
    const table *t = tables[k];
    if (k) putc('\n', to);
    if (format == FORMAT_CSV) {
      const table_begun later = {.several = begun->several};
      write_csv_begun(t, to, k ? &later : begun);
      if (t->notes_split) write_csv_notes(t, t->n_first_notes, t->n_notes, to);
    } else st = table_write_aligned(t, to);
  }
  leave_c_locale(c, before);
  return ferror(to) ? HC_IO : st;
}
