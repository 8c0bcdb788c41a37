/* vectors.c - see vectors.h. Any result may be one of the operands. Operations on several vectors at once are SUNDIALS'
 * own, which call these: with other ones CVODES would allocate for its sensitivities. */
#include "numerics/vectors.h"

#include <math.h>

#include "numerics/wide_vectors.h"

/* Sums of LONG numbers and more are made of LANES partial sums, so that they do not depend on the vector width. */
enum { LONG = 128, LANES = 8 };

/* z = a x + b y */
WIDE_VECTORS static void combine(long n, double a, const double *x, double b, const double *y, double *z)
{
  for (long i = 0; i < n; ++i) z[i] = a * x[i] + b * y[i];
}

WIDE_VECTORS static void scale_sum(long n, double a, const double *x, const double *y, double *z)
{
  for (long i = 0; i < n; ++i) z[i] = a * (x[i] + y[i]);
}

WIDE_VECTORS static void scale_difference(long n, double a, const double *x, const double *y, double *z)
{
  for (long i = 0; i < n; ++i) z[i] = a * (x[i] - y[i]);
}

WIDE_VECTORS static double sum_of_squares(long n, const double *restrict x, const double *restrict w)
{
  double part[LANES] = {0}, sum = 0;
  long i = 0;
  for (; n >= LONG && i + LANES <= n; i += LANES)
    for (int k = 0; k < LANES; ++k) part[k] += (x[i + k] * w[i + k]) * (x[i + k] * w[i + k]);
  for (; i < n; ++i) sum += (x[i] * w[i]) * (x[i] * w[i]);
  for (int k = 0; k < LANES && n >= LONG; ++k) sum += part[k];
  return sum;
}

static void linear_sum(sunrealtype a, N_Vector x, sunrealtype b, N_Vector y, N_Vector z)
{
  const long n = NV_LENGTH_S(z);
  if (a == b) scale_sum(n, a, NV_DATA_S(x), NV_DATA_S(y), NV_DATA_S(z));
  else if (a == -b) scale_difference(n, a, NV_DATA_S(x), NV_DATA_S(y), NV_DATA_S(z));
  else combine(n, a, NV_DATA_S(x), b, NV_DATA_S(y), NV_DATA_S(z));
}

#define FOR_EACH(z, value)                                                                                             \
  for (long i = 0, n = NV_LENGTH_S(z); i < n; ++i) NV_Ith_S(z, i) = (value)

static void scale(sunrealtype a, N_Vector x, N_Vector z) { FOR_EACH(z, a * NV_Ith_S(x, i)); }
static void product(N_Vector x, N_Vector y, N_Vector z) { FOR_EACH(z, NV_Ith_S(x, i) * NV_Ith_S(y, i)); }
static void quotient(N_Vector x, N_Vector y, N_Vector z) { FOR_EACH(z, NV_Ith_S(x, i) / NV_Ith_S(y, i)); }
static void inverse(N_Vector x, N_Vector z) { FOR_EACH(z, 1 / NV_Ith_S(x, i)); }
static void absolute(N_Vector x, N_Vector z) { FOR_EACH(z, fabs(NV_Ith_S(x, i))); }

static sunrealtype weighted_rms(N_Vector x, N_Vector w)
{
  return sqrt(sum_of_squares(NV_LENGTH_S(x), NV_DATA_S(x), NV_DATA_S(w)) / (double)NV_LENGTH_S(x));
}

static sunrealtype weighted_length(N_Vector x, N_Vector w)
{
  return sqrt(sum_of_squares(NV_LENGTH_S(x), NV_DATA_S(x), NV_DATA_S(w)));
}

N_Vector vectors_new(int n, SUNContext ctx)
{
  N_Vector v = N_VNew_Serial(n, ctx);
  if (!v) return NULL;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvscale = scale;
  v->ops->nvprod = product;
  v->ops->nvdiv = quotient;
  v->ops->nvinv = inverse;
  v->ops->nvabs = absolute;
  v->ops->nvwrmsnorm = weighted_rms;
  v->ops->nvwl2norm = weighted_length;
  return v;
}
