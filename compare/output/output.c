/* output.c - see output.h. The file beside is opened with O_EXCL under our own name, not by mkstemp: the kernel then
 * applies umask and ACLs (reading the umask disturbs threads). Signals are the main program's. Proof: test_output.c. */
#include "compare/output/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "compare/output/same_file.h"
#include "numerics/base/path.h"

enum { MAX_TRIES = 10000, MOST_BESIDE = 8, MOST_COLUMNS = 10000 };

/* The files beside that exist now, for output_abandon_all in a signal handler, which gets no argument: so many. */
static _Atomic(char *) all_beside[MOST_BESIDE];

/* Put a new one in the place of NULL, or NULL in that of one whose name is about to be freed. */
/* NOLINTNEXTLINE(readability-non-const-parameter): the list holds it as it is kept elsewhere, not const */
static void replace_beside(char *old, char *new)
{
  for (int i = 0; i < MOST_BESIDE; ++i) {
    char *this = old;
    if (atomic_compare_exchange_strong(&all_beside[i], &this, new)) return;
  }
}

void output_abandon_all(void)
{
  for (int i = 0; i < MOST_BESIDE; ++i) {
    const char *beside = atomic_load(&all_beside[i]);
    if (beside) unlink(beside);
  }
}

struct output {
  FILE *stream;
  char *target; /* what the commit renames to, links followed; NULL when written straight */
  char *beside; /* what is written until then; set only while it exists */
};

/* Opens a new file in the target's folder, under a short name: one made from the target's could be too long. */
static int open_beside(output *o)
{
  for (int i = 0; i < MAX_TRIES; ++i) {
    char name[64];
    snprintf(name, sizeof name, ".hbmcheck-%ld-%d", (long)getpid(), i);
    char *beside = path_beside(o->target, name, strlen(name));
    if (!beside) return -1;
    int fd = open(beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0) {
      o->beside = beside;
      replace_beside(NULL, beside);
      return fd;
    }
    free(beside);
    if (errno != EEXIST) return -1;
  }
  return -1;
}

/* A file descriptor to write to, or -1 and errno. `old`: the file that is at `path`, or NULL. */
static int open_regular(output *o, const char *path, const struct stat *old)
{
  /* rename would replace a read-only file, too */
  if (old && access(path, W_OK) != 0) return -1;
  o->target = file_follow_links(path);
  if (!o->target) return -1;
  int fd = open_beside(o);
  /* fails on a file system without permissions, which has none to keep */
  if (fd >= 0 && old) fchmod(fd, old->st_mode & 0777);
  return fd;
}

static bool is_standard_output(const struct stat *st)
{
  struct stat out;
  return fstat(STDOUT_FILENO, &out) == 0 && out.st_dev == st->st_dev && out.st_ino == st->st_ino;
}

static FILE *open_stream(output *o, const char *path)
{
  struct stat st;
  if (path && !strcmp(path, "-")) path = NULL;
  bool exists = path && stat(path, &st) == 0;
  if (!path || (exists && is_standard_output(&st))) return stdout;
  if (!*path) {
    errno = ENOENT;
    return NULL;
  }
  /* a directory is refused by open itself */
  int fd = exists && !S_ISREG(st.st_mode) ? open(path, O_WRONLY | O_NOCTTY | O_CLOEXEC)
                                          : open_regular(o, path, exists ? &st : NULL);
  if (fd < 0) return NULL;
  FILE *stream = fdopen(fd, "w");
  if (!stream) close(fd);
  return stream;
}

/* Closes, removes what was written beside, frees; errno stays as it was. */
static void discard(output *o)
{
  int why = errno;
  if (o->stream && o->stream != stdout) fclose(o->stream);
  if (o->beside) {
    unlink(o->beside);
    replace_beside(o->beside, NULL);
  }
  free(o->beside);
  free(o->target);
  free(o);
  errno = why;
}

hc_status output_open(const char *path, output **out)
{
  *out = NULL;
  output *o = calloc(1, sizeof *o);
  if (!o) return HC_NO_MEMORY;
  o->stream = open_stream(o, path);
  if (o->stream) {
    *out = o;
    return HC_OK;
  }
  discard(o);
  return errno == ENOMEM ? HC_NO_MEMORY : HC_IO;
}

FILE *output_stream(output *o) { return o->stream; }

hc_status output_commit(output *o)
{
  /* Was everything written and accepted by the kernel? Closes the stream unless it is standard output. */
  FILE *stream = o->stream;
  bool lost = ferror(stream) != 0;
  errno = 0;
  bool flushed = (stream == stdout ? fflush(stream) : fclose(stream)) == 0;
  o->stream = NULL;
  if (lost && errno == 0) errno = EIO; /* the errno of the write that failed is lost */
  bool good = flushed && !lost;
  if (good && o->beside && (good = rename(o->beside, o->target) == 0)) {
    replace_beside(o->beside, NULL);
    free(o->beside);
    o->beside = NULL;
  }
  discard(o);
  return good ? HC_OK : HC_IO;
}

void output_abandon(output *o)
{
  if (o) discard(o);
}

hc_status output_finish(output *o, hc_status st)
{
  if (st == HC_OK) return output_commit(o);
  output_abandon(o);
  return st;
}

/* The columns of a terminal, 0 where there is none. */
static int terminal_columns(int fd, int *rows)
{
  struct winsize size;
  if (ioctl(fd, TIOCGWINSZ, &size) != 0) return 0;
  *rows = size.ws_row;
  return size.ws_col;
}

int output_columns(const char *path, int *rows)
{
  struct stat out;
  int columns = 0;
  *rows = 0;
  if (!path || !strcmp(path, "-")) {
    columns = terminal_columns(STDOUT_FILENO, rows);
    if (columns == 0 && fstat(STDOUT_FILENO, &out) == 0 && S_ISFIFO(out.st_mode))
      columns = terminal_columns(STDERR_FILENO, &(int){0});
  }
  if (columns > 0) return columns;
  const char *said = getenv("COLUMNS");
  char *end = NULL;
  const long number = said ? strtol(said, &end, 10) : 0;
  return end && !*end && number > 0 && number <= MOST_COLUMNS ? (int)number : 0;
}
