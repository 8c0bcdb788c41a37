/* shell.h - a line for sh, with $H for the built hbmcheck, in the current folder; its exit code and what it says are
 * held against expectations. */
#pragma once

#include "tests/shell.h"

typedef struct said {
  int code;
  char text[1 << 16];
} said;

static inline said shell(const char *line)
{
  static said s;
  s.code = shell_read(line, s.text, sizeof s.text);
  return s;
}

static inline void expect(const char *line, int code, const char *fragment)
{
  said s = shell(line);
  shell_check(line, s.code, s.text, code, fragment);
}
