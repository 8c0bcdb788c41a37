/* modal_base.c - see modal_base.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/law/modal_base.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "model/modes.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

static const double rounding = 1e-13; /* off-diagonal entries of C that count as 0, relative to the diagonal */

/* y = A x, or A^T x; A[n][n] by columns. */
static void times(int n, const double *A, const double *x, double *y)
{
  memset(y, 0, (size_t)n * sizeof *y);
  for (int col = 0; col < n; ++col)
    for (int row = 0; row < n; ++row) y[row] += A[(size_t)col * (size_t)n + (size_t)row] * x[col];
}

static void transposed_times(int n, const double *A, const double *x, double *y)
{
  for (int col = 0; col < n; ++col) y[col] = dot_product(n, A + (size_t)col * (size_t)n, x);
}

/* out := phi^T A phi; vector[n]: work. */
static void to_modes(int n, const double *phi, const double *A, double *vector, double *out)
{
  for (int col = 0; col < n; ++col) {
    times(n, A, phi + (size_t)col * (size_t)n, vector);
    transposed_times(n, phi, vector, out + (size_t)col * (size_t)n);
  }
}

/* sum_kl |phi_k| |A_kl| |phi_l| */
static double size_of_sum(int n, const double *left, const double *A, const double *right)
{
  double sum = 0;
  for (int col = 0; col < n; ++col)
    for (int row = 0; row < n; ++row) sum += fabs(left[row] * A[(size_t)col * (size_t)n + (size_t)row] * right[col]);
  return sum;
}

/* True if A[n][n] = phi^T of phi is diagonal up to rounding, relative to the diagonal or, for very different modes, to
 * the n^2 terms of each entry. Then its diagonal is moved to A[0..n-1]. */
static bool keep_diagonal(int n, const double *phi, const double *of, double *A)
{
  const size_t ld = (size_t)n;
  for (size_t col = 0; col < ld; ++col)
    for (size_t row = 0; row < ld; ++row) {
      const double a = fabs(A[col * ld + row]);
      if (row == col || a <= rounding * sqrt(fabs(A[row * (ld + 1)] * A[col * (ld + 1)]))) continue;
      if (!(a <= n * DBL_EPSILON * size_of_sum(n, phi + row * ld, of, phi + col * ld))) return false;
    }
  for (size_t i = 0; i < ld; ++i) A[i] = A[i * (ld + 1)];
  return true;
}

static void scale(size_t count, double *a, double by)
{
  for (size_t i = 0; i < count; ++i) a[i] *= by;
}

/* Everything from phi, which is in b->shape. */
static void fill(modal_base *b, const model *m, const double *omega2, double *vector)
{
  const int n = b->n;
  const size_t ld = (size_t)n, contacts = (size_t)b->n_contacts, loads = (size_t)b->n_loads;
  const double *phi = b->shape;
  b->diagonal_K = dense_is_symmetric(n, m->stiffness);
  if (b->diagonal_K) memcpy(b->K, omega2, ld * sizeof *b->K);
  else to_modes(n, phi, m->stiffness, vector, b->K);
  to_modes(n, phi, m->damping, vector, b->C);
  b->slowest = INFINITY;
  b->decay = 0;
  for (size_t i = 0; i < ld; ++i) {
    b->slowest = fmin(b->slowest, 0.5 * b->C[i * (ld + 1)]);
    b->decay = fmax(b->decay, b->C[i * (ld + 1)]);
  }
  b->slowest = fmax(b->slowest, 0);
  b->diagonal_C = keep_diagonal(n, phi, m->damping, b->C);
  for (size_t j = 0; j < contacts; ++j) {
    transposed_times(n, phi, m->contacts[j].tangent, b->tangent + j * ld);
    transposed_times(n, phi, m->contacts[j].normal, b->normal + j * ld);
  }
  for (int r = 0; r < b->n_responses; ++r)
    transposed_times(n, phi, m->responses + (size_t)r * ld, b->response + (size_t)r * ld);
  for (size_t k = 0; k < loads; ++k) {
    b->harmonic[k] = m->loads[k].harmonic, b->inertial[k] = m->loads[k].inertial;
    transposed_times(n, phi, m->loads[k].cosine, b->cosine + k * ld);
    transposed_times(n, phi, m->loads[k].sine, b->sine + k * ld);
  }
  for (int col = 0; col < n; ++col) { /* phi^-1 = phi^T M */
    transposed_times(n, m->mass, phi + (size_t)col * ld, vector);
    for (size_t row = 0; row < ld; ++row) b->inverse[row * ld + (size_t)col] = vector[row];
  }
  /* The longest row in modes with phi^T M phi = 1. */
  double longest = 0;
  const struct {
    int count;
    const double *row;
  } sets[] = {{b->n_contacts, b->tangent}, {b->n_contacts, b->normal}, {b->n_responses, b->response}};
  for (size_t k = 0; k < sizeof sets / sizeof *sets; ++k)
    for (int j = 0; j < sets[k].count; ++j) {
      const double *row = sets[k].row + (size_t)j * (size_t)b->n;
      longest = fmax(longest, sqrt(dot_product(b->n, row, row)));
    }
  b->s = longest > 0 ? longest : 1;
  scale(contacts * ld, b->tangent, 1 / b->s);
  scale(contacts * ld, b->normal, 1 / b->s);
  scale((size_t)b->n_responses * ld, b->response, 1 / b->s);
  scale(loads * ld, b->cosine, b->s);
  scale(loads * ld, b->sine, b->s);
  scale(ld * ld, b->shape, 1 / b->s);
  scale(ld * ld, b->inverse, b->s);
}

/* Sets highest and lowest from the modes with all contacts stuck; omega2[n], phi[n][n]: work. */
static hc_status look_at_stuck(modal_base *b, const model *m, double *omega2, double *phi)
{
  hc_status st = model_modes(m, true, omega2, phi);
  if (st != HC_OK) return st;
  b->highest = sqrt(fmax(omega2[b->n - 1], 0));
  b->lowest = b->highest;
  for (int i = b->n - 1; i >= 0 && omega2[i] > rounding * omega2[b->n - 1]; --i) b->lowest = sqrt(omega2[i]);
  return HC_OK;
}

/* Number of doubles in b->numbers; sets *b's arrays, unless b->numbers is NULL. */
static size_t place_arrays(modal_base *b)
{
  const size_t n = (size_t)b->n, contacts = (size_t)b->n_contacts, loads = (size_t)b->n_loads,
               responses = (size_t)b->n_responses;
  const struct {
    double **array;
    size_t count;
  } parts[] = {{&b->shape, n * n},      {&b->inverse, n * n},        {&b->K, n * n},
               {&b->C, n * n},          {&b->tangent, contacts * n}, {&b->normal, contacts * n},
               {&b->cosine, loads * n}, {&b->sine, loads * n},       {&b->response, responses * n},
               {&b->slowed, n}};
  size_t used = 0;
  for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k) {
    if (b->numbers) *parts[k].array = b->numbers + used;
    used += parts[k].count;
  }
  return used;
}

static hc_status make_memory(modal_base *b)
{
  b->numbers = calloc(place_arrays(b), sizeof *b->numbers);
  b->harmonic = calloc(2 * (size_t)b->n_loads + 1, sizeof *b->harmonic);
  b->inertial = b->harmonic + b->n_loads;
  if (!b->numbers || !b->harmonic) return HC_NO_MEMORY;
  place_arrays(b);
  for (int i = 0; i < b->n; ++i) b->slowed[i] = 1;
  return HC_OK;
}

hc_status modal_base_new(const model *m, modal_base **out)
{
  *out = NULL;
  modal_base *b = calloc(1, sizeof *b); /* zeroed, so free works half-built */
  double *room = malloc(2 * (size_t)m->n * sizeof *room);
  hc_status st = b && room ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) {
    b->n = m->n, b->n_contacts = m->n_contacts, b->n_loads = m->n_loads, b->n_responses = m->n_responses;
    b->is_smooth = model_is_smooth(m);
    for (int j = 0; j < m->n_contacts; ++j)
      b->n_planar += m->contacts[j].circle && m->contacts[j].pair == CONTACT_FIRST;
    st = make_memory(b);
  }
  if (st == HC_OK) st = look_at_stuck(b, m, room, b->shape);
  if (st == HC_OK) st = model_modes(m, false, room, b->shape);
  if (st == HC_OK) {
    fill(b, m, room, room + m->n);
    *out = b;
  } else {
    modal_base_free(b);
  }
  free(room);
  return st;
}

/* The highest natural frequency, contacts stuck, by power iteration: up to a percent too low, which only makes the
 * first trial step longer. x[n], y[n]: work. */
static double highest_stuck(const modal_base *b, const model *m, double *x, double *y)
{
  enum { ITERATIONS = 100 };
  double highest = 0;
  for (int i = 0; i < b->n; ++i) x[i] = 1 / sqrt(b->n);
  for (int it = 0; it < ITERATIONS; ++it) {
    /* out := (K + sum_j kt t_j t_j^T + kn n_j n_j^T) x, of the contacts of m; K diagonal. */
    const size_t n = (size_t)b->n;
    for (size_t i = 0; i < n; ++i) y[i] = b->K[i] * x[i];
    for (int j = 0; j < m->n_contacts; ++j) {
      const double *t = b->tangent + (size_t)j * n, *normal = b->normal + (size_t)j * n, mass = 1 / (b->s * b->s);
      const double along = m->contacts[j].law.kt / mass * dot_product(b->n, t, x);
      const double across = m->contacts[j].law.kn / mass * dot_product(b->n, normal, x);
      for (size_t i = 0; i < n; ++i) y[i] += along * t[i] + across * normal[i];
    }
    highest = norm_2(b->n, y);
    if (!(highest > 0)) return 0;
    for (int i = 0; i < b->n; ++i) x[i] = y[i] / highest;
  }
  return sqrt(highest);
}

static void scale_column(size_t rows, size_t ld, double by, double *first)
{
  for (size_t r = 0; r < rows; ++r) first[r * ld] *= by;
}

hc_status modal_base_slowed(const modal_base *b, const model *m, double fastest, modal_base **out)
{
  const size_t n = (size_t)b->n;
  *out = NULL;
  modal_base *copy = malloc(sizeof *copy);
  double *room = calloc(2 * n, sizeof *room);
  if (copy) *copy = *b;
  hc_status st = copy ? make_memory(copy) : HC_NO_MEMORY;
  if (st == HC_OK && room) {
    memcpy(copy->numbers, b->numbers, place_arrays(copy) * sizeof *b->numbers);
    memcpy(copy->harmonic, b->harmonic, 2 * (size_t)b->n_loads * sizeof *b->harmonic);
    copy->slowest = INFINITY, copy->decay = 0;
    for (size_t i = 0; i < n; ++i) {
      const double a = sqrt(fmax(b->K[i], 0)) / fastest, *C = copy->C + (b->diagonal_C ? i : i * (n + 1));
      /* Mode i is slowed by `a`. */
      if (a > 1) {
        const size_t count = (size_t)copy->n, contacts = (size_t)copy->n_contacts, loads = (size_t)copy->n_loads;
        copy->slowed[i] = a;
        copy->K[i] /= a * a;
        if (copy->diagonal_C) copy->C[i] /= a;
        else scale_column(count, count, 1 / sqrt(a), copy->C + i), scale(count, copy->C + i * count, 1 / sqrt(a));
        scale(count, copy->shape + i * count, 1 / a);
        scale_column(count, count, a, copy->inverse + i);
        scale_column(contacts, count, 1 / a, copy->tangent + i);
        scale_column(contacts, count, 1 / a, copy->normal + i);
        scale_column((size_t)copy->n_responses, count, 1 / a, copy->response + i);
        scale_column(loads, count, 1 / a, copy->cosine + i);
        scale_column(loads, count, 1 / a, copy->sine + i);
      }
      copy->slowest = fmax(0, fmin(copy->slowest, 0.5 * *C));
      copy->decay = fmax(copy->decay, *C);
    }
    copy->highest = highest_stuck(copy, m, room, room + n);
    *out = copy;
  } else {
    modal_base_free(copy);
  }
  free(room);
  return *out ? HC_OK : HC_NO_MEMORY;
}

void modal_base_free(modal_base *b)
{
  if (!b) return;
  free(b->numbers);
  free(b->harmonic);
  free(b);
}

void modal_base_to_modes(const modal_base *b, const double *x, double *q) { times(b->n, b->inverse, x, q); }
void modal_base_to_model(const modal_base *b, const double *q, double *x) { times(b->n, b->shape, q, x); }

/* out -= by A x; A diagonal [n] or [n][n] by columns. */
static void subtract(int n, bool diagonal, const double *A, double by, const double *x, double *out)
{
  for (int i = 0; i < n && diagonal; ++i) out[i] -= by * A[i] * x[i];
  if (!diagonal) dense_times_vector(n, n, -by, A, x, 1, out);
}

void modal_base_subtract_K(const modal_base *b, double by, const double *x, double *out)
{
  subtract(b->n, b->diagonal_K, b->K, by, x, out);
}

void modal_base_subtract_C(const modal_base *b, double by, const double *x, double *out)
{
  subtract(b->n, b->diagonal_C, b->C, by, x, out);
}
