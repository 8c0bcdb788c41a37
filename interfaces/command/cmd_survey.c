/* cmd_survey.c - hbmcheck survey: the steady states that many starts come to. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "compare/duration.h"
#include "compare/output/progress.h"
#include "compare/survey.h"
#include "interfaces/command/case_names.h"
#include "interfaces/command/commands.h"
#include "interfaces/command/keep_found.h"
#include "model/casefile/structure.h"

static const char help[] =
    "You want to know which other motions there are: the steady states that the exact law reaches at the frequencies "
    "of --at, from starts drawn in position, velocity and sliders, the share of the starts that each has, and the HBM "
    "solution that it runs on. A motion that no solution of the curve has is handed to HBM: what that finds, as on an "
    "isola, gets a branch number above those of the curve."
    "\vStarts: one at rest, one on each HBM solution, the others Sobol points in the modes that move most, sized by "
    "the linear response and by what was found. Time integration is in closed form (smooth laws: CVODE). Rows with "
    "free_sliders are families: a slider rests differently in each start.\n"
    "exit: 0 done  2 case file wrong  3 some starts came to nothing (which and why on stderr)  64 usage\n"
    "example: hbmcheck survey cases/paper/case2.yaml --at 5.11,8";

typedef struct survey_options {
  number_list at;         /* n = 0: the case's */
  const char *response;   /* NULL: all of them */
  int starts, seed, jobs; /* jobs 0: not given */
} survey_options;

static const cli_option options[] = {
    {CLI_LIST, "at", "LIST", "At these " CLI_FREQUENCIES " [compare.omega of the case]", offsetof(survey_options, at)},
    {CLI_INTEGER, "starts", "N", "Starts at each [200]", offsetof(survey_options, starts), 1, SURVEY_MOST_STARTS},
    {CLI_INTEGER, "seed", "N", "Of the draw [1]", offsetof(survey_options, seed), 0, 1000000000},
    {CLI_INTEGER, "jobs", "N", "Threads; results are the same [one a processor]", offsetof(survey_options, jobs), 1,
     CLI_MAX_JOBS, .letter = 'j'},
    CLI_RESPONSE_OPTION(survey_options),
    CLI_PLOT_OPTION,
    {0},
};

typedef struct found_motions {
  const cli_common *common;
  survey *found;
  keep_found beside;
  shown_rows shown;
  int n_shown; /* of found->rows */
} found_motions;

static table *table_of_rows(const cli_common *common)
{
  table *t = cli_table(common, "Motions", ROWS_SURVEY);
  table_notes_of_rows(t);
  return t;
}

/* The rows from `from` on into the table. */
static void put_rows(const cli_common *common, survey *found, int from, table *t)
{
  const scene_structure *of = common->scene->structure;
  for (int i = from; i < found->n_rows; ++i) {
    steady_row *r = &found->rows[i].steady;
    if (!of->is_oscillator) structure_response_name(of, r->response, r->response_name, RESPONSE_NAME);
    cli_put_row(common, t, ROWS_SURVEY, &found->rows[i]);
  }
}

/* Of all that was found; *code: 3 where starts failed, or st is not HC_OK. */
static table *table_of_found(const found_motions *f, hc_status st, int *code)
{
  const cli_common *common = f->common;
  table *t = table_of_rows(common);
  bool creeps = false;
  put_rows(common, f->found, 0, t);
  for (int i = 0; i < f->found->n_rows; ++i) {
    const survey_row *row = &f->found->rows[i];
    const hc_status why = row->steady.status;
    creeps |= why == HC_CREEPS;
    if (row->steady.response > 0 || why == HC_OK || why == HC_APERIODIC || why == HC_CREEPS || why == HC_UNBOUNDED)
      continue;
    *code = cli_solver_failed(common, CLI_TRANSIENT, "time integration", why, row->steady.result.omega);
  }
  for (int k = 0; k < f->found->beside.n; ++k) {
    const hbm_point *p = &f->found->beside.points[k];
    table_note(t, "branch %d at %s: an HBM solution that the response curve does not come to", p->branch,
               scene_where(common->scene, p->omega, (char[SCENE_WHERE]){0}));
  }
  if (!creeps) table_hide(t, "drift");
  if (st != HC_OK) {
    table_note(t, "INCOMPLETE: %s; shares are of the starts made", hc_status_text(st));
    *code = cli_solver_failed(common, CLI_TRANSIENT, "time integration", st, 0);
  }
  return t;
}

/* For keep_found_begin. */
static int write_found(void *self)
{
  found_motions *f = self;
  int code = 0;
  if (f->found->n_rows == 0) return -1;
  table *t = table_of_found(f, HC_INTERRUPTED, &code);
  pthread_mutex_lock(&f->shown.writing);
  const int written = cli_write_rest(f->common, 1, &t, &f->shown.begun);
  return code ? code : written;
}

/* For compare_setup.added. */
static void show_found(void *self)
{
  found_motions *f = self;
  pthread_mutex_lock(&f->beside.found);
  if (!f->shown.rows) f->shown.rows = table_of_rows(f->common);
  put_rows(f->common, f->found, f->n_shown, f->shown.rows);
  f->n_shown = f->found->n_rows;
  pthread_mutex_unlock(&f->beside.found);
  shown_rows_write(&f->shown, f->common);
}

static int run_survey(cli_common *common, void *given, scene *sc)
{
  const survey_options *own = given;
  int code = cli_keep_response(common, sc, own->response);
  if (!code) code = cli_take_frequencies(common, &own->at, true, sc);
  if (code) return code;
  if (sc->compare.omega.n == 0)
    return cli_failed(common, EXIT_USAGE, "at which frequencies? give --at LIST, or compare.omega in the case");
  const survey_settings how = {
      .starts = own->starts, .seed = (unsigned)own->seed, .jobs = own->jobs ? own->jobs : cli_jobs(common)};
  survey found = {0};
  compare_setup setup;
  hc_status st = scene_setup(sc, &setup);
  if (st == HC_OK && cli_foretells(common)) {
    const int n = duration_frequencies(&setup);
    cli_foretell_time(common, survey_seconds(&setup, how.starts), n, setup.model->n > 1 ? setup.model : NULL);
  }
  progress *bar = cli_progress(common, "time integration");
  hc_monitor monitor = progress_monitor(bar);
  found_motions so_far = {.common = common, .found = &found};
  shown_rows_begin(&so_far.shown, false);
  keep_found_begin(&so_far.beside, common, write_found, &so_far);
  setup.found = &so_far.beside.found;
  if (cli_shows_rows(common)) setup.added = show_found, setup.added_to = &so_far;
  if (st == HC_OK) st = survey_run(&setup, &how, &monitor, &found);
  keep_found_end(&so_far.beside);
  scene_setup_clear(&setup);
  progress_end(bar);
  cli_ended(common, st);
  table *t = table_of_found(&so_far, st, &code);
  int written = st == HC_OK || found.n_rows ? cli_write_rest(common, 1, &t, &so_far.shown.begun) : 0;
  if (common->drawing.path && found.n_rows && !written)
    written = cli_plotted(common, plot_survey(&common->drawing, sc, &found));
  table_free(t);
  shown_rows_end(&so_far.shown);
  survey_clear(&found);
  return code ? code : written;
}

CLI_COMMAND(survey, survey_options, "CASE", "the steady states that many starts come to, and those HBM has not",
            .defaults = &(const survey_options){.starts = SURVEY_STARTS, .seed = SURVEY_SEED});
