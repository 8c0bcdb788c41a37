/* call.h - a command called by a program (interfaces/library), not by a shell: the same options, the same work. The
 * case is the caller's, ticks go to its monitor, and what the command would print is kept: tables, remarks. Signals,
 * standard streams and what else is the process's are left alone; any number of calls at a time. */
#pragma once

#include "interfaces/command/cli.h"

struct cli_call {
  const char *name; /* of the case file; with a text: what messages call it */
  const char *text; /* of the case, [length]; NULL: read the file */
  size_t length;
  int n_set;              /* assignments that stand before those of the options */
  const char *const *set; /* [n_set] */
  int n_points;           /* for verify, in the place of --against */
  const double *points;   /* [2][n_points] omega [rad/time], values; NULL: none */
  hc_monitor monitor;
  hc_status status; /* why the work as a whole ended early; HC_OK: it did not. Rows may have failed all the same */
  int n_tables, n_remarks;
  table **tables; /* [n_tables] whole ones */
  char **remarks; /* [n_remarks] what would be on standard error */
};

/* Runs it with options[n], "--at=6,8" or "--at", "6,8"; its exit code. --format, --wide, --plot and --help are not
 * there. The rest of *call is filled; cli_call_clear in any case. */
int cli_call_command(const cli_command *self, cli_call *call, int n, const char *const *options);
void cli_call_clear(cli_call *call);

/* What a command has written: for cli.c. Without memory the status says so. */
void cli_call_keep_table(cli_call *call, table *t);
void cli_call_keep_remark(cli_call *call, const char *format, va_list args);
