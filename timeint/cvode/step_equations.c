/* step_equations.c - see step_equations.h. Proof: tests/timeint/test_large.c. */
#include "timeint/cvode/step_equations.h"

#include <string.h>

#include "numerics/dense.h"

hc_status step_equations_make(step_equations *s, const modal_base *base, workspace *w)
{
  const size_t n = (size_t)base->n;
  *s = (step_equations){.base = base, .n = base->n, .n_contacts = base->n_contacts};
  if (contact_rows_make(&s->rows, base, w) != HC_OK) return HC_NO_MEMORY;
  s->n_rows = s->rows.count;
  const size_t rows = (size_t)s->n_rows;
  s->contact = workspace_array(w, (size_t)base->n_contacts, sizeof *s->contact);
  s->D = workspace_doubles(w, base->diagonal_K && base->diagonal_C ? n : n * n);
  s->pulled = workspace_doubles(w, n * rows);
  s->compliant = workspace_doubles(w, rows * rows);
  s->small = workspace_doubles(w, rows * rows);
  s->force = workspace_doubles(w, rows);
  s->q = workspace_doubles(w, rows);
  s->p = workspace_doubles(w, n);
  s->pivot = workspace_array(w, n, sizeof *s->pivot);
  s->small_pivot = workspace_array(w, rows, sizeof *s->small_pivot);
  return w->failed ? HC_NO_MEMORY : HC_OK;
}

double step_equations_motion(const step_equations *s, int j, int directions, double u[2])
{
  u[0] = contact_rows_at(s->q, s->rows.along[j]);
  u[1] = directions == 2 ? contact_rows_at(s->q, s->rows.along[j + 1]) : 0;
  return contact_rows_at(s->q, s->rows.across[j]);
}

/* ---- D ------------------------------------------------------------------------------------------------- */

static bool is_diagonal(const step_equations *s) { return s->base->diagonal_K && s->base->diagonal_C; }

static void add(int n, bool from_diagonal, double by, const double *A, bool to_diagonal, double *D)
{
  const size_t step = (size_t)n + 1;
  if (!from_diagonal)
    for (size_t i = 0; i < (size_t)n * (size_t)n; ++i) D[i] += by * A[i];
  else
    for (size_t i = 0; i < (size_t)n; ++i) D[to_diagonal ? i : i * step] += by * A[i];
}

static bool factor_D(step_equations *s)
{
  const modal_base *b = s->base;
  const bool diagonal = is_diagonal(s);
  const size_t n = (size_t)s->n, step = diagonal ? 1 : n + 1;
  memset(s->D, 0, (diagonal ? n : n * n) * sizeof *s->D);
  for (size_t i = 0; i < n; ++i) s->D[i * step] = 1;
  add(s->n, b->diagonal_C, s->gamma * s->by_C, b->C, diagonal, s->D);
  add(s->n, b->diagonal_K, s->gamma * s->gamma * s->by_K, b->K, diagonal, s->D);
  if (!diagonal) return dense_factor(s->n, s->D, s->pivot) == HC_OK;
  for (size_t i = 0; i < n; ++i)
    if (!(fabs(s->D[i]) > 0)) return false;
  return true;
}

static void solve_D(const step_equations *s, double *x)
{
  if (!is_diagonal(s)) {
    dense_solve(s->n, s->D, s->pivot, 1, x);
    return;
  }
  for (int i = 0; i < s->n; ++i) x[i] /= s->D[i];
}

/* ---- the contacts ---------------------------------------------------------------------------------------- */

/* Adds to column `row` of I + gamma^2 G S the effect of a force on row `by`, `force` per unit of motion of `row`. */
static void add_force(step_equations *s, int by, double force, int row)
{
  if (by < 0 || row < 0) return;
  const size_t n = (size_t)s->n_rows;
  const double *G = s->compliant + (size_t)by * n;
  double *column = s->small + (size_t)row * n;
  for (size_t i = 0; i < n; ++i) column[i] += s->gamma * s->gamma * force * G[i];
}

bool step_equations_factor(step_equations *s, const scaled_model *m)
{
  const size_t rows = (size_t)s->n_rows;
  s->by_K = m->by_K;
  s->by_C = m->by_C;
  if (!factor_D(s)) return false;
  /* G = B D^-1 B^T. */
  const size_t n = (size_t)s->n, count = (size_t)s->n_rows;
  memcpy(s->pulled, s->rows.row, n * count * sizeof *s->pulled);
  for (size_t r = 0; r < count; ++r) {
    solve_D(s, s->pulled + r * n);
    contact_rows_motion(&s->rows, s->pulled + r * n, s->compliant + r * count);
  }
  memset(s->small, 0, rows * rows * sizeof *s->small);
  for (size_t r = 0; r < rows; ++r) s->small[r * (rows + 1)] = 1;
  for (int j = 0; j < s->n_contacts; ++j) {
    const step_contact *f = &s->contact[j];
    for (int a = 0; a < f->directions; ++a) {
      for (int b = 0; b < f->directions; ++b) add_force(s, s->rows.along[j + a], f->by_u[a][b], s->rows.along[j + b]);
      add_force(s, s->rows.along[j + a], f->by_v[a], s->rows.across[j]);
      add_force(s, s->rows.across[j + a], f->n_v, s->rows.across[j]);
    }
  }
  return dense_factor(s->n_rows, s->small, s->small_pivot) == HC_OK;
}

void step_equations_solve(step_equations *s, double *a, double *b)
{
  const int n = s->n;
  const double gamma = s->gamma;
  modal_base_subtract_K(s->base, gamma * s->by_K, a, b);
  solve_D(s, b); /* p without contacts */
  for (int i = 0; i < n; ++i) s->p[i] = a[i] + gamma * b[i];
  contact_rows_motion(&s->rows, s->p, s->q);
  dense_times_vector(s->n_rows, s->n_rows, -gamma * gamma, s->compliant, s->force, 1, s->q);
  dense_solve(s->n_rows, s->small, s->small_pivot, 1, s->q);
  /* s->force += S q */
  for (int j = 0; j < s->n_contacts; ++j) {
    const step_contact *f = &s->contact[j];
    double u[2];
    const double v = step_equations_motion(s, j, f->directions, u);
    for (int k = 0; k < f->directions; ++k) {
      const double t = f->by_v[k] * v + f->by_u[k][0] * u[0] + f->by_u[k][1] * u[1];
      step_equations_add(s->force, s->rows.along[j + k], t);
      step_equations_add(s->force, s->rows.across[j + k], f->n_v * v);
    }
  }
  dense_times_vector(n, s->n_rows, -gamma, s->pulled, s->force, 1, b);
  for (int i = 0; i < n; ++i) a[i] += gamma * b[i];
}
