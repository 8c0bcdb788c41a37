/* shell.h - a line for sh, for tests of the command: its exit code, what it says, and both held against
 * expectations. */
#pragma once

#include <sys/wait.h>

#include "tests/check.h"

/* What `line` prints into out[size], zero-terminated; what does not fit is read and dropped, since a closed pipe
 * would end the program. Returns the exit code, as sh does: 128 and the signal's number for what a signal ended. */
static inline int shell_read(const char *line, char *out, size_t size)
{
  FILE *pipe = popen(line, "r");
  assert_non_null(pipe);
  out[fread(out, 1, size - 1, pipe)] = 0;
  while (fgetc(pipe) != EOF) {}
  int status = pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* Fails with everything there is to see unless the code is the expected one and `fragment` was said. */
static inline void shell_check(const char *line, int code, const char *out, int expected, const char *fragment)
{
  if (code == expected && strstr(out, fragment)) return;
  print_error("%s\nexit %d, expected %d; expected to read '%s' in:\n%s\n", line, code, expected, fragment, out);
  fail();
}
