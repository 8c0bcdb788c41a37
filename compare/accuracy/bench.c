/* bench.c - see bench.h: each method's settings, solutions timed in turns, and the Pareto front. */
#include "compare/accuracy/bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/accuracy/bench_start.h"
#include "compare/accuracy/scipy.h"
#include "compare/first_guess.h"
#include "compare/work_limit.h"
#include "numerics/base/growing.h"
#include "numerics/base/thread_clock.h"
#include "numerics/norm.h"

enum { MOST_SETTINGS = 8, FEWEST = 3 };
static const double enough = 0.25; /* [s] time after which a row is not repeated, if it has run FEWEST times */

/* A method's settings, all pairs of a (harmonics or regularisation) and b (samples or tolerance); 0: none. */
typedef struct family {
  bench_method method;
  int n_a;
  double a[MOST_SETTINGS];
  int n_b;
  double b[MOST_SETTINGS];
} family;
static const family families[] = {
    {BENCH_HBM_EXACT, 7, {1, 3, 5, 10, 20, 40, 80}, 1, {0}},
    {BENCH_HBM_SAMPLED, 5, {1, 5, 10, 20, 40}, 5, {64, 256, 1024, 4096, 16384}},
    {BENCH_CLOSED_SHOOTING, 1, {0}, 1, {1e-11}},
    {BENCH_EXACT_SCOUTED, 1, {0}, 5, {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}},
    {BENCH_EXACT_SHOOTING, 1, {0}, 5, {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}},
    {BENCH_EXACT_MARCHING, 1, {0}, 5, {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}},
    {BENCH_REGULARISED_SCOUTED, 5, {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}, 3, {1e-4, 1e-6, 1e-8}},
    {BENCH_REGULARISED_SHOOTING, 5, {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}, 3, {1e-4, 1e-6, 1e-8}},
    {BENCH_REGULARISED_MARCHING, 4, {1e-2, 1e-3, 1e-4, 1e-5}, 3, {1e-4, 1e-6, 1e-8}},
};
enum { N_FAMILIES = sizeof families / sizeof *families };

const char *bench_method_name(bench_method m)
{
#define BENCH_NAME(code, name, meaning) name,
  static const char *const names[] = {BENCH_METHOD_LIST(BENCH_NAME)};
#undef BENCH_NAME
  return names[m];
}

const char *bench_outcome_name(bench_outcome o)
{
  static const char *const names[] = {[BENCH_WAITING] = "not_run",
                                      [BENCH_SOLVED] = "solved",
                                      [BENCH_FAILED] = "failed",
                                      [BENCH_OTHER_ORBIT] = "other_orbit",
                                      [BENCH_TOO_LONG] = "too_long"};
  return names[o];
}

const char *bench_settings(const bench_row *r, char text[BENCH_TEXT])
{
  if (r->samples > 0) snprintf(text, BENCH_TEXT, "H = %d, N = %d", r->harmonics, r->samples);
  else if (r->harmonics > 0) snprintf(text, BENCH_TEXT, "H = %d", r->harmonics);
  else if (r->regularisation > 0)
    snprintf(text, BENCH_TEXT, "regularisation %.0e, tolerance %.0e", r->regularisation, r->tolerance);
  else snprintf(text, BENCH_TEXT, "tolerance %.0e", r->tolerance);
  return text;
}

/* ---- a method at one frequency, timed ---- */

const double bench_longest = 1.5, bench_longest_shot = 0.3;
static const double timed_method_slow = 0.2; /* [s] a solution that takes longer is measured by its first run only */
static const double shortest_run = 5e-4;     /* [s] least duration of a timed run; the clock's resolution is a
                                                microsecond */
static const double other_orbit = 0.3;       /* [amplitude] waveform error above which it is another orbit: few
                                                harmonics err by some ten percent */

typedef struct timed_method {
  bench_row *row; /* not owned; settings are read, outcome and errors written */
  compare_setup setup;
  hbm_solver *hbm; /* exactly one of hbm and ti is not NULL */
  timeint *ti;
  workspace memory;        /* of the arrays below */
  double *X, *trial;       /* [most_coef] the HBM method's own solution at the neighbour; at omega */
  double *state;           /* [n_states] */
  periodic_motion *motion; /* [n_responses] of the last solution */
  double *seconds;         /* [cap] of each run */
  int runs, cap, batch;    /* batch: solutions in a run, so that it is long enough for the clock */
  double spent;            /* [s] total time of all runs */
} timed_method;

/* Result of one solution. */
typedef struct answer {
  hc_status status;
  bool too_long;
} answer;

/* Solves a batch; returns the time of one solution. */
static double solve(timed_method *t, const bench_start *at, const hc_monitor *monitor, answer *a)
{
  timeint_result r;
  *a = (answer){.status = HC_OK};
  const double began = thread_seconds();
  for (int i = 0; i < t->batch; ++i) {
    if (t->hbm) {
      hbm_point point;
      hbm_measures m;
      memcpy(t->trial, t->X, (size_t)hbm_n_coefficients(t->hbm) * sizeof *t->X);
      a->status = hbm_solve(t->hbm, at->omega, t->trial, &point);
      if (a->status == HC_OK) a->status = hbm_measure(t->hbm, t->trial, &m);
    } else {
      const bool marches = t->setup.transient.steady == TRANSIENT_STEADY_MARCH;
      work_limit l = {.outer = monitor, .until = thread_seconds() + (marches ? bench_longest : bench_longest_shot)};
      hc_monitor limited = {work_limit_tick, &l};
      memcpy(t->state, at->state, (size_t)at->n_states * sizeof *t->state);
      timeint_forget(t->ti); /* the same solution is computed repeatedly */
      a->status = timeint_steady(t->ti, at->omega, t->state, &limited, &r);
      a->too_long = a->status == HC_INTERRUPTED && !l.stopped;
    }
  }
  const double took = thread_seconds() - began;
  t->spent += took;
  /* The motion of every response of the last solution. */
  if (a->status == HC_OK) {
    hc_status st = HC_OK;
    for (int i = 0; i < at->n_responses && st == HC_OK; ++i) {
      if (t->hbm) st = motion_of_response(t->hbm, at->omega, t->trial, i, NULL, &t->motion[i]);
      else if (i == 0 || (st = timeint_response(t->ti, i, &r)) == HC_OK) t->motion[i] = motion_of_transient(&r);
    }
    a->status = st;
  }
  return took / t->batch;
}

/* Start from the largest solution at the neighbour on the method's own curve. */
static hc_status from_own_curve(const bench_start *at, const hc_monitor *monitor, timed_method *t)
{
  work_limit l = {.outer = monitor, .until = thread_seconds() + bench_longest_shot};
  hc_monitor limited = {work_limit_tick, &l};
  hbm_curve curve = {0}, found = {0};
  hbm_measures m;
  double most = -1;
  hbm_trace(t->hbm, t->setup.omega_from, t->setup.omega_to, &limited, &curve); /* as far as the curve goes */
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

/* Workspace and start: the neighbour's solution, or where Newton fails one of the method's own curve. */
static hc_status make(const bench_start *at, const hc_monitor *monitor, timed_method *t)
{
  hbm_point point;
  if (!method_is_hbm(t->row->method)) return timeint_new(t->setup.model, &t->setup.transient, &t->ti);
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
  /* The largest of each difference between n motions and their references, over `size`; NaN stays. */
  motion_distance worst = {0};
  for (int i = 0; i < at->n_responses; ++i) {
    const motion_distance gap = motion_between(&t->motion[i], &at->reference[i]);
    worst.waveform = larger(worst.waveform, gap.waveform);
    worst.amplitude = larger(worst.amplitude, gap.amplitude);
    worst.harmonic_1 = larger(worst.harmonic_1, gap.harmonic_1);
  }
  const motion_distance error = {.amplitude = discrepancy_relative(worst.amplitude, at->size),
                                 .harmonic_1 = discrepancy_relative(worst.harmonic_1, at->size),
                                 .mean = NAN,
                                 .waveform = discrepancy_relative(worst.waveform, at->size)};
  if (!(error.waveform <= other_orbit)) row->outcome = BENCH_OTHER_ORBIT;
  if (row->outcome != BENCH_SOLVED) return;
  row->error = error.amplitude;
  row->error_harmonic_1 = error.harmonic_1;
  row->seconds = took;
}

/* Makes a method for up to cap runs and does the first run: errors and outcome into the row. HC_INTERRUPTED,
 * HC_NO_MEMORY; a failure of the method itself is the row's outcome. Call timed_method_finish in any case. */
static hc_status timed_method_start(const compare_setup *setup, const bench_start *at, bench_row *row, int cap,
                                    const hc_monitor *monitor, timed_method *t)
{
  answer a;
  *t = (timed_method){.row = row, .cap = cap, .batch = 1};
  t->setup = method_setup(setup, row->method, row->harmonics, row->samples, row->regularisation, row->tolerance);
  t->seconds = workspace_doubles(&t->memory, (size_t)cap);
  t->X = workspace_doubles(&t->memory, (size_t)at->most_coef);
  t->trial = workspace_doubles(&t->memory, (size_t)at->most_coef);
  t->state = workspace_doubles(&t->memory, (size_t)at->n_states);
  t->motion = workspace_array(&t->memory, (size_t)at->n_responses, sizeof *t->motion);
  hc_status st = t->memory.failed ? HC_NO_MEMORY : make(at, monitor, t);
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
  if (st != HC_OK) {
    row->status = st;
    row->outcome = BENCH_FAILED;
    return HC_OK;
  }
  double took = solve(t, at, monitor, &a);
  if (a.status == HC_NO_MEMORY || (a.status == HC_INTERRUPTED && !a.too_long)) return a.status;
  record_answer(t, &a, at, took, row);
  if (took > timed_method_slow && row->outcome == BENCH_SOLVED) t->seconds[t->runs++] = took; /* the only run */
  if (took < shortest_run) t->batch = (int)fmin(ceil(shortest_run / fmax(took, 1e-7)), 1000);
  return HC_OK;
}

/* One more timed run. */
static hc_status timed_method_run(timed_method *t, const bench_start *at, const hc_monitor *monitor)
{
  answer a;
  if (t->row->outcome != BENCH_SOLVED || t->runs == t->cap) return HC_OK;
  double took = solve(t, at, monitor, &a);
  if (a.too_long) return HC_OK; /* just above the limit this time: not counted */
  if (a.status == HC_OK) t->seconds[t->runs++] = took;
  return a.status;
}

/* hbm_exact: time of the whole curve into the row; NaN if too long. */
static hc_status timed_method_curve(timed_method *t, const hc_monitor *monitor)
{
  work_limit l = {.outer = monitor, .until = thread_seconds() + bench_longest};
  hc_monitor limited = {work_limit_tick, &l};
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

/* Median and quartiles of the runs into the row; frees. */
static void timed_method_finish(timed_method *t)
{
  if (t->row && t->seconds && t->runs > 0) {
    t->row->repeats = t->runs;
    method_quartiles(t->runs, t->seconds, &t->row->low, &t->row->seconds, &t->row->high);
  }
  workspace_free(&t->memory);
  hbm_solver_free(t->hbm);
  timeint_free(t->ti);
  *t = (timed_method){0};
}

/* ---- the rounds ------------------------------------------------------------------------------- */

/* State of the bench at one frequency. */
typedef struct bench_work {
  const compare_setup *setup;
  const bench_options *options;
  const hc_monitor *outer;
  double from, width, done; /* [1] progress: start of this frequency, its fraction of the whole, fraction of it that is
                               done */
  hc_monitor monitor;
  bench_start start;
  timed_method *methods;
  bench *out;
} bench_work;

static bool bench_tick(void *self, double done)
{
  const bench_work *w = self;
  (void)done;
  return hc_monitor_tick(w->outer, w->from + w->width * w->done);
}

static hc_status add_row(bench *b, const bench_row *row)
{
  if (!GROW(b->rows, b->n_rows)) return HC_NO_MEMORY;
  b->rows[b->n_rows++] = *row;
  return HC_OK;
}

static bench_row empty_row(bench_method method, double omega)
{
  bench_row row = {.method = method, .omega = omega};
  row.regularisation = row.tolerance = row.error = row.error_harmonic_1 = row.error_finer = NAN;
  row.seconds = row.low = row.high = row.curve_seconds = NAN;
  return row;
}

static hc_status add_family(bench *b, const family *f, double omega)
{
  hc_status st = HC_OK;
  for (int i = 0; i < f->n_a && st == HC_OK; ++i)
    for (int k = 0; k < f->n_b && st == HC_OK; ++k) {
      bench_row row = empty_row(f->method, omega);
      bool hbm = f->method == BENCH_HBM_EXACT || f->method == BENCH_HBM_SAMPLED;
      if (hbm) row.harmonics = (int)f->a[i], row.samples = (int)f->b[k];
      else row.tolerance = f->b[k];
      if (!hbm && f->a[i] > 0) row.regularisation = f->a[i];
      if (row.samples > 0 && row.samples < 2 * row.harmonics + 2) continue;
      st = add_row(b, &row);
    }
  return st;
}

/* True for a marching row if a row with no finer settings took too long; not for shooting, whose time does not rise
 * with finer settings. */
static bool hopeless(const bench_row *rows, int i)
{
  if (rows[i].method != BENCH_EXACT_MARCHING && rows[i].method != BENCH_REGULARISED_MARCHING) return false;
  for (int k = 0; k < i; ++k) {
    const bench_row *r = &rows[k];
    if (r->method != rows[i].method || r->outcome != BENCH_TOO_LONG) continue;
    if (!(r->regularisation < rows[i].regularisation) && !(r->tolerance < rows[i].tolerance)) return true;
  }
  return false;
}

static bool has_enough(const timed_method *t, const bench_row *row)
{
  if (row->outcome != BENCH_SOLVED || t->runs == t->cap) return true;
  int fewest = row->seconds > timed_method_slow ? 1 : FEWEST;
  return t->runs >= fewest && t->spent > enough; /* spent: the first run included */
}

static hc_status measure_ours(bench_work *w, bench_frequency *p)
{
  hc_status st = HC_OK;
  p->first = w->out->n_rows;
  for (int i = 0; i < N_FAMILIES && st == HC_OK; ++i) st = add_family(w->out, &families[i], p->omega);
  p->n = w->out->n_rows - p->first;
  if (st == HC_OK && !(w->methods = calloc((size_t)p->n, sizeof *w->methods))) st = HC_NO_MEMORY;
  /* All rows once, for errors and outcomes; and the curves. */
  if (st == HC_OK) {
    bench_row *rows = w->out->rows + p->first;
    for (int i = 0; i < p->n && st == HC_OK; ++i) {
      w->done = 0.1 + 0.5 * i / p->n;
      if (hopeless(rows, i)) rows[i].outcome = BENCH_TOO_LONG;
      else if (!hc_monitor_tick(&w->monitor, -1)) st = HC_INTERRUPTED;
      else if ((st = timed_method_start(w->setup, &w->start, &rows[i], w->options->repeats, &w->monitor,
                                        &w->methods[i])) == HC_OK)
        st = timed_method_curve(&w->methods[i], &w->monitor);
    }
  }
  if (st == HC_OK) {
    const int n = w->options->repeats;
    for (int round = 0; round < n && st == HC_OK; ++round)
      for (int i = 0; i < p->n && st == HC_OK; ++i) {
        w->done = 0.6 + 0.3 * (round * p->n + i) / ((double)n * p->n);
        if (!hc_monitor_tick(&w->monitor, -1)) st = HC_INTERRUPTED;
        else if (!has_enough(&w->methods[i], &w->out->rows[p->first + i]))
          st = timed_method_run(&w->methods[i], &w->start, &w->monitor);
      }
  }
  for (int i = 0; w->methods && i < p->n; ++i) timed_method_finish(&w->methods[i]);
  free(w->methods);
  w->methods = NULL;
  return st;
}

/* The runs of scipy, as rows. */
static hc_status measure_scipy(bench_work *w, bench_frequency *p)
{
  scipy_run runs[SCIPY_MOST_RUNS];
  int n = 0;
  w->done = 0.9;
  if (!model_is_oscillator(w->setup->model)) {
    snprintf(p->scipy, sizeof p->scipy, "of one degree of freedom only");
    return HC_OK;
  }
  hc_status st =
      scipy_lsoda(w->setup->model, &w->start, p->multiplier, w->options->repeats, &w->monitor, runs, &n, p->scipy);
  const periodic_motion *ref = w->start.reference;
  for (int i = 0; i < n && (st == HC_OK || st == HC_INTERRUPTED); ++i) {
    bench_row row = empty_row(BENCH_SCIPY_LSODA, p->omega);
    row.tolerance = runs[i].rtol;
    row.outcome = BENCH_SOLVED;
    row.error = discrepancy_relative(runs[i].amplitude - ref->amplitude, ref->amplitude);
    row.error_harmonic_1 = discrepancy_relative(runs[i].harmonic_1 - ref->harmonic_1, ref->amplitude);
    row.repeats = runs[i].n;
    method_quartiles(runs[i].n, runs[i].seconds, &row.low, &row.seconds, &row.high);
    if (!(row.error <= 0.3)) row.outcome = BENCH_OTHER_ORBIT;
    if (add_row(w->out, &row) != HC_OK) st = HC_NO_MEMORY;
    else ++p->n;
  }
  return st;
}

/* ---- the front -------------------------------------------------------------------------------- */

static bool beats(const bench_row *b, const bench_row *a)
{
  bool as_good = b->error_finer <= a->error_finer && b->seconds <= a->seconds;
  return as_good && (b->error_finer < a->error_finer || b->seconds < a->seconds);
}

void bench_judge(int n, bench_row *rows, double floor)
{
  for (int i = 0; i < n; ++i) {
    bench_row *r = &rows[i];
    r->error_finer = NAN;
    if (r->outcome != BENCH_SOLVED) continue;
    r->error_finer = fmax(r->error, floor);
    for (int k = 0; k < n; ++k) /* settings no coarser in any respect; NaN is not a setting */
      if (rows[k].outcome == BENCH_SOLVED &&
          (rows[k].method == r->method && rows[k].harmonics >= r->harmonics && rows[k].samples >= r->samples &&
           !(rows[k].regularisation > r->regularisation) && !(rows[k].tolerance > r->tolerance)))
        r->error_finer = fmax(r->error_finer, rows[k].error);
  }
  for (int i = 0; i < n; ++i) {
    rows[i].front = rows[i].outcome == BENCH_SOLVED && rows[i].repeats > 0;
    for (int k = 0; k < n && rows[i].front; ++k)
      if (rows[k].outcome == BENCH_SOLVED && rows[k].repeats > 0 && beats(&rows[k], &rows[i])) rows[i].front = false;
  }
}

static bool meets(const bench_row *r, double goal)
{
  return r->outcome == BENCH_SOLVED && r->repeats > 0 && r->error_finer <= goal;
}

const bench_row *bench_cheapest(int n, const bench_row *rows, double goal, const bench_row **second)
{
  const bench_row *best = NULL;
  *second = NULL;
  for (int i = 0; i < n; ++i)
    if (meets(&rows[i], goal) && (!best || rows[i].seconds < best->seconds)) best = &rows[i];
  for (int i = 0; i < n && best; ++i)
    if (meets(&rows[i], goal) && rows[i].method != best->method && (!*second || rows[i].seconds < (*second)->seconds))
      *second = &rows[i];
  return best;
}

/* ---- the whole -------------------------------------------------------------------------------- */

static hc_status bench_at(bench_work *w, finder *f, double omega)
{
  bench_frequency *p = &w->out->frequencies[w->out->n_frequencies];
  w->done = 0;
  hc_status st = finder_frequency(f, omega, &w->monitor, p, &w->start);
  if (st != HC_OK) return st;
  ++w->out->n_frequencies;
  snprintf(p->scipy, sizeof p->scipy, "not asked for");
  st = measure_ours(w, p);
  if (st == HC_OK && !w->options->alone) st = measure_scipy(w, p);
  bench_judge(p->n, w->out->rows + p->first, p->floor);
  return st;
}

hc_status bench_run(const compare_setup *setup, const bench_options *options, const hc_monitor *monitor, bench *out,
                    double *failed_at)
{
  finder f;
  number_list at = options->at;
  *out = (bench){0};
  *failed_at = 0;
  if (options->repeats < 1) return HC_BAD_INPUT;
  hc_status st = finder_start(setup, &at, monitor, &f);
  if (st == HC_OK && at.n == 0 && (st = finder_default(&f, &at.v[0])) == HC_OK) at.n = 1;
  for (int i = 0; i < at.n && st == HC_OK; ++i) {
    bench_work w = {.setup = &f.setup,
                    .options = options,
                    .outer = monitor,
                    .from = (double)i / at.n,
                    .width = 1.0 / at.n,
                    .out = out};
    w.monitor = (hc_monitor){bench_tick, &w};
    st = bench_start_new(setup->model, f.response.hbm, &w.start);
    if (st == HC_OK) st = bench_at(&w, &f, at.v[i]);
    bench_start_free(&w.start);
    if (st != HC_OK) *failed_at = at.v[i];
  }
  finder_free(&f);
  return st;
}

void bench_clear(bench *b)
{
  free(b->rows);
  *b = (bench){0};
}
