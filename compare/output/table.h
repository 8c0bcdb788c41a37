/* table.h - results as rows of named columns, written as an aligned table, csv (17 significant digits) or json.
 * Column names: docs/interface.md, 3. A value that is not there (NaN, NULL) is empty in csv and table, null in json.
 * Infinities are inf and -inf in csv and table, null in json. The decimal point is '.' whatever locale the host
 * program has set; text comes out as valid UTF-8. Not here: the file it goes to (output.h). */
#pragma once

#include <stdbool.h>
#include <stdio.h>

#include "numerics/base/status.h"

typedef enum { TABLE_TEXT, TABLE_INTEGER, TABLE_REAL, TABLE_SERIES } table_kind;
typedef struct {
  const char *name;
  table_kind kind;            /* TABLE_SERIES: numbers, for programs: no writer has the column */
  const char *unit, *meaning; /* "length", "1"; what it is: constant strings, or NULL */
} table_column;
#define TEXT(name)                                                                                                     \
  {                                                                                                                    \
    name, TABLE_TEXT                                                                                                   \
  }
#define INTEGER(name)                                                                                                  \
  {                                                                                                                    \
    name, TABLE_INTEGER                                                                                                \
  }
#define REAL(name)                                                                                                     \
  {                                                                                                                    \
    name, TABLE_REAL                                                                                                   \
  }
typedef enum { FORMAT_TABLE, FORMAT_CSV, FORMAT_JSON } table_format;

typedef struct table table;

/* A table is its holders': table_new's and each table_keep's; the last table_free frees it. NULL stays NULL. */
table *table_keep(table *t);

/* The columns and their names, which differ from each other, are copied, and so is the title, which may be NULL.
 * Appending after a failed allocation, or to NULL, does nothing; table_write reports HC_NO_MEMORY then. So it is with
 * HC_BUG after a mistake of the caller's: no columns, two of one name, a value that is not of its column's kind. */
table *table_new(const char *title, int n_columns, const table_column *columns);
void table_free(table *t);

/* A row is its values in column order. A put fills the next cell, rows start by themselves; kinds must be the columns'
 * and the last row full, else table_write answers HC_BUG. Text is copied; only the table has spaces for line breaks. */
void table_put_text(table *t, const char *value);
void table_put_integer(table *t, long value);
void table_put_real(table *t, double value);
void table_put_series(table *t, int n, const double *values);
void table_put_missing(table *t);

/* A row's values: CELL(x) of text, integer or real; CELL_IF(there, x), else missing; CELL_OF(has, x): if it has it. */
typedef struct table_value {
  table_kind kind;
  bool has, there;
  union {
    const char *text;
    long integer;
    double real;
  } as;
} table_value;
void table_put_values(table *t, int n, const table_value *values);
/* clang-format off */
#define TABLE_ROW(t, ...) \
  table_put_values(t, sizeof (table_value[]){__VA_ARGS__} / sizeof(table_value), (table_value[]){__VA_ARGS__})
#define CELL(x) CELL_OF(true, x)
#define CELL_IF(there, x) TABLE_VALUE(true, there, x)
#define CELL_OF(has, x) TABLE_VALUE(has, true, x)
#define TABLE_VALUE(has, there, x) \
  _Generic((x), double: table_real, int: table_integer, long: table_integer, char *: table_text, \
           const char *: table_text)(has, there, x)
/* clang-format on */
static inline table_value table_text(bool has, bool there, const char *text)
{
  return (table_value){TABLE_TEXT, has, there, .as.text = text};
}
static inline table_value table_integer(bool has, bool there, long integer)
{
  return (table_value){TABLE_INTEGER, has, there, .as.integer = integer};
}
static inline table_value table_real(bool has, bool there, double real)
{
  return (table_value){TABLE_REAL, has, there, .as.real = real};
}
/* A remark, one line: after the table; in csv "# ..." before the header, in json under "notes". */
void table_note(table *t, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* For table_write_begun: remarks from here on are about the rows, and stand behind them in csv, too. */
void table_notes_of_rows(table *t);

/* Format table: texts go on in further lines and are not cut; a line is longer than `width` only where it must be. */
void table_wrap(table *t, int width);

/* In the format table, leave that column out. csv and json have it. */
void table_hide(table *t, const char *column);

/* In the format table, what lines longer than `width` lose: the columns of `spare`, NULL at the end, one after the
 * other until the rest fits, with a remark that says so; empty ones go first. If that does not do, the rest stands in
 * blocks under each other, each of which begins with the columns that tell rows apart, and texts go on in more lines.
 * A table that is wrapped loses columns of `spare` only where words would have to be broken. The list must outlive the
 * table; NULL: nothing to lose. */
void table_spare(table *t, const char *const *spare);
void table_fit(table *t, int width); /* 0: as long as they are, the default */

/* In the format table, every column, also those that were hidden or to spare. */
void table_show_all(table *t);

/* Full rows so far. */
int table_rows(const table *t);

/* What is in it, for programs. Column j and remark i: NULL past the last. Of a cell that is not there, or of another
 * kind: NULL, NaN, 0 numbers and NULL. */
const char *table_title(const table *t);
const table_column *table_column_at(const table *t, int j);
const char *table_text_at(const table *t, int row, int column);
double table_number_at(const table *t, int row, int column);
int table_series_at(const table *t, int row, int column, const double **values);
const char *table_note_at(const table *t, int i);
/* HC_OK where all its rows are full and nothing went wrong before. HC_NO_MEMORY, HC_BUG. */
hc_status table_status(const table *t);

/* All tables of one command.
 * table: one after another, each under its title; 7 significant digits, a column in one notation with its decimal
 *        points aligned. A text of more than 60 columns goes on in the next line unless it is the row's last.
 *        On a terminal remarks are broken at blanks.
 * csv:   RFC 4180 quoting, lines end in \n, tables separated by a blank line, "# title" first when n > 1. Empty text is
 *        "" in quotes: not missing.
 * json:  for n = 1 {"rows": [{column: value}, ...], "notes": [...]}; else one object {"title": [{column: value}, ...],
 *        ..., "notes": {"title": [...], ...}} with the notes of the tables that have some. A second table of one title
 *        has the key "title (2)", one without a title "table".
 * HC_NO_MEMORY or HC_BUG (see above) if a table came to that before; then nothing is written. HC_IO once the stream has
 * failed; a failure of what is still in its buffer is found by output_commit. */
hc_status table_write(int n, table *const *tables, table_format format, FILE *to);

/* The same bytes in parts, in csv and json: the first table's rows as they are found, then the rest. */
typedef struct table_begun {
  bool several; /* more tables will follow the first: n > 1 */
  bool begun;   /* what stands before the first row has been written */
  int rows;     /* and so many rows */
  int failed;   /* errno of the write that failed, for who writes the rest; 0: none */
} table_begun;

/* The rows of t that have not been written, and what stands before the first one. table_notes_of_rows was called;
 * nothing is written without a row. HC_NO_MEMORY, HC_BUG, HC_IO as of table_write. */
hc_status table_write_begun(const table *t, table_format format, FILE *to, table_begun *begun);
/* All that is left: tables[0] has the rows and the remarks that were written, and maybe more. */
hc_status table_write_rest(int n, table *const *tables, table_format format, FILE *to, const table_begun *begun);
