/* scipy.c - see scipy.h: a child process with a time limit, whose output is read line by line. */
#include "compare/accuracy/scipy.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "lsoda.py.h" /* made of lsoda.py: script[] */

extern char **environ;

enum { NUMBER = 32, LINE = 256, NOT_THERE = 69, MOST_PERIODS = 3000 };
static const double longest = 6; /* [s] of wall time, Python's start included */
static const double left = 1e-9; /* [distance of the start] distance to the orbit at which marching ends */

/* The child process and its output. */
typedef struct child {
  pid_t pid;
  int from;        /* its standard output */
  char line[LINE]; /* the part of the next line received so far */
  size_t n;
  bool ended; /* end of its output */
} child;

/* "python3 -c SCRIPT" and the script's numbers. */
typedef struct arguments {
  int n;
  char **argv;          /* [n + 1] */
  char (*text)[NUMBER]; /* [n] */
} arguments;

static void add(arguments *a, double value)
{
  snprintf(a->text[a->n], NUMBER, "%.17g", value);
  a->argv[a->n] = a->text[a->n];
  ++a->n;
}

static hc_status fill(arguments *a, const model *m, const bench_start *at, int periods, int repeats)
{
  const size_t most = 3 + 9 + 7 * (size_t)m->n_contacts;
  const double head[] = {at->omega, periods,     repeats,       at->state[TIMEINT_X], at->state[TIMEINT_V],
                         *m->mass,  *m->damping, *m->stiffness, model_force(m)};
  *a = (arguments){.n = 3, .argv = calloc(most + 1, sizeof *a->argv), .text = calloc(most, sizeof *a->text)};
  if (!a->argv || !a->text) return HC_NO_MEMORY;
  a->argv[1] = (char *)(size_t) "-c";
  a->argv[2] = (char *)(size_t)script;
  for (size_t i = 0; i < sizeof head / sizeof *head; ++i) add(a, head[i]);
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    add(a, at->state[TIMEINT_W + j]);
    const double own[] = {c->law.kt, c->law.kn, c->law.mu, c->law.gap, *c->tangent, *c->normal};
    for (size_t i = 0; i < sizeof own / sizeof *own; ++i) add(a, own[i]);
  }
  return HC_OK;
}

/* Starts the child, with Python's messages to /dev/null and default signal handling. */
static bool start(child *c, arguments *a)
{
  int ends[2];
  posix_spawn_file_actions_t actions;
  *c = (child){.pid = -1, .from = -1};
  if (pipe(ends) != 0) return false;
  bool ready = posix_spawn_file_actions_init(&actions) == 0;
  if (ready) {
    ready = posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO) == 0 &&
            posix_spawn_file_actions_addclose(&actions, ends[0]) == 0 &&
            posix_spawn_file_actions_addclose(&actions, ends[1]) == 0 &&
            posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", 1, 0) == 0 &&
            posix_spawnp(&c->pid, a->argv[0], &actions, NULL, a->argv, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
  }
  close(ends[1]);
  c->from = ends[0];
  if (!ready) close(ends[0]);
  return ready;
}

static double wall(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The next line into text[LINE]. False: end of output, out of time, or stopped by the monitor. */
static bool next_line(child *c, double until, const hc_monitor *monitor, char *text, bool *stopped)
{
  for (;;) {
    char *end = memchr(c->line, '\n', c->n);
    if (end) {
      size_t length = (size_t)(end - c->line);
      memcpy(text, c->line, length);
      text[length] = 0;
      c->n -= length + 1;
      memmove(c->line, end + 1, c->n);
      return true;
    }
    if (c->n == LINE) c->n = 0; /* too long: not a line of the script */
    struct pollfd p = {.fd = c->from, .events = POLLIN};
    if ((*stopped = !hc_monitor_tick(monitor, -1)) || wall() > until) return false;
    if (poll(&p, 1, 50) <= 0) continue;
    ssize_t got = read(c->from, c->line + c->n, LINE - c->n);
    if (got <= 0) c->ended = true;
    if (got <= 0) return false;
    c->n += (size_t)got;
  }
}

static void take(const char *text, scipy_run *runs, int *n)
{
  double v[4];
  char *end = (char *)(size_t)text;
  for (int i = 0; i < 4; ++i) v[i] = strtod(end, &end);
  if (!(v[0] > 0) || !(v[1] >= 0)) return;
  int k = 0;
  while (k < *n && runs[k].rtol != v[0]) ++k;
  if (k == SCIPY_MOST_RUNS) return;
  if (k == *n) runs[(*n)++] = (scipy_run){.rtol = v[0]};
  runs[k].amplitude = v[2];
  runs[k].harmonic_1 = v[3];
  if (runs[k].n < SCIPY_MOST_REPEATS) runs[k].seconds[runs[k].n++] = v[1];
}

/* Runs the script with this python3; returns its exit code, -1 if it was killed, NOT_THERE if the program or scipy is
 * missing. */
static int run(const char *python, arguments *a, const hc_monitor *monitor, scipy_run *runs, int *n, char text[96],
               bool *stopped)
{
  child c;
  char line[LINE];
  const double until = wall() + longest;
  a->argv[0] = (char *)(size_t)python;
  if (!start(&c, a)) return NOT_THERE;
  while (next_line(&c, until, monitor, line, stopped)) {
    if (line[0] == '#') snprintf(text, 96, "%.90s", line + 2);
    else take(line, runs, n);
  }
  /* Kills it if it still runs. Its exit code; -1: a signal ended it, or this process ignores SIGCHLD, and then the
   * system keeps no exit codes: waitpid waits for the end and fails with ECHILD. */
  int status = 0;
  close(c.from);
  if (!c.ended) kill(c.pid, SIGKILL);
  while (waitpid(c.pid, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

hc_status scipy_lsoda(const model *m, const bench_start *at, double multiplier, int repeats, const hc_monitor *monitor,
                      scipy_run *runs, int *n, char text[96])
{
  const char *asked = getenv("PYTHON"),
             *candidates[] = {asked && *asked ? asked : "python3", asked && *asked ? NULL : "/usr/bin/python3"};
  arguments a;
  bool stopped = false;
  *n = 0;
  double periods = multiplier < 1 ? ceil(log(left) / log(fmax(multiplier, 0.01))) : INFINITY;
  if (!(periods < MOST_PERIODS)) {
    snprintf(text, 96, "not run: marching would take %.2g periods", periods);
    return HC_OK;
  }
  snprintf(text, 96, "not found (no python3 with scipy; PYTHON says which python3)");
  const hc_status filled = fill(&a, m, at, (int)periods, repeats < 3 ? repeats : 3);
  for (int i = 0; i < 2 && candidates[i] && !stopped && filled == HC_OK; ++i) {
    int code = run(candidates[i], &a, monitor, runs, n, text, &stopped);
    if (code != NOT_THERE && code != 127) break;
  }
  free(a.argv);
  free(a.text);
  if (filled != HC_OK) return filled;
  size_t length = strlen(text);
  if (*n > 0) snprintf(text + length, 96 - length, ", %d periods, what it did in %g s", (int)periods, longest);
  else if (!strncmp(text, "scipy", 5))
    snprintf(text + length, 96 - length, ", nothing in %g s: %d periods", longest, (int)periods);
  return stopped ? HC_INTERRUPTED : HC_OK;
}
