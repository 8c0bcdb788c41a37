/* bench.c - see bench.h: the settings of each method, the rounds in which they take turns, and the Pareto front of
 * error and time. */
#include "compare/accuracy/bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/growing.h"
#include "compare/accuracy/reference.h"
#include "compare/accuracy/scipy.h"

enum { MOST_SETTINGS = 8, FEWEST = 3 };
static const double enough = 0.25; /* [s] a row measured FEWEST times and for as long is repeated no more */

/* A method's settings: every a with every b. a: harmonics or regularisation, b: samples or tolerance; 0 is none. */
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

/* ---- the rounds ------------------------------------------------------------------------------- */

/* What the functions below have at hand: the settings, one frequency's start and its methods, the result. */
typedef struct workspace {
  const compare_setup *setup;
  const bench_options *options;
  const hc_monitor *outer;
  double from, width,
      done; /* [1] progress: where this frequency begins, its part of the whole, the part of that done */
  hc_monitor monitor;
  bench_start start;
  timed_method *methods;
  bench *out;
} workspace;

static bool bench_tick(void *self, double done)
{
  const workspace *w = self;
  (void)done;
  return hc_monitor_tick(w->outer, w->from + w->width * w->done);
}

static hc_status add_row(bench *b, const bench_row *row)
{
  bench_row *grown = growing(b->rows, b->n_rows, sizeof *grown);
  if (!grown) return HC_NO_MEMORY;
  b->rows = grown;
  b->rows[b->n_rows++] = *row;
  return HC_OK;
}

static bench_row empty_row(bench_method method, double omega)
{
  return (bench_row){.method = method,
                     .omega = omega,
                     .regularisation = NAN,
                     .tolerance = NAN,
                     .error = NAN,
                     .error_harmonic_1 = NAN,
                     .error_finer = NAN,
                     .seconds = NAN,
                     .low = NAN,
                     .high = NAN,
                     .curve_seconds = NAN};
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

/* True if the row marches and one with settings no finer took too long. Not asked of shooting, whose time does not rise
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

/* All rows once: what they find; and the curves. */
static hc_status first_round(workspace *w, bench_frequency *p)
{
  bench_row *rows = w->out->rows + p->first;
  hc_status st = HC_OK;
  for (int i = 0; i < p->n && st == HC_OK; ++i) {
    w->done = 0.1 + 0.5 * i / p->n;
    if (hopeless(rows, i)) rows[i].outcome = BENCH_TOO_LONG;
    else if (!hc_monitor_tick(&w->monitor, -1)) st = HC_INTERRUPTED;
    else if ((st = timed_method_start(w->setup, &w->start, &rows[i], w->options->repeats, &w->monitor,
                                      &w->methods[i])) == HC_OK)
      st = timed_method_curve(&w->methods[i], &w->monitor);
  }
  return st;
}

static bool has_enough(const timed_method *t, const bench_row *row)
{
  if (row->outcome != BENCH_SOLVED || t->runs == t->cap) return true;
  int fewest = row->seconds > timed_method_slow ? 1 : FEWEST;
  return t->runs >= fewest && t->spent > enough; /* spent: the first run included */
}

static hc_status rounds(workspace *w, const bench_frequency *p)
{
  const int n = w->options->repeats;
  hc_status st = HC_OK;
  for (int round = 0; round < n && st == HC_OK; ++round)
    for (int i = 0; i < p->n && st == HC_OK; ++i) {
      w->done = 0.6 + 0.3 * (round * p->n + i) / ((double)n * p->n);
      if (!hc_monitor_tick(&w->monitor, -1)) st = HC_INTERRUPTED;
      else if (!has_enough(&w->methods[i], &w->out->rows[p->first + i]))
        st = timed_method_run(&w->methods[i], &w->start, &w->monitor);
    }
  return st;
}

static hc_status measure_ours(workspace *w, bench_frequency *p)
{
  hc_status st = HC_OK;
  p->first = w->out->n_rows;
  for (int i = 0; i < N_FAMILIES && st == HC_OK; ++i) st = add_family(w->out, &families[i], p->omega);
  p->n = w->out->n_rows - p->first;
  if (st == HC_OK && !(w->methods = calloc((size_t)p->n, sizeof *w->methods))) st = HC_NO_MEMORY;
  if (st == HC_OK) st = first_round(w, p);
  if (st == HC_OK) st = rounds(w, p);
  for (int i = 0; w->methods && i < p->n; ++i) timed_method_finish(&w->methods[i]);
  free(w->methods);
  w->methods = NULL;
  return st;
}

/* The runs of scipy, as rows. */
static hc_status measure_scipy(workspace *w, bench_frequency *p)
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

/* At settings no coarser than a's in any respect? NaN is no setting. */
static bool no_coarser(const bench_row *b, const bench_row *a)
{
  return b->method == a->method && b->harmonics >= a->harmonics && b->samples >= a->samples &&
         !(b->regularisation > a->regularisation) && !(b->tolerance > a->tolerance);
}

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
    for (int k = 0; k < n; ++k)
      if (rows[k].outcome == BENCH_SOLVED && no_coarser(&rows[k], r))
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

static hc_status bench_at(workspace *w, finder *f, double omega)
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
    workspace w = {.setup = &f.setup,
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
