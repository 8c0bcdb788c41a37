/* receptance.c - see receptance.h. With the modes phi of the reduced structure, phi^T M phi = 1, and the diagonal c of
 * phi^T C phi, the receptance from unit directions p to the kept rows is
 *     G = sum_k phi_k phi_k^T p / (omega_k^2 - omega^2 + i omega c_k),    H = p^T G,    dH = -G^T R G. */
#include "model/reduce/receptance.h"

#include <complex.h>
#include <string.h>

#include "model/modes.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

enum { HARMONICS = 3, SPREAD = 11 /* frequencies of each */ };

typedef struct frequency {
  double omega, weight;
  bool stuck;
} frequency;

struct receptance {
  const craig_bampton *cb;
  int n, n_kept, n_directions, n_frequencies;
  double *p;                     /* [n_directions][n] */
  double *omega2[2], *c[2];      /* [n] contacts apart, stuck */
  double *to_kept[2], *p_phi[2]; /* [n][n_kept] phi's kept rows; [n_directions][n] phi^T p */
  frequency *at;
  double *R, *G, *RG, *H, *half; /* [n_kept][n_kept], [2][n_directions][n_kept] twice, [4][n_directions]^2, [n_d][n] */
  workspace memory;
};

/* ---- directions and frequencies ---- */

static void add_direction(receptance *r, const double *direction)
{
  const size_t n = (size_t)r->n;
  const double length = norm_2(r->n, direction);
  double *to = r->p + n * (size_t)r->n_directions;
  if (length == 0) return;
  for (size_t i = 0; i < n; ++i) to[i] = direction[i] / length;
  ++r->n_directions;
}

static void find_directions(receptance *r, const model *m)
{
  const size_t n = (size_t)r->n;
  for (int j = 0; j < m->n_contacts; ++j) {
    add_direction(r, m->contacts[j].tangent);
    if (m->contacts[j].pair != CONTACT_SECOND) add_direction(r, m->contacts[j].normal);
  }
  for (int l = 0; l < m->n_loads; ++l) {
    add_direction(r, m->loads[l].cosine);
    if (m->loads[l].harmonic > 0) add_direction(r, m->loads[l].sine);
  }
  for (int i = 0; i < m->n_responses; ++i) add_direction(r, m->responses + n * (size_t)i);
}

/* Modes with the contacts stuck are damped by half the least ratio of those apart, at least: of a body that contacts
 * alone hold they have next to none, and are never met, since contacts that resonate slip. */
static void damp_stuck_modes(receptance *r, double low)
{
  double least = INFINITY;
  for (int k = 0; k < r->n; ++k) {
    const double omega = sqrt(fmax(r->omega2[0][k], 0));
    if (omega >= low) least = fmin(least, r->c[0][k] / (2 * omega));
  }
  for (int k = 0; k < r->n && isfinite(least); ++k)
    r->c[1][k] = fmax(r->c[1][k], least * sqrt(fmax(r->omega2[1][k], 0)));
}

/* Those of the sweep times h, both states. */
static void find_frequencies(receptance *r, const scene *sc)
{
  const double low = fmin(sc->omega_from, sc->omega_to), high = fmax(sc->omega_from, sc->omega_to);
  damp_stuck_modes(r, low);
  for (int h = 1; h <= HARMONICS; ++h)
    for (int state = 0; state < 2; ++state) {
      const double weight = 1.0 / (h * h);
      for (int i = 0; i < SPREAD; ++i)
        r->at[r->n_frequencies++] = (frequency){h * (low + (high - low) * i / (SPREAD - 1)), weight, state};
      for (int k = 0; k < r->n; ++k) {
        const double omega = sqrt(fmax(r->omega2[state][k], 0));
        if (omega >= h * low && omega <= h * high && r->c[state][k] > 0)
          r->at[r->n_frequencies++] = (frequency){omega, weight, state};
      }
    }
}

/* ---- making ---- */

static hc_status find_modes(receptance *r, const model *m, bool stuck)
{
  const int n = r->n;
  const size_t rows = (size_t)n;
  double *phi = malloc(2 * rows * rows * sizeof *phi), *C_phi = phi ? phi + rows * rows : NULL;
  hc_status st = phi ? model_modes(m, stuck, r->omega2[stuck], phi) : HC_NO_MEMORY;
  if (st == HC_OK) {
    dense_multiply(n, n, n, m->damping, phi, C_phi);
    for (size_t k = 0; k < rows; ++k) {
      r->c[stuck][k] = 0;
      for (size_t i = 0; i < rows; ++i) r->c[stuck][k] += phi[i + rows * k] * C_phi[i + rows * k];
      memcpy(r->to_kept[stuck] + (size_t)r->n_kept * k, phi + rows * k, (size_t)r->n_kept * sizeof *phi);
    }
    dense_transpose(n, n, phi, C_phi);
    dense_multiply(n, r->n_directions, n, C_phi, r->p, r->p_phi[stuck]);
  }
  free(phi);
  return st;
}

hc_status receptance_new(const craig_bampton *cb, const scene *sc, receptance **out)
{
  scene_structure *small = NULL;
  model *m = NULL;
  receptance *r = *out = calloc(1, sizeof *r);
  if (!r) return HC_NO_MEMORY;
  hc_status st = craig_bampton_structure(cb, sc->structure, cb->n_modes, &small);
  if (st == HC_OK) st = structure_model(small, &m);
  if (st == HC_OK) {
    r->cb = cb, r->n = m->n, r->n_kept = cb->n_kept;
    const size_t n = (size_t)r->n, b = (size_t)r->n_kept;
    const size_t most = 2 * (size_t)m->n_contacts + 2 * (size_t)m->n_loads + (size_t)m->n_responses;
    workspace *w = &r->memory;
    r->p = workspace_doubles(w, most * n);
    r->at = workspace_array(w, 2 * HARMONICS * (SPREAD + n), sizeof *r->at);
    for (int state = 0; state < 2; ++state) {
      r->omega2[state] = workspace_doubles(w, n);
      r->c[state] = workspace_doubles(w, n);
      r->to_kept[state] = workspace_doubles(w, n * b);
      r->p_phi[state] = workspace_doubles(w, most * n);
    }
    r->R = workspace_doubles(w, b * b);
    r->G = workspace_doubles(w, 2 * b * most);
    r->RG = workspace_doubles(w, 2 * b * most);
    r->H = workspace_doubles(w, 4 * most * most);
    r->half = workspace_doubles(w, most * n);
    st = w->failed ? HC_NO_MEMORY : HC_OK;
    if (st == HC_OK) find_directions(r, m);
    for (int state = 0; state < 2 && st == HC_OK; ++state) st = find_modes(r, m, state);
    if (st == HC_OK) find_frequencies(r, sc);
  }
  model_free(m);
  structure_free(small);
  if (st == HC_OK) return HC_OK;
  receptance_free(r);
  *out = NULL;
  return st;
}

void receptance_free(receptance *r)
{
  if (!r) return;
  workspace_free(&r->memory);
  free(r);
}

/* ---- comparing ---- */

/* Real and imaginary part of G. */
static void answer(receptance *r, double omega, bool stuck)
{
  const size_t n = (size_t)r->n, d = (size_t)r->n_directions;
  for (int part = 0; part < 2; ++part) {
    for (size_t j = 0; j < d; ++j)
      for (size_t k = 0; k < n; ++k) {
        const double complex h = 1 / (r->omega2[stuck][k] - omega * omega + I * omega * r->c[stuck][k]);
        r->half[k + n * j] = (part == 0 ? creal(h) : cimag(h)) * r->p_phi[stuck][k + n * j];
      }
    dense_multiply(r->n_kept, r->n_directions, r->n, r->to_kept[stuck], r->half,
                   r->G + (size_t)part * (size_t)r->n_kept * d);
  }
}

/* |dH|/|H| at omega. */
static double relative(receptance *r, int modes, double omega, bool stuck)
{
  const int b = r->n_kept, d = r->n_directions;
  const size_t G = (size_t)b * (size_t)d, H = (size_t)d * (size_t)d;
  if (!craig_bampton_rest(r->cb, modes, omega, r->R)) return 1;
  answer(r, omega, stuck);
  double *turned = r->half; /* G^T, then p^T, of the kept rows, which are all that p has */
  for (int part = 0; part < 2; ++part) dense_multiply(b, d, b, r->R, r->G + (size_t)part * G, r->RG + (size_t)part * G);
  for (int part = 0; part < 2; ++part) { /* (Gr + i Gi)^T R (Gr + i Gi) */
    dense_transpose(b, d, r->G + (size_t)part * G, turned);
    dense_add_product(d, d, b, part == 0 ? 1 : -1, turned, d, r->RG + (size_t)part * G, b, part, r->H, d);
    dense_add_product(d, d, b, 1, turned, d, r->RG + (size_t)(1 - part) * G, b, part, r->H + H, d);
  }
  for (int j = 0; j < d; ++j)
    for (int i = 0; i < b; ++i) turned[j + (size_t)d * (size_t)i] = r->p[(size_t)i + (size_t)r->n * (size_t)j];
  for (int part = 0; part < 2; ++part)
    dense_multiply(d, d, b, turned, r->G + (size_t)part * G, r->H + (size_t)(2 + part) * H);
  return norm_2(2 * d * d, r->H) / norm_2(2 * d * d, r->H + 2 * H);
}

receptance_error receptance_compare(receptance *r, int modes, const receptance_error *at)
{
  receptance_error most = {0, 0, false};
  for (int i = 0; i < r->n_frequencies; ++i) {
    const frequency *f = &r->at[i];
    if (at && (f->omega != at->omega || f->stuck != at->stuck)) continue;
    const double error = fmin(relative(r, modes, f->omega, f->stuck) * f->weight, 1);
    if (!(error <= most.error)) most = (receptance_error){error, f->omega, f->stuck};
  }
  return most;
}
