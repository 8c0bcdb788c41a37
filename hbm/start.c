/* start.c - the first point: the linear response as guess, then a ramp of the forcing, then a ramp of the contact. A
 * ramp follows the solution from an easy system to the model's (phi or lambda of system.h from 0 to 1), step halved
 * on failure. */
#include "hbm/start.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "model/linear.h"

#include "hbm/solver.h"
#include "numerics/series.h"

static double static_stiffness(const model *m)
{
  double k = m->stiffness;
  for (int j = 0; j < m->n_contacts; ++j)
    if (m->contacts[j].law.gap > 0) k += model_stuck_stiffness(&m->contacts[j]);
  return k;
}

double hbm_linear_response(const model *m, double omega, int n_harm, double *X)
{
  double k = static_stiffness(m);
  memset(X, 0, (size_t)series_length(n_harm) * sizeof(double));
  double complex x = linear_response(m->mass, m->damping, k, m->force, omega);
  /* undamped, at resonance: any size of the right order */
  if (!isfinite(cabs(x))) x = m->force / (k + m->mass * omega * omega);
  X[1] = creal(x);
  X[2] = -cimag(x); /* Re(z exp(i th)) = Re z cos - Im z sin */
  return cabs(x);
}

bool hbm_linear_point(hbm_solver *s, double omega, double near, double *X, double *dX, hbm_point *point)
{
  const model *m = s->sys.model;
  double *linear = s->anchor, *R = s->z, k = static_stiffness(m), far = 0, worst = 0;
  double size = hbm_linear_response(m, omega, s->sys.n_harm, linear);
  for (int i = 0; i < s->sys.n_coef; ++i) far += (X[i] - linear[i]) * (X[i] - linear[i]);
  if (!(k > 0 && size > 0 && sqrt(far) <= near * size)) return false;
  if (hbm_system_residual(&s->sys, omega, linear, R) != HC_OK || s->sys.report.regime > CONTACT_STUCK) return false;
  for (int i = 0; i < s->sys.n; ++i) worst = fmax(worst, fabs(R[i]));
  worst /= hbm_system_scale(&s->sys, omega);
  if (!(worst <= s->sys.how.tolerance)) return false;
  memcpy(X, linear, (size_t)s->sys.n_coef * sizeof(double));
  memset(dX, 0, (size_t)s->sys.n_coef * sizeof(double));
  double complex z = k - m->mass * omega * omega + I * m->damping * omega;
  double complex by_omega = -m->force * (-2 * m->mass * omega + I * m->damping) / (z * z);
  dX[1] = creal(by_omega);
  dX[2] = -cimag(by_omega);
  *point = (hbm_point){.omega = omega, .residual = worst, .harmonics = s->sys.n_harm, .error = NAN};
  return true;
}

/* A ramp that gets there takes 10 to 60 solves; one that creeps towards a fold of its own never does. */
enum { RAMP_MOST_SOLVES = 200 };

/* Follow *factor from 0 to 1 at fixed omega from the solution at 0; *factor is 1 again afterwards. */
static hc_status ramp(hbm_solver *s, double *factor, double omega, double x_scale, const hc_monitor *monitor, double *X,
                      hbm_point *point)
{
  double here = 0, step = 0.1;
  hc_status st = HC_OK;
  int iterations = 0;
  for (int solves = 0; here < 1 && step > 1e-4 && solves < RAMP_MOST_SOLVES; ++solves) {
    if (!hc_monitor_tick(monitor, -1)) {
      st = HC_INTERRUPTED;
      break;
    }
    *factor = fmin(1, here + step);
    s->sys.evaluated = false;
    st = hbm_solve_fixed(s, omega, fmax(x_scale, hbm_norm(s->sys.n_coef, X)), X, point);
    iterations += point->iterations;
    if (st == HC_OK) {
      here = *factor;
      step *= 1.5;
    } else step *= 0.5;
  }
  *factor = 1;
  s->sys.evaluated = false;
  point->iterations = iterations;
  return here == 1 ? HC_OK : st;
}

hc_status hbm_solve_start(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
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

hc_status hbm_solve_first(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  return hbm_solve_start(s, omega, NULL, X, point);
}

hc_status hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  double size = hbm_norm(s->sys.n_coef, X);
  if (size != 0) return hbm_solve_fixed(s, omega, size, X, point);
  hc_status st = hbm_solve_first(s, omega, X, point); /* nothing says how large an answer to expect */
  if (st != HC_OK) memset(X, 0, (size_t)s->sys.n_coef * sizeof(double));
  return st;
}
