/* matlab_child.c - see matlab_child.h. The child is forked, reads by matlab_variable.h and writes to a pipe
 *     reply, then values[n][n] if there are any
 * It has little time and memory, and nothing of it reaches the terminal: whatever becomes of it, an answer comes.
 * libmatio's and HDF5's globals are never touched in this process, so threads need no lock. The child may allocate even
 * where the parent has threads: the C libraries of Linux see to malloc in fork. */
#include "casefile/matlab_child.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "casefile/matlab_variable.h"
#include "casefile/matrix_file.h"
#include "casefile/text_file.h"

enum { WORDS = 512, CPU_SECONDS = 20 /* the largest matrix, compressed, takes one */ };
static const rlim_t most_bytes = (rlim_t)1 << 30; /* more than at the fork; the largest matrix takes a third */

typedef struct reply {
  hc_status status;
  int n; /* rows, with HC_OK */
  char words[WORDS];
} reply;

static bool put(int to, const void *bytes, size_t size)
{
  for (const char *from = bytes; size > 0;) {
    const ssize_t n = write(to, from, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    from += n;
    size -= (size_t)n;
  }
  return true;
}

static bool get(int from, void *bytes, size_t size)
{
  for (char *to = bytes; size > 0;) {
    const ssize_t n = read(from, to, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    to += n;
    size -= (size_t)n;
  }
  return true;
}

/* ---- the child ---- */

/* Bytes of address space in use: Linux tells; 0 elsewhere. */
static rlim_t in_use(void)
{
  char line[64] = "";
  FILE *from = fopen("/proc/self/statm", "r");
  const bool told = from && fgets(line, sizeof line, from);
  if (from) fclose(from);
  return told ? (rlim_t)strtoull(line, NULL, 10) * (rlim_t)sysconf(_SC_PAGESIZE) : 0; /* pages come first */
}

static void limit(int what, rlim_t most)
{
  struct rlimit now;
  if (getrlimit(what, &now) != 0 || (now.rlim_cur != RLIM_INFINITY && now.rlim_cur <= most)) return;
  now.rlim_cur = most;
  setrlimit(what, &now);
}

/* Crashes are silent; signals meant for the program are its own to hear, and the child is soon done.
 * Nor is a parent that does not listen any more a crash. */
static void settle_in(void)
{
  static const int fatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU},
                   ignored[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
  for (size_t i = 0; i < sizeof fatal / sizeof *fatal; ++i) signal(fatal[i], SIG_DFL);
  for (size_t i = 0; i < sizeof ignored / sizeof *ignored; ++i) signal(ignored[i], SIG_IGN);
  const int nowhere = open("/dev/null", O_WRONLY);
  for (int fd = STDOUT_FILENO; fd <= STDERR_FILENO; ++fd)
    if (nowhere < 0 || dup2(nowhere, fd) < 0) close(fd);
  const rlim_t used = in_use();
  if (used > 0) limit(RLIMIT_AS, used + most_bytes);
  limit(RLIMIT_CPU, CPU_SECONDS);
  limit(RLIMIT_CORE, 0);
}

_Noreturn static void serve(int to, const char *path, const char *variable, int expected)
{
  reply r = {0};
  double *values;
  message m;
  to = fcntl(to, F_DUPFD, STDERR_FILENO + 1); /* it may have the place of a terminal that was closed */
  settle_in();
  message_start(&m, r.words, sizeof r.words);
  r.status = matlab_variable_read(path, variable, expected, &r.n, &values, &m);
  const bool told = put(to, &r, sizeof r);
  if (told && r.status == HC_OK) put(to, values, (size_t)r.n * (size_t)r.n * sizeof *values);
  _exit(0); /* no buffers of the parent's are written */
}

/* ---- the parent ---- */

static bool all_finite(const double *v, size_t count)
{
  for (size_t i = 0; i < count; ++i)
    if (!isfinite(v[i])) return false;
  return true;
}

/* What the child says, as far as it can be believed: it may have been overwritten by what it read. *whole: it came to
 * its end. */
static hc_status listen(int from, int expected, int *rows, double **values, message *m, bool *whole)
{
  reply r;
  *whole = get(from, &r, sizeof r);
  if (!*whole) return HC_BAD_INPUT;
  r.words[WORDS - 1] = '\0';
  if (r.status == HC_NO_MEMORY) return HC_NO_MEMORY;
  if (r.status != HC_OK) {
    *whole = *r.words != '\0';
    message_add_input(m, r.words, strlen(r.words), WORDS);
    return HC_BAD_INPUT;
  }
  *whole = false;
  if (r.n < 1 || r.n > MATRIX_MOST_ROWS || (expected > 0 && r.n != expected)) return HC_BAD_INPUT;
  const size_t count = (size_t)r.n * (size_t)r.n;
  if (!(*values = malloc(count * sizeof **values))) return HC_NO_MEMORY;
  *rows = r.n;
  *whole = get(from, *values, count * sizeof **values) && all_finite(*values, count);
  return *whole ? HC_OK : HC_BAD_INPUT;
}

/* How the child ended; 0 where the program does not care for its children and nobody knows. */
static int end_of(pid_t child)
{
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 0;
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

static void tell_end(message *m, int end)
{
  message_add(m, "cannot be read: ");
  if (end == SIGXCPU) message_add(m, "libmatio did not end within %d s", CPU_SECONDS);
  else if (end) message_add(m, "libmatio crashed (signal %d)", end);
  else message_add(m, "libmatio gave no answer");
  message_add(m, ", expected a MATLAB file without damage");
}

/* A pipe that nobody else's children keep open. */
static bool open_pipe(int ends[2])
{
  if (pipe(ends) != 0) return false;
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  fcntl(ends[1], F_SETFD, FD_CLOEXEC);
  return true;
}

/* By a child, from a file that is there. */
static hc_status read_apart(const char *path, const char *variable, int expected, int *rows, double **values,
                            message *m)
{
  int ends[2];
  bool whole;
  if (!open_pipe(ends)) return HC_NO_MEMORY;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    serve(ends[1], path, variable, expected);
  }
  close(ends[1]);
  hc_status st = child < 0 ? HC_NO_MEMORY : listen(ends[0], expected, rows, values, m, &whole);
  close(ends[0]);
  const int end = child < 0 ? 0 : end_of(child);
  if (st == HC_BAD_INPUT && !whole) tell_end(m, end);
  if (st == HC_OK) return HC_OK;
  free(*values);
  *values = NULL;
  *rows = 0;
  return st;
}

hc_status matlab_child_read(const char *path, const char *variable, int expected, int *rows, double **values,
                            message *m)
{
  FILE *from;
  size_t size;
  *rows = 0;
  *values = NULL;
  const hc_status st = text_file_open(path, SIZE_MAX, &from, &size, m);
  if (st != HC_OK) return st;
  fclose(from);
  return read_apart(path, variable, expected, rows, values, m);
}
