/* sufficient.c - see sufficient.h. */
#include "compare/accuracy/sufficient.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/motion.h"
#include "model/modes.h"
#include "numerics/base/growing.h"
#include "numerics/base/workspace.h"

enum {
  TRACED = 20,
  POINTS = 64,
  OF_CURVE = 48,
  FIRST_TRUTH = 40,
  MOST_SAMPLES = 65536,
  MANY_SAMPLES = 1024,
  ROUNDS = 5,
  REFINED = 4
};
static const double least_strip = 1e-3, widths = 50;     /* [omega] least distance from a turning point; [half widths of
                                                            resonances] upper limit of that */
static const double proven = 0.05;                       /* [allowed error] largest error estimate of the truth */
static const double most_work = 5e10, little_work = 2e9; /* [unknowns^3] most work of a search; of additional
                                                            frequencies */
static const double seen = 0.9;   /* assumed ratio of the largest error at the frequencies examined to the largest on
                                     the curve */
static const double still = 1e-9; /* [largest amplitude] responses with a smaller amplitude are not examined */

/* One solution of the truth, with which settings are compared. */
typedef struct target {
  double omega, error; /* error: that of the last setting tried */
  const char *quantity;
  double *X;               /* [n_coef of the truth] */
  periodic_motion *motion; /* [responses] */
} target;

typedef struct search {
  const compare_setup *setup;
  const hc_monitor *monitor;
  double allowed, work;
  hbm_solver *truth;
  response_curve curve; /* response curve from which solutions are taken */
  int n;
  target *targets;
  workspace memory; /* of the targets and X */
  double *X;        /* [n_coef of most harmonics] */
  sufficient *out;
} search;

static hbm_settings exact_settings(const search *s, int harmonics)
{
  hbm_settings how = s->setup->hbm;
  how.force = HBM_FORCE_EXACT;
  how.harmonics = harmonics;
  how.keep_mean = true;
  return how;
}

/* ---- the truth ---- */

/* The turning points of the curve, by its interpolant; X[n_coef]: work. */
static void find_folds(const hbm_curve *c, double *X, sufficient *out)
{
  enum { STEPS = 64 };
  for (int k = 0; k + 1 < c->n && out->n_folds < SUFFICIENT_FOLDS; ++k) {
    if (c->points[k].branch == c->points[k + 1].branch || !hbm_curve_has_segment(c, k)) continue;
    const hbm_segment seg = hbm_segment_between(c, k);
    const double sign = c->points[k].d_omega < 0 ? -1 : 1;
    double most = -INFINITY, omega;
    for (int i = 0; i <= STEPS; ++i) {
      hbm_segment_at(&seg, (double)i / STEPS, X, &omega, NULL, NULL);
      most = fmax(most, sign * omega);
    }
    out->folds[out->n_folds++] = sign * most;
  }
}

static bool near_fold(const sufficient *out, double omega)
{
  for (int i = 0; i < out->n_folds; ++i)
    if (fabs(omega / out->folds[i] - 1) < 0.999 * out->strip) return true;
  return false;
}

/* Adds the truth's solution next to X to the targets, unless it is linear or lost. *predicted: raised to its error
 * estimate. */
static hc_status add_target(search *s, double omega, const double *X, int n_coef, double *predicted)
{
  const int length = hbm_n_coefficients(s->truth), n = s->setup->model->n_responses;
  hbm_point point;
  hbm_measures m;
  motion_error e;
  target t = {.omega = omega};
  t.X = workspace_doubles(&s->memory, (size_t)length);
  t.motion = workspace_array(&s->memory, (size_t)n, sizeof *t.motion);
  if (s->memory.failed) return HC_NO_MEMORY;
  memcpy(t.X, X, (size_t)(n_coef < length ? n_coef : length) * sizeof *X);
  ++s->out->solutions;
  hc_status st = hbm_solve(s->truth, omega, t.X, &point);
  double largest = 0, off = 0;
  for (int r = 0; r < n && st == HC_OK; ++r) {
    st = motion_of_response(s->truth, omega, t.X, r, &m, &t.motion[r]);
    largest = fmax(largest, t.motion[r].amplitude);
    if (r == 0 && st == HC_OK && m.contact.regime <= CONTACT_STUCK) return ++s->out->linear, HC_OK;
  }
  for (int r = 0; r < n && st == HC_OK; ++r) {
    st = r == 0 ? hbm_predict(s->truth, omega, t.X, &e) : hbm_predict_response(s->truth, omega, t.X, r, &e);
    if (st == HC_OK && t.motion[r].amplitude > still * largest)
      off = fmax(off, fmax(fmax(e.amplitude, e.harmonic_1), e.waveform) / t.motion[r].amplitude);
  }
  if (st == HC_NO_MEMORY) return st;
  if (st != HC_OK || !(off <= s->allowed)) return ++s->out->lost, HC_OK;
  if (!GROW(s->targets, s->n)) return HC_NO_MEMORY;
  s->targets[s->n++] = t;
  *predicted = fmax(*predicted, off);
  return hc_monitor_tick(s->monitor, -1) ? HC_OK : HC_INTERRUPTED;
}

static hc_status add_frequency(search *s, double omega, double *predicted)
{
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(s->curve.hbm, &s->curve.curve, omega, &at) == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
  ++s->out->frequencies;
  if (at.n == 0) ++s->out->lost;
  for (int k = 0; k < at.n && st == HC_OK; ++k)
    st = add_target(s, omega, at.X + (size_t)k * (size_t)at.n_coef, at.n_coef, predicted);
  hbm_curve_free(&at);
  return st;
}

/* At most OF_CURVE of the curve's points at which a contact changes its state. */
static void add_nonlinear_points(search *s, number_list *out)
{
  const hbm_curve *c = &s->curve.curve;
  hbm_measures m;
  int n = 0, kept = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (int k = 0, i = 0; k < c->n; ++k) {
      if (hbm_measure(s->curve.hbm, hbm_curve_X(c, k), &m) != HC_OK || m.contact.regime <= CONTACT_STUCK) continue;
      if (pass == 0) ++n;
      else if (i++ * OF_CURVE >= kept * n && out->n < NUMBER_LIST_MAX) ++kept, out->v[out->n++] = c->points[k].omega;
    }
}

/* The given frequencies; else some along the curve, its peak, the ends, and `strip` beside its folds. */
static hc_status choose_frequencies(search *s, number_list *out)
{
  const hbm_curve *c = &s->curve.curve;
  compare_settings where = s->setup->compare;
  const bool asked = where.omega.n > 0;
  hbm_curve peak = {0};
  where.points = POINTS;
  hc_status st = comparison_frequencies(&where, s->setup->omega_from, s->curve.hbm, c, out);
  if (st != HC_OK || asked) return st;
  const double low = fmin(s->setup->omega_from, s->setup->omega_to),
               high = fmax(s->setup->omega_from, s->setup->omega_to);
  find_folds(c, s->X, s->out);
  add_nonlinear_points(s, out);
  if (hbm_curve_peak(s->curve.hbm, c, &peak) == HC_OK && peak.n > 0 && out->n < NUMBER_LIST_MAX)
    out->v[out->n++] = peak.points[0].omega;
  hbm_curve_free(&peak);
  for (int end = 0; end < 2 && out->n < NUMBER_LIST_MAX; ++end) out->v[out->n++] = end ? high : low;
  for (int i = 0; i < s->out->n_folds; ++i)
    for (int side = -1; side <= 1 && out->n < NUMBER_LIST_MAX; side += 2)
      out->v[out->n++] = s->out->folds[i] * (1 + side * s->out->strip);
  int kept = 0;
  for (int i = 0; i < out->n; ++i)
    if (out->v[i] >= low && out->v[i] <= high && !near_fold(s->out, out->v[i])) out->v[kept++] = out->v[i];
  out->n = kept;
  return HC_OK;
}

/* The truth: doubles the harmonics until its error estimate is small enough, or the work too large. */
static hc_status find_truth(search *s, const number_list *omega)
{
  hc_status st = HC_OK;
  for (int h = FIRST_TRUTH;; h = 2 * h < HBM_MAX_HARMONICS ? 2 * h : HBM_MAX_HARMONICS) {
    double predicted = 0;
    workspace_free(&s->memory);
    hbm_solver_free(s->truth);
    s->truth = NULL;
    s->n = s->out->frequencies = s->out->solutions = s->out->linear = s->out->lost = 0;
    const hbm_settings how = exact_settings(s, h);
    st = hbm_solver_new(s->setup->model, &how, &s->truth);
    if (st != HC_OK) return st;
    const double unknowns = hbm_newton_work(s->truth).unknowns;
    for (int i = 0; i < omega->n && st == HC_OK; ++i) st = add_frequency(s, omega->v[i], &predicted);
    s->out->harmonics = h;
    s->out->predicted = predicted;
    const bool enough = predicted <= proven * s->allowed && s->out->lost == 0;
    if (st != HC_OK || enough || h == HBM_MAX_HARMONICS || pow(2 * unknowns, 3) * omega->n > most_work) return st;
  }
}

/* ---- one setting ---- */

/* Error of the solution X of hbm relative to the target. */
static double distance(search *s, hbm_solver *hbm, const double *X, target *t)
{
  double worst = 0, largest = 0;
  const int n = s->setup->model->n_responses;
  for (int r = 0; r < n; ++r) largest = fmax(largest, t->motion[r].amplitude);
  for (int r = 0; r < n; ++r) {
    periodic_motion m;
    if (!(t->motion[r].amplitude > still * largest)) continue;
    if (motion_of_response(hbm, t->omega, X, r, NULL, &m) != HC_OK) return INFINITY;
    const discrepancy d = motion_discrepancy(&m, &t->motion[r]);
    const struct {
      const char *name;
      double value;
    } of[] = {{"amplitude", d.amplitude}, {"harmonic_1", d.harmonic_1}, {"mean", d.mean}, {"waveform", d.waveform}};
    for (int i = 0; i < 4; ++i)
      if (of[i].value > worst) worst = of[i].value, t->quantity = of[i].name;
  }
  return worst;
}

/* *error: the largest error over the targets, which store theirs; INFINITY: a solution is missing. Stops at the first
 * above `enough`, which is tried first next time. HC_TOO_MANY_POINTS: too much work. */
static hc_status try_setting(search *s, const hbm_settings *how, double enough, double *error, const target **where)
{
  hbm_solver *hbm;
  *error = 0;
  hc_status st = hbm_solver_new(s->setup->model, how, &hbm);
  if (st != HC_OK) return st;
  const int n_coef = hbm_n_coefficients(hbm), zeros = n_coef / (2 * how->harmonics + 1);
  const int known = hbm_n_coefficients(s->truth);
  const double work = pow(hbm_newton_work(hbm).unknowns, 3);
  for (int i = 0; i < s->n && *error <= enough && st == HC_OK; ++i) {
    target *t = &s->targets[i];
    hbm_point point;
    s->work += work;
    memset(s->X, 0, (size_t)n_coef * sizeof *s->X);
    memcpy(s->X, t->X, (size_t)(n_coef < known ? n_coef : known) * sizeof *s->X);
    if (!how->keep_mean) memset(s->X, 0, (size_t)zeros * sizeof *s->X);
    const hc_status solved = hbm_solve(hbm, t->omega, s->X, &point);
    if (solved == HC_NO_MEMORY) st = solved;
    t->quantity = "solution";
    t->error = solved == HC_OK ? distance(s, hbm, s->X, t) : INFINITY;
    if (t->error >= *error) *error = t->error, *where = t;
    if (!hc_monitor_tick(s->monitor, -1)) st = HC_INTERRUPTED;
    else if (s->work > most_work) st = HC_TOO_MANY_POINTS;
    if (t->error > enough && i > 0) {
      const target first = s->targets[0];
      s->targets[0] = *t;
      *t = first;
      *where = s->targets;
    }
  }
  hbm_solver_free(hbm);
  return st;
}

/* *yes: the response curve with these settings contains solutions within `allowed`; with few harmonics it may be
 * another curve. */
static hc_status follows(search *s, const hbm_settings *how, bool *yes)
{
  enum { PROBES = 6 };
  compare_setup setup = *s->setup;
  response_curve c;
  setup.hbm = *how;
  hc_status st = response_trace(&setup, &setup.compare.omega, s->monitor, &c);
  *yes = st == HC_OK && c.hbm;
  for (int i = 0; i < PROBES && i < s->n && *yes; ++i) {
    target *t = &s->targets[i * s->n / (s->n < PROBES ? s->n : PROBES)];
    hbm_curve at = {0};
    st = hbm_curve_at(c.hbm, &c.curve, t->omega, &at) == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK;
    *yes = false;
    for (int k = 0; k < at.n && !*yes; ++k) *yes = distance(s, c.hbm, hbm_curve_X(&at, k), t) <= s->allowed;
    hbm_curve_free(&at);
  }
  response_curve_free(&c);
  return st;
}

static hc_status error_of(search *s, const hbm_settings *how, sufficient_row *row)
{
  const target *where = NULL;
  hc_status st = try_setting(s, how, INFINITY, &row->error, &where);
  row->quantity = where ? where->quantity : "amplitude";
  row->omega = where ? where->omega : NAN;
  return st;
}

/* ---- the searches ---- */

static int ascending_targets(const void *a, const void *b)
{
  const double d = ((const target *)a)->omega - ((const target *)b)->omega;
  return (d > 0) - (d < 0);
}

/* Adds targets halfway between all present ones, if that is affordable; else between the worst ones and their
 * neighbours. */
static hc_status refine(search *s, bool everywhere)
{
  double at[NUMBER_LIST_MAX];
  int n = 0;
  qsort(s->targets, (size_t)s->n, sizeof *s->targets, ascending_targets);
  const double work = s->n * pow(hbm_newton_work(s->truth).unknowns, 3);
  for (int i = 1; i < s->n && n + 2 * REFINED < NUMBER_LIST_MAX && everywhere && work <= little_work; ++i) {
    const double omega = s->targets[i - 1].omega, middle = 0.5 * (omega + s->targets[i].omega);
    if (middle - omega > 1e-6 * omega && !near_fold(s->out, middle)) at[n++] = middle;
  }
  for (int k = 0, all = n; k < REFINED && all == 0; ++k) {
    int top = -1;
    for (int i = 0; i < s->n; ++i)
      if (s->targets[i].error > 0.3 * s->allowed && (top < 0 || s->targets[i].error > s->targets[top].error)) top = i;
    if (top < 0) break;
    const double omega = s->targets[top].omega;
    for (int way = -1; way <= 1; way += 2) {
      int i = top;
      while (i >= 0 && i < s->n && s->targets[i].omega == omega) i += way;
      const double middle = i >= 0 && i < s->n ? 0.5 * (omega + s->targets[i].omega) : omega;
      if (fabs(middle - omega) > 1e-6 * omega && !near_fold(s->out, middle)) at[n++] = middle;
    }
    s->targets[top].error = 0;
  }
  hc_status st = HC_OK;
  for (int i = 0; i < n && st == HC_OK; ++i) st = add_frequency(s, at[i], &s->out->predicted);
  return st;
}

/* All harmonics of the loads are needed. */
static int fewest_harmonics(const search *s)
{
  const int highest = model_highest_load(s->setup->model);
  return highest > 1 ? highest : 1;
}

/* The fewest harmonics, from row->harmonics on, such that these and more keep `allowed`, into row; how: other
 * settings. */
static hc_status least_harmonics(search *s, hbm_settings how, int most, sufficient_row *row)
{
  const int from = row->harmonics > 0 ? row->harmonics : fewest_harmonics(s);
  const double allowed = seen * s->allowed;
  int first = 0;
  hc_status st = HC_OK;
  row->harmonics = 0;
  for (int h = from; h <= most && st == HC_OK; ++h) {
    const target *where;
    double error;
    how.harmonics = row->most_harmonics = h;
    st = try_setting(s, &how, allowed, &error, &where);
    if (st != HC_OK) break;
    if (error <= allowed) {
      if (!first) first = h;
      if (h >= first + 2 + first / 4 || h == most) return row->harmonics = first, HC_OK;
    } else {
      if (first) row->by_chance = first;
      first = 0;
    }
  }
  return st == HC_TOO_MANY_POINTS ? HC_OK : st;
}

static hc_status exact_row(search *s, bool keep_mean, int most, sufficient_row *row)
{
  hbm_settings how = exact_settings(s, 1);
  hc_status st = HC_OK;
  how.keep_mean = keep_mean;
  *row = (sufficient_row){.keep_mean = keep_mean, .error = NAN, .next_error = NAN, .omega = NAN};
  /* Most solutions have no reference that is accurate enough: no result. */
  if (s->out->lost > s->n) return row->most_harmonics = s->out->harmonics, HC_OK;
  for (int round = 0; round <= ROUNDS && st == HC_OK;) {
    st = least_harmonics(s, how, most, row);
    if (st != HC_OK || row->harmonics == 0) return st;
    bool yes;
    how.harmonics = row->harmonics;
    st = follows(s, &how, &yes);
    if (st == HC_OK && !yes) row->by_chance = row->harmonics++;
    if (st != HC_OK || !yes) continue;
    ++round; /* errors between the frequencies may be larger */
    st = error_of(s, &how, row);
    const int before = s->n;
    if (st == HC_OK && round <= ROUNDS && s->setup->compare.omega.n == 0) st = refine(s, round == 1);
    if (s->n == before) break;
  }
  sufficient_row next;
  if (st != HC_OK || row->harmonics == fewest_harmonics(s)) return st;
  row->next_harmonics = how.harmonics = row->harmonics - 1;
  st = error_of(s, &how, &next);
  row->next_error = next.error;
  return st;
}

/* [operations] of a Newton iteration: two transforms and the law a contact, and the factorisation. */
static double cost(const search *s, int harmonics, int samples)
{
  const double n = (double)hbm_n_coefficients(s->truth) / (2 * s->out->harmonics + 1) * (2 * harmonics + 1);
  return s->setup->model->n_contacts * (10 * log2(samples) + 20) * samples + 2 * n * n * n / 3;
}

/* The cheapest pair of harmonics and samples such that it and larger ones keep `allowed`, into row; how: other
 * settings. */
static hc_status cheapest_pair(search *s, int least, hbm_settings how, sufficient_row *row)
{
  const double allowed = seen * s->allowed;
  const int most = least + 4 + least / 4;
  double cheapest = INFINITY;
  hc_status st = HC_OK;
  row->harmonics = row->samples = row->by_chance = 0;
  for (int h = least; h <= most && h <= HBM_MAX_HARMONICS && st == HC_OK; ++h) {
    int first = 0, by_chance = 0, n = 4;
    while (n < 2 * h + 2) n *= 2;
    row->most_harmonics = how.harmonics = h;
    for (; n <= MOST_SAMPLES && cost(s, h, first ? first : n) < cheapest && st == HC_OK; n *= 2) {
      const target *where;
      double error;
      bool yes;
      how.samples = n;
      if ((st = try_setting(s, &how, allowed, &error, &where)) != HC_OK) break;
      if (!(error <= allowed) && first) by_chance = first;
      first = !(error <= allowed) ? 0 : first ? first : n;
      const int beyond = first < MANY_SAMPLES ? 4 : 2; /* with many samples errors fall regularly */
      if (first == 0 || (n < beyond * first && n < MOST_SAMPLES)) continue;
      how.samples = first;
      if ((st = follows(s, &how, &yes)) != HC_OK || !yes) break;
      cheapest = cost(s, h, first);
      row->harmonics = h, row->samples = first, row->by_chance = by_chance;
      break;
    }
  }
  return st == HC_TOO_MANY_POINTS ? HC_OK : st;
}

static hc_status sampled_row(search *s, const sufficient_row *exact, sufficient_row *row)
{
  hbm_settings how = exact_settings(s, exact->harmonics);
  hc_status st = HC_OK;
  how.force = HBM_FORCE_SAMPLED;
  how.keep_mean = exact->keep_mean;
  *row =
      (sufficient_row){.sampled = true, .keep_mean = exact->keep_mean, .error = NAN, .next_error = NAN, .omega = NAN};
  row->most_harmonics = exact->most_harmonics;
  if (exact->harmonics == 0) return HC_OK;
  for (int round = 0; round <= ROUNDS && st == HC_OK; ++round) {
    if (!(row->error <= s->allowed)) st = cheapest_pair(s, exact->harmonics, how, row);
    if (st != HC_OK || row->harmonics == 0) return st;
    s->work = 0;
    how.harmonics = row->harmonics, how.samples = row->samples;
    st = error_of(s, &how, row);
    const int before = s->n;
    if (st == HC_OK && round < ROUNDS && s->setup->compare.omega.n == 0) st = refine(s, false);
    if (s->n == before) break;
    if (st == HC_OK) st = error_of(s, &how, row);
  }
  const bool halved = row->samples / 2 >= 2 * row->harmonics + 2;
  sufficient_row next;
  how.harmonics = halved ? row->harmonics : row->harmonics - 1;
  how.samples = halved ? row->samples / 2 : row->samples;
  if (st != HC_OK || how.harmonics < fewest_harmonics(s)) return st;
  row->next_harmonics = how.harmonics, row->next_samples = how.samples;
  st = error_of(s, &how, &next);
  row->next_error = next.error;
  return st;
}

/* [omega] Distance from turning points within which nothing is compared. */
static double strip_of(const compare_setup *setup, double error)
{
  model_scales scales;
  const double least = fmin(setup->omega_from, setup->omega_to);
  const bool damped = model_find_scales(setup->model, &scales) == HC_OK && scales.half_width > 0;
  return fmax(error, least_strip) * (damped ? fmin(1, widths * scales.half_width / least) : 1);
}

hc_status sufficient_run(const compare_setup *setup, double error, bool without_mean, const hc_monitor *monitor,
                         sufficient *out)
{
  *out = (sufficient){.strip = strip_of(setup, error)};
  search s = {.setup = setup, .monitor = monitor, .allowed = error, .out = out};
  compare_setup traced = *setup;
  number_list omega = {.n = 0};
  workspace memory = {0};
  s.X = workspace_doubles(&memory, (size_t)(2 * HBM_MAX_HARMONICS + 1) * (size_t)setup->model->n);
  traced.hbm = exact_settings(&s, TRACED);
  hc_status st = memory.failed ? HC_NO_MEMORY : response_trace(&traced, &setup->compare.omega, monitor, &s.curve);
  if (st == HC_OK && !s.curve.hbm) st = s.curve.status;
  out->end = s.curve.curve.n ? s.curve.curve.end : s.curve.status;
  if (st == HC_OK && s.curve.curve.n == 0) st = out->end;
  if (st == HC_OK) st = choose_frequencies(&s, &omega);
  if (st == HC_OK) st = find_truth(&s, &omega);
  for (int mean = 1; mean >= (without_mean ? 0 : 1) && st == HC_OK; --mean) {
    sufficient_row *row = &out->rows[out->n];
    const int most = mean ? HBM_MAX_HARMONICS : 2 * TRACED;
    s.work = 0;
    st = exact_row(&s, mean, most, row);
    if (st == HC_OK) ++out->n;
    if (st == HC_OK) st = sampled_row(&s, row, row + 1);
    if (st == HC_OK) ++out->n;
  }
  free(s.targets);
  workspace_free(&s.memory);
  workspace_free(&memory);
  hbm_solver_free(s.truth);
  response_curve_free(&s.curve);
  return st;
}
