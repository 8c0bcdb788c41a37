/* start.c - the first point: the linear response as guess, then a ramp of the forcing, then a ramp of the contact.
 * A ramp follows the solution from an easy system to the scene's (phi or lambda of system.h from 0 to 1), step halved on failure. */
#include "hbm/start.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "hbm/series.h"
#include "hbm/solver.h"

double hbm_linear_response(const scene *sc, double omega, int n_harm, double *X)
{
  double k = sc->stiffness;
  for (int j = 0; j < sc->n_contacts; ++j)
    if (sc->contacts[j].law.gap > 0) k += scene_stuck_stiffness(&sc->contacts[j]);
  memset(X, 0, (size_t)series_length(n_harm) * sizeof(double));
  double complex x = sc->force / (k - sc->mass * omega * omega + I * sc->damping * omega);
  if (!isfinite(cabs(x))) x = sc->force / (k + sc->mass * omega * omega); /* undamped, at resonance: any size of the right order */
  X[1] = creal(x);
  X[2] = -cimag(x); /* Re(z exp(i th)) = Re z cos - Im z sin */
  return cabs(x);
}

/* Follow *factor from 0 to 1 at fixed omega from the solution at 0; *factor is 1 again afterwards. */
static hc_status ramp(hbm_solver *s, double *factor, double omega, double x_scale, double *X, hbm_point *point)
{
  double here = 0, step = 0.1;
  hc_status st = HC_OK;
  int iterations = 0;
  while (here < 1 && step > 1e-4) {
    *factor = fmin(1, here + step);
    s->sys.evaluated = false;
    st = hbm_solve_fixed(s, omega, fmax(x_scale, hbm_norm(s->sys.n_coef, X)), X, point);
    iterations += point->iterations;
    if (st == HC_OK) { here = *factor; step *= 1.5; } else step *= 0.5;
  }
  *factor = 1;
  s->sys.evaluated = false;
  point->iterations = iterations;
  return here == 1 ? HC_OK : st;
}

hc_status hbm_solve_first(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  const scene *sc = &s->sys.sc;
  int n_coef = s->sys.n_coef;
  double size = hbm_linear_response(sc, omega, s->sys.n_harm, X);
  hc_status st = hbm_solve_fixed(s, omega, size, X, point);
  if (st == HC_OK) return HC_OK;
  memset(X, 0, (size_t)n_coef * sizeof(double));
  st = ramp(s, &s->sys.force_factor, omega, size / 100, X, point);
  if (st == HC_OK) return HC_OK;
  scene apart = *sc;
  apart.n_contacts = 0;
  size = hbm_linear_response(&apart, omega, s->sys.n_harm, X);
  return ramp(s, &s->sys.contact_factor, omega, size, X, point);
}

hc_status hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  double size = hbm_norm(s->sys.n_coef, X);
  if (size != 0) return hbm_solve_fixed(s, omega, size, X, point);
  hc_status st = hbm_solve_first(s, omega, X, point); /* nothing says how large an answer to expect */
  if (st != HC_OK) memset(X, 0, (size_t)s->sys.n_coef * sizeof(double));
  return st;
}
