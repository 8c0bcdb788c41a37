/* cmd_gate.c - hbmcheck gate: are the discrepancies of case files within the limits they set? For CI. */
#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "compare/duration.h"
#include "compare/gate/gate.h"
#include "compare/output/output.h"
#include "compare/output/progress.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/proofs.h"
#include "numerics/base/number.h"
#include "numerics/base/path.h"
#include "numerics/workers.h"

static const char help[] =
    "You want CI to fail where a result becomes wrong: compares harmonic balance with time integration on every CASE, "
    "and with the limits under its gate: a table of what was allowed and what was found, and an exit code."
    "\vA stable HBM solution is held against the transient, an unstable one against the exact orbit next to it; and "
    "every transient must match some HBM solution. Each response of a structure is held to the limits by itself. "
    "Limits: gate.amplitude, harmonic_1, mean, waveform; the same with range_ in front, in gate.ranges; "
    "gate.iterations and gate.evaluations of the response curve (hbmcheck describe gate).\n"
    "A number passes up to 1.000001 times its limit, so that rounding decides nothing. A case file that is wrong fails "
    "its own test, in the JUnit file, too; the others run.\n"
    "exit: 0 all within  1 something is not  2 a case file is wrong  3 something could not be compared or written  "
    "64 usage\n"
    "example: hbmcheck gate cases/paper/case2.yaml --junit gate.xml";

typedef struct gate_options {
  number_list at;    /* n = 0: each case's */
  const char *junit; /* NULL: not written */
  bool all;          /* --all */
  int jobs;          /* 0: not given */
} gate_options;

static const cli_option options[] = {
    {CLI_TEXT, "junit", "FILE", "Also write every check as JUnit XML to FILE, whole or not at all",
     offsetof(gate_options, junit), .file = "--junit", .use = CLI_OUTPUT},
    {CLI_FLAG, "all", NULL, "Show every check in the table [the worst of each quantity, and all that do not pass]",
     offsetof(gate_options, all)},
    {CLI_LIST, "at", "LIST",
     "At these " CLI_FREQUENCIES ", in every case [each case's compare.omega or compare.points]",
     offsetof(gate_options, at)},
    {CLI_INTEGER, "jobs", "N", "Cases judged at a time [1]", offsetof(gate_options, jobs), 1, CLI_MAX_JOBS,
     .letter = 'j'},
    {0},
};

/* allowed and found are texts on the screen, where a column of numbers has one notation; else numbers. */
/* clang-format off */
#define COLUMNS(number) \
  TEXT("case"), REAL("omega"), REAL("frequency"), INTEGER("branch"), TEXT("response"), TEXT("verdict"), \
  TEXT("quantity"), TEXT("against"), number("allowed"), number("found"), TEXT("result"), TEXT("reason")
/* clang-format on */
static const table_column columns[] = {COLUMNS(REAL)}, columns_for_people[] = {COLUMNS(TEXT)};
static const char *const spare_columns[] = {"against", "verdict", "allowed", "branch", "case", NULL};

typedef struct read_case {
  scene sc;
  char (*responses)[RESPONSE_NAME]; /* their names, of a structure */
  case_error error;                 /* what is wrong with the case file, or empty */
  int no_checker;                   /* errno where hbmcheck-proof was asked for and could not be asked */
} read_case;

typedef struct gate_call {
  cli_common *common;
  const gate_options *own;
  read_case *of;    /* [n_arguments] */
  gate_case *cases; /* [n_arguments] */
  unsigned extra;   /* columns that one of them has */
  bool short_names; /* their names differ without their folders, too: so they stand on the screen */
  output *junit;    /* opened before anything runs: a name that cannot be written to is found at once */
} gate_call;

/* Every case; what is wrong in one is said, and *wrong counts them. 0, or the exit code after the message. */
static int read_cases(gate_call *call, int *wrong)
{
  for (int i = 0; i < call->common->n_arguments; ++i) {
    read_case *of = &call->of[i];
    const char *name = call->common->arguments[i];
    const int code = cli_load_case(call->common, name, &of->sc, &of->error);
    if (code == EXIT_NO_SOLUTION) return code;
    if (!code && !cli_frequencies_fit(call->common, &call->own->at, true, &of->sc, of->error.message))
      cli_message(call->common, "%s: %s", name, of->error.message);
    else if (!code) call->extra |= cli_extra_columns(&of->sc);
    if (!*of->error.message) continue;
    call->cases[i] = gate_of_wrong_case(name, of->error.message);
    ++*wrong;
  }
  return 0;
}

/* For all cases together. */
static void foretell_time(const gate_call *call)
{
  double seconds = 0;
  int frequencies = 0;
  for (int i = 0; i < call->common->n_arguments && cli_foretells(call->common); ++i) {
    duration_units u;
    compare_setup setup;
    if (call->cases[i].wrong) continue;
    if (scene_setup(&call->of[i].sc, &setup) == HC_OK) {
      duration_measure(&setup, &u);
      const int n = duration_frequencies(&setup);
      seconds += duration_of_comparison(&u, n);
      frequencies += n;
    }
    scene_setup_clear(&setup);
  }
  cli_foretell_time(call->common, seconds, frequencies, NULL);
}

/* For gate.proven. */
static hc_status judge_proofs(read_case *of, const compare_setup *setup, const hc_monitor *monitor, gate_case *g)
{
  proofs p;
  hc_status st = prove_run(&of->sc, setup, monitor, NULL, NULL, &p);
  if (st == HC_IO) of->no_checker = errno;
  for (int i = 0; i < p.n && st == HC_OK; ++i) {
    const proof_row *r = &p.rows[i];
    const double most = fmax(fabs(r->error.low), fabs(r->error.high)) / r->amplitude.low;
    st = gate_add_proof(g, setup, r->omega, r->branch, r->proven ? NULL : proof_reasons[r->reason].words, most);
  }
  proofs_clear(&p);
  return st;
}

static hc_status judge_case(void *self, int i, const hc_monitor *monitor)
{
  gate_call *call = self;
  gate_case *g = &call->cases[i];
  read_case *of = &call->of[i];
  compare_setup setup;
  if (g->wrong) return HC_OK;
  hc_status st = scene_setup(&of->sc, &setup);
  if (st == HC_OK) st = gate_run(call->common->arguments[i], &setup, monitor, g);
  if (st == HC_OK && of->sc.gate.proven) st = judge_proofs(of, &setup, monitor, g);
  if (st == HC_OK) st = cli_response_names(&of->sc, &of->responses);
  g->responses = (const char(*)[RESPONSE_NAME])of->responses;
  scene_setup_clear(&setup);
  return st;
}

static int judge_cases(gate_call *call)
{
  const cli_common *common = call->common;
  const char *name = common->n_arguments == 1 ? common->arguments[0] : "gate";
  foretell_time(call);
  progress *bar = cli_progress(common, name);
  hc_monitor monitor = progress_monitor(bar);
  const hc_status st = workers_run(call->own->jobs, common->n_arguments, judge_case, call, &monitor);
  progress_end(bar);
  cli_ended(common, st);
  if (st == HC_OK) return 0;
  int error = 0;
  for (int i = 0; i < common->n_arguments && !error; ++i) error = call->of[i].no_checker;
  if (st == HC_IO) return proofs_ended(common, HC_OK, st, error);
  if (st == HC_INTERRUPTED) cli_message(common, "stopped on request: nothing is written, half a gate is none");
  else cli_solver_failed(common, CLI_BOTH, name, st, 0);
  return EXIT_NO_SOLUTION;
}

/* ---- results ---- */

static table_value number_cell(bool people, double x, char text[NUMBER_TEXT])
{
  if (!people) return CELL(x);
  return CELL_IF(!isnan(x), number_write(x, text));
}

static table *checks_table(gate_call *call)
{
  const bool people = call->common->format == FORMAT_TABLE;
  const int n = call->common->n_arguments;
  table *t = people ? cli_own_table("Gate", call->extra, CLI_COLUMNS(columns_for_people))
                    : cli_own_table("Gate", call->extra, CLI_COLUMNS(columns));
  table_wrap(t, cli_width(call->common)); /* the reasons are sentences */
  table_spare(t, spare_columns);
  if (n == 1 && !call->common->wide) table_hide(t, "case"); /* the remark below has it */
  call->short_names = !call->common->wide;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < i; ++k)
      call->short_names &=
          strcmp(path_name(call->common->arguments[i], NULL), path_name(call->common->arguments[k], NULL)) != 0;
  for (int i = 0; i < n; ++i) {
    const gate_case *g = &call->cases[i];
    for (int k = 0; k < g->n; ++k) {
      const gate_check *c = &g->checks[k];
      const bool wants_attention = c->result == GATE_FAIL || c->result == GATE_ERROR;
      if (!people || call->own->all || wants_attention || gate_is_worst(g, k)) {
        const scene *sc = &call->of[i].sc;
        char allowed[NUMBER_TEXT], found[NUMBER_TEXT];
        TABLE_ROW(t, CELL(people && call->short_names ? path_name(g->name, NULL) : g->name), CELL(c->omega),
                  CELL_OF(call->extra & ROWS_IN_CYCLES, sc->in_cycles ? scene_frequency(sc, c->omega) : NAN),
                  CELL_IF(c->branch >= 0, c->branch), CELL_OF(call->extra & ROWS_RESPONSES, gate_response(g, c)),
                  CELL_IF(*c->verdict, c->verdict), CELL(c->quantity), CELL(c->against),
                  number_cell(people, c->allowed, allowed),
                  number_cell(people, people ? gate_shown(c) : c->found, found), CELL(gate_result_name(c->result)),
                  CELL_IF(*c->reason, c->reason));
      }
    }
    if (g->wrong) table_note(t, "%s: not judged, the case file is wrong", g->name);
    else
      table_note(t, "%s: %d checks, %d passed, %d failed, %d could not be made, %d not applicable", g->name, g->n,
                 g->n - g->failures - g->errors - g->not_applicable, g->failures, g->errors, g->not_applicable);
    if (g->linear) table_note(t, "%s: " COMPARISON_LINEAR, g->name, g->n_rows);
  }
  return t;
}

/* The cases read, judged, and told in the table and in JUnit. Returns the exit code. */
static int read_and_judge(gate_call *call)
{
  const int n = call->common->n_arguments;
  const char *junit = call->own->junit;
  int wrong = 0, code = read_cases(call, &wrong), reported = 0;
  hc_status st = !code && junit ? output_open(junit, &call->junit) : HC_OK;
  if (st != HC_OK) code = cli_file_failed(call->common, junit, st);
  if (st != HC_OK && wrong) code = EXIT_BAD_CASE;
  if (!code) code = judge_cases(call);
  if (code) return code;
  table *t = checks_table(call); /* each is written even if the other one fails */
  const int shown = cli_write_all(call->common, 1, &t);
  if (call->junit) st = output_finish(call->junit, gate_write_junit(n, call->cases, output_stream(call->junit)));
  if (st != HC_OK) reported = cli_file_failed(call->common, junit, st);
  call->junit = NULL;
  if (wrong) return EXIT_BAD_CASE;
  if ((code = gate_exit_code(n, call->cases)) != 0) return code;
  return shown ? shown : reported;
}

static int run_gate(cli_common *common, void *own, scene *sc)
{
  const size_t n = (size_t)common->n_arguments;
  gate_call call = {common, own};
  (void)sc;
  call.of = calloc(n, sizeof *call.of);
  call.cases = calloc(n, sizeof *call.cases);
  const int code =
      call.of && call.cases ? read_and_judge(&call) : cli_solver_failed(common, CLI_BOTH, "gate", HC_NO_MEMORY, 0);
  output_abandon(call.junit);
  for (size_t i = 0; call.cases && i < n; ++i) gate_clear(&call.cases[i]);
  free(call.cases);
  for (size_t i = 0; call.of && i < n; ++i) {
    free(call.of[i].responses);
    case_clear(&call.of[i].sc);
  }
  free(call.of);
  return code;
}

CLI_COMMAND(gate, gate_options, "CASE...",
            "the accuracy gate for CI: case files with limits, a table of verdicts, JUnit, an exit code");
