/* cmd_report.c - hbmcheck report: the comparison as one HTML page. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command/cli.h"
#include "command/compare_tables.h"
#include "command/report/report.h"
#include "command/version.h"
#include "output/output.h"
#include "output/progress.h"

static const char doc[] =
    "Write one self-contained HTML page about CASE: verdict and error budget in words, interactive plots, the tables, "
    "what aliasing does to this "
    "case, and the resolved case and versions to make it again. It opens from disk and needs no network."
    "\vWithout --output the page is named after the case: case2.yaml gives case2.html in the current folder. The same "
    "input gives the same bytes.\n"
    "exit: as hbmcheck compare, 0 agree  1 a transient differs from every HBM solution  2 case file wrong  3 "
    "something could not be compared  64 usage\n"
    "example: hbmcheck report cases/paper/case2.yaml --output case2.html";

static const struct argp_option options[] = {
    {"at", CLI_AT, "LIST", 0, "Omegas, rad per unit time [compare.omega, else compare.points over the sweep]", 1},
    {"harmonics", CLI_HARMONICS, "LIST", 0, "Truncation orders of the tables, 1..200 [compare.harmonics]", 1},
    {"samples", CLI_SAMPLES, "LIST", 0, "Samples per period of the tables, at least 2 H + 2 [compare.samples]", 1},
    {0},
};

/* "case2.html" for cases/paper/case2.yaml, into text[size]. */
static const char *name_of_page(const char *path, char *text, size_t size)
{
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  const char *dot = strrchr(name, '.');
  int length = dot && dot != name ? (int)(dot - name) : (int)strlen(name);
  if (!strcmp(path, "-")) snprintf(text, size, "report.html");
  else snprintf(text, size, "%.*s.html", length, name);
  return text;
}

/* One word of a shell's command line. */
static void put_word(FILE *to, const char *word)
{
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+@%";
  putc(' ', to);
  if (*word && strspn(word, plain) == strlen(word)) {
    fputs(word, to);
    return;
  }
  putc('\'', to);
  for (; *word; ++word) {
    if (*word == '\'') fputs("'\\''", to);
    else putc(*word, to);
  }
  putc('\'', to);
}

static void put_list(FILE *to, const char *option, const number_list *list)
{
  if (list->n) fprintf(to, " --%s ", option);
  for (int i = 0; i < list->n; ++i) fprintf(to, "%s%.15g", i ? "," : "", list->v[i]);
}

/* What a person types to have this page again. */
static void put_command(FILE *to, const cli_options *o)
{
  fputs("hbmcheck report", to);
  put_word(to, o->argument);
  put_list(to, "at", &o->at);
  put_list(to, "harmonics", &o->harmonics);
  put_list(to, "samples", &o->samples);
  for (int i = 0; i < o->n_set; ++i) {
    fputs(" --set", to);
    put_word(to, o->set[i]);
  }
}

/* The texts of a report_origin, each in memory of its own; NULL: out of memory. */
static char *text_of(const cli_options *o)
{
  char *text = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&text, &size);
  if (!to) return NULL;
  if (o) put_command(to, o);
  else cli_print_version(to, NULL);
  bool whole = !ferror(to);
  if (fclose(to) == 0 && whole) return text;
  free(text);
  return NULL;
}

static void describe_settings(const report_data *d, char *text, size_t size)
{
  char hbm[96], law[64] = "exact contact law";
  const transient_settings *t = &d->sc->transient;
  if (t->law != TRANSIENT_LAW_EXACT) snprintf(law, sizeof law, "regularised contact law, %g", t->regularisation);
  cli_hbm_settings(d->sc, d->comparison.harmonics, d->comparison.samples, hbm, sizeof hbm);
  snprintf(text, size, "Harmonic balance: %s. Time integration: %s, to %g of the steady state.", hbm, law,
           t->tolerance);
}

static hc_status write_page(const cli_options *o, const report_data *d, const char *path)
{
  char settings[256], *command = text_of(o), *versions = text_of(NULL);
  output *out = NULL;
  describe_settings(d, settings, sizeof settings);
  hc_status st = command && versions ? output_open(path, &out) : HC_NO_MEMORY;
  if (st == HC_OK) {
    st = report_write(d, &(report_origin){command, versions, settings}, output_stream(out));
    if (st == HC_OK) st = output_commit(out);
    else output_abandon(out);
  }
  free(command);
  free(versions);
  return st;
}

static void announce(void *bar, const char *stage) { progress_relabel(bar, stage); }

/* 0, or the exit code after saying why there is no page. */
static int refuse(const cli_options *o)
{
  if (o->format != FORMAT_TABLE) {
    cli_say(o, "a report is HTML: --format does not apply; hbmcheck compare has csv and json");
    return EXIT_USAGE;
  }
  if (!report_has_charts()) {
    cli_say(o, "built without Chart.js, which draws the plots: install it (Debian: libjs-chart.js) and build again");
    return EXIT_USAGE;
  }
  return 0;
}

int cmd_report(int argc, char **argv)
{
  cli_options o;
  scene sc;
  report_data d;
  char name[512];
  cli_parse(argc, argv, "report", "CASE", doc, options, true, &o);
  int code = refuse(&o);
  if (!code) code = cli_load_case(&o, &sc);
  if (!code) code = compare_lists(&o, &sc);
  if (code) return code;
  if (o.at.n) sc.compare.omega = o.at;
  const char *path = o.output ? o.output : name_of_page(o.argument, name, sizeof name);
  progress *bar = progress_start("comparing", o.quiet);
  hc_monitor monitor = progress_monitor(bar);
  hc_status st = report_gather(&sc, &monitor, announce, bar, &d);
  progress_end(bar);
  if (st == HC_INTERRUPTED) {
    cli_say(&o, "stopped on request; no page was written");
    code = EXIT_NO_SOLUTION;
  } else if (st != HC_OK) code = cli_solver_failed(&o, "the report", st, 0);
  else if ((st = write_page(&o, &d, path)) == HC_OK) {
    code = comparison_exit_code(&d.comparison);
    if (!o.quiet) cli_say(&o, "wrote %s", path);
  } else {
    cli_say(&o, "%s: %s", path, st == HC_IO && errno ? strerror(errno) : hc_status_text(st));
    code = EXIT_NO_SOLUTION;
  }
  report_clear(&d);
  return code;
}
