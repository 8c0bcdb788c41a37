/* condensation.c - see condensation.h. */
#include "hbm/structure/condensation.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/structure/compliance.h"
#include "hbm/structure/condensation_basis.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"

struct condensation {
  const model *m;
  int n_harm;
  condensation_basis basis;
  compliance *compliance; /* sum over modes for a large rest; NULL: not used */
  double more_mass;       /* [1/mass] n/trace M */
  /* the rest is valid for the last condensation_at; [h] is harmonic h */
  double omega, more_damping;
  condensation_damping *damping; /* NULL: viscous, i h omega C */
  bool known;
  bool loaded;               /* dim = n only: `load` is filled; later only inertial loads change with omega */
  bool *by_compliance;       /* [n_harm + 1] S of the harmonic is from the compliance */
  double complex *motion;    /* [n_loads][dim] q under a load alone, without contacts; of harmonics by_compliance */
  double complex *workspace; /* [2 n_loads][dim] */
  double complex *vector;    /* [2][dim + rest] work of responses and derivatives */
  double complex *S;         /* [n_harm + 1][dim][dim] */
  double *size;              /* [dim][dim] result of condensation_sizes */
  double complex *by_q;      /* [n_harm + 1][dim][rest]: Z_yy^-1 Z_yq */
  double complex *by_y;      /* [n_harm + 1][dim][rest]: (Z_qy Z_yy^-1)^T */
  double complex *load;      /* [n_loads][dim] */
  double complex *rest_of;   /* [n_loads][rest]: Z_yy^-1 p_y */
  double complex *Zyy;       /* [rest][rest] where it is not diagonal; else [rest], its inverse */
  int *pivot;                /* [rest] */
  workspace memory;          /* of all of these */
};

/* Coefficients of Z = K + alpha M + beta C at harmonic h. */
static condensation_change dynamic_at(const condensation *c, int h)
{
  const double w = h * c->omega;
  const double complex of_C = c->damping ? c->damping(h, c->omega, &(double complex){0}) : I * w;
  return (condensation_change){-w * w + I * (w * c->more_damping * c->more_mass), of_C, 0};
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

/* True if Z_yy of harmonic h is diagonal; for h = 0 damping does not matter. */
static bool rest_is_diagonal(const condensation *c, int h) { return c->basis.diagonal || (c->basis.modes && h == 0); }

/* Arguments of compliance.h for harmonic h: w, reach. */
static double condensation_frequency(const condensation *c, int h) { return h * c->omega; }
static double condensation_reach(const condensation *c) { return condensation_frequency(c, c->n_harm); }
static double more_rate(const condensation *c) { return c->more_damping * c->more_mass; }

/* Least size of the rest for which the sum over modes is the faster way. */
enum { LARGE = 24 };

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
    c->by_compliance = workspace_array(&c->memory, H, sizeof *c->by_compliance);
    c->motion = workspace_array(&c->memory, loads * dim, sizeof *c->motion);
    c->workspace = workspace_array(&c->memory, 2 * loads * dim, sizeof *c->workspace);
    c->vector = workspace_array(&c->memory, 2 * (size_t)m->n, sizeof *c->vector);
    c->S = workspace_array(&c->memory, H * dim * dim, sizeof *c->S);
    c->size = workspace_array(&c->memory, dim * dim + 1, sizeof *c->size);
    c->by_q = workspace_array(&c->memory, H * dim * rest, sizeof *c->by_q);
    c->by_y = workspace_array(&c->memory, H * dim * rest, sizeof *c->by_y);
    c->load = workspace_array(&c->memory, loads * dim, sizeof *c->load);
    c->rest_of = workspace_array(&c->memory, loads * rest, sizeof *c->rest_of);
    c->Zyy = workspace_array(&c->memory, rest * rest, sizeof *c->Zyy);
    c->pivot = workspace_array(&c->memory, rest + 1, sizeof *c->pivot);
    if (c->memory.failed) st = HC_NO_MEMORY;
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
  workspace_free(&c->memory);
  free(c);
}

void condensation_damp(condensation *c, condensation_damping *damping)
{
  c->damping = damping;
  compliance_free(c->compliance); /* valid for viscous damping only */
  c->compliance = NULL;
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

const double *condensation_rounding(const condensation *c) { return c->basis.rounding; }

const double *condensation_first_response(const condensation *c) { return c->basis.responses; }

/* ---- at one omega ----------------------------------------------------------------------------- */

/* Z_yy of harmonic h, factored (or its inverse where diagonal). HC_NOT_FINITE if singular. */
static hc_status prepare_rest(condensation *c, int h, condensation_change dynamic)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const bool diagonal = rest_is_diagonal(c, h);
  for (int i = 0; i < rest && diagonal; ++i) {
    const double complex z = Z_at(c, dynamic, entry(c, dim + i, dim + i));
    if (!(cabs(z) > 0)) return HC_NOT_FINITE;
    c->Zyy[i] = 1 / z;
  }
  if (diagonal || rest == 0) return HC_OK;
  for (int col = 0; col < rest; ++col)
    for (int row = 0; row < rest; ++row)
      c->Zyy[(size_t)col * (size_t)rest + (size_t)row] = Z_at(c, dynamic, entry(c, dim + row, dim + col));
  return dense_factor_complex(rest, c->Zyy, c->pivot) == HC_OK ? HC_OK : HC_NOT_FINITE;
}

/* y[columns][rest] := Z_yy^-1 y, or with its transpose. */
static void solve_rest(const condensation *c, int h, bool transposed, int columns, double complex *y)
{
  const int rest = c->basis.rest;
  const bool diagonal = rest_is_diagonal(c, h);
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
      c->by_q[at] = Z_at(c, dynamic, entry(c, dim + i, e));
      c->by_y[at] = Z_at(c, dynamic, entry(c, e, dim + i));
    }
  solve_rest(c, h, false, dim, c->by_q + start);
  solve_rest(c, h, true, dim, c->by_y + start);
}

static double load_factor(const condensation *c, int l) { return model_load_factor(c->m->loads[l].inertial, c->omega); }

/* p and Z_yy^-1 p_y of load l. */
static void fill_load(condensation *c, int l)
{
  const int dim = c->basis.dim, rest = c->basis.rest, h = c->m->loads[l].harmonic;
  const double *cosine = c->basis.loads + (size_t)(2 * l) * (size_t)c->m->n, *sine = cosine + c->m->n;
  double complex *y = c->rest_of + (size_t)l * (size_t)rest, *p = c->load + (size_t)l * (size_t)dim;
  const double complex *by_y = c->by_y + (size_t)h * (size_t)dim * (size_t)rest;
  const double factor = load_factor(c, l);
  for (int i = 0; i < rest; ++i) y[i] = factor * (cosine[dim + i] - I * sine[dim + i]);
  for (int d = 0; d < dim; ++d) {
    p[d] = factor * (cosine[d] - I * sine[d]);
    for (int i = 0; i < rest; ++i) p[d] -= by_y[(size_t)d * (size_t)rest + (size_t)i] * y[i];
  }
  solve_rest(c, h, false, 1, y);
}

/* S, couplings and loads of harmonic h by eliminating the rest. HC_NOT_FINITE where Z_yy is singular. */
static hc_status fill_by_rest(condensation *c, int h)
{
  const condensation_change dynamic = dynamic_at(c, h);
  hc_status st = prepare_rest(c, h, dynamic);
  if (st != HC_OK) return st;
  /* For h = 0 K does not couple q with modes of the rest: S = K_qq, p = p_q, and by_q, by_y stay 0. */
  const bool uncoupled = h == 0 && c->basis.modes;
  const int dim = c->basis.dim;
  for (int e = 0; e < dim && uncoupled; ++e)
    for (int d = 0; d < dim; ++d) c->S[e * dim + d] = c->basis.K[entry(c, d, e)];
  if (!uncoupled) {
    fill_couplings(c, h, dynamic);
    const int of_dim = c->basis.dim, rest = c->basis.rest;
    const double complex *by_q = c->by_q + (size_t)h * (size_t)of_dim * (size_t)rest;
    for (int e = 0; e < of_dim; ++e)
      for (int d = 0; d < of_dim; ++d) {
        const size_t at = entry(c, d, e), to = ((size_t)h * (size_t)of_dim + (size_t)e) * (size_t)of_dim + (size_t)d;
        double complex sum = Z_at(c, dynamic, at);
        for (int i = 0; i < rest; ++i)
          sum -= Z_at(c, dynamic, entry(c, d, of_dim + i)) * by_q[(size_t)e * (size_t)rest + (size_t)i];
        c->S[to] = sum;
      }
  }
  for (int l = 0; l < c->m->n_loads; ++l)
    if (c->m->loads[l].harmonic == h) fill_load(c, l);
  return HC_OK;
}

/* out[dim] = S a. */
static void condensation_multiply(int dim, const double complex *S, const double complex *a, double complex *out)
{
  for (int d = 0; d < dim; ++d) out[d] = 0;
  for (int e = 0; e < dim; ++e)
    for (int d = 0; d < dim; ++d) out[d] += S[(size_t)e * (size_t)dim + (size_t)d] * a[e];
}

/* S and the loads of harmonic h by the sum over modes; false if it is not available or not reliable at this omega. */
static bool fill_by_compliance(condensation *c, int h)
{
  const size_t dim = (size_t)c->basis.dim;
  double complex *S = c->S + (size_t)h * dim * dim;
  if (!c->compliance || h == 0) return false;
  if (compliance_at(c->compliance, condensation_frequency(c, h), condensation_reach(c), more_rate(c), S,
                    c->workspace) != HC_OK)
    return false;
  for (size_t l = 0; l < (size_t)c->m->n_loads; ++l) {
    if (c->m->loads[l].harmonic != h) continue;
    for (size_t d = 0; d < dim; ++d)
      c->motion[l * dim + d] =
          load_factor(c, (int)l) * (c->workspace[2 * l * dim + d] - I * c->workspace[(2 * l + 1) * dim + d]);
    condensation_multiply(c->basis.dim, S, c->motion + l * dim, c->load + l * dim);
  }
  return true;
}

hc_status condensation_at(condensation *c, double omega, double more_damping)
{
  if (c->known && omega == c->omega && more_damping == c->more_damping) return HC_OK;
  c->omega = omega;
  c->more_damping = more_damping;
  c->known = false;
  hc_status st = HC_OK;
  /* Without a rest S = Z, and loads are as the model has them. */
  if (c->basis.rest == 0) {
    const size_t entries = (size_t)c->basis.dim * (size_t)c->basis.dim;
    double complex *S = c->S;
    for (int h = 0; h <= c->n_harm; ++h) {
      const condensation_change dynamic = dynamic_at(c, h);
      for (size_t at = 0; at < entries; ++at) *S++ = Z_at(c, dynamic, at);
    }
    for (int l = 0; l < c->m->n_loads; ++l)
      if (c->m->loads[l].harmonic <= c->n_harm && (!c->loaded || c->m->loads[l].inertial)) fill_load(c, l);
    c->loaded = true;
  }
  for (int h = 0; h <= c->n_harm && st == HC_OK && c->basis.rest > 0; ++h) {
    c->by_compliance[h] = fill_by_compliance(c, h);
    if (!c->by_compliance[h]) st = fill_by_rest(c, h);
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
  const bool coupled = !c->by_compliance[h] && !(h == 0 && c->basis.modes); /* fill_by_rest */
  const condensation_change dynamic = dynamic_at(c, h);
  const double alpha = cabs(dynamic.alpha), beta = cabs(dynamic.beta);
  const double complex *S = condensation_stiffness(c, h), *by_q = c->by_q + (size_t)h * (size_t)dim * (size_t)rest;
  for (int e = 0; e < dim; ++e)
    for (int d = 0; d < dim; ++d) {
      const size_t at = entry(c, d, e), to = (size_t)e * (size_t)dim + (size_t)d;
      double size = fabs(c->basis.K[at]) + alpha * fabs(c->basis.M[at]) + beta * fabs(c->basis.C[at]);
      if (c->by_compliance[h]) size += cabs(S[to] - Z_at(c, dynamic, at));
      for (int i = 0; i < rest && coupled; ++i)
        size += cabs(Z_at(c, dynamic, entry(c, d, dim + i)) * by_q[(size_t)e * (size_t)rest + (size_t)i]);
      c->size[to] = size;
    }
  return c->size;
}

bool condensation_is_by_modes(const condensation *c, int h) { return c->by_compliance[h]; }

const double complex *condensation_load(const condensation *c, int i)
{
  return c->load + (size_t)i * (size_t)c->basis.dim;
}

/* ---- derivatives and responses -------------------------------------------------------------------- */

condensation_change condensation_by_omega(const condensation *c, int h)
{
  double complex of_C = I * h;
  if (c->damping) c->damping(h, c->omega, &of_C);
  return (condensation_change){-2.0 * h * h * c->omega + I * (h * c->more_damping * c->more_mass), of_C, 2 / c->omega};
}

condensation_change condensation_by_damping(const condensation *c, int h)
{
  return (condensation_change){I * (h * c->omega * c->more_mass), 0, 0};
}

/* dG and dg of compliance.h. NULL if not available: the harmonic is then by Z_yy (fill_by_rest). */
static const double complex *change_by_compliance(condensation *c, int h, condensation_change by)
{
  const double w = condensation_frequency(c, h);
  const double complex ds = by.beta, dd = by.beta == 0 ? by.alpha / (I * w) : 0, *dG;
  if (!c->by_compliance[h]) return NULL;
  const hc_status st = compliance_change(c->compliance, w, condensation_reach(c), more_rate(c), ds, dd, &dG);
  if (st == HC_OK) return dG;
  c->by_compliance[h] = fill_by_rest(c, h) != HC_OK;
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
  const bool diagonal = rest_is_diagonal(c, h);
  for (int i = 0; i < rest && diagonal; ++i) inner[i] -= change_at(c, by, entry(c, dim + i, dim + i)) * y[i];
  for (int k = 0; k < rest && !diagonal; ++k)
    for (int i = 0; i < rest; ++i) inner[i] -= change_at(c, by, entry(c, dim + i, dim + k)) * y[k];
}

/* out[dim] -= dZ_qy y + Z_qy Z_yy^-1 inner. */
static void subtract_coupling(const condensation *c, int h, condensation_change by, const double complex *y,
                              const double complex *inner, double complex *out)
{
  const size_t dim = (size_t)c->basis.dim, rest = (size_t)c->basis.rest;
  const double complex *by_y = c->by_y + (size_t)h * dim * rest;
  for (size_t d = 0; d < dim; ++d)
    for (size_t i = 0; i < rest; ++i)
      out[d] -= by_y[d * rest + i] * inner[i] + change_at(c, by, entry(c, (int)d, (int)(dim + i))) * y[i];
}

/* dS a = dZ_qq a - Z_qy Z_yy^-1 (dZ_yq a - dZ_yy W a) - dZ_qy W a,   W = Z_yy^-1 Z_yq. */
static void apply_by_rest(const condensation *c, int h, condensation_change by, const double complex *a,
                          double complex *vector, double complex *dS_a)
{
  const int dim = c->basis.dim, rest = c->basis.rest;
  const double complex *W = c->by_q + (size_t)h * (size_t)dim * (size_t)rest;
  double complex *y = vector, *inner = vector + rest;
  for (int d = 0; d < dim; ++d) {
    dS_a[d] = 0;
    for (int e = 0; e < dim; ++e) dS_a[d] += change_at(c, by, entry(c, d, e)) * a[e];
  }
  if (rest == 0) return;
  memset(vector, 0, 2 * (size_t)rest * sizeof *vector);
  for (int e = 0; e < dim; ++e)
    for (int i = 0; i < rest; ++i) {
      y[i] += W[(size_t)e * (size_t)rest + (size_t)i] * a[e];
      inner[i] += change_at(c, by, entry(c, dim + i, e)) * a[e];
    }
  subtract_rest(c, h, by, y, inner);
  subtract_coupling(c, h, by, y, inner, dS_a);
}

void condensation_stiffness_change(condensation *c, int h, condensation_change by, const double complex *a,
                                   double complex *dS_a)
{
  if (by.alpha == 0 && by.beta == 0) { /* at rest */
    memset(dS_a, 0, (size_t)c->basis.dim * sizeof *dS_a);
    return;
  }
  const double complex *dG = c->by_compliance[h] ? change_by_compliance(c, h, by) : NULL;
  if (dG) apply_by_compliance(c, h, dG, a, c->vector, dS_a);
  else apply_by_rest(c, h, by, a, c->vector, dS_a);
}

/* By compliance p = S g: dp = dS g + S dg; by the rest dp = Z_qy Z_yy^-1 dZ_yy Z_yy^-1 p_y - dZ_qy Z_yy^-1 p_y; an
 * inertial load adds by.inertial p. */
void condensation_load_change(condensation *c, int l, condensation_change by, double complex *dp)
{
  const int h = c->m->loads[l].harmonic;
  const size_t dim = (size_t)c->basis.dim, rest = (size_t)c->basis.rest;
  memset(dp, 0, dim * sizeof *dp);
  if (by.alpha == 0 && by.beta == 0) return;
  const double complex *dG = change_by_compliance(c, h, by), *y = c->rest_of + (size_t)l * rest;
  if (dG) {
    const double complex *dg = dG + dim * dim + 2 * (size_t)l * dim;
    apply_by_compliance(c, h, dG, c->motion + (size_t)l * dim, c->vector, dp);
    for (size_t d = 0; d < dim; ++d) c->workspace[d] = load_factor(c, l) * (dg[d] - I * dg[dim + d]);
    condensation_multiply(c->basis.dim, condensation_stiffness(c, h), c->workspace, c->vector);
    for (size_t d = 0; d < dim; ++d) dp[d] += c->vector[d];
  } else {
    memset(c->vector, 0, rest * sizeof *c->vector);
    subtract_rest(c, h, by, y, c->vector);
    subtract_coupling(c, h, by, y, c->vector, dp);
  }
  for (size_t d = 0; d < dim && c->m->loads[l].inertial; ++d) dp[d] += by.inertial * c->load[(size_t)l * dim + d];
}

/* row = G_r S, rest = g_r - G_r p. */
static bool response_by_compliance(condensation *c, int h, int r, double factor, double complex *row,
                                   double complex *rest_of_it)
{
  const int dim = c->basis.dim;
  double complex *G_r = c->vector, *g_r = c->workspace;
  const double complex *S = c->S + (size_t)h * (size_t)dim * (size_t)dim;
  if (!c->by_compliance[h]) return false;
  if (compliance_of_response(c->compliance, condensation_frequency(c, h), condensation_reach(c), more_rate(c), r, G_r,
                             g_r) != HC_OK)
    return false;
  *rest_of_it = 0;
  for (int e = 0; e < dim; ++e) {
    row[e] = 0;
    for (int d = 0; d < dim; ++d) row[e] += G_r[d] * S[(size_t)e * (size_t)dim + (size_t)d];
  }
  for (int l = 0; l < c->m->n_loads; ++l) {
    if (c->m->loads[l].harmonic != h) continue;
    *rest_of_it += factor * load_factor(c, l) * (g_r[2 * l] - I * g_r[2 * l + 1]);
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
    hc_status st = fill_by_rest(c, h);
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
