/* norm.h - norms and products of vectors. libm only. */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

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

static inline bool is_zero(int n, const double *v)
{
  for (int i = 0; i < n; ++i)
    if (v[i] != 0) return false;
  return true;
}

/* A[n][n] += k a b^T, by columns. */
static inline void add_outer(int n, double k, const double *a, const double *b, double *A)
{
  for (int j = 0; j < n && k != 0; ++j)
    for (int i = 0; i < n && b[j] != 0; ++i) A[(size_t)j * (size_t)n + (size_t)i] += k * a[i] * b[j];
}

/* norm_2 of a - b. */
static inline double distance_2(int n, const double *a, const double *b)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(sum);
}

/* The larger one; NaN if either is, unlike fmax. */
static inline double larger(double a, double b) { return isnan(a) || a >= b ? a : b; }

/* Largest |v[i]|; NaN if any is. */
static inline double norm_max(int n, const double *v)
{
  double max = 0;
  for (int i = 0; i < n; ++i) max = larger(max, fabs(v[i]));
  return max;
}

/* Largest |weight[i] v[i]|; NaN if any is. */
static inline double norm_weighted_max(int n, const double *weight, const double *v)
{
  double max = 0;
  for (int i = 0; i < n; ++i) max = larger(max, fabs(weight[i] * v[i]));
  return max;
}
