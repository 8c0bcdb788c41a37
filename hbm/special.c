/* special.c - turning points, period doublings and changes of the contact pattern along a curve, each located
 * between two points. A turning point and a doubling are roots of smooth functions of sigma (d omega along the
 * tangent; the product of 1 + multiplier), searched by interpolation. A pattern changes at an instant, so it is
 * bisected; what lies beyond the first change of a stretch is searched again. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/between.h"
#include "hbm/curve.h"
#include "hbm/solver.h"
#include "numerics/roots.h"

/* Of a segment, which spans a fraction of the sweep: far within the 1e-9 of omega that hbm.h promises. */
static const double SIGMA_TOLERANCE = 1e-11;

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
  const exact_force *e;
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

/* A search along segment k, and the point it was at last. */
typedef struct search {
  finder *f;
  int k;
  hbm_special_kind kind; /* of locate_root */
  const watched *left;   /* of locate_patterns: what is left behind */
  double sigma;
  watched here;
} search;

static hc_status look_at(search *s, double sigma)
{
  s->sigma = sigma;
  return watch_at(s->f, s->k, sigma, &s->here);
}

static hc_status value_at(void *self, double sigma, double *value)
{
  search *s = self;
  hc_status st = look_at(s, sigma);
  *value = value_of(s->kind, &s->here);
  return st;
}

static hc_status is_changed(void *self, double sigma, bool *changed)
{
  search *s = self;
  hc_status st = look_at(s, sigma);
  *changed = !same_pattern(&s->here, s->left);
  return st;
}

/* Back to the point that was found, if another one was looked at after it. */
static hc_status settle_at(search *s, double sigma) { return s->sigma == sigma ? HC_OK : look_at(s, sigma); }

/* A sign change of a smooth watched value on segment k. */
static hc_status locate_root(finder *f, int k, hbm_special_kind kind, double fa, double fb)
{
  search s = {.f = f, .k = k, .kind = kind, .sigma = NAN};
  root_point root;
  hc_status st = root_between(value_at, &s, 0, fa, 1, fb, SIGMA_TOLERANCE, &root);
  if (st == HC_OK) st = settle_at(&s, root.x);
  if (st != HC_OK) return st;
  /* the turn belongs to the branch it ends */
  if (kind == HBM_TURNING_POINT) f->x.point.branch = f->c->points[k].branch;
  return report_here(f, root.x, kind, s.here.regime, s.here.regime);
}

/* Every change of pattern on segment k, from `left` at its start to `right` at its end. */
static hc_status locate_patterns(finder *f, int k, watched left, const watched *right)
{
  double from = 0;
  for (int guard = 0; guard < 64 && from < 1 && !same_pattern(&left, right); ++guard) {
    search s = {.f = f, .k = k, .left = &left, .sigma = NAN};
    root_point change;
    hc_status st = root_change(is_changed, &s, from, 1, SIGMA_TOLERANCE, &change);
    if (st == HC_OK) st = settle_at(&s, change.x);
    watched beyond = change.x < 1 ? s.here : *right;
    if (st == HC_OK) st = report_here(f, change.x, HBM_CONTACT_CHANGE, left.regime, beyond.regime);
    if (st != HC_OK) return st;
    left = beyond;
    from = change.x;
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
