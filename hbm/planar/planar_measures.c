/* planar_measures.c - see planar_measures.h. The largest traction of an interval is a maximum of R, or of |u - w|^2, a
 * trigonometric polynomial of degree 2H. */
#include "hbm/planar/planar_measures.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/hbm_settings.h"
#include "hbm/planar/planar_force.h"
#include "numerics/crossing.h"
#include "numerics/series.h"

enum { N = COLLOCATION_POINTS };

/* square += (X - constant)^2, a series of 2 n_harm harmonics by the product formulas of cosines and sines. */
static void add_square(int n_harm, const double *X, double constant, double *square)
{
  const double mean = X[0] - constant;
  square[0] += mean * mean;
  for (int p = 1; p <= n_harm; ++p) {
    const double a = X[2 * p - 1], b = X[2 * p];
    square[2 * p - 1] += 2 * mean * a;
    square[2 * p] += 2 * mean * b;
    for (int q = 1; q <= n_harm; ++q) {
      const double c = X[2 * q - 1], d = X[2 * q];
      square[2 * (p + q) - 1] += 0.5 * (a * c - b * d);
      square[2 * (p + q)] += 0.5 * (a * d + b * c);
      if (p == q) square[0] += 0.5 * (a * c + b * d);
      if (p <= q) continue; /* each difference once, for p > q, and twice as large */
      square[2 * (p - q) - 1] += a * c + b * d;
      square[2 * (p - q)] += b * c - a * d;
    }
  }
}

/* The largest |u - w| of a stick interval; square[4 n_harm + 1]: work. */
static double stick_distance(const planar_motion *m, const planar_interval *p, double *square)
{
  const double one = 1;
  const series_vector of_square = {2 * m->n_harm, 1, {square}};
  double most, least;
  memset(square, 0, (size_t)series_length(2 * m->n_harm) * sizeof *square);
  for (int d = 0; d < 2; ++d) add_square(m->n_harm, m->u[d], p->w[d], square);
  guard_extrema(&of_square, &one, p->from, p->to, &most, &least);
  return sqrt(fmax(most, 0));
}

/* The largest R of a slip interval. */
static double slip_distance(const planar_motion *m, const planar_interval *p)
{
  const series_vector of_v = {m->n_harm, 1, {m->v}};
  double most, least;
  if (!m->v) return m->rest;
  guard_extrema(&of_v, &m->per_v, p->from, p->to, &most, &least);
  return most + m->rest;
}

/* sum[0] += length of the path of w on a panel, sum[1] += integral of R |dw|. */
static void add_panel(const planar_cycle *c, const planar_panel *p, double sum[2])
{
  const collocation *rule = c->slip.c;
  const double width = p->to - p->from;
  for (int i = 0; i < N; ++i) {
    const planar_point at = planar_motion_at(c->m, p->from + width * rule->x[i]);
    const double path = width * rule->a[N - 1][i] * planar_slip_speed(&at, p->phi[i]);
    sum[0] += path;
    sum[1] += at.R * path;
  }
}

static hc_status measure(const contact *half, int n_harm, int n_dof, const double *X, double *F, double *square,
                         contact_period out[2])
{
  const int n = series_length(n_harm);
  planar_force *f;
  double most, least;
  hc_status st = planar_force_new(n_harm, n_dof, half, &f);
  if (st != HC_OK) return st;
  contact_report report;
  st = planar_force_eval(f, X, F, NULL, &report);
  if (st == HC_OK) {
    const planar_cycle *c = planar_force_cycle(f);
    series_extrema(n_harm, X + 2 * n, &most, &least);
    out[0].regime = report.regime;
    out[0].normal_min = contact_normal(half, least);
    out[0].normal_max = contact_normal(half, most);
    out[1] = out[0];
    double sum[2] = {0}, distance = 0;
    for (int i = 0; i < c->n; ++i) {
      const planar_interval *p = &c->interval[i];
      const bool sticks = p->state == CONTACT_STICK;
      distance = fmax(distance, sticks ? stick_distance(c->m, p, square) : slip_distance(c->m, p));
      for (int k = p->panel; k < p->panel + p->n_panels; ++k) add_panel(c, &c->slip.panel[k], sum);
    }
    /* |u - w| may exceed the limit by rounding where stick becomes slip */
    out[0].traction_max = fmin(half->kt * distance, half->mu * out[0].normal_max);
    out[0].slip_distance = sum[0];
    out[0].work = half->kt * sum[1];
  }
  planar_force_free(f);
  return st;
}

hc_status planar_measures_of(const contact *half, int n_harm, const double *u1, const double *u2, const double *v,
                             contact_period out[2])
{
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS) return HC_BAD_INPUT;
  const int n = series_length(n_harm);
  const double *const given[] = {u1, u2, v};
  double *X = calloc(8 * (size_t)n, sizeof *X);
  out[0] = out[1] = (contact_period){.regime = CONTACT_LINEAR};
  if (!X) return HC_NO_MEMORY;
  for (int d = 0; d < 3; ++d) memcpy(X + d * n, given[d], (size_t)n * sizeof *X);
  const hc_status st = measure(half, n_harm, half->kn > 0 ? 3 : 2, X, X + 3 * n, X + 6 * n, out);
  free(X);
  return st;
}
