/* test_progress.c - the progress line is drawn on a terminal only, and signals stop the work. The clock is the test's
 * (the linker wraps clock_gettime). Without pseudo-terminals what needs one is left out: exit code 77. */
#define _XOPEN_SOURCE 700 /* posix_openpt */
#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <time.h>

#include "compare/output/progress.h"
#include "tests/check.h"
#include "tests/wrap.h"

enum { SEEN_ROOM = 1 << 16 };
static char seen[SEEN_ROOM];

static struct timespec clock_now = {.tv_sec = 1000};

WRAP(int, clock_gettime, (clockid_t which, struct timespec *t))
{
  (void)which;
  *t = clock_now;
  return 0;
}

static void wait_ms(long ms)
{
  clock_now.tv_nsec += ms * 1000000;
  clock_now.tv_sec += clock_now.tv_nsec / 1000000000;
  clock_now.tv_nsec %= 1000000000;
}

/* Runs `work` with stderr on `to`, then reads what came out of `from` (not blocking) into seen. */
static void watch(int to, int from, void (*work)(void))
{
  int before = dup(STDERR_FILENO);
  assert_true(before >= 0 && dup2(to, STDERR_FILENO) >= 0);
  work();
  dup2(before, STDERR_FILENO);
  close(before);
  assert_int_equal(fcntl(from, F_SETFL, O_NONBLOCK), 0);
  size_t n = 0;
  for (ssize_t got; n < SEEN_ROOM - 1 && (got = read(from, seen + n, SEEN_ROOM - 1 - n)) > 0;) n += (size_t)got;
  seen[n] = 0;
  close(to);
  close(from);
}

/* Both ends of a new pseudo-terminal; false: there is none to be had (no devpts, none left). */
static bool open_terminal(int *master, int *slave)
{
  const char *name;
  *slave = -1;
  *master = posix_openpt(O_RDWR | O_NOCTTY);
  if (*master < 0) return false;
  if (grantpt(*master) == 0 && unlockpt(*master) == 0 && (name = ptsname(*master)))
    *slave = open(name, O_RDWR | O_NOCTTY);
  if (*slave < 0) close(*master);
  return *slave >= 0;
}

static void watch_terminal(int columns, void (*work)(void))
{
  int master, slave;
  assert_true(open_terminal(&master, &slave));
  struct winsize w = {.ws_row = 24, .ws_col = (unsigned short)columns};
  assert_int_equal(ioctl(slave, TIOCSWINSZ, &w), 0);
  watch(slave, master, work);
}

static void watch_pipe(void (*work)(void))
{
  int end[2];
  assert_int_equal(pipe(end), 0);
  watch(end[1], end[0], work);
}

static void run(const char *label, bool quiet)
{
  progress *p = progress_start(label, quiet);
  hc_monitor m = progress_monitor(p);
  wait_ms(120);
  assert_true(hc_monitor_tick(&m, 0.37));
  progress_end(p);
}
static void run_plain(void) { run("sweep", false); }
static void run_quiet(void) { run("sweep", true); }
static void run_long(void) { run("a rather long label that does not fit", false); }
static void run_hostile(void) { run("a\x1b[2Jb\nc\xff", false); }

static void run_often(void)
{
  progress *p = progress_start("sweep", false);
  hc_monitor m = progress_monitor(p);
  for (int i = 0; i < 350; ++i) {
    assert_true(hc_monitor_tick(&m, i / 350.0));
    wait_ms(1);
  }
  progress_end(p);
}

static int set_term(CHECK_STATE) { return setenv("TERM", "xterm", 1); }

static void a_terminal_shows_it_and_is_left_clean(CHECK_STATE)
{
  watch_terminal(80, run_plain);
  assert_string_equal(seen, "\rsweep\033[K\rsweep  37 %\033[K\r\033[K");
  watch_terminal(0, run_plain); /* a terminal that does not know its size */
  assert_non_null(strstr(seen, "sweep  37 %"));
}

static void a_narrow_terminal_does_not_wrap(CHECK_STATE)
{
  watch_terminal(20, run_long);
  assert_string_equal(seen, "\ra rather long label\033[K\ra rather long  37 %\033[K\r\033[K");
}

static void a_label_cannot_command_the_terminal(CHECK_STATE)
{
  watch_terminal(80, run_hostile);
  assert_non_null(strstr(seen, "\ra [2Jb c\xef\xbf\xbd  37 %\033[K"));
}

/* The start and the end, and 3 in 350 ms: 100, 201 and 302 ms after the start at the latest. */
static void drawings_are_a_tenth_of_a_second_apart(CHECK_STATE)
{
  int drawn = 0;
  watch_terminal(80, run_often);
  for (const char *p = seen; (p = strchr(p, '\r')); ++p) ++drawn;
  assert_int_equal(drawn, 2 + 3);
}

static void silence_in_a_pipe(CHECK_STATE)
{
  watch_pipe(run_plain);
  assert_string_equal(seen, "");
}

static void silence_if_quiet_or_dumb(CHECK_STATE)
{
  watch_terminal(80, run_quiet);
  assert_string_equal(seen, "");
  setenv("TERM", "dumb", 1);
  watch_terminal(80, run_plain);
  assert_string_equal(seen, "");
  unsetenv("TERM");
  watch_terminal(80, run_plain);
  assert_string_equal(seen, "");
}

static void expect_line(const char *label, double done, double elapsed, int columns, size_t size, const char *expected)
{
  char line[128];
  memset(line, '#', sizeof line);
  progress_line(line, size, label, done, elapsed, columns);
  assert_string_equal(line, expected);
  assert_int_equal(line[size], '#');
}

static void lines_say_how_long_it_takes(CHECK_STATE)
{
  expect_line("frf", 0.25, 4, 79, 100, "frf  25 %  12 s left");
  expect_line("frf", 0.25, 0.9, 79, 100, "frf  25 %");
  expect_line("frf", 0, 40, 79, 100, "frf  0 %");
  expect_line("frf", 1.5, 4, 79, 100, "frf  100 %  0 s left");
  expect_line("frf", 0.5, 600, 79, 100, "frf  50 %  10 min left");
  expect_line("frf", 0.5, 36000, 79, 100, "frf  50 %  10 h left");
  expect_line("frf", 1e-300, 10, 79, 100, "frf  0 %  ages left");
  expect_line("frf", -1, 12, 79, 100, "frf  12 s");
  expect_line("frf", NAN, 12, 79, 100, "frf  12 s");
  expect_line("\xc3\xa9\xc3\xa9\xc3\xa9", -1, 0, 2, 100, "\xc3\xa9\xc3\xa9");
  expect_line("\xc3\xa9\xc3\xa9\xc3\xa9", -1, 0, 79, 6, "\xc3\xa9\xc3\xa9"); /* 5 bytes would cut the third in half */
  expect_line("label", 0.37, 0, 2, 100, "  37 %");
}

/* The exit code of a child that runs `work` with the handlers, or 100 plus the signal that killed it. */
static int fate(int (*work)(void), void (*sigint)(int))
{
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    signal(SIGINT, sigint);
    signal(SIGTERM, SIG_DFL);
    progress_install_signals(3);
    _exit(work());
  }
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  return WIFSIGNALED(status) ? 100 + WTERMSIG(status) : WEXITSTATUS(status);
}

/* 0 if ticks are true before `number` and false after, also without a progress, and the signal is remembered. */
static int stopped_by(int number)
{
  progress *p = progress_start("x", true);
  hc_monitor m = progress_monitor(p), bare = progress_monitor(NULL);
  if (!hc_monitor_tick(&m, 0.1) || !hc_monitor_tick(&bare, 0.1) || progress_interrupted()) return 1;
  raise(number);
  if (hc_monitor_tick(&m, 0.2) || hc_monitor_tick(&bare, 0.2)) return 2;
  if (progress_interrupted() != number) return 3;
  progress_end(p);
  progress_end(NULL);
  return 0;
}
static int interrupt_once(void) { return stopped_by(SIGINT); }
static int terminate_once(void) { return stopped_by(SIGTERM); }
static int interrupt_twice(void) { return stopped_by(SIGINT) ? 1 : raise(SIGINT); }

static void signals_stop_the_work(CHECK_STATE)
{
  assert_int_equal(fate(interrupt_once, SIG_DFL), 0);
  assert_int_equal(fate(terminate_once, SIG_DFL), 0);
  assert_int_equal(fate(interrupt_twice, SIG_DFL), 100 + SIGINT);
  assert_int_equal(fate(interrupt_once, SIG_IGN), 2); /* ignored before: stays ignored, ticks go on */
}

CHECK_ENTRY_FUNCTION
{
  const struct CMUnitTest on_a_terminal[] = {
      cmocka_unit_test_setup(a_terminal_shows_it_and_is_left_clean, set_term),
      cmocka_unit_test_setup(a_narrow_terminal_does_not_wrap, set_term),
      cmocka_unit_test_setup(a_label_cannot_command_the_terminal, set_term),
      cmocka_unit_test_setup(drawings_are_a_tenth_of_a_second_apart, set_term),
      cmocka_unit_test_setup(silence_if_quiet_or_dumb, set_term),
  };
  const struct CMUnitTest anywhere[] = {
      cmocka_unit_test_setup(silence_in_a_pipe, set_term),
      cmocka_unit_test_setup(lines_say_how_long_it_takes, set_term),
      cmocka_unit_test_setup(signals_stop_the_work, set_term),
  };
  int master, slave;
  check_watchdog(60);
  int failed = cmocka_run_group_tests_name("output.progress", anywhere, NULL, NULL);
  if (!open_terminal(&master, &slave)) {
    print_message("no pseudo-terminal can be opened (/dev/ptmx, /dev/pts): what is drawn on one was not tested\n");
    ++check_skipped;
    return check_ended(failed);
  }
  close(master);
  close(slave);
  return failed + cmocka_run_group_tests_name("output.progress on a terminal", on_a_terminal, NULL, NULL);
}
