/* table_private.h - what a table holds, for table.c and the writers of each format. */
#pragma once

#include "compare/output/table.h"

typedef struct table_cell {
  bool there; /* false: missing, whatever the kind (a NaN is stored so) */
  union {
    char *text;
    long integer;
    double real;
    double *series; /* owned: how many, then the numbers */
  } as;             /* by the column's kind; text is owned, valid UTF-8 */
} table_cell;

struct table {
  int holders;
  char *title;           /* one line, "" for none */
  int n_columns;         /* 0: the columns given were wrong, and status is not HC_OK */
  table_column *columns; /* [n_columns] */
  size_t n_cells;        /* a row after another; n_cells is a multiple of n_columns between rows */
  table_cell *cells;
  size_t n_notes;
  char **notes;     /* one line each */
  bool notes_split; /* csv has the notes from n_first_notes on behind the rows */
  size_t n_first_notes;
  bool *hidden;             /* [n_columns] left out of the aligned format */
  int wrap;                 /* columns of the terminal to fit into, 0: each row is one line */
  int fit;                  /* longest line of the aligned format, 0: any */
  const char *const *spare; /* columns it may lose to fit, the first ones first; NULL: none */
  hc_status status;         /* HC_OK, or what went wrong first: nothing is appended any more */
};

static inline int table_row_count(const table *t)
{
  return t && t->n_columns ? (int)(t->n_cells / (size_t)t->n_columns) : 0;
}

static inline const table_cell *table_at(const table *t, int row, int column)
{
  return &t->cells[(size_t)row * (size_t)t->n_columns + (size_t)column];
}

/* Called with the C locale in force; HC_OK or HC_NO_MEMORY: whether the stream failed is the caller's to ask. */
hc_status table_write_aligned(const table *t, FILE *to);
/* A csv cell, quoted by RFC 4180, where a reader might strip or skip it, and for empty text. */
void table_write_csv_text(const char *s, FILE *to);
hc_status table_write_json(int n, table *const *tables, FILE *to, const table_begun *begun);
/* The rows of the first table from begun->rows on, with what stands before the first one. */
hc_status table_write_json_begun(const table *t, FILE *to, const table_begun *begun);
