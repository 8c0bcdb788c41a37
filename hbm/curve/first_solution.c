/* first_solution.c - see first_solution.h. The linear response is the first guess; where Newton fails from there, the
 * guess of whoever the solver was given to ask; where that is none, the solution is followed along a ramp
 * (ramp.h) to the model's equations, first of the damping, then of the force, as a response curve is followed
 * along omega: by steps of arc length, through turning points and round corners. The end of a ramp is solved once
 * more with the equations as they are. Sampled equations are first asked for the solution next to that with exact
 * forces, found in the same way. */
#include "hbm/curve/first_solution.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/curve/continuation.h"
#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "hbm/solver/linear_solution.h"
#include "numerics/norm.h"

/* The monitor of a ramp: one tick a step. */
typedef struct ramp_watch {
  const hc_monitor *outer;
  int left;     /* steps */
  bool stopped; /* on request */
} ramp_watch;

static bool watch_step(void *self, double done)
{
  ramp_watch *w = self;
  (void)done; /* of the ramp, not of the work */
  w->stopped = !hc_monitor_tick(w->outer, -1);
  return !w->stopped && w->left-- > 0;
}

/* The curve along the ramp. Equations stay as fine as they are, and nothing that is true of omega alone is used. */
static hc_status trace_ramp(hbm_solver *s, const hbm_ramp *ramp, const hc_monitor *monitor, hbm_curve *curve)
{
  const hbm_settings how = s->how;
  const double step_scale = s->step_scale;
  refinement *const harmonics = s->finer_harmonics, *const samples = s->finer_samples;
  s->how.harmonics = s->sys.n_harm;
  s->how.skip_linear = false;
  s->how.continuation = HBM_CONTINUATION_AUTO;
  s->finer_harmonics = s->finer_samples = NULL;
  s->step_scale = 1;
  s->ramp = ramp;
  hc_status st = hbm_trace(s, ramp->from, 1, monitor, curve);
  s->ramp = NULL;
  hbm_ramp_leave(&s->sys);
  s->step_scale = step_scale;
  s->finer_harmonics = harmonics;
  s->finer_samples = samples;
  s->how = how;
  return st == HC_OK && curve->left_at_start ? HC_NOT_CONVERGED : st;
}

static hc_status follow_ramp(hbm_solver *s, hbm_ramp_kind kind, double omega, const hc_monitor *monitor, double *X,
                             hbm_point *point)
{
  const hbm_ramp ramp = hbm_ramp_of(kind, &s->sys, omega);
  ramp_watch watch = {.outer = monitor, .left = ramp.most_steps};
  const hc_monitor step = {watch_step, &watch};
  hbm_curve curve = {0};
  hc_status st = trace_ramp(s, &ramp, &step, &curve);
  if (st == HC_INTERRUPTED && !watch.stopped) st = HC_NOT_CONVERGED;
  if (st == HC_OK) {
    memcpy(X, hbm_curve_X(&curve, curve.n - 1), (size_t)s->sys.n_coef * sizeof(double));
    st = hbm_solve_fixed(s, omega, norm_2(s->sys.n_coef, X), X, point);
    point->iterations += curve.iterations;
  }
  hbm_curve_free(&curve);
  return st;
}

/* Sampled equations from the solution with exact forces: a path along those has no false turning points, and costs as
 * little as the samples are many. */
static hc_status from_exact_forces(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  hbm_settings how = s->how;
  hbm_solver *exact;
  how.force = HBM_FORCE_EXACT;
  how.harmonics = s->sys.n_harm;
  hc_status st = hbm_solver_new(s->model, &how, &exact);
  if (st != HC_OK) return st;
  st = hbm_first_solution(exact, omega, monitor, X, point);
  const int iterations = point->iterations;
  if (st == HC_OK) st = hbm_solve_fixed(s, omega, norm_2(s->sys.n_coef, X), X, point);
  point->iterations += iterations;
  s->solves += exact->solves;
  hbm_solver_free(exact);
  return st;
}

static hc_status from_guess(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  double *x = malloc((size_t)s->model->n * (size_t)series_length(s->sys.n_harm) * sizeof *x);
  hc_status st = x ? s->guess.ask(s->guess.self, s->model, omega, s->sys.n_harm, monitor, x) : HC_NO_MEMORY;
  if (st == HC_OK) hbm_guess_of(s, x, X);
  free(x);
  if (st != HC_OK) return st;
  for (int i = 0; i < s->sys.first; ++i) X[i] = 0;
  return hbm_solve_fixed(s, omega, norm_2(s->sys.n_coef, X), X, point);
}

static bool goes_on(hc_status st) { return st != HC_OK && st != HC_INTERRUPTED && st != HC_NO_MEMORY; }

hc_status hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  double size = hbm_linear_response(&s->sys, omega, X);
  hc_status st = hbm_solve_fixed(s, omega, size, X, point);
  if (goes_on(st) && s->guess.ask) st = from_guess(s, omega, monitor, X, point);
  if (goes_on(st) && s->how.force == HBM_FORCE_SAMPLED) st = from_exact_forces(s, omega, monitor, X, point);
  if (goes_on(st)) st = follow_ramp(s, HBM_RAMP_DAMPING, omega, monitor, X, point);
  if (goes_on(st)) st = follow_ramp(s, HBM_RAMP_FORCE, omega, monitor, X, point);
  return st;
}

hc_status hbm_solve_first(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  return hbm_first_solution(s, omega, NULL, X, point);
}

hc_status hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  double size = norm_2(s->sys.n_coef, X);
  if (size != 0) return hbm_solve_fixed(s, omega, size, X, point);
  hc_status st = hbm_solve_first(s, omega, X, point); /* a zero guess gives no size to scale the unknowns with */
  if (st != HC_OK) memset(X, 0, (size_t)s->sys.n_coef * sizeof(double));
  return st;
}
