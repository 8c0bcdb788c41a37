/* condensation.c - see condensation.h. */
#include "hbm/condensation.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/condensation_basis.h"
#include "numerics/dense.h"

struct condensation {
  const model *m;
  int n_harm;
  condensation_basis basis;
  double more_mass; /* [1/mass] n/trace M */
  /* at the omega asked for last; of harmonic h at [h] */
  double omega, more_damping;
  bool known;
  double complex *S;       /* [n_harm + 1][dim][dim] */
  double *size;            /* [n_harm + 1][dim][dim] */
  double complex *by_q;    /* [n_harm + 1][dim][rest]: Z_yy^-1 Z_yq */
  double complex *by_y;    /* [n_harm + 1][dim][rest]: (Z_qy Z_yy^-1)^T */
  double complex *load;    /* [n_loads][dim] */
  double complex *rest_of; /* [n_loads][rest]: Z_yy^-1 p_y */
  double complex *Zyy;     /* [rest][rest] where it is not diagonal; else [rest], its inverse */
  int *pivot;              /* [rest] */
};

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
    c->S = new_complex(H * dim * dim);
    c->size = calloc(H * dim * dim + 1, sizeof *c->size);
    c->by_q = new_complex(H * dim * rest);
    c->by_y = new_complex(H * dim * rest);
    c->load = new_complex(loads * dim);
    c->rest_of = new_complex(loads * rest);
    c->Zyy = new_complex(rest * rest);
    c->pivot = calloc(rest + 1, sizeof *c->pivot);
    const bool sums = c->S && c->size && c->by_q && c->by_y;
    if (!sums || !c->load || !c->rest_of || !c->Zyy || !c->pivot) st = HC_NO_MEMORY;
  }
  if (st == HC_OK) *out = c;
  else condensation_free(c);
  return st;
}

void condensation_free(condensation *c)
{
  if (!c) return;
  condensation_basis_clear(&c->basis);
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

const double *condensation_first_response(const condensation *c) { return c->basis.responses; }

/* ---- Z of one harmonic, entry by entry -------------------------------------------------------- */

/* What Z is at h: K + (alpha M + beta C) with these. */
static condensation_change inertia_and_damping(const condensation *c, int h)
{
  const double w = h * c->omega;
  return (condensation_change){-w * w + I * (w * c->more_damping * c->more_mass), I * w};
}

static size_t entry(const condensation *c, int row, int column)
{
  return (size_t)row + (size_t)c->m->n * (size_t)column;
}

static double complex change_at(const condensation *c, condensation_change by, size_t at)
{
  return by.alpha * c->basis.M[at] + by.beta * c->basis.C[at];
}

static double complex Z_at(const condensation *c, condensation_change dynamic, size_t at)
{
  return c->basis.K[at] + change_at(c, dynamic, at);
}

/* ---- at one omega ----------------------------------------------------------------------------- */

/* Z_yy, factored. */
static hc_status prepare_rest(condensation *c, condensation_change dynamic)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  for (int i = 0; i < rest && c->basis.diagonal; ++i) {
    const double complex z = Z_at(c, dynamic, entry(c, dim + i, dim + i));
    if (!(cabs(z) > 0)) return HC_NOT_FINITE;
    c->Zyy[i] = 1 / z;
  }
  if (c->basis.diagonal || rest == 0) return HC_OK;
  for (int col = 0; col < rest; ++col)
    for (int row = 0; row < rest; ++row)
      c->Zyy[(size_t)col * (size_t)rest + (size_t)row] = Z_at(c, dynamic, entry(c, dim + row, dim + col));
  return dense_factor_complex(rest, c->Zyy, c->pivot) == HC_OK ? HC_OK : HC_NOT_FINITE;
}

/* y[columns][rest] := Z_yy^-1 y, or with its transpose. */
static void solve_rest(const condensation *c, bool transposed, int columns, double complex *y)
{
  const int rest = c->basis.rest;
  if (rest == 0) return;
  if (!c->basis.diagonal) dense_solve_complex(rest, c->Zyy, c->pivot, transposed, columns, y);
  for (int k = 0; k < columns && c->basis.diagonal; ++k)
    for (int i = 0; i < rest; ++i) y[(size_t)k * (size_t)rest + (size_t)i] *= c->Zyy[i];
}

static void fill_couplings(condensation *c, int h, condensation_change dynamic)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const size_t start = (size_t)h * (size_t)dim * (size_t)rest;
  for (int e = 0; e < dim; ++e)
    for (int i = 0; i < rest; ++i) {
      const size_t at = start + (size_t)e * (size_t)rest + (size_t)i;
      c->by_q[at] = Z_at(c, dynamic, entry(c, dim + i, e));
      c->by_y[at] = Z_at(c, dynamic, entry(c, e, dim + i));
    }
  solve_rest(c, false, dim, c->by_q + start);
  solve_rest(c, true, dim, c->by_y + start);
}

static void fill_stiffness(condensation *c, int h, condensation_change dynamic)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const double complex *by_q = c->by_q + (size_t)h * (size_t)dim * (size_t)rest;
  for (int e = 0; e < dim; ++e)
    for (int d = 0; d < dim; ++d) {
      const size_t at = entry(c, d, e), to = ((size_t)h * (size_t)dim + (size_t)e) * (size_t)dim + (size_t)d;
      double complex sum = Z_at(c, dynamic, at);
      double size =
          fabs(c->basis.K[at]) + cabs(dynamic.alpha) * fabs(c->basis.M[at]) + cabs(dynamic.beta) * fabs(c->basis.C[at]);
      for (int i = 0; i < rest; ++i) {
        const double complex part = Z_at(c, dynamic, entry(c, d, dim + i)) * by_q[(size_t)e * (size_t)rest + (size_t)i];
        sum -= part;
        size += cabs(part);
      }
      c->S[to] = sum;
      c->size[to] = size;
    }
}

/* p and Z_yy^-1 p_y of the loads of harmonic h. */
static void fill_loads(condensation *c, int h)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  for (int l = 0; l < c->m->n_loads; ++l) {
    if (c->m->loads[l].harmonic != h) continue;
    const double *cosine = c->basis.loads + (size_t)(2 * l) * (size_t)c->m->n, *sine = cosine + c->m->n;
    double complex *y = c->rest_of + (size_t)l * (size_t)rest, *p = c->load + (size_t)l * (size_t)dim;
    const double complex *by_y = c->by_y + (size_t)h * (size_t)dim * (size_t)rest;
    for (int i = 0; i < rest; ++i) y[i] = cosine[dim + i] - I * sine[dim + i];
    for (int d = 0; d < dim; ++d) {
      p[d] = cosine[d] - I * sine[d];
      for (int i = 0; i < rest; ++i) p[d] -= by_y[(size_t)d * (size_t)rest + (size_t)i] * y[i];
    }
    solve_rest(c, false, 1, y);
  }
}

/* One degree of freedom: S = Z. */
static void fill_oscillator(condensation *c)
{
  const double K = *c->basis.K, M = *c->basis.M, C = *c->basis.C + c->more_damping, omega = c->omega;
  for (int h = 0; h <= c->n_harm; ++h) {
    c->S[h] = K - M * h * h * omega * omega + I * (C * h * omega);
    c->size[h] = K + M * h * h * omega * omega + C * h * omega;
  }
  for (int l = 0; l < c->m->n_loads; ++l) c->load[l] = c->basis.loads[2 * l] - I * c->basis.loads[2 * l + 1];
}

hc_status condensation_at(condensation *c, double omega, double more_damping)
{
  if (c->known && omega == c->omega && more_damping == c->more_damping) return HC_OK;
  c->omega = omega;
  c->more_damping = more_damping;
  c->known = false;
  hc_status st = HC_OK;
  if (c->m->n == 1) fill_oscillator(c);
  for (int h = 0; h <= c->n_harm && c->m->n > 1 && st == HC_OK; ++h) {
    const condensation_change dynamic = inertia_and_damping(c, h);
    if ((st = prepare_rest(c, dynamic)) != HC_OK) break;
    fill_couplings(c, h, dynamic);
    fill_stiffness(c, h, dynamic);
    fill_loads(c, h);
  }
  c->known = st == HC_OK;
  return st;
}

const double complex *condensation_stiffness(const condensation *c, int h)
{
  return c->S + (size_t)h * (size_t)c->basis.dim * (size_t)c->basis.dim;
}

const double *condensation_sizes(const condensation *c, int h)
{
  return c->size + (size_t)h * (size_t)c->basis.dim * (size_t)c->basis.dim;
}

const double complex *condensation_load(const condensation *c, int i)
{
  return c->load + (size_t)i * (size_t)c->basis.dim;
}

/* ---- changes ---------------------------------------------------------------------------------- */

condensation_change condensation_by_omega(const condensation *c, int h)
{
  return (condensation_change){-2.0 * h * h * c->omega + I * (h * c->more_damping * c->more_mass), I * h};
}

condensation_change condensation_by_damping(const condensation *c, int h)
{
  return (condensation_change){I * (h * c->omega * c->more_mass), 0};
}

void condensation_stiffness_change(const condensation *c, int h, condensation_change by, double complex *dS)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const size_t start = (size_t)h * (size_t)dim * (size_t)rest;
  if (c->m->n == 1) {
    *dS = change_at(c, by, 0);
    return;
  }
  for (int e = 0; e < dim; ++e) {
    const double complex *W = c->by_q + start + (size_t)e * (size_t)rest;
    for (int d = 0; d < dim; ++d) dS[(size_t)e * (size_t)dim + (size_t)d] = change_at(c, by, entry(c, d, e));
    for (int i = 0; i < rest; ++i) {
      double complex inner = change_at(c, by, entry(c, dim + i, e)); /* (dZ_yq - dZ_yy W) at (i, e) */
      if (c->basis.diagonal) inner -= change_at(c, by, entry(c, dim + i, dim + i)) * W[i];
      else
        for (int k = 0; k < rest; ++k) inner -= change_at(c, by, entry(c, dim + i, dim + k)) * W[k];
      for (int d = 0; d < dim; ++d)
        dS[(size_t)e * (size_t)dim + (size_t)d] -= c->by_y[start + (size_t)d * (size_t)rest + (size_t)i] * inner +
                                                   change_at(c, by, entry(c, d, dim + i)) * W[i];
    }
  }
}

void condensation_load_change(const condensation *c, int l, condensation_change by, double complex *dp)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const size_t start = (size_t)c->m->loads[l].harmonic * (size_t)dim * (size_t)rest;
  const double complex *y = c->rest_of + (size_t)l * (size_t)rest;
  for (int d = 0; d < dim; ++d) dp[d] = 0;
  for (int i = 0; i < rest; ++i) {
    double complex inner = 0; /* dZ_yy Z_yy^-1 p_y */
    if (c->basis.diagonal) inner = change_at(c, by, entry(c, dim + i, dim + i)) * y[i];
    else
      for (int k = 0; k < rest; ++k) inner += change_at(c, by, entry(c, dim + i, dim + k)) * y[k];
    for (int d = 0; d < dim; ++d)
      dp[d] +=
          c->by_y[start + (size_t)d * (size_t)rest + (size_t)i] * inner - change_at(c, by, entry(c, d, dim + i)) * y[i];
  }
}

void condensation_response(const condensation *c, int h, int r, double factor, double complex *row,
                           double complex *rest_of_it)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
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
