/* lowest_modes.c - see lowest_modes.h. */
#include "reduce/lowest_modes.h"

#include <arpack/arpack.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/dense.h"

/* y = M x with the rows that are held 0. */
static void times_mass(const sparse *M, const bool *held, const double *x, double *y)
{
  sparse_multiply(M, 1, x, y);
  for (int i = 0; i < M->n; ++i)
    if (held[i]) y[i] = 0;
}

/* x := x - phi phi^T M x, of modes phi[known][n] with M_phi = M phi: what is left of x beside them. */
static void remove_known(int n, int known, const double *phi, const double *M_phi, double *x, double *share)
{
  if (known == 0) return;
  dense_add_product(1, known, n, 1, x, 1, M_phi, n, 0, share, 1);
  dense_add_product(n, 1, known, -1, phi, n, share, known, 1, x, n);
}

hc_status lowest_modes(factor *f, const sparse *M, const bool *held, int known, int more, double *lambda, double *phi,
                       int *found)
{
  const int n = M->n;
  int left = 0, info = 1, ido = 0, parameters[11] = {1, 0, 500, 1, 0, 0, 3}, pointers[11];
  for (int i = 0; i < n; ++i) left += !held[i] && sparse_at(M, i, i) > 0;
  left -= known;
  *found = 0;
  if (more > left - 1) more = left - 1; /* ARPACK's limit */
  if (more < 1) return HC_OK;
  const int vectors = 2 * more + 20 < left ? 2 * more + 20 : left, work = vectors * (vectors + 8);
  const size_t rows = (size_t)n;
  double *V = malloc(rows * (size_t)vectors * sizeof *V), *room = malloc((size_t)work * sizeof *room);
  double *residual = malloc(5 * rows * sizeof *residual), *M_phi = malloc((rows * (size_t)known + 1) * sizeof *M_phi);
  double *share = malloc(((size_t)known + 1) * sizeof *share);
  int *select = malloc((size_t)vectors * sizeof *select);
  hc_status st = V && room && residual && M_phi && share && select ? HC_OK : HC_NO_MEMORY;
  double *basis = st == HC_OK ? residual + rows : NULL; /* [3][n] workd, and one of ours */
  for (int k = 0; k < known && st == HC_OK; ++k)
    times_mass(M, held, phi + rows * (size_t)k, M_phi + rows * (size_t)k);
  for (int i = 0; i < n && st == HC_OK; ++i) residual[i] = 1 + 0.37 * sin(7.0 * i + 1); /* of no symmetry */
  if (st == HC_OK) { /* into what has mass and is held by nothing */
    times_mass(M, held, residual, basis);
    st = factor_solve(f, 1, basis);
    memcpy(residual, basis, rows * sizeof *basis);
    remove_known(n, known, phi, M_phi, residual, share);
  }
  while (st == HC_OK && ido != 99) {
    dsaupd_c(&ido, "G", n, "LM", more, 1e-13, residual, vectors, V, n, parameters, pointers, basis, room, work, &info);
    if (ido != -1 && ido != 1 && ido != 2) break;
    double *x = basis + pointers[0] - 1, *y = basis + pointers[1] - 1;
    if (ido == 2) {
      times_mass(M, held, x, y);
      continue;
    }
    if (ido == 1) memcpy(y, basis + pointers[2] - 1, rows * sizeof *y); /* M x, which is there already */
    else times_mass(M, held, x, y);
    st = factor_solve(f, 1, y);
    remove_known(n, known, phi, M_phi, y, share);
  }
  if (st == HC_OK && (info < 0 || parameters[4] < more)) st = HC_NOT_CONVERGED;
  if (st == HC_OK) {
    dseupd_c(1, "A", select, lambda + known, phi + rows * (size_t)known, n, 0, "G", n, "LM", more, 1e-13, residual,
             vectors, V, n, parameters, pointers, basis, room, work, &info);
    if (info != 0) st = HC_NOT_CONVERGED;
    else *found = more;
  }
  free(V);
  free(room);
  free(residual);
  free(M_phi);
  free(share);
  free(select);
  return st;
}
