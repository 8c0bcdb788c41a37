/* crossing.c - see crossing.h. An interval is proved free of crossings by the bound of f'', or proved monotone by
 * it, or proved convex by the bound of f'''; else it is halved. No halving is needed where the motion is smooth on the
 * scale of the interval. */
#include "numerics/crossing.h"

#include <float.h>
#include <math.h>

#include "numerics/base/constants.h"

enum { MAX_DEPTH = 48, MAX_NEWTON = 60 };

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

static double guard_derivative(const guard *g, const series_node *at, int k)
{
  double f = 0;
  for (int d = 0; d < g->dim; ++d) f += g->a[d] * at->d[g->order + k][d];
  return f;
}

double guard_value(const guard *g, const series_node *at) { return guard_derivative(g, at, 0) + g->constant; }

typedef struct guarded_motion {
  const series_vector *m;
  const guard *g;
} guarded_motion;

/* Root of f in [a, b], f falling through 0 once: Newton kept inside by bisection. */
static series_node falling_root(const guarded_motion *s, series_node a, series_node b)
{
  double fa = guard_value(s->g, &a), fb = guard_value(s->g, &b);
  if (!(fa > 0)) return a;
  series_node x = series_vector_at(s->m, a.th + (b.th - a.th) * fa / (fa - fb));
  for (int it = 0; it < MAX_NEWTON; ++it) {
    double f = guard_value(s->g, &x), derivative = guard_derivative(s->g, &x, 1);
    if (f > 0) a = x;
    else b = x;
    double next = x.th - f / derivative;
    /* before the bracket is looked at: at the root, next may be an end of it */
    if (fabs(next - x.th) <= 2 * DBL_EPSILON * (1 + fabs(x.th))) break;
    bool inside = next > a.th && next < b.th;
    if (!inside) next = 0.5 * (a.th + b.th);
    double moved = next - x.th;
    x = series_vector_at(s->m, next);
    /* the error left is at most bound2 moved^2/(2 |derivative|) */
    if (inside && s->g->bound2 * moved * moved <= 2 * DBL_EPSILON * fabs(derivative)) break;
  }
  return x;
}

/* Minimum of f in [a, b], f convex there with f'(a) < 0 < f'(b). */
static series_node minimum(const guarded_motion *s, series_node a, series_node b)
{
  double da = guard_derivative(s->g, &a, 1), db = guard_derivative(s->g, &b, 1);
  series_node x = series_vector_at(s->m, a.th + (b.th - a.th) * da / (da - db));
  for (int it = 0; it < MAX_NEWTON; ++it) {
    double derivative = guard_derivative(s->g, &x, 1);
    if (derivative < 0) a = x;
    else b = x;
    double next = x.th;
    bool newton = s->g->order == 0; /* order 1 would need a third derivative of the motion, which a node has not */
    if (newton) next -= derivative / guard_derivative(s->g, &x, 2);
    if (newton && fabs(next - x.th) <= 1e-9) break; /* f is stationary: an error e of the angle makes f'' e^2/2 in f */
    if (!newton || !(next > a.th && next < b.th)) next = 0.5 * (a.th + b.th);
    if (fabs(next - x.th) <= 1e-9) break;
    x = series_vector_at(s->m, next);
  }
  return x;
}

/* fmin and fmax are function calls, since they treat NaN specially; nothing here is NaN. */
static inline double lesser(double x, double y) { return x < y ? x : y; }
static inline double greater(double x, double y) { return x > y ? x : y; }

/* Is f'' > 0 between a and b by the bound of f'''? Order 0 only. */
static bool is_convex(const guard *g, const series_node *a, const series_node *b)
{
  double least = lesser(guard_derivative(g, a, 2), guard_derivative(g, b, 2));
  return least - 0.5 * g->bound3 * (b->th - a->th) > 0;
}

/* crossing_first by at most `depth` halvings; at the last, ends of different sign are taken for one crossing, and ends
 * of the same sign for none. */
static bool find_first(const guarded_motion *s, series_node a, series_node b, int depth, series_node *root)
{
  const guard *g = s->g;
  double fa = guard_value(g, &a), fb = guard_value(g, &b), width = b.th - a.th;
  if (fa < -g->noise) {
    *root = a;
    return true;
  }
  double sag = g->bound2 * width * width / 8; /* f is at most this far from its chord */
  if (lesser(fa, fb) > sag) return false;
  double da = guard_derivative(g, &a, 1), db = guard_derivative(g, &b, 1), change = 0.5 * g->bound2 * width;
  bool below = fb < -g->noise;
  bool falls = greater(da, db)<-change, rises = lesser(da, db)> change;
  if (falls || rises || sag <= g->noise || depth == 0) {
    if (below) *root = falling_root(s, a, b);
    return below;
  }
  if (g->order == 0 && !below && is_convex(g, &a, &b)) {
    if (da >= 0 || db <= 0) return false; /* convex and monotone, both ends above */
    series_node low = minimum(s, a, b);
    if (guard_value(g, &low) >= -g->noise) return false;
    *root = falling_root(s, a, low);
    return true;
  }
  series_node middle = series_vector_at(s->m, 0.5 * (a.th + b.th));
  return find_first(s, a, middle, depth - 1, root) || find_first(s, middle, b, depth - 1, root);
}

bool crossing_first(const series_vector *m, const guard *g, const series_node *a, const series_node *b,
                    series_node *root)
{
  double width = b->th - a->th, sag = g->bound2 * width * width / 8;
  if (guard_value(g, a) > sag && guard_value(g, b) > sag) return false; /* the usual case, before nodes are copied */
  guarded_motion s = {m, g};
  return find_first(&s, *a, *b, MAX_DEPTH, root);
}

typedef struct range {
  double max, min;
} range;

static void take_in(range *r, double f)
{
  if (f > r->max) r->max = f;
  if (f < r->min) r->min = f;
}

static double weighted(const series_vector *m, const double *a, const series_node *at)
{
  double f = 0;
  for (int d = 0; d < m->dim; ++d) f += a[d] * at->d[0][d];
  return f;
}

void guard_extrema(const series_vector *m, const double *a, double from, double to, double *max, double *min)
{
  const int n = (int)ceil(SERIES_GRID * (to - from) / TWO_PI);
  guard rising = guard_make(m, 1, a, 0), falling = guard_negative(&rising);
  series_node here = series_vector_at(m, from), root;
  range r = {weighted(m, a, &here), weighted(m, a, &here)};
  for (int i = 1; i <= n; ++i) {
    const series_node next = series_vector_at(m, i < n ? from + (to - from) * i / n : to);
    /* between grid angles f' changes sign any number of times; every change is an extremum */
    for (bool up = guard_value(&rising, &here) > 0; crossing_first(m, up ? &rising : &falling, &here, &next, &root);
         up = !up) {
      take_in(&r, weighted(m, a, &root));
      if (!(root.th > here.th)) break; /* f' is 0 to rounding */
      here = root;
    }
    here = next;
    take_in(&r, weighted(m, a, &here));
  }
  *max = r.max;
  *min = r.min;
}

void series_extrema(int n_harm, const double *X, double *max, double *min)
{
  const double one = 1;
  const series_vector m = {n_harm, 1, {X}};
  guard_extrema(&m, &one, 0, TWO_PI, max, min);
}
