/* steady_states.c - see steady_states.h. */
#include "compare/steady_states.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/comparison.h"
#include "compare/gate_limits.h"
#include "compare/motion.h"
#include "numerics/base/growing.h"
#include "numerics/base/workspace.h"
#include "timeint/steady/contact_watch.h"
#include "timeint/steady/sweep.h"

const char *steady_verdict_text(const steady_row *r, char text[24])
{
  if (r->status == HC_OK && timeint_stability(&r->result) < 0) snprintf(text, 24, "%s", verdict_name(VERDICT_UNSTABLE));
  else if (r->status == HC_OK && r->result.period_multiple > 1)
    snprintf(text, 24, "period_%d", r->result.period_multiple);
  else if (r->status == HC_OK) snprintf(text, 24, "settled");
  else if (r->status == HC_NOT_SETTLED) snprintf(text, 24, "%s", verdict_name(VERDICT_NOT_SETTLED));
  else if (r->status == HC_APERIODIC) snprintf(text, 24, "%s", verdict_name(VERDICT_APERIODIC));
  else if (r->status == HC_UNBOUNDED) snprintf(text, 24, "%s", verdict_name(VERDICT_UNBOUNDED));
  else if (r->status == HC_CREEPS) snprintf(text, 24, "%s", verdict_name(VERDICT_CREEPS));
  else snprintf(text, 24, "%s", verdict_name(VERDICT_SOLVER_FAILED));
  return text;
}

/* The settings and solvers of one run of steady states, and where its rows go. */
typedef struct steady_work {
  const compare_setup *setup;
  timeint *ti;
  timeint *exact;          /* to see what the regularisation costs; NULL where the law is the exact one already */
  response_curve response; /* its solver is NULL unless the start is on HBM orbits */
  const hc_monitor *monitor;
  steady_states *out;
  workspace memory; /* of the arrays below */
  double *state;    /* [n_states] on its way to the steady state of a row */
  double *scratch;  /* [n_states] of the exact law's orbit next to that */
} steady_work;

static hc_status add_row(steady_work *w, const steady_row *row)
{
  steady_states *s = w->out;
  compare_lock(w->setup);
  const bool grown = GROW(s->rows, s->n);
  if (grown) s->rows[s->n++] = *row;
  compare_unlock(w->setup);
  return grown ? HC_OK : HC_NO_MEMORY;
}

/* A row that came to nothing at that stage. */
static hc_status add_failure(steady_work *w, steady_stage stage, hc_status st, double omega)
{
  steady_row row = {.status = st, .stage = stage, .result = {.omega = omega}};
  hc_status added = add_row(w, &row);
  return st == HC_INTERRUPTED ? st : added;
}

/* The error of a regularised steady state, w->state, by the exact orbit next to it. *st: no memory, or interrupted. */
static double regularisation_error(steady_work *w, const timeint_result *r, hc_status *st)
{
  timeint_result orbit;
  if (!w->exact || r->method == TIMEINT_BY_CLOSED_FORM) return 0;
  memcpy(w->scratch, w->state, (size_t)timeint_n_states(w->ti) * sizeof *w->scratch);
  hc_status found = timeint_orbit(w->exact, r->omega, r->period_multiple, w->scratch, w->monitor, &orbit);
  if (found == HC_NO_MEMORY || found == HC_INTERRUPTED) *st = found;
  if (found != HC_OK) return NAN;
  return budget_regularisation(r, &orbit);
}

/* Appends the rows of the other responses, from the periods that w->ti holds. */
static hc_status add_other_responses(steady_work *w, steady_row *row)
{
  hc_status st = HC_OK;
  for (row->response = 1;
       row->response < w->setup->model->n_responses && motion_is_measured(row->status) && st == HC_OK;
       ++row->response) {
    st = timeint_response(w->ti, row->response, &row->result);
    row->from_regularisation = NAN; /* known of the first response */
    if (st == HC_OK) st = add_row(w, row);
  }
  return st;
}

/* w->state to the steady state at omega; not HC_OK only when there is no going on. */
static hc_status steady_settle(steady_work *w, double omega, const char *start, hc_status without_hbm)
{
  steady_row row = {.result = {.omega = omega}, .without_hbm = without_hbm, .from_regularisation = NAN};
  snprintf(row.start, sizeof row.start, "%s", start);
  row.status = timeint_steady(w->ti, omega, w->state, w->monitor, &row.result);
  if (row.status == HC_OK) row.from_regularisation = regularisation_error(w, &row.result, &row.status);
  if (row.from_regularisation > w->setup->limits->most.amplitude) row.status = HC_NOT_SETTLED; /* a gate refuses it */
  if (row.status == HC_NO_MEMORY) return HC_NO_MEMORY;
  hc_status st = add_row(w, &row);
  /* Appends what each contact does in the periods that w->ti holds. */
  if (st == HC_OK && w->setup->contacts && motion_is_measured(row.status)) {
    const model *m = w->setup->model;
    const int n = model_whole_contacts(m);
    steady_states *out = w->out;
    contact_period *periods = calloc((size_t)m->n_contacts + 1, sizeof *periods);
    hc_status measured = periods ? timeint_contacts(w->ti, &row.result, periods) : HC_NO_MEMORY;
    if (measured == HC_OK) contact_periods_merge(m, periods);
    compare_lock(w->setup);
    steady_contact *grown = growing_by(out->contacts, out->n_contacts, n, sizeof *grown);
    if (grown) out->contacts = grown;
    else measured = HC_NO_MEMORY;
    for (int j = 0; j < n && measured == HC_OK; ++j) {
      steady_contact *c = &out->contacts[out->n_contacts++];
      *c = (steady_contact){.omega = row.result.omega, .contact = j, .period = periods[j]};
      snprintf(c->start, sizeof c->start, "%s", row.start);
    }
    compare_unlock(w->setup);
    free(periods);
    st = measured == HC_NO_MEMORY ? measured : HC_OK;
  }
  if (st == HC_OK) st = add_other_responses(w, &row);
  if (w->setup->added) w->setup->added(w->setup->added_to);
  return row.status == HC_INTERRUPTED ? HC_INTERRUPTED : st;
}

static hc_status steady_from_rest(steady_work *w, double omega, hc_status without_hbm)
{
  timeint_rest(w->ti, w->state);
  return steady_settle(w, omega, "rest", without_hbm);
}

static hc_status steady_from_orbit(steady_work *w, double omega, const hbm_curve *at, int k)
{
  const double *X = at->X + (size_t)k * at->n_coef;
  char start[32];
  hc_status st = comparison_orbit_start(w->response.hbm, X, omega, w->state);
  if (st == HC_NO_MEMORY) return st;
  if (st != HC_OK) return add_failure(w, STEADY_HBM, st, omega);
  snprintf(start, sizeof start, "hbm branch %d", at->points[k].branch);
  return steady_settle(w, omega, start, HC_OK);
}

static hc_status from_hbm_orbits(steady_work *w, double omega)
{
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(w->response.hbm, &w->response.curve, omega, &at), why = st != HC_OK ? st
                                                                                      : w->response.curve.end != HC_OK
                                                                                          ? w->response.curve.end
                                                                                          : HC_NOT_CONVERGED;
  if (st != HC_NO_MEMORY) st = st != HC_OK || at.n == 0 ? steady_from_rest(w, omega, why) : HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) st = steady_from_orbit(w, omega, &at, k);
  hbm_curve_free(&at);
  return st;
}

/* The asked omegas in the order a sweep meets them, from the sweep's end, the state carried along. */
static hc_status swept(steady_work *w, const number_list *at, bool up)
{
  double here = up ? fmin(w->setup->omega_from, w->setup->omega_to) : fmax(w->setup->omega_from, w->setup->omega_to);
  timeint_rest(w->ti, w->state);
  for (int i = 0; i < at->n; ++i) {
    double omega = at->v[up ? i : at->n - 1 - i];
    hc_status st = timeint_sweep(w->ti, here, omega, w->state, w->monitor);
    if (st == HC_NO_MEMORY) return st;
    if (st != HC_OK) return add_failure(w, STEADY_SWEEP, st, omega); /* from nowhere there is no going on */
    if ((st = steady_settle(w, omega, up ? "up" : "down", HC_OK)) != HC_OK) return st;
    here = omega;
  }
  return HC_OK;
}

static hc_status run(steady_work *w, const number_list *asked)
{
  int start = w->setup->transient.start;
  hc_status st = timeint_new(w->setup->model, &w->setup->transient, &w->ti);
  if (st == HC_OK && w->setup->transient.law != TRANSIENT_LAW_EXACT)
    st = comparison_referee(w->setup, w->ti, &w->exact);
  if (st != HC_OK) return st;
  w->state = workspace_doubles(&w->memory, (size_t)timeint_n_states(w->ti));
  w->scratch = workspace_doubles(&w->memory, (size_t)timeint_n_states(w->ti));
  if (w->memory.failed) return HC_NO_MEMORY;
  if (start == TRANSIENT_START_UP || start == TRANSIENT_START_DOWN) return swept(w, asked, start == TRANSIENT_START_UP);
  if (start == TRANSIENT_START_HBM) st = response_trace(w->setup, asked, w->monitor, &w->response);
  if (st == HC_OK && !w->response.hbm) st = w->response.status;
  for (int i = 0; i < asked->n && st == HC_OK; ++i)
    st = w->response.hbm ? from_hbm_orbits(w, asked->v[i]) : steady_from_rest(w, asked->v[i], HC_OK);
  return st;
}

hc_status steady_states_run(const compare_setup *setup, const hc_monitor *monitor, steady_states *out)
{
  *out = (steady_states){0};
  if (setup->compare.omega.n == 0) return HC_BAD_INPUT;
  number_list asked;
  steady_work w = {.setup = setup, .monitor = monitor, .out = out};
  hc_status st = comparison_frequencies(&setup->compare, setup->omega_from, NULL, &(hbm_curve){0}, &asked);
  if (st == HC_OK) st = run(&w, &asked);
  response_curve_free(&w.response);
  workspace_free(&w.memory);
  timeint_free(w.exact);
  timeint_free(w.ti);
  return st;
}

void steady_states_clear(steady_states *s)
{
  free(s->contacts);
  free(s->rows);
  *s = (steady_states){0};
}
