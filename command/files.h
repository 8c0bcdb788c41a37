/* files.h - no output of a command may replace one of its inputs or another of its outputs: every command hands in the
 * files that it reads and writes before it opens or computes anything. Names that mean one file are told by device and
 * inode number (output/same_file.h); /dev/null, terminals and pipes may be given any number of times. */
#ifndef HC_CLI_FILES_H
#define HC_CLI_FILES_H

#include "command/cli.h"

typedef struct cli_file {
  const char *what; /* "--junit", "the curve": how messages call it                                                   */
  const char *path; /* NULL: there is none; "-": standard input or output, but for CLI_RESULTS                        */
  enum {
    CLI_INPUT,
    CLI_OUTPUT,
    CLI_RESULTS /* kept over several calls: read and written */
  } use;
} cli_file;

/* Hold files[n], the command's CASEs or STUDYs, and --output (without it, standard output) against each other. 0; or
 * EXIT_USAGE after a message that names both if an output is an input or another output; EXIT_NO_SOLUTION without
 * memory. Nothing is opened. */
int cli_check_files(const cli_common *common, int n, const cli_file *files);

#endif
