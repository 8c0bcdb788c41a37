/* lowest_modes.c - see lowest_modes.h. */
#include "model/reduce/lowest_modes.h"

#include <arpack/arpack.h>
#include <pthread.h>
#include <string.h>

#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

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
  if (left < 1) return HC_OK;
  const bool last = left == 1;
  if (more >= left) more = last ? 1 : left - 1; /* ARPACK's limit */
  const int vectors = 2 * more + 20 < left ? 2 * more + 20 : left, work = vectors * (vectors + 8);
  const size_t rows = (size_t)n;
  workspace memory = {0};
  double *V = workspace_doubles(&memory, rows * (size_t)vectors), *room = workspace_doubles(&memory, (size_t)work),
         *residual = workspace_doubles(&memory, rows), *M_phi = workspace_doubles(&memory, rows * (size_t)known),
         *share = workspace_doubles(&memory, (size_t)known), *basis = workspace_doubles(&memory, 3 * rows); /* workd */
  int *select = workspace_array(&memory, (size_t)vectors, sizeof *select);
  hc_status st = memory.failed ? HC_NO_MEMORY : HC_OK;
  for (int k = 0; k < known && st == HC_OK; ++k) times_mass(M, held, phi + rows * (size_t)k, M_phi + rows * (size_t)k);
  for (int i = 0; i < n && st == HC_OK; ++i) residual[i] = 1 + 0.37 * sin(7.0 * i + 1); /* of no symmetry */
  if (st == HC_OK) { /* into what has mass and is held by nothing */
    times_mass(M, held, residual, basis);
    st = factor_solve(f, 1, basis);
    memcpy(residual, basis, rows * sizeof *basis);
    for (int twice = 0; twice < 2; ++twice) remove_known(n, known, phi, M_phi, residual, share);
  }
  if (st == HC_OK && last) { /* it is what is left, and lambda = phi^T A phi = 1/(M phi)^T A^-1 (M phi) */
    double *x = phi + rows * (size_t)known;
    times_mass(M, held, residual, basis);
    const double mass = dot_product(n, residual, basis);
    for (int i = 0; i < n; ++i) x[i] = residual[i] / sqrt(mass), basis[i] /= sqrt(mass);
    memcpy(basis + rows, basis, rows * sizeof *basis);
    st = factor_solve(f, 1, basis);
    lambda[known] = 1 / dot_product(n, basis, basis + n);
    *found = 1;
  }
  static pthread_mutex_t turn = PTHREAD_MUTEX_INITIALIZER; /* ARPACK keeps where it is in variables of its own */
  pthread_mutex_lock(&turn);
  while (st == HC_OK && !last && ido != 99) {
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
  if (st == HC_OK && !last && (info < 0 || parameters[4] < more)) st = HC_NOT_CONVERGED;
  if (st == HC_OK && !last) {
    dseupd_c(1, "A", select, lambda + known, phi + rows * (size_t)known, n, 0, "G", n, "LM", more, 1e-13, residual,
             vectors, V, n, parameters, pointers, basis, room, work, &info);
    if (info != 0) st = HC_NOT_CONVERGED;
    else *found = more;
  }
  pthread_mutex_unlock(&turn);
  workspace_free(&memory);
  return st;
}

/* ---- of a structure ---- */

/* The stiffness of all contacts stuck, on the rows that they move. */
static hc_status contact_stiffness(const scene_structure *s, sparse *out)
{
  int *row = malloc((size_t)s->n * sizeof *row), touched = 0;
  if (!row) return HC_NO_MEMORY;
  for (int i = 0; i < s->n; ++i) {
    bool any = false;
    for (int j = 0; j < s->n_contacts; ++j) {
      const structure_contact *c = &s->contacts[j];
      any |= c->tangent[i] != 0 || c->tangent_2[i] != 0 || c->normal[i] != 0;
    }
    if (any) row[touched++] = i;
  }
  const size_t t = (size_t)touched;
  double *K = calloc(t * t + 3 * t + 1, sizeof *K);
  hc_status st = K ? sparse_new(s->n, touched * touched, out) : HC_NO_MEMORY;
  for (int j = 0; j < s->n_contacts && st == HC_OK; ++j) {
    const structure_contact *c = &s->contacts[j];
    const contact law = scene_contact_law(&c->given);
    const double *const from[] = {c->tangent, c->tangent_2, c->normal};
    for (int d = 0; d < 3; ++d) {
      double *along = K + t * t, k = d == 2 ? law.kn : contact_has_friction(&law) ? law.kt : 0;
      for (int i = 0; i < touched; ++i) along[i] = from[d][row[i]];
      add_outer(touched, k, along, along, K);
    }
  }
  for (int j = 0, at = 0, k = 0; j < s->n && st == HC_OK; out->start[++j] = k) {
    if (at == touched || row[at] != j) continue;
    for (int i = 0; i < touched; ++i) out->row[k] = row[i], out->value[k++] = K[(size_t)i + t * (size_t)at];
    ++at;
  }
  free(row);
  free(K);
  return st;
}

/* phi^T C phi/(2 omega) of mode k; room[n]. */
static double damping_ratio(const scene_structure *s, bool stuck, int k, double omega, const double *phi, double *room)
{
  switch (s->how) {
  case STRUCTURE_DAMPING_MODAL: return stuck ? NAN : s->modal;
  case STRUCTURE_DAMPING_MODES: return stuck ? NAN : s->ratios[k];
  case STRUCTURE_DAMPING_RAYLEIGH:
    sparse_multiply(&s->stiffness.kept, 1, phi, room);
    return (s->rayleigh[0] + s->rayleigh[1] * dot_product(s->n, phi, room)) / (2 * omega);
  case STRUCTURE_DAMPING_MATRIX:
    sparse_multiply(&s->damping.kept, 1, phi, room);
    return dot_product(s->n, phi, room) / (2 * omega);
  }
  return NAN;
}

hc_status lowest_of_structure(const scene_structure *s, bool stuck, int count, model_mode *modes, int *found)
{
  const size_t n = (size_t)s->n;
  sparse contacts = {0}, both = {0};
  factor *f = NULL;
  double shift = 0;
  workspace memory = {0};
  bool *held = workspace_array(&memory, n, sizeof *held);
  double *lambda = workspace_doubles(&memory, (size_t)count),
         *phi = workspace_doubles(&memory, n * (size_t)(count + 1));
  hc_status st = memory.failed ? HC_NO_MEMORY : HC_OK;
  *found = 0;
  if (st == HC_OK && stuck) st = contact_stiffness(s, &contacts);
  if (st == HC_OK && stuck) st = sparse_sum(&s->stiffness.kept, &contacts, &both);
  const sparse *K = stuck ? &both : &s->stiffness.kept;
  if (st == HC_OK) {
    factor_hold_empty(K, &s->mass.kept, held);
    st = factor_shifted(K, &s->mass.kept, held, 0, &shift, &f);
  }
  if (st == HC_OK) st = lowest_modes(f, &s->mass.kept, held, 0, count, lambda, phi, found);
  for (int k = 0; k < *found && st == HC_OK; ++k) {
    const double omega2 = lambda[k] - shift, omega = omega2 > 0 ? sqrt(omega2) : 0;
    const double damping = damping_ratio(s, stuck, k, omega, phi + n * (size_t)k, phi + n * (size_t)count);
    modes[k] = (model_mode){omega, omega > 0 ? damping : NAN};
  }
  factor_free(f);
  sparse_free(&contacts);
  sparse_free(&both);
  workspace_free(&memory);
  return st;
}
