/* cmd_gate.c - hbmcheck gate: the limits of case files held against what is found, for CI. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "command/cli.h"
#include "compare/gate/gate.h"
#include "output/output.h"
#include "output/progress.h"

static const char doc[] =
    "Compare harmonic balance with time integration on every CASE, and hold what is found against the limits under "
    "its gate: a table of what was "
    "allowed and what was found, and an exit code."
    "\vA stable HBM solution is held against the transient, an unstable one against the exact orbit next to it; and "
    "every transient must match some "
    "HBM solution. Limits: gate.amplitude, harmonic_1, mean, waveform; the same with range_ in front, in gate.ranges; "
    "gate.iterations and "
    "gate.evaluations of the response curve (hbmcheck describe gate).\n"
    "A number passes up to 1.000001 times its limit, so that rounding decides nothing. Every case is read before "
    "anything runs.\n"
    "exit: 0 all within  1 something is not  2 a case file is wrong  3 something could not be compared or written  64 "
    "usage\n"
    "example: hbmcheck gate cases/paper/case2.yaml --junit gate.xml";

static const struct argp_option options[] = {
    {"junit", CLI_JUNIT, "FILE", 0, "Also write every check as JUnit XML to FILE, whole or not at all", 1},
    {"all", CLI_ALL, NULL, 0, "Show every check in the table [the worst of each quantity, and all that do not pass]",
     1},
    {"at", CLI_AT, "LIST", 0, "Omegas, rad per unit time, for every case [each case's compare.omega or compare.points]",
     1},
    {0},
};

/* Limits and findings are numbers for machines; for people text, because costs and discrepancies stand in one
 * column. */
#define COLUMNS(number)                                                                                                \
  {"case", TABLE_TEXT}, {"omega", TABLE_REAL}, {"branch", TABLE_INTEGER}, {"verdict", TABLE_TEXT},                     \
      {"quantity", TABLE_TEXT}, {"against", TABLE_TEXT}, {"allowed", number}, {"found", number},                       \
      {"result", TABLE_TEXT},                                                                                          \
  {                                                                                                                    \
    "reason", TABLE_TEXT                                                                                               \
  }
static const table_column columns[] = {COLUMNS(TABLE_REAL)}, columns_for_people[] = {COLUMNS(TABLE_TEXT)};
enum { N_COLUMNS = sizeof columns / sizeof *columns };

typedef struct job {
  cli_options o;
  int n;         /* cases read */
  scene *scenes; /* [n_arguments] */
  gate_case *cases;
  output *junit; /* opened before anything runs: a wrong name is found at once */
} job;

/* 0 or the exit code. */
static int read_cases(job *j)
{
  for (int i = 0; i < j->o.n_arguments; ++i) {
    j->o.argument = j->o.arguments[i];
    int code = cli_load_case(&j->o, &j->scenes[i]);
    if (code) return code;
    if (j->o.at.n) j->scenes[i].compare.omega = j->o.at;
  }
  return 0;
}

static int junit_failed(const job *j, hc_status st)
{
  cli_say(&j->o, "%s: %s", j->o.junit, st == HC_IO && errno ? strerror(errno) : hc_status_text(st));
  return EXIT_NO_SOLUTION;
}

static int open_junit(job *j)
{
  if (!j->o.junit) return 0;
  if (j->o.output && !strcmp(j->o.junit, j->o.output)) {
    cli_say(&j->o, "--junit and --output name the same file, %s", j->o.junit);
    return EXIT_USAGE;
  }
  hc_status st = output_open(j->o.junit, &j->junit);
  return st == HC_OK ? 0 : junit_failed(j, st);
}

static int run_cases(job *j)
{
  for (; j->n < j->o.n_arguments; ++j->n) {
    progress *bar = progress_start(j->o.arguments[j->n], j->o.quiet);
    hc_monitor monitor = progress_monitor(bar);
    compare_setup setup;
    hc_status st = scene_setup(&j->scenes[j->n], &setup);
    if (st == HC_OK) st = gate_run(j->o.arguments[j->n], &setup, &monitor, &j->cases[j->n]);
    scene_setup_clear(&setup);
    progress_end(bar);
    if (st == HC_OK) continue;
    if (st == HC_INTERRUPTED) cli_say(&j->o, "stopped on request: nothing is written, half a gate is none");
    else cli_solver_failed(&j->o, j->o.arguments[j->n], st, 0);
    gate_clear(&j->cases[j->n]);
    return EXIT_NO_SOLUTION;
  }
  return 0;
}

/* ---- telling ---- */

static void put_number(table *t, double x, bool people)
{
  char text[NUMBER_TEXT];
  if (people) table_put_text(t, isnan(x) ? NULL : number_write(x, text));
  else table_put_real(t, x);
}

static void put_check(table *t, const gate_case *g, const gate_check *c, bool people)
{
  table_put_text(t, g->name);
  table_put_real(t, c->omega);
  if (c->branch >= 0) table_put_integer(t, c->branch);
  else table_put_missing(t);
  table_put_text(t, *c->verdict ? c->verdict : NULL);
  table_put_text(t, c->quantity);
  table_put_text(t, c->against);
  put_number(t, c->allowed, people);
  put_number(t, people ? gate_shown(c) : c->found, people);
  table_put_text(t, gate_result_name(c->result));
  table_put_text(t, *c->reason ? c->reason : NULL);
}

static table *checks_table(const job *j)
{
  const bool people = j->o.format == FORMAT_TABLE;
  table *t = table_new("Gate", N_COLUMNS, people ? columns_for_people : columns);
  for (int i = 0; i < j->n; ++i) {
    const gate_case *g = &j->cases[i];
    for (int k = 0; k < g->n; ++k)
      if (!people || j->o.all || g->checks[k].result != GATE_PASS || gate_is_worst(g, k))
        put_check(t, g, &g->checks[k], people);
    table_note(t, "%s: %d checks, %d passed, %d failed, %d could not be made", g->name, g->n,
               g->n - g->failures - g->errors, g->failures, g->errors);
  }
  return t;
}

static int write_junit(job *j)
{
  if (!j->junit) return 0;
  hc_status st = gate_write_junit(j->n, j->cases, output_stream(j->junit));
  if (st == HC_OK) st = output_commit(j->junit);
  else output_abandon(j->junit);
  j->junit = NULL;
  return st == HC_OK ? 0 : junit_failed(j, st);
}

/* Both are written, even if one of them fails. */
static int tell(job *j)
{
  table *t = checks_table(j);
  int shown = cli_write(&j->o, 1, &t), reported = write_junit(j), code = gate_exit_code(j->n, j->cases);
  table_free(t);
  return code ? code : shown ? shown : reported;
}

int cmd_gate(int argc, char **argv)
{
  job j = {.n = 0};
  cli_parse(argc, argv, "gate", "CASE...", doc, options, true, &j.o);
  j.scenes = calloc((size_t)j.o.n_arguments, sizeof *j.scenes);
  j.cases = calloc((size_t)j.o.n_arguments, sizeof *j.cases);
  int code = j.scenes && j.cases ? read_cases(&j) : cli_solver_failed(&j.o, "gate", HC_NO_MEMORY, 0);
  if (!code) code = open_junit(&j);
  if (!code) code = run_cases(&j);
  if (!code) code = tell(&j);
  output_abandon(j.junit);
  for (int i = 0; i < j.n; ++i) gate_clear(&j.cases[i]);
  free(j.cases);
  free(j.scenes);
  return code;
}
