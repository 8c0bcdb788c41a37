/* system.c - see system.h for the equations. */
#include "hbm/solver/system.h"

#include <string.h>

#include "numerics/norm.h"

hc_status hbm_system_init(hbm_system *sys, const model *m, const hbm_settings *how, int n_harm, int n_time,
                          metric *shared)
{
  *sys = (hbm_system){.model = m, .how = *how, .n_harm = n_harm, .force_factor = 1};
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || model_highest_load(m) > n_harm) return HC_BAD_INPUT;
  hc_status st = model_find_scales(m, &sys->scales);
  if (st == HC_OK) st = condensation_new(m, n_harm, &sys->linear);
  sys->metric = metric_share(shared);
  if (st == HC_OK && !shared) st = metric_new(m, sys->linear, &sys->metric);
  if (st != HC_OK) return st;
  if (how->plug_in && how->plug_in->damping) condensation_damp(sys->linear, how->plug_in->damping);
  sys->dim = condensation_dim(sys->linear);
  sys->n_coef = hbm_system_length(sys, n_harm);
  sys->first = how->keep_mean ? 0 : sys->dim;
  sys->n = sys->n_coef - sys->first;
  const size_t n = (size_t)sys->n_coef, dim = (size_t)sys->dim;
  workspace *w = &sys->memory;
  sys->X = workspace_doubles(w, n);
  sys->F = workspace_doubles(w, n);
  sys->rows = workspace_doubles(w, n);
  sys->all = workspace_doubles(w, dim);
  sys->moved = workspace_doubles(w, dim);
  sys->amplitudes = workspace_array(w, 2 * dim, sizeof *sys->amplitudes);
  sys->stuck = workspace_array(w, (size_t)sys->model->n_contacts, sizeof *sys->stuck);
  sys->stiffness = workspace_doubles(w, dim * dim);
  sys->A = workspace_array(w, dim * dim, sizeof *sys->A);
  sys->z = workspace_array(w, dim, sizeof *sys->z);
  sys->pivot = workspace_array(w, dim, sizeof *sys->pivot);
  if (sys->memory.failed) return HC_NO_MEMORY;
  const evaluator_settings by = {n_harm, n_time, {.restart = how->restart}, how->plug_in};
  return contact_forces_new(m, sys->linear, how->force, &by, &sys->contacts);
}

void hbm_system_clear(hbm_system *sys)
{
  condensation_free(sys->linear);
  metric_free(sys->metric);
  contact_forces_free(sys->contacts);
  workspace_free(&sys->memory);
  *sys = (hbm_system){0};
}

hc_status hbm_system_contact(hbm_system *sys, const double *X, bool derive)
{
  size_t bytes = (size_t)sys->n_coef * sizeof(double);
  if (sys->evaluated && (sys->derived || !derive) && memcmp(X, sys->X, bytes) == 0) return HC_OK;
  sys->evaluated = false;
  ++sys->evaluations;
  hc_status st = contact_forces_eval(sys->contacts, X, sys->F, derive, &sys->report);
  if (st != HC_OK) return st;
  memcpy(sys->X, X, bytes);
  sys->evaluated = true;
  sys->derived = derive;
  return HC_OK;
}

void hbm_system_response(const hbm_system *sys, int n_harm, const double *X, double *x)
{
  const double *row = condensation_first_response(sys->linear);
  for (int c = 0; c < series_length(n_harm); ++c) {
    x[c] = 0;
    for (int d = 0; d < sys->dim; ++d) x[c] += row[d] * X[(size_t)c * (size_t)sys->dim + (size_t)d];
  }
}

hc_status hbm_system_any_response(hbm_system *sys, double omega, const double *X, int r, double *x)
{
  const int dim = sys->dim;
  hc_status st = condensation_at(sys->linear, omega, 0);
  for (int h = 0; h <= sys->n_harm && st == HC_OK; ++h) {
    const double *a = X + (h ? (2 * h - 1) * dim : 0), *b = a + dim;
    double complex z;
    condensation_response(sys->linear, h, r, 1, sys->amplitudes, &z);
    for (int d = 0; d < dim; ++d) z += sys->amplitudes[d] * (h ? a[d] - I * b[d] : a[d]);
    x[h ? 2 * h - 1 : 0] = creal(z);
    if (h) x[2 * h] = -cimag(z);
  }
  if (!sys->how.keep_mean) x[0] = 0;
  return st;
}

/* Where the cosines and the sines of harmonic h begin in X; of harmonic 0, the means. */
static size_t cosines(const hbm_system *sys, int h) { return (size_t)sys->dim * (size_t)(h ? 2 * h - 1 : 0); }
static size_t sines(const hbm_system *sys, int h) { return (size_t)sys->dim * (size_t)(2 * h); }

/* rows += S X; apart for dim = 1, whose loops fall away. */
static inline void add_forces(const hbm_system *sys, int dim, const double *restrict X, double *restrict rows)
{
  const double complex *S = condensation_stiffness(sys->linear, 0);
  for (int e = 0; e < dim; ++e)
    for (int d = 0; d < dim; ++d) rows[d] += creal(*S++) * X[e];
  const double *a = X + dim, *b = a + dim;
  double *of_a = rows + dim, *of_b = of_a + dim;
  for (int h = 1; h <= sys->n_harm; ++h, a += 2 * dim, b += 2 * dim, of_a += 2 * dim, of_b += 2 * dim)
    for (int e = 0; e < dim; ++e)
      for (int d = 0; d < dim; ++d, ++S) {
        const double re = creal(*S), im = cimag(*S);
        of_a[d] += re * a[e] + im * b[e];
        of_b[d] += re * b[e] - im * a[e];
      }
}

static void add_linear_forces(const hbm_system *sys, const double *X, double *rows)
{
  if (sys->dim == 1) add_forces(sys, 1, X, rows);
  else add_forces(sys, sys->dim, X, rows);
}

/* rows of harmonic h -= factor p, a complex amplitude a - i b. */
static void subtract_load(hbm_system *sys, const double complex *p, int h, double factor)
{
  for (int d = 0; d < sys->dim; ++d) {
    sys->rows[cosines(sys, h) + (size_t)d] -= factor * creal(p[d]);
    if (h) sys->rows[sines(sys, h) + (size_t)d] += factor * cimag(p[d]);
  }
}

static hc_status drop_means(const hbm_system *sys, double *R)
{
  memcpy(R, sys->rows + sys->first, (size_t)sys->n * sizeof(double));
  double sum = 0;
  for (int i = 0; i < sys->n; ++i) sum += R[i];
  return isfinite(sum) ? HC_OK : HC_NOT_FINITE;
}

void hbm_system_at(hbm_system *sys, double omega)
{
  if (omega == sys->omega) return;
  sys->omega = omega;
  if (contact_forces_at(sys->contacts, omega)) sys->evaluated = false;
}

hc_status hbm_system_residual(hbm_system *sys, double omega, const double *X, double *R)
{
  hbm_system_at(sys, omega);
  hc_status st = hbm_system_contact(sys, X, true);
  if (st == HC_OK) st = condensation_at(sys->linear, omega, sys->more_damping);
  if (st != HC_OK) return st;
  memset(sys->rows, 0, (size_t)sys->n_coef * sizeof(double));
  add_linear_forces(sys, X, sys->rows);
  for (int i = 0; i < sys->n_coef; ++i) sys->rows[i] += sys->F[i];
  for (int l = 0; l < sys->model->n_loads; ++l)
    subtract_load(sys, condensation_load(sys->linear, l), sys->model->loads[l].harmonic, sys->force_factor);
  return drop_means(sys, R);
}

void hbm_system_linear(hbm_system *sys, const double *X, bool turned, double *rows)
{
  memset(sys->rows, 0, (size_t)sys->n_coef * sizeof(double));
  add_linear_forces(sys, X, sys->rows);
  for (int h = 0; h <= sys->n_harm && turned; ++h)
    for (int d = 0; d < sys->dim; ++d) { /* i (a - i b) = b - i (-a) */
      double *a = &sys->rows[cosines(sys, h) + (size_t)d], *b = h > 0 ? &sys->rows[sines(sys, h) + (size_t)d] : NULL;
      const double was = *a;
      *a = b ? *b : 0;
      if (b) *b = -was;
    }
  drop_means(sys, rows);
}

/* jac += S. */
static void add_linear_stiffness(const hbm_system *sys, int ld, double *jac)
{
  const size_t dim = (size_t)sys->dim, n = (size_t)ld;
  const double complex *S = condensation_stiffness(sys->linear, 0);
  for (size_t e = 0; e < dim; ++e)
    for (size_t d = 0; d < dim; ++d, ++S)
      if (sys->first == 0) jac[d + n * e] += creal(*S);
  for (int h = 1; h <= sys->n_harm; ++h) {
    const size_t a = cosines(sys, h) - (size_t)sys->first, b = a + dim;
    for (size_t e = 0; e < dim; ++e)
      for (size_t d = 0; d < dim; ++d, ++S) {
        const double re = creal(*S), im = cimag(*S);
        jac[a + d + n * (a + e)] += re;
        jac[b + d + n * (b + e)] += re;
        jac[a + d + n * (b + e)] += im;
        jac[b + d + n * (a + e)] -= im;
      }
  }
}

void hbm_system_jacobian(hbm_system *sys, double omega, int ld, double *jac)
{
  const double *dF = contact_forces_jacobian(sys->contacts);
  for (int col = 0; col < sys->n; ++col) {
    const double *from = dF + (size_t)sys->n_coef * (size_t)(col + sys->first) + sys->first;
    double *to = jac + (size_t)ld * (size_t)col;
    for (int row = 0; row < sys->n; ++row) to[row] = from[row]; /* few: a call would take longer */
  }
  if (condensation_at(sys->linear, omega, sys->more_damping) != HC_OK) return; /* it was, in the residual */
  add_linear_stiffness(sys, ld, jac);
}

/* Harmonic h of X as complex amplitudes. */
static void amplitudes(const hbm_system *sys, int h, const double *X, double complex *a)
{
  const double *cosine = X + cosines(sys, h), *sine = X + sines(sys, h);
  for (int d = 0; d < sys->dim; ++d) a[d] = h ? cosine[d] - I * sine[d] : cosine[d];
}

static void differentiate(hbm_system *sys, condensation_change (*by)(const condensation *, int), const double *X,
                          double *dR)
{
  double complex *a = sys->amplitudes, *dS_a = a + sys->dim;
  for (int h = 0; h <= sys->n_harm; ++h) {
    amplitudes(sys, h, X, a);
    condensation_stiffness_change(sys->linear, h, by(sys->linear, h), a, dS_a);
    double *of_a = sys->rows + cosines(sys, h), *of_b = sys->rows + sines(sys, h);
    for (int d = 0; d < sys->dim; ++d) {
      if (h) of_b[d] = -cimag(dS_a[d]);
      of_a[d] = creal(dS_a[d]);
    }
  }
  for (int l = 0; l < sys->model->n_loads; ++l) {
    const int h = sys->model->loads[l].harmonic;
    condensation_load_change(sys->linear, l, by(sys->linear, h), a);
    subtract_load(sys, a, h, sys->force_factor);
  }
  if (by == condensation_by_omega) contact_forces_add_by_omega(sys->contacts, sys->rows);
  drop_means(sys, dR);
}

void hbm_system_domega(hbm_system *sys, double omega, const double *X, double *dR)
{
  if (condensation_at(sys->linear, omega, sys->more_damping) == HC_OK) differentiate(sys, condensation_by_omega, X, dR);
}

void hbm_system_ddamping(hbm_system *sys, double omega, const double *X, double *dR)
{
  if (condensation_at(sys->linear, omega, sys->more_damping) == HC_OK)
    differentiate(sys, condensation_by_damping, X, dR);
}

void hbm_system_dforce(hbm_system *sys, double omega, double *dR)
{
  memset(sys->rows, 0, (size_t)sys->n_coef * sizeof(double));
  for (int l = 0; l < sys->model->n_loads && condensation_at(sys->linear, omega, sys->more_damping) == HC_OK; ++l)
    subtract_load(sys, condensation_load(sys->linear, l), sys->model->loads[l].harmonic, 1);
  drop_means(sys, dR);
}

/* The static load condensed on coordinate d [force]. */
static double static_load(const hbm_system *sys, int d)
{
  for (int l = 0; l < sys->model->n_loads; ++l)
    if (sys->model->loads[l].harmonic == 0) return sys->force_factor * creal(condensation_load(sys->linear, l)[d]);
  return 0;
}

void hbm_system_sizes(const hbm_system *sys, double omega, double *all, double *moved)
{
  const bool known = condensation_at(sys->linear, omega, sys->more_damping) == HC_OK;
  const int dim = sys->dim;
  const double *rest = metric_rest(sys->metric);
  for (int d = 0; d < dim; ++d) all[d] = moved[d] = known ? 0 : NAN;
  for (int h = 1; h <= sys->n_harm && known; ++h) {
    const double *size = condensation_sizes(sys->linear, h), *a = sys->X + cosines(sys, h), *b = sys->X + sines(sys, h),
                 *fa = sys->F + cosines(sys, h), *fb = sys->F + sines(sys, h);
    for (int e = 0; e < dim; ++e) {
      const double x = hypot(a[e], b[e]);
      for (int d = 0; d < dim; ++d) moved[d] += size[(size_t)e * (size_t)dim + (size_t)d] * x;
      moved[e] += hypot(fa[e], fb[e]);
    }
  }
  for (int l = 0; l < sys->model->n_loads && known; ++l)
    for (int d = 0; d < dim && sys->model->loads[l].harmonic > 0; ++d)
      moved[d] += sys->force_factor * cabs(condensation_load(sys->linear, l)[d]);
  for (int d = 0; d < dim; ++d) all[d] = moved[d];
  if (!known) return;
  /* The contacts' force at rest is what the static load leaves beside K rest. */
  const double *size = condensation_sizes(sys->linear, 0);
  const double complex *S = condensation_stiffness(sys->linear, 0);
  for (int d = 0; d < dim; ++d) {
    double at_rest = static_load(sys, d);
    all[d] += fabs(sys->F[d]) + fabs(at_rest);
    for (int e = 0; e < dim; ++e) {
      const size_t at = (size_t)e * (size_t)dim + (size_t)d;
      at_rest -= creal(S[at]) * rest[e];
      all[d] += size[at] * fabs(sys->X[e]);
      moved[d] += size[at] * fabs(sys->X[e] - rest[e]);
    }
    moved[d] += fabs(sys->F[d] - at_rest);
  }
}

bool hbm_system_knows_means(const hbm_system *sys)
{
  const double two_digits = 1e-2, *unknown = condensation_rounding(sys->linear);
  const model *m = sys->model;
  double sum = 0, load = 0;
  for (int d = 0; d < sys->dim; ++d) sum += unknown[d] * fabs(sys->X[d]);
  for (int l = 0; l < m->n_loads; ++l)
    load += model_load_factor(m->loads[l].inertial, sys->omega) *
            (norm_2(m->n, m->loads[l].cosine) + norm_2(m->n, m->loads[l].sine));
  return load == 0 || sum <= two_digits * load;
}

void hbm_system_weights(hbm_system *sys, double omega, double least, double *weight)
{
  double sum = 0;
  hbm_system_sizes(sys, omega, sys->all, sys->moved);
  for (int d = 0; d < sys->dim; ++d) sum += sys->all[d];
  for (int d = 0; d < sys->dim; ++d) {
    const double size = larger(sys->moved[d], least * sum);
    sys->moved[d] = size == 0 ? 1 : 1 / size;
  }
  for (int i = 0; i < sys->n; ++i) weight[i] = sys->moved[i % sys->dim];
}
