/* main.c - hbmcheck COMMAND ...: finds the command (commands.h) and hands it its arguments. */
#include <errno.h>
#include <gsl/gsl_errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/output/progress.h"
#include "interfaces/command/commands.h"
#include "numerics/base/nearest.h"
#include "numerics/base/trace.h"
#include "numerics/dense.h"

#define ADDRESS_OF(name) &cmd_##name,
static const cli_command *const commands[] = {COMMANDS(ADDRESS_OF)};
#undef ADDRESS_OF
enum { N_COMMANDS = sizeof commands / sizeof *commands };

#define NAME_OF(name) #name,
static const char *const names[] = {COMMANDS(NAME_OF) "help", NULL};
#undef NAME_OF

static void usage(FILE *to)
{
  fputs("usage: hbmcheck COMMAND [OPTION...] CASE\n\n", to);
  for (int i = 0; i < N_COMMANDS; ++i) fprintf(to, "  %-10s %s\n", commands[i]->name, commands[i]->summary);
  fputs("\nhbmcheck COMMAND --help tells more. Start with: hbmcheck compare cases/paper/case2.yaml\n"
        "exit: 0 agreed  1 disagreed  2 case file wrong  3 could not  64 usage  70 a bug\n",
        to);
}

/* The exit code once all of it is on standard output. */
static int written(const char *what)
{
  if (fflush(stdout) == 0 && !ferror(stdout)) return 0;
  if (errno != EPIPE) fprintf(stderr, "hbmcheck %s: standard output: %s\n", what, strerror(errno));
  return EXIT_NO_SOLUTION;
}

int main(int argc, char **argv)
{
  signal(SIGPIPE, SIG_IGN);    /* a closed pipe then is a write error, with exit code 3 */
  signal(SIGCHLD, SIG_DFL);    /* if our parent ignored it, waitpid could not tell how gnuplot and python3 ended */
  gsl_set_error_handler_off(); /* GSL's default handler aborts; we check its statuses */
  dense_end_idle_threads();
  progress_install_signals(EXIT_NO_SOLUTION);
  if (argc < 2) {
    usage(stderr);
    return EXIT_USAGE;
  }
  if (!strcmp(argv[1], "--help") || (!strcmp(argv[1], "help") && argc == 2)) {
    usage(stdout);
    return written("--help");
  }
  if (!strcmp(argv[1], "--version")) {
    cli_print_version(stdout, NULL);
    return written("--version");
  }
  char wrong[256];
  message msg;
  message_start(&msg, wrong, sizeof wrong);
  if (trace_start(getenv("HBMCHECK_TRACE"), &msg) != HC_OK) {
    fprintf(stderr, "%s\n", wrong);
    return EXIT_USAGE;
  }
  const bool help = !strcmp(argv[1], "help"); /* help NAME is NAME --help */
  const char *name = argv[help ? 2 : 1];
  const cli_command *command = NULL;
  for (int i = 0; i < N_COMMANDS && !command; ++i)
    if (!strcmp(name, commands[i]->name)) command = commands[i];
  char *ask[] = {argv[0], "--help", NULL}, hint[NEAREST_HINT];
  if (command) return cli_run(command, help ? 2 : argc - 1, help ? ask : argv + 1);
  fprintf(stderr, "hbmcheck: '%s' is not a command%s\n", name, nearest_hint(names, name, hint));
  fputs(*hint ? "Try 'hbmcheck --help'.\n" : "\n", stderr);
  if (!*hint) usage(stderr);
  return EXIT_USAGE;
}
