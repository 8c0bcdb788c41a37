/* mode_sum.c - see mode_sum.h. Sums over modes are products of matrices, real and imaginary parts being two numbers of
 * one factor. Modes are sorted by how far from s = 0 their poles are. */
#include "hbm/structure/mode_sum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/workspace.h"
#include "numerics/dense.h"

/* A mode is far where its poles are more than FAR times as far from 0 as s: what the series leaves out after TERMS
 * terms is (1/FAR)^TERMS = 1e-17 of it. */
enum { FAR = 4, TERMS = 28 };
/* The series of so many entries are summed side by side, their coefficients next to each other. */
enum { LANES = 8 };

struct mode_sum {
  int n, dim, rows;
  bool poles;
  double *k, *c;             /* [n] of modes */
  double complex *lambda;    /* [n] of poles */
  double *distance;          /* [n] of the nearer pole from 0, ascending */
  double *lr, *li, *rr, *ri; /* [rows][n] left and right, real and imaginary parts; of modes lr alone */
  double *weight;            /* [4][n] of one value */
  double *product, *turned;  /* [n][2 dim] what multiplies the right parts' real part, and their imaginary part */
  double *term;              /* [rows][dim] of the series */
  double complex *power;     /* [n] */
  int near;                  /* modes that are summed one by one; the others by the series */
  double reach;              /* of the series, which is in s/reach; 0: none yet */
  double *series;            /* [rows dim/LANES][TERMS][LANES] */
  workspace memory;          /* of all of these */
};

/* ---- made and freed ------------------------------------------------------------------------------ */

static double distance_of_mode(double k, double c)
{
  const double root = c * c / 4 - k;
  return root > 0 ? fabs(k) / (fabs(c) / 2 + sqrt(root)) : sqrt(fabs(k));
}

typedef struct ranked {
  double distance;
  int mode;
} ranked;

static int by_distance(const void *a, const void *b)
{
  const double x = ((const ranked *)a)->distance, y = ((const ranked *)b)->distance;
  return (x > y) - (x < y);
}

static hc_status new_sum(int n, int dim, int rows, bool poles, mode_sum **out)
{
  mode_sum *m = *out = calloc(1, sizeof *m);
  if (!m) return HC_NO_MEMORY;
  *m = (mode_sum){.n = n, .dim = dim, .rows = rows, .poles = poles};
  const size_t modes = (size_t)n + 1, entries = (size_t)rows * (size_t)n + 1;
  double **const lists[] = {&m->k, &m->c, &m->distance}, **const tables[] = {&m->lr, &m->li, &m->rr, &m->ri};
  for (size_t i = 0; i < sizeof lists / sizeof *lists; ++i) *lists[i] = workspace_doubles(&m->memory, modes);
  for (size_t i = 0; i < (poles ? sizeof tables / sizeof *tables : 1); ++i)
    *tables[i] = workspace_doubles(&m->memory, entries);
  m->lambda = workspace_array(&m->memory, modes, sizeof *m->lambda);
  m->power = workspace_array(&m->memory, modes, sizeof *m->power);
  m->weight = workspace_array(&m->memory, 4 * modes, sizeof *m->weight);
  m->product = workspace_array(&m->memory, 2 * (size_t)dim * modes, sizeof *m->product);
  m->turned = workspace_array(&m->memory, poles ? 2 * (size_t)dim * modes : 1, sizeof *m->turned);
  m->term = workspace_array(&m->memory, (size_t)rows * (size_t)dim + 1, sizeof *m->term);
  m->series = workspace_array(&m->memory, ((size_t)rows * (size_t)dim + LANES) * TERMS, sizeof *m->series);
  return m->memory.failed ? HC_NO_MEMORY : HC_OK;
}

void mode_sum_free(mode_sum *m)
{
  if (!m) return;
  workspace_free(&m->memory);
  free(m);
}

static hc_status finish(hc_status st, ranked *order, mode_sum **out)
{
  free(order);
  if (st == HC_OK) return HC_OK;
  mode_sum_free(*out);
  *out = NULL;
  return st;
}

hc_status mode_sum_of_modes(int n, const double *k, const double *c, int dim, int rows, const double *x, mode_sum **out)
{
  ranked *order = malloc(((size_t)n + 1) * sizeof *order);
  hc_status st = new_sum(n, dim, rows, false, out);
  if (!order) st = HC_NO_MEMORY;
  for (int i = 0; i < n && st == HC_OK; ++i) order[i] = (ranked){distance_of_mode(k[i], c[i]), i};
  if (st == HC_OK) qsort(order, (size_t)n, sizeof *order, by_distance);
  for (int i = 0; i < n && st == HC_OK; ++i) {
    mode_sum *m = *out;
    const int from = order[i].mode;
    m->distance[i] = order[i].distance;
    m->k[i] = k[from], m->c[i] = c[from];
    for (int a = 0; a < rows; ++a) m->lr[a * n + i] = x[(size_t)a * (size_t)n + (size_t)from];
  }
  return finish(st, order, out);
}

hc_status mode_sum_of_poles(int n, const double complex *lambda, int dim, int rows, const double complex *left,
                            const double complex *right, mode_sum **out)
{
  ranked *order = malloc(((size_t)n + 1) * sizeof *order);
  hc_status st = new_sum(n, dim, rows, true, out);
  if (!order) st = HC_NO_MEMORY;
  for (int i = 0; i < n && st == HC_OK; ++i) order[i] = (ranked){cabs(lambda[i]), i};
  if (st == HC_OK) qsort(order, (size_t)n, sizeof *order, by_distance);
  for (int i = 0; i < n && st == HC_OK; ++i) {
    mode_sum *m = *out;
    const int from = order[i].mode;
    m->distance[i] = order[i].distance;
    m->lambda[i] = lambda[from];
    for (int a = 0; a < rows; ++a) {
      const double complex l = left[(size_t)a * (size_t)n + (size_t)from],
                           r = right[(size_t)a * (size_t)n + (size_t)from];
      m->lr[a * n + i] = creal(l), m->li[a * n + i] = cimag(l);
      m->rr[a * n + i] = creal(r), m->ri[a * n + i] = cimag(r);
    }
  }
  return finish(st, order, out);
}

bool mode_sum_takes_damping(const mode_sum *m) { return !m->poles; }

/* ---- the series ---------------------------------------------------------------------------------- */

/* The place of an entry's coefficient t. */
static double *coefficient(const mode_sum *m, size_t entry, int t)
{
  return m->series + (entry / LANES * TERMS + (size_t)t) * LANES + entry % LANES;
}

/* Coefficient t of every far mode's series in s/reach, from those before it. Of a mode, 1/(k + c s + s^2): g_t =
 * -(c reach g_(t-1) + reach^2 g_(t-2))/k. Of a pole, 1/(s - lambda): -(reach/lambda)^t/lambda, and its conjugate's. */
static void next_coefficients(mode_sum *m, int t, double *now, double *before)
{
  for (int i = m->near; i < m->n; ++i) {
    if (m->poles) {
      m->power[i] = t == 0 ? -1 / m->lambda[i] : m->power[i] * (m->reach / m->lambda[i]);
      continue;
    }
    const double g = t == 0 ? 1 / m->k[i] : -(m->c[i] * m->reach * now[i] + m->reach * m->reach * before[i]) / m->k[i];
    before[i] = t == 0 ? 0 : now[i];
    now[i] = g;
  }
}

static void add_term(mode_sum *m, int t, const double *now)
{
  const int dim = m->dim;
  for (int i = m->near; i < m->n; ++i) {
    const double complex power = m->poles ? m->power[i] * (cimag(m->lambda[i]) > 0 ? 2 : 1) : now[i];
    for (int a = 0; a < dim; ++a) {
      const double complex z = (m->lr[a * m->n + i] + (m->poles ? I * m->li[a * m->n + i] : 0)) * power;
      m->product[i * dim + a] = creal(z);
      if (m->poles) m->turned[i * dim + a] = -cimag(z);
    }
  }
  const int behind = m->n - m->near, first = m->near;
  const double *right = (m->poles ? m->rr : m->lr) + first;
  dense_add_product(dim, m->rows, behind, 1, m->product + first * dim, dim, right, m->n, 0, m->term, dim);
  if (m->poles)
    dense_add_product(dim, m->rows, behind, 1, m->turned + first * dim, dim, m->ri + first, m->n, 1, m->term, dim);
  for (size_t e = 0; e < (size_t)m->rows * (size_t)dim; ++e) *coefficient(m, e, t) = m->term[e];
}

static void make_series(mode_sum *m, double reach)
{
  double *now = m->weight, *before = now + m->n;
  m->reach = reach;
  m->near = 0;
  while (m->near < m->n && !(m->distance[m->near] > FAR * reach)) ++m->near;
  for (int t = 0; t < TERMS; ++t) {
    next_coefficients(m, t, now, before);
    add_term(m, t, now);
  }
}

typedef struct lane_sums {
  double even[LANES], odd[LANES];
} lane_sums;

/* even = sum over even t of T_t x^t, odd = sum over odd t of T_t x^(t-1), v = x^2. */
static inline void sum_terms(const double *restrict T, double v, lane_sums *restrict s)
{
  *s = (lane_sums){.even = {0}};
  for (int t = TERMS - 2; t >= 0; t -= 2) {
    const double *restrict at = T + (size_t)t * LANES;
    for (int k = 0; k < LANES; ++k) s->even[k] = s->even[k] * v + at[k];
    for (int k = 0; k < LANES; ++k) s->odd[k] = s->odd[k] * v + at[LANES + k];
  }
}

/* The same of the derivative: even = sum over even t of t T_t x^(t-2), odd = sum over odd t of t T_t x^(t-1). */
static inline void sum_derivatives(const double *restrict T, double v, lane_sums *restrict s)
{
  *s = (lane_sums){.even = {0}};
  for (int t = TERMS - 2; t >= 0; t -= 2) {
    const double *restrict at = T + (size_t)t * LANES;
    for (int k = 0; k < LANES && t > 0; ++k) s->even[k] = s->even[k] * v + t * at[k];
    for (int k = 0; k < LANES; ++k) s->odd[k] = s->odd[k] * v + (t + 1) * at[LANES + k];
  }
}

/* += the series and, if by_s is not NULL, its derivative, at s = i w. Of v = (s/reach)^2 < 0: even powers are real. */
static void add_series(const mode_sum *m, double w, int from, int to, double complex *G, double complex *by_s)
{
  const double x = w / m->reach, v = -x * x;
  const int first = from * m->dim, end = to * m->dim;
  for (int block = first - first % LANES; block < end; block += LANES) {
    const double *T = m->series + (size_t)block * TERMS;
    const int low = block < first ? first - block : 0, high = block + LANES > end ? end - block : LANES;
    lane_sums s;
    if (G) sum_terms(T, v, &s);
    for (int k = low; G && k < high; ++k) G[block + k - first] += s.even[k] + I * x * s.odd[k];
    if (by_s) sum_derivatives(T, v, &s);
    for (int k = low; by_s && k < high; ++k) by_s[block + k - first] += (s.odd[k] + I * x * s.even[k]) / m->reach;
  }
}

/* ---- a value ------------------------------------------------------------------------------------- */

/* weight: real and imaginary parts of 1/z of the first n modes, by `square` of 1/z^2 factor_i. */
typedef enum { VALUE, BY_S, BY_D } wanted;

static double complex of_mode(const mode_sum *m, int i, double w, double d, wanted what)
{
  const double re = m->k[i] - w * w, im = (m->c[i] + d) * w, size = 1 / (re * re + im * im);
  const double complex inverse = re * size - I * (im * size);
  if (what == VALUE) return inverse;
  const double a = creal(inverse), b = cimag(inverse);
  const double complex square = (a * a - b * b) + I * (2 * a * b);
  return what == BY_S ? -square * ((m->c[i] + d) + I * (2 * w)) : -square * (I * w);
}

/* Into weight[4][n]: what real and imaginary parts of products are multiplied by. */
static bool fill_weights(mode_sum *m, int n, double w, double d, wanted what)
{
  double *ar = m->weight, *ai = ar + m->n, *br = ai + m->n, *bi = br + m->n, sum = 0;
  for (int i = 0; i < n; ++i) {
    double complex z, conjugate = 0;
    if (!m->poles) z = of_mode(m, i, w, d, what);
    else {
      const bool pair = cimag(m->lambda[i]) > 0;
      z = 1 / (I * w - m->lambda[i]);
      if (pair) conjugate = 1 / (I * w - conj(m->lambda[i]));
      if (what == BY_S) z = -z * z, conjugate = -conjugate * conjugate;
    }
    ar[i] = creal(z + conjugate), ai[i] = cimag(z + conjugate);
    br[i] = -cimag(z - conjugate), bi[i] = creal(z - conjugate); /* i (z - conjugate) */
    sum += ar[i] + ai[i];
  }
  return isfinite(sum);
}

/* += the sum over the first n modes. With l r = p + i q: p (z + z') + q i (z - z'). */
static void add_modes(mode_sum *m, int n, int from, int to, double complex *G)
{
  const double *ar = m->weight, *ai = ar + m->n, *br = ai + m->n, *bi = br + m->n;
  const int width = 2 * m->dim;
  for (int a = 0; a < m->dim; ++a) {
    const double *lr = m->lr + a * m->n, *li = m->poles ? m->li + a * m->n : NULL;
    double *to_real = m->product + 2 * a, *to_imaginary = m->turned + 2 * a;
    for (int i = 0; i < n && !li; ++i) to_real[i * width] = lr[i] * ar[i], to_real[i * width + 1] = lr[i] * ai[i];
    for (int i = 0; i < n && li; ++i) {
      to_real[i * width] = lr[i] * ar[i] + li[i] * br[i], to_real[i * width + 1] = lr[i] * ai[i] + li[i] * bi[i];
      to_imaginary[i * width] = lr[i] * br[i] - li[i] * ar[i];
      to_imaginary[i * width + 1] = lr[i] * bi[i] - li[i] * ai[i];
    }
  }
  const double *right = (m->poles ? m->rr : m->lr) + from * m->n;
  double *sum = (double *)G; /* complex numbers are pairs of these (C11, 6.2.5) */
  dense_add_product(width, to - from, n, 1, m->product, width, right, m->n, 1, sum, width);
  if (m->poles) dense_add_product(width, to - from, n, 1, m->turned, width, m->ri + from * m->n, m->n, 1, sum, width);
}

static hc_status add_up(mode_sum *m, int n, double w, double d, wanted what, int from, int to, double complex *G)
{
  memset(G, 0, (size_t)(to - from) * (size_t)m->dim * sizeof *G);
  if (!fill_weights(m, n, w, d, what)) return HC_NOT_FINITE;
  add_modes(m, n, from, to, G);
  return HC_OK;
}

hc_status mode_sum_at(mode_sum *m, double w, double reach, double d, int from, int to, double complex *G,
                      double complex *by_s, double complex *by_d)
{
  const bool in_reach = w <= m->reach && reach > m->reach / 4;
  if (d == 0 && !by_d && !in_reach && reach > 0) make_series(m, 1.5 * fmax(reach, w));
  const bool by_series = d == 0 && !by_d && m->reach > 0;
  const int n = by_series ? m->near : m->n;
  hc_status st = G ? add_up(m, n, w, d, VALUE, from, to, G) : HC_OK;
  if (st == HC_OK && by_s) st = add_up(m, n, w, d, BY_S, from, to, by_s);
  if (st == HC_OK && by_d) st = add_up(m, n, w, d, BY_D, from, to, by_d);
  if (st == HC_OK && by_series) add_series(m, w, from, to, G, by_s);
  return st;
}
