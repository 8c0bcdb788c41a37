/* main.c - hbmcheck: one command word, the rest is the command's. */
#include <gsl/gsl_errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "command/cli.h"
#include "command/version.h"
#include "output/progress.h"

static const struct command {
  const char *name, *does;
  int (*run)(int argc, char **argv);
} commands[] = {
    {"compare", "harmonic balance and time integration at the same frequencies: discrepancies and verdicts",
     cmd_compare},
    {"frf", "the harmonic-balance response curve, or every solution at given frequencies", cmd_frf},
    {"transient", "the steady state by time integration at given frequencies", cmd_transient},
    {"study", "many scenes in parallel, kept as they come, and claims held against them", cmd_study},
    {"bench", "work-precision: run time against error for every method at one frequency", cmd_bench},
    {"gate", "the accuracy gate for CI: case files with limits, a table of verdicts, JUnit, an exit code", cmd_gate},
    {"verify", "another code's response curve held against both, and the suspected cause where it is off", cmd_verify},
    {"stress", "random scenes, every method held against every other", cmd_stress},
    {"report", "one self-contained HTML page: verdict in words, plots, tables, what aliasing does", cmd_report},
    {"contact", "Fourier coefficients of the contact force of a given motion", cmd_contact},
    {"describe", "what a case file may say", cmd_describe},
};
enum { N_COMMANDS = sizeof commands / sizeof *commands };

static void usage(FILE *to)
{
  fputs("usage: hbmcheck COMMAND [OPTION...] CASE\n\n", to);
  for (int i = 0; i < N_COMMANDS; ++i) fprintf(to, "  %-10s %s\n", commands[i].name, commands[i].does);
  fputs("\nhbmcheck COMMAND --help tells more. Start with: hbmcheck compare cases/paper/case2.yaml\n"
        "exit: 0 agreed  1 disagreed  2 case file wrong  3 could not  64 usage  70 a bug\n",
        to);
}

int main(int argc, char **argv)
{
  signal(SIGPIPE, SIG_IGN);    /* a closed pipe is a write error like any other */
  signal(SIGCHLD, SIG_DFL);    /* ignored by who started us, the exit codes of gnuplot and python3 would be lost */
  gsl_set_error_handler_off(); /* its default aborts; our code reads the statuses */
  progress_install_signals();
  if (argc < 2) {
    usage(stderr);
    return EXIT_USAGE;
  }
  if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "help")) {
    usage(stdout);
    return 0;
  }
  if (!strcmp(argv[1], "--version")) {
    cli_print_version(stdout, NULL);
    return 0;
  }
  for (int i = 0; i < N_COMMANDS; ++i)
    if (!strcmp(argv[1], commands[i].name)) return commands[i].run(argc - 1, argv + 1);
  fprintf(stderr, "hbmcheck: '%s' is not a command\n\n", argv[1]);
  usage(stderr);
  return EXIT_USAGE;
}
