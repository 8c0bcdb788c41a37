/* comparison.c - see comparison.h. What is swept here are frequencies and branches; what one row's numbers mean is
 * errors_between(). */
#include "compare/comparison.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "compare/frequencies.h"
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

timeint_state comparison_orbit_start(const hbm_measures *m, int n_harm, const double *X, double omega)
{
  series_jet j = series_at(n_harm, X, 1, 0);
  timeint_state s = {.x = j.x, .v = omega * j.d1};
  memcpy(s.w, m->contact.w, sizeof s.w);
  return s;
}

/* Largest |x_hbm(t) - x_transient(t)| over the period. */
static double waveform_distance(int n_harm, const double *X, const timeint_result *tr)
{
  const double shift = tr->free_sliders > 0 ? X[0] - tr->mean : 0; /* a mean of its own history is no difference */
  double worst = 0;
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double th = TWO_PI * i / TIMEINT_WAVE;
    double d = fabs(series_at(n_harm, X, cos(th), sin(th)).x - tr->wave[i] - shift);
    if (!(d >= 0)) return NAN;
    if (d > worst) worst = d;
  }
  return worst;
}

/* |difference| / amplitude; no difference is no error, also where nothing moves (no forcing). */
static double relative(double difference, double amplitude)
{
  return difference == 0 ? 0 : fabs(difference) / amplitude;
}

double comparison_waveform_error(int n_harm, const double *X, const timeint_result *tr)
{
  return relative(waveform_distance(n_harm, X, tr), tr->amplitude);
}

static comparison_errors errors_between(const hbm_measures *hbm, int n_harm, const double *X, const timeint_result *tr)
{
  double a = tr->amplitude;
  return (comparison_errors){
      .amplitude = relative(hbm->amplitude - a, a),
      .harmonic_1 = relative(hbm->harmonic_1 - tr->harmonic_1, a),
      .mean = relative(hbm->mean - tr->mean, a),
      .waveform = comparison_waveform_error(n_harm, X, tr),
  };
}

/* Where a slider is free the mean is a matter of history, and not held against HBM. */
static bool within_gate(const comparison_errors *e, const timeint_result *tr, const scene_gate *g)
{
  bool mean = tr->free_sliders > 0 || e->mean <= g->mean;
  return e->amplitude <= g->amplitude && e->harmonic_1 <= g->harmonic_1 && mean && e->waveform <= g->waveform;
}

/* Is the transient within the gate of any HBM solution at this omega? */
static bool accounted_for(hbm_solver *hbm, const scene *sc, const hbm_curve *at, const timeint_result *tr)
{
  const scene_gate gate = scene_gate_at(sc, tr->omega);
  for (int i = 0; i < at->n; ++i) {
    const double *X = at->X + (size_t)i * at->n_coef;
    hbm_measures m;
    if (hbm_measure(hbm, X, &m) != HC_OK) continue;
    comparison_errors e = errors_between(&m, hbm_n_harmonics(hbm), X, tr);
    if (within_gate(&e, tr, &gate)) return true;
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
  const scene *sc;
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
  switch (r->sc->transient.start) {
  case TRANSIENT_START_HBM:
    *state = comparison_orbit_start(&row->hbm, hbm_n_harmonics(r->hbm), X, row->omega);
    return HC_OK;
  case TRANSIENT_START_REST: *state = timeint_rest(r->ti); return HC_OK;
  default: break;
  }
  hc_status st = timeint_sweep(r->ti, r->swept_omega, row->omega, &r->swept, r->monitor);
  r->swept_omega = row->omega;
  *state = r->swept;
  return st;
}

/* Largest difference of two transients over the period, relative to the second one's amplitude. */
static double orbits_apart(const timeint_result *a, const timeint_result *b)
{
  const double shift = a->free_sliders > 0 || b->free_sliders > 0 ? a->mean - b->mean : 0;
  double worst = 0;
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double d = fabs(a->wave[i] - b->wave[i] - shift);
    if (!(d <= worst)) worst = d; /* NaN stays */
  }
  return relative(worst, b->amplitude);
}

/* Does the transient run on the orbit next to the HBM solution? It does if it was found there. Otherwise, having
 * come from elsewhere, that orbit is computed from the HBM solution, with the transient's own law, and the two are
 * held together: same law, same orbit, so that the difference is of the order of transient.tolerance, and anything
 * beyond `same` is another orbit. */
static bool runs_next_to(runner *r, const comparison_row *row, const double *X)
{
  const double same = fmax(1e-6, 100 * r->sc->transient.tolerance);
  if (r->sc->transient.start == TRANSIENT_START_HBM && row->transient.method != TIMEINT_BY_MARCHING)
    return !row->transient.left_orbit;
  timeint_state state = comparison_orbit_start(&row->hbm, hbm_n_harmonics(r->hbm), X, row->omega);
  timeint_result restarted;
  /* none there: what differs is HBM */
  if (timeint_orbit(r->ti, row->omega, 1, &state, r->monitor, &restarted) != HC_OK) return true;
  return orbits_apart(&restarted, &row->transient) <= same;
}

static bool unstable(const comparison_row *row)
{
  if (row->orbit_status == HC_OK && timeint_stability(&row->orbit) != 0) return timeint_stability(&row->orbit) < 0;
  return hbm_stability_verdict(&row->stability) < 0;
}

static verdict judge(runner *r, const comparison_row *row, const double *X)
{
  if (row->transient_status == HC_NOT_SETTLED) return VERDICT_NOT_SETTLED;
  if (row->transient_status == HC_APERIODIC && row->hbm_status == HC_OK) return VERDICT_APERIODIC;
  if (row->transient_status != HC_OK || row->hbm_status != HC_OK) return VERDICT_SOLVER_FAILED;
  if (row->transient.period_multiple > 1) return VERDICT_PERIOD_K;
  const scene_gate gate = scene_gate_at(r->sc, row->omega);
  if (within_gate(&row->errors, &row->transient, &gate)) return VERDICT_MATCH;
  if (unstable(row)) return VERDICT_UNSTABLE;
  return runs_next_to(r, row, X) ? VERDICT_DIFFERS : VERDICT_OTHER_BRANCH;
}

/* The orbit of the exact law next to the HBM solution; not computed again where the transient is just that. */
static void referee(runner *r, comparison_row *row, const double *X)
{
  const scene_transient *t = &r->sc->transient;
  const timeint_result *tr = &row->transient;
  bool same = t->law == TRANSIENT_LAW_EXACT && t->start == TRANSIENT_START_HBM && row->transient_status == HC_OK &&
              !tr->left_orbit && tr->period_multiple == 1 && tr->method == TIMEINT_BY_SHOOTING;
  timeint_state state = comparison_orbit_start(&row->hbm, hbm_n_harmonics(r->hbm), X, row->omega);
  if (same) row->orbit = *tr, row->orbit_status = HC_OK;
  else row->orbit_status = timeint_orbit(r->exact, row->omega, 1, &state, r->monitor, &row->orbit);
  row->orbit_error = NAN;
  if (row->orbit_status != HC_OK) return;
  row->orbit_error = comparison_waveform_error(hbm_n_harmonics(r->hbm), X, &row->orbit);
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
      comparable && row->transient.period_multiple == 1 && accounted_for(r->hbm, r->sc, at, &row->transient);
  row->verdict = judge(r, row, X);
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
  bool down = r->sc->transient.start == TRANSIENT_START_DOWN;
  double low = fmin(r->sc->omega_from, r->sc->omega_to), high = fmax(r->sc->omega_from, r->sc->omega_to);
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
  scene_list omega;
  hc_status st = comparison_frequencies(r->sc, r->hbm, &r->out->curve, &omega);
  begin_sweep(r);
  for (int i = 0; i < omega.n && st == HC_OK; ++i) {
    int at = r->sc->transient.start == TRANSIENT_START_DOWN ? omega.n - 1 - i : i;
    share part = {outer, (double)i / omega.n, 1.0 / omega.n};
    hc_monitor inner = {tick_share, &part};
    r->monitor = &inner;
    st = compare_at(r, omega.v[at]);
  }
  r->monitor = outer;
  return st;
}

hc_status comparison_referee(const scene *sc, timeint **out)
{
  scene own = *sc;
  own.transient.law = TRANSIENT_LAW_EXACT;
  own.transient.tolerance = fmin(sc->transient.tolerance, 1e-9);
  return timeint_new(&own, out);
}

hc_status comparison_run(const scene *sc, const hc_monitor *monitor, comparison *out)
{
  *out = (comparison){0};
  runner r = {.sc = sc, .monitor = monitor, .out = out};
  hc_status st = hbm_solver_new(sc, &r.hbm);
  if (st == HC_OK) st = timeint_new(sc, &r.ti);
  if (st == HC_OK) st = comparison_referee(sc, &r.exact);
  if (st == HC_OK) st = budgeter_new(sc, &r.budgeter);
  if (st == HC_OK) {
    double from, to;
    comparison_sweep(sc, &sc->compare.omega, &from, &to);
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
