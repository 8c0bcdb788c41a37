/* rows.h - the columns of results, one table a kind, for everything that shows or keeps them: the commands, the
 * study. Names: docs/interface.md, 3. A new column is a new line in rows.c and nothing else. Not here: how they are
 * written (output/table.h). */
#ifndef HC_ROWS_H
#define HC_ROWS_H

#include "compare/accuracy/accuracy.h"
#include "compare/comparison.h"
#include "compare/response.h"
#include "compare/steady_states.h"
#include "output/table.h"

typedef enum {
  ROWS_FRF,
  ROWS_TRANSIENT,
  ROWS_COMPARE,
  ROWS_CURVE,
  ROWS_ACCURACY,
  ROWS_ORDER,
  ROWS_CONTACT,
  ROWS_STEADY_CONTACT,
  ROWS_COMPARE_CONTACT
} rows_kind;

/* Columns that only some cases have: frequencies in cycles per time beside the omegas; the name of the response or
 * contact. */
enum { ROWS_IN_CYCLES = 1, ROWS_RESPONSES = 2 };

enum { ROWS_MOST = 48, ROWS_TEXT = 32 }; /* columns of a kind, asserted; bytes of a text, the end included */

typedef struct row_cell {
  table_kind kind;
  bool there;
  union {
    char text[ROWS_TEXT];
    long integer;
    double real;
  } as;
} row_cell;

/* The columns of a kind, *n of them; constant. extra: a sum of ROWS_IN_CYCLES and ROWS_RESPONSES. */
const table_column *rows_columns(rows_kind kind, unsigned extra, int *n);

/* For table_spare: which of them a narrow screen does without, the first ones first. */
const char *const *rows_spare(rows_kind kind, bool in_cycles);

/* One row: cells[n] in the columns' order. A real that is not a number is not there. Cannot fail. */
void rows_frf(const response_row *r, unsigned extra, row_cell *cells);
void rows_transient(const steady_row *r, unsigned extra, row_cell *cells);
void rows_compare(const comparison_row *r, unsigned extra, row_cell *cells);
void rows_curve(const response_summary *r, unsigned extra, row_cell *cells);
void rows_accuracy(const accuracy_row *r, unsigned extra, row_cell *cells);
void rows_order(const order_row *r, unsigned extra, row_cell *cells);
void rows_contact(const contact_row *r, unsigned extra, row_cell *cells);
void rows_steady_contact(const steady_contact *r, unsigned extra, row_cell *cells);
void rows_compare_contact(const contact_comparison *r, unsigned extra, row_cell *cells);

#endif
