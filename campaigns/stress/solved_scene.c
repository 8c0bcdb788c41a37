/* solved_scene.c - see solved_scene.h. */
#include "campaigns/stress/solved_scene.h"

#include <math.h>
#include <string.h>

#include "base/thread_clock.h"
#include "campaigns/scene_solvers.h"
#include "compare/comparison.h"
#include "hbm/first_solution.h"

static bool go_on(void *self, double done)
{
  solved_scene *s = self;
  if (!hc_monitor_tick(s->outer, done)) s->fatal = HC_INTERRUPTED;
  return s->fatal == HC_OK && thread_seconds() < s->deadline;
}

void stress_clock(solved_scene *s) { s->deadline = thread_seconds() + s->seconds; }

void solved_scene_start(solved_scene *s, const scene *sc, double seconds, const hc_monitor *outer)
{
  memset(s, 0, sizeof *s);
  s->asked = sc;
  s->exact = *sc;
  s->exact.hbm.force = HBM_FORCE_EXACT;
  s->exact.transient.law = TRANSIENT_LAW_EXACT;
  s->sc = &s->exact;
  s->omega = sc->compare.omega.v[0];
  s->seconds = seconds;
  s->outer = outer;
  s->monitor = (hc_monitor){go_on, s};
  stress_clock(s);
  stress_solve(s, s->sc, s->omega, 0, NULL, &s->base);
  s->fine = s->base;
  s->orbit.status = HC_NOT_CONVERGED; /* none yet */
  s->predicted = stress_skip(STRESS_NO_ORBIT);
}

static void note_fatal(solved_scene *s, hc_status st)
{
  if (st == HC_NO_MEMORY) s->fatal = st;
}

void stress_solve(solved_scene *s, const scene *sc, double omega, int n_guess, const double *guess,
                  stress_solution *out)
{
  hbm_solver *hbm = NULL;
  hbm_point point;
  memset(out, 0, sizeof *out);
  out->status = scene_hbm_solver(sc, &hbm);
  if (out->status == HC_OK) {
    out->n_harm = hbm_n_harmonics(hbm);
    int n = n_guess < out->n_harm ? n_guess : out->n_harm;
    if (guess) memcpy(out->X, guess, (size_t)(2 * n + 1) * sizeof *guess);
    out->status =
        guess ? hbm_solve(hbm, omega, out->X, &point) : hbm_first_solution(hbm, omega, &s->monitor, out->X, &point);
    if (out->status == HC_OK) out->status = hbm_measure(hbm, out->X, &out->m);
    if (out->status == HC_OK) out->status = comparison_orbit_start(hbm, out->X, omega, out->start.all);
    if (out->status == HC_OK) out->stability_status = hbm_stability_at(hbm, omega, out->X, &out->stability);
  }
  hbm_solver_free(hbm);
  note_fatal(s, out->status);
}

void stress_shoot(solved_scene *s, const scene *sc, double omega, stress_orbit *out)
{
  timeint *ti = NULL;
  out->status = scene_timeint(sc, &ti);
  if (out->status == HC_OK) out->status = timeint_orbit(ti, omega, 1, out->state.all, &s->monitor, &out->r);
  timeint_free(ti);
  note_fatal(s, out->status);
}

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

stress_check stress_refuse(solved_scene *s, hc_status st)
{
  stress_check c = {STRESS_REFUSED, STRESS_REFUSED_BY, st, NAN, NAN, 0};
  note_fatal(s, st);
  if (st == HC_INTERRUPTED) c.outcome = STRESS_EXPLAINED, c.reason = STRESS_TOO_DEAR;
  /* none of these is an answer to a scene whose every field is within its range */
  if (st == HC_OK || st == HC_BUG || st == HC_BAD_INPUT || st == HC_UNSUPPORTED || st == HC_IO)
    c.outcome = STRESS_FINDING, c.reason = STRESS_INTERNAL;
  return c;
}

double stress_distance(int n_coef, const double *X, const double *Y)
{
  double apart = 0, size = 0;
  for (int i = 0; i < n_coef; ++i) {
    apart = hypot(apart, X[i] - Y[i]);
    size = hypot(size, Y[i]);
  }
  return apart == 0 ? 0 : apart / size;
}

/* ---- names ---- */

#define NAME(code, name, meaning) name,
static const char *const kinds[] = {STRESS_CHECKS(NAME)}, *const reasons[] = {STRESS_REASONS(NAME)};
#undef NAME
#define NAME(code, name) name,
static const char *const outcomes[] = {STRESS_OUTCOMES(NAME)};
#undef NAME
#define MEANING(code, name, meaning) meaning,
static const char *const kind_meanings[] = {STRESS_CHECKS(MEANING)}, *const reason_meanings[] = {
                                                                         STRESS_REASONS(MEANING)};
#undef MEANING

const char *stress_kind_name(stress_kind kind) { return kinds[kind]; }
const char *stress_kind_meaning(stress_kind kind) { return kind_meanings[kind]; }
const char *stress_reason_name(stress_reason reason) { return reasons[reason]; }
const char *stress_reason_meaning(stress_reason reason) { return reason_meanings[reason]; }
const char *stress_outcome_name(stress_outcome outcome) { return outcomes[outcome]; }

/* ---- all checks ---- */

hc_status stress_scene(const scene *sc, double seconds, const hc_monitor *monitor, stress_result *out)
{
  static stress_check (*const checks[STRESS_N_CHECKS])(solved_scene *) = {
      stress_check_force,    stress_check_shift,     stress_check_reflection,  stress_check_free,
      stress_check_stuck,    stress_check_units,     stress_check_energy,      stress_check_sampled,
      stress_check_shooting, stress_check_stability, stress_check_regularised, stress_check_closed,
      stress_check_verdict,  stress_check_predicted};
  solved_scene s;
  double start = thread_seconds();
  solved_scene_start(&s, sc, seconds, monitor);
  for (int k = 0; k < STRESS_N_CHECKS && s.fatal == HC_OK; ++k) {
    stress_clock(&s);
    double began = thread_seconds();
    out->check[k] = checks[k](&s);
    out->check[k].seconds = thread_seconds() - began;
  }
  out->seconds = thread_seconds() - start;
  out->there = s.fatal == HC_OK;
  return s.fatal;
}
