/* special.c - turning points, period doublings and changes of the contact pattern along a curve, each located
 * between two points. A turning point and a doubling are roots of smooth functions of sigma (d omega along the
 * tangent; the product of 1 + multiplier): regula falsi. A pattern changes at an instant, so it is bisected; what
 * lies beyond the first change of a stretch is searched again. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/between.h"
#include "hbm/curve.h"
#include "hbm/solver.h"

/* What is watched at a point. */
typedef struct watched {
  double d_omega, flip;
  contact_regime regime;
  int transitions;
} watched;

typedef struct finder {
  hbm_solver *s;
  const hbm_curve *c;
  hbm_candidate x;
  int cap, n, first; /* first: of the segment under way */
  double *sigma;     /* [cap] where on its segment each lies */
  hbm_special *out;
} finder;

static hc_status watch(finder *f, double omega, double d_omega, const double *X, watched *w)
{
  const exact *e;
  contact_report report;
  hbm_stability st;
  hc_status status = hbm_pattern_at(f->s, X, &e, &report);
  if (status == HC_OK) status = stability_of(f->s->stability, f->s->model, e, omega, &st);
  *w = (watched){d_omega, st.flip, report.regime, report.transitions};
  return status;
}

static hc_status watch_at(finder *f, int k, double sigma, watched *w)
{
  hc_status st = hbm_segment_point(f->s, f->c, k, sigma, &f->x);
  return st == HC_OK ? watch(f, f->x.point.omega, f->x.point.d_omega, f->x.X, w) : st;
}

static bool same_pattern(const watched *a, const watched *b)
{
  return a->regime == b->regime && a->transitions == b->transitions;
}

/* The point in f->x, found at sigma, goes behind those of this segment that come before it. */
static hc_status report_here(finder *f, double sigma, hbm_special_kind kind, contact_regime before,
                             contact_regime after)
{
  hbm_measures m;
  hc_status st = hbm_measure(f->s, f->x.X, &m);
  if (st != HC_OK) return st;
  if (f->n++ >= f->cap) return HC_OK;
  int i = f->n - 1;
  for (; i > f->first && f->sigma[i - 1] > sigma; --i) {
    f->out[i] = f->out[i - 1];
    f->sigma[i] = f->sigma[i - 1];
  }
  f->out[i] = (hbm_special){kind, f->x.point.omega, m.amplitude, f->x.point.branch, before, after};
  f->sigma[i] = sigma;
  return HC_OK;
}

static double value_of(hbm_special_kind kind, const watched *w)
{
  return kind == HBM_TURNING_POINT ? w->d_omega : w->flip;
}

/* A sign change of a smooth watched value on segment k: Illinois. */
static hc_status locate_root(finder *f, int k, hbm_special_kind kind, double fa, double fb)
{
  double a = 0, b = 1, m = 0, omega_before = NAN;
  watched w;
  for (int it = 0; it < 60; ++it) {
    m = (a * fb - b * fa) / (fb - fa);
    if (!(m > a && m < b)) m = 0.5 * (a + b);
    hc_status st = watch_at(f, k, m, &w);
    if (st != HC_OK) return st;
    double fm = value_of(kind, &w);
    if ((fm < 0) == (fb < 0)) {
      b = m;
      fb = fm;
      fa *= 0.5;
    } else {
      a = m;
      fa = fm;
      fb *= 0.5;
    }
    bool still = fabs(f->x.point.omega - omega_before) <= 1e-12 * f->x.point.omega;
    omega_before = f->x.point.omega;
    if (fm == 0 || b - a < 1e-12 || (still && kind == HBM_PERIOD_DOUBLING && it > 2)) break;
  }
  /* the turn belongs to the branch it ends */
  if (kind == HBM_TURNING_POINT) f->x.point.branch = f->c->points[k].branch;
  return report_here(f, m, kind, w.regime, w.regime);
}

/* Every change of pattern on segment k, from `left` at its start to `right` at its end. */
static hc_status locate_patterns(finder *f, int k, watched left, const watched *right)
{
  double from = 0;
  for (int guard = 0; guard < 64 && !same_pattern(&left, right); ++guard) {
    double a = from, b = 1;
    watched w = left, beyond = *right;
    hc_status st = HC_OK;
    while (st == HC_OK && b - a > 1e-11) {
      double m = 0.5 * (a + b);
      st = watch_at(f, k, m, &w);
      if (st == HC_OK && same_pattern(&w, &left)) a = m;
      else b = m;
    }
    if (st == HC_OK && b < 1) st = watch_at(f, k, b, &beyond);
    else if (st == HC_OK) st = watch_at(f, k, 1, &w);
    if (st == HC_OK) st = report_here(f, b, HBM_CONTACT_CHANGE, left.regime, beyond.regime);
    if (st != HC_OK) return st;
    left = beyond;
    from = b;
    if (b >= 1) break;
  }
  return HC_OK;
}

static hc_status search_segment(finder *f, int k, const watched *a, const watched *b)
{
  hc_status st = HC_OK;
  f->first = f->n;
  hc_status turn = HC_OK, flip = HC_OK;
  if (!same_pattern(a, b)) st = locate_patterns(f, k, *a, b);
  if ((a->d_omega > 0) != (b->d_omega > 0)) turn = locate_root(f, k, HBM_TURNING_POINT, a->d_omega, b->d_omega);
  if ((a->flip > 0) != (b->flip > 0)) flip = locate_root(f, k, HBM_PERIOD_DOUBLING, a->flip, b->flip);
  return st != HC_OK ? st : turn != HC_OK ? turn : flip;
}

hc_status hbm_specials(hbm_solver *s, const hbm_curve *c, int cap, hbm_special *out, int *n)
{
  finder f = {.s = s, .c = c, .cap = cap, .out = out};
  watched before, here;
  *n = 0;
  if (c->n == 0) return HC_OK;
  f.sigma = malloc((size_t)(cap > 0 ? cap : 1) * sizeof *f.sigma);
  hc_status st = f.sigma ? hbm_candidate_new(c->n_coef, &f.x) : HC_NO_MEMORY, worst = HC_OK;
  if (st == HC_OK) st = watch(&f, c->points[0].omega, c->points[0].d_omega, hbm_curve_X(c, 0), &before);
  for (int k = 0; st == HC_OK && k + 1 < c->n; ++k) {
    st = watch(&f, c->points[k + 1].omega, c->points[k + 1].d_omega, hbm_curve_X(c, k + 1), &here);
    hc_status found = st == HC_OK ? search_segment(&f, k, &before, &here) : st;
    if (found != HC_OK) worst = found; /* one that could not be located does not hide the others */
    before = here;
  }
  free(f.x.X);
  free(f.sigma);
  *n = f.n;
  return st != HC_OK ? st : worst;
}
