/* limits.c - checks that one method tends to another: samples to exact forces, harmonics to the orbit,
 * regularisation to the exact law.
 *
 * Differences up to 1e-6 of the amplitude (or the two tolerances together, where that is more) agree. A larger one must
 * shrink when its cause is made smaller, or lie within the method's own error estimate; else it is a finding. */
#include <math.h>
#include <string.h>

#include "compare/comparison.h"
#include "compare/motion.h"
#include "stress/solved_scene.h"

static const double close_enough = 1e-6;

/* ---- samples ---- */

stress_check stress_check_sampled(solved_scene *s)
{
  const stress_solution *b = &s->base;
  if (b->status != HC_OK) return stress_refuse(s, b->status);
  if (b->m.contact.regime == CONTACT_LINEAR) return stress_skip(STRESS_NOT_APPLICABLE);
  scene sc = *s->sc;
  double worst = 0, before = 0, error = 0; /* largest, last but one, last */
  int solved = 0;
  hc_status failed = HC_OK;
  sc.hbm.force = HBM_FORCE_SAMPLED;
  const int least = 2 * sc.hbm.harmonics + 1 > 256 ? 2 * sc.hbm.harmonics + 1 : 256;
  for (int n = least; n <= 32768; n *= 4) {
    stress_solution sampled;
    sc.hbm.samples = n;
    stress_solve(s, &sc, s->omega, b->n_harm, b->X, &sampled);
    if (sampled.status != HC_OK) {
      failed = sampled.status;
      continue;
    }
    /* a slider that is stuck all period rests where it likes */
    int first = b->m.contact.regime == CONTACT_STUCK ? 1 : 0;
    before = error;
    error = stress_distance(2 * b->n_harm + 1 - first, sampled.X + first, b->X + first);
    if (error <= close_enough) return stress_agree(error, close_enough);
    worst = fmax(worst, error);
    ++solved;
  }
  if (solved < 2) return stress_refuse(s, failed);
  /* Of second order; of first where a slider's rest hangs on one sample; and scattering by where the transitions lie
   * between the samples: in 64 times as many an eighth is asked, or half in the last four times as many. */
  const double bound = fmax(worst / 8, before / 2);
  return error <= bound ? stress_explain(STRESS_ALIASED, error, bound) : stress_find(STRESS_DISAGREES, error, bound);
}

/* ---- harmonics ---- */

/* The exact law's orbit from an HBM solution, and how far that is from it. NaN: no orbit. */
static double shoot_from(solved_scene *s, const stress_solution *h, stress_orbit *orbit)
{
  orbit->state = h->start;
  stress_shoot(s, s->sc, s->omega, orbit);
  return orbit->status == HC_OK ? comparison_waveform_error(&h->m, h->n_harm, h->X, &orbit->r) : NAN;
}

static double tolerance_of(const stress_orbit *o) { return fmax(close_enough, 3 * o->r.closure); }

/* How far HBM ends from an orbit found by time integration when it starts from that orbit's own harmonics. */
static double confirm(solved_scene *s, const scene *sc, const stress_orbit *o)
{
  double guess[STRESS_COEFFICIENTS];
  stress_solution h;
  const periodic_motion orbit = motion_of_transient(&o->r);
  motion_harmonics(&orbit, sc->hbm.harmonics, guess);
  stress_solve(s, sc, s->omega, sc->hbm.harmonics, guess, &h);
  return h.status == HC_OK ? comparison_waveform_error(&h.m, h.n_harm, h.X, &o->r) : NAN;
}

/* Is the natural frequency of the stuck mass above a tenth of the n-th harmonic's? After each impact the mass
 * oscillates at that frequency, and n harmonics do not resolve it. */
static bool beyond_harmonics(const solved_scene *s, int n)
{
  return sqrt(scene_max_stiffness(s->sc) / s->sc->mass) > 0.1 * n * s->omega;
}

/* A bound of the change of the waveform by doubling the harmonics, relative to the orbit's amplitude. */
static double moved(const stress_solution *h, const stress_solution *finer, double amplitude)
{
  double sum = 0;
  for (int i = 0; i < 2 * finer->n_harm + 1; ++i) sum += fabs(finer->X[i] - (i < 2 * h->n_harm + 1 ? h->X[i] : 0));
  return sum / amplitude;
}

/* Harmonics are doubled until HBM and the orbit next to it meet. */
stress_check stress_check_shooting(solved_scene *s)
{
  if (s->base.status != HC_OK) return stress_refuse(s, s->base.status);
  /* another equation */
  if (!s->sc->hbm.keep_mean && s->base.m.contact.regime != CONTACT_LINEAR) return stress_skip(STRESS_NOT_APPLICABLE);
  scene sc = *s->sc;
  double error = shoot_from(s, &s->base, &s->orbit);
  if (s->orbit.status == HC_OK && error <= tolerance_of(&s->orbit)) return stress_agree(error, tolerance_of(&s->orbit));
  const double coarse = error;
  while (2 * s->fine.n_harm <= STRESS_MOST_HARMONICS) {
    stress_solution finer;
    sc.hbm.harmonics = 2 * s->fine.n_harm;
    stress_solve(s, &sc, s->omega, s->fine.n_harm, s->fine.X, &finer);
    if (finer.status != HC_OK) break;
    stress_orbit orbit;
    double before = error;
    error = shoot_from(s, &finer, &orbit);
    double step = moved(&s->fine, &finer, orbit.status == HC_OK ? orbit.r.amplitude : finer.m.amplitude);
    s->fine = finer;
    s->orbit = orbit;
    if (orbit.status == HC_INTERRUPTED) return stress_refuse(s, orbit.status);
    if (orbit.status != HC_OK) continue;
    if (error <= tolerance_of(&orbit)) return stress_explain(STRESS_TRUNCATED, coarse, NAN);
    if (2 * s->fine.n_harm > STRESS_MOST_HARMONICS && (error <= before / 2 || error <= 3 * step))
      return stress_explain(STRESS_TRUNCATED, error, 3 * step);
  }
  if (s->orbit.status != HC_OK) return stress_refuse(s, s->orbit.status);
  if (beyond_harmonics(s, s->fine.n_harm)) return stress_explain(STRESS_UNRESOLVED, error, NAN);
  sc.hbm.harmonics = s->fine.n_harm;
  double confirmed = confirm(s, &sc, &s->orbit);
  if (confirmed <= fmin(error / 10, 1e-3)) return stress_explain(STRESS_OTHER_ORBIT, error, confirmed);
  return stress_find(STRESS_DISAGREES, error, tolerance_of(&s->orbit));
}

/* ---- stability ---- */

static double multiplier_error(const stress_solution *h, const stress_orbit *o)
{
  return fabs(h->stability.multiplier - o->r.multiplier) / fmax(1, o->r.multiplier);
}

/* A multiplier changes with the orbit, and by a jump where a transition appears or disappears. A difference above 1e-3
 * is explained if it shrinks with twice the harmonics (to 0.8: slowly where a contact is short and stiff), or if the
 * two orbits have different numbers of transitions. */
stress_check stress_check_stability(solved_scene *s)
{
  const double bound = 1e-3;
  if (s->base.status != HC_OK) return stress_refuse(s, s->base.status);
  if (!s->sc->hbm.keep_mean && s->base.m.contact.regime != CONTACT_LINEAR) return stress_skip(STRESS_NOT_APPLICABLE);
  if (s->orbit.status != HC_OK || isnan(s->orbit.r.multiplier) || s->fine.stability_status != HC_OK)
    return stress_skip(STRESS_NO_ORBIT);
  const double far = comparison_waveform_error(&s->fine.m, s->fine.n_harm, s->fine.X, &s->orbit.r);
  if (!(far <= 1e-3)) return stress_skip(STRESS_NO_ORBIT); /* not the same one, or hardly */
  const double error = multiplier_error(&s->fine, &s->orbit);
  if (error <= bound) return stress_agree(error, bound);
  scene sc = *s->sc;
  stress_solution finer;
  sc.hbm.harmonics = 2 * s->fine.n_harm;
  stress_solve(s, &sc, s->omega, s->fine.n_harm, s->fine.X, &finer);
  const double better =
      finer.status == HC_OK && finer.stability_status == HC_OK ? multiplier_error(&finer, &s->orbit) : NAN;
  if (better <= fmax(bound, 0.8 * error)) return stress_explain(STRESS_TRUNCATED, error, better);
  const int events = s->fine.m.contact.transitions, scouted = s->orbit.r.scout_switches;
  if (events != s->orbit.r.switches || (scouted >= 0 && events != scouted))
    return stress_explain(STRESS_OTHER_EVENTS, error, better);
  if (far > close_enough && beyond_harmonics(s, sc.hbm.harmonics))
    return stress_explain(STRESS_UNRESOLVED, error, better);
  return stress_find(STRESS_DISAGREES, error, bound);
}

/* ---- regularisation ---- */

static double regularised(solved_scene *s, double regularisation, stress_orbit *o)
{
  scene sc = *s->sc;
  sc.transient.law = TRANSIENT_LAW_REGULARISED;
  sc.transient.regularisation = regularisation;
  o->state = s->orbit.state;
  stress_shoot(s, &sc, s->omega, o);
  if (o->status != HC_OK) return NAN;
  return hypot(o->r.a1 - s->orbit.r.a1, o->r.b1 - s->orbit.r.b1) / s->orbit.r.amplitude;
}

/* The error is of first or second order in the regularisation, which of them is not known beforehand: with a tenth of
 * it, the difference must fall to a quarter or less. */
stress_check stress_check_regularised(solved_scene *s)
{
  if (s->orbit.status != HC_OK) return stress_skip(STRESS_NO_ORBIT);
  static const double less[] = {1e-4, 1e-5, 1e-6, 1e-7};
  double error = -1; /* none yet */
  stress_orbit o;
  for (int i = 0; i < 4; ++i) {
    double before = error;
    error = regularised(s, less[i], &o);
    if (o.status != HC_OK) return stress_refuse(s, o.status);
    if (error <= fmax(close_enough, 3 * (o.r.closure + s->orbit.r.closure))) return stress_agree(error, close_enough);
    if (error <= before / 4) return stress_explain(STRESS_SMOOTHED, error, before / 4);
  }
  return stress_find(STRESS_DISAGREES, error, close_enough);
}
