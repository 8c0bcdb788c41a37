/* rows.h - the columns of results, a table a kind, for all that shows, keeps or hands them over: csv, json, the aligned
 * table, C, Python, report, studies, the lab. A new column is a new line in rows.c and nothing else: its name, unit,
 * meaning and value. How they are written: compare/output/table.h. */
#pragma once

#include "compare/accuracy/accuracy.h"
#include "compare/comparison.h"
#include "compare/output/table.h"
#include "compare/response.h"
#include "compare/steady_states.h"
#include "compare/survey.h"
#include "proof/prove/prove.h"

typedef enum {
  ROWS_FRF,             /* of response_row      */
  ROWS_TRANSIENT,       /* of steady_row        */
  ROWS_COMPARE,         /* of comparison_row    */
  ROWS_CURVE,           /* of response_summary  */
  ROWS_SPECIALS,        /* of hbm_special       */
  ROWS_ACCURACY,        /* of accuracy_row      */
  ROWS_ORDER,           /* of order_row         */
  ROWS_CONTACT,         /* of contact_row       */
  ROWS_STEADY_CONTACT,  /* of steady_contact    */
  ROWS_COMPARE_CONTACT, /* of contact_comparison */
  ROWS_PROVE,           /* of proof_row          */
  ROWS_SURVEY,          /* of survey_row         */
  ROWS_KINDS
} rows_kind;

/* Columns of some tables: frequencies in cycles beside the omegas; the name of response or contact; what is for
 * programs alone, series of numbers among it; of HBM's solutions their bands. */
enum { ROWS_IN_CYCLES = 1, ROWS_RESPONSES = 2, ROWS_IN_MEMORY = 4, ROWS_BANDS = 8 };

enum { ROWS_MOST = 64, ROWS_TEXT = 128 }; /* columns of a kind, asserted; bytes of a text, the end included */

typedef struct row_series {
  int n;
  const double *v; /* the row's */
} row_series;

typedef struct row_cell {
  table_kind kind;
  bool there;
  union {
    char text[ROWS_TEXT];
    long integer;
    double real;
    row_series series;
  } as;
} row_cell;

/* The columns of a kind; how many. extra: a sum of those above. */
int rows_columns(rows_kind kind, unsigned extra, table_column columns[ROWS_MOST]);

/* "frf", "steady_contact": what describe and docs/columns.txt call that kind. */
const char *rows_name(rows_kind kind);

/* For table_spare: which of them a narrow screen does without, the first ones first. */
const char *const *rows_spare(rows_kind kind, bool in_cycles);

/* One row in the columns' order; how many. A real that is no number is not there. Cannot fail. */
int rows_cells(rows_kind kind, const void *row, unsigned extra, row_cell *cells);

/* "turning point", "contact goes from slip to separation": what happens there. Returns text. */
enum { ROWS_SPECIAL = 96 };
const char *rows_special_text(const hbm_special *p, char text[ROWS_SPECIAL]);

/* "0.6780359995"; where the error is two digits and more of these ten, "0.68 +- 0.12"; INFINITY: not known, in words.
 * Returns text. */
enum { ROWS_WITH_ERROR = 96 };
const char *rows_with_error(double value, double error, char text[ROWS_WITH_ERROR]);

/* Entry i of rows[] of that type. */
const void *rows_at(rows_kind kind, const void *rows, int i);
