/* cmd_compare.c - hbmcheck compare: harmonic balance and time integration at the same frequencies. */
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "compare/comparison.h"
#include "compare/duration.h"
#include "compare/gate/gate.h"
#include "compare/memory.h"
#include "compare/output/progress.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/keep_found.h"
#include "interfaces/command/proofs.h"
#include "model/casefile/structure.h"

static const char help[] =
    "You want to know whether an HBM result of your case is right: solves CASE by harmonic balance and by time "
    "integration at the same frequencies; how far apart they are, and a verdict, for every frequency and branch."
    "\vAn error is |hbm - transient| / the transient's amplitude; the limits are the case's gate. from_aliasing, ... "
    "say what it is made of: one part a cause, all of them sizes. hbm_predicted and transient_predicted are the "
    "errors in amplitude that each side expects of itself before it sees the other; more than three times both is "
    "said to be unexpected.\n"
    "--tables adds a table over truncation orders and samples (largest amplitude discrepancy, peak, false turning "
    "points, cost) and one of observed orders; it takes seconds, and with csv they follow the first after a blank "
    "line. The screen shows the columns that fit; --wide, csv and json have all of them.\n"
    "exit: 0 agreed  1 a transient differs from every HBM solution  2 case file wrong  3 something could not be "
    "compared  64 usage\n"
    "example: hbmcheck compare cases/paper/case2.yaml --set hbm.static=false";

typedef struct compare_options {
  number_list at;       /* n = 0: the case's */
  bool tables;          /* --tables */
  bool contacts;        /* --contacts */
  bool prove;           /* --prove */
  const char *response; /* NULL: all of them */
  int survey;           /* starts at each frequency; 0: none */
  table_lists lists;    /* one that is not empty implies tables */
} compare_options;

static const cli_option options[] = {
    {CLI_LIST, "at", "LIST", "At these " CLI_FREQUENCIES " [compare.omega, else compare.points over the sweep]",
     offsetof(compare_options, at)},
    {CLI_FLAG, "tables", NULL, "Also the tables over truncation orders and samples, and observed orders",
     offsetof(compare_options, tables)},
    {CLI_LIST, "harmonics", "LIST", "Truncation orders of the tables, 1..200 [compare.harmonics]; implies --tables",
     offsetof(compare_options, lists.harmonics)},
    {CLI_LIST, "samples", "LIST",
     "Samples per period of the tables, at least 2 H + 2 [compare.samples]; implies --tables",
     offsetof(compare_options, lists.samples)},
    CLI_RESPONSE_OPTION(compare_options),
    {CLI_FLAG, "contacts", NULL, "A table of the contacts: what each does on both sides, and how far off",
     offsetof(compare_options, contacts)},
    {CLI_FLAG, "prove", NULL, "A table of proofs at the same frequencies, as hbmcheck prove has it",
     offsetof(compare_options, prove)},
    {CLI_INTEGER, "survey", "N", "Also where N drawn starts go (hbmcheck survey)", offsetof(compare_options, survey), 1,
     SURVEY_MOST_STARTS},
    CLI_PLOT_OPTION,
    {0},
};

/* "omega = 7, branch 0" and, of a structure, ", tip" into text[WHERE], which is returned. */
enum { WHERE = SCENE_WHERE + RESPONSE_NAME + 32 };
static const char *row_where(const scene *sc, const comparison_row *r, char text[WHERE])
{
  char at[SCENE_WHERE];
  snprintf(text, WHERE, "%s, branch %d%s%s", scene_where(sc, r->omega, at), r->branch, *r->response_name ? ", " : "",
           r->response_name);
  return text;
}

/* What neither side expected, a line a row: under the table if there is one, else on stderr. */
static void say_unexpected(const cli_common *common, const comparison *c, table *t)
{
  char text[COMPARISON_UNEXPECTED_TEXT], at[WHERE];
  for (int i = 0; i < c->n_rows; ++i) {
    if (!c->rows[i].unexpected) continue;
    row_where(common->scene, &c->rows[i], at);
    comparison_unexpected_text(&c->rows[i], text);
    if (t) table_note(t, "UNEXPECTED at %s: %s", at, text);
    else cli_message(common, "at %s: %s", at, text);
  }
}

/* Says why rows failed, and why the curve ended early: because the body creeps there, unless in_haste, which asks only
 * the rows. */
static void print_failures(const cli_common *common, const comparison *c, bool in_haste)
{
  bool creeps = false;
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    creeps |= r->transient_status == HC_CREEPS;
    if (r->transient_status == HC_CREEPS) cli_creeps(common, r->omega, r->response_name, r->transient.drift);
    else if (r->hbm_status != HC_OK && r->transient_status != HC_UNBOUNDED)
      cli_solver_failed(common, CLI_HBM, "harmonic balance", r->hbm_status, r->omega);
    else if (r->transient_status != HC_OK && r->transient_status != HC_APERIODIC)
      cli_solver_failed(common, CLI_TRANSIENT, "time integration", r->transient_status, r->omega);
  }
  const hc_status end = c->curve.end;
  if (end == HC_OK || c->curve.n == 0) return;
  char name[RESPONSE_NAME] = "";
  double drift;
  const double past = cli_past(common->scene, c->curve.ends_at);
  const bool given_up = in_haste || end == HC_NO_MEMORY || end == HC_INTERRUPTED || end == HC_UNBOUNDED;
  if (!creeps && !given_up && cli_it_creeps(common->scene, past, NULL, name, &drift))
    cli_creeps(common, past, name, drift);
  else cli_solver_failed(common, CLI_HBM, "the HBM response curve", creeps ? HC_CREEPS : end, c->curve.ends_at);
}

/* "3 rows without ...": where there are such rows. */
static void note_rows(table *t, int n, const char *what)
{
  if (n) table_note(t, "%d row%s %s", n, n == 1 ? "" : "s", what);
}

static table *contacts_table(const cli_common *common, comparison *c)
{
  const scene *sc = common->scene;
  table *t = cli_table(common, "Contacts", ROWS_COMPARE_CONTACT);
  for (int i = 0; i < c->n_contacts; ++i) {
    contact_comparison *k = &c->contacts[i];
    snprintf(k->name, sizeof k->name, "%s", scene_contact_at(sc, k->contact)->name);
    cli_put_row(common, t, ROWS_COMPARE_CONTACT, k);
  }
  table_note(
      t,
      "work: dissipated in a period, work_error relative to the largest there; beyond the gate's waveform it differs");
  if (sc->hbm.force == HBM_FORCE_SAMPLED)
    table_note(t, "harmonic balance's by the exact law along the motion found with sampled forces");
  /* Contacts that do not do the same on both sides, a line each: under the table and on stderr. */
  char text[CONTACT_COMPARISON_TEXT], at[SCENE_WHERE];
  int unknown = 0;
  for (int i = 0; i < c->n_contacts; ++i) {
    const contact_comparison *k = &c->contacts[i];
    unknown += k->hbm_status != HC_OK || k->transient_status != HC_OK;
    if (!k->differs) continue;
    contact_comparison_text(k, text);
    scene_where(common->scene, k->omega, at);
    table_note(t, "DIFFERS at %s, branch %d: %s", at, k->branch, text);
    cli_message(common, "at %s, branch %d: %s", at, k->branch, text);
  }
  note_rows(t, unknown, "of which one side is not known");
  return t;
}

/* The table over (H, N) and the one of observed orders into out[], which the caller frees; on failure they have the
 * rows found before. *a gets what they were made from, to be freed with accuracy_clear in any case. */
static hc_status compare_tables(const cli_common *common, const compare_setup *setup, const comparison *c,
                                const hc_monitor *monitor, table *out[2], accuracy *a)
{
  hc_status st = accuracy_run(setup, c, monitor, a);
  out[0] = cli_table(common, "Samples and truncation order", ROWS_ACCURACY);
  for (int i = 0; i < a->n_rows; ++i) cli_put_row(common, out[0], ROWS_ACCURACY, &a->rows[i]);
  table *t = out[0];
  char of[RESPONSE_NAME];
  if (!scene_is_oscillator(common->scene))
    table_note(t, "by the response %s", structure_response_name(common->scene->structure, 0, of, sizeof of));
  table_note(
      t,
      "amplitude_error: largest over %d orbits of the exact transient at %d frequencies; missing: orbits no solution "
      "is next to",
      a->orbits, a->frequencies);
  if (isfinite(a->peak_amplitude))
    table_note(t, "peak: %.10g at %s, %s", a->peak_amplitude,
               scene_where(common->scene, a->peak_omega, (char[SCENE_WHERE]){0}),
               a->peak_by_orbit ? "of the exact transient's orbits"
                                : "of the curve with exact forces and most harmonics");
  table_note(
      t,
      "aliasing: against exact forces and the same H; false turning points: more than with exact forces and the same "
      "H");
  out[1] = cli_table(common, "Observed orders", ROWS_ORDER);
  for (int i = 0; i < a->n_orders; ++i) cli_put_row(common, out[1], ROWS_ORDER, &a->orders[i]);
  table_note(out[1],
             "error ~ quantity^-order (regularisation^order), least squares over the asymptotic part of its envelope; "
             "spread: standard error");
  for (int i = 0; i < 2 && st != HC_OK; ++i) table_note(out[i], "INCOMPLETE: %s", hc_status_text(st));
  return st;
}

/* Without rows yet: its remarks are those that are known before the first one. */
static table *table_of_rows(const cli_common *common, const comparison *c)
{
  const scene *sc = common->scene;
  table *t = cli_table(common, "HBM against time integration", ROWS_COMPARE);
  table_note(t, "%s", sc->title);
  char how[128];
  char law[64] = "exact law";
  if (sc->transient.law != TRANSIENT_LAW_EXACT)
    snprintf(law, sizeof law, "regularised law, %g", sc->transient.regularisation);
  table_note(t, "HBM: %s. Transient: %s, closure %g", cli_hbm_settings(sc, c->harmonics, c->samples, how, sizeof how),
             law, sc->transient.tolerance);
  table_note(t, "gate: amplitude %g, harmonic_1 %g, mean %g, waveform %g of the transient's amplitude",
             sc->gate.most.amplitude, sc->gate.most.harmonic_1, sc->gate.most.mean, sc->gate.most.waveform);
  if (c->curve.end != HC_OK && c->curve.n)
    table_note(t, "the HBM curve STOPPED at %s: %s", scene_where(sc, c->curve.ends_at, (char[SCENE_WHERE]){0}),
               hc_status_text(c->curve.end));
  table_notes_of_rows(t);
  return t;
}

/* The rows that t does not have; *c is not changed meanwhile but for their names. */
static void put_rows(const cli_common *common, comparison *c, table *t)
{
  const scene_structure *of = common->scene->structure;
  for (int i = table_rows(t); i < c->n_rows; ++i) {
    if (!of->is_oscillator) structure_response_name(of, c->rows[i].response, c->rows[i].response_name, RESPONSE_NAME);
    cli_put_row(common, t, ROWS_COMPARE, &c->rows[i]);
  }
}

/* "at omega = 8 of 200 starts: settled 68 % (branch 0, 13.870), settled 32 % (branch 2, 4.130)", a line a frequency. */
static void note_motions(const scene *sc, const comparison *c, int starts, table *t)
{
  enum { SHOWN = 6 };
  for (int i = 0, n; i < c->survey.n_rows; i += n) {
    char text[96 * SHOWN], where[SCENE_WHERE], word[24];
    size_t used = 0;
    const survey_row *first = &c->survey.rows[i];
    int shown = 0;
    for (n = 0; i + n < c->survey.n_rows; ++n) {
      const survey_row *r = first + n;
      if (r->steady.result.omega != first->steady.result.omega) break;
      if (r->steady.response != 0 || shown++ >= SHOWN) continue;
      used += (size_t)snprintf(text + used, sizeof text - used, "%s%s %.3g %%", used ? ", " : "",
                               steady_verdict_text(&r->steady, word), 100 * r->share);
      if (r->hbm_branch >= 0)
        used += (size_t)snprintf(text + used, sizeof text - used, " (branch %d, %.5g)", r->hbm_branch,
                                 r->steady.result.amplitude);
      else used += (size_t)snprintf(text + used, sizeof text - used, " (%.5g)", r->steady.result.amplitude);
    }
    table_note(t, "steady states at %s, of %d starts: %s%s", scene_where(sc, first->steady.result.omega, where), starts,
               text, shown > SHOWN ? ", and more (hbmcheck survey)" : "");
  }
}

/* Shown where a solution has a band. */
static const char *const band_columns[] = {"band_low", "band_high", "band_width", "band_kind", "from_history", NULL};

/* The tables of what was found, and that it is not all unless st is HC_OK; how many. */
static int tables_of_found(const cli_common *common, bool contacts, const compare_setup *setup, comparison *c,
                           hc_status st, table **tables)
{
  const scene *sc = common->scene;
  table *t = table_of_rows(common, c);
  const comparison_row *top = comparison_worst(c, setup->limits);
  double reduction = 0;
  int unaccounted = 0, beside = 0, unknown = 0, creeping = 0, mean_free = 0, family = 0, still = 0, bands = 0,
      at_least = 0;
  put_rows(common, c, t);
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    unknown += !r->budget.known && r->response == 0;
    unaccounted += comparison_unaccounted(r);
    beside += r->beside;
    mean_free += comparison_mean_free(r);
    creeping += r->transient_status == HC_CREEPS;
    family += r->family;
    still += r->still;
    bands += r->band.kind == BAND_EXACT || r->band.kind == BAND_AT_LEAST;
    at_least += r->band.kind == BAND_AT_LEAST;
    reduction = fmax(reduction, r->budget.reduction);
  }
  if (unaccounted)
    table_note(t, "%d transient%s NO HBM solution of this curve within the gate", unaccounted,
               unaccounted == 1 ? " matches" : "s match");
  note_rows(t, beside, "whose transient runs on an HBM solution that this curve has not come to");
  for (int v = 0; v < VERDICT_COUNT; ++v)
    if (c->count[v]) table_note(t, "%d %s: %s", c->count[v], verdict_name((verdict)v), verdict_meaning((verdict)v));
  char text[COMPARISON_WORST_TEXT], at[WHERE];
  if (top)
    table_note(t, "largest budget, %s: %s", row_where(sc, top, at), comparison_worst_text(c, top, setup->limits, text));
  if (setup->reduction > 0)
    table_note(t, "a reduced model: the error of %.2g that structure.reduction states moves amplitudes by up to %.2g%s",
               setup->reduction, reduction, reduction > sc->gate.most.amplitude ? ", MORE THAN THE GATE" : "");
  else table_hide(t, "from_reduction");
  note_rows(t, unknown, "without a budget: no periodic orbit was found next to the HBM solution");
  say_unexpected(common, c, t);
  if (creeping == 0) table_hide(t, "drift");
  if (mean_free == 0) table_hide(t, "mean_free");
  note_rows(t, mean_free,
            "without a mean to compare (mean_free): a slider that never slips rests where the history left it, and the "
            "mean, max, min and rms with it");
  for (const char *const *name = band_columns; bands == 0 && *name; ++name) table_hide(t, *name);
  if (setup->survey) note_motions(sc, c, setup->survey, t);
  else table_hide(t, "others");
  note_rows(t, at_least, "whose band may be wider: several sliders never slip, or a member could not be followed");
  note_rows(t, family,
            "of a family of steady states: where a slider that never slips rests decides on the harmonics, too. HBM is "
            "compared with the one whose sliders start where its own do");
  note_rows(t, still, "not compared: that response moves less than 1e-9 of the largest");
  if (scene_adrift(sc)) table_note(t, "%s", SCENE_ADRIFT);
  if (!comparison_nonlinear(c)) table_note(t, COMPARISON_LINEAR, c->n_rows);
  if (st != HC_OK) table_note(t, "INCOMPLETE: %s", hc_status_text(st));
  tables[0] = t;
  if (contacts) tables[1] = contacts_table(common, c);
  return 1 + contacts;
}

/* What `hbmcheck gate` says of these rows, in numbers: for programs. */
static table *gate_table(const cli_common *common, const compare_setup *setup, const comparison *c)
{
  static const table_column columns[] = {INTEGER("checks"), INTEGER("failed"), INTEGER("errors"),
                                         INTEGER("not_applicable"), INTEGER("exit_code")};
  gate_case g;
  const hc_status st = gate_judge("", setup, c, &g);
  table *t = table_new("Gate", CLI_COLUMNS(columns));
  TABLE_ROW(t, CELL(g.n), CELL(g.failures), CELL(g.errors), CELL(g.not_applicable), CELL(gate_exit_code(1, &g)));
  cli_ended(common, st);
  gate_clear(&g);
  return t;
}

typedef struct found_rows {
  const cli_common *common;
  const compare_setup *setup;
  comparison *c;
  keep_found beside;
  shown_rows shown;
} found_rows;

static int write_found(void *self)
{
  found_rows *f = self;
  table *tables[2];
  if (f->c->n_rows == 0) return -1;
  const int n = tables_of_found(f->common, f->setup->contacts, f->setup, f->c, HC_INTERRUPTED, tables);
  const int code = cli_solver_failed(f->common, CLI_BOTH, "the comparison", HC_INTERRUPTED, 0);
  print_failures(f->common, f->c, true);
  pthread_mutex_lock(&f->shown.writing);
  const int written = cli_write_rest(f->common, n, tables, &f->shown.begun);
  return code ? code : written;
}

/* For compare_setup.added. */
static void show_found(void *self)
{
  found_rows *f = self;
  pthread_mutex_lock(&f->beside.found);
  if (!f->shown.rows) f->shown.rows = table_of_rows(f->common, f->c);
  put_rows(f->common, f->c, f->shown.rows);
  pthread_mutex_unlock(&f->beside.found);
  shown_rows_write(&f->shown, f->common);
}

static void foretell_time(const cli_common *common, const compare_setup *setup, bool with_tables)
{
  duration_units u;
  if (!cli_foretells(common)) return;
  duration_measure(setup, &u);
  const int n = duration_frequencies(setup);
  const double tables = with_tables ? duration_of_tables(&u, &setup->compare) : 0;
  cli_foretell_time(common, duration_of_comparison(&u, n) + tables, n, setup->model);
}

static int run_compare(cli_common *common, void *given, scene *sc)
{
  const compare_options *own = given;
  comparison c = {0};
  accuracy a = {0};
  proofs p = {0};
  table *tables[6] = {NULL};
  int code = compare_lists(common, &own->lists, sc);
  if (!code) code = cli_keep_response(common, sc, own->response);
  if (!code) code = cli_take_frequencies(common, &own->at, true, sc);
  if (code) return code;
  compare_setup setup;
  hc_status st = scene_setup(sc, &setup), tabled = HC_OK;
  const bool with_tables = own->tables || own->lists.harmonics.n || own->lists.samples.n;
  if (st == HC_OK) cli_foretell_memory(common, memory_of_comparison(&setup));
  if (st == HC_OK) foretell_time(common, &setup, with_tables);
  progress *bar = cli_progress(common, "comparing");
  hc_monitor monitor = progress_monitor(bar);
  setup.jobs = cli_jobs(common);
  setup.contacts = own->contacts;
  setup.advise = true;
  setup.survey = own->survey;
  setup.spare = !cli_reads(common, ROWS_COMPARE, "from_integration");
  setup.multipliers = cli_reads(common, ROWS_COMPARE, "multiplier");
  found_rows found = {.common = common, .setup = &setup, .c = &c};
  shown_rows_begin(&found.shown, own->contacts || with_tables || own->prove);
  keep_found_begin(&found.beside, common, write_found, &found);
  setup.found = &found.beside.found;
  if (cli_shows_rows(common)) setup.added = show_found, setup.added_to = &found;
  if (st == HC_OK) st = comparison_run(&setup, &monitor, &c);
  setup.found = NULL;
  setup.added = NULL;
  pthread_mutex_lock(&found.beside.found);
  int n_tables = tables_of_found(common, own->contacts, &setup, &c, st, tables);
  pthread_mutex_unlock(&found.beside.found);
  if (st == HC_OK && with_tables) {
    tabled = compare_tables(common, &setup, &c, &monitor, tables + n_tables, &a);
    n_tables += 2;
  }
  hc_status proved = HC_OK;
  if (st == HC_OK && own->prove) proved = prove_run(sc, &setup, &monitor, NULL, NULL, &p);
  const int error = errno;
  keep_found_end(&found.beside);
  progress_end(bar);
  cli_ended(common, st != HC_OK ? st : tabled != HC_OK ? tabled : proved);
  if (st == HC_OK && common->call) tables[n_tables++] = gate_table(common, &setup, &c);
  if (st == HC_OK && own->prove) tables[n_tables++] = proofs_table(common, &p, proved);
  if (proved != HC_OK) proofs_ended(common, p.curve_end, proved, error);
  if (st != HC_OK) code = cli_solver_failed(common, CLI_BOTH, "the comparison", st, 0);
  else code = comparison_exit_code(&c);
  if (proved != HC_OK) code = EXIT_NO_SOLUTION;
  if (tabled != HC_OK) code = cli_solver_failed(common, CLI_BOTH, "the tables", tabled, 0);
  print_failures(common, &c, false);
  say_unexpected(common, &c, NULL);
  if (c.n_rows && !common->quiet && !comparison_nonlinear(&c)) cli_message(common, COMPARISON_LINEAR, c.n_rows);
  int written = c.n_rows ? cli_write_rest(common, n_tables, tables, &found.shown.begun) : 0;
  if (common->drawing.path && c.n_rows && !written)
    written = cli_plotted(common, plot_compare(&common->drawing, sc, &c, a.n_rows ? &a : NULL));
  for (int i = 0; i < n_tables; ++i) table_free(tables[i]);
  shown_rows_end(&found.shown);
  accuracy_clear(&a);
  proofs_clear(&p);
  comparison_clear(&c);
  scene_setup_clear(&setup);
  return code ? code : written;
}

CLI_COMMAND(compare, compare_options, "CASE",
            "harmonic balance and time integration at the same frequencies: discrepancies and verdicts");
