/* system.c - see system.h for the equations. The contact force comes from aft.c or exact_force.c; what follows is the
 * same for both. */
#include "hbm/system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/series.h"

hc_status hbm_system_init(hbm_system *sys, const model *m, const hbm_settings *how, int n_harm, int n_time)
{
  *sys = (hbm_system){.model = m, .how = *how, .n_harm = n_harm, .n_coef = series_length(n_harm), .force_factor = 1};
  sys->first = how->keep_mean ? 0 : 1;
  sys->n = sys->n_coef - sys->first;
  size_t n = (size_t)sys->n_coef;
  sys->X = calloc(n, sizeof(double));
  sys->F = calloc(n, sizeof(double));
  sys->dF = calloc(n * n, sizeof(double));
  sys->rows = calloc(n, sizeof(double));
  if (!sys->X || !sys->F || !sys->dF || !sys->rows) return HC_NO_MEMORY;
  if (how->force == HBM_FORCE_SAMPLED) return aft_new(m, how->restart, n_harm, n_time, &sys->sampled);
  return exact_force_new_of_model(n_harm, m, &sys->located);
}

void hbm_system_clear(hbm_system *sys)
{
  aft_free(sys->sampled);
  exact_force_free(sys->located);
  free(sys->X);
  free(sys->F);
  free(sys->dF);
  free(sys->rows);
  *sys = (hbm_system){0};
}

hc_status hbm_system_contact(hbm_system *sys, const double *X)
{
  size_t bytes = (size_t)sys->n_coef * sizeof(double);
  if (sys->evaluated && memcmp(X, sys->X, bytes) == 0) return HC_OK;
  sys->evaluated = false;
  ++sys->evaluations;
  hc_status st = sys->sampled ? aft_eval(sys->sampled, X, sys->F, NULL, &sys->report)
                              : exact_force_eval(sys->located, X, sys->F, sys->dF, &sys->report);
  if (st != HC_OK) return st;
  sys->differentiated = !sys->sampled;
  memcpy(sys->X, X, bytes);
  sys->evaluated = true;
  return HC_OK;
}

static double damping(const hbm_system *sys) { return sys->model->damping + sys->more_damping; }

/* What a coefficient of an even harmonic is multiplied by where those are to be zero [force/length]. */
static double dropped(const model *m, double omega) { return m->stiffness + m->mass * omega * omega; }

static void make_mistakes(const hbm_system *sys, double omega, const double *X, double *full)
{
  const hbm_mistakes *wrong = &sys->how.mistakes;
  full[0] += wrong->mean_error * sys->F[0];
  if (!wrong->odd_only) return;
  for (int h = 0; h <= sys->n_harm; h += 2)
    for (int i = h ? 2 * h - 1 : 0; i <= 2 * h; ++i) full[i] = dropped(sys->model, omega) * X[i];
}

hc_status hbm_system_residual(hbm_system *sys, double omega, const double *X, double *R)
{
  hc_status st = hbm_system_contact(sys, X);
  if (st != HC_OK) return st;
  const model *m = sys->model;
  double *full = sys->rows;
  full[0] = m->stiffness * X[0] + sys->F[0];
  for (int h = 1; h <= sys->n_harm; ++h) {
    double k = m->stiffness - m->mass * h * h * omega * omega, c = damping(sys) * h * omega;
    double a = X[2 * h - 1], b = X[2 * h];
    full[2 * h - 1] = k * a + c * b + sys->F[2 * h - 1];
    full[2 * h] = k * b - c * a + sys->F[2 * h];
  }
  full[1] -= sys->force_factor * m->force;
  make_mistakes(sys, omega, X, full);
  memcpy(R, full + sys->first, (size_t)sys->n * sizeof(double));
  double sum = 0;
  for (int i = 0; i < sys->n; ++i) sum += R[i];
  return isfinite(sum) ? HC_OK : HC_NOT_FINITE;
}

/* jac is whole but for the mistakes. */
static void differentiate_mistakes(const hbm_system *sys, double omega, int ld, double *jac)
{
  const hbm_mistakes *wrong = &sys->how.mistakes;
  for (int col = 0; sys->first == 0 && wrong->mean_error != 0 && col < sys->n; ++col)
    jac[(size_t)ld * col] += wrong->mean_error * sys->dF[(size_t)sys->n_coef * col];
  for (int h = 0; wrong->odd_only && h <= sys->n_harm; h += 2)
    for (int i = h ? 2 * h - 1 : 0; i <= 2 * h; ++i) {
      const int row = i - sys->first;
      for (int col = 0; row >= 0 && col < sys->n; ++col)
        jac[row + (size_t)ld * col] = col == row ? dropped(sys->model, omega) : 0;
    }
}

void hbm_system_jacobian(hbm_system *sys, double omega, int ld, double *jac)
{
  const model *m = sys->model;
  if (!sys->differentiated) aft_jacobian(sys->sampled, sys->dF);
  sys->differentiated = true;
  for (int col = 0; col < sys->n; ++col) {
    const double *from = sys->dF + (size_t)sys->n_coef * (col + sys->first) + sys->first;
    double *to = jac + (size_t)ld * col;
    for (int row = 0; row < sys->n; ++row) to[row] = from[row];
  }
  if (sys->first == 0) jac[0] += m->stiffness;
  for (int h = 1; h <= sys->n_harm; ++h) {
    double k = m->stiffness - m->mass * h * h * omega * omega, c = damping(sys) * h * omega;
    size_t a = (size_t)(2 * h - 1 - sys->first), b = a + 1, n = (size_t)ld;
    jac[a + n * a] += k;
    jac[b + n * b] += k;
    jac[a + n * b] += c;
    jac[b + n * a] -= c;
  }
  differentiate_mistakes(sys, omega, ld, jac);
}

void hbm_system_domega(hbm_system *sys, double omega, const double *X, double *dR)
{
  const model *m = sys->model;
  double *full = sys->rows;
  full[0] = 0;
  for (int h = 1; h <= sys->n_harm; ++h) {
    double dk = -2 * m->mass * h * h * omega, dc = damping(sys) * h;
    full[2 * h - 1] = dk * X[2 * h - 1] + dc * X[2 * h];
    full[2 * h] = dk * X[2 * h] - dc * X[2 * h - 1];
  }
  for (int h = 2; sys->how.mistakes.odd_only && h <= sys->n_harm; h += 2)
    for (int i = 2 * h - 1; i <= 2 * h; ++i) full[i] = 2 * m->mass * omega * X[i];
  memcpy(dR, full + sys->first, (size_t)sys->n * sizeof(double));
}

double hbm_system_scale(const hbm_system *sys, double omega)
{
  const model *m = sys->model;
  double sum = fabs(m->stiffness * sys->X[0]), force = fabs(sys->F[0]);
  for (int h = 1; h <= sys->n_harm; ++h) {
    double z = m->stiffness + m->mass * h * h * omega * omega + damping(sys) * h * omega;
    sum += z * hypot(sys->X[2 * h - 1], sys->X[2 * h]);
    force += hypot(sys->F[2 * h - 1], sys->F[2 * h]);
  }
  return sum + force + sys->force_factor * m->force;
}
