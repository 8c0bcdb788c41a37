/* test_signals.c - SIGINT, SIGTERM, SIGHUP and SIGKILL at moments drawn from a fixed sequence: an output file is
 * absent, whole, or says that it was stopped; the exit code is 3 with a remark, or that of a run that was over
 * before; the catchable ones leave no other file behind; a study that was killed again and again goes on to the same
 * export. A signal that comes before main() has set its handlers kills, with nothing written. */
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <time.h>

#include "tests/faults/shell.h"
#include "tests/faults/small.h"
#include "tests/random.h"

enum { MOST_ARGUMENTS = 16, TEXT = 1 << 16 };

static int times = 2; /* moments a command and signal; 20 with the argument "every" */

static double seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static char *contents(const char *name, char *text)
{
  FILE *from = fopen(name, "r");
  if (!from) return NULL;
  text[fread(text, 1, TEXT - 1, from)] = 0;
  fclose(from);
  return text;
}

/* Removes files written beside others; how many there were. */
static int sweep_up(void)
{
  DIR *here = opendir(".");
  int n = 0;
  assert_non_null(here);
  for (struct dirent *e; (e = readdir(here));)
    if (!strncmp(e->d_name, ".hbmcheck-", 10)) n += unlink(e->d_name) == 0;
  closedir(here);
  return n;
}

/* "hbmcheck LINE", signalled after so many seconds (0: never) -> wait status. Its stderr is in the file "err". */
static int run(const char *line, int number, double after)
{
  char text[500], *argv[MOST_ARGUMENTS + 1] = {(char *)"hbmcheck"};
  int argc = 1, status;
  snprintf(text, sizeof text, "%s", line);
  for (char *word = strtok(text, " "); word && argc < MOST_ARGUMENTS; word = strtok(NULL, " ")) argv[argc++] = word;
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    int err = open("err", O_WRONLY | O_CREAT | O_TRUNC, 0666), null = open("/dev/null", O_WRONLY);
    if (err < 0 || null < 0 || dup2(err, 2) < 0 || dup2(null, 1) < 0) _exit(99);
    execv(HBMCHECK_COMMAND, argv);
    _exit(99);
  }
  if (after > 0) {
    nanosleep(&(struct timespec){(time_t)after, (long)(fmod(after, 1) * 1e9)}, NULL);
    kill(child, number);
  }
  assert_int_equal(waitpid(child, &status, 0), child);
  return status;
}

/* Is that an honest end? `good`: what an undisturbed run writes to "result". */
static bool honest(int number, int status, int good_code, const char *good)
{
  static char result[TEXT], err[TEXT];
  const char *there = contents("result", result);
  const bool whole = there && !strcmp(there, good), nothing_beside = sweep_up() == 0;
  if (!contents("err", err)) err[0] = 0;
  if (WIFSIGNALED(status))
    return WTERMSIG(status) == number && (whole || !there) && (nothing_beside || number == SIGKILL);
  if (!nothing_beside) return false;
  if (WEXITSTATUS(status) == good_code && whole) return true;
  return WEXITSTATUS(status) == 3 && strstr(err, "stopped") &&
         (!there || whole || strstr(there, "STOPPED") || strstr(there, "stopped"));
}

static void try_with(const char *line, int moments)
{
  static char good[TEXT], result[TEXT], err[TEXT];
  static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGKILL};
  int stopped = 0;
  uint64_t seed = 1;
  unlink("result");
  double began = seconds();
  int status = run(line, 0, 0);
  const double long_as = seconds() - began;
  const int code = WEXITSTATUS(status);
  assert_true(WIFEXITED(status) && code <= 1 && contents("result", good));
  for (int i = 0; i < 4 * moments; ++i) {
    const int number = numbers[i % 4];
    unlink("result");
    status = run(line, number, 1e-4 + 1.1 * long_as * random_unit(&seed));
    stopped += WIFSIGNALED(status) || WEXITSTATUS(status) == 3;
    if (honest(number, status, code, good)) continue;
    const char *there = contents("result", result);
    print_error("hbmcheck %s\nsignal %d: status %x, result %.2000s\nerr %s\n", line, number, (unsigned)status,
                there ? there : "absent", contents("err", err) ? err : "");
    fail();
  }
  print_message("%d of %d were stopped: hbmcheck %s\n", stopped, 4 * moments, line);
  assert_true(stopped > 0);
}

static void frf(void **state)
{
  (void)state;
  try_with("frf small.yaml -o result --set hbm.harmonics=40", times);
}

static void compare(void **state)
{
  (void)state;
  try_with("compare small.yaml -o result --set compare.omega=6.2,6.3,6.4,6.5,6.6", times);
}

static void transient(void **state)
{
  (void)state;
  try_with("transient small.yaml -o result --set compare.omega=6.2,6.3,6.4,6.5,6.6", times);
}

static void gate(void **state)
{
  (void)state;
  try_with("gate small.yaml --junit result --set compare.omega=6.2,6.3,6.4,6.5,6.6", times);
}

static void report(void **state)
{
  (void)state;
  said s = shell("$H report small.yaml -q -o result --harmonics 1 --samples 16 2>&1");
  if (s.code == 64) skip(); /* built without Chart.js */
  try_with("report small.yaml -o result --harmonics 1 --samples 16", times > 2 ? times : 1);
}

/* Each time a little is added, whatever ended it; then the export is that of an undisturbed run. */
static void study(void **state)
{
  (void)state;
  static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGKILL};
  small_file("many.yaml", "study: many\nbase: small.yaml\nrun: frf\nset: {compare.omega: [6.2, 6.8]}\n"
                          "vary: [{oscillator.damping: {from: 1, to: 3, count: 40}}, {hbm.harmonics: [2, 3, 4]}]\n");
  double began = seconds();
  expect("$H study many.yaml -q --results whole.sqlite --export csv -o whole.csv 2>&1", 0, "");
  const double long_as = seconds() - began;
  int stopped = 0;
  uint64_t seed = 2;
  for (int i = 0; i < 4 * times; ++i) {
    int status = run("study many.yaml --jobs 2 --results killed.sqlite", numbers[i % 4],
                     0.01 + 0.3 * long_as * random_unit(&seed));
    stopped += WIFSIGNALED(status) || WEXITSTATUS(status) == 3;
    if (!WIFSIGNALED(status) && WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != 3)
      fail_msg("status %x", (unsigned)status);
  }
  assert_true(stopped > 0);
  print_message("%d of %d were stopped: hbmcheck study\n", stopped, 4 * times);
  expect("$H study many.yaml -q --results killed.sqlite --export csv -o killed.csv 2>&1 && cmp whole.csv killed.csv", 0,
         "");
}

int main(int argc, char **argv)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(frf),  cmocka_unit_test(compare), cmocka_unit_test(transient),
      cmocka_unit_test(gate), cmocka_unit_test(report),  cmocka_unit_test(study),
  };
  static char folder[] = "/tmp/hbmcheck-signals-XXXXXX";
  if (argc > 1 && !strcmp(argv[1], "every")) times = 20;
  small_watchdog(times > 4 ? 1800 : 300);
  setenv("H", HBMCHECK_COMMAND, 1);
  small_folder(folder);
  int failed = cmocka_run_group_tests_name("faults.signals", tests, NULL, NULL);
  small_clean(folder);
  return failed;
}
