/* cmd_gate.c - hbmcheck gate: are the discrepancies of case files within the limits they set? For CI. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "command/commands.h"
#include "compare/gate/gate.h"
#include "output/output.h"
#include "output/progress.h"

static const char help[] =
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

typedef struct gate_options {
  number_list at;    /* n = 0: each case's */
  const char *junit; /* NULL: not written */
  bool all;          /* --all */
} gate_options;

enum { KEY_JUNIT = CLI_OWN_KEY, KEY_ALL, KEY_AT };

static const struct argp_option options[] = {
    {"junit", KEY_JUNIT, "FILE", 0, "Also write every check as JUnit XML to FILE, whole or not at all", 1},
    {"all", KEY_ALL, NULL, 0, "Show every check in the table [the worst of each quantity, and all that do not pass]",
     1},
    {"at", KEY_AT, "LIST", 0, "Omegas, rad per unit time, for every case [each case's compare.omega or compare.points]",
     1},
    {0},
};

static error_t read_option(int key, char *text, struct argp_state *state)
{
  gate_options *own = state->input;
  switch (key) {
  case KEY_AT: cli_read_list(state, "at", text, &own->at); return 0;
  case KEY_JUNIT: own->junit = text; return 0;
  case KEY_ALL: own->all = true; return 0;
  default: return ARGP_ERR_UNKNOWN;
  }
}

/* allowed and found: numbers in csv and json; on the screen texts, because a column of numbers has one notation and
 * these range from discrepancies to costs. */
/* clang-format off */
#define COLUMNS(number) \
  {"case", TABLE_TEXT}, {"omega", TABLE_REAL}, {"branch", TABLE_INTEGER}, {"verdict", TABLE_TEXT}, \
  {"quantity", TABLE_TEXT}, {"against", TABLE_TEXT}, {"allowed", number}, {"found", number}, \
  {"result", TABLE_TEXT}, {"reason", TABLE_TEXT}
/* clang-format on */
static const table_column columns[] = {COLUMNS(TABLE_REAL)}, columns_for_people[] = {COLUMNS(TABLE_TEXT)};
enum { N_COLUMNS = sizeof columns / sizeof *columns };

/* One call of the command. */
typedef struct gate_call {
  cli_common common;
  gate_options own;
  scene *scenes;    /* [n_arguments] */
  gate_case *cases; /* [n_arguments], of which n_judged are filled */
  int n_judged;
  output *junit; /* opened before anything runs: a name that cannot be written to is found at once */
} gate_call;

/* 0 or the exit code after the message. */
static int read_cases(gate_call *call)
{
  for (int i = 0; i < call->common.n_arguments; ++i) {
    int code = cli_load_case(&call->common, call->common.arguments[i], &call->scenes[i]);
    if (code) return code;
    if (call->own.at.n) call->scenes[i].compare.omega = call->own.at;
  }
  return 0;
}

static int open_junit(gate_call *call)
{
  if (!call->own.junit) return 0;
  if (call->common.output && !strcmp(call->own.junit, call->common.output)) {
    cli_message(&call->common, "--junit and --output name the same file, %s", call->own.junit);
    return EXIT_USAGE;
  }
  hc_status st = output_open(call->own.junit, &call->junit);
  return st == HC_OK ? 0 : cli_file_failed(&call->common, call->own.junit, st);
}

static int judge_cases(gate_call *call)
{
  for (; call->n_judged < call->common.n_arguments; ++call->n_judged) {
    progress *bar = progress_start(call->common.arguments[call->n_judged], call->common.quiet);
    hc_monitor monitor = progress_monitor(bar);
    compare_setup setup;
    hc_status st = scene_setup(&call->scenes[call->n_judged], &setup);
    if (st == HC_OK)
      st = gate_run(call->common.arguments[call->n_judged], &setup, &monitor, &call->cases[call->n_judged]);
    scene_setup_clear(&setup);
    progress_end(bar);
    if (st == HC_OK) continue;
    if (st == HC_INTERRUPTED) cli_message(&call->common, "stopped on request: nothing is written, half a gate is none");
    else cli_solver_failed(&call->common, CLI_BOTH, call->common.arguments[call->n_judged], st, 0);
    gate_clear(&call->cases[call->n_judged]);
    return EXIT_NO_SOLUTION;
  }
  return 0;
}

/* ---- results ---- */

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

static table *checks_table(const gate_call *call)
{
  const bool people = call->common.format == FORMAT_TABLE;
  table *t = table_new("Gate", N_COLUMNS, people ? columns_for_people : columns);
  for (int i = 0; i < call->n_judged; ++i) {
    const gate_case *g = &call->cases[i];
    for (int k = 0; k < g->n; ++k)
      if (!people || call->own.all || g->checks[k].result != GATE_PASS || gate_is_worst(g, k))
        put_check(t, g, &g->checks[k], people);
    table_note(t, "%s: %d checks, %d passed, %d failed, %d could not be made", g->name, g->n,
               g->n - g->failures - g->errors, g->failures, g->errors);
  }
  return t;
}

static int write_junit(gate_call *call)
{
  if (!call->junit) return 0;
  hc_status st = gate_write_junit(call->n_judged, call->cases, output_stream(call->junit));
  if (st == HC_OK) st = output_commit(call->junit);
  else output_abandon(call->junit);
  call->junit = NULL;
  return st == HC_OK ? 0 : cli_file_failed(&call->common, call->own.junit, st);
}

/* The table and the JUnit file: each is written even if the other one fails. */
static int write_results(gate_call *call)
{
  table *t = checks_table(call);
  int shown = cli_write(&call->common, 1, &t), reported = write_junit(call),
      code = gate_exit_code(call->n_judged, call->cases);
  table_free(t);
  return code ? code : shown ? shown : reported;
}

static int run_gate(int argc, char **argv)
{
  gate_call call = {.n_judged = 0};
  cli_parse(&cmd_gate, argc, argv, &call.own, &call.common);
  call.scenes = calloc((size_t)call.common.n_arguments, sizeof *call.scenes);
  call.cases = calloc((size_t)call.common.n_arguments, sizeof *call.cases);
  int code = call.scenes && call.cases ? read_cases(&call)
                                       : cli_solver_failed(&call.common, CLI_BOTH, "gate", HC_NO_MEMORY, 0);
  if (!code) code = open_junit(&call);
  if (!code) code = judge_cases(&call);
  if (!code) code = write_results(&call);
  output_abandon(call.junit);
  for (int i = 0; i < call.n_judged; ++i) gate_clear(&call.cases[i]);
  free(call.cases);
  free(call.scenes);
  return code;
}

const cli_command cmd_gate = {
    .name = "gate",
    .summary = "the accuracy gate for CI: case files with limits, a table of verdicts, JUnit, an exit code",
    .arguments = "CASE...",
    .help = help,
    .options = options,
    .read_option = read_option,
    .run = run_gate,
};
