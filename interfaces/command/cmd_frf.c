/* cmd_frf.c - hbmcheck frf: the response curve, or every solution at given frequencies. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include "compare/duration.h"
#include "compare/memory.h"
#include "compare/output/progress.h"
#include "compare/response.h"
#include "compare/study/scene_solvers.h"
#include "compare/survey.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/keep_found.h"
#include "model/casefile/structure.h"
#include "numerics/base/constants.h"
#include "numerics/base/thread_clock.h"

static const char help[] =
    "You want the response curve: harmonic balance along the sweep of CASE, turning points included, or every "
    "solution of that curve at the omegas of --at. Branches that begin at the sweep's other end or where symmetry "
    "breaks come with it."
    "\vColumns: amplitude = (max - min)/2 of x over a period, branch = turning points passed, contact = the "
    "strongest thing that happens in a period.\n"
    "exit: 0 the whole sweep  2 case file wrong  3 stopped before the end (where and why on stderr)  64 usage\n"
    "example: hbmcheck frf cases/paper/case2.yaml --at 8,9 --set hbm.harmonics=5";

typedef struct frf_options {
  number_list at;       /* n = 0: the whole curve */
  const char *response; /* NULL: all of them */
  bool contacts;        /* what each contact does, too */
  bool band;            /* of each solution */
  bool verbose;         /* how Newton's equations were solved, too */
  int survey;           /* starts at each of `at`; 0: none */
} frf_options;

static const cli_option options[] = {
    {CLI_LIST, "at", "LIST", "Only the solutions at these " CLI_FREQUENCIES, offsetof(frf_options, at)},
    CLI_RESPONSE_OPTION(frf_options),
    CLI_CONTACTS_OPTION(frf_options),
    {CLI_FLAG, "band", NULL, "With --at: the least and largest amplitude as sliders rest elsewhere that never slip",
     offsetof(frf_options, band)},
    {CLI_INTEGER, "survey", "N",
     "With --at: also solutions that the curve does not come to, next to motions from N starts, as hbmcheck survey has",
     offsetof(frf_options, survey), 1, SURVEY_MOST_STARTS},
    {CLI_FLAG, "verbose", NULL, "Also how Newton's equations were solved", offsetof(frf_options, verbose)},
    CLI_PLOT_OPTION,
    {0},
};

/* What was found, while the solver is at work. */
typedef struct found_points {
  const cli_common *common;
  hbm_solver *s;
  plot_responses of_case;
  progress *bar;
  double began;                        /* [s] processor time of this thread */
  double X[2 * HBM_MAX_HARMONICS + 1]; /* of a response, for programs */
  band_search *search;                 /* NULL without --band */
  model *model;                        /* of that */
  band *bands;                         /* [responses] of the point under way */
  const hc_monitor *monitor;
  bool free;   /* a slider that never slips leaves a mean to history */
  int points;  /* so many */
  double last; /* [rad/time] the last one's omega */
  keep_found beside;
  shown_rows shown;            /* the rows of all points, of the thread that finds them */
  table *contacts;             /* and of all contacts; NULL without --contacts */
  table *kept, *contacts_kept; /* the same rows for the other thread, under its lock */
} found_points;

static table *table_of_points(const cli_common *common)
{
  table *t = cli_table(common, "Response curve", ROWS_FRF);
  table_notes_of_rows(t);
  return t;
}

/* f->search and f->bands, by harmonic balance alone. */
static hc_status make_search(found_points *f, const scene *sc)
{
  model *m;
  hc_status st = scene_model(sc, &m);
  if (st != HC_OK) return st;
  f->bands = calloc((size_t)m->n_responses, sizeof *f->bands);
  st = f->bands ? band_search_new(m, f->s, NULL, &f->search) : HC_NO_MEMORY;
  f->model = m;
  return st;
}

static hc_status put_point(found_points *f, const hbm_curve *c, int k)
{
  const scene_structure *of = f->common->scene->structure;
  response_row row;
  hc_status st = response_row_of(f->s, c, k, &row);
  if (st == HC_OK && f->search) st = band_find(f->search, row.point.omega, hbm_curve_X(c, k), f->monitor, f->bands);
  for (int r = f->of_case.first; r <= f->of_case.last && st == HC_OK; ++r) {
    if (r > 0) st = response_row_turn(f->s, c, k, r, &row);
    if (st == HC_OK && f->common->call) {
      st = hbm_response(f->s, row.point.omega, hbm_curve_X(c, k), r, f->X);
      row.series = f->X;
    }
    if (!of->is_oscillator) structure_response_name(of, r, row.response, sizeof row.response);
    if (st == HC_OK && f->search) row.band = f->bands[r];
    f->free |= row.measures.contact.free_sliders > 0;
    pthread_mutex_lock(&f->beside.found);
    cli_put_row(f->common, f->kept, ROWS_FRF, &row);
    pthread_mutex_unlock(&f->beside.found);
    cli_put_row(f->common, f->shown.rows, ROWS_FRF, &row);
  }
  return st;
}

static hc_status put_contacts(found_points *f, const hbm_curve *c, int k)
{
  const scene *sc = f->common->scene;
  contact_period *periods = calloc((size_t)hbm_n_contacts(f->s) + 1, sizeof *periods);
  hc_status st = periods ? hbm_measure_contacts(f->s, c->points[k].omega, hbm_curve_X(c, k), periods) : HC_NO_MEMORY;
  for (int j = 0; j < scene_contact_count(sc) && st == HC_OK; ++j) {
    contact_row row = {c->points[k].omega, c->points[k].branch, .contact = j, .period = periods[j]};
    snprintf(row.name, sizeof row.name, "%s", scene_contact_at(sc, j)->name);
    pthread_mutex_lock(&f->beside.found);
    cli_put_row(f->common, f->contacts_kept, ROWS_CONTACT, &row);
    pthread_mutex_unlock(&f->beside.found);
    cli_put_row(f->common, f->contacts, ROWS_CONTACT, &row);
  }
  free(periods);
  return st;
}

/* Where each further part begins and ends, and the branches it has. */
static void note_parts(table *t, const scene *sc, const hbm_curve *c)
{
  static const char *const start[] = {"the sweep's beginning", "the other end of the sweep", "a branch point"};
  for (int i = 1; i < c->n_parts; ++i) {
    const hbm_curve_part *p = &c->parts[i];
    const hbm_point *first = &c->points[p->first], *last = first + p->n - 1;
    char from[SCENE_WHERE], to[SCENE_WHERE], reason[160] = "";
    scene_where(sc, first->omega, from);
    scene_where(sc, p->ends_at, to);
    if (p->end != HC_OK) snprintf(reason, sizeof reason, ": it STOPPED there, %s", hc_status_text(p->end));
    else if (p->met) snprintf(reason, sizeof reason, ", where it meets another branch");
    else if (p->closed) snprintf(reason, sizeof reason, ", where it closes");
    table_note(t, "branch %d%s%.0d: not connected to the sweep's beginning; %d points from %s, %s, to %s%s",
               first->branch, last->branch > first->branch ? " to " : "",
               last->branch > first->branch ? last->branch : 0, p->n, start[p->start], from, to, reason);
  }
}

/* For hbm_curve_watch. */
static hc_status put_points(void *self, const hbm_curve *c, int from, int to)
{
  found_points *f = self;
  hc_status st = HC_OK;
  for (int k = from; k < to && st == HC_OK; ++k) {
    st = put_point(f, c, k);
    if (st == HC_OK && f->contacts) st = put_contacts(f, c, k);
    if (st != HC_OK) continue;
    pthread_mutex_lock(&f->beside.found);
    f->last = c->points[k].omega;
    ++f->points;
    pthread_mutex_unlock(&f->beside.found);
  }
  shown_rows_write(&f->shown, f->common);
  return st;
}

/* For hbm_curve_watch of a curve whose points are the result. */
static hc_status put_curve(void *self, const hbm_curve *c, int from, int to)
{
  found_points *f = self;
  char label[64];
  if (f->points == 0 && c->points[0].iterations > 0) { /* what the first solution took tells what a curve will */
    const double newton = (thread_seconds() - f->began) / c->points[0].iterations;
    const int n_harm = hbm_n_harmonics(f->s);
    progress_erase();
    cli_foretell_time(f->common, duration_of_curve(&(duration_units){.newton = newton, .harmonics = n_harm}, n_harm), 0,
                      NULL);
  }
  const hc_status st = put_points(f, c, from, to);
  snprintf(label, sizeof label, "harmonic balance, %d points", f->points);
  progress_relabel(f->bar, label);
  return st;
}

/* For keep_found_begin. */
static int write_found(void *self)
{
  found_points *f = self;
  if (f->points == 0) return -1;
  table_note(f->kept, "STOPPED at %s: %s", scene_where(f->common->scene, f->last, (char[SCENE_WHERE]){0}),
             hc_status_text(HC_INTERRUPTED));
  const int code = cli_solver_failed(f->common, CLI_HBM, "harmonic balance", HC_INTERRUPTED, f->last);
  pthread_mutex_lock(&f->shown.writing);
  cli_write_rest(f->common, f->contacts ? 2 : 1, (table *[]){f->kept, f->contacts_kept}, &f->shown.begun);
  return code;
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
    table_note(t, "stability is found at the omegas of --at alone, nor are period doublings and such looked for: %s",
               hbm_stability_limit(s));
  if (sc->hbm.keep_mean && scene_adrift(sc)) table_note(t, "%s", SCENE_ADRIFT);
  if (c->n == 0) return;
  char last[SCENE_WHERE];
  scene_where(sc, c->ends_at, last);
  if (c->left_at_start) table_note(t, "the branch turned back and left the sweep where it began, at %s", last);
  else if (c->end == HC_OK) table_note(t, "reached the end of the sweep, %s", last);
  else table_note(t, "STOPPED at %s: %s", last, hc_status_text(c->end));
  note_parts(t, sc, c);
}

/* In the table the first contact changes only, which may be many; all that stability changes at, and in csv and json
 * everything; for programs as rows of `specials`, too. */
static hc_status note_specials(const cli_common *common, table *t, table *specials, hbm_solver *s, const hbm_curve *c)
{
  enum { SHOWN = 24 };
  const scene *sc = common->scene;
  const bool all = common->format != FORMAT_TABLE;
  char amplitude[16 + RESPONSE_NAME] = "amplitude", name[RESPONSE_NAME];
  hbm_special *special;
  int n, changes = 0;
  if (!scene_is_oscillator(sc))
    snprintf(amplitude, sizeof amplitude, "amplitude of %s",
             structure_response_name(sc->structure, 0, name, sizeof name));
  if (!hbm_specials_follow_each(s))
    table_note(t,
               "contact changes are listed where the strongest state of all contacts changes: there are more than 24");
  if (!hbm_stability_is_costly(s) && hbm_stability_error_is_costly(s))
    table_note(t,
               "stability by HBM's own multipliers: that they err is seen at the omegas of --at alone, with twice the "
               "harmonics, which are more than 600 unknowns");
  hc_status st = hbm_specials(s, c, &special, &n);
  for (int i = 0; i < n; ++i) {
    const hbm_special *p = &special[i];
    char what[ROWS_SPECIAL], omega[ROWS_WITH_ERROR], frequency[ROWS_WITH_ERROR];
    changes += p->kind == HBM_CONTACT_CHANGE;
    if (common->call) cli_put_row(common, specials, ROWS_SPECIALS, p);
    if (p->kind == HBM_CONTACT_CHANGE && changes > SHOWN && !all) continue;
    rows_special_text(p, what);
    rows_with_error(p->omega, p->omega_error, omega);
    rows_with_error(p->omega / TWO_PI, p->omega_error / TWO_PI, frequency);
    if (sc->in_cycles)
      table_note(t, "%s at frequency = %s (omega = %s), %s %.9g", what, frequency, omega, amplitude, p->amplitude);
    else table_note(t, "%s at omega = %s, %s %.9g", what, omega, amplitude, p->amplitude);
  }
  if (changes > SHOWN && !all) table_note(t, "and %d more contact changes (all in csv and json)", changes - SHOWN);
  if (st != HC_OK) table_note(t, "at least one more was noticed but not located: %s", hc_status_text(st));
  free(special);
  return st;
}

/* Appends the solutions next to motions from drawn starts that the curve does not come to. */
static hc_status find_beside(const cli_common *common, int starts, hbm_solver *s, const hbm_curve *curve,
                             const hc_monitor *monitor, hbm_curve *found)
{
  compare_setup setup;
  survey motions = {0};
  const survey_settings how = {starts, SURVEY_SEED, cli_jobs(common), survey_first_branch(curve)};
  hc_status st = scene_setup(common->scene, &setup);
  for (int i = 0; i < setup.compare.omega.n && st == HC_OK; ++i) {
    const double omega = setup.compare.omega.v[i];
    hbm_curve at = {0};
    if (hbm_curve_at(s, curve, omega, &at) == HC_NO_MEMORY) st = HC_NO_MEMORY;
    if (st == HC_OK) st = survey_at(&setup, s, &at, omega, &how, monitor, &motions);
    hbm_curve_free(&at);
  }
  if (st == HC_OK || st == HC_INTERRUPTED) {
    const hc_status added = survey_append_beside(&motions, 0, found);
    if (added != HC_OK) st = added;
  }
  const hc_status taken = hbm_curve_settle(found, found->n);
  survey_clear(&motions);
  scene_setup_clear(&setup);
  return taken != HC_OK ? taken : st;
}

/* The whole curve in a row: for programs. */
static table *summary_table(const cli_common *common, hbm_solver *s, const hbm_curve *c, hc_status *st)
{
  response_summary whole;
  table *t = cli_table(common, "Curve", ROWS_CURVE);
  const hc_status summarised = response_summarise(s, c, &whole);
  if (summarised == HC_OK) cli_put_row(common, t, ROWS_CURVE, &whole);
  else if (*st == HC_OK) *st = summarised;
  return t;
}

static int run_frf(cli_common *common, void *given, scene *sc)
{
  const frf_options *own = given;
  plot_responses of_case = {0, structure_response_count(sc->structure) - 1};
  if (own->response && (of_case.first = of_case.last = cli_response_named(common, own->response)) < 0)
    return EXIT_USAGE;
  if (own->survey && !own->at.n)
    return cli_failed(common, EXIT_USAGE, "at which frequencies? --survey N goes with --at LIST");
  if (!own->at.n) sc->compare.omega.n = 0; /* those of the case are for the comparison */
  const int refused = cli_take_frequencies(common, &own->at, true, sc);
  if (refused) return refused;
  if (own->band && !own->at.n)
    return cli_failed(common, EXIT_USAGE, "--band: at which frequencies? --at LIST was expected");
  common->bands = own->band;
  hbm_curve curve = {0}, found = {0};
  double from, to, failed_at = 0, drift = NAN;
  char name[RESPONSE_NAME] = "";              /* of the response that creeps */
  const number_list *at = &sc->compare.omega; /* n = 0: the whole curve */
  compare_setup setup;
  if (scene_setup(sc, &setup) == HC_OK) cli_foretell_memory(common, memory_of_curve(setup.model, &setup.hbm));
  scene_setup_clear(&setup);
  progress *bar = cli_progress(common, "harmonic balance");
  hc_monitor monitor = progress_monitor(bar);
  found_points f = {.common = common, .of_case = of_case, .bar = bar, .began = thread_seconds()};
  shown_rows_begin(&f.shown, own->contacts);
  table *t = f.shown.rows = table_of_points(common);
  table *specials = common->call ? cli_table(common, "Special points", ROWS_SPECIALS) : NULL, *whole = NULL;
  f.kept = table_of_points(common);
  if (own->contacts) f.contacts = cli_table(common, "Contacts", ROWS_CONTACT);
  if (own->contacts) f.contacts_kept = cli_table(common, "Contacts", ROWS_CONTACT);
  keep_found_begin(&f.beside, common, write_found, &f);
  comparison_sweep(sc->omega_from, sc->omega_to, at, &from, &to);
  hc_status st = scene_hbm_solver(sc, &f.s);
  hbm_solver *s = f.s;
  f.monitor = &monitor;
  if (st == HC_OK && own->band) st = make_search(&f, sc);
  if (st == HC_OK) {
    if (at->n) found.watch = (hbm_curve_watch){put_points, &f};
    else curve.watch = (hbm_curve_watch){put_curve, &f};
    st = hbm_trace_all(s, from, to, &monitor, &curve);
    if (st != HC_OK) failed_at = curve.ends_at;
    double lacks_at = 0;
    hc_status solved = at->n ? response_at(s, &curve, at, &found, &lacks_at) : HC_OK;
    if (st == HC_OK) failed_at = lacks_at;
    if (own->survey && solved != HC_NO_MEMORY && st != HC_NO_MEMORY && st != HC_INTERRUPTED) {
      const hc_status surveyed = find_beside(common, own->survey, s, &curve, &monitor, &found);
      if (surveyed != HC_OK) st = surveyed;
    }
    /* also with --at a curve that stops early is a failure: it might have turned back to those omegas */
    if (st == HC_OK) st = solved;
    note_curve(t, sc, s, &curve, at->n > 0);
    const hbm_newton_report work = hbm_newton_work(s);
    if (own->verbose) table_note(t, "Newton: %d unknowns, %ld factorisations", work.unknowns, work.factorisations);
    solved = at->n || st == HC_INTERRUPTED ? HC_OK : note_specials(common, t, specials, s, &curve);
    if (st == HC_OK && solved == HC_NO_MEMORY) st = solved; /* another failure to locate one is in the note */
    /* where there is no solution: at the first frequency without, else past the last point */
    const double none_at = lacks_at > 0 ? lacks_at : curve.n ? cli_past(sc, failed_at) : failed_at;
    const bool given_up = st == HC_NO_MEMORY || st == HC_INTERRUPTED || st == HC_UNBOUNDED;
    if (st != HC_OK && !given_up && none_at > 0 && cli_it_creeps(sc, none_at, &monitor, name, &drift)) {
      st = HC_CREEPS, failed_at = none_at;
      table_note(t, "at %s the body slides on by %.9g in each period", scene_where(sc, none_at, (char[SCENE_WHERE]){0}),
                 drift);
    }
    if (st != HC_OK && (curve.n == 0 || curve.end == HC_OK)) table_note(t, "INCOMPLETE: %s", hc_status_text(st));
    if (!f.free) table_hide(t, "mean_free");
    if (f.contacts && sc->hbm.force == HBM_FORCE_SAMPLED)
      table_note(f.contacts, "contacts by the exact law along the motion found with sampled forces");
  }
  keep_found_end(&f.beside);
  progress_end(bar);
  int code = 0, n_tables = 1 + own->contacts;
  table *tables[4] = {t, f.contacts};
  if (common->call && s) {
    tables[n_tables++] = specials;
    tables[n_tables++] = whole = summary_table(common, s, &curve, &st);
  }
  cli_ended(common, st);
  if (st == HC_CREEPS) code = cli_creeps(common, failed_at, name, drift);
  else if (st != HC_OK) code = cli_solver_failed(common, CLI_HBM, "harmonic balance", st, failed_at);
  int written = s ? cli_write_rest(common, n_tables, tables, &f.shown.begun) : 0;
  if (common->drawing.path && s && !written)
    written = cli_plotted(common, plot_frf(&common->drawing, sc, s, &curve, at->n ? &found : NULL, of_case));
  shown_rows_end(&f.shown);
  table_free(specials);
  table_free(whole);
  table_free(f.contacts);
  table_free(f.kept);
  table_free(f.contacts_kept);
  hbm_curve_free(&found);
  hbm_curve_free(&curve);
  band_search_free(f.search);
  free(f.bands);
  model_free(f.model);
  hbm_solver_free(s);
  return code ? code : written;
}

CLI_COMMAND(frf, frf_options, "CASE", "the harmonic-balance response curve, or every solution at given frequencies");
