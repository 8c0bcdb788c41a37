/* condensation.c - see condensation.h. */
#include "hbm/structure/condensation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/structure/condensation_impl.h"
#include "numerics/dense.h"

/* With a rest at least as large its modes pay. */
enum { LARGE = 24 };

static double complex *new_complex(size_t n) { return calloc(n + 1, sizeof(double complex)); }

hc_status condensation_new(const model *m, int n_harm, condensation **out)
{
  condensation *c = calloc(1, sizeof *c);
  *out = NULL;
  if (!c) return HC_NO_MEMORY;
  c->m = m;
  c->n_harm = n_harm;
  for (int i = 0; i < m->n; ++i) c->more_mass += m->mass[(size_t)i * (size_t)(m->n + 1)] / m->n;
  c->more_mass = 1 / c->more_mass;
  hc_status st = condensation_basis_make(m, &c->basis);
  const size_t H = (size_t)n_harm + 1, dim = (size_t)c->basis.dim, rest = (size_t)c->basis.rest,
               loads = (size_t)m->n_loads;
  if (st == HC_OK) {
    c->by_compliance = calloc(H, sizeof *c->by_compliance);
    c->motion = new_complex(loads * dim);
    c->room = new_complex(2 * loads * dim);
    c->vector = new_complex(2 * (size_t)m->n);
    c->S = new_complex(H * dim * dim);
    c->size = calloc(dim * dim + 1, sizeof *c->size);
    c->by_q = new_complex(H * dim * rest);
    c->by_y = new_complex(H * dim * rest);
    c->load = new_complex(loads * dim);
    c->rest_of = new_complex(loads * rest);
    c->Zyy = new_complex(rest * rest);
    c->pivot = calloc(rest + 1, sizeof *c->pivot);
    const bool sums = c->S && c->size && c->by_q && c->by_y && c->by_compliance && c->motion && c->room && c->vector;
    if (!sums || !c->load || !c->rest_of || !c->Zyy || !c->pivot) st = HC_NO_MEMORY;
  }
  if (st == HC_OK && c->basis.rest >= LARGE) st = compliance_new(m, c->basis.dim, c->basis.rows, &c->compliance);
  if (st == HC_OK) *out = c;
  else condensation_free(c);
  return st;
}

void condensation_free(condensation *c)
{
  if (!c) return;
  condensation_basis_clear(&c->basis);
  compliance_free(c->compliance);
  free(c->by_compliance);
  free(c->motion);
  free(c->room);
  free(c->vector);
  free(c->S);
  free(c->size);
  free(c->by_q);
  free(c->by_y);
  free(c->load);
  free(c->rest_of);
  free(c->Zyy);
  free(c->pivot);
  free(c);
}

int condensation_dim(const condensation *c) { return c->basis.dim; }

const double *condensation_tangent(const condensation *c, int j)
{
  return c->basis.directions + (size_t)(2 * j) * (size_t)c->basis.dim;
}

const double *condensation_normal(const condensation *c, int j)
{
  return c->basis.directions + (size_t)(2 * j + 1) * (size_t)c->basis.dim;
}

void condensation_coordinates(const condensation *c, const double *x, double *q)
{
  const int n = c->basis.n;
  const double *row = c->basis.rows;
  for (int d = 0; d < c->basis.dim; ++d, row += n) {
    q[d] = c->basis.rest > 0 ? 0 : x[d];
    for (int i = 0; i < n && c->basis.rest > 0; ++i) q[d] += row[i] * x[i];
  }
}

const double *condensation_first_response(const condensation *c) { return c->basis.responses; }

/* ---- at one omega ----------------------------------------------------------------------------- */

/* Z_yy, factored. */
static hc_status prepare_rest(condensation *c, int h, condensation_change dynamic)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const bool diagonal = condensation_rest_is_diagonal(c, h);
  for (int i = 0; i < rest && diagonal; ++i) {
    const double complex z = condensation_Z_at(c, dynamic, condensation_entry(c, dim + i, dim + i));
    if (!(cabs(z) > 0)) return HC_NOT_FINITE;
    c->Zyy[i] = 1 / z;
  }
  if (diagonal || rest == 0) return HC_OK;
  for (int col = 0; col < rest; ++col)
    for (int row = 0; row < rest; ++row)
      c->Zyy[(size_t)col * (size_t)rest + (size_t)row] =
          condensation_Z_at(c, dynamic, condensation_entry(c, dim + row, dim + col));
  return dense_factor_complex(rest, c->Zyy, c->pivot) == HC_OK ? HC_OK : HC_NOT_FINITE;
}

/* y[columns][rest] := Z_yy^-1 y, or with its transpose. */
static void solve_rest(const condensation *c, int h, bool transposed, int columns, double complex *y)
{
  const int rest = c->basis.rest;
  const bool diagonal = condensation_rest_is_diagonal(c, h);
  if (rest == 0) return;
  if (!diagonal) dense_solve_complex(rest, c->Zyy, c->pivot, transposed, columns, y);
  for (int k = 0; k < columns && diagonal; ++k)
    for (int i = 0; i < rest; ++i) y[(size_t)k * (size_t)rest + (size_t)i] *= c->Zyy[i];
}

static void fill_couplings(condensation *c, int h, condensation_change dynamic)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const size_t start = (size_t)h * (size_t)dim * (size_t)rest;
  for (int e = 0; e < dim; ++e)
    for (int i = 0; i < rest; ++i) {
      const size_t at = start + (size_t)e * (size_t)rest + (size_t)i;
      c->by_q[at] = condensation_Z_at(c, dynamic, condensation_entry(c, dim + i, e));
      c->by_y[at] = condensation_Z_at(c, dynamic, condensation_entry(c, e, dim + i));
    }
  solve_rest(c, h, false, dim, c->by_q + start);
  solve_rest(c, h, true, dim, c->by_y + start);
}

static void fill_stiffness(condensation *c, int h, condensation_change dynamic)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const double complex *by_q = c->by_q + (size_t)h * (size_t)dim * (size_t)rest;
  for (int e = 0; e < dim; ++e)
    for (int d = 0; d < dim; ++d) {
      const size_t at = condensation_entry(c, d, e),
                   to = ((size_t)h * (size_t)dim + (size_t)e) * (size_t)dim + (size_t)d;
      double complex sum = condensation_Z_at(c, dynamic, at);
      for (int i = 0; i < rest; ++i)
        sum -= condensation_Z_at(c, dynamic, condensation_entry(c, d, dim + i)) *
               by_q[(size_t)e * (size_t)rest + (size_t)i];
      c->S[to] = sum;
    }
}

/* p and Z_yy^-1 p_y of load l. */
static void fill_load(condensation *c, int l)
{
  const int dim = c->basis.dim, rest = c->basis.rest, h = c->m->loads[l].harmonic;
  const double *cosine = c->basis.loads + (size_t)(2 * l) * (size_t)c->m->n, *sine = cosine + c->m->n;
  double complex *y = c->rest_of + (size_t)l * (size_t)rest, *p = c->load + (size_t)l * (size_t)dim;
  const double complex *by_y = c->by_y + (size_t)h * (size_t)dim * (size_t)rest;
  for (int i = 0; i < rest; ++i) y[i] = cosine[dim + i] - I * sine[dim + i];
  for (int d = 0; d < dim; ++d) {
    p[d] = cosine[d] - I * sine[d];
    for (int i = 0; i < rest; ++i) p[d] -= by_y[(size_t)d * (size_t)rest + (size_t)i] * y[i];
  }
  solve_rest(c, h, false, 1, y);
}

/* At rest K couples q and modes of the rest nowhere: S = K_qq, p = p_q, and no coupling is ever anything but 0. */
static void fill_static(condensation *c)
{
  const int dim = c->basis.dim;
  for (int e = 0; e < dim; ++e)
    for (int d = 0; d < dim; ++d) c->S[e * dim + d] = c->basis.K[condensation_entry(c, d, e)];
}

hc_status condensation_by_rest(condensation *c, int h)
{
  const condensation_change dynamic = condensation_dynamic(c, h);
  hc_status st = prepare_rest(c, h, dynamic);
  if (st != HC_OK) return st;
  const bool uncoupled = h == 0 && c->basis.modes;
  if (uncoupled) fill_static(c);
  else fill_couplings(c, h, dynamic);
  if (!uncoupled) fill_stiffness(c, h, dynamic);
  for (int l = 0; l < c->m->n_loads; ++l)
    if (c->m->loads[l].harmonic == h) fill_load(c, l);
  return HC_OK;
}

void condensation_multiply(int dim, const double complex *S, const double complex *a, double complex *out)
{
  for (int d = 0; d < dim; ++d) out[d] = 0;
  for (int e = 0; e < dim; ++e)
    for (int d = 0; d < dim; ++d) out[d] += S[(size_t)e * (size_t)dim + (size_t)d] * a[e];
}

/* S and the loads of harmonic h by a sum over modes, if there is one to rely on here. */
static bool fill_by_compliance(condensation *c, int h)
{
  const size_t dim = (size_t)c->basis.dim;
  double complex *S = c->S + (size_t)h * dim * dim;
  if (!c->compliance || h == 0) return false;
  if (compliance_at(c->compliance, condensation_frequency(c, h), condensation_reach(c), condensation_more_rate(c), S,
                    c->room) != HC_OK)
    return false;
  for (size_t l = 0; l < (size_t)c->m->n_loads; ++l) {
    if (c->m->loads[l].harmonic != h) continue;
    for (size_t d = 0; d < dim; ++d)
      c->motion[l * dim + d] = c->room[2 * l * dim + d] - I * c->room[(2 * l + 1) * dim + d];
    condensation_multiply(c->basis.dim, S, c->motion + l * dim, c->load + l * dim);
  }
  return true;
}

/* Without a rest S = Z, and loads are as the model has them. */
static void fill_whole(condensation *c)
{
  const size_t entries = (size_t)c->basis.dim * (size_t)c->basis.dim;
  double complex *S = c->S;
  for (int h = 0; h <= c->n_harm; ++h) {
    const condensation_change dynamic = condensation_dynamic(c, h);
    for (size_t at = 0; at < entries; ++at) *S++ = condensation_Z_at(c, dynamic, at);
  }
  for (int l = 0; l < c->m->n_loads; ++l)
    if (c->m->loads[l].harmonic <= c->n_harm) fill_load(c, l);
}

hc_status condensation_at(condensation *c, double omega, double more_damping)
{
  if (c->known && omega == c->omega && more_damping == c->more_damping) return HC_OK;
  c->omega = omega;
  c->more_damping = more_damping;
  c->known = false;
  hc_status st = HC_OK;
  if (c->basis.rest == 0) fill_whole(c);
  for (int h = 0; h <= c->n_harm && st == HC_OK && c->basis.rest > 0; ++h) {
    c->by_compliance[h] = fill_by_compliance(c, h);
    if (!c->by_compliance[h]) st = condensation_by_rest(c, h);
  }
  c->known = st == HC_OK;
  return st;
}

const double complex *condensation_stiffness(const condensation *c, int h)
{
  return c->S + (size_t)h * (size_t)c->basis.dim * (size_t)c->basis.dim;
}

const double *condensation_sizes(condensation *c, int h)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const condensation_change dynamic = condensation_dynamic(c, h);
  const double alpha = cabs(dynamic.alpha), beta = cabs(dynamic.beta);
  const double complex *S = condensation_stiffness(c, h), *by_q = c->by_q + (size_t)h * (size_t)dim * (size_t)rest;
  for (int e = 0; e < dim; ++e)
    for (int d = 0; d < dim; ++d) {
      const size_t at = condensation_entry(c, d, e), to = (size_t)e * (size_t)dim + (size_t)d;
      double size = fabs(c->basis.K[at]) + alpha * fabs(c->basis.M[at]) + beta * fabs(c->basis.C[at]);
      if (c->by_compliance[h]) size += cabs(S[to] - condensation_Z_at(c, dynamic, at));
      for (int i = 0; i < rest && !c->by_compliance[h]; ++i)
        size += cabs(condensation_Z_at(c, dynamic, condensation_entry(c, d, dim + i)) *
                     by_q[(size_t)e * (size_t)rest + (size_t)i]);
      c->size[to] = size;
    }
  return c->size;
}

const double complex *condensation_load(const condensation *c, int i)
{
  return c->load + (size_t)i * (size_t)c->basis.dim;
}
