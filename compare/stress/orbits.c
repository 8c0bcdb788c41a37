/* orbits.c - a scene by time integration: the orbit of the exact law next to the HBM solution, in closed form, and its
 * multiplier; then that orbit in other coordinates, other units and at another time, from beside it, by CVODE, by the
 * regularised law.
 *
 * The first check leaves the orbit and the finest HBM solution it needed (solved_scene.path, .fine) to those after it.
 * What differs by more than 1e-6 of the largest response must come nearer with twice the harmonics, or lie within what
 * doubling them changes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/stress/solved_scene.h"
#include "model/modes.h"
#include "numerics/base/constants.h"
#include "numerics/norm.h"
#include "numerics/random.h"
#include "numerics/series.h"
#include "proof/prove/certificate.h"
#include "proof/prove/checker.h"

/* ---- one orbit ---------------------------------------------------------------------------------------------- */

typedef enum path_way {
  PATH_ORBIT, /* timeint_orbit: next to the start, stable or not */
  PATH_AGAIN, /* timeint_again: the start is on it but for errors of integration */
  PATH_STEADY /* timeint_steady: where the motion goes from the start */
} path_way;

/* Relative to the largest response; rounding through (I - Phi)^-1 comes besides. CVODE's: docs/measurements. */
static const double close_enough = 1e-6, same_orbit = 1e-3, same_in_closed_form = 1e-9, same_by_cvode = 1e-8;
static const double same_law = 1e-6, beside = 1e-5, nearby = 1e-4, tolerance = 1e-10;
enum { MOST_PERIODS = 400, MOST_HARMONICS = 160, MOST_UNKNOWNS = 1500 };
enum { ALONE_EVERY = 8 }; /* scenes for which CVODE finds the orbit by itself */

/* The exact law from where the start says: in closed form, but for smooth laws, which have none. */
static transient_settings path_settings(const model *m)
{
  return (transient_settings){.law = TRANSIENT_LAW_EXACT,
                              .method = model_is_smooth(m) ? TRANSIENT_METHOD_CVODE : TRANSIENT_METHOD_CLOSED_FORM,
                              .regularisation = 1e-4,
                              .steady = TRANSIENT_STEADY_AUTO,
                              .start = TRANSIENT_START_REST,
                              .tolerance = tolerance,
                              .max_periods = MOST_PERIODS};
}

static size_t state_length(const model *m) { return 2 * (size_t)m->n + (size_t)m->n_contacts; }

/* An orbit to find: of m, with the base model's DOFs as responses 1 .. n, in units `length` to one. */
typedef struct search {
  const model *m;
  transient_settings how;
  path_way way;
  double omega, length;
} search;

/* The orbit of the base model next to a start, by the exact law in closed form. */
static search next_to(const solved_scene *s)
{
  return (search){s->model, path_settings(s->model), PATH_ORBIT, s->omega, 1};
}

/* To which another orbit is p, whose mean is integrated, too: tolerances, and rounding, are relative to both. */
static double within(const stress_path *p, double same) { return same * fmax(1, p->size / p->amplitude); }
static double by_cvode(const stress_path *p) { return within(p, same_by_cvode); }

/* To which an orbit that is found again is the same. */
static double same_again(const solved_scene *s)
{
  return model_is_smooth(s->model) ? by_cvode(&s->path) : within(&s->path, same_in_closed_form);
}

static hc_status read_waves(const solved_scene *s, timeint *ti, double length, stress_path *p)
{
  timeint_result one = p->r;
  p->amplitude = p->size = 0;
  for (int i = 0; i < s->n; ++i) {
    hc_status st = timeint_response(ti, 1 + i, &one);
    if (st != HC_OK) return st;
    p->amplitude = fmax(p->amplitude, one.amplitude / length);
    for (int k = 0; k < TIMEINT_WAVE; ++k) {
      p->wave[i * TIMEINT_WAVE + k] = one.wave[k] / length;
      p->size = fmax(p->size, fabs(one.wave[k]) / length);
    }
  }
  p->errors = (p->r.closure + p->r.attainable) * (p->r.amplitude / length) / p->amplitude;
  return HC_OK;
}

/* From from[2 n + contacts], or from rest where it is NULL. Its status is that of the way; also HC_NOT_SETTLED where it
 * is of several periods; HC_NO_MEMORY goes to s->fatal. stress_path_free in any case. */
static stress_path find_path(solved_scene *s, const search *at, const double *from)
{
  timeint *ti = NULL;
  stress_path p = {.state = calloc(state_length(at->m), sizeof *p.state),
                   .wave = calloc((size_t)s->n * TIMEINT_WAVE, sizeof *p.wave)};
  p.status = p.state && p.wave ? s->fatal : HC_NO_MEMORY;
  if (p.status == HC_OK && from) memcpy(p.state, from, state_length(at->m) * sizeof *from);
  if (p.status == HC_OK) p.status = timeint_new(at->m, &at->how, &ti);
  if (p.status == HC_OK) switch (at->way) {
    case PATH_ORBIT: p.status = timeint_orbit(ti, at->omega, 1, p.state, &s->monitor, &p.r); break;
    case PATH_AGAIN: p.status = timeint_again(ti, at->omega, 1, p.state, &s->monitor, &p.r); break;
    case PATH_STEADY: p.status = timeint_steady(ti, at->omega, p.state, &s->monitor, &p.r); break;
    }
  if (p.status == HC_OK && p.r.period_multiple != 1) p.status = HC_NOT_SETTLED;
  if (p.status == HC_OK) p.status = read_waves(s, ti, at->length, &p);
  timeint_free(ti);
  if (p.status == HC_NO_MEMORY) s->fatal = HC_NO_MEMORY;
  return p;
}

/* Largest |a(t) - b(t)| of any degree of freedom, b later by `shift` samples, over a's largest amplitude. */
static double paths_apart(const solved_scene *s, const stress_path *a, const stress_path *b, int shift)
{
  double apart = 0;
  for (int i = 0; i < s->n; ++i)
    for (int k = 0; k < TIMEINT_WAVE; ++k) {
      const double *of = b->wave + i * TIMEINT_WAVE,
                   d = fabs(a->wave[i * TIMEINT_WAVE + k] - of[(k + shift) % TIMEINT_WAVE]);
      apart = larger(apart, d);
    }
  return apart / a->amplitude;
}

void stress_path_of(solved_scene *s, const model *m, const double *from, stress_path *out)
{
  search at = next_to(s);
  at.m = m;
  *out = find_path(s, &at, from);
}

double stress_path_off(const solved_scene *s, int n_coef, const double *x, const stress_path *p)
{
  double off = 0;
  for (int k = 0; k < TIMEINT_WAVE; ++k)
    for (int i = 0; i < s->n; ++i) {
      double sum = x[i] - p->wave[i * TIMEINT_WAVE + k];
      for (int h = 1; 2 * h < n_coef; ++h) {
        const double turn = TWO_PI * ((long)h * k % TIMEINT_WAVE) / TIMEINT_WAVE;
        sum += x[(2 * h - 1) * s->n + i] * cos(turn) + x[2 * h * s->n + i] * sin(turn);
      }
      off = larger(off, fabs(sum));
    }
  return off / p->amplitude;
}

/* ---- the orbit ---------------------------------------------------------------------------------------- */

/* HBM of m, the base model or one rewritten, with n_harm harmonics, from guess[n_coef][n]. */
static void solve_with(solved_scene *s, const model *m, int n_harm, int n_coef, const double *guess, stress_motion *out)
{
  hbm_settings how = s->how;
  how.harmonics = n_harm;
  const size_t most = (size_t)series_length(n_harm) * (size_t)s->n, given = (size_t)n_coef * (size_t)s->n;
  double *padded = calloc(most, sizeof *padded);
  *out = (stress_motion){.status = HC_NO_MEMORY, .harmonics = n_harm};
  if (!padded) s->fatal = HC_NO_MEMORY;
  else {
    if (guess) memcpy(padded, guess, (given < most ? given : most) * sizeof *padded);
    stress_motion_solve(s, m, &how, s->omega, padded, 1, out);
  }
  free(padded);
}

/* The same with n_harm harmonics. */
static void solve_again(solved_scene *s, const stress_motion *from, int n_harm, stress_motion *out)
{
  solve_with(s, s->model, n_harm, series_length(from->harmonics), from->x, out);
}

static double motion_off(const solved_scene *s, const stress_motion *h, const stress_path *p)
{
  return stress_path_off(s, series_length(h->harmonics), h->x, p);
}

/* The orbit next to that solution, into *path, and how far apart they are; NaN without one. */
static double shoot_from(solved_scene *s, const stress_motion *from, stress_path *path)
{
  *path = (stress_path){.status = HC_NOT_CONVERGED};
  if (from->status != HC_OK || from->start_status != HC_OK) return NAN;
  stress_path_of(s, s->model, from->start, path);
  return path->status == HC_OK ? motion_off(s, from, path) : NAN;
}

/* The orbit's harmonics [2H+1][n], `shift` samples later, as many as s->fine has. NULL: out of memory, s->fatal. */
static double *harmonics_of(solved_scene *s, const stress_path *path, int shift)
{
  const int n_harm = s->fine.harmonics, n_coef = series_length(n_harm);
  double *x = calloc((size_t)n_coef * (size_t)s->n, sizeof *x), *one = calloc((size_t)n_coef, sizeof *one);
  if (!x || !one) s->fatal = HC_NO_MEMORY;
  for (int i = 0; x && one && i < s->n; ++i) {
    periodic_motion motion = {.amplitude = 1};
    for (int k = 0; k < TIMEINT_WAVE; ++k)
      motion.samples[k] = path->wave[i * TIMEINT_WAVE + (k + shift) % TIMEINT_WAVE];
    motion_harmonics(&motion, n_harm, one);
    for (int c = 0; c < n_coef; ++c) x[c * s->n + i] = one[c];
  }
  free(one ? one : x);
  return one ? x : NULL;
}

/* HBM of m, the base model or one rewritten with its coordinates, from the orbit's harmonics. stress_motion_free in any
 * case. */
static void motion_beside(solved_scene *s, const model *m, const stress_path *path, int shift, stress_motion *out)
{
  double *guess = harmonics_of(s, path, shift);
  *out = (stress_motion){.status = HC_NO_MEMORY};
  if (guess) solve_with(s, m, s->fine.harmonics, series_length(s->fine.harmonics), guess, out);
  free(guess);
}

/* How much of the orbit, over its amplitude, lies beyond the harmonics of s->fine; 0: it is not known. */
static double beyond_harmonics(solved_scene *s)
{
  double *x = harmonics_of(s, &s->path, 0);
  const double left = x ? stress_path_off(s, series_length(s->fine.harmonics), x, &s->path) : 0;
  free(x);
  return left;
}

/* Does the stuck structure ring, after each transition, above a tenth of the last harmonic? */
static bool rings_beyond(solved_scene *s)
{
  model_scales scales;
  hc_status st = model_find_scales(s->model, &scales);
  if (st == HC_NO_MEMORY) s->fatal = st;
  return st == HC_OK && scales.highest > 0.1 * s->fine.harmonics * s->omega;
}

/* What the errors of two orbits may set apart, or those of one. */
static double sensitive(const stress_path *a, const stress_path *b)
{
  const double errors = a->errors + (b ? b->errors : 0);
  return errors >= 0 ? 3 * errors : 0;
}

static double tolerance_of(const stress_path *p) { return fmax(close_enough, sensitive(p, NULL)); }

static bool affordable(const solved_scene *s, int n_harm)
{
  const int coordinates = 2 * s->model->n_contacts < s->n ? 2 * s->model->n_contacts : s->n;
  return coordinates * series_length(n_harm) <= MOST_UNKNOWNS;
}

/* s->fine and s->path become those of n_harm harmonics, if there are. *step: the change; *member: how far the finer
 * solution is from the orbit there was. */
static bool refine(solved_scene *s, int n_harm, double *error, double *step, double *member)
{
  stress_motion finer;
  stress_path path;
  solve_again(s, &s->fine, n_harm, &finer);
  if (finer.status != HC_OK) {
    stress_motion_free(&finer);
    return false;
  }
  *error = shoot_from(s, &finer, &path);
  *member = s->path.status == HC_OK ? motion_off(s, &finer, &s->path) : NAN;
  /* A bound of the change by more harmonics, of any degree of freedom, over that amplitude. */
  const int n_coef = series_length(s->fine.harmonics), n_fine = series_length(finer.harmonics);
  double most = 0;
  for (int i = 0; i < s->n; ++i) {
    double sum = 0;
    for (int c = 0; c < n_fine; ++c) sum += fabs(finer.x[c * s->n + i] - (c < n_coef ? s->fine.x[c * s->n + i] : 0));
    most = fmax(most, sum);
  }
  *step = most / (path.status == HC_OK ? path.amplitude : finer.m.amplitude);
  stress_motion_free(&s->fine);
  stress_path_free(&s->path);
  s->fine = finer;
  s->path = path;
  return true;
}

/* s->enough, unless fewer were. */
static void note_enough(solved_scene *s, double error)
{
  const discrepancy gate = gate_limits_at(&s->asked->gate, s->omega);
  const double least = fmin(fmin(gate.amplitude, gate.harmonic_1), fmin(gate.mean, gate.waveform));
  if (s->enough == 0 && error <= least / 100) s->enough = s->fine.harmonics;
}

/* A slider that never slips, but comes to its limit, may rest elsewhere: how far the orbit follows, over its amplitude,
 * where sliders are at slider[n_contacts] of a model whose lengths are that much longer. By how it follows them a
 * millionth of the amplitude to either side, if they stay there; contacts change at other times, too, hence twice. */
static double follows_sliders(solved_scene *s, const double *slider, double length)
{
  const search near = next_to(s);
  const int n_contacts = s->model->n_contacts;
  const double *rest = s->path.state + 2 * s->n;
  double *from = malloc(state_length(s->model) * sizeof *from), moved = 0, rate = 0;
  if (!from) s->fatal = HC_NO_MEMORY;
  for (int j = 0; j < n_contacts; ++j) moved = hypot(moved, slider[j] / length - rest[j]);
  for (int side = -1; side <= 1 && from && moved > 0 && s->path.r.free_sliders > 0; side += 2) {
    const double part = side * 1e-6 * s->path.amplitude / moved;
    memcpy(from, s->path.state, state_length(s->model) * sizeof *from);
    for (int j = 0; j < n_contacts; ++j) from[2 * s->n + j] += part * (slider[j] / length - rest[j]);
    stress_path member = find_path(s, &near, from);
    const double far = member.status == HC_OK ? distance_2(n_contacts, member.state + 2 * s->n, rest) : 0;
    if (far > 0) rate = fmax(rate, paths_apart(s, &s->path, &member, 0) / far);
    stress_path_free(&member);
  }
  free(from);
  return 2 * rate * moved;
}

/* Harmonics are doubled until HBM and the orbit next to it meet. */
stress_check stress_check_orbit(solved_scene *s)
{
  bool loaded = false; /* statically */
  solve_again(s, &s->base, s->base.harmonics, &s->fine);
  if (s->fine.status != HC_OK) return stress_refuse(s, s->fine.status);
  double error = shoot_from(s, &s->fine, &s->path), before = NAN, step = NAN, member = NAN;
  for (int l = 0; l < s->model->n_loads; ++l) loaded = loaded || s->model->loads[l].harmonic == 0;
  if (!s->how.keep_mean && (loaded || s->base.m.contact.regime != CONTACT_LINEAR))
    return stress_skip(STRESS_NOT_APPLICABLE); /* without harmonic 0, means and static loads are left out */
  const double coarse = error;
  note_enough(s, error);
  if (s->path.status == HC_OK && error <= tolerance_of(&s->path))
    return stress_agree_within(error, close_enough, sensitive(&s->path, NULL));
  for (int n; s->fatal == HC_OK && (n = 2 * s->fine.harmonics) <= MOST_HARMONICS && affordable(s, n);) {
    before = error;
    if (!refine(s, n, &error, &step, &member)) break;
    note_enough(s, error);
    if (s->path.status == HC_INTERRUPTED) return stress_refuse(s, s->path.status);
    if (s->path.status == HC_OK && error <= tolerance_of(&s->path))
      return stress_explain(STRESS_TRUNCATED, coarse, NAN);
  }

  /* beyond the bound with as many harmonics as may be */
  if (s->path.status != HC_OK) return stress_refuse(s, s->path.status);
  if (error <= before / 2 || (error < before && error <= 3 * step))
    return stress_explain(STRESS_TRUNCATED, error, 3 * step);
  const double unkept = 10 * beyond_harmonics(s);
  if (error <= unkept && rings_beyond(s)) return stress_explain(STRESS_UNRESOLVED, error, unkept);
  if (s->path.r.free_sliders > 0 && member <= error / 10) return stress_explain(STRESS_FAMILY, error, member);
  const double follows = follows_sliders(s, s->fine.start + 2 * s->n, 1);
  if (error <= follows) return stress_explain(STRESS_FAMILY, error, follows);
  stress_motion from_orbit; /* does HBM, from the orbit's own harmonics, end on it? */
  motion_beside(s, s->model, &s->path, 0, &from_orbit);
  const double other = from_orbit.status == HC_OK ? motion_off(s, &from_orbit, &s->path) : NAN;
  stress_motion_free(&from_orbit);
  if (other <= fmin(error / 10, same_orbit)) return stress_explain(STRESS_OTHER_ORBIT, error, other);
  stress_condition(s);
  const stress_check c = stress_agree_within(error, tolerance_of(&s->path), s->solution_errs);
  if (c.outcome != STRESS_FINDING) return c;
  /* The last doubling may have been nearer by chance, as where the error changes its sign. */
  if (affordable(s, HBM_MAX_HARMONICS) && refine(s, HBM_MAX_HARMONICS, &error, &step, &member) &&
      error <= tolerance_of(&s->path))
    return stress_explain(STRESS_TRUNCATED, coarse, NAN);
  return c;
}

/* ---- its multiplier ----------------------------------------------------------------------------------- */

static double multipliers_apart(const stress_motion *h, const stress_path *p)
{
  if (h->stability_status != HC_OK) return NAN;
  return fabs(h->stability.multiplier - p->r.multiplier) / fmax(1, p->r.multiplier);
}

/* HBM's multiplier with twice the harmonics, and twice, until it is the orbit's or there are no more; how far off it
 * then is. Contacts much stiffer than the structure close for so short a time that many harmonics move its ends.
 *
 * As x'' is bounded, harmonics fall as 1/h^2 or faster, and truncation moves x, and with it the instants at which
 * contacts change, by 1/H or less. So *truncated where at last the difference fell as 1/H or faster, or within the
 * bound. A contact that is shorter than the last harmonic's period has as large a share in all harmonics: the
 * difference falls in proportion to their number, and the multiplier is *unresolved. That is evidence, not a bound:
 * what is left may hide an error as large as itself. */
static double better_multiplier(solved_scene *s, double error, double bound, bool *truncated, bool *unresolved)
{
  stress_motion h = {.status = HC_OK};
  const stress_motion *from = &s->fine;
  double fell = NAN; /* by a harmonic more */
  *truncated = *unresolved = false;
  for (int n = from->harmonics, more; error > bound && n < HBM_MAX_HARMONICS; n = more) {
    stress_motion finer;
    more = 2 * n < HBM_MAX_HARMONICS ? 2 * n : HBM_MAX_HARMONICS;
    if (n > s->fine.harmonics && !affordable(s, more)) break; /* beyond what `orbit` may take once */
    solve_again(s, from, more, &finer);
    const double now = finer.status == HC_OK ? multipliers_apart(&finer, &s->path) : NAN;
    stress_motion_free(&h);
    h = finer, from = &h;
    if (isnan(now)) break;
    const bool falls = now <= fmax(bound, error * n / more);
    if (falls || more == 2 * n) *truncated = falls;
    *unresolved = error - now >= 0.9 * (more - n) * fell && fell > 0;
    fell = (error - now) / (more - n);
    error = now;
  }
  stress_motion_free(&h);
  return error;
}

/* A slider that never slips may rest at its limit, |T| = mu N at one instant: multipliers are one-sided there. Does an
 * orbit next to that one, with a slider off its limit, have HBM's? */
static bool beside_its_limit(solved_scene *s, double bound)
{
  const search at = next_to(s);
  const double off = model_is_smooth(s->model) ? 1e-3 : beside; /* where multipliers are differences over 1e-4 */
  bool found = false;
  for (int i = 0; i < 2 * s->model->n_contacts && s->path.r.free_sliders > 0 && !found; ++i) {
    double *slider = &s->path.state[2 * s->n + i / 2], rests = *slider;
    *slider += (i % 2 ? -off : off) * s->path.amplitude;
    stress_path other = find_path(s, &at, s->path.state);
    *slider = rests;
    found = other.status == HC_OK && paths_apart(s, &s->path, &other, 0) <= 10 * off &&
            multipliers_apart(&s->fine, &other) <= bound;
    stress_path_free(&other);
  }
  return found;
}

/* A multiplier jumps where a transition appears or disappears. */
stress_check stress_check_multiplier(solved_scene *s)
{
  const double bound = 1e-3;
  bool truncated, unresolved;
  if (s->path.status != HC_OK || isnan(s->path.r.multiplier) || s->fine.stability_status != HC_OK)
    return stress_skip(STRESS_NO_ORBIT);
  const double far = motion_off(s, &s->fine, &s->path);
  if (!(far <= same_orbit)) return stress_skip(STRESS_NO_ORBIT);
  const double error = multipliers_apart(&s->fine, &s->path);
  if (error <= bound) return stress_agree(error, bound);
  const double better = better_multiplier(s, error, bound, &truncated, &unresolved);
  if (truncated) return stress_explain(STRESS_TRUNCATED, error, better);
  if (s->fine.m.contact.transitions != s->path.r.switches) return stress_explain(STRESS_OTHER_EVENTS, error, better);
  if (unresolved && rings_beyond(s)) return stress_explain(STRESS_UNRESOLVED, error, better);
  if (beside_its_limit(s, bound)) return stress_explain(STRESS_FAMILY, error, better);
  stress_condition(s);
  if (s->solution_errs > STRESS_SAYS_SOMETHING) return stress_skip(STRESS_ILL_CONDITIONED);
  const stress_check c = stress_agree_within(error, bound, s->multiplier_errs);
  if (c.outcome != STRESS_FINDING) return c;
  const double by_motion = s->multiplier_rate * far; /* of what fewer harmonics than there are leave of the motion */
  if (error <= by_motion) return stress_explain(STRESS_TRUNCATED, error, by_motion);
  if (!hc_monitor_tick(&s->monitor, -1)) return stress_refuse(s, HC_INTERRUPTED); /* some of these had no time */
  return c;
}

/* ---- that orbit again ---------------------------------------------------------------------------------- */

static bool known(const solved_scene *s) { return s->path.status == HC_OK; }

/* Does that method stay on that orbit of m, too? Then it is one. */
static bool is_orbit(solved_scene *s, const model *m, const stress_path *p, transient_method method)
{
  search at = next_to(s);
  at.m = m;
  at.how.method = method;
  at.how.tolerance = 1e-9;
  stress_path again = find_path(s, &at, p->state);
  const double bound = fmax(by_cvode(p), sensitive(p, &again));
  const bool same = again.status == HC_OK && paths_apart(s, p, &again, 0) <= bound;
  stress_path_free(&again);
  return same;
}

/* The orbit found in another way beside the one that is known, which is `shift` samples ahead. */
static stress_check hold(solved_scene *s, const stress_path *other, int shift, double least)
{
  if (other->status != HC_OK) return stress_refuse(s, other->status);
  return stress_agree_within(paths_apart(s, &s->path, other, shift), least, sensitive(&s->path, other));
}

static stress_check hold_found(solved_scene *s, const search *at, const double *from, int shift, double least)
{
  stress_path other = find_path(s, at, from);
  stress_check c = hold(s, &other, shift, least);
  if (c.outcome == STRESS_FINDING) {
    const double follows = follows_sliders(s, other.state + 2 * at->m->n, at->length);
    if (c.error <= follows + c.bound) c = stress_explain(STRESS_FAMILY, c.error, follows + c.bound);
  }
  stress_path_free(&other);
  return c;
}

/* From beside the known orbit; another orbit may be as near. */
static stress_check hold_beside(solved_scene *s, const search *at, const double *from, int shift)
{
  stress_path other = find_path(s, at, from);
  stress_check c = hold(s, &other, shift, same_again(s));
  if (c.outcome == STRESS_FINDING && is_orbit(s, at->m, &other, TRANSIENT_METHOD_CVODE))
    c = stress_explain(STRESS_OTHER_ORBIT, c.error, c.bound);
  stress_path_free(&other);
  return c;
}

/* The base model written in another way, which is cleared, from the known orbit's start as it says that. */
static stress_check hold_rewritten(solved_scene *s, hc_status made, rewritten *w)
{
  const int n = s->n;
  stress_check c = stress_skip(STRESS_NO_REASON);
  search at = {w->model, path_settings(w->model), PATH_ORBIT, s->omega / w->time, w->length};
  double *from = made == HC_OK ? malloc(state_length(w->model) * sizeof *from) : NULL;
  if (from) {
    rewritten_motion(w, n, s->path.state, from);
    rewritten_motion(w, n, s->path.state + n, from + n);
    for (int j = 0; j < w->model->n_contacts; ++j) from[2 * n + j] = s->path.state[2 * n + j];
    for (size_t i = 0; i < state_length(w->model); ++i) from[i] *= (int)i / n == 1 ? w->length / w->time : w->length;
    c = hold_found(s, &at, from, 0, same_again(s));
  } else s->fatal = HC_NO_MEMORY;
  rewritten_clear(w);
  free(from);
  return c;
}

/* From the HBM solution of the later loads next to the orbit's own harmonics, later; where that is not next to the
 * orbit the start says nothing. Where a slider that never slips rests hangs on time 0. */
static stress_check delayed(solved_scene *s)
{
  const int shift = random_int(&s->random, 1, TIMEINT_WAVE - 1);
  stress_motion h = {.status = HC_NOT_CONVERGED};
  stress_check c = stress_skip(STRESS_NO_ORBIT);
  rewritten w;
  s->fatal = rewritten_delayed(s->model, TWO_PI * shift / TIMEINT_WAVE, &w);
  if (s->fatal == HC_OK) motion_beside(s, w.model, &s->path, shift, &h);
  if (h.status == HC_OK) {
    search at = next_to(s);
    at.m = w.model;
    c = hold_beside(s, &at, h.start, TIMEINT_WAVE - shift);
  }
  if (c.outcome == STRESS_REFUSED || !(motion_off(s, &s->fine, &s->path) <= nearby)) c = stress_skip(STRESS_NO_ORBIT);
  stress_motion_free(&h);
  rewritten_clear(&w);
  return c;
}

stress_check stress_check_rewritten(solved_scene *s)
{
  rewritten w;
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  hc_status made = rewritten_permuted(s->model, &s->random, &w);
  stress_check c = hold_rewritten(s, made, &w);
  made = rewritten_rotated(s->model, &s->random, &w);
  c = stress_worse(c, hold_rewritten(s, made, &w));
  made = rewritten_in_units(s->model, 39.3701, 0.224809, 1.0 / 60, &w);
  c = stress_worse(c, hold_rewritten(s, made, &w));
  return s->path.r.free_sliders == 0 ? stress_worse(c, delayed(s)) : c;
}

/* Where the motion goes from next to a stable orbit: back to it. Sliders that never slip would rest elsewhere. */
stress_check stress_check_returns(solved_scene *s)
{
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  if (!(s->path.r.multiplier < 1 - 1e-3) || s->path.r.free_sliders > 0) return stress_skip(STRESS_NOT_APPLICABLE);
  search at = next_to(s);
  at.way = PATH_STEADY;
  double *from = malloc(state_length(s->model) * sizeof *from);
  if (!from) return stress_refuse(s, HC_NO_MEMORY);
  memcpy(from, s->path.state, state_length(s->model) * sizeof *from);
  for (int i = 0; i < 2 * s->n; ++i)
    from[i] += beside * s->path.amplitude * (i < s->n ? 1 : s->omega) * random_signed(&s->random);
  const stress_check c = hold_beside(s, &at, from, 0);
  free(from);
  return c;
}

/* CVODE without the closed form's matrix, for some scenes. */
static bool is_alone(solved_scene *s) { return random_int(&s->random, 1, ALONE_EVERY) == 1; }

/* Where the motion goes from rest. What does not settle soon says nothing (chance decides when), nor does a slider that
 * comes to rest for good: all periods before decide where. */
stress_check stress_check_from_rest(solved_scene *s)
{
  search at = next_to(s);
  at.way = PATH_STEADY;
  if (!is_alone(s) || model_is_smooth(s->model)) return stress_skip(STRESS_NOT_APPLICABLE);
  stress_path closed = find_path(s, &at, NULL), cvode = {.status = HC_NOT_CONVERGED};
  stress_check c = stress_skip(STRESS_NO_ORBIT);
  at.how.method = TRANSIENT_METHOD_CVODE;
  at.how.tolerance = 1e-9;
  if (closed.status == HC_OK && closed.r.free_sliders > 0) c = stress_skip(STRESS_NOT_APPLICABLE);
  else if (closed.status == HC_OK) cvode = find_path(s, &at, NULL);
  if (closed.status == HC_INTERRUPTED || cvode.status == HC_INTERRUPTED) c = stress_refuse(s, HC_INTERRUPTED);
  if (cvode.status == HC_OK) {
    c = stress_agree_within(paths_apart(s, &closed, &cvode, 0), by_cvode(&closed), sensitive(&closed, &cvode));
    if (c.outcome == STRESS_FINDING && is_orbit(s, s->model, &closed, TRANSIENT_METHOD_CVODE) &&
        is_orbit(s, s->model, &cvode, TRANSIENT_METHOD_CLOSED_FORM))
      c = stress_explain(STRESS_OTHER_ORBIT, c.error, c.bound);
  }
  stress_path_free(&closed);
  stress_path_free(&cvode);
  return c;
}

/* CVODE from event to event closes the orbit; for some scenes by itself, without the closed form's matrix. */
stress_check stress_check_cvode(solved_scene *s)
{
  search at = next_to(s);
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  if (model_is_smooth(s->model)) return stress_skip(STRESS_NOT_APPLICABLE);
  at.how.method = TRANSIENT_METHOD_CVODE;
  at.how.tolerance = 1e-9;
  at.how.scout = !is_alone(s);
  at.way = at.how.scout ? PATH_AGAIN : PATH_ORBIT;
  return hold_found(s, &at, s->path.state, 0, by_cvode(&s->path));
}

/* A slider that never slips may rest elsewhere by another law: how far is `other` from the member of the family, by the
 * exact law, that begins where it does? NaN: there is none. */
static double off_member(solved_scene *s, const stress_path *other)
{
  const search at = next_to(s);
  if (s->path.r.free_sliders == 0 || other->status != HC_OK) return NAN;
  stress_path member = find_path(s, &at, other->state);
  const double off = member.status == HC_OK ? paths_apart(s, &member, other, 0) : NAN;
  stress_path_free(&member);
  return off;
}

/* With a tenth of the regularisation an error of first or second order falls to a quarter or less. */
stress_check stress_check_regularised(solved_scene *s)
{
  search at = next_to(s);
  transient_settings *how = &at.how;
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  at.way = PATH_AGAIN;
  how->method = TRANSIENT_METHOD_CVODE;
  how->law = TRANSIENT_LAW_REGULARISED;
  how->tolerance = 1e-8;
  how->scout = true;
  stress_check c = stress_skip(STRESS_NO_ORBIT);
  double before = -1;
  int solved = 0;
  for (how->regularisation = 1e-4; how->regularisation >= 0.9e-7; how->regularisation /= 10) {
    stress_path other = find_path(s, &at, s->path.state);
    c = hold(s, &other, 0, same_law);
    const double off = c.outcome == STRESS_FINDING ? off_member(s, &other) : NAN;
    stress_path_free(&other);
    if (c.outcome == STRESS_REFUSED && solved >= 2) { /* it did not shrink, so far */
      c = stress_find(STRESS_DISAGREES, before, same_law);
      continue;
    }
    if (c.outcome != STRESS_FINDING || isnan(c.error)) return c;
    if (off <= same_law) return stress_explain(STRESS_FAMILY, c.error, off);
    c.error = fmin(c.error, off);
    ++solved;
    if (c.error <= before / 4) return stress_explain(STRESS_SMOOTHED, c.error, before / 4);
    before = c.error;
  }
  return c;
}

/* Is it proven, and does what is proven hold what was measured? Both bounds by how far it is outside, over the largest
 * amplitude; a multiplier on the wrong side of the circle is far outside. */
static stress_check hold_proven(solved_scene *s, const timeint_result *r, const json_t *answer)
{
  const char *said = json_string_value(json_object_get(answer, "verdict"));
  const double low = certificate_bound(answer, "amplitude", 0, -1), high = certificate_bound(answer, "amplitude", 1, 1),
               least = certificate_bound(answer, "multiplier", 0, -1),
               most = certificate_bound(answer, "multiplier", 1, 1);
  if (!said || strcmp(said, "accepted") != 0) return stress_skip(STRESS_NOT_APPLICABLE);
  const int side = timeint_stability(r);
  if ((most < 1 && side < 0) || (least > 1 && side > 0)) {
    const double error = fabs(r->multiplier - (side < 0 ? most : least));
    stress_condition(s);
    return stress_agree_within(error, 0, s->multiplier_errs);
  }
  const double off = r->amplitude < low ? low - r->amplitude : r->amplitude > high ? r->amplitude - high : 0;
  return stress_agree_within(off / s->path.amplitude, same_in_closed_form, sensitive(&s->path, NULL));
}

stress_check stress_check_proof(solved_scene *s)
{
  const transient_settings how = path_settings(s->model);
  proof_checker *checker = NULL;
  certificate_model m = {0};
  orbit_events e = {0};
  timeint *ti = NULL;
  timeint_result r;
  json_t *candidate = NULL, *answer = NULL;
  if (!known(s) || model_has_circle(s->model) || model_is_smooth(s->model)) return stress_skip(STRESS_NOT_APPLICABLE);
  hc_status st = proof_checker_new(&checker);
  if (st == HC_OK) st = certificate_model_make(s->asked, s->model, 0, &m);
  if (st == HC_OK) st = timeint_new(s->model, &how, &ti);
  if (st == HC_OK) st = timeint_again(ti, s->omega, 1, s->path.state, &s->monitor, &r);
  if (st == HC_OK) st = timeint_events(ti, 1, &e);
  if (st == HC_OK) candidate = certificate_of(&m, s->omega, 1, s->path.amplitude, &e);
  if (candidate) st = proof_checker_ask(checker, candidate, &answer);
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) s->fatal = st;
  const stress_check c =
      answer ? hold_proven(s, &r, answer) : stress_skip(checker ? STRESS_NO_ORBIT : STRESS_NO_CHECKER);
  json_decref(candidate);
  json_decref(answer);
  orbit_events_free(&e);
  timeint_free(ti);
  certificate_model_free(&m);
  proof_checker_free(checker);
  return c;
}
