/* matlab_file.h - a square matrix from a variable of a MATLAB file, named `rom.mat#M`: versions 4, 5 (compressed or
 * not) and 7.3; full (real, single or an integer type) or sparse; a row or a column stands for a diagonal matrix.
 * By libmatio, where built with HBMCHECK_MATIO; otherwise every such name is refused (matlab_none.c).
 *
 * libmatio and HDF5 crash on some damaged files, loop on others, and give out what memory held where a file is cut
 * short. Therefore a child process reads (matlab_child.c), and version 5 is checked beforehand (matlab_layout.h). */
#ifndef HC_MATLAB_FILE_H
#define HC_MATLAB_FILE_H

#include <stdbool.h>

#include "base/message.h"
#include "base/status.h"

/* Does `name` mean a MATLAB file: FILE.mat#VARIABLE or FILE.mat, in any case of letters? */
bool matlab_file_meant(const char *name);

/* (*values)[n][n], n = *rows, by columns and to free in any case, of what `name` names; without #VARIABLE, of the only
 * variable of the file. It must have `expected` rows unless expected = 0. HC_BAD_INPUT with what is wrong and what was
 * expected in m, words that follow `name` ("is complex, expected ..."); HC_IO where there is no such file or none that
 * can be opened, likewise ("cannot be opened: ..."); HC_NO_MEMORY. Needs no lock: it may be called by any thread. */
hc_status matlab_file_read(const char *name, int expected, int *rows, double **values, message *m);

#endif
