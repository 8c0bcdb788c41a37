/* checker.c - see checker.h. */
#include "proof/prove/checker.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static const char program[] = "hbmcheck-proof";

struct proof_checker {
  pid_t pid; /* 0: not started */
  FILE *to, *from;
  char *line; /* [room] last answer */
  size_t room;
};

/* The program's path, or its name if it is to be searched in PATH. */
static void find_program(char path[PATH_MAX])
{
  const char *named = getenv("HBMCHECK_PROOF");
  const ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - sizeof program);
  char *slash = NULL;
  if (length > 0) path[length] = 0, slash = strrchr(path, '/');
  if (slash) memcpy(slash + 1, program, sizeof program);
  if (named && *named) snprintf(path, PATH_MAX, "%s", named);
  else if (!slash || access(path, X_OK) != 0) memcpy(path, program, sizeof program);
}

/* Starts the program with `in` and `out` as its streams, SIGPIPE as by default. Returns 0 or an errno. */
static int spawn(proof_checker *c, int in, int out)
{
  char path[PATH_MAX], complete[] = "complete", standard[] = "-", output[] = "-o";
  char *argv[] = {path, complete, standard, output, standard, NULL};
  posix_spawn_file_actions_t streams;
  posix_spawnattr_t how;
  sigset_t pipes;
  find_program(path);
  sigemptyset(&pipes);
  sigaddset(&pipes, SIGPIPE);
  int bad = posix_spawn_file_actions_init(&streams);
  if (bad) return bad;
  bad = posix_spawnattr_init(&how);
  if (!bad) {
    bad = posix_spawnattr_setsigdefault(&how, &pipes);
    if (!bad) bad = posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGDEF);
    if (!bad) bad = posix_spawn_file_actions_adddup2(&streams, in, STDIN_FILENO);
    if (!bad) bad = posix_spawn_file_actions_adddup2(&streams, out, STDOUT_FILENO);
    if (!bad) bad = posix_spawnp(&c->pid, path, &streams, &how, argv, environ);
    posix_spawnattr_destroy(&how);
  }
  posix_spawn_file_actions_destroy(&streams);
  return bad;
}

/* Makes two pipes, of which the child inherits only its streams, and starts it. Returns 0 or an errno. */
static int start(proof_checker *c)
{
  int to[2] = {-1, -1}, from[2] = {-1, -1};
  int bad = pipe(to) != 0 || pipe(from) != 0 ? errno : 0;
  for (int i = 0; i < 2 && !bad; ++i)
    if (fcntl(to[i], F_SETFD, FD_CLOEXEC) < 0 || fcntl(from[i], F_SETFD, FD_CLOEXEC) < 0) bad = errno;
  if (!bad) bad = spawn(c, to[0], from[1]);
  if (bad) c->pid = 0;
  if (!bad && !(c->to = fdopen(to[1], "w"))) bad = errno;
  if (!bad && !(c->from = fdopen(from[0], "r"))) bad = errno;
  close(to[0]);
  close(from[1]);
  if (!c->to) close(to[1]);
  if (!c->from) close(from[0]);
  return bad;
}

hc_status proof_checker_new(proof_checker **out)
{
  proof_checker *c = calloc(1, sizeof *c);
  *out = NULL;
  if (!c) return HC_NO_MEMORY;
  const int bad = start(c);
  if (!bad) return *out = c, HC_OK;
  proof_checker_free(c);
  errno = bad;
  return bad == ENOMEM ? HC_NO_MEMORY : HC_IO;
}

void proof_checker_free(proof_checker *c)
{
  if (!c) return;
  if (c->to) fclose(c->to); /* the program ends at the end of its input */
  if (c->from) fclose(c->from);
  while (c->pid > 0 && waitpid(c->pid, NULL, 0) < 0 && errno == EINTR) {}
  free(c->line);
  free(c);
}

hc_status proof_checker_ask(proof_checker *c, const json_t *question, json_t **answer)
{
  *answer = NULL;
  errno = 0; /* end of file sets no errno */
  if (json_dumpf(question, c->to, JSON_COMPACT) < 0 || putc('\n', c->to) == EOF || fflush(c->to) != 0) return HC_IO;
  const ssize_t length = getline(&c->line, &c->room, c->from);
  if (length > 0) *answer = json_loadb(c->line, (size_t)length, 0, NULL);
  return *answer ? HC_OK : HC_IO;
}
