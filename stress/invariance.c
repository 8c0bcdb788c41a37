/* invariance.c - checks of units, which no result may depend on, and of the balance of work over a period. */
#include <math.h>
#include <string.h>

#include "stress/scenes.h"
#include "stress/solved_scene.h"

/* The condition of a solution: its relative change over that of its data, each datum changed by `nudge`, up or down in
 * turn. At least 1; INFINITY where HBM then fails. */
static double sensitivity(solved_scene *s, const stress_solution *from)
{
  const double nudge = 1e-9;
  scene sc = *s->sc;
  stress_solution moved;
  sc.mass *= 1 + nudge;
  sc.stiffness *= 1 - nudge;
  sc.damping *= 1 + nudge;
  sc.force *= 1 + nudge;
  for (int j = 0; j < sc.n_contacts; ++j) {
    sc.contacts[j].law.kn *= 1 + nudge;
    sc.contacts[j].law.kt *= 1 - nudge;
    sc.contacts[j].law.gap *= 1 - nudge;
  }
  stress_solve(s, &sc, s->omega, from->n_harm, from->X, &moved);
  if (moved.status != HC_OK) return INFINITY;
  return fmax(1, stress_distance(2 * from->n_harm + 1, moved.X, from->X) / nudge);
}

/* The distance of the same solution in other units, back in ours. From nothing, or from our own solution. NaN: *st
 * says what failed. */
static double in_other_units(solved_scene *s, double length, double force, double time, bool from_nothing,
                             hc_status *st)
{
  const scene sc = stress_in_units(s->sc, length, force, time);
  const int n_coef = 2 * s->base.n_harm + 1;
  double guess[STRESS_COEFFICIENTS];
  stress_solution other;
  for (int i = 0; i < n_coef; ++i) guess[i] = length * s->base.X[i];
  stress_solve(s, &sc, sc.compare.omega.v[0], s->base.n_harm, from_nothing ? NULL : guess, &other);
  *st = other.status;
  for (int i = 0; i < n_coef; ++i) other.X[i] /= length;
  return other.status == HC_OK ? stress_distance(n_coef, other.X, s->base.X) : NAN;
}

/* Powers of two change no mantissa: not even the path of a failing Newton iteration may differ, from nothing.
 * Inches, pounds and minutes round every datum, and can lead an iteration elsewhere; from our own solution they must
 * stay there. */
stress_check stress_check_units(solved_scene *s)
{
  const double bound = 1e-10; /* what hbm.tolerance allows a well-conditioned solution */
  hc_status st;
  double binary = in_other_units(s, 0x1p-10, 0x1p6, 0x1p4, true, &st);
  if (st == HC_INTERRUPTED || s->base.status == HC_INTERRUPTED) return stress_refuse(s, HC_INTERRUPTED);
  if (st != s->base.status) return stress_find(STRESS_DISAGREES, NAN, NAN);
  if (st != HC_OK) return stress_refuse(s, st);
  if (!(binary <= bound)) return stress_agree(binary, bound);
  double decimal = in_other_units(s, 39.3701, 0.224809, 1.0 / 60, false, &st);
  if (st == HC_OK && decimal <= bound) return stress_agree(fmax(binary, decimal), bound);
  double allowed = sensitivity(s, &s->base) * s->sc->hbm.tolerance;
  if (st != HC_OK)
    return allowed > 1e-3 ? stress_explain(STRESS_ILL_CONDITIONED, NAN, allowed)
                          : stress_find(STRESS_DISAGREES, NAN, bound);
  return decimal <= allowed ? stress_explain(STRESS_ILL_CONDITIONED, decimal, allowed)
                            : stress_find(STRESS_DISAGREES, decimal, allowed);
}

/* Work per period, divided by pi:   F0 b1 = C omega sum h^2 (a_h^2 + b_h^2) + contacts,   contacts >= 0, and = 0 where
 * nothing slips. It holds for the truncated equations, too, since their force is the exact one of the truncated motion.
 * Bound: the residual's tolerance, relative to each harmonic's forces, times the displacements they act along. */
stress_check stress_check_energy(solved_scene *s)
{
  const scene *sc = s->sc;
  const stress_solution *b = &s->base;
  if (b->status != HC_OK) return stress_refuse(s, b->status);
  const double k = scene_max_stiffness(sc), w = s->omega;
  double damper = 0, terms = 0;
  for (int h = 1; h <= b->n_harm; ++h) {
    double a = hypot(b->X[2 * h - 1], b->X[2 * h]);
    damper += sc->damping * w * h * h * a * a;
    terms += ((k + h * h * sc->mass * w * w + h * w * sc->damping) * a + (h == 1 ? sc->force : 0)) * h * a;
  }
  const double contacts = sc->force * b->X[2] - damper;
  const double error = b->m.contact.regime == CONTACT_SLIPS || b->m.contact.regime == CONTACT_SEPARATES
                           ? fmax(-contacts, 0)
                           : fabs(contacts);
  return stress_agree(error == 0 ? 0 : error / terms, sc->hbm.tolerance);
}
