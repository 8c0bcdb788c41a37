/* stuck_response.h - the closed form of a structure's response while contacts stay stuck, or open, by Gauss in long
 * double: for tests that hold harmonic balance against it. */
#pragma once

#include <complex.h>

#include "model/model.h"
#include "numerics/random.h"
#include "tests/check.h"

enum { STUCK_MAX_DOFS = 16 };

typedef long double complex number; /* 64 bits of mantissa where there are: the reference must not be what errs */

/* x of A x = b, [n][n] by rows, by Gauss with row pivots; both are overwritten. */
static inline void gauss(int n, number A[][STUCK_MAX_DOFS], number *b)
{
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (cabsl(A[i][k]) > cabsl(A[pivot][k])) pivot = i;
    for (int j = 0; j < n; ++j) {
      const number kept = A[k][j];
      A[k][j] = A[pivot][j], A[pivot][j] = kept;
    }
    const number kept = b[k];
    b[k] = b[pivot], b[pivot] = kept;
    for (int i = k + 1; i < n; ++i) {
      const number factor = A[i][k] / A[k][k];
      for (int j = k; j < n; ++j) A[i][j] -= factor * A[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
}

/* K + sum of stuck contacts kt t t^T + kn n n^T - w^2 M + i w C, each entry off by as much as `off` of itself. */
static inline void dynamic_stiffness(const model *m, const bool *stuck, long double w, double off,
                                     number A[][STUCK_MAX_DOFS])
{
  uint64_t seed = 7;
  const int n = m->n;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      A[i][k] = m->stiffness[k * n + i] - w * w * m->mass[k * n + i] + I * w * m->damping[k * n + i];
      for (int j = 0; j < m->n_contacts; ++j) {
        const model_contact *c = &m->contacts[j];
        if (!stuck[j]) continue;
        A[i][k] += (long double)c->law.kt * c->tangent[i] * c->tangent[k];
        A[i][k] += (long double)c->law.kn * c->normal[i] * c->normal[k];
      }
      A[i][k] *= 1 + off * (long double)random_signed(&seed);
    }
}

/* x of load l where every contact that is stuck stays so. */
static inline void closed_form(const model *m, const bool *stuck, double omega, int l, double off, number *x)
{
  number A[STUCK_MAX_DOFS][STUCK_MAX_DOFS];
  dynamic_stiffness(m, stuck, (long double)omega * m->loads[l].harmonic, off, A);
  for (int i = 0; i < m->n; ++i) x[i] = (long double)m->loads[l].cosine[i] - I * (long double)m->loads[l].sine[i];
  gauss(m->n, A, x);
}

static inline number along(const model *m, const double *direction, const number *x)
{
  number sum = 0;
  for (int i = 0; i < m->n; ++i) sum += direction[i] * x[i];
  return sum;
}

/* The static part x0, under load 0, where the friction that is needed, s kt u > mu kn v with u, v of x0 (gap = 0),
 * is more than there is: such a slider, which starts at w = 0, slides until the motion x1 cos(omega t) + .. around
 * x0 just reaches the limit, s T0 + |s kt u1 - mu kn v1| = mu N0. Then T0 = s (mu kn v0 - |..|) is one more linear
 * force. */
static inline void shake_down(const model *m, const bool *stuck, const number *x1, number *x0)
{
  number A[STUCK_MAX_DOFS][STUCK_MAX_DOFS], b[STUCK_MAX_DOFS];
  dynamic_stiffness(m, stuck, 0, 0, A);
  for (int i = 0; i < m->n; ++i) b[i] = m->loads[0].cosine[i];
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const long double limit = c->law.mu * c->law.kn, pull = creall(c->law.kt * along(m, c->tangent, x0));
    if (!stuck[j] || c->law.kn == 0 || fabsl(pull) <= limit * creall(along(m, c->normal, x0))) continue;
    const int sign = pull > 0 ? 1 : -1;
    const long double swing = cabsl(sign * c->law.kt * along(m, c->tangent, x1) - limit * along(m, c->normal, x1));
    for (int i = 0; i < m->n; ++i) {
      for (int k = 0; k < m->n; ++k)
        A[i][k] += c->tangent[i] * (sign * limit * c->normal[k] - (long double)c->law.kt * c->tangent[k]);
      b[i] += sign * swing * c->tangent[i];
    }
  }
  gauss(m->n, A, b);
  for (int i = 0; i < m->n; ++i) x0[i] = b[i];
}
