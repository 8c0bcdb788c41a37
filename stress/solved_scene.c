/* solved_scene.c - see solved_scene.h. */
#include "stress/solved_scene.h"

#include <math.h>
#include <string.h>

#include "base/thread_clock.h"
#include "compare/comparison.h"
#include "hbm/first_solution.h"
#include "stress/solved_structure.h"
#include "study/scene_solvers.h"

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

stress_check stress_refuse(solved_scene *s, hc_status st)
{
  note_fatal(s, st);
  return stress_refusal(st);
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

/* ---- all checks ---- */

static hc_status stress_oscillator(const scene *sc, double seconds, const hc_monitor *monitor, stress_result *out)
{
  static stress_check (*const checks[STRESS_N_OSCILLATOR_CHECKS])(solved_scene *) = {
      stress_check_force,    stress_check_shift,     stress_check_reflection,  stress_check_free,
      stress_check_stuck,    stress_check_units,     stress_check_energy,      stress_check_sampled,
      stress_check_shooting, stress_check_stability, stress_check_regularised, stress_check_closed,
      stress_check_verdict,  stress_check_predicted};
  solved_scene s;
  double start = thread_seconds();
  solved_scene_start(&s, sc, seconds, monitor);
  for (int k = 0; k < STRESS_N_OSCILLATOR_CHECKS && s.fatal == HC_OK; ++k) {
    stress_clock(&s);
    double began = thread_seconds();
    out->check[k] = checks[k](&s);
    out->check[k].seconds = thread_seconds() - began;
  }
  out->seconds = thread_seconds() - start;
  out->there = s.fatal == HC_OK;
  return s.fatal;
}

hc_status stress_scene(const scene *sc, double seconds, const hc_monitor *monitor, stress_result *out)
{
  for (int k = 0; k < STRESS_N_CHECKS; ++k) out->check[k] = stress_skip(STRESS_NOT_APPLICABLE);
  return sc->structure ? stress_structure(sc, seconds, monitor, out) : stress_oscillator(sc, seconds, monitor, out);
}
