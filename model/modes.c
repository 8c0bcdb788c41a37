/* modes.c - see modes.h. */
#include "model/modes.h"

#include <stdlib.h>

#include "numerics/dense.h"
#include "numerics/norm.h"

hc_status model_modes(const model *m, bool stuck, double *omega2, double *phi)
{
  const size_t n = (size_t)m->n;
  double *K = malloc(n * n * sizeof *K);
  if (!K) return HC_NO_MEMORY;
  for (size_t col = 0; col < n; ++col)
    for (size_t row = 0; row < n; ++row)
      K[col * n + row] = 0.5 * (m->stiffness[col * n + row] + m->stiffness[row * n + col]);
  for (int j = 0; j < m->n_contacts && stuck; ++j) {
    const model_contact *c = &m->contacts[j];
    if (contact_has_friction(&c->law)) add_outer(m->n, c->law.kt, c->tangent, c->tangent, K);
    add_outer(m->n, c->law.kn, c->normal, c->normal, K);
  }
  hc_status st = dense_modes(m->n, K, m->mass, omega2, phi);
  free(K);
  return st;
}

/* phi^T C phi [1/time] of a mode with phi^T M phi = 1: twice its damping ratio times omega. */
static double modal_damping(const model *m, const double *phi)
{
  double c = 0;
  for (int col = 0; col < m->n; ++col)
    for (int row = 0; row < m->n; ++row)
      c += phi[row] * m->damping[(size_t)col * (size_t)m->n + (size_t)row] * phi[col];
  return c;
}

hc_status model_find_scales(const model *m, model_scales *out)
{
  const size_t n = (size_t)m->n;
  double *omega2 = malloc(n * sizeof *omega2), *phi = malloc(2 * n * n * sizeof *phi),
         *C_phi = phi ? phi + n * n : NULL;
  hc_status st = omega2 && phi ? model_modes(m, true, omega2, phi) : HC_NO_MEMORY;
  if (st == HC_OK) {
    *out = (model_scales){sqrt(fmax(omega2[n - 1], 0)), INFINITY};
    dense_multiply(m->n, m->n, m->n, m->damping, phi, C_phi);
    for (size_t i = 0; i < n; ++i)
      out->half_width = fmin(out->half_width, 0.5 * dot_product(m->n, phi + i * n, C_phi + i * n));
    out->half_width = fmax(out->half_width, 0);
  }
  free(omega2);
  free(phi);
  return st;
}

hc_status model_mode_list(const model *m, bool stuck, model_mode *modes)
{
  const size_t n = (size_t)m->n;
  double *omega2 = malloc((n + n * n) * sizeof *omega2);
  if (!omega2) return HC_NO_MEMORY;
  double *phi = omega2 + n;
  hc_status st = model_modes(m, stuck, omega2, phi);
  for (size_t i = 0; i < n && st == HC_OK; ++i) {
    const double omega = sqrt(omega2[i]), c = modal_damping(m, phi + i * n);
    modes[i] = (model_mode){omega, omega > 0 ? c / (2 * omega) : NAN};
  }
  free(omega2);
  return st;
}
