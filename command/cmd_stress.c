/* cmd_stress.c - hbmcheck stress: random scenes, every method against every other. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/ascending.h"
#include "campaigns/stress/scenes.h"
#include "campaigns/stress/stress.h"
#include "cases/case_file.h"
#include "command/cli.h"
#include "output/output.h"
#include "output/progress.h"

static const char doc[] =
    "Draw scenes from a Sobol sequence over the whole range of every quantity, solve each by every method, and hold "
    "each against every other. Every "
    "check ends as agreed, explained (by a reason that was computed, too), refused (a solver said why) or a finding: "
    "two methods differ and nothing explains it."
    "\vSeed and index make a scene again: --first INDEX --scenes 1 --all runs it alone, --case prints its case file. "
    "With --results the same command goes "
    "on where it was stopped.\n"
    "exit: 0 no findings  1 findings  3 stopped, or a file could not be written  64 usage\n"
    "example: hbmcheck stress --scenes 200";

static const struct argp_option options[] = {
    {"scenes", CLI_SCENES, "N", 0, "How many scenes [200]", 1},
    {"seed", CLI_SEED, "N", 0, "Which sequence [1]", 1},
    {"first", CLI_FIRST, "INDEX", 0, "The first scene's place in the sequence [0]", 1},
    {"case", CLI_CASE, NULL, 0, "Run nothing: print the case file of the first scene", 1},
    {"all", CLI_ALL, NULL, 0, "Show every check of every scene", 1},
    {"findings", CLI_FINDINGS, "DIR", 0, "Shrink every finding, and keep it in DIR as a case file", 1},
    {"results", CLI_RESULTS, "FILE", 0, "Keep results in FILE as they come, and go on from what is there", 1},
    {"seconds", CLI_SECONDS, "S", 0, "Processor time for one check before it is given up as too dear [1]", 1},
    {"jobs", CLI_JOBS, "N", 0, "Scenes at once [one a processor]", 1},
    {0},
};

static const table_column check_columns[] = {
    {"check", TABLE_TEXT},        {"skipped", TABLE_INTEGER},    {"agreed", TABLE_INTEGER},
    {"explained", TABLE_INTEGER}, {"refused", TABLE_INTEGER},    {"findings", TABLE_INTEGER},
    {"median_error", TABLE_REAL}, {"largest_error", TABLE_REAL}, {"scene", TABLE_INTEGER},
    {"seconds", TABLE_REAL},      {"holds", TABLE_TEXT},
};
static const table_column reason_columns[] = {
    {"check", TABLE_TEXT},     {"outcome", TABLE_TEXT},        {"reason", TABLE_TEXT},
    {"scenes", TABLE_INTEGER}, {"one_of_them", TABLE_INTEGER}, {"meaning", TABLE_TEXT},
};
static const table_column scene_columns[] = {
    {"scene", TABLE_INTEGER}, {"check", TABLE_TEXT}, {"outcome", TABLE_TEXT}, {"reason", TABLE_TEXT},
    {"error", TABLE_REAL},    {"bound", TABLE_REAL}, {"why", TABLE_TEXT},
};
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

typedef struct job {
  cli_options o;
  stress_plan plan;
  stress_result *results; /* [plan.scenes] */
  long there, resumed, findings;
} job;

/* ---- telling ---- */

/* Errors of what agreed: their median and largest. */
static void put_errors(const job *j, int kind, table *t)
{
  double *errors = malloc((size_t)j->plan.scenes * sizeof *errors), largest = -1;
  long n = 0, at = -1;
  for (long i = 0; errors && i < j->plan.scenes; ++i) {
    const stress_check *c = &j->results[i].check[kind];
    if (!j->results[i].there || c->outcome != STRESS_AGREED) continue;
    errors[n++] = c->error;
    if (c->error > largest) largest = c->error, at = j->results[i].index;
  }
  if (n > 0) qsort(errors, (size_t)n, sizeof *errors, ascending);
  table_put_real(t, n > 0 ? errors[n / 2] : NAN);
  table_put_real(t, n > 0 ? largest : NAN);
  if (n > 0) table_put_integer(t, at);
  else table_put_missing(t);
  free(errors);
}

static table *checks_table(job *j)
{
  table *t = table_new("Checks", COUNT(check_columns), check_columns);
  for (int k = 0; k < STRESS_N_CHECKS; ++k) {
    long count[STRESS_N_OUTCOMES] = {0};
    double seconds = 0;
    for (long i = 0; i < j->plan.scenes; ++i) {
      if (!j->results[i].there) continue;
      ++count[j->results[i].check[k].outcome];
      seconds += j->results[i].check[k].seconds;
    }
    table_put_text(t, stress_kind_name((stress_kind)k));
    for (int o = 0; o < STRESS_N_OUTCOMES; ++o) table_put_integer(t, count[o]);
    put_errors(j, k, t);
    table_put_real(t, seconds);
    table_put_text(t, stress_kind_meaning((stress_kind)k));
    j->findings += count[STRESS_FINDING];
  }
  return t;
}

static const char *why(const stress_check *c)
{
  return c->outcome == STRESS_REFUSED ? hc_status_text(c->status) : stress_reason_meaning(c->reason);
}

/* Everything that did not simply agree, by reason. */
static table *reasons_table(const job *j)
{
  table *t = table_new("Reasons", COUNT(reason_columns), reason_columns);
  for (int k = 0; k < STRESS_N_CHECKS; ++k)
    for (int o = 0; o < STRESS_N_OUTCOMES; ++o)
      for (int r = 0; r < STRESS_N_REASONS; ++r)
        for (int st = HC_OK; st <= HC_BUG; ++st) {
          const stress_check *one = NULL;
          long n = 0, index = 0;
          for (long i = 0; i < j->plan.scenes; ++i) {
            const stress_check *c = &j->results[i].check[k];
            if (!j->results[i].there || o == STRESS_AGREED || (int)c->outcome != o || (int)c->reason != r ||
                (int)c->status != st)
              continue;
            if (n++ == 0) one = c, index = j->results[i].index;
          }
          if (n == 0) continue;
          table_put_text(t, stress_kind_name((stress_kind)k));
          table_put_text(t, stress_outcome_name((stress_outcome)o));
          table_put_text(t, stress_reason_name((stress_reason)r));
          table_put_integer(t, n);
          table_put_integer(t, index);
          table_put_text(t, why(one));
        }
  return t;
}

static void put_scene(table *t, long index, int kind, const stress_check *c)
{
  table_put_integer(t, index);
  table_put_text(t, stress_kind_name((stress_kind)kind));
  table_put_text(t, stress_outcome_name(c->outcome));
  table_put_text(t, stress_reason_name(c->reason));
  table_put_real(t, c->error);
  table_put_real(t, c->bound);
  table_put_text(t, c->outcome == STRESS_AGREED ? "" : why(c));
}

/* The findings, or with --all everything. */
static table *scenes_table(const job *j)
{
  table *t = table_new(j->o.all ? "Scenes" : "Findings", COUNT(scene_columns), scene_columns);
  for (long i = 0; i < j->plan.scenes; ++i)
    for (int k = 0; k < STRESS_N_CHECKS && j->results[i].there; ++k)
      if (j->o.all || j->results[i].check[k].outcome == STRESS_FINDING)
        put_scene(t, j->results[i].index, k, &j->results[i].check[k]);
  return t;
}

static void note_totals(const job *j, table *t)
{
  double total = 0, slowest = -1;
  long at = 0;
  for (long i = 0; i < j->plan.scenes; ++i) {
    const stress_result *r = &j->results[i];
    if (!r->there) continue;
    total += r->seconds;
    if (r->seconds > slowest) slowest = r->seconds, at = r->index;
  }
  table_note(t, "%ld scenes of seed %lu from %ld on: %ld findings, %ld scenes never classified", j->there, j->plan.seed,
             j->plan.first, j->findings, j->plan.scenes - j->there);
  if (j->there > 0) table_note(t, "%.4g s of processor time; slowest: scene %ld, %.3g s", total, at, slowest);
  table_note(t, "errors are those of what agreed; again: hbmcheck stress --seed %lu --first SCENE --scenes 1 --all",
             j->plan.seed);
}

static int tell(job *j)
{
  table *tables[3] = {checks_table(j), reasons_table(j), scenes_table(j)};
  note_totals(j, tables[0]);
  int code = cli_write(&j->o, table_rows(tables[2]) > 0 ? 3 : 2, tables);
  for (int i = 0; i < 3; ++i) table_free(tables[i]);
  return code ? code : j->findings > 0 ? EXIT_DISAGREED : EXIT_AGREED;
}

/* ---- scenes as case files ---- */

static hc_status scene_at(const job *j, long index, scene *sc)
{
  stress_scenes *scenes;
  hc_status st = stress_scenes_new(j->plan.seed, &scenes);
  if (st == HC_OK) st = stress_scenes_at(scenes, index, sc);
  stress_scenes_free(scenes);
  return st;
}

/* `comment`, of one line or empty, and the scene into a file, or to standard output. 0 or the exit code after saying
 * why. */
static int write_case(const job *j, const char *path, const char *comment, const scene *sc)
{
  output *out = NULL;
  hc_status st = output_open(path, &out);
  if (st == HC_OK) {
    fputs(comment, output_stream(out));
    st = case_echo(sc, output_stream(out));
    if (st == HC_OK) st = output_commit(out);
    else output_abandon(out);
  }
  if (st == HC_OK) return 0;
  cli_say(&j->o, "%s: %s", path ? path : "standard output",
          st == HC_IO && errno ? strerror(errno) : hc_status_text(st));
  return EXIT_NO_SOLUTION;
}

static int print_case(const job *j)
{
  scene sc;
  hc_status st = scene_at(j, j->plan.first, &sc);
  return st == HC_OK ? write_case(j, j->o.output, "", &sc) : cli_solver_failed(&j->o, "the sequence", st, 0);
}

static int keep_finding(const job *j, long index, stress_kind kind, const hc_monitor *monitor)
{
  scene sc;
  char path[4096], comment[512];
  hc_status st = scene_at(j, index, &sc);
  if (st == HC_OK) st = stress_shrink(&sc, kind, j->plan.seconds, monitor);
  if (st != HC_OK && st != HC_INTERRUPTED) return cli_solver_failed(&j->o, "shrinking", st, 0);
  snprintf(path, sizeof path, "%s/stress-%lu-%ld-%s.yaml", j->o.findings, j->plan.seed, index, stress_kind_name(kind));
  snprintf(
      comment, sizeof comment,
      "# Found by hbmcheck stress --seed %lu --first %ld --scenes 1, and made smaller: %s.\n# It should hold that: "
      "%s.\n",
      j->plan.seed, index, stress_kind_name(kind), stress_kind_meaning(kind));
  return write_case(j, path, comment, &sc);
}

static int keep_findings(const job *j)
{
  int code = 0;
  progress *bar = progress_start("shrinking findings", j->o.quiet);
  const hc_monitor monitor = progress_monitor(bar);
  for (long i = 0; i < j->plan.scenes && !code; ++i)
    for (int k = 0; k < STRESS_N_CHECKS && !code; ++k)
      if (j->results[i].there && j->results[i].check[k].outcome == STRESS_FINDING)
        code = keep_finding(j, j->results[i].index, (stress_kind)k, &monitor);
  progress_end(bar);
  return code;
}

/* ---- running ---- */

typedef struct watcher {
  progress *bar;
  hc_monitor monitor;
} watcher;

static bool watch(void *self, long done, long scenes)
{
  watcher *w = self;
  char label[64];
  snprintf(label, sizeof label, "%ld of %ld scenes", done, scenes);
  progress_relabel(w->bar, label);
  return hc_monitor_tick(&w->monitor, (double)done / (double)scenes);
}

static int run(job *j)
{
  watcher w = {.bar = progress_start("stress", j->o.quiet)};
  w.monitor = progress_monitor(w.bar);
  const stress_watch watching = {watch, &w};
  hc_status st = stress_run(&j->plan, &watching, j->results, &j->resumed);
  int why_not = errno;
  progress_end(w.bar);
  for (long i = 0; i < j->plan.scenes; ++i) j->there += j->results[i].there;
  if (st == HC_OK) return 0;
  if (st == HC_BAD_INPUT || st == HC_UNSUPPORTED) {
    cli_say(&j->o, "%s: %s, expected those or a new file", j->plan.journal,
            st == HC_BAD_INPUT ? "not the results of this seed and these --seconds, or damaged"
                               : "not the results of this version of hbmcheck with its checks and reasons");
    return EXIT_BAD_CASE;
  }
  if (st == HC_IO) cli_say(&j->o, "%s: %s", j->plan.journal, strerror(why_not));
  else if (st == HC_INTERRUPTED)
    cli_say(&j->o, "stopped on request after %ld of %ld scenes%s", j->there, j->plan.scenes,
            j->plan.journal ? "; the same command goes on from there" : "; --results FILE would keep them");
  else return cli_solver_failed(&j->o, "stress", st, 0);
  return EXIT_NO_SOLUTION;
}

int cmd_stress(int argc, char **argv)
{
  job j = {.there = 0};
  cli_parse(argc, argv, "stress", "", doc, options, false, &j.o);
  if (j.o.n_set) {
    cli_say(&j.o, "--set has no case file to set anything in");
    return EXIT_USAGE;
  }
  long online = sysconf(_SC_NPROCESSORS_ONLN);
  j.plan = (stress_plan){.seed = j.o.seed >= 0 ? (unsigned long)j.o.seed : 1,
                         .first = j.o.first,
                         .scenes = j.o.scenes ? j.o.scenes : 200,
                         .jobs = j.o.jobs                ? j.o.jobs
                                 : online < 1            ? 1
                                 : online > CLI_MAX_JOBS ? CLI_MAX_JOBS
                                                         : (int)online,
                         .seconds = j.o.seconds > 0 ? j.o.seconds : 1,
                         .journal = j.o.results};
  if (j.o.one_case) return print_case(&j);
  if (j.o.findings && mkdir(j.o.findings, 0777) != 0 && errno != EEXIST) {
    cli_say(&j.o, "%s: %s", j.o.findings, strerror(errno));
    return EXIT_NO_SOLUTION;
  }
  if (!(j.results = calloc((size_t)j.plan.scenes, sizeof *j.results)))
    return cli_solver_failed(&j.o, "stress", HC_NO_MEMORY, 0);
  int stopped = run(&j), code = stopped && j.there == 0 ? stopped : tell(&j);
  if (!stopped && j.o.findings && code == EXIT_DISAGREED) {
    int kept = keep_findings(&j);
    if (kept) code = kept;
  }
  free(j.results);
  return stopped ? stopped : code;
}
