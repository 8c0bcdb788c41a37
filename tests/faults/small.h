/* small.h - the scene of these tests, small/small.yaml, and a folder with what is in small/. */
#pragma once

#include <signal.h>

#include "casefile/case_file.h"
#include "tests/check.h"

#define SMALL SOURCE_DIR "/tests/faults/small"

/* The scene, with --set assignments applied; the list ends with NULL. */
static inline scene small_scene(const char *const *set)
{
  scene sc;
  case_error err;
  int n = 0;
  while (set && set[n]) ++n;
  if (case_read(SMALL "/small.yaml", n, set, &sc, &err) != HC_OK) fail_msg("%s", err.message);
  return sc;
}

/* What is being tried; told if it hangs. */
static char small_doing[200];

static inline void small_hangs(int number)
{
  (void)number;
  ssize_t written = write(2, small_doing, strlen(small_doing));
  _exit(written > 0 ? 98 : 97);
}

/* check_watchdog that says in what the program hung. */
static inline void small_watchdog(unsigned seconds)
{
  signal(SIGALRM, small_hangs);
  check_watchdog(seconds);
}

static inline void small_file(const char *name, const char *text)
{
  FILE *to = fopen(name, "w");
  assert_non_null(to);
  assert_true(fputs(text, to) >= 0);
  assert_int_equal(fclose(to), 0);
}

/* Times in a JUnit file, which differ from run to run, become 0. */
static inline char *small_without_times(char *text)
{
  for (char *at = text; (at = strstr(at, " time=\"")) != NULL;)
    for (at += strlen(" time=\""); *at && *at != '"'; ++at)
      if (*at != '.') *at = '0';
  return text;
}

/* The files of small/ in a new folder, which becomes the current one. */
static inline void small_folder(char *name)
{
  assert_non_null(mkdtemp(name));
  assert_int_equal(chdir(name), 0);
  assert_int_equal(system("cp " SMALL "/* ."), 0);
}

static inline void small_clean(const char *name)
{
  char line[300];
  snprintf(line, sizeof line, "rm -r %s", name);
  assert_int_equal(chdir("/"), 0);
  assert_int_equal(system(line), 0);
}

/* The main() of tests that work in that folder, as faults.NAME. */
static inline int small_main(const char *name, unsigned seconds, char *names, size_t n, const CMUnitTestFunction *tests)
{
  char folder[100], group[100];
  snprintf(folder, sizeof folder, "/tmp/hbmcheck-%s-XXXXXX", name);
  snprintf(group, sizeof group, "faults.%s", name);
  small_watchdog(seconds);
  small_folder(folder);
  const int failed = check_run(group, names, n, tests, NULL, NULL);
  small_clean(folder);
  return failed;
}
#define SMALL_MAIN(name, seconds, ...)                                                                                 \
  small_main(name, seconds, (char[]){#__VA_ARGS__}, CHECK_COUNT(__VA_ARGS__), CHECK_FUNCTIONS(__VA_ARGS__))
