/* csv.h - a response curve from a text file of columns: strict, every mistake is one message FILE:LINE:COLUMN: what
 * is wrong, what was expected. '#' starts a line of remarks; blank lines are skipped; a first line without a
 * number is a header. CRLF and a byte order mark are accepted. Points at omega <= 0, to which a continuation may
 * wander, are counted and left out. */
#pragma once

#include <stdbool.h>

#include "compare/verify/curve_file/quantity.h"
#include "compare/verify/equations/causes.h"
#include "numerics/base/status.h"

enum { VERIFY_MOST_POINTS = 100000, VERIFY_LEAST_POINTS = 3, VERIFY_MOST_FIELDS = 256, VERIFY_NAME = 64 };

/* Where a column is: by number, or by its name in the header. */
typedef struct verify_column {
  int number; /* from 1; 0: by header */
  char header[VERIFY_NAME];
} verify_column;

typedef struct verify_columns {
  bool by_header; /* the file's own names say which columns are meant (recognise_columns) */
  verify_column omega, value;
  bool cycles;         /* the first is a frequency in cycles per time: times 2 pi */
  bool quantity_given; /* with by_header: by --quantity */
  verify_quantity quantity;
  const char *response; /* in a file with a column `response` only the lines are read that have this one; NULL: all */
} verify_columns;

typedef struct verify_point {
  double omega, value; /* [rad/time] > 0; the quantity, not in dB */
  long line;           /* in the file, from 1 */
} verify_point;

typedef struct verify_data {
  int response; /* of the model, counted from 0: what moves so */
  verify_quantity quantity;
  int n;
  verify_point *points; /* [n] in the file's order */
  int left_out;         /* points at omega <= 0 */
  bool by_response;     /* lines of other responses were left out */
  double noise;         /* [1] standard deviation of a value, relative to its scale, as of a measured curve; 0: none */
  bool with_line;       /* the report is to hold the truth's curve, for a drawing */
} verify_data;

/* "omega=1,amplitude=2", NAME=NUMBER or NAME=HEADER; names: omega or frequency, and a quantity or `value`. `quantity`:
 * what value is, NULL if not told. `text` NULL: by the file's header. HC_BAD_INPUT with message[VERIFY_TEXT]. */
hc_status verify_columns_read(const char *text, const char *quantity, verify_columns *out, char *message);

/* The points of arrays omega[n] [rad/time] and value[n] of the quantity with that name, which scatter by `noise`, 0..1;
 * lines are counted from 1. HC_OK, or HC_BAD_INPUT, HC_NO_MEMORY with message[VERIFY_TEXT]. Free with
 * verify_data_clear in any case. */
hc_status verify_data_of(const char *quantity, double noise, int n, const double *omega, const double *value,
                         verify_data *out, char *message);

/* HC_OK, or HC_BAD_INPUT, HC_IO, HC_NO_MEMORY with message[VERIFY_TEXT]. Free with verify_data_clear in any case. */
hc_status verify_data_read(const char *path, const verify_columns *columns, verify_data *out, char *message);
void verify_data_clear(verify_data *d);
