/* comparison.c - see comparison.h. What is swept here are frequencies and branches; what one row's numbers mean is
 * errors_between(). */
#include "compare/comparison.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "compare/frequencies.h"
#include "compare/gate_limits.h"
#include "compare/motion.h"
#include "numerics/series.h"

static const struct {
  const char *name, *meaning;
} verdicts[] = {
#define VERDICT_WORDS(code, name, meaning) {name, meaning},
    VERDICT_LIST(VERDICT_WORDS)
#undef VERDICT_WORDS
};

const char *verdict_name(verdict v) { return verdicts[v].name; }

const char *verdict_meaning(verdict v) { return verdicts[v].meaning; }

const char *comparison_verdict_text(const comparison_row *row, char text[24])
{
  if (row->verdict == VERDICT_PERIOD_K) snprintf(text, 24, "period_%d", row->transient.period_multiple);
  else snprintf(text, 24, "%s", verdict_name(row->verdict));
  return text;
}

hc_status comparison_orbit_start(hbm_solver *hbm, const double *X, double omega, timeint_state *out)
{
  series_jet j = series_at(hbm_n_harmonics(hbm), X, 1, 0);
  *out = (timeint_state){.x = j.x, .v = omega * j.d1};
  return hbm_sliders(hbm, X, out->w);
}

double comparison_waveform_error(const hbm_measures *hbm, int n_harm, const double *X, const timeint_result *tr)
{
  const periodic_motion a = motion_of_series(hbm, n_harm, X), b = motion_of_transient(tr);
  return motion_discrepancy(&a, &b).waveform;
}

static discrepancy errors_between(const hbm_measures *hbm, int n_harm, const double *X, const timeint_result *tr)
{
  const periodic_motion a = motion_of_series(hbm, n_harm, X), b = motion_of_transient(tr);
  return motion_discrepancy(&a, &b);
}

/* Where a slider is free the mean is a matter of history, and not held against HBM. */
static bool within_limits(const compare_setup *setup, const discrepancy *e, const timeint_result *tr)
{
  return gate_limits_hold(setup->limits, tr->omega, e, tr->free_sliders > 0);
}

/* Is the transient within the limits of any HBM solution at this omega? */
static bool accounted_for(hbm_solver *hbm, const compare_setup *setup, const hbm_curve *at, const timeint_result *tr)
{
  for (int i = 0; i < at->n; ++i) {
    const double *X = at->X + (size_t)i * at->n_coef;
    hbm_measures m;
    if (hbm_measure(hbm, X, &m) != HC_OK) continue;
    discrepancy e = errors_between(&m, hbm_n_harmonics(hbm), X, tr);
    if (within_limits(setup, &e, tr)) return true;
  }
  return false;
}

static hc_status add_row(comparison *c, const comparison_row *row)
{
  if (c->n_rows == c->cap) {
    int cap = c->cap ? 2 * c->cap : 32;
    comparison_row *rows = realloc(c->rows, (size_t)cap * sizeof *rows);
    if (!rows) return HC_NO_MEMORY;
    c->rows = rows;
    c->cap = cap;
  }
  c->rows[c->n_rows++] = *row;
  ++c->count[row->verdict];
  return HC_OK;
}

/* Everything the run needs at hand. */
typedef struct runner {
  const compare_setup *setup;
  hbm_solver *hbm;
  timeint *ti;
  timeint *exact; /* the referee: exact law, shooting */
  budgeter *budgeter;
  const hc_monitor *monitor;
  comparison *out;
  timeint_state swept; /* where a sweep start has come to */
  double swept_omega;
} runner;

/* The transient's state at the start of a row. HC_OK, or why the sweep up to here failed. */
static hc_status start_state(runner *r, const comparison_row *row, const double *X, timeint_state *state)
{
  switch (r->setup->transient.start) {
  case TRANSIENT_START_HBM: return comparison_orbit_start(r->hbm, X, row->omega, state);
  case TRANSIENT_START_REST: *state = timeint_rest(r->ti); return HC_OK;
  default: break;
  }
  hc_status st = timeint_sweep(r->ti, r->swept_omega, row->omega, &r->swept, r->monitor);
  r->swept_omega = row->omega;
  *state = r->swept;
  return st;
}

/* Does the transient run on the orbit next to the HBM solution? It does if it was found there. Otherwise, having
 * come from elsewhere, that orbit is computed from the HBM solution, with the transient's own law, and the two are
 * held together: same law, same orbit, so that the difference is of the order of transient.tolerance, and anything
 * beyond `same` is another orbit. */
static hc_status runs_next_to(runner *r, const comparison_row *row, const double *X, bool *next)
{
  const double same = fmax(1e-6, 100 * r->setup->transient.tolerance);
  if (r->setup->transient.start == TRANSIENT_START_HBM && row->transient.method != TIMEINT_BY_MARCHING)
    return *next = !row->transient.left_orbit, HC_OK;
  *next = true; /* also where there is no orbit: what differs is HBM */
  timeint_state state;
  timeint_result restarted;
  hc_status st = comparison_orbit_start(r->hbm, X, row->omega, &state);
  if (st == HC_OK) st = timeint_orbit(r->ti, row->omega, 1, &state, r->monitor, &restarted);
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st; /* nothing is known */
  if (st != HC_OK) return HC_OK;
  const periodic_motion there = motion_of_transient(&restarted), here = motion_of_transient(&row->transient);
  *next = motion_discrepancy(&there, &here).waveform <= same;
  return HC_OK;
}

static bool unstable(const comparison_row *row)
{
  if (row->orbit_status == HC_OK && timeint_stability(&row->orbit) != 0) return timeint_stability(&row->orbit) < 0;
  return hbm_stability_verdict(&row->stability) < 0;
}

/* HC_NO_MEMORY, HC_INTERRUPTED: *out is not known. */
static hc_status judge(runner *r, const comparison_row *row, const double *X, verdict *out)
{
  if (row->transient_status == HC_NOT_SETTLED) return *out = VERDICT_NOT_SETTLED, HC_OK;
  if (row->transient_status == HC_APERIODIC && row->hbm_status == HC_OK) return *out = VERDICT_APERIODIC, HC_OK;
  if (row->transient_status != HC_OK || row->hbm_status != HC_OK) return *out = VERDICT_SOLVER_FAILED, HC_OK;
  if (row->transient.period_multiple > 1) return *out = VERDICT_PERIOD_K, HC_OK;
  if (within_limits(r->setup, &row->errors, &row->transient)) return *out = VERDICT_MATCH, HC_OK;
  if (unstable(row)) return *out = VERDICT_UNSTABLE, HC_OK;
  bool next = true;
  hc_status st = runs_next_to(r, row, X, &next);
  *out = next ? VERDICT_DIFFERS : VERDICT_OTHER_BRANCH;
  return st;
}

/* The orbit of the exact law next to the HBM solution; not computed again where the transient is just that. */
static void referee(runner *r, comparison_row *row, const double *X)
{
  const transient_settings *t = &r->setup->transient;
  const timeint_result *tr = &row->transient;
  bool same = t->law == TRANSIENT_LAW_EXACT && t->start == TRANSIENT_START_HBM && row->transient_status == HC_OK &&
              !tr->left_orbit && tr->period_multiple == 1 && tr->method == TIMEINT_BY_SHOOTING;
  timeint_state state;
  if (same) row->orbit = *tr, row->orbit_status = HC_OK;
  else if ((row->orbit_status = comparison_orbit_start(r->hbm, X, row->omega, &state)) == HC_OK)
    row->orbit_status = timeint_orbit(r->exact, row->omega, 1, &state, r->monitor, &row->orbit);
  row->orbit_error = NAN;
  if (row->orbit_status != HC_OK) return;
  row->orbit_error = comparison_waveform_error(&row->hbm, hbm_n_harmonics(r->hbm), X, &row->orbit);
}

/* What the discrepancy is made of. */
static hc_status account(runner *r, const hbm_curve *at, int k, comparison_row *row)
{
  const budget_case from = {.omega = row->omega,
                            .n_harm = at->points[k].harmonics,
                            .X = at->X + (size_t)k * at->n_coef,
                            .hbm = &row->hbm,
                            .transient_status = row->transient_status,
                            .transient = &row->transient,
                            .orbit_status = row->orbit_status,
                            .orbit = &row->orbit,
                            .state = row->transient_state};
  return row->hbm_status == HC_OK ? budgeter_run(r->budgeter, &from, r->monitor, &row->budget) : HC_OK;
}

/* One HBM solution against the transient started from it. */
static hc_status compare_solution(runner *r, const hbm_curve *at, int k, comparison_row *row)
{
  const double *X = at->X + (size_t)k * at->n_coef;
  timeint_state state;
  row->branch = at->points[k].branch;
  row->hbm_status = hbm_measure(r->hbm, X, &row->hbm);
  hc_status known = hbm_stability_at(r->hbm, row->omega, X, &row->stability);
  if (known == HC_NO_MEMORY) return known;
  if (known != HC_OK) row->stability.multiplier = NAN;
  row->transient_status = start_state(r, row, X, &state);
  if (row->transient_status == HC_OK)
    row->transient_status = timeint_steady(r->ti, row->omega, &state, r->monitor, &row->transient);
  if (row->transient_status == HC_INTERRUPTED || row->transient_status == HC_NO_MEMORY) return row->transient_status;
  referee(r, row, X);
  if (row->orbit_status == HC_INTERRUPTED || row->orbit_status == HC_NO_MEMORY) return row->orbit_status;
  bool comparable = row->hbm_status == HC_OK && row->transient_status == HC_OK;
  if (comparable) row->errors = errors_between(&row->hbm, hbm_n_harmonics(r->hbm), X, &row->transient);
  row->accounted =
      comparable && row->transient.period_multiple == 1 && accounted_for(r->hbm, r->setup, at, &row->transient);
  hc_status judged = judge(r, row, X, &row->verdict);
  if (judged != HC_OK) return judged;
  row->transient_state = state;
  return account(r, at, k, row);
}

/* Every HBM solution at omega. */
static hc_status compare_at(runner *r, double omega)
{
  hbm_curve at = {0};
  const comparison_row none = {.omega = omega,
                               .branch = -1,
                               .verdict = VERDICT_SOLVER_FAILED,
                               .transient_status = HC_UNSUPPORTED,
                               .orbit_status = HC_UNSUPPORTED,
                               .errors = {NAN, NAN, NAN, NAN},
                               .orbit_error = NAN,
                               .budget = budget_nothing()};
  comparison_row row = none;
  row.hbm_status = hbm_curve_at(r->hbm, &r->out->curve, omega, &at);
  if (row.hbm_status == HC_OK && at.n == 0)
    row.hbm_status = r->out->curve.end != HC_OK ? r->out->curve.end : HC_NOT_CONVERGED;
  hc_status st = row.hbm_status == HC_NO_MEMORY         ? row.hbm_status
                 : at.n == 0 || row.hbm_status != HC_OK ? add_row(r->out, &row)
                                                        : HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    row = none;
    st = compare_solution(r, &at, k, &row);
    /* what was stopped inside may look like an answer */
    if (st == HC_OK && !hc_monitor_tick(r->monitor, 1)) st = HC_INTERRUPTED;
    if (st == HC_OK) st = add_row(r->out, &row);
  }
  hbm_curve_free(&at);
  return st;
}

static void begin_sweep(runner *r)
{
  bool down = r->setup->transient.start == TRANSIENT_START_DOWN;
  double low = fmin(r->setup->omega_from, r->setup->omega_to), high = fmax(r->setup->omega_from, r->setup->omega_to);
  r->swept_omega = down ? high : low;
  r->swept = timeint_rest(r->ti);
}

/* Part i of n of the whole work, for the monitor of the inner loops. */
typedef struct share {
  const hc_monitor *outer;
  double from, width;
} share;

static bool tick_share(void *self, double done)
{
  const share *s = self;
  return hc_monitor_tick(s->outer, s->from + s->width * (done > 0 ? done : 0));
}

static hc_status compare_all(runner *r)
{
  const hc_monitor *outer = r->monitor;
  number_list omega;
  hc_status st = comparison_frequencies(&r->setup->compare, r->setup->omega_from, r->hbm, &r->out->curve, &omega);
  begin_sweep(r);
  for (int i = 0; i < omega.n && st == HC_OK; ++i) {
    int at = r->setup->transient.start == TRANSIENT_START_DOWN ? omega.n - 1 - i : i;
    share part = {outer, (double)i / omega.n, 1.0 / omega.n};
    hc_monitor inner = {tick_share, &part};
    r->monitor = &inner;
    st = compare_at(r, omega.v[at]);
  }
  r->monitor = outer;
  return st;
}

hc_status comparison_referee(const compare_setup *setup, timeint **out)
{
  compare_setup own = *setup;
  own.transient.law = TRANSIENT_LAW_EXACT;
  own.transient.tolerance = fmin(setup->transient.tolerance, 1e-9);
  return timeint_new(own.model, &own.transient, out);
}

hc_status comparison_run(const compare_setup *setup, const hc_monitor *monitor, comparison *out)
{
  *out = (comparison){0};
  runner r = {.setup = setup, .monitor = monitor, .out = out};
  hc_status st = hbm_solver_new(setup->model, &setup->hbm, &r.hbm);
  if (st == HC_OK) st = timeint_new(setup->model, &setup->transient, &r.ti);
  if (st == HC_OK) st = comparison_referee(setup, &r.exact);
  if (st == HC_OK) st = budgeter_new(setup, &r.budgeter);
  if (st == HC_OK) {
    double from, to;
    comparison_sweep(setup->omega_from, setup->omega_to, &setup->compare.omega, &from, &to);
    st = hbm_trace(r.hbm, from, to, monitor, &out->curve);
    out->harmonics = hbm_n_harmonics(r.hbm);
    out->samples = hbm_n_samples(r.hbm);
    hc_status summed = response_summarise(r.hbm, &out->curve, &out->summary);
    if (summed != HC_OK) st = summed;
    if (st != HC_INTERRUPTED && st != HC_NO_MEMORY) st = compare_all(&r); /* as far as the curve goes */
  }
  budgeter_free(r.budgeter);
  timeint_free(r.exact);
  timeint_free(r.ti);
  hbm_solver_free(r.hbm);
  return st;
}

void comparison_clear(comparison *c)
{
  hbm_curve_free(&c->curve);
  free(c->rows);
  *c = (comparison){0};
}

bool comparison_unaccounted(const comparison_row *row)
{
  bool known = row->transient_status == HC_OK || row->transient_status == HC_APERIODIC;
  return known && row->hbm_status == HC_OK && !row->accounted;
}

int comparison_exit_code(const comparison *c)
{
  for (int i = 0; i < c->n_rows; ++i)
    if (comparison_unaccounted(&c->rows[i])) return 1;
  if (c->curve.end != HC_OK) return 3; /* what lies beyond was not compared, and the curve might have come back */
  if (c->count[VERDICT_SOLVER_FAILED] > 0 || c->count[VERDICT_NOT_SETTLED] > 0 || c->count[VERDICT_MATCH] == 0)
    return 3;
  return 0;
}
