/* path.c - see path.h. */
#include "hbm/curve/path.h"

#include <math.h>
#include <string.h>

#include "hbm/curve/segment.h"
#include "hbm/solver/corrector.h"
#include "numerics/norm.h"

double path_metric(const path *p, double x_scale, const double *aX, double a_omega, const double *bX, double b_omega)
{
  double sum = 0;
  for (int i = 0; i < p->curve->n_coef; ++i) sum += aX[i] * bX[i];
  return sum / (x_scale * x_scale) + a_omega * b_omega / (p->curve->omega_scale * p->curve->omega_scale);
}

double path_size(const path *p)
{
  double size = norm_2(p->curve->n_coef, hbm_curve_X(p->curve, p->curve->n - 1));
  return size > 0 ? size : 1;
}

double path_correction(const path *p, double omega_unit)
{
  double sum = 0, x_scale = path_size(p), d = (p->omega - p->omega_predicted) / omega_unit;
  for (int i = 0; i < p->curve->n_coef; ++i) {
    double moved = p->X[i] - p->X_predicted[i];
    sum += moved * moved;
  }
  return sqrt(sum / (x_scale * x_scale) + d * d);
}

bool path_agrees_backwards(const path *p, double h)
{
  const hbm_curve *c = p->curve;
  const double *X0 = hbm_curve_X(c, c->n - 1), step = (p->omega - c->points[c->n - 1].omega) / p->d_omega;
  double sum = 0;
  for (int i = 0; i < c->n_coef; ++i) {
    double missed = p->X[i] - X0[i] - step * p->dX[i];
    sum += missed * missed;
  }
  return sqrt(sum) <= h * path_size(p);
}

double path_flatness(const path *p)
{
  double all = path_metric(p, path_size(p), p->dX, p->d_omega, p->dX, p->d_omega);
  return fabs(p->d_omega) / p->curve->omega_scale / sqrt(all);
}

double path_predict(path *p, double h)
{
  const hbm_curve *c = p->curve;
  int last = c->n - 1;
  double x_scale = path_size(p), ratio = 1.0 / 16;
  hbm_segment seg = {.length = 0};
  if (c->n >= 2) seg = hbm_segment_between(c, last - 1);
  if (c->n >= 2 && h <= 4 * seg.length && !p->tangent_only) {
    hbm_segment_at(&seg, 1 + h / seg.length, p->X, &p->omega, p->dX, &p->d_omega);
    ratio = h * h / (16 * (seg.length + h) * (seg.length + h));
  } else {
    const double *X = hbm_curve_X(c, last), *dX = hbm_curve_dX(c, last);
    const hbm_point *q = &c->points[last];
    double scale = h / sqrt(path_metric(p, x_scale, dX, q->d_omega, dX, q->d_omega));
    for (int i = 0; i < c->n_coef; ++i) p->X[i] = X[i] + scale * dX[i];
    memcpy(p->dX, dX, (size_t)c->n_coef * sizeof(double));
    p->omega = q->omega + scale * q->d_omega;
    p->d_omega = q->d_omega;
  }
  hbm_truncate(p->s, c->n_coef, p->X);
  hbm_truncate(p->s, c->n_coef, p->dX);
  double length = sqrt(path_metric(p, x_scale, p->dX, p->d_omega, p->dX, p->d_omega));
  for (int i = 0; i < c->n_coef; ++i) p->dX[i] /= length;
  p->d_omega /= length;
  memcpy(p->X_predicted, p->X, (size_t)c->n_coef * sizeof(double));
  p->omega_predicted = p->omega;
  return ratio;
}

void path_orient_tangent(path *p)
{
  if (p->det_sign == p->orientation) return;
  for (int i = 0; i < p->curve->n_coef; ++i) p->dX[i] = -p->dX[i];
  p->d_omega = -p->d_omega;
}

void path_fill_normal(path *p)
{
  int n = p->s->sys.n, first = p->s->sys.first;
  double x_scale = path_size(p), omega_scale = p->curve->omega_scale;
  for (int i = 0; i < n; ++i) p->normal[i] = p->dX[i + first] / (x_scale * x_scale);
  p->normal[n] = p->d_omega / (omega_scale * omega_scale);
}

hc_status path_correct_in_plane(path *p)
{
  double x_scale = path_size(p), omega_scale = p->curve->omega_scale;
  path_fill_normal(p);
  hc_status st = hbm_solve_plane(p->s, p->normal, x_scale, omega_scale, p->X, &p->omega, &p->point);
  p->det_sign = newton_sign(p->s->plane);
  return st == HC_OK ? hbm_tangent_plane(p->s, p->dX, &p->d_omega) : st;
}
