/* test_scipy.c - the python3 that bench starts, with a shell script in its place ($PYTHON): what it prints is read, and
 * the call ends also where SIGCHLD is ignored, as some parents leave it, and exit codes cannot be had. */
#include <signal.h>
#include <sys/stat.h>
#include <time.h>

#include "compare/accuracy/scipy.h"
#include "tests/folder.h"

/* `script` as $PYTHON. */
static void be_python(const char *script)
{
  char text[128], program[64];
  snprintf(text, sizeof text, "#!/bin/sh\n%s\n", script);
  snprintf(program, sizeof program, "%s/python", folder);
  folder_put("python", text);
  assert_int_equal(chmod(program, 0700), 0);
  setenv("PYTHON", program, 1);
}

/* Multiplier 1/2: 30 periods. python3 has 6 s; a slow machine makes no run in them: -1, which is skipped. */
static int asked(scipy_run *runs, char text[96])
{
  double rest[2] = {0, 0};
  const bench_start at = {.omega = 6, .state = rest};
  const time_t start = time(NULL);
  int n = -1;
  CHECK_MADE(model, m, model_oscillator(1, 0.4, 40, 1, 0, &m));
  assert_int_equal(scipy_lsoda(m, &at, 0.5, 1, NULL, runs, &n, text), HC_OK);
  model_free(m);
  return n == 0 && time(NULL) - start > 4 ? -1 : n;
}

static void what_it_prints_is_read(CHECK_STATE)
{
  scipy_run runs[SCIPY_MOST_RUNS];
  char text[96];
  be_python("echo '# scipy 0.0 python 0.0'; echo 1e-4 0.5 2 1.75");
  const int n = asked(runs, text);
  if (n < 0) skip();
  assert_true(n == 1 && runs[0].rtol == 1e-4 && runs[0].amplitude == 2 && runs[0].harmonic_1 == 1.75);
  assert_true(runs[0].n == 1 && runs[0].seconds[0] == 0.5);
  assert_non_null(strstr(text, "scipy 0.0 python 0.0, 30 periods"));
}

/* waitpid says ECHILD then; the watchdog ends a test that asks again for ever. */
static void ignored_children_end_too(CHECK_STATE)
{
  scipy_run runs[SCIPY_MOST_RUNS];
  char text[96];
  struct sigaction before, ignore = {.sa_handler = SIG_IGN};
  be_python("echo 1e-4 0.5 2 1.75");
  assert_int_equal(sigaction(SIGCHLD, &ignore, &before), 0);
  int n = asked(runs, text);
  assert_int_equal(sigaction(SIGCHLD, &before, NULL), 0);
  if (n < 0) skip();
  assert_true(n == 1 && runs[0].amplitude == 2);
}

static void without_scipy_it_says_so(CHECK_STATE)
{
  scipy_run runs[SCIPY_MOST_RUNS];
  char text[96];
  be_python("exit 69");
  assert_true(asked(runs, text) <= 0);
  assert_non_null(strstr(text, "not found"));
}

CHECK_TESTS_WITH("bench.scipy", 60, folder_make, folder_remove, what_it_prints_is_read, ignored_children_end_too,
                 without_scipy_it_says_so)
