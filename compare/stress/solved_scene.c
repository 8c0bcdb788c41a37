/* solved_scene.c - see solved_scene.h. */
#include "compare/stress/solved_scene.h"

#include <string.h>

#include "compare/comparison.h"
#include "compare/first_guess.h"
#include "numerics/base/thread_clock.h"

/* Rounding is seen only if Newton does not stop before. */
static const double tight = 1e-12;

static bool go_on(void *self, double done)
{
  solved_scene *s = self;
  if (!hc_monitor_tick(s->outer, done)) s->fatal = HC_INTERRUPTED;
  return s->fatal == HC_OK && thread_seconds() < s->deadline;
}

void solved_scene_clock(solved_scene *s, int checks) { s->deadline = thread_seconds() + checks * s->seconds; }

hc_status solved_scene_start(solved_scene *s, const scene *sc, double seconds, const hc_monitor *outer)
{
  *s = (solved_scene){.how = sc->hbm, .omega = sc->compare.omega.v[0], .seconds = seconds, .outer = outer};
  s->how.force = HBM_FORCE_EXACT;
  s->how.tolerance = fmin(s->how.tolerance, tight);
  s->from = sc->omega_from, s->to = sc->omega_to;
  s->monitor = (hc_monitor){go_on, s};
  memcpy(&s->random, &s->omega, sizeof s->random); /* the same for the same scene, whatever its number */
  model *m;
  hc_status st = scene_model(sc, &m);
  if (st == HC_OK) st = rewritten_with_all_responses(m, &s->model);
  model_free(m);
  if (st != HC_OK) return st;
  s->n = s->model->n;
  s->n_coef = series_length(s->how.harmonics);
  s->asked = sc;
  s->fine.status = HC_NOT_CONVERGED; /* none yet */
  s->predicted = stress_skip(STRESS_NO_ORBIT);
  s->path.status = HC_NOT_CONVERGED;
  solved_scene_clock(s, STRESS_N_CHECKS); /* all start from it */
  stress_motion_solve(s, s->model, &s->how, s->omega, NULL, 1, &s->base);
  return s->fatal;
}

void stress_path_free(stress_path *p)
{
  free(p->state);
  free(p->wave);
  *p = (stress_path){.status = HC_NOT_CONVERGED};
}

void solved_scene_clear(solved_scene *s)
{
  model_free(s->model);
  stress_motion_free(&s->base);
  stress_motion_free(&s->fine);
  stress_path_free(&s->path);
  free(s->plain);
}

/* ---- one solution --------------------------------------------------------------------------------- */

void stress_motion_free(stress_motion *m)
{
  free(m->x);
  free(m->start);
  m->x = m->start = NULL;
}

hc_status stress_motion_read(const solved_scene *s, hbm_solver *h, double omega, const double *X, int n_coef, double *x)
{
  hc_status st = HC_OK;
  double *series = malloc((size_t)n_coef * sizeof *series);
  if (!series) return HC_NO_MEMORY;
  for (int i = 0; i < s->n && st == HC_OK; ++i) {
    st = hbm_response(h, omega, X, 1 + i, series);
    for (int c = 0; c < n_coef; ++c) x[c * s->n + i] = series[c];
  }
  free(series);
  return st;
}

void stress_motion_solve(solved_scene *s, const model *m, const hbm_settings *how, double omega, const double *guess,
                         double length, stress_motion *out)
{
  const size_t length_x = (size_t)s->n * (size_t)series_length(how->harmonics);
  *out = (stress_motion){.harmonics = how->harmonics,
                         .x = calloc(length_x, sizeof(double)),
                         .start = calloc(2 * (size_t)m->n + (size_t)m->n_contacts, sizeof(double))};
  hbm_solver *h = NULL;
  hbm_point point;
  hc_status st = out->x && out->start ? guided_hbm_solver_new(m, how, &h) : HC_NO_MEMORY;
  double *X = st == HC_OK ? calloc((size_t)hbm_n_coefficients(h), sizeof *X) : NULL;
  if (st == HC_OK && !X) st = HC_NO_MEMORY;
  if (st == HC_OK && guess) hbm_guess_of(h, guess, X);
  if (st == HC_OK) st = guess ? hbm_solve(h, omega, X, &point) : hbm_first_solution(h, omega, &s->monitor, X, &point);
  if (st == HC_OK) st = hbm_measure(h, X, &out->m);
  if (st == HC_OK) st = stress_motion_read(s, h, omega, X, series_length(out->harmonics), out->x);
  if (st == HC_OK) out->stability_status = hbm_stability_at(h, omega, X, &out->stability);
  if (st == HC_OK) out->start_status = comparison_orbit_start(h, X, omega, out->start);
  free(X);
  hbm_solver_free(h);
  out->status = st;
  for (size_t i = 0; out->x && i < length_x; ++i) out->x[i] /= length;
  if (st == HC_NO_MEMORY) s->fatal = HC_NO_MEMORY;
}

double stress_motion_distance(const solved_scene *s, const double *x, const double *y, bool means_out)
{
  double apart = 0, size = 0;
  for (int i = means_out ? s->n : 0; i < s->n * s->n_coef; ++i) {
    if (!isfinite(x[i]) || !isfinite(y[i])) return NAN;
    apart = fmax(apart, fabs(x[i] - y[i]));
    size = fmax(size, fabs(y[i]));
  }
  return apart == 0 ? 0 : apart / size;
}

double stress_multipliers_apart(const stress_motion *a, const stress_motion *b)
{
  const double x = a->stability.multiplier, y = b->stability.multiplier;
  if (a->stability_status != HC_OK || b->stability_status != HC_OK) return NAN;
  return fabs(x - y) / fmax(1, fabs(x));
}

/* ---- the words a check ends with ---- */

stress_check stress_skip(stress_reason why) { return (stress_check){STRESS_SKIPPED, why, HC_OK, NAN, NAN, 0}; }

stress_check stress_explain(stress_reason why, double error, double bound)
{
  return (stress_check){STRESS_EXPLAINED, why, HC_OK, error, bound, 0};
}

stress_check stress_find(stress_reason why, double error, double bound)
{
  return (stress_check){STRESS_FINDING, why, HC_OK, error, bound, 0};
}

stress_check stress_agree(double error, double bound)
{
  if (error <= bound) return (stress_check){STRESS_AGREED, STRESS_NO_REASON, HC_OK, error, bound, 0};
  return stress_find(isnan(error) ? STRESS_INTERNAL : STRESS_DISAGREES, error, bound);
}

stress_check stress_agree_within(double error, double least, double sensitive)
{
  if (error > least && error <= sensitive)
    return sensitive <= STRESS_SAYS_SOMETHING ? stress_explain(STRESS_ILL_CONDITIONED, error, sensitive)
                                              : stress_skip(STRESS_ILL_CONDITIONED);
  return stress_agree(error, fmax(least, sensitive));
}

stress_check stress_refuse(solved_scene *s, hc_status st)
{
  stress_check c = {STRESS_REFUSED, STRESS_REFUSED_BY, st, NAN, NAN, 0};
  if (st == HC_NO_MEMORY) s->fatal = st;
  if (st == HC_INTERRUPTED) c.outcome = STRESS_DEAR, c.reason = STRESS_TOO_DEAR;
  /* none of these is an answer to a scene whose every field is within its range */
  if (st == HC_OK || st == HC_BUG || st == HC_BAD_INPUT || st == HC_UNSUPPORTED || st == HC_IO)
    c.outcome = STRESS_FINDING, c.reason = STRESS_INTERNAL;
  return c;
}

stress_check stress_worse(stress_check a, stress_check b)
{
  return b.outcome > a.outcome || (b.outcome == a.outcome && b.error > a.error) ? b : a;
}

/* ---- names ---- */

#define NAME(code, name, ...)                name,
#define MEANING(code, name, meaning)         meaning,
#define NAME_OF(code, name)                  name,
#define MEANING_OF(code, name, fun, meaning) meaning,
static const char *const kinds[] = {STRESS_CHECKS(NAME)}, *const reasons[] = {STRESS_REASONS(NAME)};
static const char *const outcomes[] = {STRESS_OUTCOMES(NAME_OF)};
static const char *const kind_meanings[] = {STRESS_CHECKS(MEANING_OF)}, *const reason_meanings[] = {
                                                                            STRESS_REASONS(MEANING)};

const char *stress_kind_name(stress_kind kind) { return kinds[kind]; }
const char *stress_kind_meaning(stress_kind kind) { return kind_meanings[kind]; }
const char *stress_reason_name(stress_reason reason) { return reasons[reason]; }
const char *stress_reason_meaning(stress_reason reason) { return reason_meanings[reason]; }
const char *stress_outcome_name(stress_outcome outcome) { return outcomes[outcome]; }

const char *stress_family_option(stress_family family)
{
  static const char *const option[] = {"", " --structures", " --space"};
  return option[family];
}
