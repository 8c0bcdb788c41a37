/* series_columns.c - see series_columns.h. A block lies mode after mode, its columns side by side, so that inner loops
 * run over columns. Proof: tests/timeint/test_structure.c. */
#include "timeint/closed_form/series_columns.h"

#include <float.h>
#include <string.h>

#include "numerics/dense.h"
#include "numerics/wide_vectors.h"

enum {
  BLOCK = 64, /* columns of a block: six arrays of them for 100 modes fit into the second cache */
  LAST = 24   /* highest power of h, as TRACK_ORDER */
};

static const double died_away = 1e-200; /* [square] least size of a column: below, squares of terms underflow */

hc_status series_columns_make(series_columns *s, const modal_base *base, workspace *w)
{
  const size_t n = (size_t)base->n, contacts = (size_t)base->n_contacts, planar = (size_t)base->n_planar,
               rows = 2 * contacts + 3 * planar;
  *s = (series_columns){.n = base->n, .n_contacts = base->n_contacts, .n_planar = base->n_planar};
  double **const blocks[] = {&s->x, &s->p, &s->x_end, &s->p_end, &s->term, &s->next, &s->second};
  for (size_t i = 0; i < sizeof blocks / sizeof *blocks; ++i) *blocks[i] = workspace_doubles(w, BLOCK * n);
  s->turned_K = workspace_doubles(w, base->diagonal_K ? 0 : n * n);
  s->turned_C = workspace_doubles(w, base->diagonal_C ? 0 : n * n);
  s->rows = workspace_doubles(w, n * rows);
  s->turned = workspace_doubles(w, n * rows);
  s->motion = workspace_doubles(w, BLOCK * rows);
  s->motion_next = workspace_doubles(w, BLOCK * rows);
  s->slider = workspace_doubles(w, BLOCK * contacts);
  s->size = workspace_doubles(w, BLOCK);
  s->left = workspace_doubles(w, BLOCK);
  s->law = workspace_array(w, contacts, sizeof *s->law);
  s->turning = workspace_array(w, planar, sizeof *s->turning);
  s->normal = workspace_array(w, planar, sizeof *s->normal);
  s->n_states = 2 * s->n + s->n_contacts;
  if (s->n_states <= SERIES_COLUMNS_SQUARED) {
    s->map = workspace_doubles(w, (size_t)s->n_states * (size_t)s->n_states);
    s->squared = workspace_doubles(w, (size_t)s->n_states * (size_t)s->n_states);
  }
  for (int i = 0; i < s->n_planar && !w->failed; ++i) planar_columns_make(&s->turning[i], BLOCK, w);
  if (w->failed) return HC_NO_MEMORY;
  if (!base->diagonal_K) dense_transpose(base->n, base->n, base->K, s->turned_K);
  if (!base->diagonal_C) dense_transpose(base->n, base->n, base->C, s->turned_C);
  return HC_OK;
}

/* True if T, if N of these linear forces depends on the motion. */
static bool has_tangent(const contact_forces_linear *f) { return f->t_u != 0 || f->t_v != 0 || f->t_w != 0; }
static bool has_normal(const contact_forces_linear *f) { return f->t_v != 0 || f->n_v != 0; }

static void add_row(series_columns *s, const double *row)
{
  memcpy(s->rows + (size_t)s->n_moving++ * (size_t)s->n, row, (size_t)s->n * sizeof *row);
}

/* True if j is the first direction of a contact whose slip turns. */
static bool turns(const scaled_model *m, const contact_track *track, int j)
{
  return track[j].turns && m->contact[j].direction == 0;
}

/* Two directions have half of N each: all of it is moved to the first. */
static void join_normals(series_columns *s, int j)
{
  if (s->law[j - 1].t_v != 0 || s->law[j].t_v != 0) return;
  s->law[j - 1].n_v += s->law[j].n_v;
  s->law[j].n_v = 0;
}

void series_columns_begin(series_columns *s, const scaled_model *m, const contact_track *track)
{
  const modal_base *b = m->base;
  const size_t n = (size_t)s->n;
  s->n_moving = s->n_slipping = 0;
  for (int j = 0; j < s->n_contacts; ++j) {
    s->law[j] = contact_track_forces(&track[j], &m->contact[j]);
    if (m->contact[j].direction > 0) join_normals(s, j);
  }
  for (int j = 0; j < s->n_contacts; ++j) {
    const bool normal = has_normal(&s->law[j]);
    if (has_tangent(&s->law[j])) add_row(s, b->tangent + (size_t)j * n);
    if (turns(m, track, j)) s->normal[s->n_slipping++] = normal ? s->n_moving : -1;
    if (normal) add_row(s, b->normal + (size_t)j * n);
  }
  s->n_rows = s->n_moving;
  for (int j = 0; j < s->n_contacts; ++j)
    for (int a = 0; turns(m, track, j) && a < 2; ++a) add_row(s, b->tangent + (size_t)(j + a) * n);
  s->n_pulled = s->n_moving;
  for (int j = 0, i = 0; j < s->n_contacts; ++j) {
    if (!turns(m, track, j)) continue;
    if (s->normal[i] < 0) s->normal[i] = s->n_moving, add_row(s, b->normal + (size_t)j * n);
    ++i;
  }
  dense_transpose(s->n, s->n_moving, s->rows, s->turned);
  s->reach = 2 / sqrt(m->by_K * b->highest * b->highest);
}

/* ---- one block of `width` columns ---------------------------------------------------------------------- */

/* out -= by A z, or out = -by A z; A diagonal[n], or turned[n][n]. */
WIDE_VECTORS static void subtract(const series_columns *s, int width, bool diagonal, const double *A,
                                  const double *turned, double by, const double *z, bool add, double *out)
{
  const size_t w = (size_t)width;
  if (!diagonal) {
    dense_add_product(width, s->n, s->n, -by, z, width, turned, s->n, add, out, width);
    return;
  }
  for (size_t i = 0; i < (size_t)s->n; ++i) {
    const double a = by * A[i], *restrict from = z + i * w;
    double *restrict to = out + i * w;
    if (add)
      for (size_t q = 0; q < w; ++q) to[q] -= a * from[q];
    else
      for (size_t q = 0; q < w; ++q) to[q] = -a * from[q];
  }
}

static double *row_of(double *block, int row, int width) { return block + (size_t)row * (size_t)width; }

/* motion := the rows times z, term k; those of turning slips are copied into their series. */
static void project(series_columns *s, int width, int k, const double *z, double *motion)
{
  const size_t bytes = (size_t)width * sizeof *z;
  dense_add_product(width, s->n_moving, s->n, 1, z, width, s->rows, s->n, 0, motion, width);
  for (int i = 0; i < s->n_slipping; ++i) {
    planar_columns *c = &s->turning[i];
    const size_t at = (size_t)k * (size_t)c->columns;
    for (int a = 0; a < 2; ++a) memcpy(c->u[a] + at, row_of(motion, s->n_rows + 2 * i + a, width), bytes);
    memcpy(c->v + at, row_of(motion, s->normal[i], width), bytes);
  }
}

/* In s->motion, displacements of linear contacts become `by` times their forces. Slider displacements dW are constant
 * in time: they enter the first term only. */
static void find_linear_forces(series_columns *s, int width, bool first, double by)
{
  const size_t w = (size_t)width;
  double *row = s->motion;
  for (int j = 0; j < s->n_contacts; ++j) {
    const contact_forces_linear *f = &s->law[j];
    const bool tangent = has_tangent(f), normal = has_normal(f);
    const double *dw = s->slider + (size_t)j * w, t_w = first ? by * f->t_w : 0, t_u = by * f->t_u, t_v = by * f->t_v;
    double *along = row, *across = tangent ? row + w : row;
    for (size_t q = 0; tangent && q < w; ++q) along[q] = t_u * along[q] + (normal ? t_v * across[q] : 0) + t_w * dw[q];
    for (size_t q = 0; normal && q < w; ++q) across[q] *= by * f->n_v;
    row += (size_t)(tangent + normal) * w;
  }
}

/* out = -by (K and contacts of z), term k of the motion, whose rows are in s->motion. */
static void subtract_stiffness(series_columns *s, const scaled_model *m, int width, int k, double by, const double *z,
                               double *out)
{
  const modal_base *b = m->base;
  subtract(s, width, b->diagonal_K, b->K, s->turned_K, by * m->by_K, z, false, out);
  find_linear_forces(s, width, k == 0, by);
  double *row = row_of(s->motion, s->n_rows, width);
  for (int i = 0; i < s->n_slipping; ++i) {
    planar_columns_term(&s->turning[i], width, k);
    for (int a = 0; a < 2; ++a, row += width)
      for (int q = 0; q < width; ++q) row[q] = by * s->turning[i].pull[a][q];
  }
  dense_add_product(width, s->n, s->n_pulled, -1, s->motion, width, s->turned, s->n_moving, 1, out, width);
}

/* sums[q] += |by z_q|^2 */
WIDE_VECTORS static void add_squares(const series_columns *s, int width, double by, const double *z,
                                     double *restrict sums)
{
  for (int i = 0; i < s->n; ++i) {
    const double *from = z + (size_t)i * (size_t)width;
    for (int q = 0; q < width; ++q) sums[q] += (by * from[q]) * (by * from[q]);
  }
}

/* True if power k of every column is below the tolerance of its motion and of its rate, to which it contributes k/h
 * times as much. */
static bool is_rounding(series_columns *s, int width, int k, double h, const double *z)
{
  const double rounding = s->rounding * fmin(fmax(h, DBL_EPSILON), 1) / k;
  bool small = true;
  memset(s->left, 0, (size_t)width * sizeof *s->left);
  add_squares(s, width, 1 / rounding, z, s->left);
  for (int q = 0; q < width; ++q) small = small && s->left[q] <= s->size[q];
  return small;
}

/* Advances s->x and s->p to s->x_end and s->p_end over a step h. Returns the last power of h that was used, LAST + 1 if
 * LAST does not suffice. */
WIDE_VECTORS static int expand(series_columns *s, const scaled_model *m, int width, double h)
{
  const modal_base *b = m->base;
  const size_t count = (size_t)s->n * (size_t)width;
  double *z = s->term, *next = s->next, *second = s->second;
  for (int q = 0; q < width; ++q) s->size[q] = died_away;
  add_squares(s, width, 1, s->x, s->size);
  add_squares(s, width, 1, s->p, s->size);
  memcpy(z, s->x, count * sizeof *z);
  for (size_t i = 0; i < count; ++i) next[i] = h * s->p[i];
  memcpy(s->p_end, s->p, count * sizeof *s->p);
  for (size_t i = 0; i < count; ++i) s->x_end[i] = z[i] + next[i];
  project(s, width, 0, z, s->motion);
  for (int k = 2, small = 0; k <= LAST; ++k) {
    const double by = h / (k * (k - 1));
    project(s, width, k - 1, next, s->motion_next);
    subtract_stiffness(s, m, width, k - 2, by * h, z, second);
    subtract(s, width, b->diagonal_C, b->C, s->turned_C, by * (k - 1) * m->by_C, next, true, second);
    /* Contribution of power k to the motion at h and to its rate. */
    for (size_t i = 0; i < count; ++i) {
      s->x_end[i] += second[i];
      s->p_end[i] += (k / h) * second[i];
    }
    if (k == 2)
      add_squares(s, width, 2 / h, second, s->size); /* columns that start with dW only have size 0 otherwise */
    if (!s->along || s->rounding > DBL_EPSILON) small = is_rounding(s, width, k, h, second) ? small + 1 : 0;
    if (small == 2) return k; /* two in a row: without damping even and odd powers are independent */
    double *spent = z, *forces = s->motion;
    z = next, next = second, second = spent;
    s->motion = s->motion_next, s->motion_next = forces;
  }
  return LAST + 1;
}

/* s->x and s->p over the span, in steps of equal length unless one is too long. */
static hc_status advance_block(series_columns *s, const scaled_model *m, int width, double span)
{
  const double shortest = 1e-12; /* [span] step below which the motion counts as not finite */
  for (double left = span; left > 0;) {
    const double h = s->reach < left ? left / ceil(left / s->reach) : left;
    if (expand(s, m, width, h) > LAST) {
      s->reach = 0.5 * h;
      if (!(s->reach > shortest * span)) return HC_NOT_FINITE;
      continue;
    }
    double *x = s->x, *p = s->p;
    s->x = s->x_end, s->x_end = x;
    s->p = s->p_end, s->p_end = p;
    if (h == left) return HC_OK;
    left -= h;
  }
  return HC_OK;
}

/* Copies rows of a block of columns from the matrix; back. */
static void take_rows(int rows, int width, const double *matrix, int ld, double *block)
{
  for (size_t i = 0; i < (size_t)rows; ++i)
    memcpy(block + i * (size_t)width, matrix + i * (size_t)ld, (size_t)width * sizeof *block);
}

static void put_rows(int rows, int width, const double *block, double *matrix, int ld)
{
  for (size_t i = 0; i < (size_t)rows; ++i)
    memcpy(matrix + i * (size_t)ld, block + i * (size_t)width, (size_t)width * sizeof *block);
}

static hc_status by_steps(series_columns *s, const scaled_model *m, double span, int count, int ld, double *matrix)
{
  const size_t rows = (size_t)s->n * (size_t)ld;
  for (int q = 0; q < count; q += BLOCK) {
    const int width = count - q < BLOCK ? count - q : BLOCK;
    double *from = matrix + q;
    take_rows(s->n, width, from, ld, s->x);
    take_rows(s->n, width, from + rows, ld, s->p);
    take_rows(s->n_contacts, width, from + 2 * rows, ld, s->slider);
    hc_status st = advance_block(s, m, width, span);
    if (st != HC_OK) return st;
    put_rows(s->n, width, s->x, from, ld);
    put_rows(s->n, width, s->p, from + rows, ld);
  }
  return HC_OK;
}

/* Number of doublings from a step within s->reach to the span. */
static int doublings_of(const series_columns *s, double span)
{
  return span > s->reach ? (int)ceil(log2(span / s->reach)) : 0;
}

/* True if squaring the map of one step is less work. Unit: n^2 operations on a column; a step has LAST terms, each with
 * two products by n n_rows. */
static bool squares_pay(const series_columns *s, double span, int count)
{
  const double n = s->n, states = s->n_states, step = LAST * 2 * s->n_rows / n, product = 2 * states / n;
  return s->map &&
         (states * step + (doublings_of(s, span) * states + count) * product) < span / s->reach * count * step;
}

/* Advances by the map of the span, found by repeated squaring of the map of a step; sliders are constant. */
static hc_status by_squares(series_columns *s, const scaled_model *m, double span, int count, int ld, double *matrix)
{
  const size_t states = (size_t)s->n_states, moving = 2 * (size_t)s->n;
  const int doublings = doublings_of(s, span);
  memset(s->map, 0, states * states * sizeof *s->map);
  for (size_t i = 0; i < states; ++i) s->map[i * (states + 1)] = 1;
  const hc_status st = by_steps(s, m, ldexp(span, -doublings), s->n_states, s->n_states, s->map);
  if (st != HC_OK) return st;
  for (int i = 0; i < doublings; ++i) {
    double *squared = s->squared;
    dense_multiply(s->n_states, s->n_states, s->n_states, s->map, s->map, squared); /* a square is the same by rows and
                                                                                       by columns */
    s->squared = s->map, s->map = squared;
  }
  dense_add_product(count, (int)moving, s->n_states, 1, matrix, ld, s->map, s->n_states, 0, s->squared, count);
  put_rows((int)moving, count, s->squared, matrix, ld);
  return isfinite(matrix[0]) ? HC_OK : HC_NOT_FINITE;
}

hc_status series_columns_advance(series_columns *s, const scaled_model *m, double span, int count, int ld,
                                 double *matrix)
{
  return (squares_pay(s, span, count) ? by_squares : by_steps)(s, m, span, count, ld, matrix);
}

/* dphi of turning slips: last = 0: from the sliders' rows into the first terms; else, after a step with powers up to
 * `last`, back. */
static void exchange_angles(series_columns *s, int width, int last)
{
  for (int i = 0; i < s->along->n_turning; ++i) {
    double *row = s->slider + (size_t)s->along->turning[i].contact * (size_t)width;
    if (last > 0) planar_columns_end(&s->turning[i], width, last - 2, row);
    else memcpy(s->turning[i].angle, row, (size_t)width * sizeof *row);
  }
}

bool series_columns_turn(series_columns *s, const scaled_model *m, const motion_series *along, double h, int count,
                         int ld, double *matrix)
{
  const size_t rows = (size_t)s->n * (size_t)ld;
  s->along = along;
  for (int i = 0; i < along->n_turning; ++i)
    planar_columns_begin(&s->turning[i], &along->turning[i], &m->contact[along->turning[i].contact], h);
  for (int q = 0; q < count; q += BLOCK) {
    const int width = count - q < BLOCK ? count - q : BLOCK;
    double *from = matrix + q;
    take_rows(s->n, width, from, ld, s->x);
    take_rows(s->n, width, from + rows, ld, s->p);
    take_rows(s->n_contacts, width, from + 2 * rows, ld, s->slider);
    exchange_angles(s, width, 0);
    const int last = expand(s, m, width, h);
    if (last > LAST && q == 0 && s->rounding > DBL_EPSILON)
      return false; /* other blocks have the same radius of convergence */
    exchange_angles(s, width, last < LAST ? last : LAST);
    put_rows(s->n, width, s->x_end, from, ld);
    put_rows(s->n, width, s->p_end, from + rows, ld);
    put_rows(s->n_contacts, width, s->slider, from + 2 * rows, ld);
  }
  s->along = NULL;
  return true;
}
