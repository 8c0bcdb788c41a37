/* test_duration.c - commands that take long say so first. The arithmetic: tests/compare/test_duration.c. */
#include <signal.h>
#include <stdbool.h>

#include "tests/shell.h"

/* The first thing that the command says on stderr, into out[size]; then it is ended, whatever it is at. */
static void first_words(const char *args, char *out, size_t size)
{
  char line[1024];
  snprintf(line, sizeof line, "%s %s 2>&1 >/dev/null & echo $!; wait", HBMCHECK_COMMAND, args);
  FILE *pipe = popen(line, "r");
  assert_non_null(pipe);
  assert_non_null(fgets(out, (int)size, pipe));
  const pid_t pid = (pid_t)strtol(out, NULL, 10);
  out[0] = 0;
  const bool said = fgets(out, (int)size, pipe) != NULL;
  assert_true(pid > 1);
  if (said) kill(pid, SIGKILL);
  pclose(pipe);
}

/* 13 s a frequency, as the plates take on the machine where the counts were measured: with 20 of them and with 20
 * harmonics, a machine ten times as fast says it, too. */
static void a_long_run_is_foretold(CHECK_STATE)
{
#define TWENTY                                                                                                         \
  "135,135.1,135.2,135.3,135.4,135.5,135.6,135.7,135.8,135.9,136,136.1,136.2,136.3,136.4,136.5,136.6,136.7,136.8,136." \
  "9"
#define PLATES "cases/structures/plates.yaml "
#define SIZES  ", 84 degrees of freedom, 24 contact rows\n"
  static const struct {
    const char *args, *end;
  } runs[] = {{"compare " PLATES "--at " TWENTY, ": 20 frequencies" SIZES},
              {"transient " PLATES "--at " TWENTY, ": 20 frequencies" SIZES},
              {"report " PLATES "--output /dev/null --at " TWENTY, ": 20 frequencies" SIZES},
              {"gate " PLATES PLATES "--at " TWENTY, ": 40 frequencies\n"},
              {"verify " PLATES "--set hbm.harmonics=20 --against test_duration.csv", ": 3 frequencies" SIZES}};
  FILE *curve = fopen("test_duration.csv", "w");
  assert_non_null(curve);
  fputs("frequency,amplitude\n135,1e-5\n136,1e-5\n137,1e-5\n", curve);
  assert_int_equal(fclose(curve), 0);
  for (size_t i = 0; i < sizeof runs / sizeof *runs; ++i) {
    char said[512];
    first_words(runs[i].args, said, sizeof said);
    const char *about = strstr(said, ": takes about "), *end = strstr(said, " of processor time");
    if (!about || !end || strcmp(end + strlen(" of processor time"), runs[i].end) != 0)
      fail_msg("%s: said '%s', expected '... takes about ... of processor time%s'", runs[i].args, said, runs[i].end);
  }
  remove("test_duration.csv");
}

static void a_short_one_is_not(CHECK_STATE)
{
#define CASE_2 "cases/paper/case2.yaml"
  static const char *const runs[] = {"compare " CASE_2 " --at 8,9",
                                     "transient " CASE_2 " --at 8,9",
                                     "gate " CASE_2 " --at 8,9",
                                     "report " CASE_2 " --output /dev/null --at 8",
                                     ("verify cases/verify/case2.yaml --against cases/verify/no_static.csv --columns "
                                      "omega=1,harmonic_1=2"),
                                     "compare cases/structures/chain3.yaml --at 0.8"};
  for (size_t i = 0; i < sizeof runs / sizeof *runs; ++i) {
    char line[512], out[4096];
    snprintf(line, sizeof line, "%s %s 2>&1 >/dev/null", HBMCHECK_COMMAND, runs[i]);
    shell_read(line, out, sizeof out);
    if (strstr(out, "takes about")) fail_msg("%s: %s", line, out);
  }
}

CHECK_TESTS("command.duration", 120, a_long_run_is_foretold, a_short_one_is_not)
