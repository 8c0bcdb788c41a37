/* planar_stick.c - see planar_stick.h. g is computed as (R - |u - w|)(R + |u - w|): its terms are as large as the
 * squares of u, however small R is, and their difference would be rounding. */
#include "hbm/planar/planar_stick.h"

#include <float.h>
#include <math.h>

#include "base/constants.h"

enum { MAX_DEPTH = 48, MAX_STEPS = 60 };

typedef struct stick_guard {
  const planar_motion *m;
  double w[2];
  double noise, bound2, bound3; /* |g| below noise is not distinguished from 0; bounds of |g''|, |g'''| */
} stick_guard;

typedef struct guarded_point {
  planar_point p;
  double g, dg, ddg;
} guarded_point;

static guarded_point guard_at(const stick_guard *s, const planar_point *p)
{
  const double t1 = p->u[0] - s->w[0], t2 = p->u[1] - s->w[1], size = sqrt(t1 * t1 + t2 * t2);
  guarded_point a = {.p = *p};
  a.g = (p->R - size) * (p->R + size);
  a.dg = 2 * (p->R * p->dR - t1 * p->du[0] - t2 * p->du[1]);
  a.ddg =
      2 * (p->dR * p->dR + p->R * p->ddR - p->du[0] * p->du[0] - p->du[1] * p->du[1] - t1 * p->ddu[0] - t2 * p->ddu[1]);
  return a;
}

static guarded_point guard_new_at(const stick_guard *s, double th)
{
  const planar_point p = planar_motion_at(s->m, th);
  return guard_at(s, &p);
}

/* On an interval of the grid that begins in stick |u - w| grows to no more than the largest R and what u moves. */
static stick_guard make_guard(const planar_motion *m, const double w[2])
{
  const double *U = m->of_u, *R = m->of_R, step = TWO_PI / SERIES_GRID;
  const double pulled = fmin(R[0] + U[1] * step, U[0] + hypot(w[0], w[1]));
  stick_guard s = {.m = m, .w = {w[0], w[1]}};
  s.bound2 = 2 * (R[1] * R[1] + R[0] * R[2] + U[1] * U[1] + pulled * U[2]);
  s.bound3 = 2 * (3 * R[1] * R[2] + R[0] * R[3] + 3 * U[1] * U[2] + pulled * U[3]);
  s.noise = DBL_EPSILON * R[0] * (32 * (U[0] + hypot(w[0], w[1]) + R[0]) + 64 * (R[1] + U[1]));
  return s;
}

/* Root of g in [a, b], falling through 0 once, perhaps after it has risen: Newton kept inside by bisection. */
static guarded_point falling_root(const stick_guard *s, guarded_point a, guarded_point b)
{
  if (!(a.g > 0) && !(a.dg > 0)) return a;
  const bool rises = a.dg > 0;
  guarded_point x = guard_new_at(s, a.p.th + (b.p.th - a.p.th) * (rises ? 0.5 : a.g / (a.g - b.g)));
  for (int i = 0; i < MAX_STEPS; ++i) {
    if (x.g > 0 || x.dg > 0) a = x;
    else b = x;
    const double newton = x.p.th - x.g / x.dg;
    if (x.dg < 0 && fabs(newton - x.p.th) <= 2 * DBL_EPSILON * (1 + fabs(x.p.th))) break;
    const bool inside = x.dg < 0 && newton > a.p.th && newton < b.p.th;
    const double next = inside ? newton : 0.5 * (a.p.th + b.p.th), moved = next - x.p.th;
    if (fabs(moved) <= DBL_EPSILON * fabs(next)) break;
    x = guard_new_at(s, next);
    if (inside && s->bound2 * moved * moved <= 2 * DBL_EPSILON * fabs(x.dg)) break; /* Newton's error after this step */
  }
  return x;
}

/* Minimum of g in [a, b], g being convex there with g'(a) < 0 < g'(b). */
static guarded_point minimum(const stick_guard *s, guarded_point a, guarded_point b)
{
  guarded_point x = guard_new_at(s, a.p.th + (b.p.th - a.p.th) * a.dg / (a.dg - b.dg));
  for (int i = 0; i < MAX_STEPS; ++i) {
    if (x.dg < 0) a = x;
    else b = x;
    double next = x.p.th - x.dg / x.ddg;
    if (fabs(next - x.p.th) <= 1e-9) break; /* g is stationary: an error e of the angle makes g'' e^2/2 in g */
    if (!(next > a.p.th && next < b.p.th)) next = 0.5 * (a.p.th + b.p.th);
    if (fabs(next - x.p.th) <= 1e-9) break;
    x = guard_new_at(s, next);
  }
  return x;
}

static bool find_first(const stick_guard *s, guarded_point a, guarded_point b, int depth, guarded_point *root)
{
  const double width = b.p.th - a.p.th, sag = s->bound2 * width * width / 8, change = 0.5 * s->bound2 * width,
               bend = 0.5 * s->bound3 * width;
  if (a.g < -s->noise) {
    *root = a;
    return true;
  }
  if (a.g > sag && b.g > sag) return false;
  const bool below = b.g < -s->noise, monotone = fmax(a.dg, b.dg) < -change || fmin(a.dg, b.dg) > change,
             concave = fmax(a.ddg, b.ddg) + bend<0, convex = fmin(a.ddg, b.ddg) - bend> 0;
  if (monotone || concave || sag <= s->noise || depth == 0) {
    if (below) *root = falling_root(s, a, b);
    return below;
  }
  if (convex && !below) {
    if (a.dg >= 0 || b.dg <= 0) return false;
    const guarded_point low = minimum(s, a, b);
    if (low.g >= -s->noise) return false;
    *root = falling_root(s, a, low);
    return true;
  }
  const guarded_point middle = guard_new_at(s, 0.5 * (a.p.th + b.p.th));
  return find_first(s, a, middle, depth - 1, root) || find_first(s, middle, b, depth - 1, root);
}

bool planar_stick_ends(const planar_motion *m, const planar_point *grid, const double w[2], const planar_point *from,
                       double to, planar_point *root)
{
  const stick_guard s = make_guard(m, w);
  const planar_point *next = grid + (int)(from->th * (SERIES_GRID / TWO_PI));
  guarded_point a = guard_at(&s, from), found;
  while (next->th <= a.p.th) ++next;
  while (a.p.th < to) {
    const planar_point end = next->th < to ? *next : planar_motion_at(m, to);
    const guarded_point b = guard_at(&s, &end);
    if (find_first(&s, a, b, MAX_DEPTH, &found)) {
      *root = found.p;
      return true;
    }
    a = b;
    ++next;
  }
  return false;
}
