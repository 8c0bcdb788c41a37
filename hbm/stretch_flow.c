/* stretch_flow.c - see stretch_flow.h. With y = V^-1 (dx, dx') and b = V^-1 (0, M^-1 t_j):
 *     y(t) = e^(lambda t) y(0) + (e^(lambda t) - 1)/lambda b dheld
 * Of a complex pair one is followed; the other's share is conjugate. Velocities are divided by a
 * frequency of the structure's, so that both halves of a state are of one size. */
#include "hbm/stretch_flow.h"

#include <complex.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/dense.h"
#include "numerics/lu.h"

enum { MOST_STATES = 32 }; /* combinations of contact states that are kept; more replace the oldest */

/* One combination. */
typedef struct decomposition {
  char *key;              /* [n_contacts] contact_state + 1 of each */
  bool usable;            /* else by the matrix exponential */
  int n;                  /* eigenvalues that are followed: real ones and those of positive imaginary part */
  double complex *lambda; /* [n] */
  double *V, *W;          /* [n][2][2n] columns of V, twice those of pairs, and rows of V^-1: real, imaginary parts */
} decomposition;

struct stretch_flow {
  const model *m;
  int n, moving /* 2n */, n_states;
  double unit;            /* [1/time] of velocities */
  double *by_K, *by_C;    /* [n][n] by columns: M^-1 K, M^-1 C */
  double *along, *across; /* [n_contacts][n] M^-1 t_j, M^-1 n_j */
  char *key;              /* [n_contacts] of the stretch */
  double *A;              /* [2n][2n] by columns */
  int kept, oldest;
  decomposition known[MOST_STATES];
  int *pivot;                          /* [2n] */
  double complex *work;                /* [3][2n][2n] and [2n] */
  double complex *growth, *sum;        /* [2n] e^(lambda t) and its integral, over a stretch */
  double *x, *moved;                   /* [2n] a column before and after */
  gsl_matrix *augmented, *exponential; /* [n_states]^2, for what has no eigenvectors; made when needed */
};

/* ---- made and freed ------------------------------------------------------------------------------ */

static void solve_columns(int n, const double *lu, const int *pivot, int columns, const double *from, double *to)
{
  memcpy(to, from, (size_t)n * (size_t)columns * sizeof *to);
  for (int k = 0; k < columns; ++k) lu_solve(n, lu, pivot, to + (size_t)k * (size_t)n);
}

static hc_status divide_by_mass(const model *m, stretch_flow *f)
{
  const int n = m->n;
  double *lu = malloc((size_t)n * (size_t)n * sizeof *lu);
  hc_status st = lu ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) {
    memcpy(lu, m->mass, (size_t)n * (size_t)n * sizeof *lu);
    if (!lu_factor(n, lu, f->pivot)) st = HC_SINGULAR;
  }
  if (st == HC_OK) {
    solve_columns(n, lu, f->pivot, n, m->stiffness, f->by_K);
    solve_columns(n, lu, f->pivot, n, m->damping, f->by_C);
  }
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    solve_columns(n, lu, f->pivot, 1, m->contacts[j].tangent, f->along + (size_t)j * (size_t)n);
    solve_columns(n, lu, f->pivot, 1, m->contacts[j].normal, f->across + (size_t)j * (size_t)n);
  }
  free(lu);
  return st;
}

/* A frequency amid the structure's own. */
static double middle_frequency(const stretch_flow *f)
{
  double sum = 0;
  for (int i = 0; i < f->n; ++i) sum += fabs(f->by_K[(size_t)i * (size_t)(f->n + 1)]);
  return sum > 0 ? sqrt(sum / f->n) : 1;
}

hc_status stretch_flow_new(const model *m, stretch_flow **out)
{
  const size_t n = (size_t)m->n, contacts = (size_t)m->n_contacts;
  stretch_flow *f = calloc(1, sizeof *f);
  *out = NULL;
  if (!f) return HC_NO_MEMORY;
  f->m = m;
  f->n = m->n;
  f->moving = 2 * m->n;
  f->n_states = f->moving + m->n_contacts;
  f->by_K = calloc(n * n, sizeof *f->by_K);
  f->by_C = calloc(n * n, sizeof *f->by_C);
  f->along = calloc(n * contacts + 1, sizeof *f->along);
  f->across = calloc(n * contacts + 1, sizeof *f->across);
  f->key = calloc(contacts + 1, sizeof *f->key);
  f->A = calloc(4 * n * n, sizeof *f->A);
  f->pivot = calloc(2 * n, sizeof *f->pivot);
  f->work = calloc(12 * n * n + 2 * n, sizeof *f->work);
  f->growth = calloc(4 * n, sizeof *f->growth);
  f->sum = f->growth ? f->growth + 2 * n : NULL;
  f->x = calloc(4 * n, sizeof *f->x);
  f->moved = f->x ? f->x + 2 * n : NULL;
  const bool linear = f->by_K && f->by_C && f->along && f->across,
             room = f->key && f->A && f->pivot && f->work && f->growth && f->x;
  hc_status st = linear && room ? divide_by_mass(m, f) : HC_NO_MEMORY;
  if (st == HC_OK) f->unit = middle_frequency(f);
  if (st == HC_OK) *out = f;
  else stretch_flow_free(f);
  return st;
}

static void forget(decomposition *d)
{
  free(d->key);
  free(d->lambda);
  free(d->V);
  free(d->W);
  *d = (decomposition){0};
}

void stretch_flow_free(stretch_flow *f)
{
  if (!f) return;
  for (int k = 0; k < MOST_STATES; ++k) forget(&f->known[k]);
  free(f->by_K);
  free(f->by_C);
  free(f->along);
  free(f->across);
  free(f->key);
  free(f->A);
  free(f->pivot);
  free(f->work);
  free(f->growth);
  free(f->x);
  if (f->augmented) gsl_matrix_free(f->augmented);
  if (f->exponential) gsl_matrix_free(f->exponential);
  free(f);
}

/* ---- A ---------------------------------------------------------------------------------------------- */

/* A -= k a b^T / unit in the rows of dx', the columns of dx. */
static void subtract_outer(stretch_flow *f, double k, const double *a, const double *b)
{
  for (int e = 0; e < f->n && k != 0; ++e)
    for (int i = 0; i < f->n; ++i)
      f->A[(size_t)e * (size_t)f->moving + (size_t)(f->n + i)] -= k / f->unit * a[i] * b[e];
}

static void add_contact(stretch_flow *f, int j, const contact_piece *p)
{
  const model_contact *c = &f->m->contacts[j];
  const double *along = f->along + (size_t)j * (size_t)f->n, *across = f->across + (size_t)j * (size_t)f->n;
  const int slip = contact_slip_sign(p->state);
  subtract_outer(f, c->law.kn, across, c->normal);
  if (!contact_has_friction(&c->law)) return;
  if (slip) subtract_outer(f, slip * c->law.mu * c->law.kn, along, c->normal);
  else subtract_outer(f, c->law.kt, along, c->tangent);
}

static void fill_A(stretch_flow *f, const contact_piece *const *piece)
{
  const size_t n = (size_t)f->n, ld = (size_t)f->moving;
  memset(f->A, 0, ld * ld * sizeof *f->A);
  for (size_t e = 0; e < n; ++e) {
    f->A[(n + e) * ld + e] = f->unit;
    for (size_t i = 0; i < n; ++i) {
      f->A[e * ld + n + i] = -f->by_K[e * n + i] / f->unit;
      f->A[(n + e) * ld + n + i] = -f->by_C[e * n + i];
    }
  }
  for (int j = 0; j < f->m->n_contacts; ++j)
    if (piece[j]) add_contact(f, j, piece[j]);
}

/* ---- its eigenvectors --------------------------------------------------------------------------------- */

/* W = V^-T. The norm of W times that of V bounds what rounding is multiplied by. */
static bool invert(stretch_flow *f, const double complex *V, double complex *lu, double complex *W)
{
  const double most = 1e8;
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
static void keep_halves(size_t ld, const double complex *lambda, const double complex *V, const double complex *W,
                        decomposition *d)
{
  d->n = 0;
  for (size_t k = 0; k < ld; ++k) {
    if (cimag(lambda[k]) < 0) continue;
    const double shares = cimag(lambda[k]) > 0 ? 2 : 1;
    double *v = d->V + (size_t)d->n * 2 * ld, *w = d->W + (size_t)d->n * 2 * ld;
    for (size_t i = 0; i < ld; ++i) {
      v[i] = shares * creal(V[k * ld + i]), v[ld + i] = shares * cimag(V[k * ld + i]);
      w[i] = creal(W[k * ld + i]), w[ld + i] = cimag(W[k * ld + i]);
    }
    d->lambda[d->n++] = lambda[k];
  }
}

static hc_status decompose(stretch_flow *f, const contact_piece *const *piece, decomposition *d)
{
  const size_t ld = (size_t)f->moving, contacts = (size_t)f->m->n_contacts;
  double complex *V = f->work, *lu = V + ld * ld, *W = lu + ld * ld, *lambda = W + ld * ld;
  forget(d);
  d->key = malloc(contacts + 1);
  d->lambda = malloc(ld * sizeof *d->lambda);
  d->V = malloc(2 * ld * ld * sizeof *d->V);
  d->W = malloc(2 * ld * ld * sizeof *d->W);
  if (!d->key || !d->lambda || !d->V || !d->W) {
    forget(d);
    return HC_NO_MEMORY;
  }
  memcpy(d->key, f->key, contacts);
  fill_A(f, piece);
  hc_status st = dense_eigen(f->moving, f->A, lambda, V);
  d->usable = st == HC_OK && invert(f, V, lu, W);
  if (d->usable) keep_halves(ld, lambda, V, W, d);
  return st == HC_NOT_CONVERGED ? HC_OK : st;
}

/* The one of the stretch, decomposed now or before. */
static hc_status find(stretch_flow *f, const contact_piece *const *piece, const decomposition **out)
{
  for (int j = 0; j < f->m->n_contacts; ++j) f->key[j] = (char)(piece[j] ? 1 + (int)piece[j]->state : 0);
  for (int k = 0; k < f->kept; ++k) {
    *out = &f->known[k];
    if (!memcmp(f->known[k].key, f->key, (size_t)f->m->n_contacts)) return HC_OK;
  }
  const int at = f->kept < MOST_STATES ? f->kept : f->oldest;
  hc_status st = decompose(f, piece, &f->known[at]);
  if (st != HC_OK && f->kept == MOST_STATES) f->kept = 0; /* a gap in the list: begin anew */
  if (st != HC_OK) return st;
  if (f->kept < MOST_STATES) ++f->kept;
  else f->oldest = (f->oldest + 1) % MOST_STATES;
  *out = &f->known[at];
  return HC_OK;
}

/* ---- a stretch ------------------------------------------------------------------------------------------ */

/* (e^(lambda t) - 1)/lambda. */
static double complex integral(double complex lambda, double t)
{
  const double complex z = lambda * t;
  if (cabs(z) > 0.1) return (cexp(z) - 1) / lambda;
  double complex sum = 1, term = 1;
  for (int k = 2; k < 14; ++k) sum += term *= z / k;
  return t * sum;
}

static bool is_stuck(const stretch_flow *f, const contact_piece *const *piece, int j)
{
  return piece[j] && !contact_slip_sign(piece[j]->state) && contact_has_friction(&f->m->contacts[j].law);
}

/* (0, M^-1 sum t_j dheld_j) of column q of phi into force[n]; false if it is 0. */
static bool pull_of(const stretch_flow *f, const contact_piece *const *piece, const double *phi, int q, double *force)
{
  bool any = false;
  memset(force, 0, (size_t)f->n * sizeof *force);
  for (int j = 0; j < f->m->n_contacts; ++j) {
    const double held = phi[(size_t)(f->moving + j) * (size_t)f->n_states + (size_t)q];
    if (held == 0 || !is_stuck(f, piece, j)) continue;
    for (int i = 0; i < f->n; ++i) force[i] += f->along[(size_t)j * (size_t)f->n + (size_t)i] * held / f->unit;
    any = true;
  }
  return any;
}

static double dot(size_t n, const double *restrict a, const double *restrict b)
{
  double sum[4] = {0};
  size_t i = 0;
  for (; i + 4 <= n; i += 4)
    for (size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
  for (; i < n; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Column q of phi: its (dx, dx') over the stretch, whose growth and sum are known. */
static void advance_column(stretch_flow *f, const decomposition *d, const contact_piece *const *piece, double *phi,
                           int q)
{
  const size_t n = (size_t)f->n, ld = (size_t)f->moving, states = (size_t)f->n_states;
  double *restrict moved = f->moved, *force = (double *)f->work, *column = phi + q;
  const bool pulled = pull_of(f, piece, phi, q, force);
  for (size_t i = 0; i < ld; ++i) f->x[i] = column[i * states] / (i >= n ? f->unit : 1);
  memset(moved, 0, ld * sizeof *moved);
  for (int k = 0; k < d->n; ++k) {
    const double *w = d->W + (size_t)k * 2 * ld, *restrict v = d->V + (size_t)k * 2 * ld;
    double complex y = (dot(ld, w, f->x) + I * dot(ld, w + ld, f->x)) * f->growth[k];
    if (pulled) y += (dot(n, w + n, force) + I * dot(n, w + ld + n, force)) * f->sum[k];
    const double re = creal(y), im = cimag(y);
    for (size_t i = 0; i < ld; ++i) moved[i] += v[i] * re - v[ld + i] * im;
  }
  for (size_t i = 0; i < ld; ++i) column[i * states] = moved[i] * (i >= n ? f->unit : 1);
}

static void advance_by_eigenvectors(stretch_flow *f, const decomposition *d, const contact_piece *const *piece,
                                    double duration, double *phi)
{
  for (int k = 0; k < d->n; ++k) {
    f->growth[k] = cexp(d->lambda[k] * duration);
    f->sum[k] = integral(d->lambda[k], duration);
  }
  for (int q = 0; q < f->n_states; ++q) advance_column(f, d, piece, phi, q);
}

/* By the exponential of A, augmented by the dheld, which are constant. */
static hc_status advance_by_exponential(stretch_flow *f, const contact_piece *const *piece, double duration,
                                        double *phi)
{
  const size_t n = (size_t)f->n, ld = (size_t)f->moving, states = (size_t)f->n_states;
  if (!f->augmented) f->augmented = gsl_matrix_alloc(states, states);
  if (!f->exponential) f->exponential = gsl_matrix_alloc(states, states);
  if (!f->augmented || !f->exponential) return HC_NO_MEMORY;
  fill_A(f, piece);
  gsl_matrix_set_zero(f->augmented);
  for (size_t e = 0; e < ld; ++e)
    for (size_t i = 0; i < ld; ++i) gsl_matrix_set(f->augmented, i, e, f->A[e * ld + i] * duration);
  for (int j = 0; j < f->m->n_contacts; ++j)
    for (size_t i = 0; i < n && is_stuck(f, piece, j); ++i)
      gsl_matrix_set(f->augmented, n + i, ld + (size_t)j, f->along[(size_t)j * n + i] / f->unit * duration);
  if (gsl_linalg_exponential_ss(f->augmented, f->exponential, GSL_PREC_DOUBLE) != GSL_SUCCESS) return HC_NOT_FINITE;
  for (size_t q = 0; q < states; ++q) {
    for (size_t i = 0; i < ld; ++i) {
      double sum = 0;
      for (size_t k = 0; k < states; ++k)
        sum += gsl_matrix_get(f->exponential, i, k) * phi[k * states + q] / (k >= n && k < ld ? f->unit : 1);
      f->moved[i] = sum;
    }
    for (size_t i = 0; i < ld; ++i) phi[i * states + q] = f->moved[i] * (i >= n ? f->unit : 1);
  }
  return HC_OK;
}

hc_status stretch_flow_advance(stretch_flow *f, const contact_piece *const *piece, double duration, double *phi)
{
  const decomposition *d;
  hc_status st = find(f, piece, &d);
  if (st == HC_OK && !d->usable) st = advance_by_exponential(f, piece, duration, phi);
  else if (st == HC_OK) advance_by_eigenvectors(f, d, piece, duration, phi);
  if (st == HC_OK && !isfinite(phi[0])) st = HC_NOT_FINITE;
  return st;
}
