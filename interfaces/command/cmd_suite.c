/* cmd_suite.c - hbmcheck suite: how many digits of the published cases a program has, and why not more. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compare/gate/gate.h"
#include "compare/output/output.h"
#include "compare/output/progress.h"
#include "compare/verify/verify.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/report/scores.h"
#include "numerics/base/number.h"
#include "numerics/base/thread_clock.h"

static const char help[] =
    "Score a program's results on the published cases of SUITE, whose references are proven: digits of amplitude, mean "
    "and harmonic 1, and what is wrong where they are missing. Without --results hbmcheck's own, exact and sampled."
    "\vResults: a folder with NAME.csv for each case, or one json; SUITE/README.md has the format. "
    "With -o FILE.html a page is written, and the table goes to standard output.\n"
    "exit: 0 every case passes  1 one does not  2 a file is wrong (the others are scored)  3 could not  64 usage\n"
    "example: hbmcheck suite --results mine -o score.html";

enum { PATH_ROOM = 4096, PROGRAMS = 2, CASE_PATIENCE = 8 /* [s] */, MOST_CAUSES = 64 };

typedef struct suite_options {
  const char *results, *program, *badge, *junit, *write; /* NULL: not given */
  double digits, patience;
  bool all;
} suite_options;
static const suite_options defaults = {.digits = 3, .patience = 60};

static const cli_option options[] = {
    {CLI_TEXT, "results", "PATH", "A program's results: a folder of csv files, or a json file",
     offsetof(suite_options, results)},
    {CLI_TEXT, "program", "TEXT", "What the program is called, with version and settings [its results' path]",
     offsetof(suite_options, program)},
    {CLI_POSITIVE, "digits", "D", "A case passes with so many digits in every quantity of every solution [3]",
     offsetof(suite_options, digits)},
    {CLI_POSITIVE, "patience", "SECONDS", "Processor time of the search for what is wrong, all cases together [60]",
     offsetof(suite_options, patience)},
    {CLI_FLAG, "all", NULL, "Cases without results, too; a second table: every quantity of every solution",
     offsetof(suite_options, all)},
    {CLI_TEXT, "badge", "FILE", "Also write the score as a picture (SVG)", offsetof(suite_options, badge),
     .file = "--badge", .use = CLI_OUTPUT},
    {CLI_TEXT, "junit", "FILE", "Also write each case as JUnit XML", offsetof(suite_options, junit), .file = "--junit",
     .use = CLI_OUTPUT},
    {CLI_TEXT, "write-results", "FILE", "Without --results: our own, exact, as results are to be written (json)",
     offsetof(suite_options, write), .file = "--write-results", .use = CLI_OUTPUT},
    {0},
};

static const table_column columns[] = {TEXT("case"),        TEXT("program"), INTEGER("solutions"), INTEGER("missing"),
                                       INTEGER("extra"),    REAL("digits"),  TEXT("quantity"),     REAL("omega"),
                                       REAL("mean_digits"), REAL("score"),   TEXT("result"),       TEXT("cause")};
static const table_column quantity_columns[] = {
    TEXT("case"),     TEXT("program"), REAL("omega"), INTEGER("solution"), TEXT("stability"), TEXT("kind"),
    TEXT("quantity"), REAL("value"),   REAL("low"),   REAL("high"),        REAL("digits")};
static const char *const spare_columns[] = {"extra", "mean_digits", "solutions", "omega", "quantity", NULL};

typedef struct suite_call {
  cli_common *common;
  const suite_options *own;
  const char *folder;
  suite suite;
  int n_programs;
  scores programs[PROGRAMS];
  int refused;          /* files */
  char why[SUITE_TEXT]; /* the likeliest cause of all cases */
  char words[SUITE_TEXT];
} suite_call;

/* The suite's folder: the one named, ./suite, or as installed. */
static const char *folder_of(const cli_common *common)
{
  if (common->n_arguments) return common->arguments[0];
  return access("compare/suite/suite.json", R_OK) == 0 ? "compare/suite" : HBMCHECK_SUITE;
}

/* What a solver makes of case i, as a scene. */
static int load_case(suite_call *call, int i, scene *sc, compare_setup *setup)
{
  char path[PATH_ROOM + 128];
  snprintf(path, sizeof path, "%s/cases/%s.yaml", call->folder, call->suite.cases[i].name);
  int code = cli_load_case(call->common, path, sc, &(case_error){{0}});
  if (!code && scene_setup(sc, setup) != HC_OK) code = EXIT_NO_SOLUTION;
  return code;
}

/* Our own solutions, exact and sampled. A solution that fails is missing. 0 or the exit code. */
static int solve_all(suite_call *call)
{
  static const hbm_force forces[PROGRAMS] = {HBM_FORCE_EXACT, HBM_FORCE_SAMPLED};
  progress *bar = progress_start("suite", call->common->quiet);
  hc_monitor monitor = progress_monitor(bar);
  int code = 0;
  for (int i = 0; i < call->suite.n && !code; ++i) {
    scene sc = {.structure = NULL};
    compare_setup setup = {0};
    code = load_case(call, i, &sc, &setup);
    for (int p = 0; p < call->n_programs && !code; ++p) {
      const hc_status st = suite_solve(&setup, &call->suite.cases[i], forces[p],
                                       &(hc_monitor){hc_monitor_tick_aside, &monitor}, &call->programs[p].answers[i]);
      if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) code = cli_solver_failed(call->common, CLI_HBM, "suite", st, 0);
    }
    hc_monitor_tick(&monitor, (i + 1.0) / call->suite.n);
    scene_setup_clear(&setup);
    case_clear(&sc);
    call->common->scene = NULL;
  }
  progress_end(bar);
  return code;
}

/* ---- what is wrong ---- */

/* The rows near the case's frequencies as a curve of amplitude, or of harmonic 1. */
static hc_status curve_of(const suite_case *c, const suite_answer *a, const char *quantity, verify_data *data)
{
  *data = (verify_data){.points = calloc((size_t)a->n + 1, sizeof *data->points)};
  if (!data->points) return HC_NO_MEMORY;
  verify_quantity_read(quantity, strlen(quantity), &data->quantity);
  for (int k = 0; k < a->n; ++k) {
    const suite_row *r = &a->rows[k];
    const double harmonic = hypot(r->value[SUITE_A1], r->value[SUITE_B1]);
    const double value = data->quantity.kind == KIND_AMPLITUDE ? r->value[SUITE_AMPLITUDE] : harmonic;
    if (r->omega >= 0.9 * c->references[0].omega && r->omega <= 1.1 * c->references[c->n - 1].omega && value >= 0)
      data->points[data->n++] = (verify_point){r->omega, value, r->line};
  }
  return HC_OK;
}

/* What verify says of them, its gate a digit more than asked for; a guess where neither curve tells the cause. */
static int ask_verify(suite_call *call, scores *p, int i, double patience, const hc_monitor *monitor)
{
  static const char *const quantities[] = {"amplitude", "harmonic_1"};
  scene sc = {.structure = NULL};
  compare_setup setup = {0};
  char text[VERIFY_TEXT];
  int code = load_case(call, i, &sc, &setup);
  hc_status st = code ? HC_BAD_INPUT : HC_OK;
  bool sure = false;
  sc.gate.most.amplitude = sc.gate.most.harmonic_1 = pow(10, -p->digits - 1); /* setup.limits is sc.gate */
  for (int k = 0; k < 2 && st == HC_OK && !sure; ++k) {
    verify_data data = {0};
    verify_report report = {0};
    st = curve_of(&call->suite.cases[i], &p->answers[i], quantities[k], &data);
    if (st == HC_OK && data.n)
      st = verify_run(&setup, 1, &data, &(verify_effort){.patience = patience}, monitor, &report);
    sure = st == HC_OK && report.causes;
    if (sure) suite_say(p->causes[i], "%s", verify_word(&report, text));
    else if (st == HC_OK && report.nearest_guess && !*p->causes[i])
      suite_say(p->causes[i], "%s?", verify_cause_words(report.nearest_guess, text));
    verify_clear(&report);
    verify_data_clear(&data);
  }
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) code = cli_solver_failed(call->common, CLI_BOTH, "suite", st, 0);
  scene_setup_clear(&setup);
  case_clear(&sc);
  call->common->scene = NULL;
  return code;
}

/* How much the cause, "a+b?", speaks for the word: a guess less than what is sure. */
static int votes(const char *cause, const char *word, size_t length)
{
  for (const char *at = cause; *at; at += strcspn(at, "+"), at += *at == '+')
    if (strcspn(at, "+?") == length && !memcmp(at, word, length)) return strchr(cause, '?') ? 1 : 4;
  return 0;
}

/* The word that most cases speak for. */
static void count_causes(suite_call *call, const scores *p)
{
  int most = 0, told = 0;
  for (int i = 0; i < call->suite.n; ++i) {
    told += *p->causes[i] != '\0';
    for (const char *at = p->causes[i]; *at; at += strcspn(at, "+"), at += *at == '+') {
      const size_t length = strcspn(at, "+?");
      int n = 0, sum = 0;
      for (int k = 0; k < call->suite.n; ++k) {
        const int of_case = votes(p->causes[k], at, length);
        n += of_case > 0, sum += of_case;
      }
      if (sum > most) most = sum, suite_say(call->why, "what is wrong: %.*s (%d", (int)length, at, n);
    }
  }
  const size_t used = strlen(call->why);
  if (most) snprintf(call->why + used, sizeof call->why - used, " of the %d cases with a cause)", told);
}

/* Cases that do not pass, until the patience ends. */
static int diagnose(suite_call *call, scores *p)
{
  double left = call->own->patience;
  int code = 0;
  progress *bar = progress_start("what is wrong", call->common->quiet);
  hc_monitor monitor = progress_monitor(bar);
  for (int i = 0; i < call->suite.n && !code; ++i) {
    const suite_score *s = &p->scores[i];
    const suite_answer *a = &p->answers[i];
    if (s->digits >= p->digits || !a->n || *a->wrong) continue;
    suite_tell(&call->suite.cases[i], s, p->digits, p->causes[i]);
    if (*p->causes[i] || left <= 0) continue;
    const double began = thread_seconds();
    code = ask_verify(call, p, i, fmin(left, CASE_PATIENCE), &(hc_monitor){hc_monitor_tick_aside, &monitor});
    left -= thread_seconds() - began;
  }
  progress_end(bar);
  count_causes(call, p);
  return code;
}

/* ---- results ---- */

static double shown(const suite_call *call, double x)
{
  return call->common->format == FORMAT_TABLE ? round(10 * x) / 10 : x;
}

static void put_case(suite_call *call, const scores *p, int i, table *t, table *details)
{
  static const char *const stabilities[] = {"unstable", "unproven", "stable"};
  const suite_case *c = &call->suite.cases[i];
  const suite_score *s = &p->scores[i];
  const suite_answer *a = &p->answers[i];
  if (!a->there && !call->own->all && call->common->format == FORMAT_TABLE) return;
  const char *result = *a->wrong ? "refused" : !a->there ? "no results" : s->digits >= p->digits ? "pass" : "fail";
  TABLE_ROW(t, CELL(c->name), CELL(p->program), CELL(c->n), CELL(s->missing), CELL(s->extra),
            CELL(shown(call, s->digits)), CELL(suite_quantity[s->quantity]), CELL(c->references[s->worst].omega),
            CELL(shown(call, s->mean)), CELL(shown(call, 100 * s->points)), CELL(result),
            CELL_IF(*p->causes[i], (const char *)p->causes[i]));
  for (int k = 0; k < c->n && s->matches; ++k)
    for (int q = 0; q < SUITE_N; ++q) {
      const suite_reference *r = &c->references[k];
      const suite_match *m = &s->matches[k];
      if (isnan(m->digits[q])) continue;
      TABLE_ROW(details, CELL(c->name), CELL(p->program), CELL(r->omega), CELL(k), CELL(stabilities[r->stability + 1]),
                CELL(r->proven ? "proven" : "stated"), CELL(suite_quantity[q]), CELL(m->row ? m->row->value[q] : NAN),
                CELL(r->low[q]), CELL(r->high[q]), CELL(shown(call, m->digits[q])));
    }
  if (*a->note) table_note(t, "%s", a->note);
  if (*a->wrong) table_note(t, "refused: %s", a->wrong);
}

static int write_tables(suite_call *call)
{
  table *t = cli_own_table("Suite", 0, CLI_COLUMNS(columns));
  table *details = cli_own_table("Quantities", 0, CLI_COLUMNS(quantity_columns));
  for (int i = 0; i < call->suite.n; ++i)
    for (int p = 0; p < call->n_programs; ++p) put_case(call, &call->programs[p], i, t, details);
  for (int k = 0; k < call->n_programs; ++k) {
    const scores *p = &call->programs[k];
    int missing = 0;
    for (int i = 0; i < call->suite.n; ++i) missing += !p->answers[i].there;
    if (missing && missing < call->suite.n)
      table_note(t, "%d cases without results count as 0; the score of the others is %.1f", missing,
                 p->total * call->suite.n / (call->suite.n - missing));
    table_note(t, "%s: score %.1f of 100, %d of %d cases with %g digits everywhere; suite %s", p->program, p->total,
               p->passed, call->suite.n, p->digits, call->suite.version);
  }
  if (*call->why) table_note(t, "%s", call->why);
  if (*call->words) table_note(t, "%s", call->words);
  table_spare(t, spare_columns);
  const int code = cli_write(call->common, call->own->all ? 2 : 1, (table *[]){t, details});
  table_free(t);
  table_free(details);
  return code;
}

/* Each case of each program as a check of its fewest digits, in the words of the gate. */
static hc_status write_junit(const suite_call *call, FILE *to)
{
  hc_status st = HC_OK;
  gate_case *cases = calloc(PROGRAMS, sizeof *cases);
  for (int p = 0; p < call->n_programs && cases; ++p) {
    const scores *of = &call->programs[p];
    gate_case *g = &cases[p];
    g->name = of->program;
    g->checks = calloc((size_t)call->suite.n, sizeof *g->checks);
    if (!g->checks) st = HC_NO_MEMORY;
    for (int i = 0; i < call->suite.n && st == HC_OK; ++i) {
      const suite_score *s = &of->scores[i];
      gate_check *c = &g->checks[g->n++];
      *c = (gate_check){.omega = NAN,
                        .branch = -1,
                        .response = -1,
                        .quantity = call->suite.cases[i].name,
                        .against = "limit",
                        .allowed = of->digits,
                        .found = s->digits,
                        .result = GATE_PASS};
      if (s->digits >= of->digits) continue;
      c->result = GATE_FAIL;
      ++g->failures;
      snprintf(c->reason, sizeof c->reason, "%.1f digits of %s at omega %.6g, %g expected; %.80s", s->digits,
               suite_quantity[s->quantity], call->suite.cases[i].references[s->worst].omega, of->digits,
               *of->answers[i].wrong ? of->answers[i].wrong : of->causes[i]);
    }
  }
  if (!cases) st = HC_NO_MEMORY;
  if (st == HC_OK) st = gate_write_junit(call->n_programs, cases, to);
  for (int p = 0; p < call->n_programs && cases; ++p) gate_clear(&cases[p]);
  free(cases);
  return st;
}

/* Our own rows in the format of results. */
static hc_status write_results(const suite_call *call, FILE *to)
{
  const scores *p = call->programs;
  char number[NUMBER_TEXT];
  fprintf(to, "{\"program\": \"hbmcheck %s, exact forces\", \"suite\": \"%s\",\n \"cases\": {", HBMCHECK_VERSION,
          call->suite.version);
  for (int i = 0; i < call->suite.n; ++i) {
    fprintf(to, "%s\n  \"%s\": [", i ? "," : "", call->suite.cases[i].name);
    for (int k = 0; k < p->answers[i].n; ++k) {
      const suite_row *r = &p->answers[i].rows[k];
      fprintf(to, "%s\n    {\"omega\": %s", k ? "," : "", number_write(r->omega, number));
      for (int q = 0; q < SUITE_N; ++q)
        fprintf(to, ", \"%s\": %s", suite_quantity[q], number_write(r->value[q], number));
      putc('}', to);
    }
    putc(']', to);
  }
  fputs("}}\n", to);
  return ferror(to) ? HC_IO : HC_OK;
}

static hc_status write_page(const suite_call *call, FILE *to)
{
  return scores_page(&call->suite, call->n_programs, call->programs, call->why, to);
}

static hc_status write_badge(const suite_call *call, FILE *to)
{
  return scores_badge(&call->suite, call->programs, to);
}

/* 0 or the exit code after the message. */
static int write_file(const suite_call *call, const char *path, hc_status (*write)(const suite_call *, FILE *))
{
  output *out = NULL;
  if (!path) return 0;
  hc_status st = output_open(path, &out);
  if (st == HC_OK) st = output_finish(out, write(call, output_stream(out)));
  return st == HC_OK ? 0 : cli_file_failed(call->common, path, st);
}

static int judge(suite_call *call, scores *p)
{
  for (int i = 0; i < call->suite.n; ++i) {
    suite_score *s = &p->scores[i];
    if (suite_judge(&call->suite.cases[i], &p->answers[i], s) != HC_OK)
      return cli_solver_failed(call->common, CLI_BOTH, "suite", HC_NO_MEMORY, 0);
    p->total += 100 * s->points / call->suite.n;
    p->passed += s->digits >= p->digits;
    call->refused += *p->answers[i].wrong != '\0';
    if (*p->answers[i].wrong) cli_message(call->common, "refused: %s", p->answers[i].wrong);
  }
  return 0;
}

static int read_and_score(suite_call *call)
{
  const suite_options *own = call->own;
  char why[SUITE_TEXT] = "out of memory";
  int strange = 0, code = 0;
  hc_status st = suite_read(call->folder, &call->suite, why);
  if (st != HC_OK) return cli_failed(call->common, st == HC_BAD_INPUT ? EXIT_BAD_CASE : EXIT_NO_SOLUTION, "%s", why);
  const size_t n = (size_t)call->suite.n;
  static const char *const ours[PROGRAMS] = {"exact", "sampled"};
  call->n_programs = own->results ? 1 : PROGRAMS;
  for (int p = 0; p < call->n_programs; ++p) {
    scores *s = &call->programs[p];
    *s = (scores){own->program   ? own->program
                  : own->results ? own->results
                                 : ours[p],
                  calloc(n, sizeof *s->answers),
                  calloc(n, sizeof *s->scores),
                  calloc(n, sizeof *s->causes),
                  own->digits,
                  0,
                  0};
    if (!s->answers || !s->scores || !s->causes)
      return cli_solver_failed(call->common, CLI_BOTH, "suite", HC_NO_MEMORY, 0);
  }
  if (own->results) {
    st = suite_results_read(own->results, &call->suite, call->programs->answers, &strange, why);
    if (st != HC_OK) return cli_failed(call->common, st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE, "%s", why);
    if (strange) suite_say(call->words, "%s; %d such", why, strange);
  } else if ((code = solve_all(call)) != 0) return code;
  for (int p = 0; p < call->n_programs && !code; ++p) code = judge(call, &call->programs[p]);
  if (!code && own->results) code = diagnose(call, call->programs);
  return code;
}

static int run_suite(cli_common *common, void *given, scene *sc)
{
  (void)sc;
  suite_call *call = calloc(1, sizeof *call);
  if (!call) return cli_solver_failed(common, CLI_BOTH, "suite", HC_NO_MEMORY, 0);
  call->common = common, call->own = given;
  const char *page = common->output, *dot = page ? strrchr(page, '.') : NULL;
  if (dot && !strcmp(dot, ".html")) common->output = NULL;
  else page = NULL;
  call->folder = folder_of(common);
  int code = call->own->write && call->own->results
                 ? cli_failed(common, EXIT_USAGE, "--write-results writes our own results: not with --results")
                 : read_and_score(call);
  int written = code ? 0 : write_tables(call);
  if (!code && !written) written = write_file(call, page, write_page);
  if (!code && !written) written = write_file(call, call->own->badge, write_badge);
  if (!code && !written) written = write_file(call, call->own->junit, write_junit);
  if (!code && !written) written = write_file(call, call->own->write, write_results);
  if (!code) code = written ? written : call->refused ? EXIT_BAD_CASE : 0;
  for (int p = 0; p < call->n_programs; ++p) {
    scores *s = &call->programs[p];
    if (!code && s->passed < call->suite.n) code = EXIT_DISAGREED;
    for (int i = 0; i < call->suite.n && s->answers && s->scores; ++i)
      free(s->answers[i].rows), free(s->scores[i].matches);
    free(s->answers), free(s->scores), free(s->causes);
  }
  suite_clear(&call->suite);
  free(call);
  return code;
}

CLI_COMMAND(suite, suite_options, "[SUITE]", "score a program, or ourselves, on published cases with proven references",
            .defaults = &defaults);
