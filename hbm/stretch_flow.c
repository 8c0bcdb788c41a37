/* stretch_flow.c - see stretch_flow.h. The state is augmented by the dheld, which are constant:
 *     d/dth (dx, dx', dheld) = A (dx, dx', dheld),      A's last rows are 0
 * GSL's matrices are by rows, and so is everything here. */
#include "hbm/stretch_flow.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/lu.h"

struct stretch_flow {
  const model *m;
  int n, n_states;
  double *by_K, *by_C;       /* [n][n] by columns: M^-1 K, M^-1 C */
  double *along, *across;    /* [n_contacts][n] M^-1 t_j, M^-1 n_j */
  gsl_matrix *A, *exponential;
  double *moved;             /* [n_states][n_states] */
};

static void solve_columns(int n, const double *lu, const int *pivot, int columns, const double *from, double *to)
{
  memcpy(to, from, (size_t)n * (size_t)columns * sizeof *to);
  for (int k = 0; k < columns; ++k) lu_solve(n, lu, pivot, to + (size_t)k * (size_t)n);
}

static hc_status divide_by_mass(const model *m, stretch_flow *f)
{
  const int n = m->n;
  double *lu = malloc((size_t)n * (size_t)n * sizeof *lu);
  int *pivot = malloc((size_t)n * sizeof *pivot);
  hc_status st = lu && pivot ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) {
    memcpy(lu, m->mass, (size_t)n * (size_t)n * sizeof *lu);
    if (!lu_factor(n, lu, pivot)) st = HC_SINGULAR;
  }
  if (st == HC_OK) {
    solve_columns(n, lu, pivot, n, m->stiffness, f->by_K);
    solve_columns(n, lu, pivot, n, m->damping, f->by_C);
  }
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    solve_columns(n, lu, pivot, 1, m->contacts[j].tangent, f->along + (size_t)j * (size_t)n);
    solve_columns(n, lu, pivot, 1, m->contacts[j].normal, f->across + (size_t)j * (size_t)n);
  }
  free(lu);
  free(pivot);
  return st;
}

hc_status stretch_flow_new(const model *m, stretch_flow **out)
{
  const size_t n = (size_t)m->n, states = 2 * n + (size_t)m->n_contacts;
  stretch_flow *f = calloc(1, sizeof *f);
  *out = NULL;
  if (!f) return HC_NO_MEMORY;
  f->m = m;
  f->n = m->n;
  f->n_states = (int)states;
  f->by_K = calloc(n * n, sizeof *f->by_K);
  f->by_C = calloc(n * n, sizeof *f->by_C);
  f->along = calloc(n * (size_t)m->n_contacts + 1, sizeof *f->along);
  f->across = calloc(n * (size_t)m->n_contacts + 1, sizeof *f->across);
  f->moved = calloc(states * states, sizeof *f->moved);
  f->A = gsl_matrix_alloc(states, states);
  f->exponential = gsl_matrix_alloc(states, states);
  const bool room = f->by_K && f->by_C && f->along && f->across && f->moved && f->A && f->exponential;
  hc_status st = room ? divide_by_mass(m, f) : HC_NO_MEMORY;
  if (st == HC_OK) *out = f;
  else stretch_flow_free(f);
  return st;
}

void stretch_flow_free(stretch_flow *f)
{
  if (!f) return;
  free(f->by_K);
  free(f->by_C);
  free(f->along);
  free(f->across);
  free(f->moved);
  if (f->A) gsl_matrix_free(f->A);
  if (f->exponential) gsl_matrix_free(f->exponential);
  free(f);
}

/* A -= k a b^T / omega^2 in the rows of dx'', the columns of dx. */
static void subtract_outer(stretch_flow *f, double k, const double *a, const double *b)
{
  for (int i = 0; i < f->n && k != 0; ++i)
    for (int e = 0; e < f->n; ++e) *gsl_matrix_ptr(f->A, (size_t)(f->n + i), (size_t)e) -= k * a[i] * b[e];
}

static void add_contact(stretch_flow *f, double per, int j, const contact_piece *p)
{
  const model_contact *c = &f->m->contacts[j];
  const double *along = f->along + (size_t)j * (size_t)f->n, *across = f->across + (size_t)j * (size_t)f->n;
  const int slip = contact_slip_sign(p->state);
  subtract_outer(f, per * c->law.kn, across, c->normal);
  if (!contact_has_friction(&c->law)) return;
  if (slip) subtract_outer(f, per * slip * c->law.mu * c->law.kn, along, c->normal);
  else subtract_outer(f, per * c->law.kt, along, c->tangent);
  for (int i = 0; i < f->n && !slip; ++i)
    gsl_matrix_set(f->A, (size_t)(f->n + i), (size_t)(2 * f->n + j), per * along[i]);
}

static void fill_matrix(stretch_flow *f, double omega, const contact_piece *const *piece, double angle)
{
  const double per = 1 / (omega * omega);
  gsl_matrix_set_zero(f->A);
  for (int i = 0; i < f->n; ++i) {
    gsl_matrix_set(f->A, (size_t)i, (size_t)(f->n + i), 1);
    for (int e = 0; e < f->n; ++e) {
      const size_t at = (size_t)e * (size_t)f->n + (size_t)i;
      gsl_matrix_set(f->A, (size_t)(f->n + i), (size_t)e, -per * f->by_K[at]);
      gsl_matrix_set(f->A, (size_t)(f->n + i), (size_t)(f->n + e), -f->by_C[at] / omega);
    }
  }
  for (int j = 0; j < f->m->n_contacts; ++j)
    if (piece[j]) add_contact(f, per, j, piece[j]);
  gsl_matrix_scale(f->A, angle);
}

hc_status stretch_flow_advance(stretch_flow *f, double omega, const contact_piece *const *piece, double angle,
                               double *phi)
{
  const size_t states = (size_t)f->n_states, moving = 2 * (size_t)f->n;
  fill_matrix(f, omega, piece, angle);
  if (gsl_linalg_exponential_ss(f->A, f->exponential, GSL_PREC_DOUBLE) != GSL_SUCCESS) return HC_NOT_FINITE;
  memset(f->moved, 0, moving * states * sizeof *f->moved);
  for (size_t i = 0; i < moving; ++i)
    for (size_t k = 0; k < states; ++k) {
      const double e = gsl_matrix_get(f->exponential, i, k);
      for (size_t q = 0; q < states && e != 0; ++q) f->moved[i * states + q] += e * phi[k * states + q];
    }
  memcpy(phi, f->moved, moving * states * sizeof *phi);
  return isfinite(phi[0]) ? HC_OK : HC_NOT_FINITE;
}
