/* gnuplot.c - see gnuplot.h. Proof: tests/command/plot/test_plots.c. */
#include "command/plot/gnuplot.h"

#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/message.h"
#include "output/progress.h"

extern char **environ;

enum { WORDS = 400 };

/* How gnuplot ended and what it wrote to stderr, in one line. */
static void describe_failure(FILE *words, int status, char *why, size_t size)
{
  char text[WORDS];
  message m;
  message_start(&m, why, size);
  rewind(words);
  size_t n = fread(text, 1, sizeof text, words), begin = 0;
  for (size_t i = 0; i < n; ++i)
    if (text[i] == '\n' || text[i] == '\t') text[i] = ' ';
  while (begin < n && text[begin] == ' ') ++begin;
  while (n > begin && text[n - 1] == ' ') --n;
  if (WIFSIGNALED(status)) message_add(&m, "gnuplot was ended by signal %d", WTERMSIG(status));
  else message_add(&m, "gnuplot failed (%d)", WEXITSTATUS(status));
  if (n > begin) message_add(&m, ": ");
  message_add_input(&m, text + begin, n - begin, WORDS);
}

/* Starts gnuplot with these as its three streams, the default action for SIGPIPE, and without the user's settings.
 * Returns 0 or an errno. */
static int start_gnuplot(FILE *script, FILE *drawing, FILE *words, pid_t *pid)
{
  char name[] = "gnuplot", settings[] = "--default-settings", *argv[] = {name, settings, NULL};
  posix_spawn_file_actions_t streams;
  posix_spawnattr_t how;
  sigset_t pipe;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  int bad = posix_spawn_file_actions_init(&streams);
  if (bad) return bad;
  bad = posix_spawnattr_init(&how);
  if (!bad) {
    bad = posix_spawnattr_setsigdefault(&how, &pipe);
    if (!bad) bad = posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGDEF);
    if (!bad) bad = posix_spawn_file_actions_adddup2(&streams, fileno(script), STDIN_FILENO);
    if (!bad) bad = posix_spawn_file_actions_adddup2(&streams, fileno(drawing), STDOUT_FILENO);
    if (!bad) bad = posix_spawn_file_actions_adddup2(&streams, fileno(words), STDERR_FILENO);
    if (!bad) bad = posix_spawnp(pid, name, &streams, &how, argv, environ);
    posix_spawnattr_destroy(&how);
  }
  posix_spawn_file_actions_destroy(&streams);
  return bad;
}

static hc_status start_and_wait(FILE *script, FILE *drawing, FILE *words, char *why, size_t size)
{
  pid_t pid;
  int status, bad = start_gnuplot(script, drawing, words, &pid);
  if (bad == ENOENT) {
    snprintf(why, size, "gnuplot is not installed, or not in PATH: try apt install gnuplot-nox");
    return HC_IO;
  }
  if (bad) {
    snprintf(why, size, "gnuplot could not be started: %s", strerror(bad));
    return bad == ENOMEM ? HC_NO_MEMORY : HC_IO;
  }
  progress_child(pid);
  int gone;
  do gone = waitpid(pid, &status, 0);
  while (gone < 0 && errno == EINTR);
  progress_child(0);
  if (gone < 0) {
    snprintf(why, size, "gnuplot: %s", strerror(errno));
    return HC_IO;
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && lseek(fileno(drawing), 0, SEEK_END) > 0) return HC_OK;
  describe_failure(words, status, why, size);
  return HC_IO;
}

hc_status gnuplot_run(const char *script, size_t length, FILE *drawing, char *why, size_t size)
{
  FILE *in = tmpfile(), *words = tmpfile();
  hc_status st = HC_IO;
  if (in && words && fwrite(script, 1, length, in) == length && fflush(in) == 0 && lseek(fileno(in), 0, SEEK_SET) == 0)
    st = start_and_wait(in, drawing, words, why, size);
  else snprintf(why, size, "no temporary file: %s", strerror(errno));
  if (in) fclose(in);
  if (words) fclose(words);
  return st;
}
