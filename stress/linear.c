/* linear.c - checks against closed forms: scenes made linear by a gap that is never reached, or by a preload and
 * friction that never slip.
 *
 *     x = Re Z exp(i omega t),   Z = F0 / (k - M omega^2 + i C omega)
 *
 * The terms of the denominator cancel near resonance: what rounding (and the tolerance of a residual that is judged
 * against those terms) does to Z grows with cond = (k + M omega^2 + C omega) / |k - M omega^2 + i C omega|. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "model/linear.h"
#include "stress/solved_scene.h"
#include "study/scene_solvers.h"

static double condition(const scene *sc, double k, double omega)
{
  double inertia = sc->mass * omega * omega, damper = sc->damping * omega;
  return (k + inertia + damper) / hypot(k - inertia, damper);
}

static double off(double a1, double b1, double complex z) { return hypot(a1 - creal(z), b1 + cimag(z)) / cabs(z); }

/* HBM by Newton from 1.4 times the solution, and the transient from the solution, against the closed form with
 * stiffness k. */
static stress_check check_linear(solved_scene *s, const scene *linear, double k)
{
  scene sc = *linear;
  const double complex z = linear_response(sc.mass, sc.damping, k, sc.force, s->omega);
  /* one Newton step of a linear equation, its LU, and the force as a sum of 2H+1 terms: some units of rounding each */
  const double bound = 50 * DBL_EPSILON * (2 * sc.hbm.harmonics + 1) * condition(&sc, k, s->omega);
  double guess[3] = {0, 1.4 * creal(z), -1.4 * cimag(z)}, rest = 0;
  stress_solution hbm;
  sc.hbm.skip_linear = false; /* or the closed form would be held against itself */
  stress_solve(s, &sc, s->omega, 1, guess, &hbm);
  if (hbm.status != HC_OK) return stress_refuse(s, hbm.status);
  for (int i = 3; i < 2 * hbm.n_harm + 1; ++i) rest = hypot(rest, hbm.X[i]);
  double error = hypot(off(hbm.X[1], hbm.X[2], z), hypot(hbm.X[0], rest) / cabs(z));
  if (!(error <= bound)) return stress_agree(error, bound);

  timeint *ti = NULL;
  timeint_result r;
  scene_state state = {.x = creal(z), .v = -s->omega * cimag(z)};
  hc_status st = scene_timeint(&sc, &ti);
  if (st == HC_OK) st = timeint_steady(ti, s->omega, state.all, &s->monitor, &r);
  timeint_free(ti);
  /* undamped, nothing settles */
  if (st != HC_OK) return sc.damping == 0 ? stress_agree(error, bound) : stress_refuse(s, st);
  double transient = off(r.a1, r.b1, z);
  const double allowed = r.method == TIMEINT_BY_CLOSED_FORM ? bound : fmax(bound, fmax(1e-6, 3 * r.closure));
  return !(transient <= allowed) ? stress_agree(transient, allowed)
                                 : stress_agree(fmax(error, r.method == TIMEINT_BY_CLOSED_FORM ? transient : 0), bound);
}

stress_check stress_check_free(solved_scene *s)
{
  scene sc = *s->sc;
  double reach = cabs(linear_response(sc.mass, sc.damping, sc.stiffness, sc.force, s->omega));
  if (!(reach < 1e150)) return stress_skip(STRESS_NOT_APPLICABLE); /* an undamped resonance */
  for (int j = 0; j < sc.n_contacts; ++j) sc.contacts[j].law.gap = -3 * reach;
  return check_linear(s, &sc, sc.stiffness);
}

/* kt c |x| <= mu kn (gap + s x) for |x| up to three times the response, with mu at least 1. */
stress_check stress_check_stuck(solved_scene *s)
{
  scene sc = *s->sc;
  const double k = scene_max_stiffness(&sc), reach = cabs(linear_response(sc.mass, sc.damping, k, sc.force, s->omega));
  if (!(reach < 1e150)) return stress_skip(STRESS_NOT_APPLICABLE);
  for (int j = 0; j < sc.n_contacts; ++j) {
    contact *c = &sc.contacts[j].law;
    c->mu = fmax(c->mu, 1);
    c->gap = 10 * reach * (1 + c->kt / (c->mu * c->kn));
  }
  return check_linear(s, &sc, k);
}
