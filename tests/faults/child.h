/* child.h - a piece of work in a process of its own, so that it may crash, leak, hang or call exit() and the test
 * goes on; and the command hbmcheck as such work, its main() linked in under the name hbmcheck_main. */
#pragma once

enum { CHILD_TEXT = 1 << 18 };

typedef struct outcome {
  int code;   /* exit code; -1: ended by a signal */
  int signal; /* which; SIGALRM: it took too long */
  long count; /* what the work put into *child_count */
  char out[CHILD_TEXT], err[CHILD_TEXT];
} outcome;

/* Shared with the child: how often it came by the place where the fault would be. Made by the first child_run. */
extern volatile long *child_count;

/* work(self) is the exit code. Standard output and error are read back; leaks fail it under the sanitizers. */
void child_run(int (*work)(void *), void *self, unsigned seconds, outcome *o);

/* "hbmcheck ARG ARG ..." split at blanks; '...' keeps blanks. In a child only: it may exit. */
int child_command(const char *line);
int hbmcheck_main(int argc, char **argv);

/* One line for a test that failed. */
void child_show(const outcome *o, const char *what);
