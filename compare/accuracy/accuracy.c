/* accuracy.c - see accuracy.h: the table over truncation orders and sampling rates, and its orders of convergence.
 *
 *     the curve with exact forces and most harmonics -> the exact law's orbits to compare with, the response's peak
 *     each H: the curve with exact forces -> a solution next to each orbit
 *     each H and N: the same solutions, from there; and the curve. Independent of each other, so by threads */
#include <stdlib.h>
#include <string.h>

#include "compare/accuracy/accuracy.h"
#include "compare/accuracy/method.h"
#include "model/modes.h"
#include "numerics/base/growing.h"
#include "numerics/base/thread_clock.h"
#include "numerics/base/workspace.h"
#include "numerics/roots.h"
#include "numerics/workers.h"

/* ---- the reference: the exact law's orbits next to the solutions at the compared frequencies, and the peak of the
 * response. The peak is that of the orbits, by shooting: three frequencies that enclose it, from the peak of the curve
 * by harmonic balance, then the peak of a cubic or, if that is not accurate enough, a minimum search. By harmonic
 * balance alone 1e-8 would take 160 harmonics. ---- */

typedef struct target {
  double omega;
  periodic_motion orbit;
} target;

typedef struct reference {
  int n;
  target *targets; /* [n] ascending in omega */
  int harmonics;   /* of the curve from which they were found */
  bool peak_by_orbit;
  double peak_amplitude, peak_omega;
} reference;

enum { PEAK_LEVELS = 6 };

static const double reusable = 0.01; /* [amplitude] largest waveform distance at which an orbit counts as the one next
                                        to a solution of the fine curve */

static bool is_known(const reference *r, double omega, const periodic_motion *orbit)
{
  for (int i = 0; i < r->n; ++i)
    if (r->targets[i].omega == omega && motion_between(&r->targets[i].orbit, orbit).waveform <= 1e-6 * orbit->amplitude)
      return true;
  return false;
}

/* The orbit next to a solution: from the comparison's rows, else by shooting. False: none. */
static bool orbit_next_to(const comparison *c, timeint *ti, double *state, hbm_solver *hbm, const double *X,
                          double omega, const hc_monitor *monitor, periodic_motion *out)
{
  periodic_motion here;
  if (motion_of_response(hbm, omega, X, 0, NULL, &here) != HC_OK) return false;
  for (int i = 0; i < c->n_rows; ++i) {
    if (c->rows[i].response != 0 || c->rows[i].omega != omega || c->rows[i].orbit_status != HC_OK) continue;
    *out = motion_of_transient(&c->rows[i].orbit);
    if (motion_between(&here, out).waveform <= reusable * out->amplitude) return true;
  }
  timeint_result r;
  if (comparison_orbit_start(hbm, X, omega, state) != HC_OK || timeint_orbit(ti, omega, 1, state, monitor, &r) != HC_OK)
    return false;
  *out = motion_of_transient(&r);
  return true;
}

static hc_status targets_at(const comparison *c, timeint *ti, double *state, hbm_solver *hbm, const hbm_curve *curve,
                            double omega, const hc_monitor *monitor, reference *r)
{
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(hbm, curve, omega, &at) == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
  for (int k = 0; k < at.n && st == HC_OK; ++k) {
    const double *X = at.X + (size_t)k * at.n_coef;
    periodic_motion orbit;
    if (!orbit_next_to(c, ti, state, hbm, X, omega, monitor, &orbit) || is_known(r, omega, &orbit)) continue;
    if (GROW(r->targets, r->n)) r->targets[r->n++] = (target){omega, orbit};
    else st = HC_NO_MEMORY;
  }
  hbm_curve_free(&at);
  return st;
}

enum { CLIMB_ORBITS = 4 };
static const double same_omega = 1e-9; /* [omega] distance within which an orbit counts as found already */

typedef struct climber {
  timeint *ti;
  hbm_solver *hbm;            /* solver of the curve, for a large structure; else NULL */
  const hbm_curve *curve;     /* response curve, which predicts amplitudes for a large structure */
  int n_found;                /* number of orbits found, of which the last CLIMB_ORBITS are stored */
  double omega[CLIMB_ORBITS]; /* their frequencies */
  double *state;              /* [CLIMB_ORBITS][n_states] states on them; before the first, a start */
  double *here;               /* [n_states] start of the next search */
} climber;

/* c->here = the state of the last orbit or, for a large structure, extrapolated by the polynomial in omega through the
 * stored ones. */
static void start_at(const climber *c, double omega)
{
  const int kept = c->n_found < CLIMB_ORBITS ? c->n_found : CLIMB_ORBITS;
  const size_t n = (size_t)timeint_n_states(c->ti), last = kept ? (size_t)(c->n_found - 1) % CLIMB_ORBITS : 0;
  memcpy(c->here, c->state + last * n, n * sizeof *c->here);
  if (!c->hbm || kept < 2) return;
  memset(c->here, 0, n * sizeof *c->here);
  for (int k = 0; k < kept; ++k) {
    double weight = 1;
    for (int i = 0; i < kept; ++i)
      if (i != k) weight *= (omega - c->omega[i]) / (c->omega[k] - c->omega[i]);
    for (size_t i = 0; i < n; ++i) c->here[i] += weight * c->state[(size_t)k * n + i];
  }
}

/* *value = -amplitude of the orbit at omega next to start_at(); NaN: none. */
static hc_status minus_amplitude(void *self, double omega, double *value)
{
  climber *c = self;
  timeint_result r;
  const size_t n = (size_t)timeint_n_states(c->ti);
  bool known = false;
  start_at(c, omega);
  const hc_status st = timeint_orbit(c->ti, omega, 1, c->here, NULL, &r);
  for (int k = 0; k < c->n_found && k < CLIMB_ORBITS; ++k) known |= fabs(c->omega[k] / omega - 1) <= same_omega;
  if (st == HC_OK && !(known && c->hbm)) {
    c->omega[c->n_found % CLIMB_ORBITS] = omega;
    memcpy(c->state + (size_t)(c->n_found++ % CLIMB_ORBITS) * n, c->here, n * sizeof *c->here);
  }
  *value = st == HC_OK ? -r.amplitude : NAN;
  return st;
}

/* Encloses a peak by three frequencies d apart, the middle one no lower than the others: moves *omega uphill, and
 * reduces d where an orbit is missing or the curvature has the wrong sign. False: not within PEAK_LEVELS, or beyond the
 * sweep. *omega and f[1] are then the last middle, f[1] NaN if it has no orbit. f: minus the amplitudes. */
static bool enclose_peak(climber *c, double low, double high, double *omega, double *d, double f[3])
{
  for (int level = 0; level < PEAK_LEVELS; ++level) {
    if (*omega - *d < low || *omega + *d > high) return false;
    bool both = minus_amplitude(c, *omega - *d, &f[0]) == HC_OK && minus_amplitude(c, *omega + *d, &f[2]) == HC_OK;
    if (both && f[1] <= f[0] && f[1] <= f[2]) return true;
    double bend = both ? f[0] - 2 * f[1] + f[2] : NAN;
    if (!(bend > 0)) {
      *d /= 4;
      continue;
    }
    *omega += fmax(fmin(0.5 * *d * (f[0] - f[2]) / bend, 2 * *d), -2 * *d);
    if (minus_amplitude(c, *omega, &f[1]) != HC_OK) return false;
  }
  return false;
}

static const double top_fall = 1e-9; /* [amplitude] corresponds to 4.5e-5 of the width, less than the error of the
                                        search below */

/* *top = the minimum of the cubic through f, at three frequencies d apart, and an orbit at the minimum of their
 * parabola. False: it is lower than that orbit by more than top_fall, or there is none. */
static bool top_of_cubic(climber *c, double omega, double d, const double f[3], root_point *top)
{
  const double bend = f[0] - 2 * f[1] + f[2], t = 0.5 * (f[0] - f[2]) / bend;
  double low;
  if (!(bend > 0) || minus_amplitude(c, omega + t * d, &low) != HC_OK) return false;
  const double cubic = (low - (f[1] - 0.5 * bend * t * t)) / (t * (t * t - 1));
  const double slope = cubic * (3 * t * t - 1), cubic_bend = bend + 6 * cubic * t;
  const double fall = 0.5 * slope * slope / cubic_bend;
  *top = (root_point){.x = omega + (t - slope / cubic_bend) * d, .f = low - fall};
  return cubic_bend > 0 && fall <= top_fall * fabs(low);
}

/* Amplitude of the curve at omega, of several solutions the one nearest to `near`; NaN: none. */
static double amplitude_of_curve(const climber *c, double omega, double near)
{
  hbm_curve at = {0};
  hbm_measures m;
  double nearest = NAN;
  hbm_curve_at(c->hbm, c->curve, omega, &at); /* solutions found before an error are used */
  for (int k = 0; k < at.n; ++k)
    if (hbm_measure(c->hbm, at.X + (size_t)k * (size_t)at.n_coef, &m) == HC_OK &&
        !(fabs(m.amplitude - near) >= fabs(nearest - near)))
      nearest = m.amplitude;
  hbm_curve_free(&at);
  return nearest;
}

/* top_of_cubic with f[0] estimated instead of computed, f[1] being the orbit at the curve's own peak, of amplitude
 * `high`: assumes that the error of the curve's amplitude is linear in omega. */
static bool top_by_curve(climber *c, double omega, double d, double high, double f[3], root_point *top)
{
  if (!c->hbm || minus_amplitude(c, omega + d, &f[2]) != HC_OK) return false;
  f[0] = 2 * f[1] - f[2] + 2 * high - amplitude_of_curve(c, omega - d, high) - amplitude_of_curve(c, omega + d, high);
  return f[1] <= f[0] && f[1] <= f[2] && top_of_cubic(c, omega, d, f, top);
}

/* Finds the peak from omega, the peak of the curve with amplitude of_curve, c->state being next to an orbit there.
 * False: *out is unchanged. */
static bool climb(const compare_setup *setup, climber *c, double omega, double of_curve, reference *out)
{
  const double low = fmin(setup->omega_from, setup->omega_to), high = fmax(setup->omega_from, setup->omega_to);
  model_scales scales;
  const bool damped = model_find_scales(setup->model, &scales) == HC_OK && scales.half_width > 0;
  const double width = fmin(damped ? scales.half_width : omega, 0.1 * omega);
  double d = 0.02 * width, f[3] = {NAN, NAN, NAN};
  if (minus_amplitude(c, omega, &f[1]) != HC_OK) return false;
  root_point peak;
  const bool known = top_by_curve(c, omega, d, of_curve, f, &peak);
  if (!known && !enclose_peak(c, low, high, &omega, &d, f)) peak = (root_point){.x = omega, .f = f[1]};
  else if (!known && !top_of_cubic(c, omega, d, f, &peak)) /* flat: 1e-4 of the width are 5e-9 of the amplitude */
    root_minimum(minus_amplitude, c, omega - d, f[0], omega, f[1], omega + d, f[2], 1e-4 * width, &peak);
  if (isnan(peak.f)) return false;
  out->peak_amplitude = -peak.f; /* the highest found, also if an orbit in between is missing */
  out->peak_omega = peak.x;
  return out->peak_by_orbit = true;
}

static void find_peak(const compare_setup *setup, timeint *ti, double *states, hbm_solver *hbm, const hbm_curve *curve,
                      reference *out)
{
  hbm_curve peak = {0};
  hbm_measures m;
  out->peak_amplitude = out->peak_omega = NAN;
  if (curve->n > 0 && hbm_curve_peak(hbm, curve, &peak) == HC_OK && peak.n > 0 &&
      hbm_measure(hbm, peak.X, &m) == HC_OK) {
    double omega = peak.points[0].omega;
    const bool large = setup->model->n > COMPARE_LARGE;
    climber c = {.ti = ti,
                 .hbm = large ? hbm : NULL,
                 .curve = curve,
                 .state = states,
                 .here = states + (size_t)CLIMB_ORBITS * (size_t)timeint_n_states(ti)};
    if (comparison_orbit_start(hbm, peak.X, omega, states) != HC_OK || !climb(setup, &c, omega, m.amplitude, out))
      out->peak_amplitude = m.amplitude, out->peak_omega = omega;
  }
  hbm_curve_free(&peak);
}

/* Makes the reference from the curve of `hbm`, with exact forces. The caller frees out->targets in any case. */
static hc_status reference_make(const compare_setup *setup, const comparison *c, hbm_solver *hbm,
                                const hbm_curve *curve, const hc_monitor *monitor, reference *out)
{
  timeint *ti = NULL;
  double *states = NULL; /* [CLIMB_ORBITS + 1][n_states] */
  *out = (reference){.harmonics = hbm_n_harmonics(hbm)};
  hc_status st = comparison_referee(setup, NULL, &ti);
  if (st == HC_OK) timeint_leave_multipliers(ti);
  if (st == HC_OK && !(states = calloc((CLIMB_ORBITS + 1) * (size_t)timeint_n_states(ti), sizeof *states)))
    st = HC_NO_MEMORY;
  for (int i = 0; i < c->n_rows && st == HC_OK; ++i) {
    if (i > 0 && c->rows[i].omega == c->rows[i - 1].omega) continue;
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
    else st = targets_at(c, ti, states, hbm, curve, c->rows[i].omega, monitor, out);
  }
  if (st == HC_OK) find_peak(setup, ti, states, hbm, curve, out);
  free(states);
  timeint_free(ti);
  return st;
}

/* ---- the table ---- */

enum { EXACT = 0 };

static const double floor_of_orbits = 1e-8; /* [1] least error for a fit: ten times the error of the referee's orbits */

/* The solution next to each target, for one H and N. */
typedef struct solutions {
  int n, n_coef;
  workspace memory;        /* of the arrays below */
  bool *there;             /* [n] */
  double *X;               /* [n][n_coef] */
  periodic_motion *motion; /* [n] */
  long iterations;
} solutions;

/* The solutions with exact forces for one H, from which its sampled rows start. */
typedef struct plain_solutions {
  int n_harm, turning_points; /* H; of its curve with exact forces */
  solutions s;
} plain_solutions;

typedef struct table_work {
  const compare_setup *setup;
  const comparison *c;
  const hc_monitor *monitor;                   /* of the calling thread */
  int n_harm, n_samples, *harmonics, *samples; /* ascending, each once */
  reference ref;
  plain_solutions plain[NUMBER_LIST_MAX]; /* [n_harm] */
  bool *there;                            /* [n_harm (n_samples + 1)] true for rows that are complete */
  accuracy_row *rows;                     /* [n_harm (n_samples + 1)] for each H exact forces, then the samples */
  order_row regularisation;
} table_work;

/* ---- curves and solutions -------------------------------------------------------------------- */

static hc_status trace(const table_work *w, int n_harm, int samples, const hc_monitor *monitor, response_curve *t)
{
  const compare_setup setup =
      method_setup(w->setup, samples == EXACT ? BENCH_HBM_EXACT : BENCH_HBM_SAMPLED, n_harm, samples, NAN, NAN);
  return response_trace(&setup, &setup.compare.omega, monitor, t);
}

static hc_status solutions_new(int n, int n_coef, solutions *s)
{
  *s = (solutions){.n = n, .n_coef = n_coef};
  s->there = workspace_array(&s->memory, (size_t)n, sizeof *s->there);
  s->X = workspace_doubles(&s->memory, (size_t)n * (size_t)n_coef);
  s->motion = workspace_array(&s->memory, (size_t)n, sizeof *s->motion);
  return s->memory.failed ? HC_NO_MEMORY : HC_OK;
}

static bool keep_solution(solutions *s, int i, hbm_solver *hbm, double omega, const double *X)
{
  if (motion_of_response(hbm, omega, X, 0, NULL, &s->motion[i]) != HC_OK) return false;
  memcpy(s->X + (size_t)i * s->n_coef, X, (size_t)s->n_coef * sizeof *X);
  return s->there[i] = true;
}

/* The nearest pair of a target without solution and an unused solution of *at; false: none left. */
static bool nearest_pair(const table_work *w, const solutions *s, int first, int last, const hbm_curve *at,
                         const periodic_motion *found, const bool *taken, int *i, int *k)
{
  double least = INFINITY;
  for (int a = first; a < last; ++a)
    for (int b = 0; b < at->n; ++b) {
      if (s->there[a] || taken[b]) continue;
      double d = motion_between(&found[b], &w->ref.targets[a].orbit).waveform;
      if (d < least) {
        least = d;
        *i = a;
        *k = b;
      }
    }
  return least < INFINITY;
}

/* Targets first..last-1, of one frequency, get at most one solution of the curve each, the nearest pairs first. */
static hc_status assign(const table_work *w, response_curve *t, int first, int last, solutions *s)
{
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(t->hbm, &t->curve, w->ref.targets[first].omega, &at);
  periodic_motion *found = calloc((size_t)at.n + 1, sizeof *found);
  bool *taken = calloc((size_t)at.n + 1, sizeof *taken);
  int i = 0, k = 0;
  st = st == HC_NO_MEMORY || !found || !taken ? HC_NO_MEMORY : HC_OK;
  for (int b = 0; b < at.n && st == HC_OK; ++b) {
    const double *X = at.X + (size_t)b * at.n_coef;
    s->iterations += at.points[b].iterations;
    taken[b] = motion_of_response(t->hbm, at.points[b].omega, X, 0, NULL, &found[b]) != HC_OK; /* unusable */
  }
  while (st == HC_OK && nearest_pair(w, s, first, last, &at, found, taken, &i, &k)) {
    taken[k] = true;
    keep_solution(s, i, t->hbm, at.points[k].omega, at.X + (size_t)k * at.n_coef);
  }
  free(found);
  free(taken);
  hbm_curve_free(&at);
  return st;
}

static hc_status solve_exact(const table_work *w, response_curve *t, solutions *s)
{
  hc_status st = solutions_new(w->ref.n, hbm_n_coefficients(t->hbm), s);
  for (int first = 0, last; first < w->ref.n && st == HC_OK; first = last) {
    for (last = first; last < w->ref.n && w->ref.targets[last].omega == w->ref.targets[first].omega;) ++last;
    st = assign(w, t, first, last, s);
  }
  return st;
}

/* If two starts converged to the same solution, the one with the more distant start is dropped. */
static void drop_doubles(const table_work *w, const solutions *from, solutions *s)
{
  for (int a = 0; a < s->n; ++a)
    for (int b = 0; b < s->n; ++b) {
      if (a == b || !s->there[a] || !s->there[b] || w->ref.targets[a].omega != w->ref.targets[b].omega) continue;
      if (!(motion_between(&s->motion[a], &s->motion[b]).waveform <= 1e-6 * s->motion[b].amplitude)) continue;
      double da = motion_between(&s->motion[a], &from->motion[a]).waveform,
             db = motion_between(&s->motion[b], &from->motion[b]).waveform;
      if (da > db || (da == db && a > b)) s->there[a] = false;
    }
}

/* The sampled solutions, each from the one with exact forces. */
static hc_status solve_sampled(const table_work *w, response_curve *t, const solutions *from, solutions *s)
{
  hc_status st = solutions_new(from->n, from->n_coef, s);
  double *X = malloc(((size_t)from->n_coef + 1) * sizeof *X);
  if (!X) st = HC_NO_MEMORY;
  for (int i = 0; i < from->n && st == HC_OK && t->hbm; ++i) {
    hbm_point point = {0};
    if (!from->there[i]) continue;
    memcpy(X, from->X + (size_t)i * from->n_coef, (size_t)from->n_coef * sizeof *X);
    const double omega = w->ref.targets[i].omega;
    if (hbm_solve(t->hbm, omega, X, &point) == HC_OK) keep_solution(s, i, t->hbm, omega, X);
    s->iterations += point.iterations;
  }
  free(X);
  if (st == HC_OK) drop_doubles(w, from, s);
  return st;
}

/* ---- a row ----------------------------------------------------------------------------------- */

static hc_status put_errors(const table_work *w, const solutions *s, const solutions *plain, accuracy_row *row)
{
  double *e = calloc((size_t)s->n + 1, sizeof *e), low, high;
  if (!e) return HC_NO_MEMORY;
  row->worst = row->aliasing = s->n ? 0 : NAN;
  for (int i = 0; i < s->n; ++i) {
    const periodic_motion *orbit = &w->ref.targets[i].orbit;
    if (!s->there[i]) continue;
    const double amplitude = s->motion[i].amplitude;
    e[row->solutions++] = discrepancy_relative(amplitude - orbit->amplitude, orbit->amplitude);
    row->worst = fmax(row->worst, e[row->solutions - 1]);
    row->aliasing = fmax(row->aliasing, discrepancy_relative(amplitude - plain->motion[i].amplitude, orbit->amplitude));
  }
  if (row->solutions == 0) row->worst = row->aliasing = NAN;
  row->missing = s->n - row->solutions;
  method_quartiles(row->solutions, e, &low, &row->median, &high);
  free(e);
  return HC_OK;
}

static hc_status put_curve(const table_work *w, response_curve *t, accuracy_row *row)
{
  response_summary curve = {.peak_amplitude = NAN, .peak_omega = NAN};
  hc_status st = t->hbm ? response_summarise(t->hbm, &t->curve, &curve) : HC_OK;
  row->status = t->status;
  row->peak_amplitude = curve.peak_amplitude, row->peak_omega = curve.peak_omega;
  row->peak_error = discrepancy_relative(curve.peak_amplitude - w->ref.peak_amplitude, w->ref.peak_amplitude);
  row->peak_omega_error = fabs(curve.peak_omega - w->ref.peak_omega) / w->ref.peak_omega;
  row->turning_points = t->curve.turning_points, row->rejected = t->curve.rejected;
  row->iterations = t->curve.iterations, row->evaluations = t->curve.evaluations;
  return st;
}

static hc_status make_row(const table_work *w, response_curve *t, int samples, const solutions *s,
                          const plain_solutions *plain, double began, accuracy_row *row)
{
  *row = (accuracy_row){.harmonics = plain->n_harm, .samples = samples, .possible = true};
  hc_status st = put_curve(w, t, row);
  if (st != HC_OK) return st;
  row->iterations += s->iterations;
  row->false_turning_points =
      row->turning_points > plain->turning_points ? row->turning_points - plain->turning_points : 0;
  st = put_errors(w, s, &plain->s, row);
  row->seconds = t->seconds + thread_seconds() - began;
  return st;
}

static accuracy_row impossible_row(int n_harm, int samples)
{
  accuracy_row row = {.harmonics = n_harm, .samples = samples, .status = HC_BAD_INPUT};
  row.worst = row.median = row.aliasing = row.seconds = NAN;
  row.peak_amplitude = row.peak_omega = row.peak_error = row.peak_omega_error = NAN;
  return row;
}

/* The row of the i-th H with exact forces, and the solutions that the sampled ones start from. */
static hc_status exact_row(table_work *w, int i, response_curve *t)
{
  const int at = i * (w->n_samples + 1);
  plain_solutions *plain = &w->plain[i];
  double began = thread_seconds();
  plain->n_harm = w->harmonics[i], plain->turning_points = t->curve.turning_points;
  hc_status st = solve_exact(w, t, &plain->s);
  if (st == HC_OK) st = make_row(w, t, EXACT, &plain->s, plain, began, &w->rows[at]);
  w->there[at] = st == HC_OK;
  return st;
}

static hc_status sampled_row(const table_work *w, int samples, const plain_solutions *plain, const hc_monitor *monitor,
                             accuracy_row *row)
{
  response_curve t;
  solutions s = {0};
  if (samples < 2 * plain->n_harm + 2) {
    *row = impossible_row(plain->n_harm, samples);
    return HC_OK;
  }
  hc_status st = trace(w, plain->n_harm, samples, monitor, &t);
  double began = thread_seconds();
  if (st == HC_OK) st = solve_sampled(w, &t, &plain->s, &s);
  if (st == HC_OK) st = make_row(w, &t, samples, &s, plain, began, row);
  workspace_free(&s.memory);
  response_curve_free(&t);
  return st;
}

/* ---- the whole ------------------------------------------------------------------------------- */

/* The whole numbers of a list, ascending and without duplicates, into out[]; returns their number. */
static int whole_numbers(const number_list *list, int *out)
{
  number_list sorted = *list;
  int n = 0;
  qsort(sorted.v, (size_t)sorted.n, sizeof *sorted.v, ascending);
  for (int i = 0; i < sorted.n; ++i)
    if (n == 0 || (int)sorted.v[i] != out[n - 1]) out[n++] = (int)sorted.v[i];
  return n;
}

static void put_order(accuracy *out, const char *quantity, int n_harm, int n, const double *x, const double *e,
                      double floor)
{
  order_fit fit = order_fit_to(n, x, e, floor);
  if (fit.points > 1)
    out->orders[out->n_orders++] = (order_row){.quantity = quantity, .harmonics = n_harm, .omega = NAN, .fit = fit};
}

/* The orders of the aliasing error in N for each H, and of the truncation error in H with exact forces. */
static void put_orders(const table_work *w, accuracy *out)
{
  double x[NUMBER_LIST_MAX], e[NUMBER_LIST_MAX], h[NUMBER_LIST_MAX], truncation[NUMBER_LIST_MAX];
  int n = 0, n_h = 0;
  for (int i = 0; i < out->n_rows; ++i) {
    const accuracy_row *row = &out->rows[i];
    if (row->samples == EXACT) h[n_h] = row->harmonics, truncation[n_h++] = row->worst;
    else x[n] = row->samples, e[n++] = row->aliasing;
    bool last = i + 1 == out->n_rows || out->rows[i + 1].harmonics != row->harmonics;
    if (last) put_order(out, "samples", row->harmonics, n, x, e, 1e2 * w->setup->hbm.tolerance), n = 0;
  }
  put_order(out, "harmonics", 0, n_h, h, truncation, floor_of_orbits);
  if (w->regularisation.fit.points > 1) out->orders[out->n_orders++] = w->regularisation;
}

/* The reference orbits, and the rows with exact forces. */
static hc_status exact_rows(table_work *w)
{
  const int least = compare_reference_harmonics(w->setup->model);
  const int most = w->harmonics[w->n_harm - 1] > least ? w->harmonics[w->n_harm - 1] : least;
  response_curve finest, t = {.hbm = NULL};
  hc_status st = trace(w, most, EXACT, w->monitor, &finest);
  if (st == HC_OK && !finest.hbm) st = finest.status;
  if (st == HC_OK) st = reference_make(w->setup, w->c, finest.hbm, &finest.curve, w->monitor, &w->ref);
  for (int i = 0; i < w->n_harm && st == HC_OK; ++i) {
    bool again = w->harmonics[i] == most; /* solved already */
    if (!hc_monitor_tick(w->monitor, -1)) st = HC_INTERRUPTED;
    if (st == HC_OK && !again) st = trace(w, w->harmonics[i], EXACT, w->monitor, &t);
    if (st == HC_OK) st = exact_row(w, i, again ? &finest : &t);
    if (!again) response_curve_free(&t);
  }
  response_curve_free(&finest);
  return st;
}

/* The tasks: the sampled rows, those with most harmonics first, since they take longest; then the regularisation. */
static hc_status do_task(void *self, int task, const hc_monitor *monitor)
{
  table_work *w = self;
  if (task == w->n_harm * w->n_samples) return order_of_regularisation(w->setup, w->c, monitor, &w->regularisation);
  const int i = w->n_harm - 1 - task / w->n_samples, k = task % w->n_samples;
  const int at = i * (w->n_samples + 1) + 1 + k;
  hc_status st = sampled_row(w, w->samples[k], &w->plain[i], monitor, &w->rows[at]);
  w->there[at] = st == HC_OK;
  return st;
}

static void put_reference(const table_work *w, accuracy *out)
{
  out->orbits = w->ref.n;
  for (int i = 0; i < w->ref.n; ++i)
    out->frequencies += i == 0 || w->ref.targets[i].omega != w->ref.targets[i - 1].omega;
  out->peak_harmonics = w->ref.harmonics, out->peak_by_orbit = w->ref.peak_by_orbit;
  out->peak_amplitude = w->ref.peak_amplitude, out->peak_omega = w->ref.peak_omega;
}

hc_status accuracy_run(const compare_setup *setup, const comparison *c, const hc_monitor *monitor, accuracy *out)
{
  int harmonics[NUMBER_LIST_MAX], samples[NUMBER_LIST_MAX];
  *out = (accuracy){0};
  const hc_monitor aside = {hc_monitor_tick_aside, (void *)monitor}; /* progress is reported by the tasks */
  table_work w = {.setup = setup, .c = c, .monitor = &aside, .harmonics = harmonics, .samples = samples};
  w.n_harm = whole_numbers(&setup->compare.harmonics, harmonics);
  w.n_samples = whole_numbers(&setup->compare.samples, samples);
  if (w.n_harm == 0) return HC_OK;
  if (harmonics[0] < 1 || harmonics[w.n_harm - 1] > HBM_MAX_HARMONICS) return HC_BAD_INPUT;
  int few = 0; /* number of H below the highest harmonic of the loads */
  while (few < w.n_harm && harmonics[few] < model_highest_load(setup->model)) ++few;
  w.harmonics += few, w.n_harm -= few;
  if (w.n_harm == 0) return HC_OK;
  const size_t most_rows = (size_t)w.n_harm * (size_t)(w.n_samples + 1);
  out->rows = w.rows = calloc(most_rows, sizeof *out->rows);
  out->orders = calloc((size_t)w.n_harm + 2, sizeof *out->orders);
  w.there = calloc(most_rows, sizeof *w.there);
  hc_status st = out->rows && out->orders && w.there ? exact_rows(&w) : HC_NO_MEMORY;
  if (st == HC_OK) st = workers_run(setup->jobs, w.n_harm * w.n_samples + 1, do_task, &w, monitor);
  if (out->rows && out->orders && w.there) {
    for (size_t i = 0; i < most_rows; ++i) /* complete rows move to the front, in their order */
      if (w.there[i]) out->rows[out->n_rows++] = out->rows[i];
    put_orders(&w, out);
    put_reference(&w, out);
  }
  for (int i = 0; i < w.n_harm; ++i) workspace_free(&w.plain[i].s.memory);
  free(w.ref.targets);
  free(w.there);
  return st;
}

void accuracy_clear(accuracy *a)
{
  free(a->rows);
  free(a->orders);
  *a = (accuracy){0};
}
