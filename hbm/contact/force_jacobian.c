/* force_jacobian.c - see force_jacobian.h. */
#include "hbm/contact/force_jacobian.h"

#include <stdlib.h>

void force_jacobian_add(int n_harm, const double *k, int ld, double *jac)
{
  jac[0] += k[0];
  for (int q = 1; q <= n_harm; ++q) {
    double *cos_col = jac + (size_t)ld * (2 * q - 1), *sin_col = cos_col + ld;
    cos_col[0] += 0.5 * k[2 * q - 1]; /* the mean of k cos(q th) */
    sin_col[0] += 0.5 * k[2 * q];
    jac[2 * q - 1] += k[2 * q - 1]; /* k times a constant */
    jac[2 * q] += k[2 * q];
    for (int p = 1; p <= n_harm; ++p) {
      int sum = p + q, dif = abs(p - q);
      double c_sum = k[2 * sum - 1], s_sum = k[2 * sum];
      double c_dif = dif ? k[2 * dif - 1] : 2 * k[0], s_dif = dif ? k[2 * dif] : 0;
      double s_pq = p >= q ? s_dif : -s_dif; /* S_{p-q} */
      cos_col[2 * p - 1] += 0.5 * (c_dif + c_sum);
      cos_col[2 * p] += 0.5 * (s_sum + s_pq);
      sin_col[2 * p - 1] += 0.5 * (s_sum - s_pq);
      sin_col[2 * p] += 0.5 * (c_dif - c_sum);
    }
  }
}
