/* cmd_study.c - hbmcheck study: many scenes of one case, in parallel, kept as they come, and what a study claims
 * held against them. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "campaigns/study/claims.h"
#include "campaigns/study/cluster.h"
#include "campaigns/study/report.h"
#include "campaigns/study/run.h"
#include "command/cli.h"
#include "command/plot/plot.h"
#include "output/output.h"
#include "output/progress.h"

static const char doc[] =
    "Compute every scene of each STUDY (a YAML file: a base case, and what varies) in parallel, keep the results in "
    "an SQLite file, and hold what the "
    "study claims against them. Killed or stopped at any moment, the same command goes on where it was."
    "\vThe file's format, the tables of the results and what is guaranteed: campaigns/study/README.md.\n"
    "exit: 0 done  1 a claim is not as it expects  2 study or results file wrong  3 a scene could not be solved, or "
    "stopped before the end  64 usage\n"
    "example: hbmcheck study gaps.yaml --jobs 4 --export csv --output gaps.csv";

static const struct argp_option options[] = {
    {"jobs", CLI_JOBS, "N", 0, "Scenes computed at a time [the processors that are online]", 1},
    {"results", CLI_RESULTS, "FILE", 0,
     "SQLite file of the results, or a folder for it; :memory: keeps nothing [STUDY's name with .sqlite, here]", 1},
    {"fresh", CLI_FRESH, NULL, 0, "Throw away what the results file has, and start again", 1},
    {"export", CLI_EXPORT, "csv|json", 0, "Write every scene with its rows instead of the summary", 1},
    {"timings", CLI_TIMINGS, NULL, 0, "Export the seconds each scene took, too", 1},
    CLI_PLOT_OPTION,
    {"plot-y", CLI_PLOT_Y, "NAME", 0,
     "What to draw: a column of scenes, or of rows, then the largest of each scene [peak_amplitude, or amplitude]", 2},
    {0},
};

enum { MOST_PATH = 4096, PLAIN_WIDTH = 150, LEAST_WIDTH = 60 };

enum { SUMMARY, VERDICTS, CLAIMS /* and STUDY_CLAIM_TABLES of them */, N_TABLES = CLAIMS + STUDY_CLAIM_TABLES };

/* One study of the command line. */
typedef struct task {
  study *s;
  char results[MOST_PATH];
  study_store *store; /* rank 0 only */
  long now, there;
  double wall; /* [s] */
} task;

typedef struct job {
  cli_options o;
  int rank, size, n, jobs;
  task tasks[CLI_MAX_ARGUMENTS];
  table *tables[N_TABLES];
  study_claims_tally claims;
  long scenes;
  double seconds, exact_seconds, wall; /* of all studies */
} job;

static double wall_seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Say it once, however many processes there are. */
static int wrong(const job *j, hc_status st, const case_error *err)
{
  if (j->rank == 0) fprintf(stderr, "%s\n", err->message[0] ? err->message : hc_status_text(st));
  return st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
}

/* ---- before anything runs ---- */

static bool is_folder(const char *path)
{
  struct stat info;
  return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

/* The study's name with .sqlite, here or in the folder of --results. */
static void name_results(const cli_options *o, task *t)
{
  const char *name = t->s->name, *slash = strrchr(name, '/'),
             *stem = !strcmp(name, "<stdin>") ? "study"
                     : slash                  ? slash + 1
                                              : name;
  const char *dot = strrchr(stem, '.');
  int length = (int)(dot && dot > stem ? (size_t)(dot - stem) : strlen(stem));
  bool folder = o->results && is_folder(o->results);
  if (o->results && !folder) snprintf(t->results, sizeof t->results, "%s", o->results);
  else
    snprintf(t->results, sizeof t->results, "%s%s%.*s.sqlite", folder ? o->results : "", folder ? "/" : "", length,
             stem);
}

static int check_names(const job *j)
{
  for (int i = 0; i < j->n; ++i)
    for (int k = 0; k < i; ++k) {
      if (strcmp(j->tasks[i].results, j->tasks[k].results) || !strcmp(j->tasks[i].results, ":memory:")) continue;
      if (j->rank == 0)
        cli_say(&j->o,
                "%s and %s would share the results file %s; run them one by one, or give a folder or names that differ",
                j->tasks[k].s->name, j->tasks[i].s->name, j->tasks[i].results);
      return EXIT_USAGE;
    }
  return 0;
}

static int read_studies(job *j)
{
  const cli_options *o = &j->o;
  for (int i = 0; i < o->n_arguments; ++i) {
    case_error err = {{0}};
    hc_status st = study_read(o->arguments[i], o->n_set, o->set, &j->tasks[i].s, &err);
    if (st == HC_OK) {
      ++j->n;
      st = study_claims_check(j->tasks[i].s, &err);
    }
    if (st != HC_OK) return wrong(j, st, &err);
    name_results(o, &j->tasks[i]);
    plot_order drawing = {.path = o->plot};
    if (o->plot && plot_study_check(&drawing, j->tasks[i].s, o->plot_y) != HC_OK) {
      if (j->rank == 0) cli_say(o, "%s", drawing.why);
      return EXIT_USAGE;
    }
  }
  return check_names(j);
}

static int open_stores(job *j)
{
  for (int i = 0; i < j->n; ++i) {
    case_error err = {{0}};
    hc_status st =
        study_store_open(j->tasks[i].s, j->tasks[i].results, HBMCHECK_VERSION, j->o.fresh, &j->tasks[i].store, &err);
    if (st != HC_OK) return wrong(j, st, &err);
  }
  return 0;
}

static int check_usage(job *j, bool lonely)
{
  const cli_options *o = &j->o;
  const char *fault = NULL;
  if (lonely)
    fault =
        "started in several copies by mpirun, but built without MPI (cmake -DHBMCHECK_MPI=ON): each would do the same";
  else if (o->export && o->n_arguments > 1) fault = "--export takes one study at a time";
  else if (j->size > 1 && o->jobs > 1)
    fault = "under mpirun every process computes one scene at a time: give mpirun more processes instead of --jobs";
  else if (o->plot && o->n_arguments > 1) fault = "--plot draws one study at a time";
  else if (o->plot_y && !o->plot) fault = "--plot-y goes with --plot";
  else if (o->timings && !o->export) fault = "--timings goes with --export";
  if (fault && j->rank == 0) cli_say(o, "%s", fault);
  long online = sysconf(_SC_NPROCESSORS_ONLN);
  j->jobs = o->jobs ? o->jobs : j->size > 1 || online < 1 ? 1 : online > CLI_MAX_JOBS ? CLI_MAX_JOBS : (int)online;
  return fault ? EXIT_USAGE : 0;
}

/* ---- running ---- */

typedef struct watcher {
  progress *bar;
  hc_monitor monitor;
  double start;
} watcher;

static bool watch(void *self, long done, long now, long scenes)
{
  watcher *w = self;
  char label[96];
  double elapsed = wall_seconds() - w->start;
  long left = scenes - done + now; /* when it started */
  snprintf(label, sizeof label, "%ld of %ld scenes, %.3g/s", done, scenes, elapsed > 0 ? (double)now / elapsed : 0.0);
  progress_relabel(w->bar, label);
  return hc_monitor_tick(&w->monitor, left > 0 ? (double)now / (double)left : 1);
}

/* 0 or the exit code after saying why. */
static int run_task(job *j, task *t)
{
  watcher w = {.bar = progress_start("study", j->o.quiet), .start = wall_seconds()};
  w.monitor = progress_monitor(w.bar);
  study_watch watching = {watch, &w};
  hc_status st = study_run(t->s, t->store, j->jobs, &watching, &t->now, &t->there);
  progress_end(w.bar);
  t->wall = wall_seconds() - w.start;
  if (st == HC_OK) return 0;
  if (st == HC_IO) cli_say(&j->o, "%s: a scene could not be kept: %s", t->results, study_store_error(t->store));
  else if (st == HC_NO_MEMORY) cli_say(&j->o, "%s", hc_status_text(st));
  if (!strcmp(t->results, ":memory:"))
    cli_say(&j->o, "stopped: %ld of %ld scenes were done and are lost with :memory:", t->there, t->s->n_scenes);
  else
    cli_say(&j->o, "stopped: %ld of %ld scenes are in %s; the same command goes on from there", t->there,
            t->s->n_scenes, t->results);
  return EXIT_NO_SOLUTION;
}

/* ---- telling ---- */

static const table_column summary_columns[] = {
    {"run", TABLE_TEXT},       {"scenes", TABLE_INTEGER},   {"computed", TABLE_INTEGER}, {"done", TABLE_INTEGER},
    {"failed", TABLE_INTEGER}, {"computing_s", TABLE_REAL}, {"exact_s", TABLE_REAL},     {"wall_s", TABLE_REAL},
    {"results", TABLE_TEXT},   {"study", TABLE_TEXT},
};

static double rounded(double seconds) { return (double)(long)(seconds * 1000 + 0.5) / 1000; }

static int summarise(job *j, const task *t, bool *any_failed)
{
  study_summary sum;
  table *to = j->tables[SUMMARY];
  hc_status st = study_summarise(t->s, t->store, &sum);
  if (st == HC_OK) st = study_verdicts(t->s, t->store, j->tables[VERDICTS]);
  if (st != HC_OK) {
    cli_say(&j->o, "%s: %s", t->results, st == HC_NO_MEMORY ? hc_status_text(st) : study_store_error(t->store));
    return st == HC_NO_MEMORY ? EXIT_NO_SOLUTION : EXIT_BAD_CASE;
  }
  table_put_text(to, study_kind_name(t->s->kind));
  table_put_integer(to, t->s->n_scenes);
  table_put_integer(to, t->now);
  table_put_integer(to, sum.done);
  table_put_integer(to, sum.failed);
  table_put_real(to, rounded(sum.seconds));
  table_put_real(to, rounded(sum.exact_seconds));
  table_put_real(to, rounded(t->wall));
  table_put_text(to, t->results);
  table_put_text(to, t->s->title);
  if (sum.failed)
    table_note(to, "%s: %ld failed, the first of them scene %ld: %s", t->s->title, sum.failed, sum.first_failed,
               sum.reason);
  *any_failed |= sum.failed > 0 && !t->s->may_fail;
  j->scenes += t->s->n_scenes;
  j->seconds += sum.seconds;
  j->exact_seconds += sum.exact_seconds;
  j->wall += t->wall;
  return 0;
}

static int hold_claims(job *j, const task *t)
{
  case_error err = {{0}};
  progress *quiet = progress_start("claims", j->o.quiet);
  hc_monitor monitor = progress_monitor(quiet);
  hc_status st = study_claims_run(t->s, t->store, &monitor, j->tables + CLAIMS, &j->claims, &err);
  progress_end(quiet);
  if (st == HC_INTERRUPTED) return cli_solver_failed(&j->o, "the claims", st, 0);
  return st == HC_OK ? 0 : wrong(j, st, &err);
}

static int write_export(const job *j)
{
  output *out = NULL;
  const task *t = &j->tasks[0];
  hc_status st = output_open(j->o.output, &out);
  if (st == HC_OK) {
    st = study_export(t->s, t->store, j->o.export_format, j->o.timings, output_stream(out));
    if (st == HC_OK) st = output_commit(out);
    else output_abandon(out);
  }
  if (st == HC_OK) return 0;
  cli_say(&j->o, "%s: %s", j->o.output ? j->o.output : "standard output",
          st == HC_IO && errno ? strerror(errno) : hc_status_text(st));
  return EXIT_NO_SOLUTION;
}

/* The tables that have something to say. */
static int write_tables(const job *j)
{
  table *shown[N_TABLES];
  int n = 0;
  for (int i = 0; i < N_TABLES; ++i)
    if (i == SUMMARY || table_rows(j->tables[i]) > 0) shown[n++] = j->tables[i];
  if (!j->o.export) return cli_write(&j->o, n, shown);
  if (!j->o.quiet) table_write(n, shown, FORMAT_TABLE, stderr);
  return write_export(j);
}

/* The terminal's width; where there is none, what COLUMNS says, or a width for files. */
static int page_width(const job *j)
{
  struct winsize size;
  const char *told = getenv("COLUMNS");
  int width = told ? (int)strtol(told, NULL, 10) : 0;
  if (!j->o.output && isatty(STDOUT_FILENO) && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    width = size.ws_col;
  return width >= LEAST_WIDTH ? width : width > 0 ? LEAST_WIDTH : PLAIN_WIDTH;
}

static void make_tables(job *j)
{
  static const char *const titles[STUDY_CLAIM_TABLES] = {
      "Claims", "Claims, with the settings of their source and with ours",
      "Seconds, as the source reports them, and here with its settings and with ours"};
  int n;
  j->tables[SUMMARY] = table_new("Studies", sizeof summary_columns / sizeof *summary_columns, summary_columns);
  const table_column *columns = study_verdict_columns(&n);
  j->tables[VERDICTS] = table_new("Verdicts", n, columns);
  for (int i = 0; i < STUDY_CLAIM_TABLES; ++i) {
    columns = study_claims_columns(i, &n);
    j->tables[CLAIMS + i] = table_new(titles[i], n, columns);
    if (i != STUDY_SECONDS) table_wrap(j->tables[CLAIMS + i], page_width(j));
  }
}

static void say_totals(const job *j)
{
  static const char *const with[STUDY_ANSWERS] = {"", " with the settings of their source", " with ours"};
  const study_claims_tally *c = &j->claims;
  if (j->n > 1)
    table_note(j->tables[SUMMARY],
               "%d studies, %ld scenes: %.3g s of processor time, %.3g s of it with exact forces; %.3g s on the clock",
               j->n, j->scenes, j->seconds, j->exact_seconds, j->wall);
  for (int k = 0; k < STUDY_ANSWERS; ++k)
    if (c->agree[k] + c->disagree[k] + c->unsaid[k] > 0)
      table_note(j->tables[CLAIMS + (k == STUDY_PLAIN ? STUDY_CLAIMS : STUDY_SIDES)],
                 "%d claims agree%s, %d do not, of %d it cannot be said", c->agree[k], with[k], c->disagree[k],
                 c->unsaid[k]);
}

static int tell(job *j, int n_run)
{
  int code = 0;
  bool any_failed = false;
  make_tables(j);
  for (int i = 0; i < n_run && !code; ++i) {
    code = summarise(j, &j->tasks[i], &any_failed);
    if (!code && j->tasks[i].there == j->tasks[i].s->n_scenes) code = hold_claims(j, &j->tasks[i]);
  }
  say_totals(j);
  if (!code) code = write_tables(j);
  plot_order drawing = {.path = j->o.plot};
  int drawn = 0;
  if (!code && j->o.plot && n_run > 0)
    drawn = cli_plotted(&j->o, plot_study(&drawing, j->tasks[0].s, j->tasks[0].store, j->o.plot_y), drawing.why);
  for (int i = 0; i < N_TABLES; ++i) table_free(j->tables[i]);
  return code ? code : j->claims.unexpected ? EXIT_DISAGREED : any_failed ? EXIT_NO_SOLUTION : drawn;
}

/* Rank 0: run, then tell. A study that was stopped is not told of with --export: half of it would look like all. */
static int lead(job *j)
{
  int stopped = 0, n = 0;
  for (; n < j->n && !stopped; ++n) {
    cluster_agree(0);
    stopped = run_task(j, &j->tasks[n]);
  }
  if (stopped && n < j->n) cluster_agree(stopped);
  if (stopped && j->o.export) return stopped;
  int code = tell(j, n);
  return stopped ? stopped : code;
}

static bool go_on(void *self, double done)
{
  (void)self, (void)done;
  return !progress_interrupted();
}

static void follow(const job *j)
{
  hc_monitor monitor = {go_on, NULL};
  for (int n = 0; n < j->n && cluster_agree(0) == 0; ++n) cluster_work(j->tasks[n].s, &monitor);
}

int cmd_study(int argc, char **argv)
{
  job *j = calloc(1, sizeof *j);
  if (!j) {
    fprintf(stderr, "hbmcheck study: %s\n", hc_status_text(HC_NO_MEMORY));
    return EXIT_NO_SOLUTION;
  }
  bool lonely = !cluster_start(&j->rank, &j->size);
  cli_parse(argc, argv, "study", "STUDY...", doc, options, true, &j->o);
  int code = check_usage(j, lonely);
  if (!code) code = read_studies(j);
  if (!code && j->rank == 0) code = open_stores(j);
  int agreed = cluster_agree(code);
  if (!agreed && j->rank == 0) code = lead(j);
  else if (!agreed) follow(j);
  for (int i = 0; i < j->n; ++i) {
    study_store_close(j->tasks[i].store);
    study_free(j->tasks[i].s);
  }
  free(j);
  cluster_end();
  return code;
}
