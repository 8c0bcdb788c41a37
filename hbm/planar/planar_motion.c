/* planar_motion.c - see planar_motion.h. */
#include "hbm/planar/planar_motion.h"

#include <float.h>

#include "numerics/rotate.h"
#include "numerics/wide_vectors.h"

/* bound[k] += factor times a bound of the k-th derivative's modulus. */
static void add_bounds(int n_harm, const double *X, double factor, double bound[4])
{
  bound[0] += factor * fabs(X[0]);
  for (int h = 1; h <= n_harm; ++h) {
    double size = factor * hypot(X[2 * h - 1], X[2 * h]);
    for (int k = 0; k < 4; ++k, size *= h) bound[k] += size;
  }
}

planar_motion planar_motion_make(const contact *law, int n_harm, const double *u1, const double *u2, const double *v)
{
  planar_motion m = {.n_harm = n_harm, .u = {u1, u2}, .v = v};
  m.rest = law->mu * (law->load + law->kn * law->gap) / law->kt;
  m.of_R[0] = fabs(m.rest);
  if (v) {
    m.per_v = law->mu * law->kn / law->kt;
    add_bounds(n_harm, v, m.per_v, m.of_R);
  }
  for (int d = 0; d < 2; ++d) add_bounds(n_harm, m.u[d], 1, m.of_u);
  return m;
}

/* Value and two derivatives of one series at the angle whose cosines and sines are in turn[]. */
static void sum(const planar_motion *m, const double *X, const double *turn, double *x, double *dx, double *ddx)
{
  double value = X[0], first = 0, second = 0;
  for (int h = 1; h <= m->n_harm; ++h) {
    const double c = turn[2 * h - 1], s = turn[2 * h];
    const double even = X[2 * h - 1] * c + X[2 * h] * s, odd = X[2 * h] * c - X[2 * h - 1] * s;
    value += even;
    first += h * odd;
    second -= (double)h * h * even;
  }
  *x = value, *dx = first, *ddx = second;
}

planar_point planar_motion_at(const planar_motion *m, double th)
{
  enum { MOST = 200 };
  double turn[2 * MOST + 1], c = cos(th), s = sin(th), ch = 1, sh = 0;
  planar_point p = {.th = th};
  for (int h = 1; h <= m->n_harm; ++h) {
    series_turn(c, s, &ch, &sh);
    turn[2 * h - 1] = ch, turn[2 * h] = sh;
  }
  for (int d = 0; d < 2; ++d) sum(m, m->u[d], turn, &p.u[d], &p.du[d], &p.ddu[d]);
  p.R = m->rest;
  if (!m->v) return p;
  double v, dv, ddv;
  sum(m, m->v, turn, &v, &dv, &ddv);
  p.R += m->per_v * v;
  p.dR = m->per_v * dv;
  p.ddR = m->per_v * ddv;
  return p;
}

WIDE_VECTORS void planar_motion_rates(const planar_motion *m, const collocation *k, double from, double to,
                                      planar_rates *r)
{
  enum { N = COLLOCATION_POINTS };
  const double width = to - from, middle = from + 0.5 * width;
  double x[N], c[N], s[N], ch[N], sh[N], v[N] = {0}, dv[N] = {0};
  for (int i = 0; i < N; ++i) x[i] = width * (k->x[i] - 0.5);
  rotate(N, cos(middle), sin(middle), x, c, s);
  for (int i = 0; i < N; ++i) r->th[i] = middle + x[i], r->du[0][i] = r->du[1][i] = 0, ch[i] = 1, sh[i] = 0;
  r->th[N - 1] = to;
  for (int h = 1; h <= m->n_harm; ++h) {
    const double a0 = h * m->u[0][2 * h - 1], b0 = h * m->u[0][2 * h], a1 = h * m->u[1][2 * h - 1],
                 b1 = h * m->u[1][2 * h];
    for (int i = 0; i < N; ++i) {
      series_turn(c[i], s[i], &ch[i], &sh[i]);
      r->du[0][i] += b0 * ch[i] - a0 * sh[i];
      r->du[1][i] += b1 * ch[i] - a1 * sh[i];
    }
    const double a = m->v ? m->v[2 * h - 1] : 0, b = m->v ? m->v[2 * h] : 0;
    for (int i = 0; i < N; ++i) {
      v[i] += a * ch[i] + b * sh[i];
      dv[i] += h * (b * ch[i] - a * sh[i]);
    }
  }
  const double rest = m->v ? m->rest + m->per_v * m->v[0] : m->rest;
  for (int i = 0; i < N; ++i) r->R[i] = rest + m->per_v * v[i], r->dR[i] = m->per_v * dv[i];
}

void planar_motion_grid(const planar_motion *m, const double *table, planar_point grid[PLANAR_GRID])
{
  const series_vector of_u = {m->n_harm, 2, {m->u[0], m->u[1]}}, of_v = {m->n_harm, 1, {m->v}};
  series_grid of;
  series_grid_fill(&of, &of_u, table);
  for (int i = 0; i < PLANAR_GRID; ++i) {
    const series_node *at = &of.node[i];
    grid[i] = (planar_point){.th = at->th, .R = m->rest};
    for (int d = 0; d < 2; ++d) grid[i].u[d] = at->d[0][d], grid[i].du[d] = at->d[1][d], grid[i].ddu[d] = at->d[2][d];
  }
  if (!m->v) return;
  series_grid_fill(&of, &of_v, table);
  for (int i = 0; i < PLANAR_GRID; ++i) {
    const series_node *at = &of.node[i];
    grid[i].R += m->per_v * at->d[0][0];
    grid[i].dR = m->per_v * at->d[1][0];
    grid[i].ddR = m->per_v * at->d[2][0];
  }
}

double planar_motion_noise(const planar_motion *m) { return 16 * DBL_EPSILON * (m->of_u[0] + m->of_R[0]); }
