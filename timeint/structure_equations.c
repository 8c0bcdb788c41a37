/* structure_equations.c - see structure_equations.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/structure_equations.h"

#include <math.h>
#include <string.h>

void structure_linear_force(const scaled_model *m, double theta, const double *y, double *out)
{
  const modal_base *b = m->base;
  const int n = m->n;
  memset(out, 0, (size_t)n * sizeof *out);
  for (int l = 0; l < b->n_loads; ++l) {
    const double c = m->by_load * cos(b->harmonic[l] * theta), s = m->by_load * sin(b->harmonic[l] * theta);
    const double *cosine = b->cosine + (size_t)l * (size_t)n, *sine = b->sine + (size_t)l * (size_t)n;
    for (int i = 0; i < n; ++i) out[i] += c * cosine[i] + s * sine[i];
  }
  modal_base_subtract_K(b, m->by_K, y, out);
  modal_base_subtract_C(b, m->by_C, y + n, out);
}

bool structure_rhs(const scaled_model *m, double theta, const double *y, double *dy)
{
  const int n = m->n;
  double *force = dy + n, sum = 0;
  structure_linear_force(m, theta, y, force);
  for (int j = 0; j < m->n_contacts; ++j) {
    double u, v;
    scaled_contact_motion(m, j, y, &u, &v);
    const law_value l = law_regularised_eval(&m->contact[j].law, u, v, y[2 * n + j]);
    const double *t = m->base->tangent + (size_t)j * (size_t)n, *normal = m->base->normal + (size_t)j * (size_t)n;
    for (int i = 0; i < n; ++i) force[i] -= l.t * t[i] + l.change * normal[i];
    dy[2 * n + j] = l.rate;
    sum += l.rate;
  }
  for (int i = 0; i < n; ++i) {
    dy[i] = y[n + i];
    sum += y[n + i] + force[i];
  }
  return isfinite(sum);
}

static void fill_linear(const scaled_model *m, double *jac)
{
  const modal_base *b = m->base;
  const size_t n = (size_t)m->n, ld = (size_t)m->n_states;
  for (size_t col = 0; col < n; ++col) {
    double *by_x = jac + col * ld, *by_p = jac + (n + col) * ld;
    by_p[col] = 1;
    if (b->diagonal_K) by_x[n + col] = -m->by_K * b->K[col];
    if (b->diagonal_C) by_p[n + col] = -m->by_C * b->C[col];
    for (size_t row = 0; row < n && !b->diagonal_K; ++row) by_x[n + row] = -m->by_K * b->K[col * n + row];
    for (size_t row = 0; row < n && !b->diagonal_C; ++row) by_p[n + row] = -m->by_C * b->C[col * n + row];
  }
}

void structure_jacobian(const scaled_model *m, const double *y, double *jac)
{
  const size_t n = (size_t)m->n, ld = (size_t)m->n_states;
  memset(jac, 0, ld * ld * sizeof *jac);
  fill_linear(m, jac);
  for (int j = 0; j < m->n_contacts; ++j) {
    const size_t w = 2 * n + (size_t)j;
    const double *t = m->base->tangent + (size_t)j * n, *normal = m->base->normal + (size_t)j * n;
    double u, v;
    scaled_contact_motion(m, j, y, &u, &v);
    const law_derivatives s = law_regularised_derivatives(&m->contact[j].law, u, v, y[w]);
    for (size_t col = 0; col < n; ++col) {
      const double force_t = s.t_u * t[col] + s.t_v * normal[col], force_n = s.n_v * normal[col];
      for (size_t row = 0; row < n; ++row) jac[col * ld + n + row] -= t[row] * force_t + normal[row] * force_n;
      jac[col * ld + w] = s.rate_u * t[col] + s.rate_v * normal[col];
    }
    for (size_t row = 0; row < n; ++row) jac[w * ld + n + row] = s.t_u * t[row];
    jac[w * ld + w] = -s.rate_u;
  }
}
