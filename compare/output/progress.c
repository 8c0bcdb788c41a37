/* progress.c - see progress.h. Proof: tests/output/test_progress.c. */
#include "compare/output/progress.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "compare/output/output.h"
#include "numerics/base/thread_clock.h"
#include "numerics/base/utf8.h"

enum { LINE_ROOM = 512, MIN_ELAPSED = 1 /* [s] below that an estimate is noise */ };
static const double interval = 0.1;    /* [s] between two drawings */
static const double first_report = 20; /* [s] after the start; each later one when the time has doubled */
enum { REPORT_COLUMNS = 100 };

struct progress {
  char *label;          /* one line, valid UTF-8; NULL: say nothing */
  bool line;            /* drawn on a terminal; else reported */
  double start, drawn;  /* [s] on the monotonic clock */
  double report;        /* [s] after the start, when the next report is due */
  const hc_monitor *to; /* who hears the ticks; NULL: the terminal */
};

static const struct timespec grace = {.tv_nsec = 700000000}; /* for the work to end by itself */

/* Variables outside a function: a signal handler gets no argument, so what it needs has to be at a fixed place. */
static volatile sig_atomic_t stop_signal; /* written by the handler alone, never cleared */
static volatile sig_atomic_t line_drawn;  /* the progress line stands on the terminal */
static volatile sig_atomic_t stop_code;   /* exit code when the grace period is over */
static volatile sig_atomic_t child;       /* process id, 0: none */
static volatile sig_atomic_t caller_ends; /* the program, not this file: progress_hold */
static volatile sig_atomic_t was_held;    /* once it was so, there are results that a second signal is not to lose */
static timer_t grace_is_over;             /* made before the handlers are installed */
static bool can_wait;                     /* it was */

static const char erase[] = "\r\033[K";

/* Ends the program wherever it is: async-signal-safe calls only. */
static void stop_at_once(int number)
{
  static const char words[] = "hbmcheck: stopped on request; what was under way is lost, files are whole or as they "
                              "were\n";
  if (number && caller_ends) return;
  if (child > 0) kill(child, SIGKILL);
  output_abandon_all();
  ssize_t said = line_drawn ? write(STDERR_FILENO, erase, sizeof erase - 1) : 0;
  if (said >= 0) said = write(STDERR_FILENO, words, sizeof words - 1);
  (void)said; /* or not: nothing more can be done */
  _exit(stop_code);
}

static void start_grace(void)
{
  const int before = errno;
  const struct itimerspec once = {.it_value = grace};
  struct sigaction end = {.sa_handler = stop_at_once};
  sigemptyset(&end.sa_mask);
  if (can_wait && sigaction(SIGALRM, &end, NULL) == 0) timer_settime(grace_is_over, 0, &once, NULL);
  errno = before;
}

static void on_signal(int number)
{
  const int before = errno;
  const struct sigaction kill_it = {.sa_handler = SIG_DFL};
  if (!stop_signal) start_grace();
  if (!was_held || !can_wait) sigaction(number, &kill_it, NULL); /* the next one of this kind */
  stop_signal = number;
  errno = before;
}

void progress_hold(bool held)
{
  caller_ends = held;
  was_held = was_held || held;
  if (!held && stop_signal) start_grace();
}

_Noreturn void progress_stop(void)
{
  stop_at_once(0);
  abort(); /* stop_at_once does not return: not the answer to an alarm */
}

void progress_erase(void)
{
  if (line_drawn && write(STDERR_FILENO, erase, sizeof erase - 1) >= 0) line_drawn = false;
}

void progress_install_signals(int exit_code)
{
  static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigevent alarm = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGALRM};
  sigset_t heard;
  sigemptyset(&heard);
  sigaddset(&heard, SIGALRM);
  stop_code = exit_code;
  can_wait = timer_create(CLOCK_MONOTONIC, &alarm, &grace_is_over) == 0 && sigprocmask(SIG_UNBLOCK, &heard, NULL) == 0;
  for (int i = 0; i < 3; ++i) {
    struct sigaction old, action = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    if (sigaction(numbers[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(numbers[i], &action, NULL);
  }
}

int progress_interrupted(void) { return stop_signal; }

void progress_child(pid_t pid) { child = (sig_atomic_t)pid; }

const char *progress_time(double seconds, char text[PROGRESS_TIME])
{
  if (seconds < 99.5) snprintf(text, PROGRESS_TIME, "%.0f s", seconds);
  else if (seconds < 99.5 * 60) snprintf(text, PROGRESS_TIME, "%.0f min", seconds / 60);
  else if (seconds < 1e6 * 3600) snprintf(text, PROGRESS_TIME, "%.0f h", seconds / 3600);
  else snprintf(text, PROGRESS_TIME, "ages");
  return text;
}

void progress_line(char *line, size_t size, const char *label, double done, double elapsed, int columns)
{
  /* "  37 %  12 s left", "  12 s" when unknown, or nothing to say yet */
  char tail[64] = "";
  const double part = done < 1 ? done : 1;
  const bool known = done >= 0; /* NaN is unknown too */
  if (known) snprintf(tail, sizeof tail, "  %.0f %%", 100 * part);
  if (elapsed >= MIN_ELAPSED && part != 0) {
    const double seconds = known ? elapsed * (1 - part) / part : elapsed;
    const size_t n = strlen(tail);
    snprintf(tail + n, sizeof tail - n, "  %s", progress_time(seconds, (char[PROGRESS_TIME]){0}));
    if (known) snprintf(tail + strlen(tail), sizeof tail - strlen(tail), " left");
  }
  int width, room = columns - (int)strlen(tail);
  size_t bytes = utf8_fit(label, room > 0 ? room : 0, &width);
  while (bytes > 0 && bytes + strlen(tail) >= size) bytes = utf8_fit(label, --width, &width);
  snprintf(line, size, "%.*s%s", (int)bytes, label, tail);
}

static void draw_line(progress *p, double done)
{
  char line[LINE_ROOM];
  struct winsize w;
  const int columns = ioctl(STDERR_FILENO, TIOCGWINSZ, &w) == 0 && w.ws_col > 0 ? w.ws_col : 80;
  p->drawn = wall_seconds();
  progress_line(line, sizeof line, p->label, done, p->drawn - p->start, columns - 1); /* a full line would wrap */
  line_drawn = true;
  fprintf(stderr, "\r%s\033[K", line);
  fflush(stderr);
}

static void report(progress *p, double done)
{
  char line[LINE_ROOM];
  const double elapsed = wall_seconds() - p->start;
  if (elapsed < p->report) return;
  progress_line(line, sizeof line, p->label, done, elapsed, REPORT_COLUMNS);
  fprintf(stderr, "hbmcheck: %s\n", line);
  p->report = 2 * elapsed;
}

progress *progress_start(const char *label, bool quiet)
{
  progress *p = calloc(1, sizeof *p);
  const char *term = getenv("TERM");
  if (!p) return NULL;
  if (!quiet) p->label = utf8_clean(label, true);
  p->line = p->label && term && *term && strcmp(term, "dumb") != 0 && isatty(STDERR_FILENO);
  p->start = wall_seconds();
  p->report = first_report;
  if (p->line) draw_line(p, -1);
  return p;
}

static bool tick_progress(void *self, double done)
{
  progress *p = self;
  if (p && p->to) return hc_monitor_tick(p->to, done);
  if (stop_signal) return false;
  if (p && p->line && wall_seconds() - p->drawn >= interval) draw_line(p, done);
  else if (p && p->label && !p->line) report(p, done);
  return true;
}

void progress_pass_on(progress *p, const hc_monitor *to) { p->to = to; }

hc_monitor progress_monitor(progress *p) { return (hc_monitor){tick_progress, p}; }

void progress_relabel(progress *p, const char *label)
{
  char *clean = p && p->label ? utf8_clean(label, true) : NULL;
  if (!clean) return;
  free(p->label);
  p->label = clean;
}

void progress_end(progress *p)
{
  if (!p) return;
  if (p->line) {
    fputs("\r\033[K", stderr);
    fflush(stderr);
    line_drawn = false;
  }
  free(p->label);
  free(p);
}
