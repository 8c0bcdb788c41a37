/* matlab_child.h - a variable of a MATLAB file, read in a process of its own; matlab_none.c where built without
 * libmatio. */
#ifndef HC_MATLAB_CHILD_H
#define HC_MATLAB_CHILD_H

#include "base/message.h"
#include "base/status.h"

/* matlab_file_read (matlab_file.h) of the file at `path`; `variable` may be NULL. */
hc_status matlab_child_read(const char *path, const char *variable, int expected, int *rows, double **values,
                            message *m);

#endif
