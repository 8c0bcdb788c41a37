/* text_file.h - a file that a case file names, whole in memory. */
#pragma once

#include <stddef.h>
#include <stdio.h>

#include "numerics/base/message.h"
#include "numerics/base/status.h"

/* The bytes of the file at `path`, at most `most` of them, with a NUL behind them, to free in any case. HC_IO
 * with the words for it in m, which are to follow the file's name ("cannot be opened: ..."); HC_NO_MEMORY. */
hc_status text_file_read(const char *path, size_t most, char **text, size_t *length, message *m);
