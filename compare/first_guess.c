/* first_guess.c - see first_guess.h. */
#include "compare/first_guess.h"

#include <stdlib.h>
#include <string.h>

#include "compare/motion.h"
#include "compare/work_limit.h"
#include "timeint/steady/steady.h"

enum { MOST_PERIODS = 200, MOST_DOF = 100 }; /* some milliseconds in closed form, some seconds */

/* Ticks of the monitor: one a period, and one in 4096 steps inside of it, which are many where slip turns at once. The
 * ramps are sooner at the end then. */
enum { MOST_TICKS = MOST_PERIODS + 100 };

typedef struct guide { /* made with the first question, freed with the solver */
  timeint *ti;
  double *state; /* [n_states] */
} guide;

/* Time integration that can report every DOF. */
static hc_status make(guide *g, const model *m, const transient_settings *how)
{
  model *seen;
  hc_status st = model_copy_all_seen(m, &seen);
  if (st != HC_OK) return st;
  st = timeint_new(seen, how, &g->ti);
  model_free(seen);
  if (st == HC_OK && !(g->state = calloc((size_t)timeint_n_states(g->ti), sizeof *g->state))) st = HC_NO_MEMORY;
  return st;
}

/* The harmonics of all DOFs of what was found last. */
static hc_status harmonics(guide *g, int n, int n_harm, timeint_result *r, double *x)
{
  double X[2 * HBM_MAX_HARMONICS + 1];
  hc_status st = HC_OK;
  for (int i = 0; i < n && st == HC_OK; ++i) {
    if (i > 0) st = timeint_response(g->ti, i, r);
    const periodic_motion motion = motion_of_transient(r);
    motion_harmonics(&motion, n_harm, X);
    for (int c = 0; c < 2 * n_harm + 1; ++c) x[c * n + i] = X[c];
  }
  return st;
}

/* Where the motion goes from rest, or, where that has more periods than one or none, the orbit of one next to it. */
static hc_status ask(void *self, const model *m, double omega, int n_harm, const hc_monitor *monitor, double *x)
{
  guide *g = self;
  timeint_result r;
  const transient_settings how = {.law = TRANSIENT_LAW_EXACT,
                                  .method = model_is_smooth(m) ? TRANSIENT_METHOD_CVODE : TRANSIENT_METHOD_CLOSED_FORM,
                                  .regularisation = 1,
                                  .steady = TRANSIENT_STEADY_AUTO,
                                  .start = TRANSIENT_START_REST,
                                  .tolerance = 1e-6,
                                  .max_periods = MOST_PERIODS};
  if (m->n > MOST_DOF) return HC_UNSUPPORTED;
  hc_status st = g->state ? HC_OK : make(g, m, &how);
  if (st != HC_OK) return st;
  work_limit limit = {.outer = monitor, .most = MOST_TICKS};
  const hc_monitor bounded = {work_limit_tick, &limit};
  timeint_rest(g->ti, g->state);
  st = timeint_steady(g->ti, omega, g->state, &bounded, &r);
  if (st == HC_NO_MEMORY || limit.stopped) return st;
  if (st != HC_OK || r.period_multiple != 1) st = timeint_orbit(g->ti, omega, 1, g->state, &bounded, &r);
  if (st == HC_INTERRUPTED && !limit.stopped) st = HC_NOT_SETTLED;
  return st == HC_OK ? harmonics(g, m->n, n_harm, &r, x) : st;
}

hc_status solution_of_motion(hbm_solver *s, const model *m, const transient_settings *how, double omega,
                             const double *state, const hc_monitor *monitor, double *X, hbm_point *point)
{
  guide g = {0};
  timeint_result r;
  if (m->n > MOST_DOF) return HC_UNSUPPORTED;
  const int n_harm = hbm_n_harmonics(s);
  double *x = calloc((size_t)(2 * n_harm + 1) * (size_t)m->n, sizeof *x);
  hc_status st = x ? make(&g, m, how) : HC_NO_MEMORY;
  if (st == HC_OK) memcpy(g.state, state, (size_t)timeint_n_states(g.ti) * sizeof *state);
  if (st == HC_OK) st = timeint_orbit(g.ti, omega, 1, g.state, monitor, &r);
  if (st == HC_OK) st = harmonics(&g, m->n, n_harm, &r, x);
  if (st == HC_OK) hbm_guess_of(s, x, X);
  if (st == HC_OK) st = hbm_solve(s, omega, X, point);
  timeint_free(g.ti);
  free(g.state);
  free(x);
  return st;
}

static void release(void *self)
{
  guide *g = self;
  timeint_free(g->ti);
  free(g->state);
  free(g);
}

hc_status guided_hbm_solver_new(const model *m, const hbm_settings *how, hbm_solver **out)
{
  hc_status st = hbm_solver_new(m, how, out);
  if (st != HC_OK) return st;
  guide *g = calloc(1, sizeof *g);
  if (!g) {
    hbm_solver_free(*out);
    *out = NULL;
    return HC_NO_MEMORY;
  }
  const hbm_guess guess = {.ask = ask, .free = release, .self = g};
  hbm_solver_take_guess(*out, &guess);
  /* cppcheck-suppress memleak; the solver frees it */
  return HC_OK;
}
