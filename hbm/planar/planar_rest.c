/* planar_rest.c - see planar_rest.h. */
#include "hbm/planar/planar_rest.h"

#include <float.h>

enum { MAX_EXCHANGES = 100 };

static double outside(const planar_point *disc, const double w[2])
{
  return hypot(disc->u[0] - w[0], disc->u[1] - w[1]) - disc->R;
}

/* Of the candidates for the next place the best so far. */
typedef struct choice {
  const planar_point *disc[3]; /* the new one, and those that held the place before */
  int n;
  double noise, excluded; /* [length] the most that one of them excludes the best one by; 0 for all below noise */
  planar_rest best;
} choice;

/* The point w, at which disc[0] and, if j > 0, disc[j] hold it. */
static void consider(choice *c, const double w[2], int j)
{
  double worst = 0;
  for (int i = 0; i < c->n; ++i) worst = fmax(worst, outside(c->disc[i], w));
  if (worst <= c->noise) worst = 0;
  const bool nearer = hypot(w[0], w[1]) < hypot(c->best.w[0], c->best.w[1]);
  if (!(worst < c->excluded || (worst == 0 && c->excluded == 0 && nearer))) return;
  c->excluded = worst;
  c->best =
      (planar_rest){.exists = worst == 0, .w = {w[0], w[1]}, .n = j > 0 ? 2 : 1, .at = {*c->disc[0], *c->disc[j]}};
}

/* The point of disc[0] nearest to 0. */
static void consider_alone(choice *c)
{
  const planar_point *a = c->disc[0];
  const double length = hypot(a->u[0], a->u[1]), part = length > a->R ? 1 - a->R / length : 0;
  consider(c, (double[2]){part * a->u[0], part * a->u[1]}, 0);
}

/* dw with e_1.dw = away_1, e_2.dw = away_2, of unit vectors. The sine of the angle between them is 0 where discs touch
 * from outside, where their corner moves like a root; nearer than the root of rounding it is not told from that. */
static void move_corner(const double e_1[2], const double e_2[2], double away_1, double away_2, double dw[2])
{
  const double sine = e_1[0] * e_2[1] - e_1[1] * e_2[0];
  const double det = copysign(fmax(fabs(sine), sqrt(DBL_EPSILON)), sine);
  dw[0] = (e_2[1] * away_1 - e_1[1] * away_2) / det;
  dw[1] = (e_1[0] * away_2 - e_2[0] * away_1) / det;
}

/* |u - w| - R and the direction of u - w. */
static double direction(const planar_point *disc, const double w[2], double e[2])
{
  const double t1 = disc->u[0] - w[0], t2 = disc->u[1] - w[1], length = fmax(hypot(t1, t2), DBL_MIN);
  e[0] = t1 / length, e[1] = t2 / length;
  return length - disc->R;
}

/* Both corners of disc[0] and disc[j]; the middle of the gap where there is one. With D the distance of the centres the
 * corners are +-a off the line through them,
 *     4 D^2 a^2 = (R_1 + R_2 - D) (R_1 + R_2 + D) (D + R_1 - R_2) (D - R_1 + R_2),
 * of discs that are nearly the same to rounding over D/R: then Newton. */
static void consider_corners(choice *c, int j)
{
  enum { NEWTON_STEPS = 2 };
  const planar_point *a = c->disc[0], *b = c->disc[j];
  const double way[2] = {b->u[0] - a->u[0], b->u[1] - a->u[1]}, D = hypot(way[0], way[1]), gap = D - a->R - b->R;
  const double squared = -gap * (a->R + b->R + D) * (D + a->R - b->R) * (D - a->R + b->R);
  if (!(D > fabs(a->R - b->R))) return; /* one lies in the other */
  const double off = squared > 0 ? 0.5 * sqrt(squared) / D : 0;
  const double along = gap > 0 ? a->R + 0.5 * gap : 0.5 * (D + (a->R - b->R) * (a->R + b->R) / D);
  for (int side = -1; side <= 1; side += 2) {
    double w[2] = {a->u[0] + (along * way[0] - side * off * way[1]) / D,
                   a->u[1] + (along * way[1] + side * off * way[0]) / D};
    for (int i = 0; i < NEWTON_STEPS && off > 0; ++i) {
      double e[2][2], dw[2];
      const double h[] = {direction(a, w, e[0]), direction(b, w, e[1])};
      move_corner(e[0], e[1], h[0], h[1], dw);
      w[0] += dw[0], w[1] += dw[1];
    }
    consider(c, w, j);
  }
}

/* w moves to the nearest point of its discs and `next`; or, not `exists`, to the one that they exclude least. */
static void exchange(planar_rest *r, const planar_point *next, double noise)
{
  const planar_rest before = *r;
  choice c = {.disc = {next, &before.at[0], &before.at[1]}, .n = 1 + before.n, .noise = noise, .excluded = INFINITY};
  consider_alone(&c);
  for (int j = 1; j <= before.n; ++j) consider_corners(&c, j);
  *r = c.best;
}

hc_status planar_rest_find(planar_farthest *farthest, void *self, double noise, planar_rest *out)
{
  bool ended = false;
  *out = (planar_rest){.exists = true};
  for (int i = 0; i < MAX_EXCHANGES && !ended; ++i) {
    planar_point next;
    ended = farthest(self, out->w, NULL, &next) <= noise;
    if (ended) break;
    exchange(out, &next, noise);
    ended = !out->exists;
  }
  for (int i = 0; i < out->n; ++i) { /* where h is largest at w itself: so far, at the one before the last exchange */
    const planar_point before = out->at[i];
    if (out->exists) farthest(self, out->w, &before, &out->at[i]);
    direction(&out->at[i], out->w, out->e[i]);
  }
  return ended ? HC_OK : HC_NOT_CONVERGED;
}

/* ---- how it moves ---------------------------------------------------------------------------------------- */

/* w = k R e, R = |u - w|, e its direction. Along e w moves with the disc; across, e turns, and the instant shifts, by
 * dth: with U = u'.e_perp, B = -h'' > 0 and q = dw.e_perp
 *
 *     q = k (across + U dth - q),      B dth = rate + U (across - q)/R
 *
 * At an instant of which B is 0 to rounding, as of samples, dth = 0. */
static void move_on_circle(const planar_rest *r, const planar_disc_change *change, double dw[2])
{
  const planar_point *p = &r->at[0];
  const double *e = r->e[0], k = (r->w[0] * e[0] + r->w[1] * e[1]) / p->R, U = p->du[1] * e[0] - p->du[0] * e[1];
  const double terms[] = {p->ddu[0] * e[0] + p->ddu[1] * e[1], U * U / p->R, -p->ddR};
  const double B = -(terms[0] + terms[1] + terms[2]);
  const bool shifts = B > 16 * DBL_EPSILON * (fabs(terms[0]) + terms[1] + fabs(terms[2]));
  const double shift = shifts ? (change->rate + U * change->across / p->R) / B : 0;
  const double q = k * (change->across + U * shift) / (1 + k + (shifts ? k * U * U / (p->R * B) : 0));
  dw[0] = change->away * e[0] - q * e[1];
  dw[1] = change->away * e[1] + q * e[0];
}

void planar_rest_move(const planar_rest *r, const planar_disc_change *change, double dw[2])
{
  dw[0] = dw[1] = 0;
  if (r->n == 1) move_on_circle(r, change, dw);
  /* h_i = 0 at an instant where it is largest, whose own shift changes nothing to first order. */
  if (r->n == 2) move_corner(r->e[0], r->e[1], change[0].away, change[1].away, dw);
}

/* 100 joins bound the work of a curve that chatters; 60 halvings pass the last bit of omega. */
const slip_edges planar_edges = {.too_short = 1e-4, .located = 1e-6, .most = 100, .bisections = 60};
