/* growth.c - see growth.h. */
#include "hbm/curve/growth.h"

#include <complex.h>
#include <stdlib.h>

#include "hbm/solver/hbm_solver_impl.h"
#include "numerics/base/constants.h"

static const double most_stored = 1e6; /* largest E/W of a bounded motion: a resonance of damping ratio zeta has 1/(4 pi
                                          zeta), here zeta = 8e-8 */
static const double most_damped = 1e-6; /* least D/W at which damping bounds the motion */

/* |x^H A x|, A[n][n] by columns. */
static double form(int n, const double *A, const double complex *x)
{
  double complex sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n && x[j] != 0; ++i) sum += conj(x[i]) * A[i + (size_t)n * (size_t)j] * x[j];
  return cabs(sum);
}

hc_status hbm_growth(hbm_solver *s, double omega, const double *X, bool *grows)
{
  const model *m = s->model;
  const int n = m->n, dim = s->sys.dim;
  double stored = 0, most = 0, damped = 0;
  double complex *x = malloc((size_t)(n + dim) * sizeof *x), *q = x + n;
  hc_status st = x ? condensation_at(s->sys.linear, omega, 0) : HC_NO_MEMORY;
  for (int h = 1; h <= s->sys.n_harm && st == HC_OK; ++h) {
    const double *a = X + (2 * h - 1) * dim, *b = a + dim, rate = h * omega;
    for (int d = 0; d < dim; ++d) q[d] = a[d] - I * b[d];
    st = condensation_motion(s->sys.linear, h, q, 1, x);
    if (st != HC_OK) break;
    stored += 0.25 * rate * rate * form(n, m->mass, x);
    damped += PI * omega * h * h * form(n, m->damping, x);
    for (int k = 0; k < m->n_loads; ++k) {
      double complex work = 0;
      if (m->loads[k].harmonic != h) continue;
      for (int i = 0; i < n; ++i) work += conj(x[i]) * (m->loads[k].cosine[i] - I * m->loads[k].sine[i]);
      most += PI * h * cabs(work) * model_load_factor(m->loads[k].inertial, omega);
    }
  }
  free(x);
  *grows = st == HC_OK && stored > most_stored * most && damped < most_damped * most;
  return st;
}
