/* matrix_file.h - a square matrix from a text file, read strictly: Matrix Market, or what CalculiX and Abaqus write.
 * The file's first line tells which, not its name; matrix_text.h says what each of them has. What is missing from a
 * file of single entries is 0. Matrix Market (https://math.nist.gov/MatrixMarket/formats.html): coordinate or array,
 * real or integer, general, symmetric or skew-symmetric, of the two symmetries the lower triangle, as the format says.
 */
#pragma once

#include <stddef.h>

#include "numerics/base/status.h"
#include "numerics/sparse.h"

struct message; /* numerics/base/message.h */

/* What a row of a matrix stands for, where its file says it. */
typedef struct matrix_label {
  int node, dof; /* 1..3 along x, y, z; 4..6 rotations; others as the program has them */
} matrix_label;

enum {
  MATRIX_MOST_ROWS = 10000000, /* of a file of single entries */
  MATRIX_MOST_DENSE = 2000     /* of a matrix that is kept, or given, whole */
};

/* *out, to free in any case, from the file at `path`: of several matrices in it
 * the one that `part` names ("MASS", "STIFFNESS", "VISCOUSDAMPING"; NULL: the first). It must have `expected` rows
 * unless expected = 0. (*labels)[n], to free in any case, or NULL where there are none; labels may be NULL.
 * HC_BAD_INPUT with "PATH:LINE:COLUMN: what is wrong, what was expected" in m; HC_IO where there is no such file or
 * none that can be read, with the words for it alone ("cannot be opened: ..."), which are the caller's to place;
 * HC_NO_MEMORY. */
hc_status matrix_file_read(const char *path, const char *part, int expected, sparse *out, matrix_label **labels,
                           struct message *m);

/* The same from text[length], which `name` stands for. */
hc_status matrix_file_parse(const char *name, const char *text, size_t length, const char *part, int expected,
                            sparse *out, matrix_label **labels, struct message *m);

/* Where the file at `path`, which has been read before, gives entry (row, column) of the part, both from 0, or by
 * symmetry its transpose: line and column from 1, or *line = 0 where it does not. */
void matrix_file_place(const char *path, const char *part, int row, int column, size_t *line, size_t *place);
