/* traced.h - a response curve, what must hold for every one of them, and the linear response in closed form. */
#pragma once

#include <complex.h>

#include "compare/study/scene_solvers.h"
#include "tests/hbm/scenes.h"

/* A monitor that stops the work after so many ticks. */
typedef struct tick_counter {
  int ticks, stop; /* so far; the one that is answered by false */
  double last;     /* fraction done */
  bool outside;    /* some fraction was not in 0..1 */
} tick_counter;

static inline bool tick(void *self, double done)
{
  tick_counter *c = self;
  c->outside |= !(done >= 0 && done <= 1);
  c->last = done;
  return ++c->ticks < c->stop;
}

typedef struct traced {
  hbm_solver *s;
  hbm_curve curve;
  hc_status status;
} traced;

/* What holds for every curve, whatever its end: frequencies are above 0 and inside the sweep (or within a factor 4
 * beyond its start, where a branch that turned back is followed), points are finite, branches are counted, and a curve
 * that ended with HC_OK ended on a limit of the sweep. */
static inline void check_curve(const hbm_curve *c, double from, double to, const char *what)
{
  double low = from < to ? from / 4 : to, high = from < to ? to : 4 * from;
  int n_coef = c->n_coef, turns = 0;
  for (int k = 0; k < c->n; ++k) {
    const hbm_point *p = &c->points[k];
    if (!(p->omega > 0 && p->omega >= low && p->omega <= high))
      fail_msg("%s: point %d of %d at omega %.17g", what, k, c->n, p->omega);
    /* 10 times hbm.tolerance: relative to the forces at the answer, not to those at the guess */
    CHECK_LE(p->residual, 1e-9, "%s: point %d", what, k);
    for (int i = 0; i < n_coef; ++i)
      assert_true(isfinite(c->X[(size_t)k * n_coef + i]) && isfinite(c->dX[(size_t)k * n_coef + i]));
    if (k) turns += (p->d_omega > 0) != (p[-1].d_omega > 0);
    assert_int_equal(p->branch, turns);
  }
  assert_int_equal(c->turning_points, turns);
  if (c->end == HC_OK && c->n) assert_true(c->points[c->n - 1].omega == (c->left_at_start ? from : to));
}

/* Curves here have some hundred points. After 5000 steps the curve is in a loop: the status is HC_INTERRUPTED. */
static inline traced trace(const scene *sc, double from, double to, const char *what)
{
  traced t = {0};
  tick_counter watch = {.stop = 5000};
  hc_monitor monitor = {tick, &watch};
  assert_int_equal(scene_hbm_solver(sc, &t.s), HC_OK);
  t.status = hbm_trace(t.s, from, to, &monitor, &t.curve);
  assert_int_equal(t.status, t.curve.end);
  check_curve(&t.curve, from, to, what);
  return t;
}

static inline void free_traced(traced *t)
{
  hbm_curve_free(&t->curve);
  hbm_solver_free(t->s);
}

/* The rows[n] of one curve, as one frequency after the other, to `tol` of the amplitude; in the order of the curve,
 * reversed or not, one solution for each row. There may be more turning points than the reference has: false ones of
 * sampling (test_paper.c), true ones that its steps passed over (a10 with H = 5 at 12.83386). They come in pairs:
 * rising stays rising. Returns how many. */
static inline int check_rows(int n, const reference_row *rows, const traced *t, const char *name, int n_harm,
                             int keep_mean, bool reversed, double tol)
{
  int checked = 0;
  for (int i = 0; i < n; ++i) {
    const reference_row *r = &rows[i];
    if (strcmp(r->name, name) || r->n_harm != n_harm || r->keep_mean != keep_mean) continue;
    int before = 0, all = 0; /* rows at this omega before this one, and in all */
    for (int j = 0; j < n; ++j) {
      bool same = !strcmp(rows[j].name, name) && rows[j].n_harm == n_harm && rows[j].keep_mean == keep_mean &&
                  rows[j].omega == r->omega;
      all += same;
      before += same && j < i;
    }
    hbm_curve at = {0};
    hc_status st = hbm_curve_at(t->s, &t->curve, r->omega, &at);
    if (st != HC_OK || at.n != all)
      fail_msg("%s H=%d static=%d: %d solutions at %g, not %d; %s", name, n_harm, keep_mean, at.n, r->omega, all,
               hc_status_text(st));
    int k = reversed ? all - 1 - before : before;
    CHECK_FILLED(hbm_measures, m, hbm_measure(t->s, at.X + (size_t)k * at.n_coef, &m));
    const double got[] = {m.amplitude, m.max, m.min, m.harmonic_1, m.mean},
                 expected[] = {r->amplitude, r->max, r->min, r->harmonic_1, r->mean};
    static const char *const what[] = {"amplitude", "max", "min", "harmonic_1", "mean"};
    for (int q = 0; q < 5; ++q)
      CHECK_NEAR(got[q], expected[q], tol * r->amplitude, "%s of %s H=%d static=%d omega=%g branch %d", what[q], name,
                 n_harm, keep_mean, r->omega, r->branch);
    const int branch = reversed ? t->curve.turning_points - at.points[k].branch : at.points[k].branch;
    if ((branch - r->branch) % 2)
      fail_msg("%s H=%d static=%d omega=%g: branch %d, not %d", name, n_harm, keep_mean, r->omega, branch, r->branch);
    hbm_curve_free(&at);
    ++checked;
  }
  return checked;
}

/* x = F0/(k - M w^2 + i C w), X_1 = Re x, X_2 = -Im x, nothing else. A residual of some eps of the forces (k + M w^2
 * + C w)|x| is amplified by the inverse of z = |k - M w^2 + i C w|: at most 8 eps (4 for the residual, 2 for the
 * polishing solve, and room), and the FFT's 2 log2 N eps of k |x|. Higher harmonics h likewise, with z_h, which is
 * larger than z off resonance, and least where h w meets the resonance: C h w. */
static inline double linear_tolerance(const scene *sc, double k, double omega, int h)
{
  double z = hypot(k - *sc->structure->mass.v * h * h * omega * omega, *sc->structure->damping.v * h * omega),
         x = sc->structure->loads->amplitude /
             hypot(k - *sc->structure->mass.v * omega * omega, *sc->structure->damping.v * omega);
  return (8 + 2 * log2(sc->hbm.samples)) * DBL_EPSILON *
         (k + *sc->structure->mass.v * h * h * omega * omega + *sc->structure->damping.v * h * omega) / z * x;
}

static inline void check_linear_point(const scene *sc, double k, const double *X, double omega, const char *what)
{
  double complex x = sc->structure->loads->amplitude /
                     (k - *sc->structure->mass.v * omega * omega + I * *sc->structure->damping.v * omega);
  CHECK_LE(hypot(X[1] - creal(x), X[2] + cimag(x)), linear_tolerance(sc, k, omega, 1), "%s at %.17g", what, omega);
  CHECK_LE(fabs(X[0]), linear_tolerance(sc, k, omega, 0), "%s at %.17g", what, omega);
  for (int h = 2; h <= sc->hbm.harmonics; ++h)
    CHECK_LE(hypot(X[2 * h - 1], X[2 * h]), linear_tolerance(sc, k, omega, h), "%s at %.17g, h=%d", what, omega, h);
}
