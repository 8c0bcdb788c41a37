/* cli.c - see cli.h. */
#include "command/cli.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "cases/case_file.h"
#include "command/plot/plot.h"
#include "output/output.h"

static const struct argp_option common_options[] = {
    {"set", CLI_SET, "PATH=VALUE", 0,
     "Set a field of the case, e.g. hbm.harmonics=10 or contacts[0].gap=-1; may be repeated", 10},
    {"format", CLI_FORMAT, "table|csv|json", 0, "Form of the result (csv: 17 significant digits) [table]", 10},
    {"output", 'o', "FILE", 0, "Write the result to FILE, whole or not at all, instead of standard output", 10},
    {"quiet", 'q', NULL, 0, "No progress, no remarks", 10},
    {0},
};

/* A list "5,7,9" of numbers, each strictly read. */
static void read_list(struct argp_state *state, const char *option, const char *text, number_list *out)
{
  out->n = 0;
  for (const char *at = text;;) {
    size_t length = strcspn(at, ",");
    if (out->n == NUMBER_LIST_MAX) argp_error(state, "--%s takes at most %d numbers", option, NUMBER_LIST_MAX);
    if (number_read(at, length, &out->v[out->n]) != NUMBER_FINE || !(out->v[out->n] > 0))
      argp_error(state, "--%s: '%.*s' is not a positive number; expected a list like 5,7,9", option, (int)length, at);
    ++out->n;
    if (!at[length]) return;
    at += length + 1;
  }
}

static void read_format(struct argp_state *state, const char *option, const char *text, bool table_too,
                        table_format *out)
{
  if (table_too && !strcmp(text, "table")) *out = FORMAT_TABLE;
  else if (!strcmp(text, "csv")) *out = FORMAT_CSV;
  else if (!strcmp(text, "json")) *out = FORMAT_JSON;
  else argp_error(state, "--%s: '%s' is unknown; expected %scsv or json", option, text, table_too ? "table, " : "");
}

static void read_integer(struct argp_state *state, const char *option, const char *text, int low, int high, int *out)
{
  if (number_read_integer(text, strlen(text), out) != NUMBER_FINE || *out < low || *out > high)
    argp_error(state, "--%s: '%s' is unknown; expected an integer %d..%d", option, text, low, high);
}

static error_t on_option(int key, char *arg, struct argp_state *state)
{
  cli_options *o = state->input;
  switch (key) {
  case CLI_SET:
    if (o->n_set == CLI_MAX_SET) argp_error(state, "--set may be given at most %d times", CLI_MAX_SET);
    o->set[o->n_set++] = arg;
    return 0;
  case CLI_FORMAT: read_format(state, "format", arg, true, &o->format); return 0;
  case 'o': o->output = arg; return 0;
  case 'q': o->quiet = true; return 0;
  case CLI_AT: read_list(state, "at", arg, &o->at); return 0;
  case CLI_HARMONICS: read_list(state, "harmonics", arg, &o->harmonics); return 0;
  case CLI_SAMPLES: read_list(state, "samples", arg, &o->samples); return 0;
  case CLI_MOTION: o->motion = arg; return 0;
  case CLI_JOBS: read_integer(state, "jobs", arg, 1, CLI_MAX_JOBS, &o->jobs); return 0;
  case CLI_REPEATS: read_integer(state, "repeats", arg, 1, CLI_MAX_REPEATS, &o->repeats); return 0;
  case CLI_SCENES: read_integer(state, "scenes", arg, 1, CLI_MAX_SCENES, &o->scenes); return 0;
  case CLI_SEED: read_integer(state, "seed", arg, 0, INT_MAX, &o->seed); return 0;
  case CLI_FIRST: read_integer(state, "first", arg, 0, CLI_MAX_SCENES, &o->first); return 0;
  case CLI_SECONDS:
    if (number_read(arg, strlen(arg), &o->seconds) != NUMBER_FINE || !(o->seconds > 0))
      argp_error(state, "--seconds: '%s' is unknown; expected a number > 0", arg);
    return 0;
  case CLI_CASE: o->one_case = true; return 0;
  case CLI_FINDINGS: o->findings = arg; return 0;
  case CLI_ALONE: o->alone = true; return 0;
  case CLI_JUNIT: o->junit = arg; return 0;
  case CLI_AGAINST: o->against = arg; return 0;
  case CLI_COLUMNS: o->curve_columns = arg; return 0;
  case CLI_QUANTITY: o->quantity = arg; return 0;
  case CLI_ALL: o->all = true; return 0;
  case CLI_PLOT:
    if (!plot_can(arg))
      argp_error(state, "--plot: '%s' has an unknown ending; expected a name ending in " PLOT_ENDINGS ", or -", arg);
    o->plot = arg;
    return 0;
  case CLI_PLOT_Y: o->plot_y = arg; return 0;
  case CLI_RESULTS: o->results = arg; return 0;
  case CLI_TABLES: o->tables = true; return 0;
  case CLI_FRESH: o->fresh = true; return 0;
  case CLI_TIMINGS: o->timings = true; return 0;
  case CLI_EXPORT:
    o->export = true;
    read_format(state, "export", arg, false, &o->export_format);
    return 0;
  case ARGP_KEY_ARG:
    if (o->n_arguments == (o->several ? CLI_MAX_ARGUMENTS : 1)) argp_error(state, "'%s' is one argument too many", arg);
    o->arguments[o->n_arguments++] = arg;
    if (!o->argument) o->argument = arg;
    return 0;
  default: return ARGP_ERR_UNKNOWN;
  }
}

void cli_parse(int argc, char **argv, const char *command, const char *args, const char *doc,
               const struct argp_option *own, bool needs_argument, cli_options *o)
{
  struct argp_option options[16] = {{0}};
  int n = 0;
  for (; own && (own[n].name || own[n].key); ++n) options[n] = own[n];
  memcpy(options + n, common_options, sizeof common_options);
  struct argp argp = {options, on_option, args, doc, NULL, NULL, NULL};
  char name[64];
  *o = (cli_options){.command = command, .seed = -1, .several = strstr(args, "...") != NULL};
  snprintf(name, sizeof name, "hbmcheck %s", command);
  argv[0] = name;
  argp_err_exit_status = EXIT_USAGE;
  error_t failed = argp_parse(&argp, argc, argv, 0, NULL, o); /* of what is left to us only ENOMEM: usage makes it
                                                                 exit */
  if (failed) {
    fprintf(stderr, "%s: %s\n", name, failed == ENOMEM ? hc_status_text(HC_NO_MEMORY) : strerror(failed));
    exit(failed == ENOMEM ? EXIT_NO_SOLUTION : EXIT_BUG);
  }
  argv[0] = (char *)"hbmcheck";
  if (needs_argument && !o->argument) {
    fprintf(stderr, "%s: no %s given\nTry 'hbmcheck %s --help'.\n", name, args, command);
    exit(EXIT_USAGE);
  }
  bool for_programs = (o->format != FORMAT_TABLE || o->export) && !o->output;
  if (o->plot && !strcmp(o->plot, "-") && for_programs) {
    fprintf(stderr, "%s: --plot - would mix a drawing into %s; give one of them a file\n", name,
            o->format == FORMAT_TABLE ? "the export" : "csv or json");
    exit(EXIT_USAGE);
  }
}

int cli_plotted(const cli_options *o, hc_status st, const char *why)
{
  if (st != HC_OK) cli_say(o, "no drawing: %s", why);
  return st == HC_OK ? 0 : EXIT_NO_SOLUTION;
}

void cli_say(const cli_options *o, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  fprintf(stderr, "hbmcheck %s: ", o->command);
  vfprintf(stderr, format, args);
  fputc('\n', stderr);
  va_end(args);
}

int cli_load_case(const cli_options *o, scene *sc)
{
  case_error err = {{0}};
  hc_status st = case_read(o->argument, o->n_set, o->set, sc, &err);
  if (st == HC_OK) return 0;
  fprintf(stderr, "%s\n", err.message[0] ? err.message : hc_status_text(st));
  return st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
}

/* What a person can try next. */
static const char *advice(hc_status st)
{
  switch (st) {
  case HC_STALLED:
  case HC_NOT_CONVERGED:
  case HC_SINGULAR:
  case HC_STEP_TOO_SMALL:
    return "try --set hbm.continuation=auto, --set hbm.force=exact, or a sweep from the other end";
  case HC_TOO_MANY_POINTS: return "try --set hbm.force=exact: false turning points come from too few samples";
  case HC_INTEGRATOR:
    return "try a larger --set transient.regularisation=... or a tighter --set transient.tolerance=...";
  case HC_NOT_SETTLED: return "try a larger --set transient.max_periods=... or --set transient.start=hbm";
  case HC_NOT_FINITE: return "the motion grew without bound: is the scene damped?";
  case HC_UNSUPPORTED: return "transient.law: exact and transient.steady_state: shooting are not there yet";
  default: return "see README.md, 'When it says no'";
  }
}

int cli_solver_failed(const cli_options *o, const char *solver, hc_status st, double omega)
{
  if (st == HC_INTERRUPTED) {
    cli_say(o, "%s: stopped on request; what was found is kept", solver);
    return EXIT_NO_SOLUTION;
  }
  if (st == HC_NO_MEMORY) {
    cli_say(o, "%s", hc_status_text(st));
    return EXIT_NO_SOLUTION;
  }
  if (omega > 0) cli_say(o, "%s stopped at omega = %.10g: %s; %s", solver, omega, hc_status_text(st), advice(st));
  else cli_say(o, "%s: %s; %s", solver, hc_status_text(st), advice(st));
  return EXIT_NO_SOLUTION;
}

const char *cli_hbm_settings(const scene *sc, int n_harm, int n_time, char *text, size_t size)
{
  char samples[48] = "exact forces";
  if (sc->hbm.force == HBM_FORCE_SAMPLED)
    snprintf(samples, sizeof samples, "%s%d samples", sc->hbm.samples == HBM_AUTO ? "auto, at most " : "", n_time);
  snprintf(text, size, "H = %s%d%s, %s", sc->hbm.harmonics == HBM_AUTO ? "auto, at most " : "", n_harm,
           sc->hbm.keep_mean ? "" : " WITHOUT harmonic 0", samples);
  return text;
}

void cli_put_row(table *t, rows_kind kind, const row_cell *cells)
{
  int n;
  rows_columns(kind, &n);
  for (int i = 0; i < n; ++i) {
    if (!cells[i].there) table_put_missing(t);
    else if (cells[i].kind == TABLE_TEXT) table_put_text(t, cells[i].as.text);
    else if (cells[i].kind == TABLE_INTEGER) table_put_integer(t, cells[i].as.integer);
    else table_put_real(t, cells[i].as.real);
  }
}

int cli_write(const cli_options *o, int n, table *const *tables)
{
  output *out = NULL;
  hc_status st = output_open(o->output, &out);
  if (st == HC_OK) {
    st = table_write(n, tables, o->format, output_stream(out));
    if (st == HC_OK) st = output_commit(out);
    else output_abandon(out);
  }
  if (st == HC_OK) return 0;
  cli_say(o, "%s: %s", o->output ? o->output : "standard output",
          st == HC_IO && errno ? strerror(errno) : hc_status_text(st));
  return st == HC_BUG ? EXIT_BUG : EXIT_NO_SOLUTION;
}
