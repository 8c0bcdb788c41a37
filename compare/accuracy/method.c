/* method.c - see method.h. */
#include "compare/accuracy/method.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/thread_clock.h"
#include "compare/first_guess.h"
#include "compare/response.h"

const double bench_longest = 1.5, bench_longest_shot = 0.3;
const double timed_method_slow = 0.2;
static const double shortest_run = 5e-4; /* [s] the clock is good to a microsecond */
static const double other_orbit = 0.3;   /* [amplitude] of the waveform: few harmonics are some ten percent off,
                                          another orbit is elsewhere */

/* A monitor that also stops at a limit of processor time. */
typedef struct limit {
  const hc_monitor *outer;
  double until;
  bool stopped;
} limit;

static bool tick_limit(void *self, double done)
{
  limit *l = self;
  (void)done;
  l->stopped = !hc_monitor_tick(l->outer, -1);
  return !l->stopped && thread_seconds() < l->until;
}

static bool is_hbm(bench_method m) { return m == BENCH_HBM_EXACT || m == BENCH_HBM_SAMPLED; }

compare_setup method_setup(const compare_setup *setup, bench_method method, int harmonics, int samples,
                           double regularisation, double tolerance)
{
  compare_setup own = *setup;
  transient_settings *t = &own.transient;
  if (is_hbm(method)) {
    own.hbm.harmonics = harmonics;
    own.hbm.force = method == BENCH_HBM_EXACT ? HBM_FORCE_EXACT : HBM_FORCE_SAMPLED;
    if (samples > 0) own.hbm.samples = samples;
    return own;
  }
  const bool marches = method == BENCH_EXACT_MARCHING || method == BENCH_REGULARISED_MARCHING;
  t->law = regularisation > 0 ? TRANSIENT_LAW_REGULARISED : TRANSIENT_LAW_EXACT;
  if (regularisation > 0) t->regularisation = regularisation;
  t->tolerance = tolerance;
  t->method = method == BENCH_CLOSED_SHOOTING ? TRANSIENT_METHOD_CLOSED_FORM : TRANSIENT_METHOD_CVODE;
  t->scout = method == BENCH_EXACT_SCOUTED || method == BENCH_REGULARISED_SCOUTED;
  t->steady = marches ? TRANSIENT_STEADY_MARCH : TRANSIENT_STEADY_SHOOTING;
  return own;
}

hc_status method_curve_trace(const compare_setup *setup, const hc_monitor *monitor, method_curve *out)
{
  const double began = thread_seconds();
  *out = (method_curve){.hbm = NULL};
  out->status = response_trace(setup, &setup->compare.omega, monitor, &out->hbm, &out->curve);
  out->seconds = thread_seconds() - began;
  return out->status == HC_INTERRUPTED || out->status == HC_NO_MEMORY ? out->status : HC_OK;
}

void method_curve_free(method_curve *c)
{
  hbm_curve_free(&c->curve);
  hbm_solver_free(c->hbm);
  *c = (method_curve){.hbm = NULL};
}

motion_distance method_error(int n, const periodic_motion *found, const periodic_motion *reference, double size)
{
  motion_distance worst = {0};
  for (int i = 0; i < n; ++i) {
    const motion_distance gap = motion_between(&found[i], &reference[i]);
    if (!(gap.waveform <= worst.waveform)) worst.waveform = gap.waveform;
    if (!(gap.amplitude <= worst.amplitude)) worst.amplitude = gap.amplitude;
    if (!(gap.harmonic_1 <= worst.harmonic_1)) worst.harmonic_1 = gap.harmonic_1;
  }
  return (motion_distance){.amplitude = discrepancy_relative(worst.amplitude, size),
                           .harmonic_1 = discrepancy_relative(worst.harmonic_1, size),
                           .mean = NAN,
                           .waveform = discrepancy_relative(worst.waveform, size)};
}

static double quantile(int n, const double *v, double at)
{
  if (n == 0) return NAN;
  double rank = at * (n - 1);
  int i = (int)rank;
  return i + 1 < n ? v[i] + (rank - i) * (v[i + 1] - v[i]) : v[n - 1];
}

void method_quartiles(int n, double *v, double *low, double *median, double *high)
{
  qsort(v, (size_t)n, sizeof *v, ascending);
  *low = quantile(n, v, 0.25);
  *median = quantile(n, v, 0.5);
  *high = quantile(n, v, 0.75);
}

/* ---- timed at one frequency ---- */

/* What one solution came to. */
typedef struct answer {
  hc_status status;
  bool too_long;
} answer;

hc_status bench_start_new(const model *m, const hbm_solver *s, bench_start *at)
{
  const int width = hbm_n_coefficients(s) / (2 * hbm_n_harmonics(s) + 1);
  *at = (bench_start){.most_coef = width * (2 * HBM_MAX_HARMONICS + 1),
                      .n_states = 2 * m->n + m->n_contacts,
                      .n_responses = m->n_responses};
  at->X = calloc((size_t)at->most_coef + (size_t)at->n_states, sizeof *at->X);
  at->reference = calloc((size_t)at->n_responses, sizeof *at->reference);
  at->state = at->X ? at->X + at->most_coef : NULL;
  return at->X && at->reference ? HC_OK : HC_NO_MEMORY;
}

void bench_start_free(bench_start *at)
{
  free(at->X);
  free(at->reference);
  *at = (bench_start){0};
}

static void solve_hbm(timed_method *t, const bench_start *at, answer *a)
{
  hbm_point point;
  hbm_measures m;
  memcpy(t->trial, t->X, (size_t)hbm_n_coefficients(t->hbm) * sizeof *t->X);
  a->status = hbm_solve(t->hbm, at->omega, t->trial, &point);
  if (a->status == HC_OK) a->status = hbm_measure(t->hbm, t->trial, &m);
}

static void solve_transient(timed_method *t, const bench_start *at, const hc_monitor *monitor, timeint_result *r,
                            answer *a)
{
  const bool marches = t->setup.transient.steady == TRANSIENT_STEADY_MARCH;
  limit l = {monitor, thread_seconds() + (marches ? bench_longest : bench_longest_shot), false};
  hc_monitor limited = {tick_limit, &l};
  memcpy(t->state, at->state, (size_t)at->n_states * sizeof *t->state);
  timeint_forget(t->ti); /* the same solution is asked for again and again */
  a->status = timeint_steady(t->ti, at->omega, t->state, &limited, r);
  a->too_long = a->status == HC_INTERRUPTED && !l.stopped;
}

/* The motion of every response of the last solution. */
static hc_status find_motions(timed_method *t, const bench_start *at, timeint_result *r)
{
  hbm_measures m;
  hc_status st = HC_OK;
  for (int i = 0; i < at->n_responses && st == HC_OK; ++i) {
    if (t->hbm) st = motion_of_response(t->hbm, at->omega, t->trial, i, &m, &t->motion[i]);
    else if (i == 0 || (st = timeint_response(t->ti, i, r)) == HC_OK) t->motion[i] = motion_of_transient(r);
  }
  return st;
}

/* A batch of solutions; the time of one. */
static double solve(timed_method *t, const bench_start *at, const hc_monitor *monitor, answer *a)
{
  timeint_result r;
  *a = (answer){.status = HC_OK};
  const double began = thread_seconds();
  for (int i = 0; i < t->batch; ++i) {
    if (t->hbm) solve_hbm(t, at, a);
    else solve_transient(t, at, monitor, &r, a);
  }
  const double took = thread_seconds() - began;
  t->spent += took;
  if (a->status == HC_OK) a->status = find_motions(t, at, &r);
  return took / t->batch;
}

/* Start from the largest solution at the neighbour on the method's own curve. */
static hc_status from_own_curve(const bench_start *at, const hc_monitor *monitor, timed_method *t)
{
  limit l = {monitor, thread_seconds() + bench_longest_shot, false};
  hc_monitor limited = {tick_limit, &l};
  hbm_curve curve = {0}, found = {0};
  hbm_measures m;
  double most = -1;
  hbm_trace(t->hbm, t->setup.omega_from, t->setup.omega_to, &limited, &curve); /* as far as it comes */
  hc_status st = l.stopped ? HC_INTERRUPTED : hbm_curve_at(t->hbm, &curve, at->neighbour, &found);
  for (int k = 0; k < found.n && st == HC_OK; ++k) {
    const double *X = found.X + (size_t)k * found.n_coef;
    if (hbm_measure(t->hbm, X, &m) != HC_OK || m.amplitude <= most) continue;
    most = m.amplitude;
    memcpy(t->X, X, (size_t)found.n_coef * sizeof *X);
  }
  hbm_curve_free(&found);
  hbm_curve_free(&curve);
  return st == HC_OK && most < 0 ? HC_NOT_CONVERGED : st;
}

/* Workspace and start. The neighbour's solution with these settings is next to that with many harmonics, or on the
 * method's own curve. */
static hc_status make(const bench_start *at, const hc_monitor *monitor, timed_method *t)
{
  hbm_point point;
  if (!is_hbm(t->row->method)) return timeint_new(t->setup.model, &t->setup.transient, &t->ti);
  hc_status st = guided_hbm_solver_new(t->setup.model, &t->setup.hbm, &t->hbm);
  if (st != HC_OK) return st;
  memcpy(t->X, at->X, (size_t)hbm_n_coefficients(t->hbm) * sizeof *t->X);
  return hbm_solve(t->hbm, at->neighbour, t->X, &point) == HC_OK ? HC_OK : from_own_curve(at, monitor, t);
}

static void record_answer(const timed_method *t, const answer *a, const bench_start *at, double took, bench_row *row)
{
  row->status = a->status;
  row->outcome = a->status == HC_OK ? BENCH_SOLVED : a->too_long ? BENCH_TOO_LONG : BENCH_FAILED;
  if (a->status != HC_OK) return;
  const motion_distance error = method_error(at->n_responses, t->motion, at->reference, at->size);
  if (!(error.waveform <= other_orbit)) row->outcome = BENCH_OTHER_ORBIT;
  if (row->outcome != BENCH_SOLVED) return;
  row->error = error.amplitude;
  row->error_harmonic_1 = error.harmonic_1;
  row->seconds = took;
}

static hc_status make_workspace(const bench_start *at, timed_method *t)
{
  t->seconds = calloc((size_t)t->cap, sizeof *t->seconds);
  t->X = calloc(2 * (size_t)at->most_coef + (size_t)at->n_states, sizeof *t->X);
  t->motion = calloc((size_t)at->n_responses, sizeof *t->motion);
  if (!t->seconds || !t->X || !t->motion) return HC_NO_MEMORY;
  t->trial = t->X + at->most_coef;
  t->state = t->trial + at->most_coef;
  return HC_OK;
}

hc_status timed_method_start(const compare_setup *setup, const bench_start *at, bench_row *row, int cap,
                             const hc_monitor *monitor, timed_method *t)
{
  answer a;
  *t = (timed_method){.row = row, .cap = cap, .batch = 1};
  t->setup = method_setup(setup, row->method, row->harmonics, row->samples, row->regularisation, row->tolerance);
  hc_status st = make_workspace(at, t);
  if (st == HC_OK) st = make(at, monitor, t);
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
  if (st != HC_OK) {
    row->status = st;
    row->outcome = BENCH_FAILED;
    return HC_OK;
  }
  double took = solve(t, at, monitor, &a);
  if (a.status == HC_NO_MEMORY || (a.status == HC_INTERRUPTED && !a.too_long)) return a.status;
  record_answer(t, &a, at, took, row);
  if (took > timed_method_slow && row->outcome == BENCH_SOLVED) t->seconds[t->runs++] = took; /* is the only one */
  if (took < shortest_run) t->batch = (int)fmin(ceil(shortest_run / fmax(took, 1e-7)), 1000);
  return HC_OK;
}

hc_status timed_method_run(timed_method *t, const bench_start *at, const hc_monitor *monitor)
{
  answer a;
  if (t->row->outcome != BENCH_SOLVED || t->runs == t->cap) return HC_OK;
  double took = solve(t, at, monitor, &a);
  if (a.too_long) return HC_OK; /* by a hair, this time: not counted */
  if (a.status == HC_OK) t->seconds[t->runs++] = took;
  return a.status;
}

hc_status timed_method_curve(timed_method *t, const hc_monitor *monitor)
{
  limit l = {monitor, thread_seconds() + bench_longest, false};
  hc_monitor limited = {tick_limit, &l};
  double v[3], low, high;
  hc_status st = HC_OK;
  if (t->row->method != BENCH_HBM_EXACT || t->row->outcome != BENCH_SOLVED) return HC_OK;
  for (int i = 0; i < 3 && st == HC_OK; ++i) {
    hbm_curve curve = {0};
    const double began = thread_seconds();
    st = hbm_trace(t->hbm, t->setup.omega_from, t->setup.omega_to, &limited, &curve);
    v[i] = thread_seconds() - began;
    hbm_curve_free(&curve);
  }
  if (st == HC_OK) method_quartiles(3, v, &low, &t->row->curve_seconds, &high);
  /* a curve that ends early has no time */
  return l.stopped || st == HC_NO_MEMORY ? (l.stopped ? HC_INTERRUPTED : st) : HC_OK;
}

void timed_method_finish(timed_method *t)
{
  if (t->row && t->seconds && t->runs > 0) {
    t->row->repeats = t->runs;
    method_quartiles(t->runs, t->seconds, &t->row->low, &t->row->seconds, &t->row->high);
  }
  free(t->seconds);
  free(t->X);
  free(t->motion);
  hbm_solver_free(t->hbm);
  timeint_free(t->ti);
  *t = (timed_method){0};
}
