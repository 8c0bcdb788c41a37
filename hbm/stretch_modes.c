/* stretch_modes.c - the combinations of contact states of stretch_flow.h: A of each, and its eigenvectors, kept. A is
 * made for velocities divided by a frequency of the structure's, so that both halves of a state are of one size. */
#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/stretch_flow_impl.h"
#include "numerics/dense.h"

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

void stretch_fill_A(stretch_flow *f, const contact_piece *const *piece)
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

/* W = V^-T. The norm of W times that of V bounds what rounding is multiplied by, at every stretch anew. */
static bool invert(stretch_flow *f, const double complex *V, double complex *lu, double complex *W)
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
static void keep_halves(const stretch_flow *f, const double complex *lambda, const double complex *V,
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

void stretch_forget(decomposition *d)
{
  free(d->key);
  free(d->lambda);
  free(d->V);
  free(d->W);
  *d = (decomposition){0};
}

static hc_status decompose(stretch_flow *f, const contact_piece *const *piece, decomposition *d)
{
  const size_t ld = (size_t)f->moving, contacts = (size_t)f->m->n_contacts;
  double complex *V = f->work, *lu = V + ld * ld, *W = lu + ld * ld, *lambda = W + ld * ld;
  stretch_forget(d);
  d->key = malloc(contacts + 1);
  d->lambda = malloc(ld * sizeof *d->lambda);
  d->V = malloc(2 * ld * ld * sizeof *d->V);
  d->W = malloc(2 * ld * ld * sizeof *d->W);
  if (!d->key || !d->lambda || !d->V || !d->W) {
    stretch_forget(d);
    return HC_NO_MEMORY;
  }
  memcpy(d->key, f->key, contacts);
  stretch_fill_A(f, piece);
  hc_status st = dense_eigen(f->moving, f->A, lambda, V);
  d->usable = st == HC_OK && invert(f, V, lu, W);
  if (d->usable) keep_halves(f, lambda, V, W, d);
  return st == HC_NOT_CONVERGED ? HC_OK : st;
}

hc_status stretch_find(stretch_flow *f, const contact_piece *const *piece, const decomposition **out)
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
