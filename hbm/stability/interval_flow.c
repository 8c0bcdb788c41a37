/* interval_flow.c - see interval_flow.h. With y = V^-1 (dx, dx') and b = V^-1 (0, M^-1 t_j):
 *     y(t) = e^(lambda t) y(0) + (e^(lambda t) - 1)/lambda b dheld
 * One of a complex pair is followed, as two real coordinates; the other's share is conjugate. */
#include "hbm/stability/interval_flow.h"

#include <complex.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_matrix.h>
#include <string.h>

#include "numerics/base/workspace.h"
#include "numerics/dense.h"

enum { MOST_STATES = 32 }; /* combinations of contact states that are kept; more replace the oldest */

/* One combination. */
typedef struct decomposition {
  char *key;              /* [n_contacts] contact_state + 1 of each */
  bool usable;            /* else by the matrix exponential */
  int n;                  /* eigenvalues that are followed: real ones and those of positive imaginary part */
  double complex *lambda; /* [n] */
  double *V, *W;          /* [moving][2 n], [2 n][moving] by rows: (dx, dx') = V y, y = W (dx, dx'), and y of eigenvalue
                             k is y[2k] + i y[2k + 1] */
  workspace memory;
} decomposition;

struct interval_flow {
  const model *m;
  int n, moving /* 2n */, n_states;
  double unit;            /* [1/time] of velocities in A */
  double *by_K, *by_C;    /* [n][n] by columns: M^-1 K, M^-1 C */
  double *along, *across; /* [n_contacts][n] M^-1 t_j, M^-1 n_j */
  char *key;              /* [n_contacts] of the interval */
  double *A;              /* [2n][2n] by columns */
  int kept, oldest;
  decomposition known[MOST_STATES];
  int *pivot;                          /* [2n] */
  double complex *work;                /* [3][2n][2n] and [2n] of decompose: V, its factors, W; lambda */
  double *y;                           /* [2 moving][n_states] coordinates of phi in the eigenvectors */
  double *column;                      /* [2n] of phi, by the matrix exponential */
  int n_lasting, *lasting;             /* [moving] of interval_flow_survivors: which rows of y outlast it */
  workspace memory;                    /* of all of these */
  gsl_matrix *augmented, *exponential; /* [n_states]^2, for what has no eigenvectors; made when needed */
};

/* ---- A ---------------------------------------------------------------------------------------------- */

/* A -= k a b^T in the rows of dx', the columns of dx. */
static void subtract_outer(interval_flow *f, double k, const double *a, const double *b)
{
  for (int e = 0; e < f->n && k != 0; ++e)
    for (int i = 0; i < f->n; ++i) f->A[(size_t)e * (size_t)f->moving + (size_t)(f->n + i)] -= k * a[i] * b[e];
}

static void interval_add_contact(interval_flow *f, int j, const contact_interval *p)
{
  const model_contact *c = &f->m->contacts[j];
  const double *along = f->along + (size_t)j * (size_t)f->n, *across = f->across + (size_t)j * (size_t)f->n;
  subtract_outer(f, c->law.kn, across, c->normal);
  subtract_outer(f, contact_interval_stiffness(&c->law, p), along,
                 contact_slip_sign(p->state) ? c->normal : c->tangent);
}

/* Velocities are taken by a frequency amid those of the structure with its contacts as they are: contacts may be all
 * that holds it. */
static void interval_fill_A(interval_flow *f, const contact_interval *const *interval)
{
  const size_t n = (size_t)f->n, ld = (size_t)f->moving;
  double sum = 0;
  memset(f->A, 0, ld * ld * sizeof *f->A);
  for (size_t e = 0; e < n; ++e)
    for (size_t i = 0; i < n; ++i) {
      f->A[e * ld + n + i] = -f->by_K[e * n + i];
      f->A[(n + e) * ld + n + i] = -f->by_C[e * n + i];
    }
  for (int j = 0; j < f->m->n_contacts; ++j)
    if (interval[j]) interval_add_contact(f, j, interval[j]);
  for (size_t e = 0; e < n; ++e) sum += fabs(f->A[e * ld + n + e]);
  f->unit = sum > 0 ? sqrt(sum / f->m->n) : 1;
  for (size_t e = 0; e < n; ++e) {
    f->A[(n + e) * ld + e] = f->unit;
    for (size_t i = 0; i < n; ++i) f->A[e * ld + n + i] /= f->unit;
  }
}

/* ---- its eigenvectors --------------------------------------------------------------------------------- */

/* W = V^-T. The norm of W times that of V bounds what rounding is multiplied by, at every interval anew. */
static bool interval_invert(interval_flow *f, const double complex *V, double complex *lu, double complex *W)
{
  const double most = 1e4;
  const size_t ld = (size_t)f->moving;
  double size_V = 0, size_W = 0;
  memcpy(lu, V, ld * ld * sizeof *lu);
  if (dense_factor_complex(f->moving, lu, f->pivot) != HC_OK) return false;
  for (size_t i = 0; i < ld * ld; ++i) W[i] = i % (ld + 1) == 0;
  dense_solve_complex(f->moving, lu, f->pivot, true, f->moving, W);
  for (size_t i = 0; i < ld * ld; ++i) size_V = fmax(size_V, cabs(V[i])), size_W = fmax(size_W, cabs(W[i]));
  return size_V * size_W < most; /* false for NaN */
}

/* The eigenvalues that are followed, with their columns of V and of W. */
static void keep_halves(const interval_flow *f, const double complex *lambda, const double complex *V,
                        const double complex *W, decomposition *d)
{
  const size_t ld = (size_t)f->moving;
  size_t kept = 0, rows = 0, at = 0;
  for (size_t k = 0; k < ld; ++k) kept += cimag(lambda[k]) >= 0;
  rows = 2 * kept;
  d->n = (int)kept;
  for (size_t k = 0; k < ld; ++k) {
    if (cimag(lambda[k]) < 0) continue;
    const double shares = cimag(lambda[k]) > 0 ? 2 : 1;
    for (size_t i = 0; i < ld; ++i) {
      const double unit = i < (size_t)f->n ? 1 : f->unit;
      const double complex v = shares * unit * V[k * ld + i], w = W[k * ld + i] / unit;
      d->V[i * rows + 2 * at] = creal(v), d->V[i * rows + 2 * at + 1] = -cimag(v);
      d->W[2 * at * ld + i] = creal(w), d->W[(2 * at + 1) * ld + i] = cimag(w);
    }
    d->lambda[at++] = lambda[k];
  }
}

static void interval_forget(decomposition *d)
{
  workspace_free(&d->memory);
  *d = (decomposition){0};
}

static hc_status decompose(interval_flow *f, const contact_interval *const *interval, decomposition *d)
{
  const size_t ld = (size_t)f->moving, contacts = (size_t)f->m->n_contacts;
  double complex *V = f->work, *lu = V + ld * ld, *W = lu + ld * ld, *lambda = W + ld * ld;
  interval_forget(d);
  d->key = workspace_array(&d->memory, contacts, 1);
  d->lambda = workspace_array(&d->memory, ld, sizeof *d->lambda);
  d->V = workspace_doubles(&d->memory, 2 * ld * ld);
  d->W = workspace_doubles(&d->memory, 2 * ld * ld);
  if (d->memory.failed) {
    interval_forget(d);
    return HC_NO_MEMORY;
  }
  memcpy(d->key, f->key, contacts);
  interval_fill_A(f, interval);
  hc_status st = dense_eigen(f->moving, f->A, lambda, V, NULL);
  d->usable = st == HC_OK && interval_invert(f, V, lu, W);
  if (d->usable) keep_halves(f, lambda, V, W, d);
  return st == HC_NOT_CONVERGED ? HC_OK : st;
}

static hc_status interval_find(interval_flow *f, const contact_interval *const *interval, const decomposition **out)
{
  for (int j = 0; j < f->m->n_contacts; ++j) f->key[j] = (char)(interval[j] ? 1 + (int)interval[j]->state : 0);
  for (int k = 0; k < f->kept; ++k) {
    *out = &f->known[k];
    if (!memcmp(f->known[k].key, f->key, (size_t)f->m->n_contacts)) return HC_OK;
  }
  const int at = f->kept < MOST_STATES ? f->kept : f->oldest;
  hc_status st = decompose(f, interval, &f->known[at]);
  if (st != HC_OK && f->kept == MOST_STATES) f->kept = 0; /* a gap in the list: begin anew */
  if (st != HC_OK) return st;
  if (f->kept < MOST_STATES) ++f->kept;
  else f->oldest = (f->oldest + 1) % MOST_STATES;
  *out = &f->known[at];
  return HC_OK;
}

/* Motions of which this part is left, times what V may multiply it by (interval_modes.c), are lost in rounding. */
static const double DEAD = 1e-24;

/* ---- made and freed ------------------------------------------------------------------------------ */

static void interval_solve(int n, const double *lu, const int *pivot, int columns, const double *from, double *to)
{
  memcpy(to, from, (size_t)n * (size_t)columns * sizeof *to);
  dense_solve(n, lu, pivot, columns, to);
}

static hc_status divide_by_mass(const model *m, interval_flow *f)
{
  const int n = m->n;
  double *lu = malloc((size_t)n * (size_t)n * sizeof *lu);
  hc_status st = lu ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) {
    memcpy(lu, m->mass, (size_t)n * (size_t)n * sizeof *lu);
    st = dense_factor(n, lu, f->pivot);
  }
  if (st == HC_OK) {
    interval_solve(n, lu, f->pivot, n, m->stiffness, f->by_K);
    interval_solve(n, lu, f->pivot, n, m->damping, f->by_C);
  }
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    interval_solve(n, lu, f->pivot, 1, m->contacts[j].tangent, f->along + (size_t)j * (size_t)n);
    interval_solve(n, lu, f->pivot, 1, m->contacts[j].normal, f->across + (size_t)j * (size_t)n);
  }
  free(lu);
  return st;
}

hc_status interval_flow_new(const model *m, interval_flow **out)
{
  const size_t n = (size_t)m->n, contacts = (size_t)m->n_contacts;
  interval_flow *f = calloc(1, sizeof *f);
  *out = NULL;
  if (!f) return HC_NO_MEMORY;
  f->m = m;
  f->n = m->n;
  f->moving = 2 * m->n;
  f->n_states = f->moving + m->n_contacts;
  f->by_K = workspace_array(&f->memory, n * n, sizeof *f->by_K);
  f->by_C = workspace_array(&f->memory, n * n, sizeof *f->by_C);
  f->along = workspace_array(&f->memory, n * contacts + 1, sizeof *f->along);
  f->across = workspace_array(&f->memory, n * contacts + 1, sizeof *f->across);
  f->key = workspace_array(&f->memory, contacts + 1, sizeof *f->key);
  f->A = workspace_array(&f->memory, 4 * n * n, sizeof *f->A);
  f->pivot = workspace_array(&f->memory, 2 * n, sizeof *f->pivot);
  f->work = workspace_array(&f->memory, 12 * n * n + 2 * n, sizeof *f->work);
  f->y = workspace_array(&f->memory, 4 * n * (2 * n + contacts), sizeof *f->y);
  f->column = workspace_doubles(&f->memory, 2 * n);
  f->lasting = workspace_array(&f->memory, 2 * n, sizeof *f->lasting);
  hc_status st = f->memory.failed ? HC_NO_MEMORY : divide_by_mass(m, f);
  if (st == HC_OK) *out = f;
  else interval_flow_free(f);
  return st;
}

void interval_flow_free(interval_flow *f)
{
  if (!f) return;
  for (int k = 0; k < MOST_STATES; ++k) interval_forget(&f->known[k]);
  workspace_free(&f->memory);
  if (f->augmented) gsl_matrix_free(f->augmented);
  if (f->exponential) gsl_matrix_free(f->exponential);
  free(f);
}

/* ---- an interval ------------------------------------------------------------------------------------------ */

/* The first `columns` columns of C = A B, by rows: A[rows][inner], B[inner][n_states], C[rows][n_states]. Counted by
 * columns, as in dense.h, these are the transposes. */
static void interval_multiply(const interval_flow *f, int rows, int inner, int columns, const double *A,
                              const double *B, double *C)
{
  dense_add_product(columns, rows, inner, 1, B, f->n_states, A, inner, 0, C, f->n_states);
}

/* (e^(lambda t) - 1)/lambda. */
static double complex interval_integral(double complex lambda, double t)
{
  const double complex z = lambda * t;
  if (cabs(z) > 0.1) return (cexp(z) - 1) / lambda;
  double complex sum = 1, term = 1;
  for (int k = 2; k < 14; ++k) sum += term *= z / k;
  return t * sum;
}

/* What a stuck slider j pulls coordinate k with. */
static double complex pull_on(const interval_flow *f, const decomposition *d, int k, int j)
{
  const double *re = d->W + (size_t)(2 * k) * (size_t)f->moving + f->n, *im = re + f->moving,
               *force = f->along + (size_t)j * (size_t)f->n;
  double sum[2] = {0};
  for (int i = 0; i < f->n; ++i) sum[0] += re[i] * force[i], sum[1] += im[i] * force[i];
  return sum[0] + I * sum[1];
}

/* y = e^(lambda t) y + (e^(lambda t) - 1)/lambda b dheld, of coordinate k. */
static void interval_grow(const interval_flow *f, const decomposition *d, const contact_interval *const *interval,
                          double duration, int k, int columns, const double *phi)
{
  const double complex growth = cexp(d->lambda[k] * duration);
  const double c = creal(growth), s = cimag(growth);
  double *restrict re = f->y + (size_t)(2 * k) * (size_t)f->n_states, *restrict im = re + f->n_states;
  for (int q = 0; q < columns; ++q) {
    const double a = re[q], b = im[q];
    re[q] = c * a - s * b;
    im[q] = c * b + s * a;
  }
  for (int j = 0; j < f->m->n_contacts; ++j) {
    if (!contact_interval_holds(&f->m->contacts[j].law, interval[j])) continue;
    const double *held = phi + (size_t)(f->moving + j) * (size_t)f->n_states;
    const double complex by_held = interval_integral(d->lambda[k], duration) * pull_on(f, d, k, j);
    for (int q = 0; q < columns; ++q) re[q] += creal(by_held) * held[q], im[q] += cimag(by_held) * held[q];
  }
}

/* By the exponential of A, augmented by the dheld, which are constant. */
static hc_status advance_by_exponential(interval_flow *f, const contact_interval *const *interval, double duration,
                                        int columns, double *phi)
{
  const size_t n = (size_t)f->n, ld = (size_t)f->moving, states = (size_t)f->n_states;
  if (!f->augmented) f->augmented = gsl_matrix_alloc(states, states);
  if (!f->exponential) f->exponential = gsl_matrix_alloc(states, states);
  if (!f->augmented || !f->exponential) return HC_NO_MEMORY;
  interval_fill_A(f, interval);
  gsl_matrix_set_zero(f->augmented);
  for (size_t e = 0; e < ld; ++e)
    for (size_t i = 0; i < ld; ++i) gsl_matrix_set(f->augmented, i, e, f->A[e * ld + i] * duration);
  for (int j = 0; j < f->m->n_contacts; ++j)
    for (size_t i = 0; i < n && contact_interval_holds(&f->m->contacts[j].law, interval[j]); ++i)
      gsl_matrix_set(f->augmented, n + i, ld + (size_t)j, f->along[(size_t)j * n + i] / f->unit * duration);
  if (gsl_linalg_exponential_ss(f->augmented, f->exponential, GSL_PREC_DOUBLE) != GSL_SUCCESS) return HC_NOT_FINITE;
  for (size_t q = 0; q < (size_t)columns; ++q) {
    for (size_t i = 0; i < ld; ++i) {
      double sum = 0;
      for (size_t k = 0; k < states; ++k)
        sum += gsl_matrix_get(f->exponential, i, k) * phi[k * states + q] / (k >= n && k < ld ? f->unit : 1);
      f->column[i] = sum;
    }
    for (size_t i = 0; i < ld; ++i) phi[i * states + q] = f->column[i] * (i >= n ? f->unit : 1);
  }
  return HC_OK;
}

hc_status interval_flow_advance(interval_flow *f, const contact_interval *const *interval, double duration, int columns,
                                double *phi)
{
  const decomposition *d;
  hc_status st = interval_find(f, interval, &d);
  if (st == HC_OK && !d->usable) st = advance_by_exponential(f, interval, duration, columns, phi);
  else if (st == HC_OK) {
    interval_multiply(f, 2 * d->n, f->moving, columns, d->W, phi, f->y);
    for (int k = 0; k < d->n; ++k) interval_grow(f, d, interval, duration, k, columns, phi);
    interval_multiply(f, f->moving, 2 * d->n, columns, d->V, f->y, phi);
  }
  if (st == HC_OK && !isfinite(phi[0])) st = HC_NOT_FINITE;
  return st;
}

/* ---- what is left at the end of an interval ----------------------------------------------------------- */

/* Column `to` of phi += scale * what coordinate c is in (dx, dx'). */
static void add_coordinate(const interval_flow *f, const decomposition *d, int c, double scale, int to, double *phi)
{
  const size_t rows = 2 * (size_t)d->n;
  for (size_t i = 0; i < (size_t)f->moving; ++i)
    phi[i * (size_t)f->n_states + (size_t)to] += scale * (d->usable ? d->V[i * rows + (size_t)c] : (int)i == c);
}

/* Slider j moved by 1, dheld = kt, and what that leaves of the coordinates that die out: y = -b/lambda dheld. */
static void add_slider(const interval_flow *f, const decomposition *d, double duration, int j, int to, double *phi)
{
  const double kt = f->m->contacts[j].law.kt;
  phi[(size_t)(f->moving + j) * (size_t)f->n_states + (size_t)to] = kt;
  for (int k = 0; k < d->n && d->usable; ++k) {
    if (!(exp(creal(d->lambda[k]) * duration) < DEAD)) continue;
    const double complex left = -kt * pull_on(f, d, k, j) / d->lambda[k];
    add_coordinate(f, d, 2 * k, creal(left), to, phi);
    add_coordinate(f, d, 2 * k + 1, cimag(left), to, phi);
  }
}

hc_status interval_flow_survivors(interval_flow *f, const contact_interval *const *interval, double duration,
                                  int n_sliders, int *slider, const bool *sticks_on, double *phi, int *columns)
{
  const decomposition *d;
  hc_status st = interval_find(f, interval, &d);
  *columns = 0;
  if (st != HC_OK) return st;
  memset(phi, 0, (size_t)f->n_states * (size_t)f->n_states * sizeof *phi);
  f->n_lasting = 0; /* coordinates that outlast it; all of (dx, dx') where there are no eigenvectors */
  for (int i = 0; i < f->moving && !d->usable; ++i) f->lasting[f->n_lasting++] = i;
  for (int k = 0; k < d->n && d->usable; ++k) {
    if (exp(creal(d->lambda[k]) * duration) < DEAD) continue;
    f->lasting[f->n_lasting++] = 2 * k;
    if (cimag(d->lambda[k]) > 0) f->lasting[f->n_lasting++] = 2 * k + 1;
  }
  for (; *columns < f->n_lasting; ++*columns) add_coordinate(f, d, f->lasting[*columns], 1, *columns, phi);
  for (int s = 0; s < n_sliders; ++s) {
    const bool counts = sticks_on[s] || f->n_lasting < f->moving;
    if (!counts) continue;
    slider[*columns - f->n_lasting] = slider[s];
    add_slider(f, d, duration, slider[s], (*columns)++, phi);
  }
  return HC_OK;
}

hc_status interval_flow_coordinates(interval_flow *f, const contact_interval *const *interval, const int *slider,
                                    int columns, const double *phi, double *out)
{
  const size_t ld = (size_t)f->moving, states = (size_t)f->n_states;
  const decomposition *d;
  hc_status st = interval_find(f, interval, &d);
  if (st != HC_OK) return st;
  for (int r = 0; r < f->n_lasting; ++r) {
    double *row = out + (size_t)r * states;
    if (d->usable) interval_multiply(f, 1, f->moving, columns, d->W + (size_t)f->lasting[r] * ld, phi, row);
    else memcpy(row, phi + (size_t)r * states, (size_t)columns * sizeof *row);
  }
  for (int r = f->n_lasting; r < columns; ++r) {
    const int j = slider[r - f->n_lasting];
    const double *held = phi + (ld + (size_t)j) * states;
    for (int q = 0; q < columns; ++q) out[(size_t)r * states + (size_t)q] = held[q] / f->m->contacts[j].law.kt;
  }
  return HC_OK;
}
