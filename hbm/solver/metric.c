/* metric.c - see metric.h. Sizes are computed where they are asked for: a solution's take less than a thousandth of the
 * factors that led to it. */
#include "hbm/solver/metric.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "model/parts.h"
#include "model/rest.h"
#include "numerics/base/workspace.h"
#include "numerics/norm.h"

enum { METRIC_MOST = 4096 };           /* contacts that are measured one by one */
static const double least_size = 1e-6; /* [largest vibration] */
static const double one_line = 1e-14;  /* [1] rounding of the square of what a row has beside a line */

struct metric {
  atomic_int owners;   /* threads that work on one curve each have solutions of it */
  int dim, n;          /* coordinates; contacts, the response one of them */
  int *first;          /* [n + 1] contact j has the rows first[j] .. first[j+1] - 1 */
  double *row;         /* [first[n]][dim] */
  int *begin, *column; /* [first[n] + 1] where the entries of a row that are not 0 begin, and which they are; */
  double *value;       /* they themselves: a contact's row is a coordinate, as a rule */
  double *own;         /* [n] [length] */
  double *rest;        /* [dim] */
  int *part;           /* [dim] which uncoupled part of the structure coordinate d is of */
  int *leader;         /* [n] the first contact of the part that contact j is of */
  double *x;           /* [n_dof] of metric_new */
  workspace memory;
};

static const double *row_of(const metric *m, int r) { return m->row + (size_t)r * (size_t)m->dim; }

/* ---- made ------------------------------------------------------------------------------------------------- */

static void add_row(metric *m, const double *row)
{
  if (is_zero(m->dim, row)) return;
  memcpy(m->row + (size_t)m->first[m->n + 1]++ * (size_t)m->dim, row, (size_t)m->dim * sizeof *row);
}

/* The rows of the last contact as one, if they are parallel: as long as all of them together. */
static void join_rows(metric *m)
{
  const int first = m->first[m->n], last = m->first[m->n + 1];
  double *to = m->row + (size_t)first * (size_t)m->dim, sum = 0;
  const double own = sqrt(dot_product(m->dim, to, to));
  for (int r = first; r < last; ++r) {
    const double along = dot_product(m->dim, to, row_of(m, r)) / own,
                 all = dot_product(m->dim, row_of(m, r), row_of(m, r));
    if (!(all - along * along <= one_line * all)) return;
    sum += all;
  }
  for (int d = 0; d < m->dim; ++d) to[d] *= sqrt(sum) / own;
  m->first[m->n + 1] = first + 1;
}

/* The contact of one row that moves along the same line as the last one does; -1: none. *ratio: of their motions. */
static int same_line(const metric *m, double *ratio)
{
  const double *row = row_of(m, m->first[m->n]), size = dot_product(m->dim, row, row);
  for (int j = 0; j < m->n && m->first[m->n + 1] == m->first[m->n] + 1; ++j) {
    const double *other = row_of(m, m->first[j]);
    if (m->first[j + 1] != m->first[j] + 1) continue;
    const double along = dot_product(m->dim, row, other), of_other = dot_product(m->dim, other, other);
    *ratio = sqrt(of_other / size);
    if (size * of_other - along * along <= one_line * size * of_other) return j;
  }
  return -1;
}

/* The part of the structure whose coordinates move contact j. */
static int part_of(const metric *m, int j)
{
  const double *row = row_of(m, m->first[j]);
  int d = 0;
  while (row[d] == 0) ++d;
  return m->part[d];
}

/* The contact whose rows were added last, or the response. */
static void end_contact(metric *m, double own)
{
  double ratio;
  if (m->first[m->n + 1] == m->first[m->n]) return; /* nothing moves it */
  if (m->n == METRIC_MOST) {                        /* measured with the last */
    m->first[m->n] = m->first[m->n + 1];
    return;
  }
  join_rows(m);
  const int twin = same_line(m, &ratio);
  if (twin >= 0) {
    m->own[twin] = fmin(m->own[twin], own * ratio);
    m->first[m->n + 1] = m->first[m->n];
    return;
  }
  m->own[m->n] = own;
  for (m->leader[m->n] = 0; m->leader[m->n] < m->n; ++m->leader[m->n])
    if (part_of(m, m->leader[m->n]) == part_of(m, m->n)) break;
  ++m->n;
  m->first[m->n + 1] = m->first[m->n];
}

/* part[n] of each degree of freedom, part_of_q[dim] of each coordinate: two that a matrix, a contact's direction or a
 * coordinate joins are of one. unit[n], q[dim]: room. */
static void find_parts(const model *of, const condensation *c, int dim, int *part, double *unit, double *q,
                       int *part_of_q)
{
  const int n = of->n;
  model_find_parts(of, part);
  for (int d = 0; d < dim; ++d) part_of_q[d] = -1;
  for (int i = 0; i < n; ++i) {
    unit[i] = 1;
    condensation_coordinates(c, unit, q);
    unit[i] = 0;
    for (int d = 0; d < dim; ++d) {
      if (q[d] == 0) continue;
      if (part_of_q[d] >= 0) model_join_parts(n, part, part[i], part[part_of_q[d]]);
      part_of_q[d] = i;
    }
  }
  for (int d = 0; d < dim; ++d) part_of_q[d] = part_of_q[d] < 0 ? -1 : part[part_of_q[d]];
}

static void add_contacts(metric *m, const model *about, const condensation *c)
{
  for (int j = 0; j < about->n_contacts;) {
    double own = 0;
    int next = j;
    do { /* a contact of the case: two tangents, or a table's springs */
      const contact *law = &about->contacts[next].law;
      const double length = contact_length(law);
      if (contact_rubs(law)) add_row(m, condensation_tangent(c, next));
      if ((law->kn > 0 || contact_never_opens(law)) && next == j) add_row(m, condensation_normal(c, next));
      if (length > 0) own = own > 0 ? fmin(own, length) : length;
    } while (++next < about->n_contacts && contact_goes_on(about->contacts[next].pair));
    end_contact(m, own);
    j = next;
  }
  if (about->n_responses > 0) add_row(m, condensation_first_response(c));
  end_contact(m, 0);
}

static void list_entries(metric *m)
{
  for (int r = 0; r < m->first[m->n]; ++r) {
    m->begin[r + 1] = m->begin[r];
    for (int d = 0; d < m->dim; ++d) {
      if (row_of(m, r)[d] == 0) continue;
      m->column[m->begin[r + 1]] = d;
      m->value[m->begin[r + 1]++] = row_of(m, r)[d];
    }
  }
}

hc_status metric_new(const model *of, const condensation *c, metric **out)
{
  const size_t dim = (size_t)condensation_dim(c), contacts = (size_t)of->n_contacts;
  metric *m = calloc(1, sizeof *m);
  model *about = NULL;
  *out = NULL;
  if (!m) return HC_NO_MEMORY;
  atomic_init(&m->owners, 1);
  m->dim = (int)dim;
  m->first = workspace_array(&m->memory, contacts + 3, sizeof *m->first);
  m->row = workspace_doubles(&m->memory, (2 * contacts + 1) * dim);
  m->begin = workspace_array(&m->memory, 2 * contacts + 2, sizeof *m->begin);
  m->column = workspace_array(&m->memory, (2 * contacts + 1) * dim, sizeof *m->column);
  m->value = workspace_doubles(&m->memory, (2 * contacts + 1) * dim);
  m->own = workspace_doubles(&m->memory, contacts + 1);
  m->rest = workspace_doubles(&m->memory, dim);
  m->part = workspace_array(&m->memory, dim, sizeof *m->part);
  m->leader = workspace_array(&m->memory, contacts + 1, sizeof *m->leader);
  workspace own = {0};
  double *x = workspace_doubles(&own, (size_t)of->n), *unit = workspace_doubles(&own, (size_t)of->n),
         *q = workspace_doubles(&own, dim);
  int *part = workspace_array(&own, (size_t)of->n, sizeof *part);
  hc_status st = m->memory.failed || own.failed ? HC_NO_MEMORY : model_about_rest(of, &about, x);
  if (st == HC_OK) {
    condensation_coordinates(c, x, m->rest);
    find_parts(of, c, m->dim, part, unit, q, m->part);
    add_contacts(m, about, c);
    list_entries(m);
    *out = m;
  } else {
    metric_free(m);
  }
  model_free(about);
  workspace_free(&own);
  return st;
}

metric *metric_share(metric *m)
{
  if (m) atomic_fetch_add(&m->owners, 1);
  return m;
}

void metric_free(metric *m)
{
  if (!m || atomic_fetch_sub(&m->owners, 1) > 1) return;
  workspace_free(&m->memory);
  free(m);
}

const double *metric_rest(const metric *m) { return m->rest; }

/* ---- measured --------------------------------------------------------------------------------------------- */

/* Row r of x[dim]. */
static double along(const metric *m, int r, const double *x)
{
  double sum = 0;
  for (int e = m->begin[r]; e < m->begin[r + 1]; ++e) sum += m->value[e] * x[m->column[e]];
  return sum;
}

/* Sum over contact j's rows, and coefficients from `from` on, of products of what a and b do there. */
static double product(const metric_at *at, int j, int from, const double *a, const double *b)
{
  const metric *m = at->m;
  const int dim = m->dim;
  double sum = 0;
  if (dim == 1) {
    for (int i = from; i < at->n_coef; ++i) sum += a[i] * b[i];
    return sum * m->row[m->first[j]] * m->row[m->first[j]]; /* one line */
  }
  for (int r = m->first[j]; r < m->first[j + 1]; ++r)
    for (int i = from; i < at->n_coef; i += dim) {
      const double by_a = along(m, r, a + i);
      sum += by_a * (a == b ? by_a : along(m, r, b + i));
    }
  return sum;
}

/* [length] The sizes of all contacts at a solution. */
typedef struct sizes {
  double of[METRIC_MOST];
} sizes;

static void find_sizes(const metric_at *at, sizes *s)
{
  const metric *m = at->m;
  double most[METRIC_MOST], all = 0, own = 0; /* of each part, by its first contact; of all */
  memset(most, 0, (size_t)m->n * sizeof *most);
  for (int j = 0; j < m->n; ++j) {
    double vibration = product(at, j, m->dim, at->X, at->X);
    if (at->Y) vibration = fmax(vibration, product(at, j, m->dim, at->Y, at->Y));
    s->of[j] = sqrt(vibration);
    most[m->leader[j]] = fmax(most[m->leader[j]], s->of[j]);
    all = fmax(all, s->of[j]);
    own = fmax(own, m->own[j]);
  }
  const double least = all > 0 || own > 0 ? least_size * all : 1;
  for (int j = 0; j < m->n; ++j) {
    const double size = fmax(fmax(sqrt(s->of[j] * most[m->leader[j]]), m->own[j]), least);
    s->of[j] = size > 0 ? size : INFINITY; /* it has none, others have: nothing is known of it */
  }
}

double metric_length(const metric_at *at, const double *a)
{
  sizes s;
  double most = 0;
  find_sizes(at, &s);
  for (int j = 0; j < at->m->n; ++j) most = larger(most, sqrt(product(at, j, 0, a, a)) / s.of[j]);
  return most;
}

double metric_tail(const metric_at *at, int from)
{
  sizes s;
  double most = 0;
  find_sizes(at, &s);
  for (int j = 0; j < at->m->n; ++j) most = larger(most, sqrt(product(at, j, from, at->X, at->X)) / s.of[j]);
  return most;
}

double metric_distance(const metric_at *at, const double *a, const double *b)
{
  const metric *m = at->m;
  sizes s;
  double most = 0;
  find_sizes(at, &s);
  for (int j = 0; j < m->n; ++j) {
    double sum = 0;
    for (int r = m->first[j]; r < m->first[j + 1]; ++r)
      for (int i = 0; i < at->n_coef; i += m->dim) {
        const double apart = along(m, r, a + i) - along(m, r, b + i);
        sum += apart * apart;
      }
    most = larger(most, sqrt(sum) / s.of[j]);
  }
  return most;
}

double metric_inner(const metric_at *at, const double *a, const double *b)
{
  sizes s;
  double sum = 0;
  find_sizes(at, &s);
  for (int j = 0; j < at->m->n; ++j) sum += product(at, j, 0, a, b) / (s.of[j] * s.of[j]);
  return sum;
}

void metric_apply(const metric_at *at, const double *a, double *out)
{
  const metric *m = at->m;
  sizes s;
  find_sizes(at, &s);
  memset(out, 0, (size_t)at->n_coef * sizeof *out);
  for (int j = 0; j < m->n; ++j) {
    const double size = s.of[j];
    for (int r = m->first[j]; r < m->first[j + 1]; ++r)
      for (int i = 0; i < at->n_coef; i += m->dim) {
        const double by_a = along(m, r, a + i) / (size * size);
        for (int e = m->begin[r]; e < m->begin[r + 1]; ++e) out[i + m->column[e]] += by_a * m->value[e];
      }
  }
}

/* [length] How far contact j is from rest, its mean included, and no less than its own length. */
static double excursion(const metric_at *at, int j)
{
  const metric *m = at->m;
  double sum = product(at, j, m->dim, at->X, at->X);
  for (int r = m->first[j]; r < m->first[j + 1]; ++r) {
    const double mean = along(m, r, at->X) - along(m, r, m->rest);
    sum += mean * mean;
  }
  return fmax(sqrt(sum), m->own[j]);
}

/* Is coordinate d of the part of the structure that contact j is in? */
static bool is_coupled(const metric *m, int j, int d)
{
  for (int r = m->first[j]; r < m->first[j + 1]; ++r)
    for (int e = 0; e < m->dim; ++e)
      if (row_of(m, r)[e] != 0 && m->part[e] == m->part[d]) return true;
  return false;
}

void metric_reach(const metric_at *at, double *weight)
{
  const metric *m = at->m;
  double least = INFINITY;
  for (int d = 0; d < m->dim; ++d) {
    double size = 0, row = 0;
    for (int j = 0; j < m->n; ++j) {
      if (!is_coupled(m, j, d)) continue;
      size = fmax(size, excursion(at, j));
      for (int r = m->first[j]; r < m->first[j + 1]; ++r) row = fmax(row, fabs(row_of(m, r)[d]));
    }
    weight[d] = size > 0 ? row / size : 0;
    if (weight[d] > 0) least = fmin(least, weight[d]);
  }
  /* What moves no contact may go anywhere; without any size nothing is known. */
  for (int d = 0; d < m->dim; ++d)
    if (!(weight[d] > 0)) weight[d] = isfinite(least) ? least : 1;
}
