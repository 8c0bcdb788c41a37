/* condensation_change.c - see condensation.h: derivatives of S and p, and responses. */
#include <string.h>

#include "hbm/structure/condensation_impl.h"

condensation_change condensation_by_omega(const condensation *c, int h)
{
  return (condensation_change){-2.0 * h * h * c->omega + I * (h * c->more_damping * c->more_mass), I * h};
}

condensation_change condensation_by_damping(const condensation *c, int h)
{
  return (condensation_change){I * (h * c->omega * c->more_mass), 0};
}

/* dG and dg of compliance.h. NULL where it cannot tell: Z_yy is then there. */
static const double complex *change_by_compliance(condensation *c, int h, condensation_change by)
{
  const double w = condensation_frequency(c, h);
  const double complex ds = by.beta, dd = by.beta == 0 ? by.alpha / (I * w) : 0, *dG;
  if (!c->by_compliance[h]) return NULL;
  const hc_status st =
      compliance_change(c->compliance, w, condensation_reach(c), condensation_more_rate(c), ds, dd, &dG);
  if (st == HC_OK) return dG;
  c->by_compliance[h] = condensation_by_rest(c, h) != HC_OK;
  return NULL;
}

/* dS a = -S dG S a; vector[2][dim]. */
static void apply_by_compliance(const condensation *c, int h, const double complex *dG, const double complex *a,
                                double complex *vector, double complex *dS_a)
{
  const int dim = c->basis.dim;
  const double complex *S = condensation_stiffness(c, h);
  double complex *force = vector, *motion = vector + dim;
  condensation_multiply(dim, S, a, force);
  condensation_multiply(dim, dG, force, motion);
  condensation_multiply(dim, S, motion, dS_a);
  for (int d = 0; d < dim; ++d) dS_a[d] = -dS_a[d];
}

/* inner[rest] -= dZ_yy y. */
static void subtract_rest(const condensation *c, int h, condensation_change by, const double complex *y,
                          double complex *inner)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const bool diagonal = condensation_rest_is_diagonal(c, h);
  for (int i = 0; i < rest && diagonal; ++i)
    inner[i] -= condensation_change_at(c, by, condensation_entry(c, dim + i, dim + i)) * y[i];
  for (int k = 0; k < rest && !diagonal; ++k)
    for (int i = 0; i < rest; ++i)
      inner[i] -= condensation_change_at(c, by, condensation_entry(c, dim + i, dim + k)) * y[k];
}

/* out[dim] -= dZ_qy y + Z_qy Z_yy^-1 inner. */
static void subtract_coupling(const condensation *c, int h, condensation_change by, const double complex *y,
                              const double complex *inner, double complex *out)
{
  const size_t dim = (size_t)c->basis.dim, rest = (size_t)c->basis.rest;
  const double complex *by_y = c->by_y + (size_t)h * dim * rest;
  for (size_t d = 0; d < dim; ++d)
    for (size_t i = 0; i < rest; ++i)
      out[d] -= by_y[d * rest + i] * inner[i] +
                condensation_change_at(c, by, condensation_entry(c, (int)d, (int)(dim + i))) * y[i];
}

/* dS a = dZ_qq a - Z_qy Z_yy^-1 (dZ_yq a - dZ_yy W a) - dZ_qy W a,   W = Z_yy^-1 Z_yq. */
static void apply_by_rest(const condensation *c, int h, condensation_change by, const double complex *a,
                          double complex *vector, double complex *dS_a)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const double complex *W = c->by_q + (size_t)h * (size_t)dim * (size_t)rest;
  double complex *y = vector, *inner = vector + rest;
  memset(vector, 0, 2 * (size_t)rest * sizeof *vector);
  for (int e = 0; e < dim; ++e) {
    for (int d = 0; d < dim; ++d) dS_a[d] += condensation_change_at(c, by, condensation_entry(c, d, e)) * a[e];
    for (int i = 0; i < rest; ++i) {
      y[i] += W[(size_t)e * (size_t)rest + (size_t)i] * a[e];
      inner[i] += condensation_change_at(c, by, condensation_entry(c, dim + i, e)) * a[e];
    }
  }
  subtract_rest(c, h, by, y, inner);
  subtract_coupling(c, h, by, y, inner, dS_a);
}

void condensation_stiffness_change(condensation *c, int h, condensation_change by, const double complex *a,
                                   double complex *dS_a)
{
  memset(dS_a, 0, (size_t)c->basis.dim * sizeof *dS_a);
  if (by.alpha == 0 && by.beta == 0) return; /* at rest */
  const double complex *dG = change_by_compliance(c, h, by);
  if (dG) apply_by_compliance(c, h, dG, a, c->vector, dS_a);
  else apply_by_rest(c, h, by, a, c->vector, dS_a);
}

/* p = S g:  dp = dS g + S dg. */
static void load_change_by_compliance(condensation *c, int l, const double complex *dG, double complex *dp)
{
  const size_t dim = (size_t)c->basis.dim;
  const int h = c->m->loads[l].harmonic;
  const double complex *dg = dG + dim * dim + 2 * (size_t)l * dim;
  double complex *motion = c->room;
  apply_by_compliance(c, h, dG, c->motion + (size_t)l * dim, c->vector, dp);
  for (size_t d = 0; d < dim; ++d) motion[d] = dg[d] - I * dg[dim + d];
  condensation_multiply(c->basis.dim, condensation_stiffness(c, h), motion, c->vector);
  for (size_t d = 0; d < dim; ++d) dp[d] += c->vector[d];
}

/* dp = Z_qy Z_yy^-1 dZ_yy Z_yy^-1 p_y - dZ_qy Z_yy^-1 p_y. */
static void load_change_by_rest(condensation *c, int l, condensation_change by, double complex *dp)
{
  const size_t rest = (size_t)c->basis.rest;
  const int h = c->m->loads[l].harmonic;
  const double complex *y = c->rest_of + (size_t)l * rest;
  memset(c->vector, 0, rest * sizeof *c->vector);
  subtract_rest(c, h, by, y, c->vector);
  subtract_coupling(c, h, by, y, c->vector, dp);
}

void condensation_load_change(condensation *c, int l, condensation_change by, double complex *dp)
{
  const int h = c->m->loads[l].harmonic;
  memset(dp, 0, (size_t)c->basis.dim * sizeof *dp);
  if (by.alpha == 0 && by.beta == 0) return;
  const double complex *dG = change_by_compliance(c, h, by);
  if (dG) load_change_by_compliance(c, l, dG, dp);
  else load_change_by_rest(c, l, by, dp);
}

/* row = G_r S, rest = g_r - G_r p. */
static bool response_by_compliance(condensation *c, int h, int r, double factor, double complex *row,
                                   double complex *rest_of_it)
{
  const int dim = c->basis.dim;
  double complex *G_r = c->vector, *g_r = c->room;
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
  if (response_by_compliance(c, h, r, factor, row, rest_of_it)) return;
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
  if (c->by_compliance[h]) {
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
