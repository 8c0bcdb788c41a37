/* child.c - see child.h. */
#include "tests/faults/child.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include "tests/check.h"

volatile long *child_count;
static FILE *streams[2]; /* made once: the parent never fails */

/* Exit codes of our own are small or round; 99 is nobody's. The sanitizer keeps its own signal handlers, against
 * cmocka's. */
const char *__asan_default_options(void);
const char *__asan_default_options(void) { return "exitcode=99:handle_segv=2:handle_sigbus=2"; }

static void make_room(void)
{
  if (child_count) return;
  FILE *shared = tmpfile();
  assert_true(shared && ftruncate(fileno(shared), sizeof *child_count) == 0);
  child_count = mmap(NULL, sizeof *child_count, PROT_READ | PROT_WRITE, MAP_SHARED, fileno(shared), 0);
  assert_true(child_count != MAP_FAILED);
  fclose(shared);
  for (int i = 0; i < 2; ++i) assert_non_null(streams[i] = tmpfile());
}

static void take_text(FILE *from, char *text)
{
  rewind(from);
  text[fread(text, 1, CHILD_TEXT - 1, from)] = 0;
}

void child_run(int (*work)(void *), void *self, unsigned seconds, outcome *o)
{
  int status;
  make_room();
  *child_count = 0;
  for (int i = 0; i < 2; ++i) {
    rewind(streams[i]);
    assert_int_equal(ftruncate(fileno(streams[i]), 0), 0);
  }
  fflush(NULL);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    static const int caught[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGSYS};
    for (int i = 0; i < 5; ++i) signal(caught[i], SIG_DFL); /* cmocka would go on with the next test, here, too */
    alarm(seconds);
    dup2(fileno(streams[0]), 1);
    dup2(fileno(streams[1]), 2);
    exit(work(self));
  }
  assert_int_equal(waitpid(child, &status, 0), child);
  o->code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  o->signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  o->count = *child_count;
  take_text(streams[0], o->out);
  take_text(streams[1], o->err);
}

int child_command(const char *line)
{
  enum { MOST = 40, TEXT = 2048 };
  static char text[TEXT];
  char *argv[MOST + 1], *at = text;
  int argc = 0;
  snprintf(text, sizeof text, "hbmcheck %s", line);
  while (*at && argc < MOST) {
    char end = *at == '\'' ? '\'' : ' ';
    if (end == '\'') ++at;
    argv[argc++] = at;
    at = strchr(at, end);
    if (!at) break;
    *at++ = 0;
    while (*at == ' ') ++at;
  }
  argv[argc] = NULL;
  return hbmcheck_main(argc, argv);
}

void child_show(const outcome *o, const char *what)
{
  print_error("%s: exit %d, signal %d\n--- out\n%.3000s\n--- err\n%.6000s\n", what, o->code, o->signal, o->out, o->err);
}
