/* response_curve.c - see response_curve.h. */
#include "hbm/curve/response_curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/growing.h"

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
  if (c->n > 0 && c->n_coef != n_coef) return HC_BUG;
  c->n_coef = n_coef;
  if (c->n == c->cap && double_capacity(c) != HC_OK) return HC_NO_MEMORY;
  size_t row = (size_t)n_coef * sizeof(double);
  c->points[c->n] = *point;
  memcpy(hbm_curve_X(c, c->n), X, row);
  memcpy(hbm_curve_dX(c, c->n), dX, row);
  ++c->n;
  return HC_OK;
}

/* Rows of n_coef numbers become rows of `longer`, 0 beyond. */
static hc_status lengthen_rows(hbm_curve *c, int longer)
{
  const size_t n = (size_t)longer, before = (size_t)c->n_coef;
  double *rows[2] = {calloc((size_t)c->cap * n + 1, sizeof(double)), calloc((size_t)c->cap * n + 1, sizeof(double))};
  if (!rows[0] || !rows[1]) {
    free(rows[0]);
    free(rows[1]);
    return HC_NO_MEMORY;
  }
  for (size_t k = 0; k < (size_t)c->n; ++k) {
    memcpy(rows[0] + k * n, c->X + k * before, before * sizeof(double));
    memcpy(rows[1] + k * n, c->dX + k * before, before * sizeof(double));
  }
  free(c->X);
  free(c->dX);
  c->X = rows[0], c->dX = rows[1];
  c->n_coef = longer;
  return HC_OK;
}

hc_status hbm_curve_add_part(hbm_curve *c, const hbm_curve *part, hbm_part_start start)
{
  const int n = c->n, longer = part->n_coef > c->n_coef ? part->n_coef : c->n_coef,
            branches = n > 0 ? c->points[n - 1].branch + 1 : 0;
  double *row = calloc(2 * (size_t)longer + 1, sizeof *row);
  hc_status st = row && GROW(c->parts, c->n_parts) ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK && c->n_coef < longer) st = lengthen_rows(c, longer);
  for (int k = 0; k < part->n && st == HC_OK; ++k) {
    hbm_point point = part->points[k];
    point.branch += branches;
    point.part = c->n_parts;
    memcpy(row, hbm_curve_X(part, k), (size_t)part->n_coef * sizeof *row);
    memcpy(row + longer, hbm_curve_dX(part, k), (size_t)part->n_coef * sizeof *row);
    st = hbm_curve_append(c, longer, row, row + longer, &point);
  }
  free(row);
  if (st != HC_OK) return c->n = n, st;
  c->parts[c->n_parts++] = (hbm_curve_part){.first = n,
                                            .n = part->n,
                                            .start = start,
                                            .end = part->end,
                                            .left_at_start = part->left_at_start,
                                            .closed = part->closed,
                                            .met = part->met,
                                            .ends_at = part->ends_at};
  c->turning_points += part->turning_points;
  c->linear += part->linear;
  c->rejected += part->rejected;
  c->iterations += part->iterations;
  c->evaluations += part->evaluations;
  c->edges += part->edges;
  c->edge_omega = fmax(c->edge_omega, part->edge_omega), c->edge_motion = fmax(c->edge_motion, part->edge_motion);
  c->inaccurate |= part->inaccurate;
  c->arclength |= part->arclength;
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
  free(c->parts);
  *c = (hbm_curve){0};
}
