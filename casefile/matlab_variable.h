/* matlab_variable.h - a variable of a MATLAB file by libmatio, in this process (matlab_child.h: in another), and the
 * square matrix that it is. */
#ifndef HC_MATLAB_VARIABLE_H
#define HC_MATLAB_VARIABLE_H

#include <matio.h>

#include "base/message.h"
#include "base/status.h"

/* As matlab_child_read (matlab_child.h), but a damaged file may end the process, and libmatio is not for two threads
 * at once. */
hc_status matlab_variable_read(const char *path, const char *variable, int expected, int *rows, double **values,
                               message *m);

/* Is v, of which only type and dimensions may be known yet, a real square matrix or a diagonal, of `expected` rows
 * unless expected = 0? *n gets its rows. HC_BAD_INPUT as in matlab_file.h. */
hc_status matlab_matrix_check(const matvar_t *v, int expected, int *n, message *m);

/* The matrix [n][n] by columns of v, which has been read and passed matlab_matrix_check, into out, which is all 0.
 * Nothing is believed of v but that each block of memory is as long as v says. HC_BAD_INPUT as in matlab_file.h. */
hc_status matlab_matrix_fill(const matvar_t *v, int n, double *out, message *m);

#endif
