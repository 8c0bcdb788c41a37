/* compliance.c - see compliance.h. The first-order form, in modal coordinates eta of K and M and with a frequency u
 * that makes both halves of a state one size:
 *     d/dt [eta; eta'/u] = A [eta; eta'/u] + [0; f/u],   A = [0  u; -Lambda/u  -C]
 *     eta = sum_k v_k (w_k^* f) / (u w_k^* (v_k; ...)) / (s - lambda_k)      v: upper half of an eigenvector of A,
 *                                                                            w: lower half of the left one */
#include "hbm/structure/compliance.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/workspace.h"
#include "hbm/structure/mode_sum.h"
#include "model/modes.h"
#include "numerics/dense.h"

/* Rounding is multiplied by as much: of an eigenvector, and of G or S by inversion. */
static const double most_condition = 1e6, most_cancelled = 1e8;

typedef struct asked_change {
  double w, reach, d;
  double complex ds, dd;
} asked_change;

struct compliance {
  int n, dim, n_loads, n_responses;
  mode_sum *of_q, *of_responses; /* left rows q or responses, right rows q, then cosine and sine of each load */
  double complex *G;             /* [dim + 2 n_loads][dim or n_responses] */
  double complex *by_s, *by_d;   /* the same */
  asked_change change;           /* what by_s is of, once asked for */
  bool change_is_known;
  int *pivot;           /* [dim] */
  double complex *work; /* [DENSE_INVERT_WORK dim] */
  workspace memory;     /* of all of these */
};

/* What mode sums are made of. */
typedef struct modal_form {
  int n, rows;    /* rows: responses, q, loads */
  double *omega2; /* [n] */
  double *phi;    /* [n][n] */
  double *C;      /* [n][n] phi^T C phi */
  double *x;      /* [rows][n] each direction's entries in the modes */
  workspace memory;
} modal_form;

/* The direction of row k: of the responses, then of q, then of the loads. Either sum begins with its left rows. */
static const double *direction(const model *m, int dim, const double *B, int k)
{
  const int of_q = k - m->n_responses, of_load = of_q - dim;
  if (of_q < 0) return m->responses + (size_t)k * (size_t)m->n;
  if (of_load < 0) return B + (size_t)of_q * (size_t)m->n;
  return of_load % 2 ? m->loads[of_load / 2].sine : m->loads[of_load / 2].cosine;
}

static hc_status make_form(const model *m, int dim, const double *B, modal_form *f)
{
  const size_t n = (size_t)m->n;
  *f = (modal_form){.n = m->n, .rows = dim + 2 * m->n_loads + m->n_responses};
  double *work = workspace_doubles(&f->memory, 2 * n * n);
  f->omega2 = workspace_array(&f->memory, n, sizeof *f->omega2);
  f->phi = workspace_array(&f->memory, n * n, sizeof *f->phi);
  f->C = workspace_array(&f->memory, n * n, sizeof *f->C);
  f->x = workspace_array(&f->memory, (size_t)f->rows * n, sizeof *f->x);
  hc_status st = f->memory.failed ? HC_NO_MEMORY : HC_OK;
  if (st == HC_OK) st = model_modes(m, false, f->omega2, f->phi);
  if (st == HC_OK) dense_congruence(m->n, m->n, f->phi, m->damping, work, f->C);
  for (int k = 0; k < f->rows && st == HC_OK; ++k) {
    const double *d = direction(m, dim, B, k);
    for (size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (size_t j = 0; j < n; ++j) sum += f->phi[i * n + j] * d[j];
      f->x[(size_t)k * n + i] = sum;
    }
  }
  return st;
}

/* ---- damping that the modes diagonalise ------------------------------------------------------------ */

/* Rounding in C is relative to its largest entry. */
static bool is_diagonal(const modal_form *f)
{
  double largest = 0, beside = 0;
  for (int j = 0; j < f->n; ++j)
    for (int i = 0; i < f->n; ++i) {
      double *of = i == j ? &largest : &beside;
      *of = fmax(*of, fabs(f->C[(size_t)i + (size_t)j * (size_t)f->n]));
    }
  return beside <= 8 * f->n * DBL_EPSILON * largest;
}

static hc_status sum_modes(const model *m, int dim, const modal_form *f, compliance *c)
{
  const size_t n = (size_t)f->n;
  const int responses = m->n_responses;
  double *own = malloc(n * sizeof *own);
  hc_status st = own ? HC_OK : HC_NO_MEMORY;
  for (size_t i = 0; i < n && st == HC_OK; ++i) own[i] = f->C[i * (n + 1)];
  if (st == HC_OK)
    st = mode_sum_of_modes(f->n, f->omega2, own, dim, f->rows - responses, f->x + (size_t)responses * n, &c->of_q);
  if (st == HC_OK) st = mode_sum_of_modes(f->n, f->omega2, own, responses, f->rows, f->x, &c->of_responses);
  free(own);
  return st;
}

/* ---- any damping ------------------------------------------------------------------------------------ */

static void fill_first_order(const modal_form *f, double u, double *A)
{
  const size_t n = (size_t)f->n, ld = 2 * n;
  memset(A, 0, ld * ld * sizeof *A);
  for (size_t j = 0; j < n; ++j) {
    A[(n + j) * ld + j] = u;
    A[j * ld + n + j] = -f->omega2[j] / u;
    for (size_t i = 0; i < n; ++i) A[(n + j) * ld + n + i] = -f->C[j * n + i];
  }
}

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

/* From the eigenvectors V, W the rows' entries at the poles with Im lambda >= 0. False where one is ill conditioned. */
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

/* A frequency amid the structure's own. */
static double middle_frequency(const modal_form *f)
{
  double sum = 0;
  for (int i = 0; i < f->n; ++i) sum += sqrt(fabs(f->omega2[i]));
  return sum > 0 ? sum / f->n : 1;
}

static hc_status sum_poles(const model *m, int dim, const modal_form *f, compliance *c)
{
  const size_t n = (size_t)f->n, ld = 2 * n;
  const double u = middle_frequency(f);
  workspace own = {0};
  double *A = workspace_doubles(&own, ld * ld);
  double complex *lambda = workspace_array(&own, ld, sizeof *lambda), *V = workspace_array(&own, ld * ld, sizeof *V),
                 *W = workspace_array(&own, ld * ld, sizeof *W);
  pole_table t = {.lambda = workspace_array(&own, ld, sizeof *t.lambda),
                  .left = workspace_array(&own, (size_t)f->rows * ld, sizeof *t.left),
                  .right = workspace_array(&own, (size_t)f->rows * ld, sizeof *t.right)};
  hc_status st = own.failed ? HC_NO_MEMORY : HC_OK;
  if (st == HC_OK) fill_first_order(f, u, A);
  if (st == HC_OK) st = dense_eigen_both(2 * f->n, A, lambda, V, W);
  if (st == HC_OK && take_poles(f, u, lambda, V, W, &t)) {
    const int responses = m->n_responses, inputs = f->rows - responses;
    const size_t behind = (size_t)responses * (size_t)t.n;
    st = mode_sum_of_poles(t.n, t.lambda, dim, inputs, t.left + behind, t.right + behind, &c->of_q);
    if (st == HC_OK) st = mode_sum_of_poles(t.n, t.lambda, responses, f->rows, t.left, t.right, &c->of_responses);
  }
  workspace_free(&own);
  return st;
}

/* ---- made and freed --------------------------------------------------------------------------------- */

/* Does every mode lose energy? One that does not could resonate without bound. */
static bool every_mode_is_damped(const modal_form *f)
{
  for (int i = 0; i < f->n; ++i)
    if (!(f->C[(size_t)i * (size_t)(f->n + 1)] > 0)) return false;
  return true;
}

static hc_status make_workspace(const model *m, int dim, compliance *c)
{
  const size_t columns = (size_t)dim + 2 * (size_t)m->n_loads + (size_t)m->n_responses,
               rows = (size_t)(dim > m->n_responses ? dim : m->n_responses);
  c->G = workspace_array(&c->memory, columns * rows, sizeof *c->G);
  c->by_s = workspace_array(&c->memory, columns * rows, sizeof *c->by_s);
  c->by_d = workspace_array(&c->memory, columns * rows, sizeof *c->by_d);
  c->work = workspace_array(&c->memory, DENSE_INVERT_WORK * (size_t)dim, sizeof *c->work);
  c->pivot = workspace_array(&c->memory, (size_t)dim, sizeof *c->pivot);
  return c->memory.failed ? HC_NO_MEMORY : HC_OK;
}

hc_status compliance_new(const model *m, int dim, const double *B, compliance **out)
{
  modal_form f = {.n = 0};
  *out = NULL;
  if (!dense_is_symmetric(m->n, m->stiffness)) return HC_OK;
  compliance *c = calloc(1, sizeof *c);
  if (!c) return HC_NO_MEMORY;
  *c = (compliance){.n = m->n, .dim = dim, .n_loads = m->n_loads, .n_responses = m->n_responses};
  hc_status st = make_form(m, dim, B, &f);
  if (st == HC_OK && every_mode_is_damped(&f))
    st = is_diagonal(&f) ? sum_modes(m, dim, &f, c) : sum_poles(m, dim, &f, c);
  if (st == HC_OK && c->of_responses) st = make_workspace(m, dim, c);
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

static bool is_same_change(const asked_change *a, const asked_change *b)
{
  return a->w == b->w && a->reach == b->reach && a->d == b->d && a->ds == b->ds && a->dd == b->dd;
}

hc_status compliance_change(compliance *c, double w, double reach, double d, double complex ds, double complex dd,
                            const double complex **dG)
{
  const size_t dim = (size_t)c->dim, entries = dim * dim + 2 * (size_t)c->n_loads * dim;
  const bool by_damping = dd != 0;
  const asked_change asked = {w, reach, d, ds, dd};
  *dG = c->by_s;
  if (c->change_is_known && is_same_change(&asked, &c->change)) return HC_OK;
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
