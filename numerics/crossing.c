/* crossing.c - see crossing.h. An interval is proved free of crossings by the bound of f'', or proved monotone by
 * it, or proved convex by the bound of f'''; else it is halved. No halving is needed where the motion is smooth on the
 * scale of the interval. */
#include "numerics/crossing.h"

#include <float.h>
#include <math.h>

#include "numerics/base/constants.h"

enum { MAX_NEWTON = 60 };

guard guard_make(const series_vector *m, int order, const double *a, double constant)
{
  guard g = {.dim = m->dim, .order = order, .constant = constant};
  for (int d = 0; d < m->dim; ++d) {
    g.a[d] = a[d];
    if (order == 0) g.mean += a[d] * m->X[d][0];
  }
  for (int h = 1; h <= m->n_harm; ++h) {
    double p = 0, q = 0, h2 = (double)h * h;
    for (int d = 0; d < m->dim; ++d) {
      p += a[d] * m->X[d][2 * h - 1];
      q += a[d] * m->X[d][2 * h];
    }
    double size = (fabs(p) + fabs(q)) * (order ? h : 1);
    g.size += size;
    g.bound2 += h2 * size;
    g.bound3 += h2 * h * size;
  }
  g.bound1 = sqrt(g.size * g.bound2); /* Cauchy-Schwarz */
  g.noise = DBL_EPSILON * (16 * guard_scale(&g) + 32 * g.bound1);
  return g;
}

guard guard_negative(const guard *g)
{
  guard n = *g;
  for (int d = 0; d < g->dim; ++d) n.a[d] = -g->a[d];
  n.constant = -g->constant;
  n.mean = -g->mean;
  return n;
}

double guard_scale(const guard *g) { return g->size + fabs(g->mean) + fabs(g->constant); }

static inline double guard_derivative(const guard *g, const series_node *at, int k)
{
  double f = 0;
  for (int d = 0; d < g->dim; ++d) f += g->a[d] * at->d[g->order + k][d];
  return f;
}

double guard_value(const guard *g, const series_node *at) { return guard_derivative(g, at, 0) + g->constant; }

/* Root of f in [a, b], f falling through 0 once, perhaps after it has risen: Newton kept inside by bisection. */
static guarded_point falling_root(const guarded *s, guarded_point a, guarded_point b)
{
  if (!(a.f > 0) && !(a.d1 > 0)) return a;
  const bool rises = a.d1 > 0;
  guarded_point x = s->at(s->self, a.th + (b.th - a.th) * (rises ? 0.5 : a.f / (a.f - b.f)));
  for (int it = 0; it < MAX_NEWTON; ++it) {
    if (x.f > 0 || (rises && x.d1 > 0)) a = x;
    else b = x;
    const double newton = x.th - x.f / x.d1;
    /* tested before the bracket, since at the root x may be an end of it */
    if (x.d1 < 0 && fabs(newton - x.th) <= 2 * DBL_EPSILON * (1 + fabs(x.th))) break;
    const bool inside = x.d1 < 0 && newton > a.th && newton < b.th;
    const double next = inside ? newton : 0.5 * (a.th + b.th), moved = next - x.th;
    if (fabs(moved) <= DBL_EPSILON * fabs(next)) break;
    x = s->at(s->self, next);
    if (inside && s->bound2 * moved * moved <= 2 * DBL_EPSILON * fabs(x.d1)) break; /* 2 |f'| times the error left */
  }
  return x;
}

/* Minimum of f in [a, b], f convex there with f'(a) < 0 < f'(b). */
static guarded_point minimum(const guarded *s, guarded_point a, guarded_point b)
{
  guarded_point x = s->at(s->self, a.th + (b.th - a.th) * a.d1 / (a.d1 - b.d1));
  for (int it = 0; it < MAX_NEWTON; ++it) {
    if (x.d1 < 0) a = x;
    else b = x;
    double next = x.th - x.d1 / x.d2;
    if (fabs(next - x.th) <= 1e-9) break; /* f is stationary: an error e of the angle makes f'' e^2/2 in f */
    if (!(next > a.th && next < b.th)) next = 0.5 * (a.th + b.th);
    if (fabs(next - x.th) <= 1e-9) break;
    x = s->at(s->self, next);
  }
  return x;
}

/* fmin and fmax are function calls, since they treat NaN specially; nothing here is NaN. */
static inline double lesser(double x, double y) { return x < y ? x : y; }
static inline double greater(double x, double y) { return x > y ? x : y; }

/* When rounding allows no further halving, ends of different sign count as one crossing, ends of the same sign as
 * none. */
bool guarded_first(const guarded *s, guarded_point a, guarded_point b, guarded_point *root)
{
  const double width = b.th - a.th, sag = s->bound2 * width * width / 8; /* f is at most this far from its chord */
  if (a.f < -s->noise) {
    *root = a;
    return true;
  }
  if (lesser(a.f, b.f) > sag) return false;
  const double change = 0.5 * s->bound2 * width, bend = 0.5 * s->bound3 * width, middle = 0.5 * (a.th + b.th);
  const bool below = -b.f > s->noise, monotone = -greater(a.d1, b.d1) > change || lesser(a.d1, b.d1) > change,
             concave = -greater(a.d2, b.d2) > bend, convex = lesser(a.d2, b.d2) > bend;
  if (monotone || concave || sag <= s->noise || !(middle > a.th && middle < b.th)) {
    if (below) *root = falling_root(s, a, b);
    return below;
  }
  if (convex && !below) {
    if (a.d1 >= 0 || b.d1 <= 0) return false; /* monotone, both ends above */
    const guarded_point low = minimum(s, a, b);
    if (low.f >= -s->noise) return false;
    *root = falling_root(s, a, low);
    return true;
  }
  const guarded_point half = s->at(s->self, middle);
  return guarded_first(s, a, half, root) || guarded_first(s, half, b, root);
}

typedef struct guarded_motion {
  const series_vector *m;
  const guard *g;
  series_node last; /* node of the last evaluation */
} guarded_motion;

static guarded_point guard_at(const guard *g, const series_node *at)
{
  const double d2 = g->order == 0 ? guard_derivative(g, at, 2) : 0; /* order 1 would need x''', which a node does not
                                                                       hold */
  return (guarded_point){at->th, guard_value(g, at), guard_derivative(g, at, 1), d2};
}

static guarded_point motion_at(void *self, double th)
{
  guarded_motion *s = self;
  s->last = series_vector_at(s->m, th);
  return guard_at(s->g, &s->last);
}

bool crossing_first(const series_vector *m, const guard *g, const series_node *a, const series_node *b,
                    series_node *root)
{
  double width = b->th - a->th, sag = g->bound2 * width * width / 8;
  if (guard_value(g, a) > sag && guard_value(g, b) > sag) return false; /* the usual case, before nodes are copied */
  guarded_motion motion = {m, g, *a};
  const guarded s = {motion_at, &motion, g->noise, g->bound2, g->order ? INFINITY : g->bound3};
  guarded_point found;
  if (!guarded_first(&s, guard_at(g, a), guard_at(g, b), &found)) return false;
  *root = found.th == motion.last.th ? motion.last : series_vector_at(m, found.th);
  return true;
}

typedef struct range {
  double max, min, th_max, th_min;
} range;

static void take_in(range *r, double f, double th)
{
  if (f > r->max) r->max = f, r->th_max = th;
  if (f < r->min) r->min = f, r->th_min = th;
}

static double weighted(const series_vector *m, const double *a, const series_node *at)
{
  double f = 0;
  for (int d = 0; d < m->dim; ++d) f += a[d] * at->d[0][d];
  return f;
}

static range find_range(const series_vector *m, const double *a, double from, double to)
{
  const int n = (int)ceil(SERIES_GRID * (to - from) / TWO_PI);
  guard rising = guard_make(m, 1, a, 0), falling = guard_negative(&rising);
  series_node here = series_vector_at(m, from), root;
  range r = {weighted(m, a, &here), weighted(m, a, &here), from, from};
  for (int i = 1; i <= n; ++i) {
    const series_node next = series_vector_at(m, i < n ? from + (to - from) * i / n : to);
    /* between grid angles f' changes sign any number of times; every change is an extremum */
    for (bool up = guard_value(&rising, &here) > 0; crossing_first(m, up ? &rising : &falling, &here, &next, &root);
         up = !up) {
      take_in(&r, weighted(m, a, &root), root.th);
      if (!(root.th > here.th)) break; /* f' is 0 to rounding */
      here = root;
    }
    here = next;
    take_in(&r, weighted(m, a, &here), here.th);
  }
  return r;
}

void guard_extrema(const series_vector *m, const double *a, double from, double to, double *max, double *min)
{
  const range r = find_range(m, a, from, to);
  *max = r.max;
  *min = r.min;
}

void series_extrema(int n_harm, const double *X, double *max, double *min)
{
  const double one = 1;
  const series_vector m = {n_harm, 1, {X}};
  guard_extrema(&m, &one, 0, TWO_PI, max, min);
}

double series_amplitude_rate(int n_harm, const double *X, const double *dX)
{
  const double one = 1;
  const series_vector m = {n_harm, 1, {X}};
  const range r = find_range(&m, &one, 0, TWO_PI);
  return 0.5 * (series_at(n_harm, dX, cos(r.th_max), sin(r.th_max)).x -
                series_at(n_harm, dX, cos(r.th_min), sin(r.th_min)).x);
}
