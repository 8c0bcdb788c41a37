/* cmd_stress.c - hbmcheck stress: random scenes, every method compared with every other. */
#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/output/output.h"
#include "compare/output/progress.h"
#include "compare/output/same_file.h"
#include "compare/stress/scenes.h"
#include "compare/stress/stress.h"
#include "interfaces/command/cli.h"
#include "interfaces/command/commands.h"
#include "model/casefile/case_file.h"
#include "numerics/base/number.h"
#include "numerics/base/path.h"

/* ---- files: none in two roles, and a folder for the findings (tests/command/files.transcript) ---- */

enum { PATH_ROOM = 4096 };

/* Is that the name of a finding's case file, of this seed? */
static bool is_finding(unsigned long seed, const char *name)
{
  static const char ending[] = ".yaml";
  char start[64];
  const size_t length = strlen(name), tail = sizeof ending - 1;
  const int head = snprintf(start, sizeof start, "stress-%lu-", seed);
  return !strncmp(name, start, (size_t)head) && length > tail && !strcmp(name + length - tail, ending);
}

static bool may_be_replaced(unsigned long seed, const char *folder, const char *path)
{
  file_identity it;
  if (file_is_in(path, folder) && is_finding(seed, path_name(path, NULL))) return true;
  file_identify(path, -1, &it);
  /* Is one of the findings in the folder, which may be written again, this very file, under whatever name? */
  bool same = false;
  DIR *from = opendir(folder);
  for (struct dirent *e; from && !same && (e = readdir(from));) {
    char finding[PATH_ROOM];
    file_identity there;
    if (!is_finding(seed, e->d_name)) continue;
    snprintf(finding, sizeof finding, "%s/%s", folder, e->d_name);
    file_identify(finding, -1, &there);
    same = file_same(&it, &there);
    file_forget(&there);
  }
  if (from) closedir(from);
  file_forget(&it);
  return same;
}

static const char help[] =
    "You changed the program, or want to know how far to trust it: draws random scenes, solves each by every method, "
    "and compares each with every other. Every check ends as agreed, explained (by a reason that was computed, too), "
    "too_dear (see --seconds), refused (a solver said why) or a finding: two methods differ and nothing explains it."
    "\vSeed and index make a scene again: --first INDEX --scenes 1 --all runs it alone, --case prints its case file. "
    "With --results the same command goes on where it was stopped.\n"
    "exit: 0 no findings  1 findings  3 stopped, or a file could not be written  64 usage\n"
    "example: hbmcheck stress --scenes 200";

typedef struct stress_options {
  stress_plan plan;   /* --scenes, --seed, --first, --results (journal), --seconds, --jobs */
  bool one_case, all; /* --case, --all */
  bool structures, space;
  const char *findings; /* NULL: not kept */
} stress_options;

enum { DEFAULT_SCENES = 200, MAX_SCENES = 100000000 };

static const cli_option options[] = {
    {CLI_COUNT, "scenes", "N", "How many scenes [200]", offsetof(stress_options, plan.scenes), 1, MAX_SCENES},
    {CLI_FLAG, "structures", NULL, "Draw structures of up to 12 degrees of freedom in place of oscillators",
     offsetof(stress_options, structures)},
    {CLI_FLAG, "space", NULL, "The same structures, with a second tangent of some of their contacts",
     offsetof(stress_options, space)},
    {CLI_COUNT, "seed", "N", "Which sequence [1]", offsetof(stress_options, plan.seed), 0, INT_MAX},
    {CLI_COUNT, "first", "INDEX", "The first scene's place in the sequence [0]", offsetof(stress_options, plan.first),
     0, MAX_SCENES},
    {CLI_FLAG, "case", NULL, "Run nothing: print the case file of the first scene", offsetof(stress_options, one_case)},
    {CLI_FLAG, "all", NULL, "Show every check of every scene", offsetof(stress_options, all)},
    {CLI_TEXT, "findings", "DIR", "Shrink every finding, and keep it in DIR as a case file",
     offsetof(stress_options, findings)},
    {CLI_TEXT, "results", "FILE", "Keep results in FILE as they come, and go on from what is there",
     offsetof(stress_options, plan.journal), .file = "--results", .use = CLI_RESULTS},
    {CLI_POSITIVE, "seconds", "S", "Processor time allowed for a check [1]; the first solution may take that of all",
     offsetof(stress_options, plan.seconds)},
    {CLI_INTEGER, "jobs", "N", "Scenes at once [one a processor]", offsetof(stress_options, plan.jobs), 1, CLI_MAX_JOBS,
     .letter = 'j'},
    {0},
};

static const table_column check_columns[] = {
    TEXT("check"),       INTEGER("agreed"),  INTEGER("explained"), INTEGER("too_dear"),  INTEGER("refused"),
    INTEGER("findings"), INTEGER("skipped"), TEXT("explained_by"), REAL("median_error"), REAL("largest_error"),
    INTEGER("scene"),    REAL("seconds"),    TEXT("holds")};
static const table_column reason_columns[] = {TEXT("check"),     TEXT("outcome"),        TEXT("reason"),
                                              INTEGER("scenes"), INTEGER("one_of_them"), TEXT("meaning")};
static const table_column scene_columns[] = {INTEGER("scene"), TEXT("check"), TEXT("outcome"), TEXT("reason"),
                                             REAL("error"),    REAL("bound"), TEXT("why")};
static const char *const spare_columns[] = {"holds", "seconds", "median_error", "scene", "explained_by", NULL};
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

typedef struct stress_call {
  cli_common *common;
  stress_options *own;
  stress_result *results;   /* [plan.scenes] */
  long classified, resumed; /* scenes with results, and those of them that the journal had */
  long findings;
} stress_call;

/* ---- tables ---- */

static table *checks_table(stress_call *call)
{
  static const stress_outcome shown[] = {STRESS_AGREED,  STRESS_EXPLAINED, STRESS_DEAR,
                                         STRESS_REFUSED, STRESS_FINDING,   STRESS_SKIPPED};
  table *t = table_new("Checks", CLI_COLUMNS(check_columns));
  table_spare(t, spare_columns);
  for (int k = 0; k < STRESS_N_CHECKS; ++k) {
    long count[STRESS_N_OUTCOMES] = {0};
    double seconds = 0;
    for (long i = 0; i < call->own->plan.scenes; ++i) {
      if (!call->results[i].there) continue;
      ++count[call->results[i].check[k].outcome];
      seconds += call->results[i].check[k].seconds;
    }
    table_put_text(t, stress_kind_name((stress_kind)k));
    for (int o = 0; o < COUNT(shown); ++o) table_put_integer(t, count[shown[o]]);
    /* "truncated 12, ill_conditioned 3": how many scenes a check explained by what. */
    char text[256] = "";
    int length = 0;
    for (int r = 0; r < STRESS_N_REASONS; ++r) {
      long n = 0;
      for (long i = 0; i < call->own->plan.scenes; ++i) {
        const stress_check *c = &call->results[i].check[k];
        n += call->results[i].there && c->outcome == STRESS_EXPLAINED && (int)c->reason == r;
      }
      if (n == 0 || length >= (int)sizeof text) continue;
      length += snprintf(text + length, sizeof text - (size_t)length, "%s%s %ld", length ? ", " : "",
                         stress_reason_name((stress_reason)r), n);
    }
    table_put_text(t, text);
    /* Median and largest error of the scenes where this check agreed, and the scene of the largest. */
    double *errors = malloc((size_t)call->own->plan.scenes * sizeof *errors), largest = -1;
    long n = 0, at = -1;
    for (long i = 0; errors && i < call->own->plan.scenes; ++i) {
      const stress_check *c = &call->results[i].check[k];
      if (!call->results[i].there || c->outcome != STRESS_AGREED) continue;
      errors[n++] = c->error;
      if (c->error > largest) largest = c->error, at = call->results[i].index;
    }
    if (n > 0) qsort(errors, (size_t)n, sizeof *errors, ascending);
    TABLE_ROW(t, CELL(n > 0 ? errors[n / 2] : NAN), CELL(n > 0 ? largest : NAN), CELL_IF(n > 0, at), CELL(seconds),
              CELL(stress_kind_meaning((stress_kind)k)));
    free(errors);
    call->findings += count[STRESS_FINDING];
  }
  return t;
}

static const char *meaning_of(const stress_check *c)
{
  return c->outcome == STRESS_REFUSED ? hc_status_text(c->status) : stress_reason_meaning(c->reason);
}

/* How often each outcome but agreement had each reason and status, with the first scene of it. */
static table *reasons_table(const stress_call *call)
{
  table *t = table_new("Reasons", CLI_COLUMNS(reason_columns));
  table_wrap(t, cli_width(call->common));
  for (int k = 0; k < STRESS_N_CHECKS; ++k)
    for (int o = 0; o < STRESS_N_OUTCOMES; ++o)
      for (int r = 0; r < STRESS_N_REASONS; ++r)
        for (int st = HC_OK; st <= HC_BUG; ++st) {
          const stress_check *one = NULL;
          long n = 0, index = 0;
          for (long i = 0; i < call->own->plan.scenes; ++i) {
            const stress_check *c = &call->results[i].check[k];
            if (!call->results[i].there || o == STRESS_AGREED || (int)c->outcome != o || (int)c->reason != r ||
                (int)c->status != st)
              continue;
            if (n++ == 0) one = c, index = call->results[i].index;
          }
          if (n == 0) continue;
          TABLE_ROW(t, CELL(stress_kind_name((stress_kind)k)), CELL(stress_outcome_name((stress_outcome)o)),
                    CELL(stress_reason_name((stress_reason)r)), CELL(n), CELL(index), CELL(meaning_of(one)));
        }
  return t;
}

static table *scenes_table(const stress_call *call)
{
  table *t = table_new(call->own->all ? "Scenes" : "Findings", CLI_COLUMNS(scene_columns));
  table_wrap(t, cli_width(call->common));
  for (long i = 0; i < call->own->plan.scenes; ++i)
    for (int k = 0; k < STRESS_N_CHECKS && call->results[i].there; ++k)
      if (call->own->all || call->results[i].check[k].outcome == STRESS_FINDING) {
        const stress_check *c = &call->results[i].check[k];
        TABLE_ROW(t, CELL(call->results[i].index), CELL(stress_kind_name((stress_kind)k)),
                  CELL(stress_outcome_name(c->outcome)), CELL(stress_reason_name(c->reason)), CELL(c->error),
                  CELL(c->bound), CELL(c->outcome == STRESS_AGREED ? "" : meaning_of(c)));
      }
  return t;
}

static int write_tables(stress_call *call)
{
  table *tables[3] = {checks_table(call), reasons_table(call), scenes_table(call)};
  table *t = tables[0];
  double total = 0, slowest = -1;
  long at = 0;
  for (long i = 0; i < call->own->plan.scenes; ++i) {
    const stress_result *r = &call->results[i];
    if (!r->there) continue;
    total += r->seconds;
    if (r->seconds > slowest) slowest = r->seconds, at = r->index;
  }
  table_note(t, "%ld scenes of seed %lu from %ld on: %ld findings, %ld scenes never classified", call->classified,
             call->own->plan.seed, call->own->plan.first, call->findings, call->own->plan.scenes - call->classified);
  if (call->classified > 0) table_note(t, "%.4g s of processor time; slowest: scene %ld, %.3g s", total, at, slowest);
  table_note(t, "errors are those of what agreed; again: hbmcheck stress%s --seed %lu --first SCENE --scenes 1 --all",
             stress_family_option(call->own->plan.family), call->own->plan.seed);
  int code = cli_write(call->common, table_rows(tables[2]) > 0 ? 3 : 2, tables);
  for (int i = 0; i < 3; ++i) table_free(tables[i]);
  return code ? code : call->findings > 0 ? EXIT_DISAGREED : EXIT_AGREED;
}

/* ---- scenes as case files ---- */

static hc_status scene_at(const stress_call *call, long index, scene *sc)
{
  stress_scenes *scenes;
  hc_status st = stress_scenes_new(call->own->plan.seed, &scenes);
  if (st == HC_OK) st = stress_scene_of(scenes, call->own->plan.family, index, sc);
  stress_scenes_free(scenes);
  return st;
}

/* comment ("" or lines) and scene into a file (NULL: standard output). 0 or the exit code after the message. */
static int write_case(const stress_call *call, const char *path, const char *comment, const scene *sc)
{
  output *out = NULL;
  hc_status st = output_open(path, &out);
  if (st == HC_OK) {
    fputs(comment, output_stream(out));
    st = output_finish(out, case_echo(sc, output_stream(out)));
  }
  return st == HC_OK ? 0 : cli_file_failed(call->common, path, st);
}

/* The finding, shrunk, as a case file in the folder of --findings. 0 or the exit code. */
static int keep_finding(const stress_call *call, long index, stress_kind kind, const hc_monitor *monitor)
{
  scene sc;
  char path[4096], comment[512];
  hc_status st = scene_at(call, index, &sc);
  if (st != HC_OK) return cli_solver_failed(call->common, CLI_BOTH, "the sequence", st, 0);
  st = stress_shrink(&sc, kind, call->own->plan.seconds, monitor);
  if (st != HC_OK && st != HC_INTERRUPTED) {
    case_clear(&sc);
    return cli_solver_failed(call->common, CLI_BOTH, "shrinking", st, 0);
  }
  snprintf(path, sizeof path, "%s/stress-%lu-%s%ld-%s.yaml", call->own->findings, call->own->plan.seed,
           !scene_is_oscillator(&sc) ? "structure-" : "", index, stress_kind_name(kind));
  snprintf(
      comment, sizeof comment,
      "# Found by hbmcheck stress%s --seed %lu --first %ld --scenes 1, and made smaller: %s.\n# It should hold that: "
      "%s.\n",
      stress_family_option(call->own->plan.family), call->own->plan.seed, index, stress_kind_name(kind),
      stress_kind_meaning(kind));
  const int code = write_case(call, path, comment, &sc);
  case_clear(&sc);
  return code;
}

/* ---- running ---- */

/* The progress: a line with the number of scenes done. */
typedef struct scene_progress {
  const stress_call *of;
  progress *bar;
  hc_monitor monitor;
} scene_progress;

static bool scenes_done(void *self, double part)
{
  scene_progress *w = self;
  char label[64];
  const long scenes = w->of->own->plan.scenes, resumed = w->of->resumed;
  const double done = (double)resumed + part * (double)(scenes - resumed);
  snprintf(label, sizeof label, "%ld of %ld scenes", lround(done), scenes);
  progress_relabel(w->bar, label);
  return hc_monitor_tick(&w->monitor, done / (double)scenes);
}

/* Classify the scenes of the plan. 0 or the exit code after the message. */
static int classify_scenes(stress_call *call)
{
  scene_progress w = {.of = call, .bar = progress_start("stress", call->common->quiet)};
  w.monitor = progress_monitor(w.bar);
  const hc_monitor watching = {scenes_done, &w};
  hc_status st = stress_run(&call->own->plan, &watching, call->results, &call->resumed);
  int failure = errno;
  progress_end(w.bar);
  for (long i = 0; i < call->own->plan.scenes; ++i) call->classified += call->results[i].there;
  if (st == HC_OK) return 0;
  if (st == HC_BAD_INPUT || st == HC_UNSUPPORTED)
    return cli_failed(call->common, EXIT_BAD_CASE, "%s: %s, expected those or a new file", call->own->plan.journal,
                      st == HC_BAD_INPUT
                          ? "not the results of this seed, these --seconds and scenes of this kind, or damaged"
                          : "not the results of this version of hbmcheck with its checks and reasons");
  if (st == HC_IO) cli_message(call->common, "%s: %s", call->own->plan.journal, strerror(failure));
  else if (st == HC_INTERRUPTED)
    cli_message(call->common, "stopped on request after %ld of %ld scenes%s", call->classified, call->own->plan.scenes,
                call->own->plan.journal ? "; the same command goes on from there" : "; --results FILE would keep them");
  else return cli_solver_failed(call->common, CLI_BOTH, "stress", st, 0);
  return EXIT_NO_SOLUTION;
}

static int run_stress(cli_common *common, void *given, scene *sc)
{
  stress_options *own = given;
  stress_call call = {.common = common, .own = own};
  (void)sc;
  if (own->structures) own->plan.family = STRESS_STRUCTURES;
  if (own->space) own->plan.family = STRESS_SPACE;
  if (!own->plan.jobs) own->plan.jobs = cli_processors();
  if (common->n_set) return cli_failed(common, EXIT_USAGE, "--set has no case file to set anything in");
  const cli_file others[] = {{"--results", own->plan.journal, CLI_RESULTS}, {"--output", common->output, CLI_OUTPUT}};
  for (int k = 0; k < 2 && own->findings; ++k)
    if (others[k].path && may_be_replaced(own->plan.seed, own->findings, others[k].path))
      return cli_failed(common, EXIT_USAGE, "%s %s is where --findings %s keeps a case file; give another name",
                        others[k].what, others[k].path, own->findings);
  if (own->one_case) {
    scene first;
    hc_status st = scene_at(&call, own->plan.first, &first);
    if (st != HC_OK) return cli_solver_failed(common, CLI_BOTH, "the sequence", st, 0);
    const int code = write_case(&call, common->output, "", &first);
    case_clear(&first);
    return code;
  }
  const int refused = cli_make_folder(common, own->findings);
  if (refused) return refused;
  if (!(call.results = calloc((size_t)own->plan.scenes, sizeof *call.results)))
    return cli_solver_failed(common, CLI_BOTH, "stress", HC_NO_MEMORY, 0);
  int stopped = classify_scenes(&call), code = stopped && call.classified == 0 ? stopped : write_tables(&call);
  if (!stopped && own->findings && code == EXIT_DISAGREED) {
    int kept = 0;
    progress *bar = progress_start("shrinking findings", call.common->quiet);
    const hc_monitor monitor = progress_monitor(bar);
    for (long i = 0; i < call.own->plan.scenes && !kept; ++i)
      for (int k = 0; k < STRESS_N_CHECKS && !kept; ++k)
        if (call.results[i].there && call.results[i].check[k].outcome == STRESS_FINDING)
          kept = keep_finding(&call, call.results[i].index, (stress_kind)k, &monitor);
    progress_end(bar);
    if (kept) code = kept;
  }
  free(call.results);
  return stopped ? stopped : code;
}

CLI_COMMAND(stress, stress_options, "", "random scenes, every method compared with every other",
            .defaults = &(const stress_options){.plan = {.seed = 1, .scenes = DEFAULT_SCENES, .seconds = 1}});
