/* cli.h - what commands share: the options all have, readers for values of their own, exit codes, and the one place
 * that puts failures into words. Results go to stdout or --output, all else to stderr. See commands.h and README.md. */
#pragma once

#include <argp.h>
#include <stdbool.h>

#include "compare/output/progress.h"
#include "compare/output/rows.h"
#include "compare/output/table.h"
#include "interfaces/command/plot/plot.h"
#include "model/casefile/case_file.h"
#include "model/casefile/scene.h"
#include "model/model.h"
#include "numerics/base/status.h"

enum { EXIT_AGREED = 0, EXIT_DISAGREED = 1, EXIT_BAD_CASE = 2, EXIT_NO_SOLUTION = 3, EXIT_USAGE = 64, EXIT_BUG = 70 };

enum { CLI_MAX_SET = 256, CLI_MAX_ARGUMENTS = 64, CLI_MAX_JOBS = 1024 };

/* Why a command names a file. */
typedef enum {
  CLI_INPUT,
  CLI_OUTPUT,
  CLI_RESULTS /* kept over several calls: read and written */
} cli_file_use;

/* One of a command's own options: a row of its table. */
typedef enum {
  CLI_FLAG,     /* bool         */
  CLI_TEXT,     /* const char * */
  CLI_TEXTS,    /* cli_texts: may be given several times                 */
  CLI_LIST,     /* number_list, all > 0                                  */
  CLI_INTEGER,  /* int,  low..high                                       */
  CLI_COUNT,    /* long, low..high                                       */
  CLI_POSITIVE, /* double                                                */
  CLI_FORMAT,   /* table_format, csv or json                             */
  CLI_PLOT      /* common->drawing.path: a file that can be drawn to     */
} cli_kind;

typedef struct cli_option {
  cli_kind kind;
  const char *name, *argument, *help; /* argument: what it takes, in the help; NULL of a CLI_FLAG */
  size_t at;                          /* its member of the command's own struct */
  int low, high;
  int group;        /* of the help; 0 is the first one */
  const char *file; /* what messages call the file it names, "--junit"; NULL: none */
  cli_file_use use; /* of that file */
  char letter;      /* 'j' of -j; 0: none */
} cli_option;

enum { CLI_MOST_OPTIONS = 16, CLI_MOST_TEXTS = 16 };
typedef struct cli_texts {
  int n;
  const char *text[CLI_MOST_TEXTS];
} cli_texts;

/* A command: its help, its own options, and what it does. */
typedef struct cli_command cli_command;
typedef struct cli_common cli_common;
typedef struct cli_call cli_call;
struct cli_command {
  const char *name;          /* "frf"                                                                   */
  const char *summary;       /* its line of hbmcheck --help                                             */
  const char *arguments;     /* "CASE": one is required; "CASE...": one or more; "[FIELD]", "": none is */
  const char *help;          /* what it does, \v, columns, exit codes, an example                       */
  const cli_option *options; /* its own, at most CLI_MOST_OPTIONS, then {0}; NULL for none */
  size_t own_size;           /* of the struct that they fill                                            */
  const void *defaults;      /* what that struct holds before; NULL: zeros                              */
  bool starts_itself;        /* run checks the files and loads the case; else that is done before it    */
  /* Does the work, on the options' struct and the case of a command for one CASE. Returns the exit code. */
  int (*run)(cli_common *common, void *own, scene *sc);
};

/* Its definition, at the end of cmd_NAME.c, which has help[], options[] and run_NAME; own: the type of its struct. What
 * follows is the summary, and other members where they are not 0. */
/* clang-format off */
#define CLI_COMMAND(NAME, own, takes, ...) \
  const cli_command cmd_##NAME = {.name = #NAME, .arguments = takes, .help = help, .options = options, \
                                  .own_size = sizeof(own), .run = run_##NAME, .summary = __VA_ARGS__}
/* clang-format on */

/* What every command has. */
struct cli_common {
  const cli_command *command;
  void *own; /* the command's own struct, as its options filled it */
  int n_arguments;
  const char *argument_is;                  /* what they are, "the case file"; NULL: no files */
  const char *arguments[CLI_MAX_ARGUMENTS]; /* CASE, or what stands in its place; arguments[0] is NULL without any */
  int n_set;
  const char *set[CLI_MAX_SET]; /* --set */
  table_format format;          /* --format */
  const char *output;           /* --output; NULL: standard output */
  bool quiet;                   /* --quiet */
  bool wide;                    /* --wide */
  bool bands;                   /* --band: of HBM's solutions, where a command has that option */
  plot_order drawing;           /* --plot; path NULL: no drawing */
  const scene *scene;           /* the case at work, for messages; NULL before cli_load_case */
  cli_call *call;               /* of a program (call.h): it gets what else is printed; NULL: of a shell */
};

/* Runs a command, argv[0] its name; its exit code. Ends the program on --help, --version and wrong usage (64). */
int cli_run(const cli_command *self, int argc, char **argv);

/* In its parts, for call.c. An option's value into the command's own struct, which cli_own_options makes, to free
 * (NULL: no memory); false, and why it cannot be. Then the command, its options read; its exit code. */
void *cli_own_options(const cli_command *self);
bool cli_read_value(cli_common *common, const cli_option *o, const char *text, char why[CASE_MESSAGE]);
int cli_run_parsed(cli_common *common);

/* What --at takes, in its help. */
#define CLI_FREQUENCIES "omegas, rad per unit time (cycles, where the case has sweep.frequency)"

/* Options that several commands have, rows of the table of a command whose own struct is `type`. */
/* clang-format off */
/* With it goes a second table, of ROWS_CONTACT. */
#define CLI_CONTACTS_OPTION(type) \
  {CLI_FLAG, "contacts", NULL, \
   "A second table: of each contact in each solution the extrema of its forces, slip path and dissipated work", \
   offsetof(type, contacts)}
/* --plot - while csv, json or an export goes to standard output ends the program with a message (exit 64). */
#define CLI_PLOT_OPTION \
  {CLI_PLOT, "plot", "FILE", \
   "Draw the result with gnuplot, too: FILE ends in .svg, .png or .pdf; - draws with letters, here. Exit 3 if only " \
   "that fails", \
   .group = 2, .file = "--plot", .use = CLI_OUTPUT}
/* clang-format on */

/* No output of a command may replace one of its inputs or another of its outputs: every command hands in the files
 * that it reads and writes before it opens or computes anything. Names that mean one file are told by device and inode
 * number (compare/output/same_file.h); /dev/null, terminals and pipes may be given any number of times. */
typedef struct cli_file {
  const char *what; /* "--junit", "the curve": how messages call it                                                   */
  const char *path; /* NULL: there is none; "-": standard input or output, but for CLI_RESULTS                        */
  cli_file_use use;
} cli_file;

/* Hold files[n], the command's CASEs or STUDYs, the files of its options and --output (without it, standard output)
 * against each other. 0; or
 * EXIT_USAGE after a message that names both if an output is an input or another output; EXIT_NO_SOLUTION without
 * memory. Nothing is opened. */
int cli_check_files(cli_common *common, int n, const cli_file *files);

/* Scenes computed at a time by default: the processors that are online, 1..CLI_MAX_JOBS. */
int cli_processors(void);
/* The same of a command; 1 for a call: threads are the caller's business. */
int cli_jobs(const cli_common *common);

/* Read the case with --set into sc, then common->scene. 0, or the exit code after the message, also in err. */
int cli_load_case(cli_common *common, const char *path, scene *sc, case_error *err);

/* The same, but a structure with large sparse matrices is taken as such, for what can do with it. */
int cli_load_sparse_case(cli_common *common, scene *sc);

/* On stderr, unless quiet: what the reader says of pairs that were found by position. */
void cli_say_notes(const cli_common *common, const scene *sc);
/* The message for a file that cannot be read as what it should be, err's or else st's. Returns the exit code. */
int cli_not_read(const cli_common *common, hc_status st, const case_error *err);

/* The frequencies of --at, if there are any, into compare.omega of the case: they are cycles per time where its sweep
 * is. Frequencies outside the sweep are warned of. Of those a factor 4 below or above it: what looks like the other
 * unit (within a factor 10 of the sweep in that) is refused. If the response curve is `followed` to the frequencies,
 * and all of them are so far and within a factor 4 of each other, the case's sweep becomes theirs: they are solved for
 * without all that lies between; else they are refused. 0, or the exit code after the message. */
int cli_take_frequencies(const cli_common *common, const number_list *at, bool followed, scene *sc);
/* The same; false and the message in why where they are refused, which is not said. */
bool cli_frequencies_fit(const cli_common *common, const number_list *at, bool followed, scene *sc,
                         char why[CASE_MESSAGE]);

/* "hbmcheck COMMAND: ..." on stderr. */
void cli_message(const cli_common *common, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The same without the command's name, which stands in the text or is none of its business. */
void cli_say(const cli_common *common, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The same as cli_message, with the exit code as its value. */
#define cli_failed(common, code, ...) (cli_message(common, __VA_ARGS__), (code))

/* How the work as a whole ended, for a call; the first that is not HC_OK counts. Single rows may have failed beside. */
void cli_ended(const cli_common *common, hc_status st);

/* progress_start, or ticks of the caller's monitor. */
progress *cli_progress(const cli_common *common, const char *label);

/* Does somebody hear what is foretold? Else it need not be worked out. */
bool cli_foretells(const cli_common *common);

/* Whose settings the advice in a message is about. */
typedef enum cli_solver { CLI_HBM, CLI_TRANSIENT, CLI_BOTH } cli_solver;

/* Says that `what` failed, where (omega <= 0: nowhere), why, and what to try. Returns the exit code. */
int cli_solver_failed(const cli_common *common, cli_solver solver, const char *what, hc_status st, double omega);

/* Says that there is no periodic motion at omega, and by how much that response ("": the only one) moves on a period.
 * Returns the exit code. */
int cli_creeps(const cli_common *common, double omega, const char *response, double drift);

/* Where no solution was found: does the body creep there, that response (name[RESPONSE_NAME]) by *drift a period? */
bool cli_it_creeps(const scene *sc, double omega, const hc_monitor *monitor, char *name, double *drift);

/* Just past the end of a curve that stops, where another motion may be seen [omega]. */
double cli_past(const scene *sc, double omega);

/* Says why the file (NULL: standard output) was not written, by errno. Returns the exit code. */
int cli_file_failed(const cli_common *common, const char *path, hc_status st);

/* A table of own columns[n], without `frequency` and `response` where `extra` lacks ROWS_IN_CYCLES, ROWS_RESPONSES. */
table *cli_own_table(const char *title, unsigned extra, int n, const table_column *columns);
#define CLI_LENGTH(list)  (int)(sizeof(list) / sizeof *(list))
#define CLI_COLUMNS(list) CLI_LENGTH(list), list

/* The columns of rows.h that only some cases have, for this one. */
unsigned cli_extra_columns(const scene *sc);

/* An empty table of that kind of rows (rows.h), which a narrow screen may show in part; and one row of it. */
table *cli_table(const cli_common *common, const char *title, rows_kind kind);
void cli_put_row(const cli_common *common, table *t, rows_kind kind, const void *row);

/* Does a table of that kind have the column, somewhere but where a narrow screen would lose it? What is read nowhere
 * need not be computed. */
bool cli_reads(const cli_common *common, rows_kind kind, const char *column);

/* The length of a line: output_columns, or 100. At least 40. */
int cli_width(const cli_common *common);

/* Write the tables to stdout or --output, whole or not at all, within cli_width unless --wide. 0 or the exit code. */
int cli_write(const cli_common *common, int n, table *const *tables);
/* The same, and frees them. */
int cli_write_all(const cli_common *common, int n, table *const *tables);

/* Rows as they are found, with --format csv or json on standard output: cli_shows_rows is true there. cli_show_rows
 * writes those of t that have not been written, at once, also into a pipe; cli_write_rest the rest of all tables, as
 * cli_write does. A progress line is erased, and drawn again by its next tick. */
bool cli_shows_rows(const cli_common *common);
void cli_show_rows(const cli_common *common, const table *t, table_begun *begun);
int cli_write_rest(const cli_common *common, int n, table *const *tables, const table_begun *begun);

/* Unless quiet, says if that is much memory, and whether the machine has it. Before a progress line is drawn. */
void cli_foretell_memory(const cli_common *common, double bytes);

/* The same of processor time, if that is more than 10 s (compare/duration.h): "takes about 40 s of processor time: 3
 * frequencies, 84 degrees of freedom, 24 contact rows", without sizes where m is NULL; "a response curve" without
 * frequencies. */
void cli_foretell_time(const cli_common *common, double seconds, int frequencies, const model *m);

/* A folder for results (NULL: none), made if it is not there. 0, or the exit code after the message. */
int cli_make_folder(const cli_common *common, const char *path);

/* After common->drawing ended with st: 0, or the exit code after the message that there is none and why. */
int cli_plotted(const cli_common *common, hc_status st);

/* "H = 10, exact forces" or "H = 10 WITHOUT harmonic 0, 1024 samples"; for auto the numbers in use. Returns text. */
const char *cli_hbm_settings(const scene *sc, int n_harm, int n_time, char *text, size_t size);

/* "hbmcheck 1.0.0" and the versions of the libraries it runs with. The signature argp wants for its --version. */
void cli_print_version(FILE *to, struct argp_state *state);
