/* condensation_change.c - see condensation.h: derivatives of S and p, and responses. */
#include <string.h>

#include "hbm/condensation_impl.h"

condensation_change condensation_by_omega(const condensation *c, int h)
{
  return (condensation_change){-2.0 * h * h * c->omega + I * (h * c->more_damping * c->more_mass), I * h};
}

condensation_change condensation_by_damping(const condensation *c, int h)
{
  return (condensation_change){I * (h * c->omega * c->more_mass), 0};
}

/* dS of harmonic h by compliance, and into c->room dg of the loads. False where it cannot tell: Z_yy is then there. */
static bool change_by_compliance(condensation *c, int h, condensation_change by, double complex *dS)
{
  const size_t dim = (size_t)c->basis.dim;
  const double w = condensation_frequency(c, h);
  const double complex ds = by.beta, dd = by.beta == 0 ? by.alpha / (I * w) : 0;
  if (!c->by_compliance[h]) return false;
  const hc_status st = compliance_change(c->compliance, w, condensation_reach(c), condensation_more_rate(c), ds, dd,
                                         c->S + (size_t)h * dim * dim, dS, c->room);
  if (st == HC_OK) return true;
  c->by_compliance[h] = condensation_by_rest(c, h) != HC_OK;
  return c->by_compliance[h];
}

void condensation_stiffness_change(condensation *c, int h, condensation_change by, double complex *dS)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const size_t start = (size_t)h * (size_t)dim * (size_t)rest;
  if (c->m->n == 1) {
    *dS = condensation_change_at(c, by, 0);
    return;
  }
  memset(dS, 0, (size_t)dim * (size_t)dim * sizeof *dS);
  if (by.alpha == 0 && by.beta == 0) return; /* at rest */
  if (change_by_compliance(c, h, by, dS)) return;
  for (int e = 0; e < dim; ++e) {
    const double complex *W = c->by_q + start + (size_t)e * (size_t)rest;
    for (int d = 0; d < dim; ++d)
      dS[(size_t)e * (size_t)dim + (size_t)d] = condensation_change_at(c, by, condensation_entry(c, d, e));
    for (int i = 0; i < rest; ++i) {
      double complex inner =
          condensation_change_at(c, by, condensation_entry(c, dim + i, e)); /* (dZ_yq - dZ_yy W) at (i, e) */
      if (condensation_rest_is_diagonal(c, h))
        inner -= condensation_change_at(c, by, condensation_entry(c, dim + i, dim + i)) * W[i];
      else
        for (int k = 0; k < rest; ++k)
          inner -= condensation_change_at(c, by, condensation_entry(c, dim + i, dim + k)) * W[k];
      for (int d = 0; d < dim; ++d)
        dS[(size_t)e * (size_t)dim + (size_t)d] -=
            c->by_y[start + (size_t)d * (size_t)rest + (size_t)i] * inner +
            condensation_change_at(c, by, condensation_entry(c, d, dim + i)) * W[i];
    }
  }
}

/* p = S g. */
static void load_change_by_compliance(condensation *c, int l, double complex *dp)
{
  const size_t dim = (size_t)c->basis.dim, h = (size_t)c->m->loads[l].harmonic;
  double complex *dg = c->room + 2 * (size_t)l * dim;
  for (size_t d = 0; d < dim; ++d) dg[d] -= I * dg[dim + d];
  condensation_multiply(c->basis.dim, c->S + h * dim * dim, dg, dp);
  condensation_multiply(c->basis.dim, c->dS, c->motion + (size_t)l * dim, dg);
  for (size_t d = 0; d < dim; ++d) dp[d] += dg[d];
}

void condensation_load_change(condensation *c, int l, condensation_change by, double complex *dp)
{
  const int dim = c->basis.dim, rest = c->basis.rest, h = c->m->loads[l].harmonic;
  memset(dp, 0, (size_t)dim * sizeof *dp);
  if (by.alpha == 0 && by.beta == 0) return;
  if (change_by_compliance(c, h, by, c->dS)) {
    load_change_by_compliance(c, l, dp);
    return;
  }
  const size_t start = (size_t)h * (size_t)dim * (size_t)rest;
  const double complex *y = c->rest_of + (size_t)l * (size_t)rest;
  for (int i = 0; i < rest; ++i) {
    double complex inner = 0; /* dZ_yy Z_yy^-1 p_y */
    if (condensation_rest_is_diagonal(c, h))
      inner = condensation_change_at(c, by, condensation_entry(c, dim + i, dim + i)) * y[i];
    else
      for (int k = 0; k < rest; ++k)
        inner += condensation_change_at(c, by, condensation_entry(c, dim + i, dim + k)) * y[k];
    for (int d = 0; d < dim; ++d)
      dp[d] += c->by_y[start + (size_t)d * (size_t)rest + (size_t)i] * inner -
               condensation_change_at(c, by, condensation_entry(c, d, dim + i)) * y[i];
  }
}

/* row = G_r S, rest = g_r - G_r p. */
static bool response_by_compliance(condensation *c, int h, int r, double factor, double complex *row,
                                   double complex *rest_of_it)
{
  const int dim = c->basis.dim;
  double complex *G_r = c->dS, *g_r = c->room;
  const double complex *S = c->S + (size_t)h * (size_t)dim * (size_t)dim;
  if (!c->by_compliance[h]) return false;
  if (compliance_of_response(c->compliance, condensation_frequency(c, h), condensation_reach(c),
                             condensation_more_rate(c), r, G_r, g_r) != HC_OK)
    return false;
  *rest_of_it = 0;
  for (int e = 0; e < dim; ++e) {
    row[e] = 0;
    for (int d = 0; d < dim; ++d) row[e] += G_r[d] * S[(size_t)e * (size_t)dim + (size_t)d];
  }
  for (int l = 0; l < c->m->n_loads; ++l) {
    if (c->m->loads[l].harmonic != h) continue;
    *rest_of_it += factor * (g_r[2 * l] - I * g_r[2 * l + 1]);
    for (int d = 0; d < dim; ++d) *rest_of_it -= factor * G_r[d] * c->load[(size_t)l * (size_t)dim + (size_t)d];
  }
  return true;
}

void condensation_response(condensation *c, int h, int r, double factor, double complex *row,
                           double complex *rest_of_it)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  if (c->m->n > 1 && response_by_compliance(c, h, r, factor, row, rest_of_it)) return;
  const double *of = c->basis.responses + (size_t)r * (size_t)c->m->n;
  const double complex *W = c->by_q + (size_t)h * (size_t)dim * (size_t)rest;
  *rest_of_it = 0;
  for (int e = 0; e < dim; ++e) {
    row[e] = of[e];
    for (int i = 0; i < rest; ++i) row[e] -= of[dim + i] * W[(size_t)e * (size_t)rest + (size_t)i];
  }
  for (int l = 0; l < c->m->n_loads; ++l)
    for (int i = 0; i < rest && c->m->loads[l].harmonic == h; ++i)
      *rest_of_it += factor * of[dim + i] * c->rest_of[(size_t)l * (size_t)rest + (size_t)i];
}

hc_status condensation_motion(condensation *c, int h, const double complex *q, double factor, double complex *x)
{
  const size_t n = (size_t)c->m->n, dim = (size_t)c->basis.dim, rest = (size_t)c->basis.rest;
  const double complex *W = c->by_q + (size_t)h * dim * rest;
  if (n > 1 && c->by_compliance[h]) {
    hc_status st = condensation_by_rest(c, h);
    if (st != HC_OK) return st;
    c->by_compliance[h] = false;
  }
  for (size_t i = 0; i < n; ++i) x[i] = 0;
  for (size_t k = 0; k < n; ++k) { /* coordinate k of (q, y) */
    double complex z = k < dim ? q[k] : 0;
    for (size_t e = 0; e < dim && k >= dim; ++e) z -= W[e * rest + k - dim] * q[e];
    for (int l = 0; l < c->m->n_loads && k >= dim; ++l)
      if (c->m->loads[l].harmonic == h) z += factor * c->rest_of[(size_t)l * rest + k - dim];
    for (size_t i = 0; i < n; ++i) x[i] += c->basis.T[k * n + i] * z;
  }
  return HC_OK;
}
