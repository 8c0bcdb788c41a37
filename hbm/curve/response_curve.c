/* response_curve.c - see response_curve.h. */
#include "hbm/curve/response_curve.h"

#include <stdlib.h>
#include <string.h>

static hc_status double_capacity(hbm_curve *c)
{
  size_t cap = c->cap ? 2 * (size_t)c->cap : 128, row = (size_t)c->n_coef * sizeof(double);
  hbm_point *points = realloc(c->points, cap * sizeof *points);
  if (points) c->points = points;
  double *X = realloc(c->X, cap * row);
  if (X) c->X = X;
  double *dX = realloc(c->dX, cap * row);
  if (dX) c->dX = dX;
  if (!points || !X || !dX) return HC_NO_MEMORY;
  c->cap = (int)cap;
  return HC_OK;
}

hc_status hbm_curve_append(hbm_curve *c, int n_coef, const double *X, const double *dX, const hbm_point *point)
{
  c->n_coef = n_coef;
  if (c->n == c->cap && double_capacity(c) != HC_OK) return HC_NO_MEMORY;
  size_t row = (size_t)n_coef * sizeof(double);
  c->points[c->n] = *point;
  memcpy(hbm_curve_X(c, c->n), X, row);
  memcpy(hbm_curve_dX(c, c->n), dX, row);
  ++c->n;
  return HC_OK;
}

hc_status hbm_curve_settle(hbm_curve *c, int settled)
{
  const int from = c->settled;
  if (settled <= from) return HC_OK;
  c->settled = settled;
  return c->watch.added ? c->watch.added(c->watch.self, c, from, settled) : HC_OK;
}

void hbm_curve_measure_by(hbm_curve *c, metric *m, double omega_scale)
{
  metric *const before = c->metric;
  c->metric = metric_share(m);
  c->omega_scale = omega_scale;
  metric_free(before);
}

void hbm_curve_free(hbm_curve *c)
{
  metric_free(c->metric);
  free(c->points);
  free(c->X);
  free(c->dX);
  *c = (hbm_curve){0};
}
