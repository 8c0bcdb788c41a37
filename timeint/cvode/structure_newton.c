/* structure_newton.c - see structure_newton.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/cvode/structure_newton.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/dense.h"
#include "numerics/norm.h"

hc_status structure_newton_make(structure_newton *s, const modal_base *base)
{
  const size_t n = (size_t)base->n, contacts = (size_t)base->n_contacts;
  const bool diagonal = base->diagonal_K && base->diagonal_C;
  *s = (structure_newton){.base = base, .n = base->n, .n_contacts = base->n_contacts};
  if (contact_rows_make(&s->rows, base) != HC_OK) return HC_NO_MEMORY;
  s->n_rows = s->rows.count;
  const size_t rows = (size_t)s->n_rows;
  const struct {
    double **array;
    size_t count;
  } parts[] = {{&s->D, diagonal ? n : n * n},
               {&s->pulled, n * rows},
               {&s->compliant, rows * rows},
               {&s->small, rows * rows},
               {&s->force, rows},
               {&s->q, rows},
               {&s->p, n}};
  size_t count = 0, used = 0;
  for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k) count += parts[k].count;
  s->numbers = calloc(count, sizeof *s->numbers);
  s->law = calloc(contacts + 1, sizeof *s->law);
  s->directions = calloc(contacts + rows + n, sizeof *s->directions);
  if (!s->numbers || !s->law || !s->directions) return HC_NO_MEMORY;
  s->small_pivot = s->directions + contacts;
  s->pivot = s->small_pivot + rows;
  for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k) {
    *parts[k].array = s->numbers + used;
    used += parts[k].count;
  }
  return HC_OK;
}

void structure_newton_free(structure_newton *s)
{
  free(s->numbers);
  free(s->law);
  free(s->directions);
  contact_rows_free(&s->rows);
}

/* Of contact j in a motion q, in its directions: u, which is returned, and v. */
static double motion_of(const structure_newton *s, int j, int directions, double u[2])
{
  u[0] = contact_rows_at(s->q, s->rows.along[j]);
  u[1] = directions == 2 ? contact_rows_at(s->q, s->rows.along[j + 1]) : 0;
  return contact_rows_at(s->q, s->rows.across[j]);
}

static void add_to(double *force, int row, double f)
{
  if (row >= 0) force[row] += f;
}

bool structure_newton_rate(const structure_newton *s, const scaled_model *m, double theta, const double *y, double *dy)
{
  const int n = s->n;
  double sum = 0;
  scaled_linear_force(m, theta, y, dy + n);
  contact_rows_motion(&s->rows, y, s->q);
  memset(s->force, 0, (size_t)s->n_rows * sizeof *s->force);
  for (int j = 0, directions; j < s->n_contacts; j += directions) {
    const scaled_contact *c = &m->contact[j];
    directions = scaled_directions(m, j);
    double u[2];
    const double v = motion_of(s, j, directions, u);
    const planar_value l = c->kind->evaluate(&c->law, u, v, y + 2 * n + j);
    for (int a = 0; a < directions; ++a) {
      add_to(s->force, s->rows.along[j + a], l.t[a]);
      add_to(s->force, s->rows.across[j + a], l.change);
      dy[2 * n + j + a] = l.rate[a];
      sum += l.rate[a];
    }
  }
  contact_rows_pull(&s->rows, 1, s->force, dy + n);
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
  for (int i = 0; i < 2 * n; ++i) sum += dy[i];
  return isfinite(sum);
}

void structure_newton_states(const structure_newton *s, const scaled_model *m, const double *y, contact_state *state)
{
  contact_rows_motion(&s->rows, y, s->q);
  for (int j = 0, directions; j < s->n_contacts; j += directions) {
    const scaled_contact *c = &m->contact[j];
    directions = scaled_directions(m, j);
    double u[2];
    const double v = motion_of(s, j, directions, u);
    const planar_value at = c->kind->evaluate(&c->law, u, v, y + 2 * s->n + j);
    for (int a = 0; a < directions; ++a) state[j + a] = scaled_state_of(m, j, v, &at);
  }
}

void structure_newton_linearise(structure_newton *s, const scaled_model *m, const double *y)
{
  contact_rows_motion(&s->rows, y, s->q);
  for (int j = 0; j < s->n_contacts; ++j) {
    const int directions = m->contact[j].direction > 0 ? 0 : scaled_directions(m, j);
    const scaled_contact *c = &m->contact[j];
    double u[2];
    const double v = motion_of(s, j, directions, u);
    s->directions[j] = directions;
    if (directions > 0) s->law[j] = c->kind->derivatives(&c->law, u, v, y + 2 * s->n + j);
  }
}

/* f = by_u (u - d) + by_v v of a contact whose slider has been eliminated: w = share (d + gamma (r_u u + r_v v)). */
typedef struct eliminated {
  double by_u[2][2], by_v[2], share[2][2];
} eliminated;

/* (1 + gamma r_u)^-1 */
static void invert_rates(const structure_newton *s, int j, double share[2][2])
{
  const planar_derivatives *l = &s->law[j];
  const double a = 1 + s->gamma * l->rate_u[0][0], b = s->gamma * l->rate_u[0][1];
  const double c = s->gamma * l->rate_u[1][0], d = 1 + s->gamma * l->rate_u[1][1];
  if (s->directions[j] == 1) {
    share[0][0] = 1 / a;
    return;
  }
  const double det = a * d - b * c;
  share[0][0] = d / det, share[0][1] = -b / det;
  share[1][0] = -c / det, share[1][1] = a / det;
}

static eliminated eliminate(const structure_newton *s, int j)
{
  const planar_derivatives *l = &s->law[j];
  const int directions = s->directions[j];
  eliminated f = {.by_v = {l->t_v[0], l->t_v[1]}};
  invert_rates(s, j, f.share);
  for (int a = 0; a < directions; ++a)
    for (int b = 0; b < directions; ++b) {
      for (int k = 0; k < directions; ++k) f.by_u[a][b] += l->t_u[a][k] * f.share[k][b];
      f.by_v[a] -= f.by_u[a][b] * s->gamma * l->rate_v[b];
    }
  return f;
}

/* ---- D ------------------------------------------------------------------------------------------------- */

static bool is_diagonal(const structure_newton *s) { return s->base->diagonal_K && s->base->diagonal_C; }

static void add(int n, bool from_diagonal, double by, const double *A, bool to_diagonal, double *D)
{
  const size_t step = (size_t)n + 1;
  if (!from_diagonal)
    for (size_t i = 0; i < (size_t)n * (size_t)n; ++i) D[i] += by * A[i];
  else
    for (size_t i = 0; i < (size_t)n; ++i) D[to_diagonal ? i : i * step] += by * A[i];
}

static bool factor_D(structure_newton *s)
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

static void solve_D(const structure_newton *s, double *x)
{
  if (!is_diagonal(s)) {
    dense_solve(s->n, s->D, s->pivot, 1, x);
    return;
  }
  for (int i = 0; i < s->n; ++i) x[i] /= s->D[i];
}

/* ---- the contacts ---------------------------------------------------------------------------------------- */

/* Column `row` of I + gamma^2 G S gets what a force on row `by` that is `force` per unit of it does. */
static void add_force(structure_newton *s, int by, double force, int row)
{
  if (by < 0 || row < 0) return;
  const size_t n = (size_t)s->n_rows;
  const double *G = s->compliant + (size_t)by * n;
  double *column = s->small + (size_t)row * n;
  for (size_t i = 0; i < n; ++i) column[i] += s->gamma * s->gamma * force * G[i];
}

/* G = B D^-1 B^T. */
static void find_compliance(structure_newton *s)
{
  const size_t n = (size_t)s->n, rows = (size_t)s->n_rows;
  memcpy(s->pulled, s->rows.row, n * rows * sizeof *s->pulled);
  for (size_t r = 0; r < rows; ++r) solve_D(s, s->pulled + r * n);
  dense_multiply(s->n_rows, s->n_rows, s->n, s->rows.turned, s->pulled, s->compliant);
}

bool structure_newton_factor(structure_newton *s, const scaled_model *m, double gamma)
{
  const size_t rows = (size_t)s->n_rows;
  s->gamma = gamma;
  s->by_K = m->by_K;
  s->by_C = m->by_C;
  if (!factor_D(s)) return false;
  find_compliance(s);
  memset(s->small, 0, rows * rows * sizeof *s->small);
  for (size_t r = 0; r < rows; ++r) s->small[r * (rows + 1)] = 1;
  for (int j = 0; j < s->n_contacts; ++j) {
    const eliminated f = eliminate(s, j);
    for (int a = 0; a < s->directions[j]; ++a) {
      for (int b = 0; b < s->directions[j]; ++b) add_force(s, s->rows.along[j + a], f.by_u[a][b], s->rows.along[j + b]);
      add_force(s, s->rows.along[j + a], f.by_v[a], s->rows.across[j]);
      add_force(s, s->rows.across[j + a], s->law[j].n_v, s->rows.across[j]);
    }
  }
  return dense_factor(s->n_rows, s->small, s->small_pivot) == HC_OK;
}

/* s->force := S q + c (whole), or c alone. */
static void find_forces(structure_newton *s, bool whole, const double *d)
{
  memset(s->force, 0, (size_t)s->n_rows * sizeof *s->force);
  for (int j = 0; j < s->n_contacts; ++j) {
    const eliminated f = eliminate(s, j);
    const double v = whole ? contact_rows_at(s->q, s->rows.across[j]) : 0;
    for (int a = 0; a < s->directions[j]; ++a) {
      double t = f.by_v[a] * v;
      for (int b = 0; b < s->directions[j]; ++b)
        t += f.by_u[a][b] * ((whole ? contact_rows_at(s->q, s->rows.along[j + b]) : 0) - d[j + b]);
      add_to(s->force, s->rows.along[j + a], t);
      add_to(s->force, s->rows.across[j + a], s->law[j].n_v * v);
    }
  }
}

/* d[] of contact j := its slider, of d. */
static void find_slider(const structure_newton *s, int j, double *d)
{
  const planar_derivatives *l = &s->law[j];
  const eliminated f = eliminate(s, j);
  const int directions = s->directions[j];
  double sum[2] = {0};
  for (int a = 0; a < directions; ++a) {
    double rate = l->rate_v[a] * contact_rows_at(s->q, s->rows.across[j]);
    for (int b = 0; b < directions; ++b) rate += l->rate_u[a][b] * contact_rows_at(s->q, s->rows.along[j + b]);
    sum[a] = d[a] + s->gamma * rate;
  }
  for (int a = 0; a < directions; ++a) {
    d[a] = 0;
    for (int b = 0; b < directions; ++b) d[a] += f.share[a][b] * sum[b];
  }
}

void structure_newton_solve(structure_newton *s, double *r)
{
  const int n = s->n;
  const double gamma = s->gamma;
  double *a = r, *b = r + n, *d = r + 2 * n;
  modal_base_subtract_K(s->base, gamma * s->by_K, a, b);
  solve_D(s, b); /* p without contacts */
  for (int i = 0; i < n; ++i) s->p[i] = a[i] + gamma * b[i];
  contact_rows_motion(&s->rows, s->p, s->q);
  find_forces(s, false, d);
  dense_times_vector(s->n_rows, s->n_rows, -gamma * gamma, s->compliant, s->force, 1, s->q);
  dense_solve(s->n_rows, s->small, s->small_pivot, 1, s->q);
  find_forces(s, true, d);
  dense_times_vector(n, s->n_rows, -gamma, s->pulled, s->force, 1, b);
  for (int i = 0; i < n; ++i) a[i] += gamma * b[i];
  for (int j = 0; j < s->n_contacts; ++j) find_slider(s, j, d + j);
}

/* What contact j does where the motion is s->q and z: its forces into s->force, its sliders' rates into rate[]. */
static void multiply_contact(structure_newton *s, int j, const double *slider, double *rate)
{
  const planar_derivatives *l = &s->law[j];
  const double v = contact_rows_at(s->q, s->rows.across[j]);
  for (int a = 0; a < s->directions[j]; ++a) {
    double t = l->t_v[a] * v;
    rate[a] = l->rate_v[a] * v;
    for (int b = 0; b < s->directions[j]; ++b) {
      const double u = contact_rows_at(s->q, s->rows.along[j + b]) - slider[b];
      t += l->t_u[a][b] * u;
      rate[a] += l->rate_u[a][b] * u;
    }
    add_to(s->force, s->rows.along[j + a], t);
    add_to(s->force, s->rows.across[j + a], l->n_v * v);
  }
}

void structure_newton_multiply(structure_newton *s, const scaled_model *m, const double *z, double *out)
{
  const int n = s->n;
  double *force = out + n;
  contact_rows_motion(&s->rows, z, s->q);
  memset(s->force, 0, (size_t)s->n_rows * sizeof *s->force);
  for (int j = 0; j < s->n_contacts; ++j) multiply_contact(s, j, z + 2 * n + j, out + 2 * n + j);
  memcpy(out, z + n, (size_t)n * sizeof *out);
  memset(force, 0, (size_t)n * sizeof *force);
  modal_base_subtract_K(s->base, m->by_K, z, force);
  modal_base_subtract_C(s->base, m->by_C, z + n, force);
  contact_rows_pull(&s->rows, 1, s->force, force);
}
