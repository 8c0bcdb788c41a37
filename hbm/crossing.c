/* crossing.c - see crossing.h. An interval is proved free of crossings by the bound of f'', or proved monotone by
 * it, or proved convex by the bound of f'''; else it is halved. The proofs hold at once wherever the motion is
 * smooth on the scale of the interval. */
#include "hbm/crossing.h"

#include <float.h>
#include <math.h>

enum { MAX_DEPTH = 48, MAX_NEWTON = 60 };

motion_node motion_at(const motion *m, double th)
{
  motion_node node = {.th = th};
  double c = cos(th), s = sin(th);
  for (int d = 0; d < m->n_dof; ++d) {
    const double *X = m->X[d];
    double x = X[0], d1 = 0, d2 = 0, ch = 1, sh = 0;
    for (int h = 1; h <= m->n_harm; ++h) {
      double next = ch * c - sh * s;
      sh = ch * s + sh * c;
      ch = next;
      double even = X[2 * h - 1] * ch + X[2 * h] * sh, odd = X[2 * h] * ch - X[2 * h - 1] * sh;
      x += even;
      d1 += h * odd;
      d2 -= (double)h * h * even;
    }
    node.d[0][d] = x;
    node.d[1][d] = d1;
    node.d[2][d] = d2;
  }
  return node;
}

guard guard_make(const motion *m, int order, const double *a, double constant)
{
  guard g = {.n_dof = m->n_dof, .order = order, .constant = constant};
  for (int d = 0; d < m->n_dof; ++d) {
    g.a[d] = a[d];
    if (order == 0) g.mean += a[d] * m->X[d][0];
  }
  for (int h = 1; h <= m->n_harm; ++h) {
    double p = 0, q = 0, h2 = (double)h * h;
    for (int d = 0; d < m->n_dof; ++d) {
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
  for (int d = 0; d < g->n_dof; ++d) n.a[d] = -g->a[d];
  n.constant = -g->constant;
  n.mean = -g->mean;
  return n;
}

double guard_scale(const guard *g) { return g->size + fabs(g->mean) + fabs(g->constant); }

static double derivative(const guard *g, const motion_node *at, int k)
{
  double f = 0;
  for (int d = 0; d < g->n_dof; ++d) f += g->a[d] * at->d[g->order + k][d];
  return f;
}

double guard_value(const guard *g, const motion_node *at) { return derivative(g, at, 0) + g->constant; }

typedef struct search {
  const motion *m;
  const guard *g;
} search;

/* Root of f in [a, b], f falling through 0 once: Newton kept inside by bisection. */
static motion_node falling_root(const search *s, motion_node a, motion_node b)
{
  double fa = guard_value(s->g, &a), fb = guard_value(s->g, &b);
  if (!(fa > 0)) return a;
  motion_node x = motion_at(s->m, a.th + (b.th - a.th) * fa / (fa - fb));
  for (int it = 0; it < MAX_NEWTON; ++it) {
    double f = guard_value(s->g, &x), slope = derivative(s->g, &x, 1);
    if (f > 0) a = x;
    else b = x;
    double next = x.th - f / slope;
    /* first: at the root, next may be an end of the bracket */
    if (fabs(next - x.th) <= 2 * DBL_EPSILON * (1 + fabs(x.th))) break;
    bool inside = next > a.th && next < b.th;
    if (!inside) next = 0.5 * (a.th + b.th);
    double moved = next - x.th;
    x = motion_at(s->m, next);
    /* the error left is at most bound2 moved^2/(2 |slope|) */
    if (inside && s->g->bound2 * moved * moved <= 2 * DBL_EPSILON * fabs(slope)) break;
  }
  return x;
}

/* Minimum of f in [a, b], f convex there with f'(a) < 0 < f'(b). */
static motion_node minimum(const search *s, motion_node a, motion_node b)
{
  double da = derivative(s->g, &a, 1), db = derivative(s->g, &b, 1);
  motion_node x = motion_at(s->m, a.th + (b.th - a.th) * da / (da - db));
  for (int it = 0; it < MAX_NEWTON; ++it) {
    double slope = derivative(s->g, &x, 1);
    if (slope < 0) a = x;
    else b = x;
    double next = x.th;
    if (s->g->order == 0) next -= slope / derivative(s->g, &x, 2); /* no third derivative at hand for order 1 */
    bool newton = s->g->order == 0;
    if (newton && fabs(next - x.th) <= 1e-9) break; /* f is stationary: an error e costs f'' e^2/2 */
    if (!newton || !(next > a.th && next < b.th)) next = 0.5 * (a.th + b.th);
    if (fabs(next - x.th) <= 1e-9) break;
    x = motion_at(s->m, next);
  }
  return x;
}

/* fmin and fmax are calls, for the sake of NaN */
static inline double lesser(double x, double y) { return x < y ? x : y; }
static inline double greater(double x, double y) { return x > y ? x : y; }

static bool find(const search *s, motion_node a, motion_node b, int depth, motion_node *root)
{
  const guard *g = s->g;
  double fa = guard_value(g, &a), fb = guard_value(g, &b), width = b.th - a.th;
  if (fa < -g->noise) {
    *root = a;
    return true;
  }
  double sag = g->bound2 * width * width / 8;
  if (lesser(fa, fb) > sag) return false;
  double da = derivative(g, &a, 1), db = derivative(g, &b, 1), bend = 0.5 * g->bound2 * width;
  bool below = fb < -g->noise;
  bool falls = greater(da, db) + bend<0, rises = lesser(da, db) - bend> 0;
  if (falls || rises || sag <= g->noise || depth == 0) {
    if (below) *root = falling_root(s, a, b);
    return below;
  }
  if (g->order == 0 && lesser(derivative(g, &a, 2), derivative(g, &b, 2)) - 0.5 * g->bound3 * width > 0 && !below) {
    if (da >= 0 || db <= 0) return false; /* convex and monotone, both ends above */
    motion_node low = minimum(s, a, b);
    if (guard_value(g, &low) >= -g->noise) return false;
    *root = falling_root(s, a, low);
    return true;
  }
  motion_node middle = motion_at(s->m, 0.5 * (a.th + b.th));
  return find(s, a, middle, depth - 1, root) || find(s, middle, b, depth - 1, root);
}

bool crossing_first(const motion *m, const guard *g, const motion_node *a, const motion_node *b, motion_node *root)
{
  double width = b->th - a->th, sag = g->bound2 * width * width / 8;
  if (guard_value(g, a) > sag && guard_value(g, b) > sag) return false; /* nearly always: before anything is copied */
  search s = {m, g};
  return find(&s, *a, *b, MAX_DEPTH, root);
}
