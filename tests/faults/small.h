/* small.h - the scene of these tests, small/small.yaml, and a folder with what is in small/. */
#pragma once

#include <dirent.h>
#include <signal.h>

#include "model/casefile/case_file.h"
#include "tests/check.h"
#include "tests/oscillator.h"

#define SMALL SOURCE_DIR "/tests/faults/small"

/* The scene, with --set assignments applied; the list ends with NULL. */
static inline scene small_scene(const char *const *set)
{
  scene sc;
  case_error err;
  int n = 0;
  while (set && set[n]) ++n;
  if (case_read(SMALL "/small.yaml", n, set, &sc, &err) != HC_OK) fail_msg("%s", err.message);
  return scene_kept(sc);
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

/* The file into text[size], such times as 0; NULL: there is none. */
static inline char *small_contents(const char *name, size_t size, char *text)
{
  FILE *from = fopen(name, "r");
  if (!from) return NULL;
  text[fread(text, 1, size - 1, from)] = 0;
  fclose(from);
  return small_without_times(text);
}

/* Removes files that were written beside others, and left; how many there were. */
static inline int small_sweep_up(void)
{
  DIR *here = opendir(".");
  int n = 0;
  assert_non_null(here);
  for (struct dirent *e; (e = readdir(here));)
    if (!strncmp(e->d_name, ".hbmcheck-", 10)) n += unlink(e->d_name) == 0;
  closedir(here);
  return n;
}

/* The main() of tests in a new folder with the files of small/, as faults.NAME. */
static inline int small_main(const char *name, unsigned seconds, char *names, size_t n, const CMUnitTestFunction *tests)
{
  char folder[100], group[100], remove_folder[120];
  snprintf(folder, sizeof folder, "/tmp/hbmcheck-%s-XXXXXX", name);
  snprintf(group, sizeof group, "faults.%s", name);
  small_watchdog(seconds);
  assert_non_null(mkdtemp(folder));
  assert_int_equal(chdir(folder), 0);
  assert_int_equal(system("cp " SMALL "/* ."), 0);
  const int failed = check_run(group, names, n, tests, NULL, NULL);
  snprintf(remove_folder, sizeof remove_folder, "rm -r %s", folder);
  assert_int_equal(chdir("/"), 0);
  assert_int_equal(system(remove_folder), 0);
  return failed;
}
#define SMALL_MAIN(name, seconds, ...)                                                                                 \
  small_main(name, seconds, (char[]){#__VA_ARGS__}, CHECK_COUNT(__VA_ARGS__), CHECK_FUNCTIONS(__VA_ARGS__))
