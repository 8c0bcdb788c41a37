/* comparison.c - see comparison.h. What is swept here are frequencies and branches; what one row's numbers mean is errors_between(). */
#include "compare/measure/comparison.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/measure/frequencies.h"
#include "hbm/series.h"

static const struct { const char *name, *meaning; } verdicts[] = {
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
  double worst = 0;
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double th = 6.283185307179586476925 * i / TIMEINT_WAVE;
    double d = fabs(series_at(n_harm, X, cos(th), sin(th)).x - tr->wave[i]);
    if (!(d >= 0)) return NAN;
    if (d > worst) worst = d;
  }
  return worst;
}

/* |difference| / amplitude; no difference is no error, also where nothing moves (no forcing). */
static double relative(double difference, double amplitude) { return difference == 0 ? 0 : fabs(difference) / amplitude; }

static comparison_errors errors_between(const hbm_measures *hbm, int n_harm, const double *X, const timeint_result *tr)
{
  double a = tr->amplitude;
  return (comparison_errors){
      .amplitude = relative(hbm->amplitude - a, a),
      .harmonic_1 = relative(hbm->harmonic_1 - tr->harmonic_1, a),
      .mean = relative(hbm->mean - tr->mean, a),
      .waveform = relative(waveform_distance(n_harm, X, tr), a),
  };
}

static bool within_gate(const comparison_errors *e, const scene_gate *g)
{
  return e->amplitude <= g->amplitude && e->harmonic_1 <= g->harmonic_1 && e->mean <= g->mean && e->waveform <= g->waveform;
}

/* The transient belongs to another branch if another solution's orbit is clearly nearer than the one it started from. */
static bool another_is_nearer(const hbm_curve *at, int k, int n_harm, const timeint_result *tr, double own_error)
{
  for (int i = 0; i < at->n; ++i) {
    if (i == k) continue;
    if (waveform_distance(n_harm, at->X + (size_t)i * at->n_coef, tr) / tr->amplitude < 0.5 * own_error) return true;
  }
  return false;
}

/* Is the transient within the gate of any HBM solution at this omega? */
static bool accounted_for(hbm_solver *hbm, const scene *sc, const hbm_curve *at, const timeint_result *tr)
{
  for (int i = 0; i < at->n; ++i) {
    const double *X = at->X + (size_t)i * at->n_coef;
    hbm_measures m;
    if (hbm_measure(hbm, X, &m) != HC_OK) continue;
    comparison_errors e = errors_between(&m, hbm_n_harmonics(hbm), X, tr);
    if (within_gate(&e, &sc->gate)) return true;
  }
  return false;
}

static verdict judge(const scene *sc, const hbm_curve *at, int k, int n_harm, const comparison_row *row)
{
  if (row->transient_status == HC_NOT_SETTLED) return VERDICT_NOT_SETTLED;
  if (row->transient_status != HC_OK || row->hbm_status != HC_OK) return VERDICT_SOLVER_FAILED;
  if (row->transient.period_multiple > 1) return VERDICT_PERIOD_K;
  if (within_gate(&row->errors, &sc->gate)) return VERDICT_MATCH;
  if (hbm_stability_verdict(&row->stability) < 0) return VERDICT_UNSTABLE;
  return another_is_nearer(at, k, n_harm, &row->transient, row->errors.waveform) ? VERDICT_OTHER_BRANCH : VERDICT_DIFFERS;
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
  const hc_monitor *monitor;
  comparison *out;
  timeint_state swept;  /* where a sweep start has come to */
  double swept_omega;
} runner;

/* The transient's state at the start of a row. HC_OK, or why the sweep up to here failed. */
static hc_status start_state(runner *r, const comparison_row *row, const double *X, timeint_state *state)
{
  switch (r->sc->transient.start) {
  case TRANSIENT_START_HBM: *state = comparison_orbit_start(&row->hbm, hbm_n_harmonics(r->hbm), X, row->omega); return HC_OK;
  case TRANSIENT_START_REST: *state = timeint_rest(r->ti); return HC_OK;
  default: break;
  }
  hc_status st = timeint_sweep(r->ti, r->swept_omega, row->omega, &r->swept, r->monitor);
  r->swept_omega = row->omega;
  *state = r->swept;
  return st;
}

/* Every HBM solution at omega against the transient started from it. */
static hc_status compare_at(runner *r, double omega)
{
  hbm_curve at = {0};
  int n_harm = hbm_n_harmonics(r->hbm);
  comparison_row row = {.omega = omega, .branch = -1, .verdict = VERDICT_SOLVER_FAILED, .transient_status = HC_UNSUPPORTED};
  row.errors = (comparison_errors){NAN, NAN, NAN, NAN};
  row.hbm_status = hbm_curve_at(r->hbm, &r->out->curve, omega, &at);
  if (row.hbm_status == HC_OK && at.n == 0) row.hbm_status = r->out->curve.end != HC_OK ? r->out->curve.end : HC_NOT_CONVERGED;
  hc_status st = at.n == 0 || row.hbm_status != HC_OK ? add_row(r->out, &row) : HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    const double *X = at.X + (size_t)k * at.n_coef;
    timeint_state state;
    row.branch = at.points[k].branch;
    row.hbm_status = hbm_measure(r->hbm, X, &row.hbm);
    if (hbm_stability_at(r->hbm, omega, X, &row.stability) != HC_OK) row.stability.multiplier = NAN;
    row.transient_status = start_state(r, &row, X, &state);
    if (row.transient_status == HC_OK) row.transient_status = timeint_steady(r->ti, omega, &state, r->monitor, &row.transient);
    if (row.transient_status == HC_INTERRUPTED) { st = HC_INTERRUPTED; break; }
    bool comparable = row.hbm_status == HC_OK && row.transient_status == HC_OK;
    row.errors = comparable ? errors_between(&row.hbm, n_harm, X, &row.transient) : (comparison_errors){NAN, NAN, NAN, NAN};
    row.accounted = comparable && row.transient.period_multiple == 1 && accounted_for(r->hbm, r->sc, &at, &row.transient);
    row.verdict = judge(r->sc, &at, k, n_harm, &row);
    st = add_row(r->out, &row);
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
typedef struct share { const hc_monitor *outer; double from, width; } share;

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

hc_status comparison_run(const scene *sc, const hc_monitor *monitor, comparison *out)
{
  *out = (comparison){0};
  runner r = {.sc = sc, .monitor = monitor, .out = out};
  hc_status st = hbm_solver_new(sc, &r.hbm);
  if (st == HC_OK) st = timeint_new(sc, &r.ti);
  if (st == HC_OK) {
    double from, to;
    comparison_sweep(sc, &sc->compare.omega, &from, &to);
    st = hbm_trace(r.hbm, from, to, monitor, &out->curve);
    out->harmonics = hbm_n_harmonics(r.hbm);
    out->samples = hbm_n_samples(r.hbm);
    if (st != HC_INTERRUPTED && st != HC_NO_MEMORY) st = compare_all(&r); /* as far as the curve goes */
  }
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

int comparison_exit_code(const comparison *c)
{
  for (int i = 0; i < c->n_rows; ++i)
    if (c->rows[i].transient_status == HC_OK && c->rows[i].hbm_status == HC_OK && !c->rows[i].accounted) return 1;
  if (c->curve.end != HC_OK) return 3; /* what lies beyond was not compared, and the curve might have come back */
  if (c->count[VERDICT_SOLVER_FAILED] > 0 || c->count[VERDICT_NOT_SETTLED] > 0 || c->count[VERDICT_MATCH] == 0) return 3;
  return 0;
}
