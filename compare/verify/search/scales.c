/* scales.c - the search for one factor of all values, one of all frequencies, or both.
 *
 * A factor of the values follows from the points one by one: theirs divided by the truth's at the same omega; the
 * median is held against all of them. For one of the frequencies the truth is looked up along its curve, interpolated
 * linearly between points close together, at many factors; the best are solved for, and refined. */
#include <math.h>
#include <stdlib.h>

#include "compare/response.h"
#include "compare/verify/search/search.h"
#include "hbm/curve/segment.h"
#include "numerics/base/number.h"
#include "numerics/roots.h"

/* The median of value/truth, of the points with one solution, or of all if they are few; NaN: no point has one. */
static double median_ratio(const verify_sample *p, const verify_solutions *of, double *room)
{
  enum { ENOUGH = 8 };
  const int r = p->first;
  int n = 0;
  for (int many = 0; many < 2 && n < ENOUGH; ++many)
    for (int i = 0, most = p->n; i < most; ++i) {
      const int there = of->first[i + 1] - of->first[i];
      if (!p->differs[r][i] || (many ? there < 2 : there != 1)) continue;
      const double ratio = p->value[r][i] / of->of[of->first[i] * of->n_responses + r].q[0];
      if (isfinite(ratio) && ratio > 0) room[n++] = ratio;
    }
  if (n == 0) return NAN;
  qsort(room, (size_t)n, sizeof *room, ascending);
  return room[n / 2];
}

/* Units of length and halves have names of their own. */
static bool usual_factor(const search *s, double factor)
{
  static const double usual[] = {1, 2, 0.5, 0.70710678118654752440};
  for (size_t i = 0; i < sizeof usual / sizeof *usual; ++i)
    if (fabs(factor / usual[i] - 1) < 0.01) return true;
  for (int ten = -3; ten <= 3; ++ten)
    if ((ten < -1 || ten > 1) && fabs(factor / pow(10, ten) - 1) < 0.01)
      return !verify_scale_near(s->scales, s->n_scales, pow(10, ten), 1e-3);
  return false;
}

/* A factor of the values beside what *h says already. */
static void keep_value_scale(search *s, const verify_solutions *of, verify_hypothesis h)
{
  double ratios[SEARCH_MOST_POINTS];
  double factor = median_ratio(&s->points, of, ratios);
  if (!(factor > 0) || usual_factor(s, factor)) return;
  const verify_scale *named = verify_scale_near(s->scales, s->n_scales, factor, 0.02);
  verify_hypothesis free = h;
  free.causes |= VERIFY_BIT(CAUSE_VALUE_SCALE);
  h = free;
  free.fitted = true;
  verify_read_one(&s->points, of, 0, factor, s->floor, &free);
  if (named) {
    h.value_scale = named->name;
    verify_read_one(&s->points, of, 0, named->factor, s->floor, &h);
  }
  search_keep(s, named && h.distance <= 2 * free.distance ? &h : &free);
}

/* All forces larger move everything more where no gap sets a length: that explains as much. */
static hc_status keep_force_scale(search *s)
{
  const verify_hypothesis *best = &s->out->hypotheses[0];
  if (s->out->n_hypotheses == 0 || best->causes != VERIFY_BIT(CAUSE_VALUE_SCALE)) return HC_OK;
  verify_hypothesis h = {.equations = search_own(s),
                         .omega_factor = 1,
                         .value_factor = 1,
                         .fitted = true,
                         .causes = VERIFY_BIT(CAUSE_FORCE)};
  h.equations.change = CHANGE_FORCE;
  h.equations.factor = best->value_factor;
  return search_fit(s, h, s->oscillator ? NULL : &s->many[true][0]);
}

/* ---- the frequencies ---- */

/* The truth's quantity along its curve, at points close together. */
typedef struct outline {
  int n;
  double *omega, *value; /* [n] */
} outline;

static hc_status outline_new(search *s, outline *out)
{
  enum { BETWEEN = 6 }; /* of two points of the curve */
  const verify_equations e = search_equations(s->out->harmonics, true);
  const compare_setup own = verify_settings(s->setup, &e);
  response_curve truth;
  const hbm_curve *curve = &truth.curve;
  *out = (outline){0};
  hc_status st = response_trace(&own, NULL, s->monitor, &truth);
  const int n_harm = s->out->harmonics;
  double *X = malloc(((size_t)curve->n_coef + 1) * sizeof *X);
  double series[2 * HBM_MAX_HARMONICS + 1];
  const size_t room = (size_t)curve->n * BETWEEN + 1;
  out->omega = malloc(2 * room * sizeof *out->omega);
  if (!X || !out->omega) st = HC_NO_MEMORY;
  for (int k = 0; k + 1 < curve->n && st == HC_OK; ++k) {
    if (!hbm_curve_has_segment(curve, k)) continue;
    const hbm_segment seg = hbm_segment_between(curve, k);
    for (int i = 0; i < BETWEEN; ++i) {
      double *const omega = &out->omega[out->n];
      hbm_segment_at(&seg, (double)i / BETWEEN, X, omega, NULL, NULL);
      if (hbm_response(truth.hbm, *omega, X, s->points.first, series) != HC_OK) continue;
      const verify_motion motion = verify_motion_of(*omega, n_harm, series);
      out->omega[room + (size_t)out->n++] = verify_quantity_of(&s->points.quantity[s->points.first], &motion);
    }
  }
  out->value = out->omega ? out->omega + room : NULL;
  free(X);
  response_curve_free(&truth);
  return st;
}

/* How far the value is from the outline at omega, relative to it; MOST where it has none. */
static double apart_at(const outline *o, double omega, double value)
{
  const double most = 0.3;
  double least = most;
  for (int k = 0; k + 1 < o->n; ++k) {
    const double part = (omega - o->omega[k]) / (o->omega[k + 1] - o->omega[k]);
    if (!(part >= 0 && part <= 1)) continue;
    const double there = o->value[k] + part * (o->value[k + 1] - o->value[k]);
    least = fmin(least, fabs(there - value) / fmax(fabs(there), fabs(value)));
  }
  return least;
}

typedef struct stretching {
  search *s;
  const outline *o;
  double value_factor;
} stretching;

static hc_status outline_stretched(void *self, double log_factor, double *out)
{
  const stretching *t = self;
  const double *values = t->s->points.value[t->s->points.first];
  /* Mean over the points, of frequencies times omega and values divided by the other factor. */
  double sum = 0;
  for (int i = 0; i < t->s->points.n; ++i)
    if (!isnan(values[i])) sum += apart_at(t->o, exp(log_factor) * t->s->points.omega[i], values[i] / t->value_factor);
  *out = sum / t->s->points.n;
  return HC_OK;
}

/* The best factor of the frequencies between exp(low) and exp(high), on the outline. */
static double best_stretch(search *s, const outline *o, double value_factor, double low, double high)
{
  enum { SCAN = 400 };
  stretching t = {s, o, value_factor};
  double values[SCAN + 1];
  int best = 0;
  for (int i = 0; i <= SCAN; ++i) {
    outline_stretched(&t, low + (high - low) * i / SCAN, &values[i]);
    if (values[i] < values[best]) best = i;
  }
  const double step = (high - low) / SCAN, at = low + step * best;
  root_point least = {.x = at};
  if (best > 0 && best < SCAN)
    root_minimum(outline_stretched, &t, at - step, values[best - 1], at, values[best], at + step, values[best + 1],
                 1e-6, &least);
  return exp(least.x);
}

static bool is_frequency_unit(double omega_factor)
{
  for (int f = 1; f < SEARCH_FREQUENCIES; ++f)
    if (fabs(omega_factor / search_omega_factor(f) - 1) < 0.005) return true;
  return false;
}

static hc_status stretched_closeness(void *self, double log_factor, double *out)
{
  search *s = self;
  const verify_equations e = search_equations(s->out->harmonics, true);
  verify_solutions of = {0};
  hc_status st = search_solve(s, &e, exp(log_factor), NULL, &of);
  if (st == HC_OK) *out = verify_closeness(&s->points, &of);
  verify_solutions_clear(&of);
  return st == HC_OK && !search_tick(s) ? HC_INTERRUPTED : st;
}

/* The factor of the frequencies that the outline gives, from solutions, where it nearly fits. */
static hc_status polish_stretch(search *s, double *omega_factor)
{
  const double nearly = 0.02, around = 1e-3, precise = 2e-6; /* [1] */
  const double at = log(*omega_factor);
  double middle, ends[2];
  root_point least;
  hc_status st = stretched_closeness(s, at, &middle);
  if (st != HC_OK || middle > nearly) return st;
  for (int k = 0; k < 2 && st == HC_OK; ++k) st = stretched_closeness(s, at + (k ? around : -around), &ends[k]);
  if (st != HC_OK || middle > fmin(ends[0], ends[1])) return st;
  st = root_minimum(stretched_closeness, s, at - around, ends[0], at, middle, at + around, ends[1], precise, &least);
  if (st == HC_OK) *omega_factor = exp(least.x);
  return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK;
}

/* omega_factor: true = factor times theirs. */
static hc_status keep_stretch(search *s, double omega_factor, double value_factor)
{
  const double nothing = 1e-5, offset = 0.02; /* a larger one is no offset any more */
  verify_scale names[VERIFY_MOST_SCALES];
  const int n = verify_omega_scales(s->setup->model, names);
  const verify_scale *named = verify_scale_near(names, n, 1 / omega_factor, 0.005),
                     *value = verify_scale_near(s->scales, s->n_scales, value_factor, 0.005);
  if (is_frequency_unit(omega_factor) || fabs(omega_factor - 1) < nothing) return HC_OK;
  if (!named && value_factor == 1) {
    const hc_status polished = polish_stretch(s, &omega_factor);
    if (polished != HC_OK) return polished == HC_BAD_INPUT ? HC_OK : polished;
  }
  verify_hypothesis h = {.equations = search_equations(s->out->harmonics, true),
                         .causes =
                             VERIFY_BIT(fabs(omega_factor - 1) < offset ? CAUSE_OMEGA_OFFSET : CAUSE_OMEGA_SCALE) |
                             (value_factor == 1 ? 0 : VERIFY_BIT(CAUSE_VALUE_SCALE)),
                         .fitted = !named || (value_factor != 1 && !value),
                         .omega_factor = named ? 1 / named->factor : omega_factor,
                         .value_factor = value_factor != 1 && value ? value->factor : value_factor,
                         .omega_scale = named ? named->name : NULL,
                         .value_scale = value_factor != 1 && value ? value->name : NULL};
  hc_status st = search_fit(s, h, NULL);
  h.equations = search_own(s);
  return st == HC_OK && s->own != s->out->harmonics && s->oscillator ? search_fit(s, h, NULL) : st;
}

/* Factors of the frequencies that leave the points within the sweep, and those near 1. */
static hc_status try_stretches(search *s, const outline *o)
{
  const double near = 0.1, first = s->points.omega[0], last = s->points.omega[s->points.n - 1];
  const double low = fmin(s->setup->omega_from, s->setup->omega_to),
               high = fmax(s->setup->omega_from, s->setup->omega_to);
  const double from = log(low / first) - near, to = log(high / last) + near;
  double largest = 0, theirs = 0;
  for (int i = 0; i < o->n; ++i) largest = fmax(largest, fabs(o->value[i]));
  for (int i = 0; i < s->points.n; ++i) theirs = fmax(theirs, fabs(s->points.value[s->points.first][i]));
  hc_status st = keep_stretch(s, best_stretch(s, o, 1, -near, near), 1);
  if (st != HC_OK || !(from < to)) return st;
  st = keep_stretch(s, best_stretch(s, o, 1, from, to), 1);
  for (int i = 0; i <= s->n_scales && st == HC_OK; ++i) {
    const double factor = i < s->n_scales ? s->scales[i].factor : theirs / largest; /* of peak to peak */
    if (!(factor > 0) || fabs(factor - 1) < 0.05) continue;
    st = keep_stretch(s, best_stretch(s, o, factor, from, to), factor);
  }
  return st;
}

hc_status search_scales(search *s)
{
  const verify_hypothesis plain = {.equations = search_equations(s->out->harmonics, true), .omega_factor = 1};
  outline o;
  keep_value_scale(s, &s->many[true][0], plain);
  hc_status st = keep_force_scale(s);
  if (st == HC_OK) st = outline_new(s, &o);
  else return st;
  if (st == HC_OK && o.n > 1) st = try_stretches(s, &o);
  free(o.omega);
  return st;
}

/* ---- numbers of the model ---- */

/* One number of the model is another, by a factor or an angle that is fitted: the smallest mean distance of the points,
 * bracketed among a few, then by parabolas. Factors within small_factor of 1 are no mistakes that somebody makes, and
 * would imitate errors of other kinds; likewise angles. */
static const double fit_factors[] = {0.05, 0.1,  0.2,  0.35, 0.5, 0.63, 0.75, 0.85, 0.93, 1,
                                     1.08, 1.18, 1.33, 1.6,  2,   3,    5,    10,   20},
                    fit_angles[] = {-80, -65, -50, -40, -30, -20, -12, -6, -2, 0, 2, 6, 12, 20, 30, 40, 50, 65, 80};
enum { SCANNED = sizeof fit_factors / sizeof *fit_factors, UNCHANGED = 9, USUAL_HARMONICS = 10 };
/* A fit to a structure's points counts if it halves their distance (much_closer). The search for its minimum ends after
 * FIRST_STEPS if the distance is then above 0.75 (closer): each step narrows the bracket to less than two thirds. */
enum { FIRST_STEPS = 4 };
static const double much_closer = 0.5, closer = 0.75;
static const double small_factor = 0.02, small_angle = 0.5,
                    precise_factor = 3e-5; /* [1], [degree], of log and degree */

typedef struct fit {
  search *s;
  double *unchanged; /* [1] closeness of the model as it is; NaN: not known yet */
  verify_equations equations;
  bool turn;
  int steps;             /* towards the minimum so far */
  double before, least;  /* closeness with the factor 1, and the least on the way */
  verify_solutions last; /* where Newton starts: of a structure, the nearest factor's that was tried */
} fit;

static double fit_parameter(const fit *f, int i) { return f->turn ? fit_angles[i] : log(fit_factors[i]); }

static hc_status closeness_at(void *self, double at, double *out)
{
  fit *f = self;
  search *s = f->s;
  verify_solutions of = {0};
  f->equations.factor = f->turn ? at : exp(at);
  s->points.look = s->oscillator ? SEARCH_ALL : SEARCH_FEW;
  s->plainly = !s->oscillator;
  const verify_solutions *near = s->oscillator ? NULL : f->last.n ? &f->last : &s->many[true][0];
  hc_status st = search_solve(s, &f->equations, 1, near, &of);
  if (st == HC_OK) *out = verify_closeness(&s->points, &of);
  if (st == HC_OK && 2 * of.count > s->many[true][0].count * 3 / 10) {
    verify_solutions_clear(&f->last);
    f->last = of;
    of = (verify_solutions){0};
  }
  verify_solutions_clear(&of);
  s->points.look = SEARCH_ALL;
  s->plainly = false;
  if (st == HC_OK && !search_tick(s)) st = HC_INTERRUPTED;
  return st;
}

/* closeness_at for root_minimum. HC_NOT_CONVERGED: after FIRST_STEPS the points are hardly closer. */
static hc_status closeness_on_the_way(void *self, double at, double *out)
{
  fit *f = self;
  const hc_status st = closeness_at(f, at, out);
  if (st != HC_OK) return st;
  f->least = fmin(f->least, *out);
  if (f->s->oscillator || ++f->steps < FIRST_STEPS) return HC_OK;
  return f->least <= closer * f->before ? HC_OK : HC_NOT_CONVERGED;
}

/* From number i on in steps of `by` as long as it comes closer, or to the end. */
static hc_status walk(fit *f, int from, int by, bool to_the_end, double *values, int *best)
{
  hc_status st = HC_OK;
  verify_solutions_clear(&f->last);
  for (int i = from + by; i >= 0 && i < SCANNED && st == HC_OK; i += by) {
    st = closeness_at(f, fit_parameter(f, i), &values[i]);
    if (st != HC_OK) return st;
    if (values[i] < values[*best]) *best = i;
    else if (!to_the_end && values[i] > values[i - by]) break;
  }
  return st;
}

/* The usual number of harmonics that comes closest, and the number of the model with that. */
static hc_status fit_harmonics(fit *f, root_point *least)
{
  const double around = f->turn ? 1 : 0.03; /* [degree], of the logarithm */
  const int before = f->equations.harmonics;
  int best = before;
  double value, closest = least->f, ends[2];
  hc_status st = HC_OK;
  for (int i = 0; i < SEARCH_ORDERS && st == HC_OK; ++i) {
    f->equations.harmonics = search_order(f->s, i);
    if (f->equations.harmonics == before) continue;
    st = closeness_at(f, least->x, &value);
    if (st == HC_OK && value < closest) closest = value, best = f->equations.harmonics;
  }
  f->equations.harmonics = best;
  for (int k = 0; k < 2 && best != before && st == HC_OK; ++k)
    st = closeness_at(f, least->x + (k ? around : -around), &ends[k]);
  if (st != HC_OK || best == before) return st;
  root_point finer;
  st = root_minimum(closeness_at, f, least->x - around, ends[0], least->x, closest, least->x + around, ends[1],
                    precise_factor, &finer);
  if (st == HC_OK || st == HC_NOT_CONVERGED) *least = finer;
  return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK;
}

/* HC_BAD_INPUT: there are no such equations. */
static hc_status fit_number(search *s, fit *f)
{
  const verify_change change = f->equations.change;
  const bool kind = verify_change_of_kind(change); /* the factor 1 is not the truth */
  double values[SCANNED];
  int best = UNCHANGED;
  root_point least;
  for (int i = 0; i < SCANNED; ++i) values[i] = INFINITY;
  hc_status st = HC_OK;
  if (!kind) values[UNCHANGED] = *f->unchanged;
  if (kind || isnan(*f->unchanged)) st = closeness_at(f, fit_parameter(f, UNCHANGED), &values[UNCHANGED]);
  if (!kind && st == HC_OK) *f->unchanged = values[UNCHANGED];
  for (int by = -1; by <= 1 && st == HC_OK; by += 2) st = walk(f, UNCHANGED, by, kind, values, &best);
  if (st != HC_OK) return st;
  if (best == 0 || best == SCANNED - 1 || (best == UNCHANGED && !kind)) return HC_OK;
  verify_solutions_clear(&f->last);
  f->steps = 0;
  f->before = values[UNCHANGED];
  f->least = values[best];
  st = root_minimum(closeness_on_the_way, f, fit_parameter(f, best - 1), values[best - 1], fit_parameter(f, best),
                    values[best], fit_parameter(f, best + 1), values[best + 1], precise_factor, &least);
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return st;
  if (!s->oscillator && f->least > much_closer * f->before) return HC_OK;
  if (!kind && fabs(least.x) <= (f->turn ? small_angle : small_factor)) return HC_OK;
  st = s->oscillator ? HC_OK : fit_harmonics(f, &least);
  if (st != HC_OK) return st;
  verify_hypothesis h = {.equations = f->equations,
                         .omega_factor = 1,
                         .value_factor = 1,
                         .fitted = true,
                         .causes = VERIFY_BIT(verify_changes[change].cause)};
  h.equations.factor = f->turn ? least.x : exp(least.x);
  for (int i = 0; i < SEARCH_USUAL_FACTORS && !f->turn && !s->oscillator; ++i)
    if (fabs(h.equations.factor / search_usual[i] - 1) < 1e-3) h.equations.factor = search_usual[i], h.fitted = kind;
  return search_fit(s, h, s->oscillator ? NULL : &s->many[true][0]);
}

hc_status search_fits(search *s)
{
  const model *m = s->setup->model;
  double unchanged = NAN;
  hc_status st = HC_OK;
  for (int c = CHANGE_FORCE; c < VERIFY_MODEL_CHANGES && st == HC_OK; ++c)
    for (int which = 0; which < verify_change_variants(m, c) && verify_changes[c].scan && st == HC_OK; ++which) {
      fit f = {
          .s = s, .unchanged = &unchanged, .equations = search_own(s), .turn = verify_changes[c].scan == SCAN_TURN};
      f.equations.change = c;
      f.equations.which = which;
      f.equations.n = m->n;
      if (!s->oscillator && f.equations.harmonics < USUAL_HARMONICS) f.equations.harmonics = USUAL_HARMONICS;
      st = search_passed(s, &f.equations, 0, fit_number(s, &f));
      verify_solutions_clear(&f.last);
    }
  return st;
}
