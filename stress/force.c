/* force.c - checks of the contact force alone: one motion, no equation to solve.
 *
 * The motion has the scene's H harmonics, falling like 1/h^2, and is large enough to cross the widest gap. A slider
 * stuck all period may rest anywhere, and the two evaluations may leave it at different places: there the mean force is
 * not compared. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/aft.h"
#include "hbm/exact_force.h"
#include "numerics/series.h"
#include "stress/solved_scene.h"
#include "study/scene_solvers.h"

typedef struct force {
  hc_status status;
  double F[STRESS_COEFFICIENTS]; /* [force] */
  int transitions;
  bool slips, free; /* some contact slips; some slider is stuck all period */
} force;

static void make_motion(const scene *sc, double *X)
{
  double reach = 0;
  memset(X, 0, STRESS_COEFFICIENTS * sizeof *X);
  for (int j = 0; j < sc->n_contacts; ++j) {
    const moving_contact c = scene_moving_contact(&sc->contacts[j]);
    reach = fmax(reach, fabs(c.law.gap) / fmax(c.cv[0], 0.05));
  }
  if (reach == 0) reach = 1;
  X[0] = 0.1 * reach;
  for (int h = 1; h <= sc->hbm.harmonics; ++h) { /* phases that repeat nowhere */
    X[2 * h - 1] = 1.5 * reach * cos(1.3 * h * h) / (h * h);
    X[2 * h] = 1.5 * reach * sin(1.3 * h * h) / (h * h);
  }
}

static void evaluate(const scene *sc, const double *X, force *out)
{
  exact_force *e = NULL;
  contact_report report = {.transitions = 0};
  memset(out, 0, sizeof *out);
  out->status = scene_exact(sc, sc->hbm.harmonics, &e);
  if (out->status == HC_OK) out->status = exact_force_eval(e, X, out->F, NULL, &report);
  for (int j = 0; j < sc->n_contacts && out->status == HC_OK; ++j) {
    int n;
    const contact_piece *p = exact_force_pieces(e, j, &n);
    out->free |= n == 1 && p[0].state == CONTACT_STICK && p[0].to - p[0].from > 6.283;
    for (int i = 0; i < n; ++i) out->slips |= contact_slip_sign(p[i].state) != 0;
  }
  out->transitions = report.transitions;
  exact_force_free(e);
}

/* Sums of h^p |coefficients|: bounds of |x|, |x'|, |x''| without the mean. */
static double size(const scene *sc, const double *X, int p)
{
  double sum = 0;
  for (int h = 1; h <= sc->hbm.harmonics; ++h) sum += pow(h, p) * (fabs(X[2 * h - 1]) + fabs(X[2 * h]));
  return sum;
}

/* A bound of |d force/d x| over all states of the contacts. */
static double stiffness(const scene *sc)
{
  double k = 0;
  for (int j = 0; j < sc->n_contacts; ++j) {
    const moving_contact c = scene_moving_contact(&sc->contacts[j]);
    k += moving_contact_stuck_stiffness(&c) + c.law.mu * c.law.kn * c.cv[0] * c.cu[0];
  }
  return k;
}

static double preload(const scene *sc)
{
  double sum = 0;
  for (int j = 0; j < sc->n_contacts; ++j) {
    const moving_contact c = scene_moving_contact(&sc->contacts[j]);
    sum += fabs(c.law.gap) * c.law.kn * (c.cv[0] + c.law.mu * c.cu[0]);
  }
  return sum;
}

/* What rounding may do to a force coefficient: H rounding units of every force that makes it up (series.h), with
 * room for the transitions' own. */
static double rounding(const scene *sc, const double *X)
{
  return 500 * DBL_EPSILON * (sc->hbm.harmonics + 1) * (stiffness(sc) * (fabs(X[0]) + size(sc, X, 0)) + preload(sc));
}

/* Largest difference of two sets of coefficients, relative to the largest of the first. */
static double apart(const scene *sc, const force *f, const double *G, bool mean)
{
  double worst = 0, largest = 0;
  for (int i = mean ? 0 : 1; i < 2 * sc->hbm.harmonics + 1; ++i) {
    worst = fmax(worst, isnan(f->F[i] - G[i]) ? INFINITY : fabs(f->F[i] - G[i]));
    largest = fmax(largest, fabs(f->F[i]));
  }
  return worst == 0 ? 0 : worst / largest;
}

static double largest(const scene *sc, const force *f)
{
  double most = 0;
  for (int i = 0; i < 2 * sc->hbm.harmonics + 1; ++i) most = fmax(most, fabs(f->F[i]));
  return most;
}

/* With N samples, d = 2 pi/N apart, a coefficient is (1/pi) of a trapezoidal sum over f(th) cos(h th). Its errors:
 *     smooth parts    |(f cos)''| d^2/12 over 2 pi:     S (X2 + 2 h X1 + h^2 X0) d^2/6
 *     kinks           jumps of f' of at most S X1, d^2/8 each
 *     the slider      comes to rest between samples, off by at most |w''| d^2/8, w'' made of u'' and (mu kn/kt) v'';
 *                     stays so all period: S X2 d^2/4
 * with S all stiffnesses, Xp = sum h^p |X_h|. The bound is twice their sum, for products of these errors. */
static double sampling(const scene *sc, const double *X, const force *f, int n_time, int h)
{
  double d = TWO_PI / n_time, x0 = fabs(X[0]) + size(sc, X, 0), x1 = size(sc, X, 1), x2 = size(sc, X, 2);
  double k = stiffness(sc);
  return 2 * d * d *
         (k * (x2 + 2 * h * x1 + h * h * x0) / 6 + h * h * preload(sc) / 6 + (f->transitions + 1) * k * x1 / 8 +
          k * x2 / 4);
}

/* The coefficient that comes nearest to its bound, or is farthest beyond. */
static void worst_coefficient(const scene *sc, const double *X, const force *f, const double *sampled, int n_time,
                              double *error, double *bound)
{
  double worst = -1;
  for (int i = f->free ? 1 : 0; i < 2 * sc->hbm.harmonics + 1; ++i) {
    double e = fabs(f->F[i] - sampled[i]), b = sampling(sc, X, f, n_time, (i + 1) / 2) + rounding(sc, X),
           ratio = e == 0 ? 0 : e / b;
    if (ratio <= worst) continue;
    *error = e == 0 ? 0 : e / largest(sc, f);
    *bound = e == 0 ? 0 : b / largest(sc, f);
    worst = isnan(ratio) ? INFINITY : ratio;
  }
}

stress_check stress_check_force(solved_scene *s)
{
  const scene *sc = s->sc;
  double X[STRESS_COEFFICIENTS], error = 0, bound = 0;
  force f;
  make_motion(sc, X);
  evaluate(sc, X, &f);
  if (f.status != HC_OK) return stress_refuse(s, f.status);
  const int samples[] = {sc->hbm.samples, 4096, 65536};
  for (int i = 0; i < 3 && error <= bound; ++i) {
    double sampled[STRESS_COEFFICIENTS];
    aft *a = NULL;
    hc_status st = scene_aft(sc, sc->hbm.harmonics, samples[i], &a);
    if (st == HC_OK) st = aft_eval(a, X, sampled, NULL, NULL);
    aft_free(a);
    if (st != HC_OK) return stress_refuse(s, st);
    worst_coefficient(sc, X, &f, sampled, samples[i], &error, &bound);
  }
  return stress_agree(error, bound);
}

stress_check stress_check_shift(solved_scene *s)
{
  const scene *sc = s->sc;
  const double later = 2.0; /* [rad] */
  double X[STRESS_COEFFICIENTS], shifted[STRESS_COEFFICIENTS], back[STRESS_COEFFICIENTS];
  force f, g;
  make_motion(sc, X);
  shifted[0] = X[0];
  for (int h = 1; h <= sc->hbm.harmonics; ++h) {
    double c = cos(h * later), n = sin(h * later);
    shifted[2 * h - 1] = X[2 * h - 1] * c + X[2 * h] * n;
    shifted[2 * h] = X[2 * h] * c - X[2 * h - 1] * n;
  }
  evaluate(sc, X, &f);
  evaluate(sc, shifted, &g);
  if (f.status != HC_OK || g.status != HC_OK) return stress_refuse(s, f.status != HC_OK ? f.status : g.status);
  back[0] = g.F[0];
  for (int h = 1; h <= sc->hbm.harmonics; ++h) {
    double c = cos(h * later), n = sin(h * later);
    back[2 * h - 1] = g.F[2 * h - 1] * c - g.F[2 * h] * n;
    back[2 * h] = g.F[2 * h] * c + g.F[2 * h - 1] * n;
  }
  double error = apart(sc, &f, back, !f.free && !g.free);
  return stress_agree(error, error == 0 ? 0 : rounding(sc, X) / largest(sc, &f));
}

/* The force of a contact that sticks or is separated depends on x alone, so that the reversed motion has the reversed
 * force; slip breaks this. Where the motion slips, the scene is given so much friction that a contact which closes
 * never slips; where it slips still (preloaded contacts), the check is skipped. */
stress_check stress_check_reflection(solved_scene *s)
{
  scene sc = *s->sc;
  double X[STRESS_COEFFICIENTS], backwards[STRESS_COEFFICIENTS];
  force f, g;
  make_motion(&sc, X);
  evaluate(&sc, X, &f);
  for (int j = 0; j < sc.n_contacts && f.slips; ++j) sc.contacts[j].law.mu = 1e6;
  if (f.slips) evaluate(&sc, X, &f);
  memcpy(backwards, X, sizeof X);
  for (int h = 1; h <= sc.hbm.harmonics; ++h) backwards[2 * h] = -X[2 * h];
  evaluate(&sc, backwards, &g);
  if (f.status != HC_OK || g.status != HC_OK) return stress_refuse(s, f.status != HC_OK ? f.status : g.status);
  if (f.slips || g.slips) return stress_skip(STRESS_NOT_APPLICABLE);
  for (int h = 1; h <= sc.hbm.harmonics; ++h) g.F[2 * h] = -g.F[2 * h];
  double error = apart(&sc, &f, g.F, !f.free && !g.free);
  double bound = rounding(s->sc, X) / largest(&sc, &f); /* without the friction that is not felt */
  return stress_agree(error, error == 0 ? 0 : bound);
}
