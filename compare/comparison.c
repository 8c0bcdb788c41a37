/* comparison.c - see comparison.h. Here: frequencies, branches and rows; what the numbers of a row mean: solution.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/comparison_private.h"
#include "compare/first_guess.h"
#include "compare/no_steady_state.h"
#include "compare/remedy.h"
#include "compare/response.h"
#include "numerics/base/growing.h"

const double *comparison_state(const comparison *c, int i) { return c->states + (size_t)i * (size_t)c->n_states; }

static hc_status add_row(comparison *c, const comparison_row *row, const double *state)
{
  const size_t bytes = (size_t)c->n_states * sizeof *state;
  comparison_row *rows = growing(c->rows, c->n_rows, sizeof *rows);
  if (rows) c->rows = rows;
  double *states = growing(c->states, c->n_rows, bytes);
  if (states) c->states = states;
  if (!rows || !states) return HC_NO_MEMORY;
  memcpy(states + (size_t)c->n_rows * (size_t)c->n_states, state, bytes);
  rows[c->n_rows++] = *row;
  ++c->count[row->verdict];
  return HC_OK;
}

/* A row for each contact of the solution X. */
static hc_status add_contacts(comparison_work *w, const double *X, const comparison_row *row)
{
  comparison *out = w->out;
  const int n = model_whole_contacts(w->setup->model);
  contact_comparison *grown = growing_by(out->contacts, out->n_contacts, n, sizeof *grown);
  if (!grown) return HC_NO_MEMORY;
  out->contacts = grown;
  const hc_status st = solution_contacts(w, X, row, grown + out->n_contacts);
  if (st == HC_OK) out->n_contacts += n;
  return st;
}

/* All that is told of solution k, at once for who looks at what was found meanwhile; k < 0: there is none. */
static hc_status add_solution(comparison_work *w, const hbm_curve *at, int k, const comparison_row *row)
{
  const compare_setup *setup = w->setup;
  compare_lock(setup);
  hc_status st = add_row(w->out, row, w->state);
  if (st == HC_OK && k >= 0 && setup->contacts) st = add_contacts(w, at->X + (size_t)k * at->n_coef, row);
  for (int r = 1; r < setup->model->n_responses && st == HC_OK && k >= 0; ++r) { /* behind that of the first response */
    comparison_row other;
    st = solution_turn(w, at, k, r, row, &other);
    if (st == HC_OK) st = add_row(w->out, &other, w->state);
  }
  compare_unlock(setup);
  if (setup->added) setup->added(setup->added_to);
  return st;
}

/* The motions that drawn starts come to at omega, into out->survey from row *first on; solutions that no curve has,
 * behind the others in *at. */
static hc_status look_around(comparison_work *w, double omega, hbm_curve *at, int *first)
{
  survey *all = &w->out->survey;
  const survey_settings how = {w->setup->survey, SURVEY_SEED, w->setup->jobs > 1 ? w->setup->jobs : 1,
                               survey_first_branch(&w->out->curve)};
  const int beside = all->beside.n;
  *first = all->n_rows;
  if (w->setup->survey == 0) return HC_OK;
  const hc_status st = survey_at(w->setup, w->hbm, at, omega, &how, w->monitor, all);
  if (st == HC_OK) return survey_append_beside(all, beside, at);
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK; /* others stay unknown */
}

/* Motions of the survey, from row `first` on, that do not run on that branch; -1: nothing is known. */
static int count_others(const comparison_work *w, int first, int branch)
{
  const survey *all = &w->out->survey;
  int n = 0;
  for (int i = first; i < all->n_rows; ++i) n += all->rows[i].steady.response == 0 && all->rows[i].hbm_branch != branch;
  return first < all->n_rows ? n : -1;
}

/* Every HBM solution at omega. */
static hc_status compare_at(comparison_work *w, double omega)
{
  hbm_curve at = {0};
  const comparison_row none = {.omega = omega,
                               .branch = -1,
                               .verdict = VERDICT_SOLVER_FAILED,
                               .others = -1,
                               .transient_status = HC_UNSUPPORTED,
                               .orbit_status = HC_UNSUPPORTED,
                               .errors = {NAN, NAN, NAN, NAN},
                               .orbit_errors = {NAN, NAN, NAN, NAN},
                               .hbm_predicted = {NAN, NAN, NAN, NAN},
                               .transient_predicted = {NAN, NAN, NAN, NAN},
                               .budget = budget_nothing()};
  comparison_row row = none;
  int first;
  row.hbm_status = hbm_curve_at(w->hbm, &w->out->curve, omega, &at);
  const hc_status looked = look_around(w, omega, &at, &first);
  if (looked != HC_OK) return hbm_curve_free(&at), looked;
  if (row.hbm_status == HC_OK && at.n == 0)
    row.hbm_status = w->out->curve.end != HC_OK ? w->out->curve.end : HC_NOT_CONVERGED;
  hc_status st = row.hbm_status == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
  if (st == HC_OK && row.hbm_status != HC_OK) {
    const hc_status why = steady_state_lacks(w->ti, omega, w->scratch, w->monitor, &row.transient);
    if (why == HC_NO_MEMORY || why == HC_INTERRUPTED) st = why;
    if (why == HC_CREEPS || why == HC_UNBOUNDED) row.transient_status = why;
    if (why == HC_CREEPS) row.verdict = VERDICT_CREEPS;
    if (why == HC_UNBOUNDED) row.verdict = VERDICT_UNBOUNDED;
    if (st == HC_OK) st = add_solution(w, &at, -1, &row);
  }
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    row = none;
    row.others = count_others(w, first, at.points[k].branch);
    st = solution_compare(w, &at, k, &row);
    /* what was stopped inside may look like an answer */
    if (st == HC_OK && !hc_monitor_tick(w->monitor, 1)) st = HC_INTERRUPTED;
    if (st == HC_OK) st = add_solution(w, &at, k, &row);
  }
  hbm_curve_free(&at);
  return st;
}

static const double curve_share = 0.1; /* of the whole work: the response curve, before the frequencies */

static hc_status compare_all(comparison_work *w)
{
  const hc_monitor *outer = w->monitor;
  number_list omega;
  hc_status st = comparison_frequencies(&w->setup->compare, w->setup->omega_from, w->hbm, &w->out->curve, &omega);
  const bool down = w->setup->transient.start == TRANSIENT_START_DOWN;
  const double from = w->setup->omega_from, to = w->setup->omega_to;
  w->swept_omega = down ? fmax(from, to) : fmin(from, to);
  timeint_rest(w->ti, w->swept);
  for (int i = 0; i < omega.n && st == HC_OK; ++i) {
    const double width = (1 - curve_share) / omega.n;
    hc_monitor_part part = {outer, curve_share + i * width, width};
    hc_monitor inner = {hc_monitor_tick_part, &part};
    w->monitor = &inner;
    st = compare_at(w, omega.v[down ? omega.n - 1 - i : i]);
  }
  w->monitor = outer;
  return st;
}

static hc_status advise(comparison_work *w)
{
  const compare_setup *setup = w->setup;
  const comparison_row *worst = comparison_worst(w->out, setup->limits);
  char text[COMPARISON_ADVICE_TEXT];
  const hc_status st = worst ? remedy_find(w, worst, text) : HC_OK;
  if (st != HC_OK || !worst) return st;
  compare_lock(setup);
  memcpy(w->out->advice, text, sizeof text);
  compare_unlock(setup);
  return HC_OK;
}

static hc_status make_states(comparison_work *w)
{
  const size_t n = (size_t)(w->out->n_states = timeint_n_states(w->ti));
  const size_t responses = (size_t)w->setup->model->n_responses, contacts = (size_t)w->setup->model->n_contacts;
  workspace *memory = &w->memory;
  w->swept = workspace_doubles(memory, n);
  w->state = workspace_doubles(memory, n);
  w->scratch = workspace_doubles(memory, n);
  w->responses = workspace_array(memory, responses, sizeof *w->responses);
  w->orbits = workspace_array(memory, responses, sizeof *w->orbits);
  w->expected = workspace_array(memory, responses, sizeof *w->expected);
  w->motions = workspace_array(memory, responses, sizeof *w->motions);
  w->budgets = workspace_array(memory, responses, sizeof *w->budgets);
  w->bands = workspace_array(memory, responses, sizeof *w->bands);
  const size_t longest = (size_t)(2 * HBM_MAX_HARMONICS + 1) * (size_t)w->setup->model->n;
  w->beside = workspace_doubles(memory, longest);
  w->moved = workspace_doubles(memory, w->setup->reduction > 0 ? 2 * longest : 0);
  w->acting = workspace_array(memory, contacts, sizeof *w->acting);
  w->balanced = workspace_array(memory, contacts, sizeof *w->balanced);
  return memory->failed ? HC_NO_MEMORY : HC_OK;
}

hc_status comparison_run(const compare_setup *setup, const hc_monitor *monitor, comparison *out)
{
  *out = (comparison){0};
  comparison_work w = {.setup = setup, .monitor = monitor, .out = out};
  hc_status st = guided_hbm_solver_new(setup->model, &setup->hbm, &w.hbm);
  if (st == HC_OK) st = timeint_new(setup->model, &setup->transient, &w.ti);
  if (st == HC_OK) st = make_states(&w);
  if (st == HC_OK) st = comparison_referee(setup, w.ti, &w.exact);
  if (st == HC_OK) st = budgeter_new(setup, &w.budgeter);
  if (st == HC_OK) {
    double from, to;
    comparison_sweep(setup->omega_from, setup->omega_to, &setup->compare.omega, &from, &to);
    hc_monitor_part part = {monitor, 0, curve_share};
    st = hbm_trace_all(w.hbm, from, to, &(hc_monitor){hc_monitor_tick_part, &part}, &out->curve);
    out->harmonics = hbm_n_harmonics(w.hbm);
    out->samples = hbm_n_samples(w.hbm);
    hc_status summed = response_summarise(w.hbm, &out->curve, &out->summary);
    if (summed != HC_OK) st = summed;
    if (st != HC_INTERRUPTED && st != HC_NO_MEMORY) st = compare_all(&w); /* as far as the curve goes */
    if (st == HC_OK && setup->advise) st = advise(&w);
    comparison_cost *cost = &out->cost;
    *cost = (comparison_cost){.hbm_solves = hbm_solves(w.hbm)};
    timeint_count(w.ti, &cost->periods, &cost->closed_form);
    timeint_count(w.exact, &cost->periods, &cost->closed_form);
    budgeter_count(w.budgeter, &cost->hbm_solves, &cost->periods, &cost->closed_form);
  }
  workspace_free(&w.memory);
  band_search_free(w.band_search);
  budgeter_free(w.budgeter);
  timeint_free(w.exact);
  timeint_free(w.ti);
  hbm_solver_free(w.hbm);
  return st;
}

void comparison_clear(comparison *c)
{
  survey_clear(&c->survey);
  hbm_curve_free(&c->curve);
  free(c->contacts);
  free(c->states);
  free(c->rows);
  *c = (comparison){0};
}
