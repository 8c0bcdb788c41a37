/* condensation_basis.c - see condensation_basis.h. The rows are the directions of all contacts, and the first response.
 *   q    the motions along those rows that are as independent as they can be chosen (pivoted QR): row P = 1. A row that
 *        is nearly a combination of rows chosen before is replaced by its normalised component orthogonal to them: as
 *        a coordinate the row itself would give motions and forces that are 1/(that component) times as large
 *   y    motions that move none of the rows, as modes; P is corrected so that K does not couple q and y (P^T K Y = 0)
 * Where the rows span everything, q = x. */
#include "hbm/structure/condensation_basis.h"

#include <float.h>
#include <string.h>

#include "numerics/dense.h"
#include "numerics/norm.h"

/* Relative length of a row's new component below which the row counts as dependent: rounding of the case file's
 * numbers. */
static const double dependent = 1e-10;
/* Relative length of a row's new component below which that component, not the row, becomes the coordinate. Contacts'
 * directions then have fewer zeros; nothing else changes. */
static const double little = 0.1;
/* Entries of a direction below this part of its largest are set to 0: rounding of the change of coordinates. */
static const double negligible = 1e-12;
/* A mode of the rest is free if its eigenvalue is less than this part of the largest. */
static const double free_mode = 1e-14;

static size_t square(int n) { return (size_t)n * (size_t)n; }

static hc_status allocate(const model *m, condensation_basis *b)
{
  const size_t n = (size_t)m->n;
  double **const squares[] = {&b->T, &b->M, &b->C, &b->K};
  for (size_t i = 0; i < sizeof squares / sizeof *squares; ++i) *squares[i] = workspace_doubles(&b->memory, n * n);
  b->rows = workspace_doubles(&b->memory, n * (2 * (size_t)m->n_contacts + 1));
  b->directions = workspace_doubles(&b->memory, 2 * n * (size_t)m->n_contacts + 1);
  b->loads = workspace_doubles(&b->memory, 2 * n * (size_t)m->n_loads + 1);
  b->responses = workspace_doubles(&b->memory, n * (size_t)m->n_responses + 1);
  b->rounding = workspace_doubles(&b->memory, n);
  return b->memory.failed ? HC_NO_MEMORY : HC_OK;
}

void condensation_basis_clear(condensation_basis *b)
{
  workspace_free(&b->memory);
  *b = (condensation_basis){0};
}

/* ---- the columns of T -------------------------------------------------------------------------- */

/* The columns of Q that span the rows become P with row P = 1 for the chosen rows: P = Q R^-T. */
static void make_unit_motions(int n, int dim, const double *R, double *Q)
{
  for (int row = 0; row < n; ++row)
    for (int j = dim - 1; j >= 0; --j) { /* R^T P^T = Q^T from the right: P_j = (Q_j - sum_k>j P_k R_jk) / R_jj */
      double sum = Q[(size_t)row + (size_t)j * (size_t)n];
      for (int k = j + 1; k < dim; ++k)
        sum -= Q[(size_t)row + (size_t)k * (size_t)n] * R[(size_t)j + (size_t)k * (size_t)dim];
      Q[(size_t)row + (size_t)j * (size_t)n] = sum / R[(size_t)j * (size_t)(dim + 1)];
    }
}

/* Rows of the contacts and the first response into row[]; their number. */
static int collect_rows(const model *m, const double **row)
{
  int n = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    row[n++] = m->contacts[j].tangent;
    row[n++] = m->contacts[j].normal;
  }
  if (m->n_responses) row[n++] = m->responses;
  return n;
}

/* The chosen rows, normalised, for q = rows x; R is changed so that the rows stay Q R. */
static void keep_rows(const model *m, const double *const *row, const int *pivot, double *R, condensation_basis *b)
{
  const size_t n = (size_t)m->n, dim = (size_t)b->dim;
  for (size_t d = 0; d < dim; ++d) {
    const bool new_part = fabs(R[d * (dim + 1)]) < little;
    const double *from = new_part ? b->T + d * n : row[pivot[d]], length = sqrt(dot_product(m->n, from, from));
    for (size_t i = 0; i < n; ++i) b->rows[d * n + i] = from[i] / length;
    for (size_t k = 0; k <= d && new_part; ++k) R[d * dim + k] = k == d;
  }
}

/* ---- modes of the rest ------------------------------------------------------------------------- */

/* Y := Y phi, then P := P - Y lambda^-1 (Y^T K P): static forces of q move no y. work[2 n n]. */
static void turn_to_modes(const model *m, condensation_basis *b, const double *lambda, const double *phi, double *work)
{
  const int n = m->n, dim = b->dim, rest = b->rest;
  double *P = b->T, *Y = P + (size_t)dim * (size_t)n, *part = b->K, *KP = work; /* M, C, K are made afterwards */
  dense_multiply(n, rest, rest, Y, phi, work);
  memcpy(Y, work, (size_t)n * (size_t)rest * sizeof *Y);
  dense_multiply(n, dim, n, m->stiffness, P, KP);
  for (int d = 0; d < dim; ++d)
    for (int j = 0; j < rest; ++j)
      part[(size_t)d * (size_t)rest + (size_t)j] =
          -dot_product(n, Y + (size_t)j * (size_t)n, KP + (size_t)d * (size_t)n) / lambda[j];
  dense_multiply(n, dim, rest, Y, part, work);
  for (size_t i = 0; i < (size_t)n * (size_t)dim; ++i) P[i] += work[i];
}

/* The rest's modes as coordinates y, for symmetric K and M. */
static hc_status choose_modes(const model *m, condensation_basis *b)
{
  const int n = m->n, rest = b->rest;
  const double *Y = b->T + (size_t)b->dim * (size_t)n;
  workspace own = {0};
  double *work = workspace_doubles(&own, 2 * square(n)), *lambda = workspace_doubles(&own, (size_t)rest),
         *phi = workspace_doubles(&own, square(rest)), *Myy = workspace_doubles(&own, square(rest)),
         *Kyy = workspace_doubles(&own, square(rest));
  hc_status st = own.failed ? HC_NO_MEMORY : HC_OK;
  if (st == HC_OK) {
    dense_congruence(n, rest, Y, m->mass, work, Myy);
    dense_congruence(n, rest, Y, m->stiffness, work, Kyy);
    st = dense_modes(rest, Kyy, Myy, lambda, phi);
  }
  for (int i = 0; i < rest && st == HC_OK; ++i)
    if (!(lambda[i] > free_mode * fabs(lambda[rest - 1]))) st = HC_SINGULAR;
  if (st == HC_OK) turn_to_modes(m, b, lambda, phi, work);
  workspace_free(&own);
  return st;
}

/* ---- everything in the new coordinates ---------------------------------------------------------- */

static void transform(const condensation_basis *b, int columns, const double *x, double *out)
{
  for (int d = 0; d < columns; ++d) out[d] = dot_product(b->n, b->T + (size_t)d * (size_t)b->n, x);
}

static void transform_vectors(const model *m, condensation_basis *b)
{
  const size_t n = (size_t)m->n, dim = (size_t)b->dim;
  for (int j = 0; j < m->n_contacts; ++j) {
    transform(b, b->dim, m->contacts[j].tangent, b->directions + (size_t)(2 * j) * dim);
    transform(b, b->dim, m->contacts[j].normal, b->directions + (size_t)(2 * j + 1) * dim);
  }
  for (int l = 0; l < m->n_loads; ++l) {
    transform(b, m->n, m->loads[l].cosine, b->loads + (size_t)(2 * l) * n);
    transform(b, m->n, m->loads[l].sine, b->loads + (size_t)(2 * l + 1) * n);
  }
  for (int r = 0; r < m->n_responses; ++r)
    transform(b, m->n, m->responses + (size_t)r * n, b->responses + (size_t)r * n);
  for (int j = 0; j < 2 * m->n_contacts; ++j) { /* entries that are only rounding would couple independent
                                                   coordinates */
    double *d = b->directions + (size_t)j * dim;
    const double largest = norm_max(b->dim, d);
    for (int i = 0; i < b->dim; ++i)
      if (fabs(d[i]) <= negligible * largest) d[i] = 0;
  }
}

/* b->rounding[d] = eps sum_e |P_e|^T |K| |P_d|: rounding error of the force of a motion that K does not resist. work[2
 * n] of zeros. */
static void find_rounding(const model *m, condensation_basis *b, double *work)
{
  const size_t n = (size_t)m->n, dim = (size_t)b->dim;
  double *sum = work, *force = work + n;
  for (size_t e = 0; e < dim * n; ++e) sum[e % n] += fabs(b->T[e]);
  for (size_t j = 0; j < n; ++j)
    for (size_t i = 0; i < n; ++i) force[j] += sum[i] * fabs(m->stiffness[j * n + i]);
  for (size_t d = 0; d < dim; ++d)
    for (size_t i = 0; i < n; ++i) b->rounding[d] += DBL_EPSILON * force[i] * fabs(b->T[d * n + i]);
}

hc_status condensation_basis_make(const model *m, condensation_basis *b)
{
  *b = (condensation_basis){.n = m->n};
  hc_status st = allocate(m, b);
  if (st == HC_OK) {
    const int n = m->n, most = 2 * m->n_contacts + 1;
    workspace own = {0};
    const double **row = workspace_array(&own, (size_t)most, sizeof *row);
    int *pivot = workspace_array(&own, (size_t)most, sizeof *pivot);
    double *triangle = workspace_doubles(&own, square(most < n ? most : n));
    st = own.failed ? HC_NO_MEMORY : HC_OK;
    b->dim = 0;
    if (st == HC_OK) st = dense_span(n, collect_rows(m, row), row, dependent, &b->dim, pivot, b->T, triangle);
    b->rest = n - b->dim;
    if (st == HC_OK) keep_rows(m, row, pivot, triangle, b);
    if (st == HC_OK && b->rest > 0) make_unit_motions(n, b->dim, triangle, b->T);
    if (st == HC_OK && b->rest == 0) {
      memset(b->T, 0, square(n) * sizeof *b->T);
      for (int i = 0; i < n; ++i) b->T[(size_t)i * (size_t)(n + 1)] = 1;
    }
    workspace_free(&own);
  }
  if (st != HC_OK) return st;
  const bool modes = b->rest > 0 && dense_is_symmetric(m->n, m->stiffness);
  if (modes) st = choose_modes(m, b);
  double *work = calloc(2 * square(m->n), sizeof *work);
  if (st == HC_OK && !work) st = HC_NO_MEMORY;
  if (st == HC_OK) {
    find_rounding(m, b, work);
    dense_congruence(m->n, m->n, b->T, m->mass, work, b->M);
    dense_congruence(m->n, m->n, b->T, m->damping, work, b->C);
    dense_congruence(m->n, m->n, b->T, m->stiffness, work, b->K);
    transform_vectors(m, b);
    /* By the choice of Y the rest's blocks of M and K are diagonal, and K does not couple it with q: entries there are
     * rounding, and set to 0. */
    if (modes) {
      const int n = b->n, dim = b->dim;
      for (int j = 0; j < n; ++j)
        for (int i = dim; i < n; ++i) {
          if (i == j) continue;
          if (j >= dim) b->M[(size_t)i + (size_t)j * (size_t)n] = 0;
          b->K[(size_t)i + (size_t)j * (size_t)n] = b->K[(size_t)j + (size_t)i * (size_t)n] = 0;
        }
    }
    b->modes = modes;
    b->diagonal = modes && dense_is_diagonal(b->rest, b->C + (size_t)b->dim * (size_t)(m->n + 1), m->n);
  }
  free(work);
  return st;
}
