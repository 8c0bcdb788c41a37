/* shell.h - a line for sh, with $H for the built hbmcheck, in the current folder; its exit code and what it says are held against expectations. */
#ifndef HC_TESTS_FAULTS_SHELL_H
#define HC_TESTS_FAULTS_SHELL_H

#include <stdio.h>
#include <string.h>
#include <sys/wait.h>

#include "tests/check.h"

typedef struct said { int code; char text[1 << 16]; } said;

static inline said shell(const char *line)
{
  static said s;
  FILE *pipe = popen(line, "r");
  assert_non_null(pipe);
  s.text[fread(s.text, 1, sizeof s.text - 1, pipe)] = 0;
  int status = pclose(pipe);
  s.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return s;
}

static inline void expect(const char *line, int code, const char *fragment)
{
  said s = shell(line);
  if (s.code == code && strstr(s.text, fragment)) return;
  print_error("%s\nexit %d, expected %d; expected to read '%s' in:\n%s\n", line, s.code, code, fragment, s.text);
  fail();
}

#endif
