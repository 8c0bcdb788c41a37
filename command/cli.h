/* cli.h - what the commands share: options, exit codes, and the one place where a failure is put into words.
 * A command is a function (argc, argv) -> exit code; results go to stdout or --output, everything else to stderr. */
#ifndef HC_CLI_H
#define HC_CLI_H

#include <argp.h>
#include <stdbool.h>

#include "base/status.h"
#include "cases/scene.h"
#include "output/rows.h"
#include "output/table.h"

enum { EXIT_AGREED = 0, EXIT_DISAGREED = 1, EXIT_BAD_CASE = 2, EXIT_NO_SOLUTION = 3, EXIT_USAGE = 64, EXIT_BUG = 70 };

enum {
  CLI_MAX_SET = 256,
  CLI_MAX_ARGUMENTS = 64,
  CLI_MAX_JOBS = 1024,
  CLI_MAX_REPEATS = 1000,
  CLI_MAX_SCENES = 100000000
};

typedef struct cli_options {
  const char *command;  /* "frf", for messages */
  const char *argument; /* CASE, or what stands in its place; NULL if absent */
  int n_set;
  const char *set[CLI_MAX_SET];
  table_format format;
  const char *output;
  bool quiet;
  number_list at;                 /* --at; n = 0 when absent */
  number_list harmonics, samples; /* --harmonics, --samples; n = 0 when absent */
  const char *motion;             /* --motion */
  bool several;                   /* more than one argument may be given: argument is the first of */
  int n_arguments;
  const char *arguments[CLI_MAX_ARGUMENTS];
  int jobs;                                       /* --jobs; 0 when absent */
  const char *results;                            /* --results; NULL when absent */
  bool tables;                                    /* --tables */
  int repeats;                                    /* --repeats; 0 when absent */
  bool alone;                                     /* --alone */
  const char *against, *curve_columns, *quantity; /* --against, --columns, --quantity; NULL when absent */
  const char *junit;                              /* --junit; NULL when absent */
  bool all;                                       /* --all */
  const char *plot, *plot_y;                      /* --plot, --plot-y; NULL when absent */
  bool fresh, timings;                            /* --fresh, --timings */
  int scenes, seed, first;                        /* --scenes, 0 when absent; --seed, -1 when absent; --first */
  double seconds;                                 /* --seconds; 0 when absent */
  bool one_case;                                  /* --case */
  const char *findings;                           /* --findings; NULL when absent */
  bool export;                                    /* --export was given, in export_format */
  table_format export_format;
} cli_options;

/* Keys of the options that only some commands have. */
enum {
  CLI_AT = 0x100,
  CLI_HARMONICS,
  CLI_SAMPLES,
  CLI_MOTION,
  CLI_SET,
  CLI_FORMAT,
  CLI_JOBS,
  CLI_RESULTS,
  CLI_FRESH,
  CLI_EXPORT,
  CLI_TIMINGS,
  CLI_TABLES,
  CLI_REPEATS,
  CLI_ALONE,
  CLI_JUNIT,
  CLI_ALL,
  CLI_PLOT,
  CLI_PLOT_Y,
  CLI_AGAINST,
  CLI_COLUMNS,
  CLI_QUANTITY,
  CLI_SCENES,
  CLI_SEED,
  CLI_FIRST,
  CLI_SECONDS,
  CLI_CASE,
  CLI_FINDINGS
};

/* What the commands that can draw share. */
/* clang-format off */
#define CLI_PLOT_OPTION \
  {"plot", CLI_PLOT, "FILE", 0, \
   "Draw the result with gnuplot, too: FILE ends in .svg, .png or .pdf; - draws with letters, here. Exit 3 if only " \
   "that fails", 2}
/* clang-format on */

/* Parse a command's arguments; does not return on --help, --version or wrong usage (exit 64). `own`: the command's
 * options, or NULL. `args` ending in "..." takes several arguments. */
void cli_parse(int argc, char **argv, const char *command, const char *args, const char *doc,
               const struct argp_option *own, bool needs_argument, cli_options *o);

/* Read the case with --set applied. 0, or the exit code after saying why. */
int cli_load_case(const cli_options *o, scene *sc);

/* "hbmcheck COMMAND: ..." on stderr. */
void cli_say(const cli_options *o, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Say which solver failed where and what to try; the exit code (docs/interface.md, 5). omega <= 0: at no particular
 * one. */
int cli_solver_failed(const cli_options *o, const char *solver, hc_status st, double omega);

/* Append a row of that kind. */
void cli_put_row(table *t, rows_kind kind, const row_cell *cells);

/* Write the tables to stdout or --output, whole or not at all. 0 or the exit code. Frees nothing. */
int cli_write(const cli_options *o, int n, table *const *tables);

/* What came of a drawing: 0, or the exit code after saying that it is missing and why. */
int cli_plotted(const cli_options *o, hc_status st, const char *why);

/* "H = 10, exact forces" or "H = 10 WITHOUT harmonic 0, 1024 samples", with the numbers in use for auto. Returns
 * text. */
const char *cli_hbm_settings(const scene *sc, int n_harm, int n_time, char *text, size_t size);

int cmd_frf(int argc, char **argv);
int cmd_transient(int argc, char **argv);
int cmd_compare(int argc, char **argv);
int cmd_study(int argc, char **argv);
int cmd_bench(int argc, char **argv);
int cmd_gate(int argc, char **argv);
int cmd_verify(int argc, char **argv);
int cmd_report(int argc, char **argv);
int cmd_stress(int argc, char **argv);
int cmd_contact(int argc, char **argv);
int cmd_describe(int argc, char **argv);

#endif
