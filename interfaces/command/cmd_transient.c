/* cmd_transient.c - hbmcheck transient: the steady state by CVODE at given frequencies. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "compare/duration.h"
#include "compare/motion.h"
#include "compare/output/progress.h"
#include "compare/steady_states.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/keep_found.h"
#include "model/casefile/structure.h"

static const char help[] =
    "You want to know which motion happens: the steady state of CASE by time integration at the omegas of --at. It "
    "starts where transient.start says: on each HBM solution's orbit (hbm), at rest, or swept from an end of the "
    "sweep, as on a shaker (up, down)."
    "\vColumns: closure = estimated distance to the periodic orbit relative to the amplitude, steps = CVODE's.\n"
    "exit: 0 all settled  2 case file wrong  3 one did not (which and why on stderr)  64 usage\n"
    "example: hbmcheck transient cases/paper/case2.yaml --at 8,9 --set transient.start=up";

typedef struct transient_options {
  number_list at;       /* n = 0: the case's */
  const char *response; /* NULL: all of them */
  bool contacts;        /* what each contact does, too */
} transient_options;

static const cli_option options[] = {
    {CLI_LIST, "at", "LIST", "At these " CLI_FREQUENCIES " [compare.omega of the case]",
     offsetof(transient_options, at)},
    CLI_RESPONSE_OPTION(transient_options),
    CLI_CONTACTS_OPTION(transient_options),
    CLI_PLOT_OPTION,
    {0},
};

/* The messages of a row that is not what was asked for. 0 or the exit code. */
static int say_failure(const cli_common *common, const steady_row *r)
{
  static const char *const stages[] = {[STEADY_TRANSIENT] = "time integration",
                                       [STEADY_SWEEP] = "the frequency sweep",
                                       [STEADY_HBM] = "harmonic balance"};
  if (r->without_hbm != HC_OK && r->status != HC_CREEPS && !common->quiet)
    cli_message(common, "no HBM solution at %s (%s): starting at rest",
                scene_where(common->scene, r->result.omega, (char[SCENE_WHERE]){0}), hc_status_text(r->without_hbm));
  if (r->status == HC_CREEPS && fabs(r->result.drift) <= 1e-6 * r->result.amplitude) return EXIT_NO_SOLUTION;
  if (r->status == HC_CREEPS) return cli_creeps(common, r->result.omega, r->response_name, r->result.drift);
  if (r->status == HC_INTERRUPTED || r->status == HC_OK || r->status == HC_APERIODIC) return 0;
  return cli_solver_failed(common, r->stage == STEADY_HBM ? CLI_HBM : CLI_TRANSIENT, stages[r->stage], r->status,
                           r->result.omega);
}

/* The rows from `from` on into the table. */
static void put_rows(const cli_common *common, steady_states *found, int from, table *t)
{
  const scene_structure *of = common->scene->structure;
  for (int i = from; i < found->n; ++i) {
    steady_row *r = &found->rows[i];
    if (!of->is_oscillator) structure_response_name(of, r->response, r->response_name, RESPONSE_NAME);
    if (r->status != HC_INTERRUPTED && r->stage == STEADY_TRANSIENT) cli_put_row(common, t, ROWS_TRANSIENT, r);
  }
}

static table *table_of_rows(const cli_common *common)
{
  table *t = cli_table(common, "Steady states", ROWS_TRANSIENT);
  table_notes_of_rows(t);
  return t;
}

static table *contacts_table(const cli_common *common, steady_states *found)
{
  const scene *sc = common->scene;
  table *t = cli_table(common, "Contacts", ROWS_STEADY_CONTACT);
  for (int i = 0; i < found->n_contacts; ++i) {
    steady_contact *c = &found->contacts[i];
    snprintf(c->name, sizeof c->name, "%s", scene_contact_at(sc, c->contact)->name);
    cli_put_row(common, t, ROWS_STEADY_CONTACT, c);
  }
  if (sc->transient.law != TRANSIENT_LAW_EXACT)
    table_note(t, "by the regularised law, %g", sc->transient.regularisation);
  return t;
}

typedef struct found_states {
  const cli_common *common;
  bool contacts; /* --contacts */
  steady_states *found;
  keep_found beside;
  shown_rows shown;
  int n_shown; /* of found->rows */
} found_states;

/* The tables of what was found into tables[2], the second NULL without --contacts; with the messages of rows without a
 * steady state, and that they are not all unless st is HC_OK. 0 or the exit code. */
static int tables_of_found(const found_states *f, hc_status st, table *tables[2])
{
  const cli_common *common = f->common;
  int code = 0;
  table *t = table_of_rows(common);
  put_rows(common, f->found, 0, t);
  bool free = false, torus = false, creeps = false, repeats = true;
  for (int i = 0; i < f->found->n; ++i) {
    const steady_row *row = &f->found->rows[i];
    free |= row->status == HC_OK && motion_mean_is_free(&row->result);
    creeps |= row->status == HC_CREEPS;
    repeats &= row->result.window == 0;
    torus |= row->status == HC_APERIODIC && !isnan(row->result.second_frequency);
    int row_code = say_failure(common, row);
    if (row_code) code = row_code;
  }
  if (!free) table_hide(t, "mean_free");
  if (!torus) table_hide(t, "second_frequency");
  if (!creeps) table_hide(t, "drift");
  for (int i = 0; repeats && i < 3; ++i) table_hide(t, (const char *const[]){"window_low", "window_high", "window"}[i]);
  if (st != HC_OK) {
    table_note(t, "INCOMPLETE: %s", hc_status_text(st));
    code = cli_solver_failed(common, CLI_TRANSIENT, "time integration", st, 0);
  }
  tables[0] = t;
  tables[1] = f->contacts ? contacts_table(common, f->found) : NULL;
  return code;
}

/* For keep_found_begin. */
static int write_found(void *self)
{
  found_states *f = self;
  table *tables[2];
  if (f->found->n == 0) return -1;
  const int code = tables_of_found(f, HC_INTERRUPTED, tables);
  pthread_mutex_lock(&f->shown.writing);
  const int written = cli_write_rest(f->common, f->contacts ? 2 : 1, tables, &f->shown.begun);
  return code ? code : written;
}

/* For compare_setup.added. */
static void show_found(void *self)
{
  found_states *f = self;
  pthread_mutex_lock(&f->beside.found);
  if (!f->shown.rows) f->shown.rows = table_of_rows(f->common);
  put_rows(f->common, f->found, f->n_shown, f->shown.rows);
  f->n_shown = f->found->n;
  pthread_mutex_unlock(&f->beside.found);
  shown_rows_write(&f->shown, f->common);
}

static int run_transient(cli_common *common, void *given, scene *sc)
{
  const transient_options *own = given;
  const bool followed = sc->transient.start == TRANSIENT_START_HBM;
  int code = cli_keep_response(common, sc, own->response);
  if (!code) code = cli_take_frequencies(common, &own->at, followed, sc);
  if (code) return code;
  if (sc->compare.omega.n == 0)
    return cli_failed(common, EXIT_USAGE, "at which frequencies? give --at LIST, or compare.omega in the case");
  steady_states found = {0};
  compare_setup setup;
  hc_status st = scene_setup(sc, &setup);
  if (st == HC_OK && cli_foretells(common)) {
    duration_units u;
    duration_measure(&setup, &u);
    const int n = duration_frequencies(&setup);
    cli_foretell_time(common, duration_of_steady_states(&u, n), n, setup.model);
  }
  progress *bar = cli_progress(common, "time integration");
  hc_monitor monitor = progress_monitor(bar);
  found_states so_far = {.common = common, .contacts = own->contacts, .found = &found};
  shown_rows_begin(&so_far.shown, own->contacts);
  keep_found_begin(&so_far.beside, common, write_found, &so_far);
  setup.contacts = own->contacts;
  setup.found = &so_far.beside.found;
  if (cli_shows_rows(common)) setup.added = show_found, setup.added_to = &so_far;
  if (st == HC_OK) st = steady_states_run(&setup, &monitor, &found);
  keep_found_end(&so_far.beside);
  scene_setup_clear(&setup);
  progress_end(bar);
  cli_ended(common, st);
  table *tables[2];
  code = tables_of_found(&so_far, st, tables);
  int written = st == HC_OK || found.n ? cli_write_rest(common, own->contacts ? 2 : 1, tables, &so_far.shown.begun) : 0;
  if (common->drawing.path && found.n && !written)
    written = cli_plotted(common, plot_transient(&common->drawing, sc, &found));
  table_free(tables[0]);
  table_free(tables[1]);
  shown_rows_end(&so_far.shown);
  steady_states_clear(&found);
  return code ? code : written;
}

CLI_COMMAND(transient, transient_options, "CASE", "the steady state by time integration at given frequencies");
