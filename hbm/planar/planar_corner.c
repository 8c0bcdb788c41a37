/* planar_corner.c - see planar_corner.h. h is convex in w, so that Newton from outside both circles comes to the corner
 * without passing it; beyond the line through their centres it would look for the other one. */
#include "hbm/planar/planar_corner.h"

#include <float.h>

enum { MAX_NEWTON = 60, MAX_ANGLE_STEPS = 8 };

/* Circle i at the angle where |u - w| - R is largest, near c->at[i].th; false if there is none. */
static bool touch(const planar_motion *m, planar_corner *c, int i, double *h)
{
  double th = c->at[i].th;
  for (int k = 0; k < MAX_ANGLE_STEPS; ++k) {
    const planar_point p = planar_motion_at(m, th);
    const double t1 = p.u[0] - c->w[0], t2 = p.u[1] - c->w[1], length = hypot(t1, t2);
    const double e1 = t1 / length, e2 = t2 / length, across = p.du[1] * e1 - p.du[0] * e2;
    const double speed = p.du[0] * e1 + p.du[1] * e2 - p.dR,
                 change = p.ddu[0] * e1 + p.ddu[1] * e2 + across * across / length - p.ddR;
    c->at[i] = p;
    c->e[i][0] = e1, c->e[i][1] = e2;
    *h = length - p.R;
    if (!(change < 0)) return false;
    if (fabs(speed) <= 1e-9 * -change) return true; /* h is stationary: an error d of the angle makes h'' d^2/2 in it */
    th -= speed / change;
  }
  return false;
}

/* sin of the angle from e_1 to e_2: 0 where the circles touch from outside, its sign tells the corner. */
static double opening(const planar_corner *c) { return c->e[0][0] * c->e[1][1] - c->e[0][1] * c->e[1][0]; }

void planar_corner_move(const planar_corner *c, const double grows[2], double dw[2])
{
  const double det = opening(c);
  dw[0] = (c->e[1][1] * grows[0] - c->e[0][1] * grows[1]) / det;
  dw[1] = (c->e[0][0] * grows[1] - c->e[1][0] * grows[0]) / det;
}

bool planar_corner_find(const planar_motion *m, const double w[2], const double th[2], planar_corner *out)
{
  const double size = m->of_u[0] + m->of_R[0];
  double side = 0, h[2], dw[2];
  *out = (planar_corner){.w = {w[0], w[1]}, .at = {{.th = th[0]}, {.th = th[1]}}};
  for (int i = 0; i < MAX_NEWTON; ++i) {
    if (!touch(m, out, 0, &h[0]) || !touch(m, out, 1, &h[1])) return false;
    if (i == 0) side = opening(out);
    if (!(opening(out) * side > 0)) return false;
    if (fabs(h[0]) + fabs(h[1]) <= 2 * DBL_EPSILON * size) return true;
    planar_corner_move(out, h, dw);
    if (!(hypot(dw[0], dw[1]) <= size)) return false;
    for (int d = 0; d < 2; ++d) out->w[d] += dw[d];
  }
  return false;
}

/* A part d of omega from the edge X differs by about sqrt(d): the longest step, 1e-3, goes with 3e-2 of X, the
 * shortest, 1e-7, with 3e-4, some times the steps at a corner. A solution on the other side of the edge is off the last
 * segment by about as much as the step is long; one that is off it by 5 % of that at most lies on the curve already.
 * Where the branch turns back three solutions coexist, over 1.2e-6 of omega in space_F0.1: an edge's place is told to
 * that. 60 halvings pass the last bit of omega; 100 edges bound the work of a curve that chatters. */
const slip_edges planar_edges = {.too_short = 1e-6,
                                 .first = 1e-7,
                                 .last = 1e-3,
                                 .widest = 3e-2,
                                 .traced = 0.05,
                                 .located = 1e-6,
                                 .most = 100,
                                 .bisections = 60};
