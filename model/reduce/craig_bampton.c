/* craig_bampton.c - see craig_bampton.h. */
#include "model/reduce/craig_bampton.h"

#include <string.h>

#include "model/reduce/lowest_modes.h"
#include "numerics/dense.h"

static size_t square(int n) { return (size_t)n * (size_t)n; }

enum { ROWS = 256 }; /* of long vectors, transposed at a time */

/* C = A^T B; A[m][n], B[k][n]; room[m ROWS]. */
static void inner_products(int n, int m, const double *A, int k, const double *B, double *room, double *C)
{
  for (int from = 0; from < n; from += ROWS) {
    const int rows = n - from < ROWS ? n - from : ROWS;
    for (int i = 0; i < m; ++i)
      for (int r = 0; r < rows; ++r)
        room[i + (size_t)m * (size_t)r] = A[(size_t)from + (size_t)r + (size_t)n * (size_t)i];
    dense_add_product(m, k, rows, 1, room, m, B + from, n, from > 0, C, m);
  }
}

static void make_symmetric(int n, double *A)
{
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < j; ++i) {
      double *a = &A[i + (size_t)n * (size_t)j], *b = &A[j + (size_t)n * (size_t)i];
      *a = *b = 0.5 * (*a + *b);
    }
}

/* The matrices of Psi, and the sums over all modes; W and room [n_kept][n]. */
static hc_status static_part(craig_bampton *cb, const scene_structure *s, double *W, double *room)
{
  const size_t n = (size_t)cb->n, b = (size_t)cb->n_kept;
  double *T = cb->T_b;
  memset(T, 0, n * b * sizeof *T);
  for (size_t k = 0; k < b; ++k) T[k * n + (size_t)cb->kept[k]] = 1;
  sparse_multiply(&s->stiffness.kept, cb->n_kept, T, W);
  hc_status st = factor_solve(cb->inner, cb->n_kept, W);
  if (st != HC_OK) return st;
  for (size_t k = 0; k < n * b; ++k) T[k] -= W[k];
  sparse_multiply(&s->stiffness.kept, cb->n_kept, T, W); /* on rows i 0 */
  for (size_t j = 0; j < b; ++j)
    for (size_t i = 0; i < b; ++i) cb->K[i + b * j] = W[(size_t)cb->kept[i] + n * j];
  sparse_multiply(&s->mass.kept, cb->n_kept, T, W);
  inner_products(cb->n, cb->n_kept, T, cb->n_kept, W, room, cb->M);
  make_symmetric(cb->n_kept, cb->K);
  make_symmetric(cb->n_kept, cb->M);
  return HC_OK;
}

/* `first` and `second` from W = M (1, Psi), whose rows i count: W^T A^-1 W and W^T A^-1 M A^-1 W. */
static hc_status sums_over_modes(craig_bampton *cb, const scene_structure *s, double *W, double *Y, double *room)
{
  const size_t n = (size_t)cb->n, size = n * (size_t)cb->n_kept;
  for (size_t k = 0; k < size; ++k)
    if (cb->held[k % n]) W[k] = 0;
  memcpy(Y, W, size * sizeof *Y);
  const hc_status st = factor_solve(cb->inner, cb->n_kept, Y);
  if (st != HC_OK) return st;
  inner_products(cb->n, cb->n_kept, W, cb->n_kept, Y, room, cb->first);
  double *const MY = W; /* which has served */
  sparse_multiply(&s->mass.kept, cb->n_kept, Y, MY);
  inner_products(cb->n, cb->n_kept, Y, cb->n_kept, MY, room, cb->second);
  make_symmetric(cb->n_kept, cb->first);
  make_symmetric(cb->n_kept, cb->second);
  return HC_OK;
}

hc_status craig_bampton_new(const scene_structure *s, int n_kept, const int *kept, craig_bampton **out)
{
  const size_t n = (size_t)s->n, b = (size_t)n_kept;
  craig_bampton *cb = *out = calloc(1, sizeof *cb);
  if (!cb) return HC_NO_MEMORY;
  cb->n = s->n, cb->n_kept = n_kept;
  workspace *w = &cb->memory;
  cb->kept = workspace_array(w, b, sizeof *cb->kept);
  cb->held = workspace_array(w, n, sizeof *cb->held);
  double **const squares[] = {&cb->K, &cb->M, &cb->first, &cb->second};
  for (size_t i = 0; i < 4; ++i) *squares[i] = workspace_doubles(w, b * b);
  double *W = malloc(n * b * sizeof *W), *room = malloc(ROWS * b * sizeof *room);
  cb->T_b = malloc(n * b * sizeof *cb->T_b);
  hc_status st = !w->failed && W && room && cb->T_b ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) {
    memcpy(cb->kept, kept, b * sizeof *kept);
    factor_hold_empty(&s->stiffness.kept, &s->mass.kept, cb->held);
    for (size_t k = 0; k < b; ++k) cb->held[kept[k]] = true;
    st = factor_new(&s->stiffness.kept, &s->mass.kept, 0, cb->held, &cb->inner);
  }
  if (st == HC_OK) st = static_part(cb, s, W, room);
  if (st == HC_OK && s->how == STRUCTURE_DAMPING_MATRIX) {
    double *Y = malloc(n * b * sizeof *Y);
    st = Y ? sums_over_modes(cb, s, W, Y, room) : HC_NO_MEMORY;
    free(Y);
  } else if (st == HC_OK) {
    st = sums_over_modes(cb, s, W, cb->T_b, room);
    free(cb->T_b);
    cb->T_b = NULL;
  }
  free(W);
  free(room);
  if (st == HC_OK) return HC_OK;
  craig_bampton_free(cb);
  *out = NULL;
  return st;
}

void craig_bampton_free(craig_bampton *cb)
{
  if (!cb) return;
  factor_free(cb->inner);
  workspace_free(&cb->memory);
  free(cb->T_b);
  free(cb->lambda);
  free(cb->phi);
  free(cb->share);
  free(cb);
}

static bool lengthen(double **list, size_t length)
{
  double *longer = realloc(*list, (length + 1) * sizeof *longer);
  if (longer) *list = longer;
  return longer != NULL;
}

/* phi^T (M_ib + M_ii Psi): with K_ii phi = lambda M_ii phi and K_ii Psi = -K_ib the second part is
 * -phi^T K_ib/lambda. */
static void find_share(craig_bampton *cb, const scene_structure *s, int k, double *M_phi, double *K_phi)
{
  const size_t n = (size_t)cb->n, b = (size_t)cb->n_kept;
  const double *phi = cb->phi + n * (size_t)k;
  sparse_multiply(&s->mass.kept, 1, phi, M_phi);
  sparse_multiply(&s->stiffness.kept, 1, phi, K_phi);
  for (size_t i = 0; i < b; ++i) {
    const size_t row = (size_t)cb->kept[i];
    cb->share[b * (size_t)k + i] = M_phi[row] - K_phi[row] / cb->lambda[k];
  }
}

hc_status craig_bampton_more(craig_bampton *cb, const scene_structure *s, int more)
{
  int found;
  const size_t n = (size_t)cb->n, all = (size_t)cb->n_modes + (size_t)more;
  double *M_phi = malloc(2 * n * sizeof *M_phi);
  hc_status st = M_phi && lengthen(&cb->lambda, all) && lengthen(&cb->phi, n * all) &&
                         lengthen(&cb->share, (size_t)cb->n_kept * all)
                     ? HC_OK
                     : HC_NO_MEMORY;
  for (; st == HC_OK && !cb->whole && more > 0; more -= found) {
    st = lowest_modes(cb->inner, &s->mass.kept, cb->held, cb->n_modes, more, cb->lambda, cb->phi, &found);
    if (st != HC_OK) break;
    cb->whole = found == 0;
    for (int k = cb->n_modes; k < cb->n_modes + found; ++k) find_share(cb, s, k, M_phi, M_phi + n);
    cb->n_modes += found;
  }
  free(M_phi);
  return st;
}

/* ---- the reduced structure ---- */

/* C = T^T C T of a damping matrix; r rows, of which n_kept first. */
static hc_status project_damping(const craig_bampton *cb, const sparse *C, int r, double *to)
{
  const size_t n = (size_t)cb->n, all = n * (size_t)r;
  double *T = malloc((2 * all + ROWS * (size_t)r) * sizeof *T), *CT = T ? T + all : NULL;
  if (!T) return HC_NO_MEMORY;
  memcpy(T, cb->T_b, n * (size_t)cb->n_kept * sizeof *T);
  memcpy(T + n * (size_t)cb->n_kept, cb->phi, n * (size_t)(r - cb->n_kept) * sizeof *T);
  sparse_multiply(C, r, T, CT);
  inner_products(cb->n, r, T, r, CT, CT + all, to);
  free(T);
  return HC_OK;
}

static void put_matrices(const craig_bampton *cb, int modes, double *K, double *M)
{
  const size_t b = (size_t)cb->n_kept, r = b + (size_t)modes;
  memset(K, 0, r * r * sizeof *K);
  memset(M, 0, r * r * sizeof *M);
  for (size_t j = 0; j < b; ++j)
    for (size_t i = 0; i < b; ++i) K[i + r * j] = cb->K[i + b * j], M[i + r * j] = cb->M[i + b * j];
  for (size_t k = 0; k < (size_t)modes; ++k) {
    const size_t row = b + k;
    K[row * (r + 1)] = cb->lambda[k], M[row * (r + 1)] = 1;
    for (size_t i = 0; i < b; ++i) {
      const double share = cb->share[b * k + i];
      M[row + r * i] = M[i + r * row] = share;
    }
  }
}

/* The kept rows of the large structure's directions. */
static void pick(const craig_bampton *cb, const double *from, double *to)
{
  for (int k = 0; k < cb->n_kept; ++k) to[k] = from[cb->kept[k]];
}

static hc_status copy_lists(const craig_bampton *cb, const scene_structure *s, scene_structure *to)
{
  for (int i = 0; i < s->n_loads; ++i) {
    structure_load *load = structure_add_load(to);
    if (!load) return HC_NO_MEMORY;
    double *direction = load->direction;
    *load = s->loads[i];
    pick(cb, s->loads[i].direction, load->direction = direction);
  }
  for (int j = 0; j < s->n_contacts; ++j) {
    const structure_contact *from = &s->contacts[j];
    structure_contact *c = structure_add_contact(to);
    if (!c) return HC_NO_MEMORY;
    c->given = from->given, c->by_angle = from->by_angle;
    pick(cb, from->tangent, c->tangent);
    pick(cb, from->tangent_2, c->tangent_2);
    pick(cb, from->normal, c->normal);
  }
  for (int i = 0; i < s->n_responses; ++i) {
    structure_response *response = structure_add_response(to);
    if (!response) return HC_NO_MEMORY;
    pick(cb, s->responses[i].direction, response->direction);
  }
  return HC_OK;
}

hc_status craig_bampton_structure(const craig_bampton *cb, const scene_structure *s, int modes, scene_structure **out)
{
  scene_structure *to = *out = structure_new();
  if (!to) return HC_NO_MEMORY;
  const int r = to->n = cb->n_kept + modes;
  to->how = s->how, to->modal = s->modal;
  memcpy(to->rayleigh, s->rayleigh, sizeof to->rayleigh);
  to->mass.v = malloc(square(r) * sizeof(double));
  to->stiffness.v = malloc(square(r) * sizeof(double));
  to->damping.v = malloc(square(r) * sizeof(double));
  to->ratios = s->ratios ? malloc((size_t)r * sizeof(double)) : NULL;
  hc_status st = to->mass.v && to->stiffness.v && to->damping.v && (to->ratios || !s->ratios) ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) put_matrices(cb, modes, to->stiffness.v, to->mass.v);
  if (st == HC_OK && s->ratios) memcpy(to->ratios, s->ratios, (size_t)r * sizeof *to->ratios);
  if (st == HC_OK && s->how == STRUCTURE_DAMPING_MATRIX) st = project_damping(cb, &s->damping.kept, r, to->damping.v);
  if (st == HC_OK) st = copy_lists(cb, s, to);
  if (st == HC_OK) st = structure_resolve_damping(to);
  if (st == HC_OK) return HC_OK;
  structure_free(to);
  *out = NULL;
  return st;
}

bool craig_bampton_rest(const craig_bampton *cb, int modes, double omega, double *R)
{
  const size_t b = (size_t)cb->n_kept;
  const double w = omega * omega;
  const double next = modes < cb->n_modes ? cb->lambda[modes] : modes > 0 ? cb->lambda[modes - 1] : 0;
  const bool none = cb->whole && modes == cb->n_modes; /* is left out */
  memset(R, 0, b * b * sizeof *R);
  if (none) return true;
  if (!(w < next)) return false;
  const double beyond = w / (1 - w / next);
  for (size_t k = 0; k < b * b; ++k) R[k] = -w * w * (cb->first[k] + beyond * cb->second[k]);
  for (int m = 0; m < modes; ++m) {
    const double *share = cb->share + b * (size_t)m;
    const double back = w * w * (1 + beyond / cb->lambda[m]) / cb->lambda[m];
    dense_add_product(cb->n_kept, cb->n_kept, 1, back, share, cb->n_kept, share, 1, 1, R, cb->n_kept);
  }
  return true;
}
