/* compliance.c - see compliance.h. The first-order form, in modal coordinates eta of K and M and with a frequency u
 * that scales both halves of a state to one size:
 *     d/dt [eta; eta'/u] = A [eta; eta'/u] + [0; f/u],   A = [0  u; -Lambda/u  -C]
 *     eta = sum_k v_k (w_k^* f) / (u w_k^* (v_k; ...)) / (s - lambda_k)      v: upper half of an eigenvector of A,
 *                                                                            w: lower half of the left one */
#include "hbm/structure/compliance.h"

#include <stdlib.h>
#include <string.h>

#include "model/modes.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

/* ---- the sum over modes, for s = i omega ----------------------------------------------------------------
 *
 *     G_ab(s) = sum_i  x_a(i) x_b(i) / (k_i + (c_i + d) s + s^2)                           C diagonal in the modes
 *     G_ab(s) = sum_i  l_a(i) r_b(i) / (s - lambda_i) + the same conjugate where Im lambda_i > 0      any damping
 *
 * Modes whose poles are far above s are summed by a power series in s, whose real coefficients are computed once for a
 * range of s; a value then costs as much as the few modes near s, whatever n is. The second form needs d = 0. x_a(i):
 * entry of direction a in mode i of unit mass. Sums over modes are matrix products, in which real and imaginary parts
 * are two columns. Modes are sorted by the distance of their poles from s = 0. */

/* FAR: a mode is summed by the series if its poles are more than FAR times as far from 0 as s. TERMS of the series:
 * their truncation error is (1/FAR)^TERMS = 1e-17 of the sum. */
enum { FAR = 4, TERMS = 28 };
/* Number of entries whose series are summed together, with adjacent coefficients (vector instructions). */
enum { LANES = 8 };

typedef struct mode_sum {
  int n, dim, rows;
  bool poles;
  double *k, *c;             /* [n] k_i and c_i of real modes */
  double complex *lambda;    /* [n] the poles */
  double *distance;          /* [n] distance of the mode's nearer pole from 0, ascending */
  double *lr, *li, *rr, *ri; /* [rows][n] l and r, real and imaginary parts; of real modes only lr, the x */
  double *weight;            /* [4][n] work: real and imaginary parts of the modes' factors */
  double *product, *turned;  /* [n][2 dim] work: left parts times weights, to be multiplied by rr; by ri */
  double *term;              /* [rows][dim] work: one coefficient of the series, all entries */
  double complex *power;     /* [n] */
  int near;                  /* number of modes, from the first on, summed one by one; the others are in the series */
  double reach;              /* [rad/time] largest w of the series, whose variable is s/reach; 0: no series yet */
  double *series;            /* [rows dim/LANES][TERMS][LANES] */
  workspace memory;          /* of all of these */
} mode_sum;

static double distance_of_mode(double k, double c)
{
  const double root = c * c / 4 - k;
  return root > 0 ? fabs(k) / (fabs(c) / 2 + sqrt(root)) : sqrt(fabs(k));
}

/* Input of mode_sum_new: real modes or, if lambda is not NULL, poles, one of each pair. */
typedef struct mode_table {
  int n;
  const double *k, *c, *x;                     /* [n], [n], [rows][n] */
  const double complex *lambda, *left, *right; /* [n], [rows][n], [rows][n] */
} mode_table;

typedef struct ranked {
  double distance;
  int mode;
} ranked;

static int by_distance(const void *a, const void *b)
{
  const double x = ((const ranked *)a)->distance, y = ((const ranked *)b)->distance;
  return (x > y) - (x < y);
}

static void mode_sum_free(mode_sum *m)
{
  if (!m) return;
  workspace_free(&m->memory);
  free(m);
}

/* The sum G_ab for a < dim and b < rows. HC_NO_MEMORY: *out is NULL. */
static hc_status mode_sum_new(const mode_table *of, int dim, int rows, mode_sum **out)
{
  const int n = of->n;
  ranked *order = malloc(((size_t)n + 1) * sizeof *order);
  mode_sum *m = *out = calloc(1, sizeof *m);
  if (m) *m = (mode_sum){.n = n, .dim = dim, .rows = rows, .poles = of->lambda};
  if (m) {
    const size_t modes = (size_t)m->n, of_rows = (size_t)m->rows, of_dim = (size_t)m->dim, parts = m->poles ? 4 : 1;
    workspace *w = &m->memory;
    double **const lists[] = {&m->k, &m->c, &m->distance}, **const tables[] = {&m->lr, &m->li, &m->rr, &m->ri};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; ++i) *lists[i] = workspace_doubles(w, modes);
    for (size_t i = 0; i < parts; ++i) *tables[i] = workspace_doubles(w, of_rows * modes);
    m->lambda = workspace_array(w, modes, sizeof *m->lambda);
    m->power = workspace_array(w, modes, sizeof *m->power);
    m->weight = workspace_doubles(w, 4 * modes);
    m->product = workspace_doubles(w, 2 * of_dim * modes);
    m->turned = workspace_doubles(w, m->poles ? 2 * of_dim * modes : 0);
    m->term = workspace_doubles(w, of_rows * of_dim);
    m->series = workspace_doubles(w, (of_rows * of_dim + LANES) * TERMS);
  }
  if (!order || !m || m->memory.failed) {
    free(order);
    mode_sum_free(m);
    *out = NULL;
    return HC_NO_MEMORY;
  }
  for (int i = 0; i < n; ++i)
    order[i] = (ranked){of->lambda ? cabs(of->lambda[i]) : distance_of_mode(of->k[i], of->c[i]), i};
  qsort(order, (size_t)n, sizeof *order, by_distance);
  for (int i = 0; i < n; ++i) {
    m->distance[i] = order[i].distance;
    /* Mode i becomes the one numbered `from` in the table. */
    if (of->lambda) m->lambda[i] = of->lambda[order[i].mode];
    else m->k[i] = of->k[order[i].mode], m->c[i] = of->c[order[i].mode];
    for (int a = 0; a < m->rows; ++a) {
      const size_t at = (size_t)a * (size_t)m->n + (size_t)order[i].mode;
      m->lr[a * m->n + i] = of->lambda ? creal(of->left[at]) : of->x[at];
      if (!of->lambda) continue;
      m->li[a * m->n + i] = cimag(of->left[at]);
      m->rr[a * m->n + i] = creal(of->right[at]), m->ri[a * m->n + i] = cimag(of->right[at]);
    }
  }
  free(order);
  return HC_OK;
}

/* True for a sum over real modes, which allows d != 0. */
static bool mode_sum_takes_damping(const mode_sum *m) { return !m->poles; }

/* ---- the series ---------------------------------------------------------------------------------- */

/* Address of coefficient t of an entry's series. */
static double *coefficient(const mode_sum *m, size_t entry, int t)
{
  return m->series + (entry / LANES * TERMS + (size_t)t) * LANES + entry % LANES;
}

static void make_series(mode_sum *m, double reach)
{
  double *now = m->weight, *before = now + m->n;
  m->reach = reach;
  m->near = 0;
  while (m->near < m->n && !(m->distance[m->near] > FAR * reach)) ++m->near;
  for (int t = 0; t < TERMS; ++t) {
    /* Coefficient t of every far mode's series in s/reach, from those before it. Of a mode, 1/(k + c s + s^2): g_t =
     * -(c reach g_(t-1) + reach^2 g_(t-2))/k. Of a pole, 1/(s - lambda): -(reach/lambda)^t/lambda, and its
     * conjugate's. */
    for (int i = m->near; i < m->n; ++i) {
      if (m->poles) {
        m->power[i] = t == 0 ? -1 / m->lambda[i] : m->power[i] * (m->reach / m->lambda[i]);
        continue;
      }
      const double g =
          t == 0 ? 1 / m->k[i] : -(m->c[i] * m->reach * now[i] + m->reach * m->reach * before[i]) / m->k[i];
      before[i] = t == 0 ? 0 : now[i];
      now[i] = g;
    }
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

/* ---- a value ------------------------------------------------------------------------------------- */

/* The factor of each mode: 1/z (VALUE), or its derivative by s or by d. */
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
  /* weight[4][n]: factors of the real and of the imaginary parts of l r (add_modes). */
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
  if (!isfinite(sum)) return HC_NOT_FINITE;
  add_modes(m, n, from, to, G);
  return HC_OK;
}

/* G[from <= b < to][dim], if not NULL, at s = i w. by_s, if not NULL, gets dG/ds, and by_d dG/dd (of real modes).
 * reach: largest w to be expected; a new power series covers 1.5 times as much. HC_NOT_FINITE: an undamped mode
 * resonates at w. */
static hc_status mode_sum_at(mode_sum *m, double w, double reach, double d, int from, int to, double complex *G,
                             double complex *by_s, double complex *by_d)
{
  const bool in_reach = w <= m->reach && reach > m->reach / 4;
  if (d == 0 && !by_d && !in_reach && reach > 0) make_series(m, 1.5 * fmax(reach, w));
  const bool by_series = d == 0 && !by_d && m->reach > 0;
  const int n = by_series ? m->near : m->n;
  hc_status st = G ? add_up(m, n, w, d, VALUE, from, to, G) : HC_OK;
  if (st == HC_OK && by_s) st = add_up(m, n, w, d, BY_S, from, to, by_s);
  if (st == HC_OK && by_d) st = add_up(m, n, w, d, BY_D, from, to, by_d);
  /* += the series and, if by_s is not NULL, its derivative, at s = i w. With v = (s/reach)^2 < 0 even powers are
   * real. */
  if (st == HC_OK && by_series) {
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
  return st;
}

/* ---- a structure's sums --------------------------------------------------------------------------- */

/* Largest factors by which rounding may be magnified: 1/|w^* v| of an eigenvector; max|G| max|S| of the inversion. */
static const double most_condition = 1e6, most_cancelled = 1e8;

typedef struct asked_change {
  double w, reach, d;
  double complex ds, dd;
} asked_change;

struct compliance {
  int n, dim, n_loads, n_responses;
  mode_sum *of_q, *of_responses; /* left rows q or responses; right rows q, then cosine and sine of each load */
  double complex *G;             /* [dim + 2 n_loads][dim or n_responses] */
  double complex *by_s, *by_d;   /* [as G] dG/ds, later dG of compliance_change; dG/dd */
  asked_change change;           /* arguments of the last compliance_change, whose dG is in by_s; valid if
                                    change_is_known */
  bool change_is_known;
  int *pivot;           /* [dim] */
  double complex *work; /* [DENSE_INVERT_WORK dim] */
  workspace memory;     /* of all of these */
};

/* The structure in modal coordinates, from which both sums are made. */
typedef struct modal_form {
  int n, rows;    /* rows: responses, q, loads */
  double *omega2; /* [n] */
  double *phi;    /* [n][n] */
  double *C;      /* [n][n] phi^T C phi */
  double *x;      /* [rows][n] entries of each direction in the modes */
  workspace memory;
} modal_form;

/* A row of x: the direction d in the modes. */
static void add_row(modal_form *f, const double *d)
{
  const size_t n = (size_t)f->n;
  double *x = f->x + (size_t)f->rows++ * n;
  for (size_t i = 0; i < n; ++i) x[i] = dot_product(f->n, f->phi + i * n, d);
}

/* Order of rows: responses, q, loads; the sum of_q begins at q, so each sum's left rows come first. */
static hc_status make_form(const model *m, int dim, const double *B, modal_form *f)
{
  const size_t n = (size_t)m->n, rows = (size_t)m->n_responses + (size_t)dim + 2 * (size_t)m->n_loads;
  workspace *w = &f->memory;
  double *work = workspace_doubles(w, 2 * n * n);
  f->n = m->n;
  f->omega2 = workspace_doubles(w, n);
  f->phi = workspace_doubles(w, n * n);
  f->C = workspace_doubles(w, n * n);
  f->x = workspace_doubles(w, rows * n);
  const hc_status st = w->failed ? HC_NO_MEMORY : model_modes(m, false, f->omega2, f->phi);
  if (st != HC_OK) return st;
  dense_congruence(m->n, m->n, f->phi, m->damping, work, f->C);
  for (int r = 0; r < m->n_responses; ++r) add_row(f, m->responses + (size_t)r * n);
  for (int d = 0; d < dim; ++d) add_row(f, B + (size_t)d * n);
  for (int l = 0; l < m->n_loads; ++l) add_row(f, m->loads[l].cosine), add_row(f, m->loads[l].sine);
  return HC_OK;
}

/* ---- damping that the modes diagonalise ------------------------------------------------------------ */

static hc_status sum_modes(const model *m, int dim, const modal_form *f, compliance *c)
{
  const size_t n = (size_t)f->n;
  const int responses = m->n_responses;
  double *own = malloc(n * sizeof *own);
  hc_status st = own ? HC_OK : HC_NO_MEMORY;
  for (size_t i = 0; i < n && st == HC_OK; ++i) own[i] = f->C[i * (n + 1)];
  mode_table of = {.n = f->n, .k = f->omega2, .c = own, .x = f->x};
  if (st == HC_OK) st = mode_sum_new(&of, responses, f->rows, &c->of_responses);
  of.x += (size_t)responses * n;
  if (st == HC_OK) st = mode_sum_new(&of, dim, f->rows - responses, &c->of_q);
  free(own);
  return st;
}

/* ---- any damping ------------------------------------------------------------------------------------ */

/* out[k] = sum_i x[i] v[i] for a real x. */
static double complex project(size_t n, const double *x, const double complex *v)
{
  double re = 0, im = 0;
  for (size_t i = 0; i < n; ++i) re += x[i] * creal(v[i]), im += x[i] * cimag(v[i]);
  return re + I * im;
}

typedef struct pole_table {
  int n;                        /* poles kept: one of each pair */
  double complex *lambda;       /* [2n] */
  double complex *left, *right; /* [rows][n kept] */
} pole_table;

/* Poles with Im lambda >= 0 and the rows' l and r, from the eigenvectors V, W. False if an eigenvalue is ill
 * conditioned. */
static bool take_poles(const modal_form *f, double u, const double complex *lambda, const double complex *V,
                       const double complex *W, pole_table *t)
{
  const size_t n = (size_t)f->n, ld = 2 * n;
  int kept = 0;
  for (size_t k = 0; k < ld; ++k) kept += cimag(lambda[k]) >= 0;
  t->n = 0;
  for (size_t k = 0; k < ld; ++k) {
    if (cimag(lambda[k]) < 0) continue;
    double complex scale = 0;
    for (size_t i = 0; i < ld; ++i) scale += conj(W[k * ld + i]) * V[k * ld + i]; /* both are of length 1 */
    if (!(cabs(scale) * most_condition > 1)) return false;
    for (int a = 0; a < f->rows; ++a) {
      const double *x = f->x + (size_t)a * n;
      const size_t at = (size_t)a * (size_t)kept + (size_t)t->n;
      t->left[at] = project(n, x, V + k * ld);
      t->right[at] = conj(project(n, x, W + k * ld + n)) / (u * scale);
    }
    t->lambda[t->n++] = lambda[k];
  }
  return true;
}

static hc_status sum_poles(const model *m, int dim, const modal_form *f, compliance *c)
{
  const size_t n = (size_t)f->n, ld = 2 * n;
  double sum = 0;
  for (size_t i = 0; i < n; ++i) sum += sqrt(fabs(f->omega2[i]));
  const double u = sum > 0 ? sum / f->n : 1; /* mean natural frequency */
  workspace own = {0};
  double *A = workspace_doubles(&own, ld * ld);
  double complex *lambda = workspace_array(&own, ld, sizeof *lambda), *V = workspace_array(&own, ld * ld, sizeof *V),
                 *W = workspace_array(&own, ld * ld, sizeof *W);
  pole_table t = {.lambda = workspace_array(&own, ld, sizeof *t.lambda),
                  .left = workspace_array(&own, (size_t)f->rows * ld, sizeof *t.left),
                  .right = workspace_array(&own, (size_t)f->rows * ld, sizeof *t.right)};
  hc_status st = own.failed ? HC_NO_MEMORY : HC_OK;
  for (size_t j = 0; j < n && st == HC_OK; ++j) {
    A[(n + j) * ld + j] = u;
    A[j * ld + n + j] = -f->omega2[j] / u;
    for (size_t i = 0; i < n; ++i) A[(n + j) * ld + n + i] = -f->C[j * n + i];
  }
  if (st == HC_OK) st = dense_eigen(2 * f->n, A, lambda, V, W);
  if (st == HC_OK && take_poles(f, u, lambda, V, W, &t)) {
    const int responses = m->n_responses;
    mode_table of = {.n = t.n, .lambda = t.lambda, .left = t.left, .right = t.right};
    st = mode_sum_new(&of, responses, f->rows, &c->of_responses);
    of.left += (size_t)responses * (size_t)t.n, of.right += (size_t)responses * (size_t)t.n;
    if (st == HC_OK) st = mode_sum_new(&of, dim, f->rows - responses, &c->of_q);
  }
  workspace_free(&own);
  return st;
}

/* ---- made and freed --------------------------------------------------------------------------------- */

hc_status compliance_new(const model *m, int dim, const double *B, compliance **out)
{
  modal_form f = {.n = 0};
  *out = NULL;
  if (!dense_is_symmetric(m->n, m->stiffness)) return HC_OK;
  compliance *c = calloc(1, sizeof *c);
  if (!c) return HC_NO_MEMORY;
  *c = (compliance){.n = m->n, .dim = dim, .n_loads = m->n_loads, .n_responses = m->n_responses};
  hc_status st = make_form(m, dim, B, &f);
  bool damped = true; /* true if each mode dissipates: else a resonance is unbounded */
  for (size_t i = 0; i < (size_t)m->n && st == HC_OK; ++i) damped &= f.C[i * (size_t)(m->n + 1)] > 0;
  if (st == HC_OK && damped)
    st = dense_is_diagonal(f.n, f.C, f.n) ? sum_modes(m, dim, &f, c) : sum_poles(m, dim, &f, c);
  if (st == HC_OK && c->of_responses) {
    const size_t columns = (size_t)dim + 2 * (size_t)m->n_loads + (size_t)m->n_responses,
                 rows = (size_t)(dim > m->n_responses ? dim : m->n_responses);
    c->G = workspace_array(&c->memory, columns * rows, sizeof *c->G);
    c->by_s = workspace_array(&c->memory, columns * rows, sizeof *c->by_s);
    c->by_d = workspace_array(&c->memory, columns * rows, sizeof *c->by_d);
    c->work = workspace_array(&c->memory, DENSE_INVERT_WORK * (size_t)dim, sizeof *c->work);
    c->pivot = workspace_array(&c->memory, (size_t)dim, sizeof *c->pivot);
    st = c->memory.failed ? HC_NO_MEMORY : HC_OK;
  }
  workspace_free(&f.memory);
  const bool usable = st == HC_OK && c->of_responses;
  if (usable) *out = c;
  else compliance_free(c);
  return st == HC_NO_MEMORY ? st : HC_OK;
}

void compliance_free(compliance *c)
{
  if (!c) return;
  mode_sum_free(c->of_q);
  mode_sum_free(c->of_responses);
  workspace_free(&c->memory);
  free(c);
}

/* ---- at one frequency -------------------------------------------------------------------------------- */

static double largest(size_t n, const double complex *A)
{
  double most = 0;
  for (size_t i = 0; i < n; ++i) most = fmax(most, fabs(creal(A[i])) + fabs(cimag(A[i])));
  return most;
}

hc_status compliance_at(compliance *c, double w, double reach, double d, double complex *S, double complex *g)
{
  const size_t dim = (size_t)c->dim;
  if (d != 0 && !mode_sum_takes_damping(c->of_q)) return HC_NOT_FINITE;
  hc_status st = mode_sum_at(c->of_q, w, reach, d, 0, c->dim + 2 * c->n_loads, c->G, NULL, NULL);
  if (st != HC_OK) return st;
  memcpy(g, c->G + dim * dim, 2 * (size_t)c->n_loads * dim * sizeof *g);
  const double size = largest(dim * dim, c->G);
  memcpy(S, c->G, dim * dim * sizeof *S);
  if (dense_invert_complex(c->dim, S, c->pivot, c->work) != HC_OK) return HC_NOT_FINITE;
  return size * largest(dim * dim, S) <= most_cancelled ? HC_OK : HC_NOT_FINITE; /* false for NaN */
}

hc_status compliance_change(compliance *c, double w, double reach, double d, double complex ds, double complex dd,
                            const double complex **dG)
{
  const size_t dim = (size_t)c->dim, entries = dim * dim + 2 * (size_t)c->n_loads * dim;
  const bool by_damping = dd != 0;
  const asked_change asked = {w, reach, d, ds, dd};
  *dG = c->by_s;
  const asked_change *last = &c->change;
  const bool same = w == last->w && reach == last->reach && d == last->d && ds == last->ds && dd == last->dd;
  if (c->change_is_known && same) return HC_OK;
  c->change_is_known = false;
  if (by_damping && !mode_sum_takes_damping(c->of_q)) return HC_NOT_FINITE;
  hc_status st =
      mode_sum_at(c->of_q, w, reach, d, 0, c->dim + 2 * c->n_loads, NULL, c->by_s, by_damping ? c->by_d : NULL);
  if (st != HC_OK) return st;
  for (size_t i = 0; i < entries; ++i) c->by_s[i] = ds * c->by_s[i] + (by_damping ? dd * c->by_d[i] : 0);
  c->change = asked;
  c->change_is_known = true;
  return HC_OK;
}

hc_status compliance_of_response(compliance *c, double w, double reach, double d, int r, double complex *G_r,
                                 double complex *g_r)
{
  const int responses = c->n_responses, inputs = c->dim + 2 * c->n_loads;
  hc_status st = mode_sum_at(c->of_responses, w, reach, d, responses, responses + inputs, c->G, NULL, NULL);
  for (int e = 0; e < inputs && st == HC_OK; ++e) *(e < c->dim ? &G_r[e] : &g_r[e - c->dim]) = c->G[e * responses + r];
  return st;
}
