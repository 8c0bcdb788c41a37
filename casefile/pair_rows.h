/* pair_rows.h - the rows of `pairs`, which nodes touch, from a csv file or from the case itself:
 *
 *     node_a,node_b[,gap][,preload][,area]      node_b may be `ground`
 *
 * The first row names the columns, in any order; in the case it may be left out where there are but the two nodes. */
#ifndef HC_PAIR_ROWS_H
#define HC_PAIR_ROWS_H

#include "casefile/case_reader.h"
#include "casefile/matrices/matrix_text.h"

typedef enum pair_column { PAIR_NODE_A, PAIR_NODE_B, PAIR_GAP, PAIR_PRELOAD, PAIR_AREA, PAIR_COLUMNS } pair_column;

enum { PAIR_GROUND = -1 };

typedef struct pair_row {
  int a, b;                  /* nodes; b may be PAIR_GROUND */
  double gap, preload, area; /* 0, 0 and 1 where there is no such column */
} pair_row;

typedef struct pair_rows {
  case_reader *r;
  yaml_document_t *doc;
  const yaml_node_t *list; /* of rows in the case; NULL: a file */
  char *path, *bytes;      /* of the file */
  matrix_text text;
  int next;                   /* row of the list */
  int columns;                /* in a row */
  int column[PAIR_COLUMNS];   /* where each stands in a row; -1: nowhere */
  const yaml_node_t *current; /* row of the list, or NULL */
} pair_rows;

/* Open what the node of `pairs` names or holds, up to the names of the columns. pair_rows_close takes it however this
 * ended. HC_BAD_INPUT with the message made, HC_NO_MEMORY. */
hc_status pair_rows_open(pair_rows *p, case_reader *r, yaml_document_t *doc, const yaml_node_t *node);
void pair_rows_close(pair_rows *p);

/* The next row; *more = false at the end. */
hc_status pair_rows_next(pair_rows *p, pair_row *row, bool *more);

/* Start the message with the place of a column in the row read last; a column that there is. */
message *pair_rows_blame(pair_rows *p, pair_column c);

#endif
