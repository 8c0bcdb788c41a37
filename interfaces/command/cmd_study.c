/* cmd_study.c - hbmcheck study: many scenes of one case in parallel, their results kept as they come, and the study's
 * claims checked against them. Under mpirun rank 0 hands out the scenes, keeps the results and writes. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "compare/output/output.h"
#include "compare/output/progress.h"
#include "compare/study/cluster.h"
#include "compare/study/store.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "model/casefile/structure.h"
#include "numerics/base/path.h"
#include "numerics/base/thread_clock.h"

static const char help[] =
    "You vary numbers of a case, or test what a paper claims: computes every scene of each STUDY (a YAML file: a base "
    "case, and what varies) in parallel, keeps the results in an SQLite file, and tests the study's claims. Killed or "
    "stopped at any moment, the same command goes on where it was."
    "\vThe file's format, the tables of the results and what is guaranteed: study/README.md.\n"
    "exit: 0 done  1 a claim is not as it expects  2 study or results file wrong  3 a scene could not be solved, or "
    "stopped before the end  64 usage\n"
    "example: hbmcheck study gaps.yaml --jobs 4 --export csv --output gaps.csv";

typedef struct study_options {
  int jobs;             /* 0: not given */
  const char *results;  /* NULL: not given */
  bool fresh, timings;  /* --fresh, --timings */
  table_format export;  /* FORMAT_TABLE: --export was not given */
  const char *plot_y;   /* NULL: not given */
  const char *response; /* likewise */
} study_options;

static const cli_option options[] = {
    {CLI_INTEGER, "jobs", "N", "Scenes computed at a time [the processors that are online]",
     offsetof(study_options, jobs), 1, CLI_MAX_JOBS, .letter = 'j'},
    {CLI_TEXT, "results", "FILE",
     "SQLite file of the results, or a folder for it; :memory: keeps nothing [STUDY's name with .sqlite, here]",
     offsetof(study_options, results)},
    {CLI_FLAG, "fresh", NULL, "Throw away what the results file has, and start again", offsetof(study_options, fresh)},
    {CLI_FORMAT, "export", "csv|json", "Write every scene with its rows instead of the summary",
     offsetof(study_options, export)},
    {CLI_FLAG, "timings", NULL, "Export the seconds each scene took, too", offsetof(study_options, timings)},
    {CLI_TEXT, "response", "NAME", "Of a structure: export, or draw, this response alone [export all, draw the first]",
     offsetof(study_options, response)},
    CLI_PLOT_OPTION,
    {CLI_TEXT, "plot-y", "NAME",
     "What to draw: a column of scenes, or of rows, then the largest of each scene [peak_amplitude, or amplitude]",
     offsetof(study_options, plot_y), .group = 2},
    {0},
};

static bool is_exporting(const study_options *own) { return own->export != FORMAT_TABLE; }

enum { MAX_PATH = 4096, BESIDE_PATH = MAX_PATH + 8, FILES_EACH = 4 };

enum { SUMMARY, VERDICTS, CLAIMS /* and STUDY_CLAIM_TABLES of them */, N_TABLES = CLAIMS + STUDY_CLAIM_TABLES };

/* One study of the command line, and how far it came. */
typedef struct study_entry {
  study *s;
  char response[RESPONSE_NAME]; /* of --response, as the column has it; empty: not given */
  char results[MAX_PATH];
  char beside[2][BESIDE_PATH]; /* what SQLite keeps next to it while it is open */
  study_store *store;          /* rank 0 only */
  long computed_now, computed;
  double wall; /* [s] */
} study_entry;

typedef struct study_call {
  cli_common *common;
  const study_options *own;
  int rank, n_ranks; /* of this process, and of how many; 0 and 1 without MPI */
  int jobs;          /* scenes computed at a time by this process */
  int n_studies;
  study_entry studies[CLI_MAX_ARGUMENTS]; /* [n_studies] */
  cli_file files[CLI_MAX_ARGUMENTS * FILES_EACH];
  table *tables[N_TABLES];
  study_claims_tally claims;
  long scenes;
  double seconds, exact_seconds, wall; /* of all studies */
} study_call;

/* The message for a study or results file that is wrong, printed by rank 0 only. Returns the exit code. */
static int study_failed(const study_call *call, hc_status st, const case_error *err)
{
  return call->rank == 0 ? cli_not_read(call->common, st, err) : st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
}

/* The message for wrong usage, printed by rank 0 only. Its value is the exit code. */
#define study_refused(call, ...) ((call)->rank == 0 ? cli_message((call)->common, __VA_ARGS__) : (void)0, EXIT_USAGE)

/* ---- before anything runs ---- */

static const char *response_of(const study_entry *entry) { return *entry->response ? entry->response : NULL; }

/* entry->response, of the study's own base; false after a message, by rank 0 only. */
static bool find_response(study_call *call, study_entry *entry)
{
  if (!call->own->response) return true;
  const scene_structure *of = entry->s->base.structure;
  call->common->scene = &entry->s->base;
  if (of->is_oscillator && call->rank == 0)
    cli_message(call->common, "--response: %s has one degree of freedom, expected a structure", entry->s->name);
  const int r = !of->is_oscillator ? cli_response_named(call->common, call->own->response) : -1;
  if (r >= 0) structure_response_name(of, r, entry->response, sizeof entry->response);
  return r >= 0;
}

static int read_studies(study_call *call)
{
  cli_common *common = call->common;
  for (int i = 0; i < common->n_arguments; ++i) {
    case_error err = {{0}};
    hc_status st = study_read(common->arguments[i], common->n_set, common->set, &call->studies[i].s, &err);
    if (st == HC_OK) {
      ++call->n_studies;
      st = study_claims_check(call->studies[i].s, &err);
    }
    if (st != HC_OK) return study_failed(call, st, &err);
    /* The file of --results; without, the study's name with .sqlite, here or in the folder of --results. */
    study_entry *entry = &call->studies[i];
    int stem;
    const char *name = path_name(!strcmp(entry->s->name, "<stdin>") ? "study" : entry->s->name, &stem);
    struct stat info;
    const bool folder = call->own->results && stat(call->own->results, &info) == 0 && S_ISDIR(info.st_mode);
    if (call->own->results && !folder) snprintf(entry->results, sizeof entry->results, "%s", call->own->results);
    else
      snprintf(entry->results, sizeof entry->results, "%s%s%.*s.sqlite", folder ? call->own->results : "",
               folder ? "/" : "", stem, name);
    if (!find_response(call, &call->studies[i])) return EXIT_USAGE;
    if (common->drawing.path && plot_study_check(&common->drawing, call->studies[i].s, call->own->plot_y,
                                                 response_of(&call->studies[i])) != HC_OK)
      return study_refused(call, "%s", common->drawing.why);
  }
  /* No two studies in one results file. */
  for (int i = 0; i < call->n_studies; ++i)
    for (int k = 0; k < i; ++k) {
      if (strcmp(call->studies[i].results, call->studies[k].results) || !strcmp(call->studies[i].results, ":memory:"))
        continue;
      return study_refused(
          call, "%s and %s would share the results file %s; run them one by one, or give a folder or names that differ",
          call->studies[k].s->name, call->studies[i].s->name, call->studies[i].results);
    }
  return 0;
}

static int open_stores(study_call *call)
{
  for (int i = 0; i < call->n_studies; ++i) {
    case_error err = {{0}};
    hc_status st = study_store_open(call->studies[i].s, call->studies[i].results, HBMCHECK_VERSION, call->own->fresh,
                                    &call->studies[i].store, &err);
    if (st != HC_OK) return study_failed(call, st, &err);
  }
  return 0;
}

/* ---- running ---- */

/* The progress of one study: a line with the number of scenes done. */
typedef struct scene_progress {
  progress *bar;
  hc_monitor monitor;
  double start; /* [s] */
} scene_progress;

static bool scenes_done(void *self, long done, long now, long scenes)
{
  scene_progress *w = self;
  char label[96];
  double elapsed = wall_seconds() - w->start;
  long left_at_start = scenes - done + now;
  snprintf(label, sizeof label, "%ld of %ld scenes, %.3g/s", done, scenes, elapsed > 0 ? (double)now / elapsed : 0.0);
  progress_relabel(w->bar, label);
  return hc_monitor_tick(&w->monitor, left_at_start > 0 ? (double)now / (double)left_at_start : 1);
}

/* Compute the scenes of one study that its results file does not have. 0 or the exit code after the message. */
static int compute_study(study_call *call, study_entry *entry)
{
  scene_progress w = {.bar = progress_start("study", call->common->quiet), .start = wall_seconds()};
  w.monitor = progress_monitor(w.bar);
  study_watch watching = {scenes_done, &w};
  hc_status st = study_run(entry->s, entry->store, call->jobs, &watching, &entry->computed_now, &entry->computed);
  progress_end(w.bar);
  entry->wall = wall_seconds() - w.start;
  if (st == HC_OK) return 0;
  if (st == HC_IO)
    cli_message(call->common, "%s: a scene could not be kept: %s", entry->results, study_store_error(entry->store));
  else if (st == HC_NO_MEMORY) cli_message(call->common, "%s", hc_status_text(st));
  if (!strcmp(entry->results, ":memory:"))
    cli_message(call->common, "stopped: %ld of %ld scenes were done and are lost with :memory:", entry->computed,
                entry->s->n_scenes);
  else
    cli_message(call->common, "stopped: %ld of %ld scenes are in %s; the same command goes on from there",
                entry->computed, entry->s->n_scenes, entry->results);
  return EXIT_NO_SOLUTION;
}

/* ---- results ---- */

static const table_column summary_columns[] = {
    TEXT("run"),         INTEGER("scenes"), INTEGER("computed"), INTEGER("done"), INTEGER("failed"),
    REAL("computing_s"), REAL("exact_s"),   REAL("wall_s"),      TEXT("results"), TEXT("study")};

static const char *const spare_columns[] = {"exact_s", "computing_s", "computed", "wall_s", NULL};

static double to_milliseconds(double seconds) { return (double)(long)(seconds * 1000 + 0.5) / 1000; }

/* The study's rows in the tables of studies and of verdicts. 0 or the exit code. */
static int put_summary(study_call *call, const study_entry *entry, bool *any_failed)
{
  study_summary sum;
  table *to = call->tables[SUMMARY];
  hc_status st = study_summarise(entry->s, entry->store, &sum);
  if (st == HC_OK) st = study_verdicts(entry->s, entry->store, call->tables[VERDICTS]);
  if (st != HC_OK) {
    cli_message(call->common, "%s: %s", entry->results,
                st == HC_NO_MEMORY ? hc_status_text(st) : study_store_error(entry->store));
    return st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
  }
  TABLE_ROW(to, CELL(study_kind_name(entry->s->kind)), CELL(entry->s->n_scenes), CELL(entry->computed_now),
            CELL(sum.done), CELL(sum.failed), CELL(to_milliseconds(sum.seconds)),
            CELL(to_milliseconds(sum.exact_seconds)), CELL(to_milliseconds(entry->wall)), CELL(entry->results),
            CELL(entry->s->title));
  if (sum.failed)
    table_note(to, "%s: %ld failed, the first of them scene %ld: %s", entry->s->title, sum.failed, sum.first_failed,
               sum.reason);
  *any_failed |= sum.failed > 0 && !entry->s->may_fail;
  call->scenes += entry->s->n_scenes;
  call->seconds += sum.seconds;
  call->exact_seconds += sum.exact_seconds;
  call->wall += entry->wall;
  return 0;
}

/* What the study claims against its results, into the tables of claims. 0 or the exit code. */
static int check_claims(study_call *call, const study_entry *entry)
{
  case_error err = {{0}};
  progress *bar = progress_start("claims", call->common->quiet);
  hc_monitor monitor = progress_monitor(bar);
  hc_status st = study_claims_run(entry->s, entry->store, &monitor, call->tables + CLAIMS, &call->claims, &err);
  progress_end(bar);
  if (st == HC_INTERRUPTED) return cli_solver_failed(call->common, CLI_BOTH, "the claims", st, 0);
  return st == HC_OK ? 0 : study_failed(call, st, &err);
}

/* The summary and the tables that have rows; with --export these go to stderr, and the export where they would. */
static int write_tables(const study_call *call)
{
  table *shown[N_TABLES];
  int n = 0;
  for (int i = 0; i < N_TABLES; ++i)
    if (i == SUMMARY || table_rows(call->tables[i]) > 0) shown[n++] = call->tables[i];
  if (!is_exporting(call->own)) return cli_write(call->common, n, shown);
  if (!call->common->quiet) table_write(n, shown, FORMAT_TABLE, stderr);
  output *out = NULL;
  const study_entry *entry = &call->studies[0];
  hc_status st = output_open(call->common->output, &out);
  if (st == HC_OK)
    st = output_finish(out, study_export(entry->s, entry->store, call->own->export, call->own->timings,
                                         response_of(entry), output_stream(out)));
  return st == HC_OK ? 0 : cli_file_failed(call->common, call->common->output, st);
}

/* The tables, export and drawing of the first n_run studies. Returns the exit code. */
static int write_results(study_call *call, int n_run)
{
  int code = 0;
  bool any_failed = false;
  static const char *const titles[STUDY_CLAIM_TABLES] = {
      "Claims", "Claims, with the settings of their source and with ours",
      "Claims that the continuation decides, in fixed steps of arc length with the settings of their source",
      "Seconds, as the source reports them, and here with its settings and with ours"};
  int n;
  call->tables[SUMMARY] = table_new("Studies", CLI_COLUMNS(summary_columns));
  table_spare(call->tables[SUMMARY], spare_columns);
  const table_column *columns = study_verdict_columns(&n);
  call->tables[VERDICTS] = table_new("Verdicts", n, columns);
  for (int i = 0; i < STUDY_CLAIM_TABLES; ++i) {
    columns = study_claims_columns(i, &n);
    call->tables[CLAIMS + i] = table_new(titles[i], n, columns);
    if (i != STUDY_SECONDS) table_wrap(call->tables[CLAIMS + i], cli_width(call->common));
  }
  for (int i = 0; i < n_run && !code; ++i) {
    code = put_summary(call, &call->studies[i], &any_failed);
    if (!code && call->studies[i].computed == call->studies[i].s->n_scenes)
      code = check_claims(call, &call->studies[i]);
  }
  static const char *const with[STUDY_ANSWERS] = {"", " with the settings of their source", " with ours",
                                                  " in fixed steps"};
  static const int shown_in[STUDY_ANSWERS] = {STUDY_CLAIMS, STUDY_SIDES, STUDY_SIDES, STUDY_STEPS};
  const study_claims_tally *c = &call->claims;
  if (call->n_studies > 1)
    table_note(call->tables[SUMMARY],
               "%d studies, %ld scenes: %.3g s of processor time, %.3g s of it with exact forces; %.3g s on the clock",
               call->n_studies, call->scenes, call->seconds, call->exact_seconds, call->wall);
  for (int k = 0; k < STUDY_ANSWERS; ++k)
    if (c->agree[k] + c->disagree[k] + c->unsaid[k] > 0)
      table_note(call->tables[CLAIMS + shown_in[k]], "%d claims agree%s, %d do not, of %d it cannot be said",
                 c->agree[k], with[k], c->disagree[k], c->unsaid[k]);
  if (!code) code = write_tables(call);
  int drawn = 0;
  if (!code && call->common->drawing.path && n_run > 0)
    drawn = cli_plotted(call->common, plot_study(&call->common->drawing, call->studies[0].s, call->studies[0].store,
                                                 call->own->plot_y, response_of(&call->studies[0])));
  for (int i = 0; i < N_TABLES; ++i) table_free(call->tables[i]);
  return code ? code : call->claims.unexpected ? EXIT_DISAGREED : any_failed ? EXIT_NO_SOLUTION : drawn;
}

/* Rank 0 computes the studies and writes results, but not of one that was stopped: half of it would look like all. */
static int run_rank_0(study_call *call)
{
  int stopped = 0, n = 0;
  for (; n < call->n_studies && !stopped; ++n) {
    cluster_agree(0);
    stopped = compute_study(call, &call->studies[n]);
  }
  if (stopped && n < call->n_studies) cluster_agree(stopped);
  if (stopped && is_exporting(call->own)) return stopped;
  int code = write_results(call, n);
  return stopped ? stopped : code;
}

static bool not_interrupted(void *self, double done)
{
  (void)self, (void)done;
  return !progress_interrupted();
}

static int run_study(cli_common *common, void *own, scene *sc)
{
  study_call *call = calloc(1, sizeof *call);
  (void)sc;
  if (!call) return cli_solver_failed(common, CLI_BOTH, "study", HC_NO_MEMORY, 0);
  call->common = common;
  call->own = own;
  bool without_mpi = !cluster_start(&call->rank, &call->n_ranks);
  call->jobs = call->own->jobs ? call->own->jobs : call->n_ranks > 1 ? 1 : cli_processors();
  /* Options that do not go together. */
  const study_options *given = call->own;
  const bool several = call->common->n_arguments > 1;
  const char *fault = NULL;
  if (without_mpi)
    fault =
        "started in several copies by mpirun, but built without MPI (cmake -DHBMCHECK_MPI=ON): each would do the same";
  else if (is_exporting(given) && several) fault = "--export takes one study at a time";
  else if (call->n_ranks > 1 && given->jobs > 1)
    fault = "under mpirun every process computes one scene at a time: give mpirun more processes instead of --jobs";
  else if (call->common->drawing.path && several) fault = "--plot draws one study at a time";
  else if (given->plot_y && !call->common->drawing.path) fault = "--plot-y goes with --plot";
  else if (given->timings && !is_exporting(given)) fault = "--timings goes with --export";
  int code = fault ? study_refused(call, "%s", fault) : 0;
  if (!code) code = read_studies(call);
  /* What each study reads and keeps. */
  for (int i = 0; i < call->n_studies && !code; ++i) {
    study_entry *entry = &call->studies[i];
    cli_file *list = call->files + (ptrdiff_t)i * FILES_EACH;
    static const char *const endings[] = {"-wal", "-shm"};
    const bool kept = strcmp(entry->results, ":memory:") != 0;
    const size_t length = strlen(entry->results); /* < MAX_PATH: BESIDE_PATH holds it with an ending */
    list[0] = (cli_file){"the base case", entry->s->base_name, CLI_INPUT};
    list[1] = (cli_file){"the results file", kept ? entry->results : NULL, CLI_RESULTS};
    for (int k = 0; k < 2; ++k) {
      memcpy(entry->beside[k], entry->results, length);
      memcpy(entry->beside[k] + length, endings[k], strlen(endings[k]) + 1);
      list[2 + k] = (cli_file){"the results file's companion", kept ? entry->beside[k] : NULL, CLI_RESULTS};
    }
  }
  if (!code && call->rank == 0) code = cli_check_files(common, call->n_studies * FILES_EACH, call->files);
  if (!code && call->rank == 0) code = open_stores(call);
  int agreed = cluster_agree(code);
  if (!agreed && call->rank == 0) code = run_rank_0(call);
  else if (!agreed) {
    hc_monitor monitor = {not_interrupted, NULL};
    for (int n = 0; n < call->n_studies && cluster_agree(0) == 0; ++n) cluster_work(call->studies[n].s, &monitor);
  }
  for (int i = 0; i < call->n_studies; ++i) {
    study_store_close(call->studies[i].store);
    study_free(call->studies[i].s);
  }
  free(call);
  cluster_end();
  return code;
}

CLI_COMMAND(study, study_options, "STUDY...", "many scenes in parallel, kept as they come, and claims tested on them",
            .starts_itself = true);
