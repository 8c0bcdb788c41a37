/* matrix_text.h - a file of numbers as lines of words, and the entries of a matrix in it: what the readers of
 * matrices' formats share, and these formats. A message starts with the place, "NAME:LINE:COLUMN: ". */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "model/casefile/matrices/matrix_file.h"
#include "numerics/base/message.h"
#include "numerics/base/status.h"

enum { MATRIX_WORDS = 20 }; /* kept of a line; a line of Abaqus has at most 16 */

typedef struct matrix_word {
  const char *text;
  size_t length;
} matrix_word;

typedef enum matrix_symmetry { MATRIX_GENERAL, MATRIX_SYMMETRIC, MATRIX_SKEW } matrix_symmetry;

/* As a line gives it; row and column from 0. */
typedef struct matrix_entry {
  int row, column;
  double value;
  unsigned line, place; /* of the file; column of the line, from 1 */
} matrix_entry;

typedef struct matrix_text {
  const char *name, *text, *end;
  const char *comment; /* what lines of comment start with */
  bool commas;         /* words are parted by commas or blanks; else by blanks alone */
  bool integers;       /* numbers must be */
  bool coordinate;     /* of Matrix Market: each entry with its row and column */
  matrix_symmetry symmetry;
  const char *line_text; /* of the line being read */
  const char *next;      /* the line after it      */
  size_t line;           /* its number, from 1     */
  int n_words;           /* at most MATRIX_WORDS are kept, and one more counted */
  matrix_word words[MATRIX_WORDS];
  const char *part; /* of those in the file the one that is asked for, or NULL */
  int expected, n;  /* rows; expected = 0: any number */
  int n_entries;
  matrix_entry *entries; /* as they come; mirrored with that sign beside the diagonal, 0: given as they are */
  int mirrored;
  sparse matrix;        /* of them */
  matrix_label *labels; /* [n], or NULL where the format has none */
  message *m;
} matrix_text;

matrix_text matrix_text_start(const char *name, const char *text, size_t length, int expected, message *m);

/* Frees what is left of entries, matrix and labels. */
void matrix_text_free(matrix_text *r);

/* Before the first line again. */
void matrix_text_rewind(matrix_text *r);

/* The next line into words; false at the end of the text. matrix_text_next skips blank lines and comments. */
bool matrix_text_line(matrix_text *r);
bool matrix_text_next(matrix_text *r);

#define MATRIX_QUOTED(word) QUOTED((word).text, (word).length)

/* Is it that word, in any case of letters? `name` is in lower case. */
bool matrix_word_is(const matrix_word *w, const char *name);

/* Start the message with the place of `at` in the current line; NULL: of the text's end. */
message *matrix_text_blame(matrix_text *r, const char *at);

/* The whole message, printf-style, about that place. Always HC_BAD_INPUT. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
hc_status
matrix_text_refuse(matrix_text *r, const char *at, const char *format, ...);

/* Word i as an integer from..to, of which `what` tells; as a finite number. Else the message is made. */
bool matrix_text_integer(matrix_text *r, int i, int from, long to, const char *what, int *value);
bool matrix_text_number(matrix_text *r, int i, double *value);

/* Entry (i, j), from 0, is given by the current line, at `at`. HC_NO_MEMORY. */
hc_status matrix_text_put(matrix_text *r, int i, int j, double value, const char *at);

/* r->matrix of all entries, r->n rows. HC_BAD_INPUT with the message if one is there twice; HC_NO_MEMORY. */
hc_status matrix_text_assemble(matrix_text *r);

/* The same about an entry's place. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
hc_status
matrix_text_refuse_entry(matrix_text *r, const matrix_entry *e, const char *format, ...);

/* The matrix has r->n rows, read to its end. HC_BAD_INPUT with the message if others are expected. */
hc_status matrix_text_check_rows(matrix_text *r, int n);

/* ---- the formats, each recognised by what its first line says; matrix_file.c chooses ----
 *
 * Each reads all of r's text into r->matrix, or returns HC_BAD_INPUT with the message made, or HC_NO_MEMORY. */

/* Matrix Market, https://math.nist.gov/MatrixMarket/formats.html: its banner comes first. matrix_market.c */
hc_status matrix_market_parse(matrix_text *r);

/* Lines of row, column and value, parted by blanks or commas, rows counted from 1: CalculiX (*FREQUENCY,
 * SOLVER=MATRIXSTORAGE: JOB.sti, JOB.mas) and Abaqus (*MATRIX OUTPUT, FORMAT=COORDINATE). The upper or the lower
 * triangle of a symmetric matrix; or both, each entry with its mirror image, of any. triplets.c */
hc_status triplets_parse(matrix_text *r);

/* Abaqus' default, *MATRIX OUTPUT, FORMAT=MATRIX INPUT: lines of node, DOF, node, DOF, value; CalculiX' OUTPUT
 * FILE=MATRIX. Rows: DOFs with a diagonal entry, by node, then DOF: r->labels. Triangles as of triplets. triplets.c */
hc_status labelled_triplets_parse(matrix_text *r);

/* Abaqus' *SUBSTRUCTURE MATRIX OUTPUT and *ELEMENT MATRIX OUTPUT, OUTPUT FILE=USER DEFINED, and CalculiX': the header
 * *USER ELEMENT, then *MATRIX,TYPE=STIFFNESS, TYPE=MASS and so on, each with the rows of its lower triangle. Of these
 * the one that r->part names, in capitals without blanks; if NULL, the first. r->labels where the header tells all of
 * them. abaqus_element.c */
hc_status abaqus_element_parse(matrix_text *r);
