/* path.c - see path.h: distances and directions along a response curve under way. */
#include <math.h>

#include "hbm/path.h"

double path_metric(const path *p, double x_scale, const double *aX, double a_omega, const double *bX, double b_omega)
{
  double sum = 0;
  for (int i = 0; i < p->curve->n_coef; ++i) sum += aX[i] * bX[i];
  return sum / (x_scale * x_scale) + a_omega * b_omega / (p->curve->omega_scale * p->curve->omega_scale);
}

double path_size(const path *p)
{
  double size = hbm_norm(p->curve->n_coef, hbm_curve_X(p->curve, p->curve->n - 1));
  return size > 0 ? size : 1;
}

double path_correction(const path *p, double omega_unit)
{
  double sum = 0, x_scale = path_size(p), d = (p->omega - p->omega_p) / omega_unit;
  for (int i = 0; i < p->curve->n_coef; ++i) sum += (p->X[i] - p->P[i]) * (p->X[i] - p->P[i]);
  return sqrt(sum / (x_scale * x_scale) + d * d);
}

bool path_agrees_backwards(const path *p, double h)
{
  const hbm_curve *c = p->curve;
  const double *X0 = hbm_curve_X(c, c->n - 1), step = (p->omega - c->points[c->n - 1].omega) / p->d_omega;
  double sum = 0;
  for (int i = 0; i < c->n_coef; ++i) sum += (p->X[i] - X0[i] - step * p->dX[i]) * (p->X[i] - X0[i] - step * p->dX[i]);
  return sqrt(sum) <= h * path_size(p);
}

double path_flatness(const path *p)
{
  double all = path_metric(p, path_size(p), p->dX, p->d_omega, p->dX, p->d_omega);
  return fabs(p->d_omega) / p->curve->omega_scale / sqrt(all);
}
