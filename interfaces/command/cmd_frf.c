/* cmd_frf.c - hbmcheck frf: the response curve, or every solution at given frequencies. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include "casefile/structure.h"
#include "compare/memory.h"
#include "compare/response.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "numerics/base/constants.h"
#include "output/progress.h"
#include "study/scene_solvers.h"

static const char help[] =
    "You want the response curve: harmonic balance along the sweep of CASE, turning points included, or every "
    "solution of that curve at the omegas of --at. What is not connected to the sweep's first omega is not seen: try "
    "the sweep the other way."
    "\vColumns: amplitude = (max - min)/2 of x over a period, branch = turning points passed, contact = the "
    "strongest thing that happens in a period.\n"
    "exit: 0 the whole sweep  2 case file wrong  3 stopped before the end (where and why on stderr)  64 usage\n"
    "example: hbmcheck frf cases/paper/case2.yaml --at 8,9 --set hbm.harmonics=5";

typedef struct frf_options {
  number_list at;       /* n = 0: the whole curve */
  const char *response; /* NULL: all of them */
  bool contacts;        /* what each contact does, too */
  bool verbose;         /* how Newton's equations were solved, too */
} frf_options;

static const cli_option options[] = {
    {CLI_LIST, "at", "LIST", "Only the solutions at these " CLI_FREQUENCIES, offsetof(frf_options, at)},
    CLI_RESPONSE_OPTION(frf_options),
    CLI_CONTACTS_OPTION(frf_options),
    {CLI_FLAG, "verbose", NULL, "Also how Newton's equations were solved", offsetof(frf_options, verbose)},
    CLI_PLOT_OPTION,
    {0},
};

static hc_status put_points(const cli_common *common, hbm_solver *s, const hbm_curve *c, plot_responses of_case,
                            table *t)
{
  const scene_structure *of = common->scene->structure;
  bool free = false;
  for (int k = 0; k < c->n; ++k) {
    response_row row;
    hc_status st = response_row_of(s, c, k, &row);
    for (int r = of_case.first; r <= of_case.last && st == HC_OK; ++r) {
      if (r > 0) st = response_row_turn(s, c, k, r, &row);
      if (of) structure_response_name(of, r, row.response, sizeof row.response);
      free |= row.measures.contact.free_sliders > 0;
      cli_put_row(common, t, ROWS_FRF, &row);
    }
    if (st != HC_OK) return st;
  }
  if (!free) table_hide(t, "mean_free");
  return HC_OK;
}

static hc_status put_contacts(const cli_common *common, hbm_solver *s, const hbm_curve *c, table *t)
{
  const scene *sc = common->scene;
  const int n = scene_contact_count(sc);
  contact_period *periods = calloc((size_t)hbm_n_contacts(s) + 1, sizeof *periods);
  hc_status st = periods ? HC_OK : HC_NO_MEMORY;
  for (int k = 0; k < c->n && st == HC_OK; ++k) {
    st = hbm_measure_contacts(s, c->points[k].omega, c->X + (size_t)k * (size_t)c->n_coef, periods);
    for (int j = 0; j < n && st == HC_OK; ++j) {
      contact_row row = {c->points[k].omega, c->points[k].branch, .contact = j, .period = periods[j]};
      snprintf(row.name, sizeof row.name, "%s", scene_contact_at(sc, j)->name);
      cli_put_row(common, t, ROWS_CONTACT, &row);
    }
  }
  free(periods);
  if (sc->hbm.force == HBM_FORCE_SAMPLED)
    table_note(t, "contacts by the exact law along the motion found with sampled forces");
  return st;
}

static void note_curve(table *t, const scene *sc, const hbm_solver *s, const hbm_curve *c, bool at_given)
{
  char how[128];
  table_note(t, "%s: %s; %d points, %ld iterations, %d steps rejected, %d turning points, %s continuation", sc->title,
             cli_hbm_settings(sc, hbm_n_harmonics(s), hbm_n_samples(s), how, sizeof how), c->n, c->iterations,
             c->rejected, c->turning_points, c->arclength ? "arc-length" : "natural");
  if (c->inaccurate)
    table_note(t, "hbm.accuracy %g was NOT met everywhere with the most harmonics or samples that auto takes",
               sc->hbm.accuracy);
  if (c->edges > 0)
    table_note(
        t,
        "%d steps over joins of rest and slip of contacts with two tangents, by up to %.1g of omega and %.1g of the "
        "motion: solutions on them may be missing",
        c->edges, c->edge_omega, c->edge_motion);
  if (hbm_stability_is_unknown(s))
    table_note(t, "stability is not found everywhere, nor period doublings and such: a limit of both tangents "
                  "together, more than 50 degrees of freedom, and damping that is not modal or too light");
  else if (hbm_stability_is_costly(s) && !at_given)
    table_note(t, "stability is found at the omegas of --at alone, nor are period doublings and such looked for: more "
                  "than 50 degrees of freedom, or 12 with contacts of two tangents");
  if (sc->hbm.keep_mean && scene_adrift(sc)) table_note(t, "%s", SCENE_ADRIFT);
  if (c->n == 0) return;
  char last[SCENE_WHERE];
  scene_where(sc, c->points[c->n - 1].omega, last);
  if (c->left_at_start) table_note(t, "the branch turned back and left the sweep where it began, at %s", last);
  else if (c->end == HC_OK) table_note(t, "reached the end of the sweep, %s", last);
  else table_note(t, "STOPPED at %s: %s", last, hc_status_text(c->end));
}

static hc_status note_specials(table *t, const scene *sc, hbm_solver *s, const hbm_curve *c)
{
  enum { SHOWN = 24 };
  hbm_special special[SHOWN];
  char amplitude[16 + RESPONSE_NAME] = "amplitude", name[RESPONSE_NAME];
  int n = 0;
  if (sc->structure)
    snprintf(amplitude, sizeof amplitude, "amplitude of %s",
             structure_response_name(sc->structure, 0, name, sizeof name));
  if (!hbm_specials_follow_each(s))
    table_note(t,
               "contact changes are listed where the strongest state of all contacts changes: there are more than 24");
  hc_status st = hbm_specials(s, c, SHOWN, special, &n);
  for (int i = 0; i < n && i < SHOWN; ++i) {
    const hbm_special *p = &special[i];
    char what[ROWS_SPECIAL], where[SCENE_WHERE];
    if (sc->in_cycles) snprintf(where, sizeof where, "frequency = %.10f (omega = %.10f)", p->omega / TWO_PI, p->omega);
    else snprintf(where, sizeof where, "omega = %.10f", p->omega);
    table_note(t, "%s at %s, %s %.9g", rows_special_text(p, what), where, amplitude, p->amplitude);
  }
  if (n > SHOWN) table_note(t, "and %d more", n - SHOWN);
  if (st != HC_OK) table_note(t, "at least one more was noticed but not located: %s", hc_status_text(st));
  return st;
}

static int run_frf(cli_common *common, void *given, scene *sc)
{
  const frf_options *own = given;
  plot_responses of_case = {0, sc->structure ? structure_response_count(sc->structure) - 1 : 0};
  if (own->response && (of_case.first = of_case.last = cli_response_named(common, own->response)) < 0)
    return EXIT_USAGE;
  if (!own->at.n) sc->compare.omega.n = 0; /* those of the case are for the comparison */
  const int refused = cli_take_frequencies(common, &own->at, true, sc);
  if (refused) return refused;
  hbm_solver *s = NULL;
  hbm_curve curve = {0}, found = {0};
  double from, to, failed_at = 0;
  table *t = cli_table(common, "Response curve", ROWS_FRF);
  table *contacts = own->contacts ? cli_table(common, "Contacts", ROWS_CONTACT) : NULL;
  compare_setup setup;
  if (scene_setup(sc, &setup) == HC_OK) cli_foretell_memory(common, memory_of_curve(setup.model, &setup.hbm));
  scene_setup_clear(&setup);
  progress *bar = progress_start("harmonic balance", common->quiet);
  hc_monitor monitor = progress_monitor(bar);
  const number_list *at = &sc->compare.omega; /* n = 0: the whole curve */
  comparison_sweep(sc->omega_from, sc->omega_to, at, &from, &to);
  hc_status st = scene_hbm_solver(sc, &s);
  if (st == HC_OK) {
    st = hbm_trace(s, from, to, &monitor, &curve);
    if (st != HC_OK) failed_at = curve.n ? curve.points[curve.n - 1].omega : from;
    const hbm_curve *shown = at->n ? &found : &curve;
    hc_status solved = at->n ? response_at(s, &curve, at, &found, &failed_at) : HC_OK;
    /* also with --at a curve that stops early is a failure: it might have turned back to those omegas */
    if (st == HC_OK) st = solved;
    solved = put_points(common, s, shown, of_case, t);
    if (st == HC_OK) st = solved;
    if (contacts) solved = put_contacts(common, s, shown, contacts);
    if (st == HC_OK) st = solved;
    note_curve(t, sc, s, &curve, at->n > 0);
    const hbm_newton_report work = hbm_newton_work(s);
    if (own->verbose) table_note(t, "Newton: %d unknowns, %ld factorisations", work.unknowns, work.factorisations);
    solved = at->n ? HC_OK : note_specials(t, sc, s, &curve);
    if (st == HC_OK && solved == HC_NO_MEMORY) st = solved; /* another failure to locate one is in the note */
    if (st != HC_OK && (curve.n == 0 || curve.end == HC_OK)) table_note(t, "INCOMPLETE: %s", hc_status_text(st));
  }
  progress_end(bar);
  int code = st == HC_OK ? 0 : cli_solver_failed(common, CLI_HBM, "harmonic balance", st, failed_at);
  int written = s ? cli_write(common, own->contacts ? 2 : 1, (table *[]){t, contacts}) : 0;
  if (common->drawing.path && s && !written)
    written = cli_plotted(common, plot_frf(&common->drawing, sc, s, &curve, at->n ? &found : NULL, of_case));
  table_free(t);
  table_free(contacts);
  hbm_curve_free(&found);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return code ? code : written;
}

CLI_COMMAND(frf, frf_options, "CASE", "the harmonic-balance response curve, or every solution at given frequencies");
