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

#include "base/constants.h"
#include "compare/motion.h"
#include "model/modes.h"
#include "numerics/random.h"
#include "numerics/series.h"
#include "stress/solved_scene.h"

/* ---- one orbit ---------------------------------------------------------------------------------------------- */

typedef enum path_way {
  PATH_ORBIT, /* timeint_orbit: next to the start, stable or not */
  PATH_AGAIN, /* timeint_again: the start is on it but for errors of integration */
  PATH_STEADY /* timeint_steady: where the motion goes from the start */
} path_way;

/* Bounds are relative to the largest response. Closed forms: rounding through (I - Phi)^-1 is counted besides. CVODE's
 * are those of docs/transient.md. */
static const double close_enough = 1e-6, same_orbit = 1e-3, same_in_closed_form = 1e-9, same_by_cvode = 1e-8;
static const double same_law = 1e-6, beside = 1e-5, nearby = 1e-4, tolerance = 1e-10;
enum { MOST_PERIODS = 400, MOST_HARMONICS = 160, MOST_UNKNOWNS = 1500 };
enum { ALONE_EVERY = 8 }; /* scenes for which CVODE finds the orbit by itself */

/* The exact law in closed form, from where the start says. */
static transient_settings path_settings(void)
{
  return (transient_settings){.law = TRANSIENT_LAW_EXACT,
                              .method = TRANSIENT_METHOD_CLOSED_FORM,
                              .regularisation = 1e-4,
                              .steady = TRANSIENT_STEADY_AUTO,
                              .start = TRANSIENT_START_REST,
                              .tolerance = tolerance,
                              .max_periods = MOST_PERIODS};
}

static size_t state_length(const model *m) { return 2 * (size_t)m->n + (size_t)m->n_contacts; }

/* Room for an orbit of m, its start from[2 n + contacts]. HC_NO_MEMORY goes to s->fatal; stress_path_free in any
 * case. */
static void path_make(solved_scene *s, const model *m, const double *from, stress_path *out)
{
  *out = (stress_path){.status = HC_NOT_CONVERGED};
  out->state = calloc(state_length(m), sizeof *out->state);
  out->wave = calloc((size_t)s->n * TIMEINT_WAVE, sizeof *out->wave);
  if (!out->state || !out->wave) s->fatal = out->status = HC_NO_MEMORY;
  else if (from) memcpy(out->state, from, state_length(m) * sizeof *out->state);
}

void stress_path_free(stress_path *p)
{
  free(p->state);
  free(p->wave);
  *p = (stress_path){.status = HC_NOT_CONVERGED};
}

static hc_status follow(solved_scene *s, timeint *ti, double omega, path_way way, stress_path *p)
{
  switch (way) {
  case PATH_ORBIT: return timeint_orbit(ti, omega, 1, p->state, &s->monitor, &p->r);
  case PATH_AGAIN: return timeint_again(ti, omega, 1, p->state, &s->monitor, &p->r);
  case PATH_STEADY: break;
  }
  hc_status st = timeint_steady(ti, omega, p->state, &s->monitor, &p->r);
  return st == HC_OK && p->r.period_multiple != 1 ? HC_NOT_SETTLED : st;
}

static hc_status read_waves(const solved_scene *s, timeint *ti, double length, stress_path *p)
{
  timeint_result one = p->r;
  p->amplitude = 0;
  for (int i = 0; i < s->n; ++i) {
    hc_status st = timeint_response(ti, 1 + i, &one);
    if (st != HC_OK) return st;
    p->amplitude = fmax(p->amplitude, one.amplitude / length);
    for (int k = 0; k < TIMEINT_WAVE; ++k) p->wave[i * TIMEINT_WAVE + k] = one.wave[k] / length;
  }
  p->errors = (p->r.closure + p->r.attainable) * (p->r.amplitude / length) / p->amplitude;
  return HC_OK;
}

/* From p->state to the orbit. m's responses 1 .. n are the base model's degrees of freedom, `length` of its units of
 * length are one of the base model's. p->status is that of the way; also HC_NOT_SETTLED where it is of several
 * periods. */
static void path_follow(solved_scene *s, const model *m, const transient_settings *how, double omega, path_way way,
                        double length, stress_path *p)
{
  timeint *ti = NULL;
  if (p->status == HC_NO_MEMORY) return;
  p->status = timeint_new(m, how, &ti);
  if (p->status == HC_OK) p->status = follow(s, ti, omega, way, p);
  if (p->status == HC_OK) p->status = read_waves(s, ti, length, p);
  timeint_free(ti);
  if (p->status == HC_NO_MEMORY) s->fatal = HC_NO_MEMORY;
}

/* Largest |a(t) - b(t)| of any degree of freedom, b later by `shift` samples, over a's largest amplitude. */
static double paths_apart(const solved_scene *s, const stress_path *a, const stress_path *b, int shift)
{
  double apart = 0;
  for (int i = 0; i < s->n; ++i)
    for (int k = 0; k < TIMEINT_WAVE; ++k) {
      const double *of = b->wave + i * TIMEINT_WAVE,
                   d = fabs(a->wave[i * TIMEINT_WAVE + k] - of[(k + shift) % TIMEINT_WAVE]);
      if (!(d <= apart)) apart = d;
    }
  return apart / a->amplitude;
}

void stress_path_of(solved_scene *s, const model *m, const double *from, stress_path *out)
{
  const transient_settings how = path_settings();
  path_make(s, m, from, out);
  if (s->fatal == HC_OK) path_follow(s, m, &how, s->omega, PATH_ORBIT, 1, out);
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
      if (!(fabs(sum) <= off)) off = fabs(sum);
    }
  return off / p->amplitude;
}

/* ---- the orbit ---------------------------------------------------------------------------------------- */

/* s with other harmonics: for stress_motion_solve and what reads its motions. */
static solved_scene with_harmonics(const solved_scene *s, int n_harm)
{
  solved_scene other = *s;
  other.how.harmonics = n_harm;
  other.n_coef = series_length(n_harm);
  return other;
}

/* HBM of m with n_harm harmonics from guess[n_coef][n]. */
static void solve_model_with(solved_scene *s, const model *m, int n_harm, int n_coef, const double *guess,
                             stress_motion *out)
{
  solved_scene other = with_harmonics(s, n_harm);
  const size_t most = (size_t)other.n_coef * (size_t)s->n, given = (size_t)n_coef * (size_t)s->n;
  double *padded = calloc(most, sizeof *padded);
  if (!padded) s->fatal = HC_NO_MEMORY;
  else memcpy(padded, guess, (given < most ? given : most) * sizeof *padded);
  stress_motion_solve(&other, m, &other.how, s->omega, padded, 1, out);
  if (other.fatal != HC_OK) s->fatal = other.fatal;
  free(padded);
}

static void solve_with(solved_scene *s, int n_harm, int n_coef, const double *guess, stress_motion *out)
{
  solve_model_with(s, s->model, n_harm, n_coef, guess, out);
}

/* The orbit next to that solution, into *path, and how far apart they are; NaN without one. */
static double shoot_from(solved_scene *s, const stress_motion *from, int n_harm, stress_path *path)
{
  *path = (stress_path){.status = HC_NOT_CONVERGED};
  if (from->status != HC_OK || from->start_status != HC_OK) return NAN;
  stress_path_of(s, s->model, from->start, path);
  return path->status == HC_OK ? stress_path_off(s, series_length(n_harm), from->x, path) : NAN;
}

/* A bound of the change by doubling the harmonics, of any degree of freedom, over the orbit's amplitude. */
static double moved(const solved_scene *s, const stress_motion *coarse, int n_coef, const stress_motion *fine,
                    int n_fine, double amplitude)
{
  double most = 0;
  for (int i = 0; i < s->n; ++i) {
    double sum = 0;
    for (int c = 0; c < n_fine; ++c) sum += fabs(fine->x[c * s->n + i] - (c < n_coef ? coarse->x[c * s->n + i] : 0));
    most = fmax(most, sum);
  }
  return most / amplitude;
}

/* HBM of m, a rewritten base model with its coordinates, with n_harm harmonics from those of the orbit, `shift` samples
 * later; *out has so many. stress_motion_free in any case. */
static void motion_beside(solved_scene *s, const model *m, const stress_path *path, int shift, int n_harm,
                          stress_motion *out)
{
  const int n_coef = series_length(n_harm);
  double *guess = calloc((size_t)n_coef * (size_t)s->n, sizeof *guess), *one = calloc((size_t)n_coef, sizeof *one);
  *out = (stress_motion){.status = HC_NO_MEMORY};
  if (!guess || !one) s->fatal = HC_NO_MEMORY;
  for (int i = 0; guess && one && i < s->n; ++i) {
    periodic_motion motion = {.amplitude = 1};
    for (int k = 0; k < TIMEINT_WAVE; ++k)
      motion.samples[k] = path->wave[i * TIMEINT_WAVE + (k + shift) % TIMEINT_WAVE];
    motion_harmonics(&motion, n_harm, one);
    for (int c = 0; c < n_coef; ++c) guess[c * s->n + i] = one[c];
  }
  if (s->fatal == HC_OK) solve_model_with(s, m, n_harm, n_coef, guess, out);
  free(guess);
  free(one);
}

/* Does HBM, from the orbit's own harmonics, end on that orbit? How far off. */
static double confirmed(solved_scene *s, const stress_path *path, int n_harm)
{
  stress_motion h;
  motion_beside(s, s->model, path, 0, n_harm, &h);
  const double off = h.status == HC_OK ? stress_path_off(s, series_length(n_harm), h.x, path) : NAN;
  stress_motion_free(&h);
  return off;
}

/* Is the highest frequency of the stuck structure above a tenth of the n-th harmonic's? After each transition it rings
 * at that frequency. */
static bool beyond_harmonics(solved_scene *s, int n_harm)
{
  model_scales scales;
  hc_status st = model_find_scales(s->model, &scales);
  if (st == HC_NO_MEMORY) s->fatal = st;
  return st == HC_OK && scales.highest > 0.1 * n_harm * s->omega;
}

/* What the errors of two orbits may set apart, or those of one. */
static double sensitive(const stress_path *a, const stress_path *b)
{
  const double errors = a->errors + (b ? b->errors : 0);
  return errors >= 0 ? 3 * errors : 0;
}

static double tolerance_of(const stress_path *p) { return fmax(close_enough, sensitive(p, NULL)); }

static bool may_double(const solved_scene *s, int n_harm)
{
  const int coordinates = 2 * s->model->n_contacts < s->n ? 2 * s->model->n_contacts : s->n;
  return 2 * n_harm <= MOST_HARMONICS && coordinates * series_length(2 * n_harm) <= MOST_UNKNOWNS;
}

/* s->fine and &s->path become those of twice the harmonics, if there are. *step: the change. */
static bool refine(solved_scene *s, double *error, double *step)
{
  stress_motion finer;
  stress_path path;
  const int n_harm = 2 * s->fine_harmonics;
  solve_with(s, n_harm, series_length(s->fine_harmonics), s->fine.x, &finer);
  const bool solved = finer.status == HC_OK;
  if (!solved) {
    stress_motion_free(&finer);
    return false;
  }
  *error = shoot_from(s, &finer, n_harm, &path);
  *step = moved(s, &s->fine, series_length(s->fine_harmonics), &finer, series_length(n_harm),
                path.status == HC_OK ? path.amplitude : finer.m.amplitude);
  stress_motion_free(&s->fine);
  stress_path_free(&s->path);
  s->fine = finer;
  s->path = path;
  s->fine_harmonics = n_harm;
  return true;
}

/* Beyond the bound with as many harmonics as may be. */
static stress_check explain(solved_scene *s, double before, double error, double step)
{
  if (s->path.status != HC_OK) return stress_refuse(s, s->path.status);
  if (error <= before / 2 || error <= 3 * step) return stress_explain(STRESS_TRUNCATED, error, 3 * step);
  if (beyond_harmonics(s, s->fine_harmonics)) return stress_explain(STRESS_UNRESOLVED, error, NAN);
  const double other = confirmed(s, &s->path, s->fine_harmonics);
  if (other <= fmin(error / 10, same_orbit)) return stress_explain(STRESS_OTHER_ORBIT, error, other);
  stress_condition(s);
  if (error <= s->solution_errs) return stress_explain(STRESS_ILL_CONDITIONED, error, s->solution_errs);
  return stress_find(STRESS_DISAGREES, error, tolerance_of(&s->path));
}

/* Without harmonic 0, means and static loads are left out. */
static bool other_equation(const solved_scene *s)
{
  if (s->how.keep_mean) return false;
  for (int l = 0; l < s->model->n_loads; ++l)
    if (s->model->loads[l].harmonic == 0) return true;
  return s->base.m.contact.regime != CONTACT_LINEAR;
}

/* Harmonics are doubled until HBM and the orbit next to it meet. */
stress_check stress_check_orbit(solved_scene *s)
{
  solve_with(s, s->how.harmonics, s->n_coef, s->base.x, &s->fine);
  s->fine_harmonics = s->how.harmonics;
  if (s->fine.status != HC_OK) return stress_refuse(s, s->fine.status);
  double error = shoot_from(s, &s->fine, s->fine_harmonics, &s->path), before = NAN, step = NAN;
  if (other_equation(s)) return stress_skip(STRESS_NOT_APPLICABLE);
  const double coarse = error;
  if (s->path.status == HC_OK && error <= tolerance_of(&s->path))
    return stress_agree_within(error, close_enough, sensitive(&s->path, NULL));
  while (s->fatal == HC_OK && may_double(s, s->fine_harmonics)) {
    before = error;
    if (!refine(s, &error, &step)) break;
    if (s->path.status == HC_INTERRUPTED) return stress_refuse(s, s->path.status);
    if (s->path.status == HC_OK && error <= tolerance_of(&s->path))
      return stress_explain(STRESS_TRUNCATED, coarse, NAN);
  }
  return explain(s, before, error, step);
}

/* ---- its multiplier ----------------------------------------------------------------------------------- */

static double multipliers_apart(const stress_motion *h, const stress_path *p)
{
  if (h->stability_status != HC_OK) return NAN;
  return fabs(h->stability.multiplier - p->r.multiplier) / fmax(1, p->r.multiplier);
}

/* HBM's multiplier with twice the harmonics, and twice, until it is the orbit's or there are no more; how far off it
 * then is. Contacts much stiffer than the structure close for so short a time that many harmonics move its ends. */
static double better_multiplier(solved_scene *s, double error, double bound)
{
  stress_motion h = {.status = HC_OK};
  const double *x = s->fine.x;
  for (int n = s->fine_harmonics, more; error > bound && n < HBM_MAX_HARMONICS; n = more) {
    stress_motion finer;
    if (n > s->fine_harmonics && !may_double(s, n)) break; /* beyond what `orbit` may take once, as it costs */
    more = 2 * n < HBM_MAX_HARMONICS ? 2 * n : HBM_MAX_HARMONICS;
    solve_with(s, more, series_length(n), x, &finer);
    const double now = finer.status == HC_OK ? multipliers_apart(&finer, &s->path) : NAN;
    stress_motion_free(&h);
    h = finer, x = h.x;
    if (isnan(now)) break;
    error = now;
  }
  stress_motion_free(&h);
  return error;
}

/* A multiplier jumps where a transition appears or disappears. */
stress_check stress_check_multiplier(solved_scene *s)
{
  const double bound = 1e-3;
  if (s->path.status != HC_OK || isnan(s->path.r.multiplier) || s->fine.stability_status != HC_OK)
    return stress_skip(STRESS_NO_ORBIT);
  const double far = stress_path_off(s, series_length(s->fine_harmonics), s->fine.x, &s->path);
  if (!(far <= same_orbit)) return stress_skip(STRESS_NO_ORBIT);
  const double error = multipliers_apart(&s->fine, &s->path);
  if (error <= bound) return stress_agree(error, bound);
  const double better = better_multiplier(s, error, bound);
  if (better <= fmax(bound, error / 2)) return stress_explain(STRESS_TRUNCATED, error, better);
  if (s->fine.m.contact.transitions != s->path.r.switches) return stress_explain(STRESS_OTHER_EVENTS, error, better);
  if (far > close_enough && beyond_harmonics(s, s->fine_harmonics))
    return stress_explain(STRESS_UNRESOLVED, error, better);
  stress_condition(s);
  if (error <= s->multiplier_errs) return stress_explain(STRESS_ILL_CONDITIONED, error, s->multiplier_errs);
  return stress_find(STRESS_DISAGREES, error, bound);
}

static const stress_path *known(const solved_scene *s) { return s->path.status == HC_OK ? &s->path : NULL; }

/* Does that method stay on that orbit, too? Then it is one. */
static bool is_orbit(solved_scene *s, const stress_path *p, transient_method method)
{
  transient_settings how = path_settings();
  how.method = method;
  how.tolerance = 1e-9;
  stress_path again;
  path_make(s, s->model, p->state, &again);
  if (s->fatal == HC_OK) path_follow(s, s->model, &how, s->omega, PATH_ORBIT, 1, &again);
  const double bound = fmax(same_by_cvode, sensitive(p, &again));
  const bool same = again.status == HC_OK && paths_apart(s, p, &again, 0) <= bound;
  stress_path_free(&again);
  return same;
}

/* The orbit found in another way beside the one that is known. */
static stress_check hold(solved_scene *s, const stress_path *other, int shift, double least)
{
  if (other->status != HC_OK) return stress_refuse(s, other->status);
  return stress_agree_within(paths_apart(s, &s->path, other, shift), least, sensitive(&s->path, other));
}

/* ---- written in another way --------------------------------------------------------------------------- */

/* Another orbit from its start, held against the known one, which is `shift` samples ahead; m as in path_follow, the
 * settings those of a closed form. Clears what it is given but the base model. */
static stress_check hold_again(solved_scene *s, model *m, double omega, double length, int shift, stress_path *other)
{
  const transient_settings how = path_settings();
  if (s->fatal == HC_OK) path_follow(s, m, &how, omega, PATH_ORBIT, length, other);
  model_free(m);
  const stress_check c = hold(s, other, shift, same_in_closed_form);
  stress_path_free(other);
  return c;
}

static stress_check turned(solved_scene *s, void (*draw)(uint64_t *, int, double *))
{
  stress_path other;
  model *m = NULL;
  double *Q = malloc((size_t)s->n * (size_t)s->n * sizeof *Q);
  path_make(s, s->model, s->path.state, &other);
  if (Q) draw(&s->random, s->n, Q);
  if (!Q || rewritten_turned(s->model, Q, &m) != HC_OK) s->fatal = HC_NO_MEMORY;
  for (int part = 0; part < 2 && s->fatal == HC_OK; ++part) /* positions, then velocities, in y, x = Q y */
    turned_vector(s->n, Q, s->path.state + part * s->n, other.state + part * s->n);
  free(Q);
  return hold_again(s, m, s->omega, 1, 0, &other);
}

static stress_check in_units(solved_scene *s, double length, double force, double time)
{
  const int n = s->n;
  stress_path other;
  model *m = NULL;
  path_make(s, s->model, s->path.state, &other);
  if (rewritten_in_units(s->model, length, force, time, &m) != HC_OK) s->fatal = HC_NO_MEMORY;
  for (int i = 0; s->fatal == HC_OK && i < 2 * n + m->n_contacts; ++i)
    other.state[i] *= i >= n && i < 2 * n ? length / time : length;
  return hold_again(s, m, s->omega / time, length, 0, &other);
}

/* From the HBM solution of the later loads next to the orbit's own harmonics, later; where that is not next to the
 * orbit the start says nothing. Where a slider that never slips rests hangs on time 0. */
static stress_check delayed(solved_scene *s)
{
  const int shift = random_int(&s->random, 1, TIMEINT_WAVE - 1);
  stress_path other;
  stress_motion h = {.status = HC_NOT_CONVERGED};
  model *m = NULL;
  if (rewritten_delayed(s->model, TWO_PI * shift / TIMEINT_WAVE, &m) != HC_OK) s->fatal = HC_NO_MEMORY;
  if (s->fatal == HC_OK) motion_beside(s, m, &s->path, shift, s->fine_harmonics, &h);
  path_make(s, s->model, h.start, &other);
  stress_check c = stress_skip(STRESS_NO_ORBIT);
  if (h.status == HC_OK) c = hold_again(s, m, s->omega, 1, TIMEINT_WAVE - shift, &other);
  else model_free(m), stress_path_free(&other);
  if (c.outcome == STRESS_REFUSED ||
      !(stress_path_off(s, series_length(s->fine_harmonics), s->fine.x, &s->path) <= nearby))
    c = stress_skip(STRESS_NO_ORBIT);
  stress_motion_free(&h);
  return c;
}

stress_check stress_check_rewritten(solved_scene *s)
{
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  stress_check c = turned(s, random_permutation);
  c = stress_worse(c, turned(s, random_rotation));
  c = stress_worse(c, in_units(s, 39.3701, 0.224809, 1.0 / 60));
  return s->path.r.free_sliders == 0 ? stress_worse(c, delayed(s)) : c;
}

/* ---- from beside it ----------------------------------------------------------------------------------- */

/* Where the motion goes from next to a stable orbit: back to it. Sliders that never slip would rest elsewhere. */
stress_check stress_check_returns(solved_scene *s)
{
  const transient_settings how = path_settings();
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  if (!(s->path.r.multiplier < 1 - 1e-3) || s->path.r.free_sliders > 0) return stress_skip(STRESS_NOT_APPLICABLE);
  stress_path other;
  path_make(s, s->model, s->path.state, &other);
  for (int i = 0; i < 2 * s->n && s->fatal == HC_OK; ++i)
    other.state[i] += beside * s->path.amplitude * (i < s->n ? 1 : s->omega) * random_signed(&s->random);
  if (s->fatal == HC_OK) path_follow(s, s->model, &how, s->omega, PATH_STEADY, 1, &other);
  stress_check c = hold(s, &other, 0, same_in_closed_form);
  if (c.outcome == STRESS_FINDING && is_orbit(s, &other, TRANSIENT_METHOD_CVODE))
    c = stress_explain(STRESS_OTHER_ORBIT, c.error, c.bound);
  stress_path_free(&other);
  return c;
}

/* CVODE without the closed form's matrix, for some scenes. */
static bool is_alone(solved_scene *s) { return random_int(&s->random, 1, ALONE_EVERY) == 1; }

/* Where the motion goes from rest. What has not settled by one of them says nothing: the longer it takes, the more
 * chance decides when. Nor does a slider that comes to rest for good: where it does is decided by all periods
 * before. */
stress_check stress_check_from_rest(solved_scene *s)
{
  transient_settings how = path_settings();
  stress_path closed, cvode;
  if (!is_alone(s)) return stress_skip(STRESS_NOT_APPLICABLE);
  path_make(s, s->model, NULL, &closed);
  path_make(s, s->model, NULL, &cvode);
  if (s->fatal == HC_OK) {
    memset(closed.state, 0, state_length(s->model) * sizeof *closed.state);
    memset(cvode.state, 0, state_length(s->model) * sizeof *cvode.state);
    path_follow(s, s->model, &how, s->omega, PATH_STEADY, 1, &closed);
    how.method = TRANSIENT_METHOD_CVODE;
    how.tolerance = 1e-9;
    if (closed.status == HC_OK && closed.r.free_sliders == 0)
      path_follow(s, s->model, &how, s->omega, PATH_STEADY, 1, &cvode);
  }
  stress_check c = stress_skip(STRESS_NO_ORBIT);
  if (closed.status == HC_OK && closed.r.free_sliders > 0) c = stress_skip(STRESS_NOT_APPLICABLE);
  else if (closed.status == HC_OK && cvode.status == HC_OK) {
    c = stress_agree_within(paths_apart(s, &closed, &cvode, 0), same_by_cvode, sensitive(&closed, &cvode));
    if (c.outcome == STRESS_FINDING && is_orbit(s, &closed, TRANSIENT_METHOD_CVODE) &&
        is_orbit(s, &cvode, TRANSIENT_METHOD_CLOSED_FORM))
      c = stress_explain(STRESS_OTHER_ORBIT, c.error, c.bound);
  } else if (closed.status == HC_INTERRUPTED || cvode.status == HC_INTERRUPTED) c = stress_refuse(s, HC_INTERRUPTED);
  stress_path_free(&closed);
  stress_path_free(&cvode);
  return c;
}

/* ---- by other integrators ----------------------------------------------------------------------------- */

/* The known orbit once more. */
static stress_check by(solved_scene *s, const transient_settings *how, path_way way, double least)
{
  stress_path other;
  path_make(s, s->model, s->path.state, &other);
  if (s->fatal == HC_OK) path_follow(s, s->model, how, s->omega, way, 1, &other);
  const stress_check c = hold(s, &other, 0, least);
  stress_path_free(&other);
  return c;
}

/* CVODE from event to event closes the orbit; for some scenes by itself, without the closed form's matrix. */
stress_check stress_check_cvode(solved_scene *s)
{
  transient_settings how = path_settings();
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  how.method = TRANSIENT_METHOD_CVODE;
  how.tolerance = 1e-9;
  how.scout = !is_alone(s);
  return by(s, &how, how.scout ? PATH_AGAIN : PATH_ORBIT, same_by_cvode);
}

/* Where a slider never slips beside other contacts, and with another law rests elsewhere, the orbit is another member
 * of the family. */
static stress_check unless_family(const solved_scene *s, stress_check c)
{
  const bool family = s->model->n_contacts > 1 && s->path.r.free_sliders > 0;
  return c.outcome == STRESS_FINDING && family ? stress_explain(STRESS_FAMILY, c.error, c.bound) : c;
}

/* The error is of first or second order: with a tenth of the regularisation the difference falls to a quarter or
 * less. */
stress_check stress_check_regularised(solved_scene *s)
{
  transient_settings how = path_settings();
  if (!known(s)) return stress_skip(STRESS_NO_ORBIT);
  how.method = TRANSIENT_METHOD_CVODE;
  how.law = TRANSIENT_LAW_REGULARISED;
  how.tolerance = 1e-8;
  how.scout = true;
  stress_check c = stress_skip(STRESS_NO_ORBIT);
  double before = -1;
  int solved = 0;
  for (how.regularisation = 1e-4; how.regularisation >= 0.9e-7; how.regularisation /= 10) {
    c = by(s, &how, PATH_AGAIN, same_law);
    if (isnan(c.error) && solved >= 2) /* it did not shrink */
      return unless_family(s, stress_find(STRESS_DISAGREES, before, same_law));
    if (c.outcome != STRESS_FINDING || isnan(c.error)) return c;
    ++solved;
    if (c.error <= before / 4) return stress_explain(STRESS_SMOOTHED, c.error, before / 4);
    before = c.error;
  }
  return unless_family(s, c);
}
