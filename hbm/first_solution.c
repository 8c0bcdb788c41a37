/* first_solution.c - see first_solution.h. The linear response is the first guess. Where Newton fails from there, a
 * ramp follows the solution from a system whose solution is known to the model's: phi of system.h from 0 to 1 (no
 * forcing, X = 0), then lambda (no contacts, linear response). Its step is halved where Newton fails. */
#include "hbm/first_solution.h"

#include <math.h>
#include <string.h>

#include "hbm/corrector.h"
#include "hbm/hbm_solver_impl.h"
#include "hbm/linear_solution.h"
#include "numerics/norm.h"

/* A ramp that arrives takes 10 to 60 solves; one that approaches a turning point of its own never arrives. */
enum { RAMP_MAX_SOLVES = 200 };

/* Follow *factor from 0 to 1 at fixed omega from the solution X at 0; *factor is 1 again afterwards. */
static hc_status ramp(hbm_solver *s, double *factor, double omega, double x_scale, const hc_monitor *monitor, double *X,
                      hbm_point *point)
{
  double reached = 0, step = 0.1;
  hc_status st = HC_OK;
  int iterations = 0;
  for (int solves = 0; reached < 1 && step > 1e-4 && solves < RAMP_MAX_SOLVES; ++solves) {
    if (!hc_monitor_tick(monitor, -1)) {
      st = HC_INTERRUPTED;
      break;
    }
    *factor = fmin(1, reached + step);
    s->sys.evaluated = false;
    st = hbm_solve_fixed(s, omega, fmax(x_scale, norm_2(s->sys.n_coef, X)), X, point);
    iterations += point->iterations;
    if (st == HC_OK) {
      reached = *factor;
      step *= 1.5;
    } else step *= 0.5;
  }
  *factor = 1;
  s->sys.evaluated = false;
  point->iterations = iterations;
  return reached == 1 ? HC_OK : st;
}

hc_status hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  const model *m = s->sys.model;
  int n_coef = s->sys.n_coef;
  double size = hbm_linear_response(m, omega, s->sys.n_harm, X);
  hc_status st = hbm_solve_fixed(s, omega, size, X, point);
  if (st == HC_OK) return HC_OK;
  memset(X, 0, (size_t)n_coef * sizeof(double));
  st = ramp(s, &s->sys.force_factor, omega, size / 100, monitor, X, point);
  if (st == HC_OK || st == HC_INTERRUPTED) return st;
  const model apart = {.mass = m->mass, .damping = m->damping, .stiffness = m->stiffness, .force = m->force};
  size = hbm_linear_response(&apart, omega, s->sys.n_harm, X);
  return ramp(s, &s->sys.contact_factor, omega, size, monitor, X, point);
}
