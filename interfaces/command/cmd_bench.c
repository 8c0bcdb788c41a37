/* cmd_bench.c - hbmcheck bench: work against precision. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "compare/accuracy/bench.h"
#include "compare/output/progress.h"
#include "interfaces/command/commands.h"

static const char help[] =
    "You choose a method: time against error of harmonic balance with exact and sampled forces, and of time "
    "integration with both laws, by shooting and by marching, at the largest stable response of CASE at each omega; "
    "scipy's LSODA beside them where python3 has it."
    "\vThe error is of the amplitude, relative to the exact law's orbit; of a structure the largest of all "
    "responses, relative to the largest amplitude. Seconds are processor time of one solution at that omega from its "
    "neighbour's in a sweep: median, lower and upper quartile. Methods take turns. error_finer is the largest error "
    "at these or finer settings: what can be counted on. front: nothing is both nearer by it and faster.\n"
    "exit: 0 done  2 case file wrong  3 no stable orbit to compare with, or stopped  64 usage\n"
    "example: hbmcheck bench cases/paper/case2.yaml --at 9";

typedef struct bench_command_options {
  number_list at; /* n = 0: where the response is largest */
  int repeats;    /* 1..MAX_REPEATS */
  bool alone;     /* --alone */
} bench_command_options;

enum { DEFAULT_REPEATS = 9, MAX_REPEATS = 1000 };

static const cli_option options[] = {
    {CLI_LIST, "at", "LIST",
     "Omegas, rad per unit time [of the case's compare frequencies the one where the response is largest]",
     offsetof(bench_command_options, at)},
    {CLI_INTEGER, "repeats", "N",
     "Times each method is measured; those that take long less often, as the column says [9]",
     offsetof(bench_command_options, repeats), 1, MAX_REPEATS},
    {CLI_FLAG, "alone", NULL, "No other programs beside our methods", offsetof(bench_command_options, alone)},
    CLI_PLOT_OPTION,
    {0},
};

static const table_column columns[] = {
    REAL("omega"),          REAL("frequency"), TEXT("method"), INTEGER("harmonics"),     INTEGER("samples"),
    REAL("regularisation"), REAL("tolerance"), REAL("error"),  REAL("error_harmonic_1"), REAL("error_finer"),
    REAL("seconds"),        REAL("low"),       REAL("high"),   INTEGER("repeats"),       TEXT("front"),
    REAL("curve_seconds"),  TEXT("outcome")};
static const table_column cheapest_columns[] = {
    REAL("omega"),       REAL("frequency"), REAL("accuracy"),    TEXT("method"),        TEXT("settings"),
    REAL("error_finer"), REAL("seconds"),   TEXT("next_method"), TEXT("next_settings"), REAL("times_faster")};
/* In cycles from the beginning on, else without omega. */
static const char *const spare_columns[] = {"omega",   "low",   "high",  "curve_seconds", "error_harmonic_1",
                                            "repeats", "error", "front", "outcome",       NULL},
                         *const spare_cheapest_columns[] = {"omega", "error_finer", "next_settings", NULL};
static const double accuracies[] = {1e-2, 1e-3, 1e-4, 1e-6, 1e-8};
enum { N_ACCURACIES = sizeof accuracies / sizeof *accuracies };

/* Rounded to three digits: those beyond are noise of the clock. NaN: not measured. */
static double rounded(double seconds)
{
  char text[32];
  snprintf(text, sizeof text, "%.3g", seconds);
  return seconds > 0 ? strtod(text, NULL) : NAN;
}

static void put_cheapest(table *t, const scene *sc, const bench *b, const bench_frequency *p)
{
  char settings[BENCH_TEXT], next[BENCH_TEXT];
  for (int i = 0; i < N_ACCURACIES; ++i) {
    const bench_row *second, *best = bench_cheapest(p->n, b->rows + p->first, accuracies[i], &second);
    TABLE_ROW(t, CELL(p->omega), CELL_OF(sc->in_cycles, scene_frequency(sc, p->omega)), CELL(accuracies[i]),
              CELL(best ? bench_method_name(best->method) : "none"), CELL(best ? bench_settings(best, settings) : NULL),
              CELL(best ? best->error_finer : NAN), CELL(best ? rounded(best->seconds) : NAN),
              CELL(second ? bench_method_name(second->method) : NULL),
              CELL(second ? bench_settings(second, next) : NULL),
              CELL(best && second ? rounded(second->seconds / best->seconds) : NAN));
  }
}

/* The fastest method for each accuracy, decade by decade: "hbm_exact from 1e-01 to 1e-06; ...". */
static void note_winners(table *t, const scene *sc, const bench *b, const bench_frequency *p)
{
  char text[512];
  size_t n = 0;
  const bench_row *second, *last = NULL;
  double first = 1e-1;
  for (int decade = -1; decade >= -13 && n < sizeof text - 96; --decade) {
    const bench_row *best =
        decade > -13 ? bench_cheapest(p->n, b->rows + p->first, 1.0000001 * pow(10, decade), &second) : NULL;
    if (decade < -1 && best && last && best->method == last->method) continue;
    if (last)
      n += (size_t)snprintf(text + n, sizeof text - n, "%s%s from %.0e to %.0e", n ? "; " : "",
                            bench_method_name(last->method), first, pow(10, decade + 1));
    first = pow(10, decade);
    if (!best) break;
    last = best;
  }
  if (n) table_note(t, "fastest at %s: %s", scene_where(sc, p->omega, (char[SCENE_WHERE]){0}), text);
}

/* Linux says it in /proc/cpuinfo; elsewhere the kind of machine has to do. */
static void processor(char *text, size_t size)
{
  char line[256];
  FILE *from = fopen("/proc/cpuinfo", "r");
  text[0] = 0;
  while (from && !text[0] && fgets(line, sizeof line, from)) {
    char *at = strncmp(line, "model name", 10) ? NULL : strstr(line, ": ");
    if (at) snprintf(text, size, "%.*s", (int)strcspn(at + 2, "\n"), at + 2);
  }
  if (from) fclose(from);
}

/* What the figures were measured on: processor, system, compiler. */
static void machine(char *text, int size)
{
  struct utsname name;
  char chip[160];
  processor(chip, sizeof chip);
  if (uname(&name) != 0) snprintf(name.sysname, sizeof name.sysname, "unknown"), name.release[0] = name.machine[0] = 0;
  snprintf(text, (size_t)size, "%s%s%s, %ld processors, %s, compiler %s", chip, chip[0] ? ", " : "", name.machine,
           sysconf(_SC_NPROCESSORS_ONLN), name.sysname, __VERSION__);
}

static void note_versions(table *t)
{
  char text[512], versions[512];
  machine(text, sizeof text);
  table_note(t, "%s", text);
  FILE *to = fmemopen(versions, sizeof versions, "w");
  if (!to) return;
  cli_print_version(to, NULL);
  fputc(0, to);
  fclose(to);
  for (char *at = versions; *at; ++at)
    if (*at == '\n') *at = at[1] ? ';' : ' ';
  table_note(t, "%s", versions);
}

static int write_tables(const cli_common *common, const scene *sc, const bench *b)
{
  const unsigned extra = cli_extra_columns(sc);
  table *tables[2] = {cli_own_table("Work and precision", extra, CLI_COLUMNS(columns)),
                      cli_own_table("Cheapest way", extra, CLI_COLUMNS(cheapest_columns))};
  for (int i = 0; i < 2 && b->n_frequencies == 1; ++i) table_hide(tables[i], "omega"); /* the remarks have it */
  table_spare(tables[0], spare_columns + !sc->in_cycles);
  table_spare(tables[1], spare_cheapest_columns + !sc->in_cycles);
  for (int i = 0; i < b->n_rows; ++i) {
    table *t = tables[0];
    const bench_row *r = &b->rows[i];
    TABLE_ROW(t, CELL(r->omega), CELL_OF(sc->in_cycles, scene_frequency(sc, r->omega)),
              CELL(bench_method_name(r->method)), CELL_IF(r->harmonics > 0, r->harmonics),
              CELL_IF(r->samples > 0, r->samples), CELL(r->regularisation), CELL(r->tolerance), CELL(r->error),
              CELL(r->error_harmonic_1), CELL(r->error_finer), CELL(r->repeats ? rounded(r->seconds) : NAN),
              CELL(rounded(r->low)), CELL(rounded(r->high)), CELL_IF(r->repeats > 0, r->repeats),
              CELL(r->front ? "yes" : "no"), CELL(rounded(r->curve_seconds)),
              CELL(r->outcome == BENCH_FAILED ? hc_status_text(r->status) : bench_outcome_name(r->outcome)));
  }
  table *t = tables[0];
  table_note(t, "%s", sc->title);
  for (int i = 0; i < b->n_frequencies; ++i) {
    const bench_frequency *p = &b->frequencies[i];
    char here[SCENE_WHERE], beside[SCENE_WHERE];
    scene_where(sc, p->omega, here);
    scene_where(sc, p->neighbour, beside);
    table_note(t,
               "%s: reference amplitude %.12g, good to %.0e, Floquet multiplier %.4g; all start from the solutions "
               "at %s",
               here, p->amplitude, p->floor, p->multiplier, beside);
    table_note(t, "%s: scipy_lsoda: %s", here, p->scipy);
  }
  table_note(
      t, "seconds: processor time of one solution and its measures; curve_seconds: the whole response curve over the "
         "sweep");
  table_note(
      t,
      "HBM: residual tolerance %g, harmonic 0 %s; transient: the tolerance is transient.tolerance; a solution is "
      "given up after %g s, by shooting %g s",
      sc->hbm.tolerance, sc->hbm.keep_mean ? "kept" : "NOT kept", bench_longest, bench_longest_shot);
  table_note(t, "AUTO-07p is not run from here: it wants its equations compiled (tests/bench/versus_auto.sh does)");
  note_versions(t);
  for (int i = 0; i < b->n_frequencies; ++i) {
    put_cheapest(tables[1], sc, b, &b->frequencies[i]);
    note_winners(tables[1], sc, b, &b->frequencies[i]);
  }
  return cli_write_all(common, 2, tables);
}

static int run_bench(cli_common *common, void *given, scene *sc)
{
  bench_command_options *own = given;
  bench b = {0};
  double failed_at = 0;
  int code = cli_take_frequencies(common, &own->at, true, sc);
  if (code) return code;
  if (own->at.n) own->at = sc->compare.omega;
  bench_options how = {.at = own->at, .repeats = own->repeats, .alone = own->alone};
  progress *bar = progress_start("benchmark", common->quiet);
  hc_monitor monitor = progress_monitor(bar);
  compare_setup setup;
  hc_status st = scene_setup(sc, &setup);
  if (st == HC_OK) st = bench_run(&setup, &how, &monitor, &b, &failed_at);
  scene_setup_clear(&setup);
  progress_end(bar);
  if (st == HC_NOT_CONVERGED)
    code = cli_failed(common, EXIT_NO_SOLUTION,
                      "%s: no stable orbit of the exact law next to a harmonic-balance solution, or none beside it; "
                      "try another --at",
                      scene_where(sc, failed_at, (char[SCENE_WHERE]){0}));
  else if (st != HC_OK) code = cli_solver_failed(common, CLI_BOTH, "the benchmark", st, failed_at);
  int written = b.n_rows ? write_tables(common, sc, &b) : 0;
  if (common->drawing.path && b.n_rows && !written) written = cli_plotted(common, plot_bench(&common->drawing, sc, &b));
  bench_clear(&b);
  return code ? code : written;
}

CLI_COMMAND(bench, bench_command_options, "CASE",
            "work-precision: run time against error for every method at one frequency",
            .defaults = &(const bench_command_options){.repeats = DEFAULT_REPEATS});
