/* cmd_report.c - hbmcheck report: the comparison as one HTML page. */
#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/duration.h"
#include "compare/output/output.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/proofs.h"
#include "interfaces/command/report/report.h"
#include "numerics/base/path.h"

static const char help[] =
    "You want to show a result: writes one HTML page about CASE: verdict and error budget in words, interactive "
    "plots, tables, what aliasing does to this case, and the resolved case and versions to make it again. It opens "
    "from disk and needs no network."
    "\vWithout --output the page is named after the case: case2.yaml gives case2.html in the current folder. The same "
    "input gives the same bytes.\n"
    "exit: as hbmcheck compare, 0 agree  1 a transient differs from every HBM solution  2 case file wrong  3 "
    "something could not be compared  64 usage\n"
    "example: hbmcheck report cases/paper/case2.yaml --output case2.html";

typedef struct report_options {
  number_list at; /* n = 0: the case's */
  table_lists lists;
  bool prove;
} report_options;

static const cli_option options[] = {
    {CLI_LIST, "at", "LIST", "At these " CLI_FREQUENCIES " [compare.omega, else compare.points over the sweep]",
     offsetof(report_options, at)},
    {CLI_LIST, "harmonics", "LIST", "Truncation orders of the tables, 1..200 [compare.harmonics]",
     offsetof(report_options, lists.harmonics)},
    {CLI_LIST, "samples", "LIST", "Samples per period of the tables, at least 2 H + 2 [compare.samples]",
     offsetof(report_options, lists.samples)},
    {CLI_FLAG, "prove", NULL, "Also a table of proofs, as hbmcheck prove has it", offsetof(report_options, prove)},
    {0},
};

/* "case2.html" for cases/paper/case2.yaml, into text[size]. */
static const char *name_of_page(const char *path, char *text, size_t size)
{
  int stem;
  const char *name = path_name(path, &stem);
  if (!strcmp(path, "-")) snprintf(text, size, "report.html");
  else snprintf(text, size, "%.*s.html", stem, name);
  return text;
}

/* One word of a command line, in quotes where the shell needs them. */
static void write_word(FILE *to, const char *word)
{
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+@%";
  putc(' ', to);
  const bool quoted = !*word || strspn(word, plain) != strlen(word);
  if (quoted) putc('\'', to);
  for (; *word; ++word)
    if (*word == '\'') fputs("'\\''", to);
    else putc(*word, to);
  if (quoted) putc('\'', to);
}

static void write_list(FILE *to, const char *option, const number_list *list)
{
  if (list->n) fprintf(to, " --%s ", option);
  for (int i = 0; i < list->n; ++i) fprintf(to, "%s%.15g", i ? "," : "", list->v[i]);
}

static void write_sets(FILE *to, const cli_common *common)
{
  for (int i = 0; i < common->n_set; ++i) {
    fputs(" --set", to);
    write_word(to, common->set[i]);
  }
}

static hc_status write_page(const cli_common *common, const report_options *own, const report_data *d, const char *path)
{
  char settings[256], hbm[96], law[64] = "exact contact law", *text = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&text, &size);
  if (!to) return HC_NO_MEMORY;
  /* The command line that makes this page again, that of the lab, and the versions, each with its end. */
  fputs("hbmcheck report", to);
  write_word(to, common->arguments[0]);
  write_list(to, "at", &own->at);
  write_list(to, "harmonics", &own->lists.harmonics);
  write_list(to, "samples", &own->lists.samples);
  if (own->prove) fputs(" --prove", to);
  write_sets(to, common);
  fputc(0, to);
  fputs("hbmcheck lab --case", to);
  write_word(to, common->arguments[0]);
  write_sets(to, common);
  fputc(0, to);
  cli_print_version(to, NULL);
  const bool failed = ferror(to);
  hc_status st = fclose(to) == 0 && !failed ? HC_OK : HC_NO_MEMORY;
  const transient_settings *t = &d->sc->transient;
  if (t->law != TRANSIENT_LAW_EXACT) snprintf(law, sizeof law, "regularised contact law, %g", t->regularisation);
  cli_hbm_settings(d->sc, d->comparison.harmonics, d->comparison.samples, hbm, sizeof hbm);
  snprintf(settings, sizeof settings, "Harmonic balance: %s. Time integration: %s, to %g of the steady state.", hbm,
           law, t->tolerance);
  output *out = NULL;
  if (st == HC_OK) st = output_open(path, &out);
  if (st == HC_OK) {
    const char *lab = text + strlen(text) + 1, *versions = lab + strlen(lab) + 1;
    st = output_finish(out, report_write(d, &(report_origin){text, lab, versions, settings}, output_stream(out)));
  }
  free(text);
  return st;
}

static void foretell_time(const cli_common *common, const scene *sc)
{
  duration_units u;
  compare_setup setup;
  if (common->quiet) return;
  if (scene_setup(sc, &setup) == HC_OK) {
    duration_measure(&setup, &u);
    const int n = duration_frequencies(&setup);
    cli_foretell_time(common, duration_of_report(&u, n, &setup.compare), n, setup.model);
  }
  scene_setup_clear(&setup);
}

static int run_report(cli_common *common, void *given, scene *sc)
{
  const report_options *own = given;
  report_data d;
  char name[512];
  const char *path = common->output ? common->output : name_of_page(common->arguments[0], name, sizeof name);
  if (common->format != FORMAT_TABLE)
    return cli_failed(common, EXIT_USAGE,
                      "a report is HTML: --format does not apply; hbmcheck compare has csv and json");
  if (!report_has_charts())
    return cli_failed(common, EXIT_USAGE,
                      "built without Chart.js, which draws the plots: install it (Debian: libjs-chart.js) and build "
                      "again");
  int code = cli_check_files(common, !common->output, &(cli_file){"the page", path, CLI_OUTPUT});
  if (!code) code = cli_load_case(common, common->arguments[0], sc, &(case_error){{0}});
  if (!code) code = compare_lists(common, &own->lists, sc);
  if (!code) code = cli_take_frequencies(common, &own->at, true, sc);
  if (code) return code;
  foretell_time(common, sc);
  progress *bar = progress_start("comparing", common->quiet);
  hc_status st = report_gather(sc, cli_processors(), bar, &d);
  const hc_monitor monitor = progress_monitor(bar);
  progress_relabel(bar, "proving");
  const hc_status proved = st == HC_OK && own->prove ? prove_run(sc, &d.setup, &monitor, NULL, NULL, &d.proofs) : HC_OK;
  const int error = errno;
  progress_end(bar);
  if (proved != HC_OK) {
    code = proofs_ended(common, d.proofs.curve_end, proved, error);
    report_clear(&d);
    return code;
  }
  if (st == HC_INTERRUPTED) code = cli_failed(common, EXIT_NO_SOLUTION, "stopped on request; no page was written");
  else if (st != HC_OK) code = cli_solver_failed(common, CLI_BOTH, "the report", st, 0);
  else if ((st = write_page(common, own, &d, path)) == HC_OK) {
    code = comparison_exit_code(&d.comparison);
    if (!common->quiet) cli_message(common, "wrote %s", path);
  } else code = cli_file_failed(common, path, st);
  report_clear(&d);
  return code;
}

CLI_COMMAND(report, report_options, "CASE",
            "one self-contained HTML page: verdict in words, plots, tables, what aliasing does", .starts_itself = true);
