/* ramp.c - see ramp.h. Why each arrives, or does not:
 *
 * Damping. It starts at D = 10 k/omega, k the stiffness with all contacts stuck: there the damper outweighs the
 * contacts, the mass creeps, and nothing suggests a second solution. The damper's work bounds the velocity of every
 * solution on the way, |v| <= F0/C in the mean square: the path cannot run to infinity. So it arrives if C > 0, however
 * many turning points it has on the way, and that may be many. With C = 0 it usually arrives, too.
 * Force. It starts where nothing happens at the contacts, unless a gap is 0. It may come back there without damping
 * alone, but its turning points are other ones: it may be short where the other is not. */
#include "hbm/solver/ramp.h"

#include "hbm/solver/linear_solution.h"

static const double least_force = 1e-4, least_damping = 1e-9; /* [1] of the whole; of `most` */

static double mean_of_diagonal(int n, const double *A)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += A[(size_t)i * (size_t)(n + 1)];
  return sum / n;
}

hbm_ramp hbm_ramp_of(hbm_ramp_kind kind, const hbm_system *sys, double omega)
{
  hbm_ramp r = {.kind = kind, .omega = omega, .from = least_force};
  if (kind == HBM_RAMP_FORCE) return r;
  r.from = 2;
  /* [force/length] the stiffness of the stuck structure's fastest mode, for the mean of the masses */
  const model *m = sys->model;
  const double stiffest = mean_of_diagonal(m->n, m->mass) * sys->scales.highest * sys->scales.highest;
  r.most = 10 * stiffest / omega;
  /* D falls by the same factor over equal parts of the ramp, until it is small beside C */
  r.rate = fmax(1, -log(fmax(mean_of_diagonal(m->n, m->damping) / r.most, least_damping)));
  return r;
}

void hbm_ramp_start(const hbm_ramp *r, hbm_system *sys, double *X)
{
  hbm_ramp_set(r, r->from, sys);
  hbm_linear_response(sys, r->omega, X);
}

void hbm_ramp_set(const hbm_ramp *r, double p, hbm_system *sys)
{
  if (r->kind == HBM_RAMP_DAMPING) sys->more_damping = r->most * expm1(r->rate * (p - 1)) / expm1(r->rate);
  else sys->force_factor = p;
}

void hbm_ramp_leave(hbm_system *sys)
{
  sys->more_damping = 0;
  sys->force_factor = 1;
}

void hbm_ramp_derivative(const hbm_ramp *r, double p, hbm_system *sys, const double *X, double *dR)
{
  if (r->kind == HBM_RAMP_FORCE) {
    hbm_system_dforce(sys, r->omega, dR);
    return;
  }
  const double by_p = r->most * r->rate * exp(r->rate * (p - 1)) / expm1(r->rate);
  hbm_system_ddamping(sys, r->omega, X, dR);
  for (int i = 0; i < sys->n; ++i) dR[i] *= by_p;
}
