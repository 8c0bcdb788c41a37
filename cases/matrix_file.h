/* matrix_file.h - a square matrix from a Matrix Market file (https://math.nist.gov/MatrixMarket/formats.html), read
 * strictly: coordinate or array, real or integer, general, symmetric or skew-symmetric. Of the two symmetries the file
 * gives the lower triangle, as the format says. What is missing from a coordinate file is 0. */
#ifndef HC_MATRIX_FILE_H
#define HC_MATRIX_FILE_H

#include <stddef.h>

#include "base/message.h"
#include "base/status.h"

enum { MATRIX_MOST_ROWS = 4000 }; /* a matrix is kept dense: 128 MB */

/* (*values)[n][n], n = *rows, by columns and to free in any case, from the file at `path`. It must have `expected`
 * rows unless expected = 0. HC_BAD_INPUT with "PATH:LINE:COLUMN: what is wrong, what was expected" in m; HC_IO where
 * there is no such file or none that can be read, with the words for it alone ("cannot be opened: ..."), which are the
 * caller's to place; HC_NO_MEMORY. */
hc_status matrix_file_read(const char *path, int expected, int *rows, double **values, message *m);

/* The same from text[length], which `name` stands for. */
hc_status matrix_file_parse(const char *name, const char *text, size_t length, int expected, int *rows, double **values,
                            message *m);

/* Where the file at `path`, which has been read before, gives entry (row, column), both from 0, or by symmetry its
 * transpose: line and column from 1, or *line = 0 where it does not. */
void matrix_file_place(const char *path, int row, int column, size_t *line, size_t *place);

#endif
