/* truth.c - see truth.h. The number of harmonics starts at LEAST_HARMONICS, or twice the case's, and is doubled until
 * the solutions are within a tenth of the gate of the exact law's orbits: a verdict is then wrong only for points
 * within that of the limit. */
#include "compare/verify/truth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/first_guess.h"
#include "compare/frequencies.h"
#include "compare/gate_limits.h"
#include "compare/verify/acceleration.h"
#include "compare/verify/solutions.h"
#include "compare/verify/truth_impl.h"

enum { LEAST_HARMONICS = 20, ENOUGH_HARMONICS = 80 };
static const double far = 7; /* a little over 2 pi: mixed units are seen from there */

void verify_window(const compare_setup *setup, const verify_data *data, double *from, double *to)
{
  number_list ends = {.n = 2, .v = {INFINITY, 0}};
  const double low = fmin(setup->omega_from, setup->omega_to) / far,
               high = fmax(setup->omega_from, setup->omega_to) * far;
  for (int i = 0; i < data->n; ++i) {
    double omega = data->points[i].omega;
    if (omega < low || omega > high) continue;
    ends.v[0] = fmin(ends.v[0], omega);
    ends.v[1] = fmax(ends.v[1], omega);
  }
  if (!(ends.v[0] <= ends.v[1])) ends.n = 0;
  comparison_sweep(setup->omega_from, setup->omega_to, &ends, from, to);
}

double verify_gate(const compare_setup *setup, const verify_quantity *q)
{
  const discrepancy *most = &setup->limits->most;
  if (q->kind == KIND_MEAN) return most->mean;
  return q->kind == KIND_HARMONIC && q->harmonic == 1 ? most->harmonic_1 : most->amplitude;
}

/* ---- one point ---- */

int truth_stable(truth *t, double omega, const double *X, hc_status *st)
{
  hbm_stability s;
  hc_status known = hbm_stability_at(t->hbm, omega, X, &s);
  if (known == HC_NO_MEMORY) *st = known;
  return known == HC_OK ? hbm_stability_verdict(&s) : 0;
}

/* A slider that never slips rests where the history left it. Of an oscillator's several contacts, which move as one,
 * the strongest state is asked: where that is stick, none slips. */
static bool mean_is_free(const model *m, const contact_report *r)
{
  bool held = false;
  if (!model_is_oscillator(m)) return r->free_sliders > 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const contact *c = &m->contacts[j].law;
    held |= c->kt > 0 && c->mu > 0 && *m->contacts[j].tangent != 0;
  }
  return held && r->regime == CONTACT_STUCK;
}

hc_status truth_measure(truth *t, double omega, const double *X, measured *out)
{
  hbm_measures m;
  verify_motion motion;
  hc_status st = verify_motion_of_solution(t->hbm, omega, X, 0, t->series, &m, &motion);
  if (st != HC_OK) return st;
  const verify_quantity *q = &t->data->quantity;
  const bool mean_free = mean_is_free(t->setup->model, &m.contact);
  if (q->kind == KIND_ACCELERATION) {
    st = hbm_sliders(t->hbm, X, t->room);
    const double amplitude = st == HC_OK ? acceleration_amplitude(t->setup->model, &motion, t->room) : NAN;
    *out = (measured){amplitude, amplitude, mean_free};
    return st;
  }
  *out = (measured){verify_quantity_of(q, &motion), verify_quantity_scale(q, &motion), mean_free};
  return HC_OK;
}

int truth_nearest(truth *t, const hbm_curve *at, const verify_row *row, measured *nearest)
{
  int best = -1;
  double least = INFINITY;
  for (int k = 0; k < at->n; ++k) {
    measured m;
    if (truth_measure(t, row->omega, at->X + (size_t)k * at->n_coef, &m) != HC_OK) continue;
    double d = fabs(m.value - row->value);
    if (d < least) least = d, best = k, *nearest = m;
  }
  return best;
}

hc_status truth_at(truth *t, double omega, hbm_curve *at)
{
  if (omega < fmin(t->from, t->to) || omega > fmax(t->from, t->to)) return HC_OK;
  if (hbm_curve_at(t->hbm, &t->curve, omega, at) == HC_NO_MEMORY) return HC_NO_MEMORY;
  if (at->n > 0) return HC_OK;
  double *X = calloc((size_t)t->curve.n_coef, sizeof *X);
  hbm_point point;
  hc_status st = X ? hbm_solve_first(t->hbm, omega, X, &point) : HC_NO_MEMORY;
  at->n_coef = t->curve.n_coef;
  if (st == HC_OK && (at->X = X) && (at->points = calloc(1, sizeof point))) {
    at->points[0] = point;
    at->points[0].omega = omega;
    at->points[0].branch = 0;
    at->n = at->cap = 1;
    return HC_OK;
  }
  if (at->X != X) free(X);
  return st == HC_NO_MEMORY || at->X ? HC_NO_MEMORY : HC_OK;
}

static hc_status judge_point(truth *t, const verify_point *p, verify_row *row)
{
  hbm_curve at = {0};
  measured m = {0};
  *row = (verify_row){.omega = p->omega,
                      .value = p->value,
                      .line = p->line,
                      .branch = -1,
                      .nearest = NAN,
                      .error = NAN,
                      .verdict = VERDICT_SOLVER_FAILED};
  hc_status st = truth_at(t, p->omega, &at);
  int k = st == HC_OK ? truth_nearest(t, &at, row, &m) : -1;
  if (k >= 0 && at.points) {
    row->solutions = at.n;
    row->branch = at.points[k].branch;
    row->nearest = m.value;
    row->scale = m.scale;
    row->free_sliders = m.mean_free;
    row->skipped = m.mean_free && verify_quantity_of_mean(&t->data->quantity);
    row->error = row->skipped ? NAN : discrepancy_relative(p->value - row->nearest, m.scale);
    row->stable = truth_stable(t, p->omega, at.X + (size_t)k * at.n_coef, &st);
    if (!row->skipped && !(row->error <= t->out->gate) && st == HC_OK) st = truth_look_around(t, row);
    row->stable_too = row->stable > 0;
    for (int j = 0; j < at.n && row->stable < 0 && !row->stable_too; ++j)
      row->stable_too = j != k && truth_stable(t, p->omega, at.X + (size_t)j * at.n_coef, &st) > 0;
    row->verdict = row->skipped                    ? VERDICT_MATCH
                   : !(row->error <= t->out->gate) ? VERDICT_DIFFERS
                   : row->stable < 0               ? VERDICT_UNSTABLE
                                                   : VERDICT_MATCH;
  }
  hbm_curve_free(&at);
  return st;
}

/* ---- all points ---- */

static hc_status judge_all(truth *t)
{
  hc_status st = HC_OK;
  t->out->n_rows = 0;
  for (int i = 0; i < t->data->n && st == HC_OK; ++i) {
    st = judge_point(t, &t->data->points[i], &t->out->rows[i]);
    if (st == HC_OK) t->out->n_rows = i + 1;
    if (!hc_monitor_tick(t->monitor, 0.5 * (i + 1) / t->data->n)) st = HC_INTERRUPTED;
  }
  return st;
}

/* The curve with H harmonics, and everything on it. */
static hc_status with_harmonics(truth *t, int harmonics)
{
  const verify_equations e = {.keep_mean = true, .harmonics = harmonics};
  const compare_setup own = verify_settings(t->setup, &e);
  hbm_curve_free(&t->curve);
  t->curve = (hbm_curve){0};
  hbm_solver_free(t->hbm);
  free(t->series);
  t->hbm = NULL;
  if (!(t->series = malloc((2 * (size_t)harmonics + 1) * sizeof *t->series))) return HC_NO_MEMORY;
  hc_status st = guided_hbm_solver_new(own.model, &own.hbm, &t->hbm);
  if (st != HC_OK) return st;
  st = hbm_trace(t->hbm, t->from, t->to, t->monitor, &t->curve);
  t->curve.n_coef = hbm_n_coefficients(t->hbm);
  t->out->harmonics = harmonics;
  t->out->curve_end = t->curve.end;
  t->out->curve_omega = t->curve.n ? t->curve.points[t->curve.n - 1].omega : t->from;
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return st;
  st = judge_all(t);
  return st == HC_OK ? truth_check(t) : st;
}

hc_status verify_truth(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor,
                       verify_report *out)
{
  truth t = {.setup = setup, .data = data, .monitor = monitor, .out = out};
  out->gate = verify_gate(setup, &data->quantity);
  out->rows = calloc((size_t)data->n, sizeof *out->rows);
  verify_window(setup, data, &t.from, &t.to);
  hc_status st = out->rows ? comparison_referee(setup, &t.referee) : HC_NO_MEMORY;
  if (st == HC_OK && !(t.state = calloc((size_t)timeint_n_states(t.referee), sizeof *t.state))) st = HC_NO_MEMORY;
  if (st == HC_OK && !(t.room = calloc(acceleration_room(setup->model), sizeof *t.room))) st = HC_NO_MEMORY;
  int harmonics = 2 * setup->hbm.harmonics; /* 0 for auto */
  harmonics = harmonics < LEAST_HARMONICS     ? LEAST_HARMONICS
              : harmonics > HBM_MAX_HARMONICS ? HBM_MAX_HARMONICS
                                              : harmonics;
  for (bool again = true; again && st == HC_OK; harmonics *= 2) {
    st = with_harmonics(&t, harmonics);
    again = out->checked_error > 0.1 * out->gate && 2 * harmonics <= ENOUGH_HARMONICS;
  }
  if (st == HC_OK && data->with_line) st = truth_line(&t);
  hbm_curve_free(&t.curve);
  hbm_solver_free(t.hbm);
  free(t.state);
  free(t.room);
  free(t.series);
  timeint_free(t.referee);
  return st;
}
