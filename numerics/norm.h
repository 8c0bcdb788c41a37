/* norm.h - norms and products of vectors. libm only. */
#ifndef HC_NORM_H
#define HC_NORM_H

#include <math.h>

/* sqrt(sum v[i]^2), not protected against overflow of the squares. */
static inline double norm_2(int n, const double *v)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += v[i] * v[i];
  return sqrt(sum);
}

/* sum a[i] b[i]. */
static inline double dot_product(int n, const double *a, const double *b)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/* norm_2 of a - b. */
static inline double distance_2(int n, const double *a, const double *b)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(sum);
}

/* Largest |weight[i] v[i]|; NaN if any is. */
static inline double norm_weighted_max(int n, const double *weight, const double *v)
{
  double max = 0;
  for (int i = 0; i < n; ++i) {
    const double a = fabs(weight[i] * v[i]);
    max = isnan(max) || a <= max ? max : a;
  }
  return max;
}

#endif
