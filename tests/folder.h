/* folder.h - a new folder of the test program's own, in /tmp: $D in lines for sh, in which $H is the built hbmcheck. */
#pragma once

#include "tests/check.h"

static char folder[] = "/tmp/hbmcheck-test-XXXXXX";

/* Setup and teardown of the group of tests that share it. */
static inline int folder_make(CHECK_STATE)
{
  if (!mkdtemp(folder)) return -1;
#ifdef HBMCHECK_COMMAND
  setenv("H", HBMCHECK_COMMAND, 1);
#endif
  return setenv("D", folder, 1);
}

static inline int folder_remove(CHECK_STATE) { return system("cd / && rm -r \"$D\""); }

/* Setup: the folder becomes the current one. */
static inline int folder_enter(void **state) { return folder_make(state) == 0 ? chdir(folder) : -1; }

static inline FILE *folder_open(const char *name, const char *mode)
{
  char path[256];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *f = fopen(path, mode);
  if (!f) fail_msg("%s cannot be opened", path);
  return f;
}

/* A file with this text. */
static inline void folder_put(const char *name, const char *text)
{
  FILE *to = folder_open(name, "w");
  fputs(text, to);
  assert_int_equal(fclose(to), 0);
}

/* The file, zero-terminated; to be freed. *length, if not NULL, gets its bytes. */
static inline char *folder_read(const char *name, size_t *length)
{
  FILE *from = folder_open(name, "rb");
  assert_int_equal(fseek(from, 0, SEEK_END), 0);
  const size_t n = (size_t)ftell(from);
  rewind(from);
  char *text = calloc(n + 1, 1);
  assert_non_null(text);
  assert_int_equal(fread(text, 1, n, from), n);
  fclose(from);
  if (length) *length = n;
  return text;
}
