/* program.h - the built hbmcheck (HBMCHECK_COMMAND) as people and scripts run it: what it says, and its exit code. */
#pragma once

#include "tests/shell.h"

/* What the last run said. */
static char out[1 << 20];

/* "hbmcheck ARGS"; stdout, or both streams with " 2>&1" in args, into out[]. The exit code. */
static inline int run(const char *args)
{
  char line[2048];
  snprintf(line, sizeof line, "%s %s", HBMCHECK_COMMAND, args);
  return shell_read(line, out, sizeof out);
}

static inline void expect(const char *args, int code, const char *fragment)
{
  shell_check(args, run(args), out, code, fragment);
}
