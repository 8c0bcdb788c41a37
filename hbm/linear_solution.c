/* linear_solution.c - see linear_solution.h. */
#include "hbm/linear_solution.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "hbm/hbm_solver_impl.h"
#include "model/linear.h"
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
  /* infinite at an undamped resonance: only the order of magnitude matters for a guess */
  if (!isfinite(cabs(x))) x = m->force / (k + m->mass * omega * omega);
  X[1] = creal(x);
  X[2] = -cimag(x); /* Re(z exp(i th)) = Re z cos - Im z sin */
  return cabs(x);
}

bool hbm_linear_point(hbm_solver *s, double omega, double near, double *X, double *dX, hbm_point *point)
{
  const model *m = s->sys.model;
  double *linear = s->anchor, *R = s->z, k = static_stiffness(m), distance = 0, residual = 0;
  double size = hbm_linear_response(m, omega, s->sys.n_harm, linear);
  for (int i = 0; i < s->sys.n_coef; ++i) distance += (X[i] - linear[i]) * (X[i] - linear[i]);
  bool is_near = sqrt(distance) <= near * size;
  if (!(k > 0 && size > 0 && is_near)) return false;
  if (hbm_system_residual(&s->sys, omega, linear, R) != HC_OK) return false;
  if (s->sys.report.regime > CONTACT_STUCK) return false;
  for (int i = 0; i < s->sys.n; ++i) residual = fmax(residual, fabs(R[i]));
  residual /= hbm_system_scale(&s->sys, omega);
  if (!(residual <= s->sys.how.tolerance)) return false;
  memcpy(X, linear, (size_t)s->sys.n_coef * sizeof(double));
  memset(dX, 0, (size_t)s->sys.n_coef * sizeof(double));
  double complex z = k - m->mass * omega * omega + I * m->damping * omega;
  double complex by_omega = -m->force * (-2 * m->mass * omega + I * m->damping) / (z * z);
  dX[1] = creal(by_omega);
  dX[2] = -cimag(by_omega);
  *point = (hbm_point){.omega = omega, .residual = residual, .harmonics = s->sys.n_harm, .error = NAN};
  return true;
}
