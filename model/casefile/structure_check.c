/* structure_check.c - what the matrices of a structure must be; see structure.h. */
#include "model/casefile/structure.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/message.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

#define AT(A, i, j) ((A)[(size_t)(i) + (size_t)n * (size_t)(j)])

/* Cholesky, by columns: what is left of a pivot is compared with what rounding makes of 0. */
static int factor(int n, double *L)
{
  for (int k = 0; k < n; ++k) {
    double pivot = AT(L, k, k);
    for (int p = 0; p < k; ++p) pivot -= AT(L, k, p) * AT(L, k, p);
    if (!(pivot > n * DBL_EPSILON * AT(L, k, k))) return k + 1;
    AT(L, k, k) = sqrt(pivot);
    for (int p = 0; p < k; ++p) {
      const double factor = AT(L, k, p);
      for (int i = k + 1; i < n && factor != 0; ++i) AT(L, i, k) -= AT(L, i, p) * factor;
    }
    for (int i = k + 1; i < n; ++i) AT(L, i, k) /= AT(L, k, k);
  }
  return 0;
}

hc_status structure_not_definite(int n, const double *M, int *order)
{
  const size_t square = (size_t)n * (size_t)n;
  double *L = malloc(square * sizeof *L);
  *order = 0;
  if (!L) return HC_NO_MEMORY;
  memcpy(L, M, square * sizeof *L);
  *order = factor(n, L);
  free(L);
  return HC_OK;
}

/* ---- what nothing holds ---- */

/* Does it press on while nothing moves? */
static bool is_pressed(const scene_contact *c) { return c->law.gap > 0 || c->preload > 0; }

/* K with every contact stuck that can hold; at_rest: that is pressed on, too. A polynomial that restores has no
 * stiffness of its own at rest: it counts as stiff as K. */
static void stuck_stiffness(const scene_structure *s, bool at_rest, double *A)
{
  const double largest = norm_max(s->n * s->n, s->stiffness.v), curved = largest > 0 ? largest : 1;
  memcpy(A, s->stiffness.v, (size_t)s->n * (size_t)s->n * sizeof *A);
  for (int j = 0; j < s->n_contacts; ++j) {
    const structure_contact *c = &s->contacts[j];
    const moving_contact moved = scene_moving_contact(&c->given); /* by_angle: n = 1 */
    const double one = 1, *across = c->by_angle ? &one : c->normal, *tangent = c->by_angle ? moved.cu : c->tangent,
                 *normal = c->by_angle ? moved.cv : c->normal;
    const int n = c->by_angle ? 1 : s->n;
    const bool holds = c->given.law.mu > 0 && (c->given.law.kn > 0 || c->given.preload > 0);
    const double smooth = scene_contact_restores(&c->given, at_rest) ? curved : 0;
    add_outer(n, scene_contact_stiffness(&c->given, at_rest) + smooth, across, across, A);
    if (at_rest && !is_pressed(&c->given)) continue;
    add_outer(n, holds ? c->given.law.kt : 0, tangent, tangent, A);
    add_outer(n, holds ? c->given.law.kt : 0, c->tangent_2, c->tangent_2, A);
    add_outer(n, c->given.law.kn, normal, normal, A);
  }
}

/* Where x is largest; of those alike the first. */
static int moves_most(int n, const double *x)
{
  int most = 0;
  for (int i = 1; i < n; ++i)
    if (fabs(x[i]) > fabs(x[most]) * (1 + 1e-9)) most = i;
  return most;
}

static double row_sum(int n, const double *A, int i)
{
  double sum = 0;
  for (int j = 0; j < n; ++j) sum += fabs(AT(A, i, j));
  return sum;
}

/* A := D A D with rows of the order of 1: soft springs show. Returns the largest row sum, 0 for a matrix of zeros. */
static double equilibrate(int n, double *A, double *d)
{
  double most = 0;
  for (int i = 0; i < n; ++i) {
    const double sum = row_sum(n, A, i);
    d[i] = sum > 0 ? 1 / sqrt(sum) : 1;
  }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) AT(A, i, j) *= d[i] * d[j];
  for (int i = 0; i < n; ++i) most = fmax(most, row_sum(n, A, i));
  return most;
}

/* Inverse iteration on A + shift: from anywhere it tends to the motion that A resists least, and grows by 1/shift a
 * step where A does not resist at all. The growth of the last step is returned. */
static double least_held(int n, const double *lu, const int *pivot, double *x)
{
  double growth = 0;
  for (int i = 0; i < n; ++i) x[i] = 1 + 0.37 * sin(7.0 * i + 1); /* of no symmetry */
  for (int step = 0; step < 4; ++step) {
    const double before = norm_max(n, x);
    for (int i = 0; i < n; ++i) x[i] /= before;
    dense_solve(n, lu, pivot, 1, x);
    growth = norm_max(n, x);
  }
  return growth;
}

void structure_describe_motion(const scene_structure *s, double *x, message *m)
{
  const double least = 0.2; /* of the largest, which is 1 */
  char word[STRUCTURE_WORD];
  for (int told = 0; told < 4; ++told) {
    const int most = moves_most(s->n, x);
    if (!(fabs(x[most]) >= least)) return;
    message_add(m, "%s%s: %.2g", told > 0 ? ", " : "", structure_dof_name(s, most, word), x[most]);
    x[most] = 0;
  }
}

/* The motion x, largest entry 1, that symmetric A resists least; true: not at all. A is used up; d, pivot: room. */
static bool unresisted(int n, double *A, double *d, int *pivot, double *x)
{
  const double scale = equilibrate(n, A, d), rounding = n * DBL_EPSILON * scale;
  for (int i = 0; i < n; ++i) x[i] = 1, AT(A, i, i) += rounding / 8;
  const bool is_free = scale == 0 || dense_factor(n, A, pivot) != HC_OK || !(least_held(n, A, pivot, x) * rounding < 1);
  for (int i = 0; i < n; ++i) x[i] *= d[i];
  const double most = x[moves_most(n, x)];
  for (int i = 0; i < n; ++i) x[i] /= most;
  return is_free;
}

/* The same with room made; A[n + 1][n] is freed, NULL: out of memory. */
static hc_status find_unresisted(int n, double *A, double *x, bool *is_free)
{
  int *pivot = malloc((size_t)n * sizeof *pivot);
  const hc_status st = A && pivot ? HC_OK : HC_NO_MEMORY;
  *is_free = st == HC_OK && unresisted(n, A, A + (size_t)n * (size_t)n, pivot, x);
  free(A);
  free(pivot);
  return st;
}

hc_status structure_free_motion(const scene_structure *s, bool at_rest, double *x, bool *free_motion)
{
  const size_t n = (size_t)s->n;
  double *A = malloc(n * (n + 1) * sizeof *A);
  if (A) stuck_stiffness(s, at_rest, A);
  return find_unresisted(s->n, A, x, free_motion);
}

hc_status structure_massless_motion(int n, const double *M, double *x, bool *massless)
{
  const size_t rows = (size_t)n;
  double *A = malloc(rows * (rows + 1) * sizeof *A);
  if (A) memcpy(A, M, rows * rows * sizeof *A);
  return find_unresisted(n, A, x, massless);
}

hc_status structure_undamped_mode(const scene_structure *s, double *omega)
{
  const int n = s->n;
  const size_t rows = (size_t)n;
  double *phi = malloc((rows + 2) * rows * sizeof *phi);
  *omega = -1;
  if (!phi) return HC_NO_MEMORY;
  double *lambda = phi + rows * rows, *Cx = lambda + rows;
  hc_status st = dense_modes(n, s->stiffness.v, s->mass.v, lambda, phi);
  for (int k = 0; k < n && st == HC_OK && *omega < 0; ++k) {
    const double *x = phi + (size_t)k * rows, own = sqrt(fmax(lambda[k], 0));
    dense_multiply(n, 1, n, s->damping.v, x, Cx);
    const double rate = dot_product(n, x, Cx); /* 2 z omega */
    if (rate <= n * DBL_EPSILON * sqrt(fmax(lambda[n - 1], 0))) *omega = own;
  }
  free(phi);
  return st;
}

/* ---- damping ---- */

/* C = M Phi diag(2 z omega) Phi^T M = P P^T, P = M Phi diag(sqrt(2 z omega)). `room` is [3 n + 1][n]. */
static hc_status modal_damping(scene_structure *s, double *room)
{
  const int n = s->n;
  const size_t rows = (size_t)n;
  double *phi = room, *P = phi + rows * rows, *turned = P + rows * rows, *lambda = turned + rows * rows;
  const hc_status st = dense_modes(n, s->stiffness.v, s->mass.v, lambda, phi);
  if (st != HC_OK) return st;
  const double rounding = n * DBL_EPSILON * fmax(fabs(lambda[0]), fabs(lambda[n - 1]));
  if (lambda[0] < -rounding) return HC_BAD_INPUT; /* they ascend */
  dense_multiply(n, n, n, s->mass.v, phi, P);
  for (size_t k = 0; k < rows; ++k) {
    const double z = s->how == STRUCTURE_DAMPING_MODAL ? s->modal : s->ratios[k];
    const double share = sqrt(2 * z * sqrt(fmax(lambda[k], 0)));
    for (size_t i = 0; i < rows; ++i) P[k * rows + i] *= share;
  }
  dense_transpose(n, n, P, turned);
  dense_multiply(n, n, n, P, turned, s->damping.v);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < j; ++i) AT(s->damping.v, i, j) = AT(s->damping.v, j, i);
  return HC_OK;
}

hc_status structure_resolve_damping(scene_structure *s)
{
  const size_t n = (size_t)s->n, square = n * n;
  if (s->how == STRUCTURE_DAMPING_MATRIX) return HC_OK;
  if (!s->damping.v && !(s->damping.v = malloc(square * sizeof *s->damping.v))) return HC_NO_MEMORY;
  if (s->how == STRUCTURE_DAMPING_RAYLEIGH) {
    for (size_t i = 0; i < square; ++i)
      s->damping.v[i] = s->rayleigh[0] * s->mass.v[i] + s->rayleigh[1] * s->stiffness.v[i];
    return HC_OK;
  }
  double *room = malloc((3 * square + n) * sizeof *room);
  const hc_status st = room ? modal_damping(s, room) : HC_NO_MEMORY;
  free(room);
  return st;
}
