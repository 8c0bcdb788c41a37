/* run.h - a page written by the built command, and a file in memory. */
#ifndef HC_TESTS_REPORT_RUN_H
#define HC_TESTS_REPORT_RUN_H

#include <stdbool.h>
#include <string.h>

#include "tests/program.h"

/* A comparison of two frequencies, tables of two orders: what a page has, in a second. */
#define CASE2 "cases/paper/case2.yaml"
#define SMALL " --at 8,9 --harmonics 1,5 --samples 32,512 -q "

/* The whole file, zero-terminated; to be freed. */
static inline char *contents(const char *path, size_t *length)
{
  FILE *f = fopen(path, "rb");
  assert_non_null(f);
  assert_int_equal(fseek(f, 0, SEEK_END), 0);
  long n = ftell(f);
  rewind(f);
  char *text = calloc((size_t)n + 1, 1);
  assert_non_null(text);
  *length = fread(text, 1, (size_t)n, f);
  assert_int_equal(*length, (size_t)n);
  fclose(f);
  return text;
}

/* A folder for one test; what is in it is the test's to remove. */
static inline void make_folder(char path[64])
{
  snprintf(path, 64, "/tmp/hbmcheck-report-XXXXXX");
  assert_non_null(mkdtemp(path));
}

#endif
