/* output.h - files written whole or not at all: a file appears under its name only when it is complete. output_open
 * writes beside it, output_commit renames, output_abandon removes; what stood there before stays until the commit. A
 * symbolic link keeps pointing and its target is replaced. What is no regular file (/dev/null, a fifo) is written
 * straight to, and so is a name for standard output itself (/dev/stdout). A new file gets 0666 less the umask, a
 * replaced one keeps its permissions. */
#pragma once

#include <stdio.h>

#include "numerics/base/status.h"

typedef struct output output;

/* path = NULL or "-" is standard output: flushed and checked by the commit, not closed.
 * HC_IO (a directory, no such folder, not writable; errno says which) or HC_NO_MEMORY, with *out = NULL. */
hc_status output_open(const char *path, output **out);
FILE *output_stream(output *o);
/* HC_IO when anything written so far was lost, a full disk or (with SIGPIPE ignored) a closed pipe; errno says why
 * and the file is as it was before output_open. Frees o either way. */
hc_status output_commit(output *o);
/* o = NULL does nothing. */
void output_abandon(output *o);

/* After writing ended with st: the commit; or the abandoning, and st. */
hc_status output_finish(output *o, hc_status st);

/* Characters a line has where `path` (NULL or "-": standard output) is read: those of standard output's terminal; of
 * standard error's where standard output is a pipe; else what the variable COLUMNS says; 0: not known, or no number.
 * *rows: lines of the former terminal, else 0. */
int output_columns(const char *path, int *rows);

/* Removes what is written beside, in a signal handler that ends the program. Async-signal-safe. */
void output_abandon_all(void);
