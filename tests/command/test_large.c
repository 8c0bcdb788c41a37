/* test_large.c - a structure of 96 degrees of freedom and 24 contacts (cases/structures/README.md), through all of it:
 * monodromy matrices of 192 columns, BDF steps of 216 states. */
#include <string.h>

#include "tests/check.h"
#include "tests/shell.h"

static char out[1 << 20];

/* Number `column`, from 0, of the first line of `out` that begins with `start`. */
static double cell(const char *start, int column)
{
  const char *line = strstr(out, start);
  assert_non_null(line);
  for (++line; column > 0; --column) line = strchr(line, ',') + 1;
  return strtod(line, NULL);
}

static void run(const char *args, int code, const char *fragment)
{
  char line[2048];
  snprintf(line, sizeof line,
           "%s %s cases/structures/bladed_disk.yaml --format csv -q --at 985 --set sweep.omega=984,986",
           HBMCHECK_COMMAND, args);
  shell_check(line, shell_read(line, out, sizeof out), out, code, fragment);
}

/* Of 5 harmonics the disk's resonance misses the gate, and by what harmonic balance predicts of them: its prediction is
 * one Newton step on more harmonics, whose own error is of the next order, a tenth. Two sides that know nothing of
 * each other. The regularised law errs by the second order of 1e-4 where contacts slip and never open. */
static void a_bladed_disk_is_compared(CHECK_STATE)
{
  run("compare", 1, "\n985,0,3,differs,");
  const double regularised = cell("\n985,0,3,", 5), error = cell("\n985,0,3,", 6);
  CHECK_NEAR(error, cell("\n985,0,3,", 11), 0.1 * error, "predicted from truncation");
  CHECK_NEAR(cell("\n985,0,1,", 6), cell("\n985,0,1,", 11), 0.1 * cell("\n985,0,1,", 6), "of the rim");
  run("transient --set transient.law=exact --set transient.method=closed_form", 0, "\n985,3,settled,");
  CHECK_NEAR(regularised, cell("\n985,3,", 3), 1e-7 * regularised, "regularised against exact");
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(a_bladed_disk_is_compared)};

CHECK_MAIN("command.large", tests, 600)
