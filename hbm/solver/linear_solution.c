/* linear_solution.c - see linear_solution.h. */
#include "hbm/solver/linear_solution.h"

#include <string.h>

#include "hbm/solver/hbm_solver_impl.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

static void add_stuck_stiffness(const hbm_system *sys)
{
  memset(sys->stiffness, 0, (size_t)sys->dim * (size_t)sys->dim * sizeof *sys->stiffness);
  for (int j = 0; j < sys->model->n_contacts; ++j) {
    const contact *law = &sys->model->contacts[j].law;
    if (!sys->stuck[j]) continue;
    const double *t = condensation_tangent(sys->linear, j), *n = condensation_normal(sys->linear, j);
    if (contact_has_friction(law)) add_outer(sys->dim, law->kt, t, t, sys->stiffness);
    add_outer(sys->dim, law->kn, n, n, sys->stiffness);
  }
}

/* S_h + K', factored. */
static hc_status factor(const hbm_system *sys, int h)
{
  const double complex *S = condensation_stiffness(sys->linear, h);
  for (int i = 0; i < sys->dim * sys->dim; ++i) sys->A[i] = S[i] + sys->stiffness[i];
  return dense_factor_complex(sys->dim, sys->A, sys->pivot);
}

static const double complex *load_of(const hbm_system *sys, int h)
{
  for (int l = 0; l < sys->model->n_loads; ++l)
    if (sys->model->loads[l].harmonic == h) return condensation_load(sys->linear, l);
  return NULL;
}

static void put_amplitude(const hbm_system *sys, int h, const double complex *z, double *X)
{
  const int dim = sys->dim;
  double *a = X + (h ? (2 * h - 1) * dim : 0);
  for (int d = 0; d < dim; ++d) {
    a[d] = creal(z[d]);
    if (h) a[dim + d] = -cimag(z[d]);
  }
}

/* The mean q_0 in sys->z for the contacts as sys->stuck has them. What a contact's force has beside its stiffness is on
 * the right: N - N0 is kn (v + gap) in contact with gap < 0, and -kn gap apart with gap > 0. */
static hc_status solve_static(const hbm_system *sys)
{
  const double complex *p = load_of(sys, 0);
  add_stuck_stiffness(sys);
  hc_status st = factor(sys, 0);
  if (st != HC_OK) return st;
  for (int d = 0; d < sys->dim; ++d) sys->z[d] = p ? sys->force_factor * p[d] : 0;
  for (int j = 0; j < sys->model->n_contacts; ++j) {
    const contact *law = &sys->model->contacts[j].law;
    const double *n = condensation_normal(sys->linear, j),
                 constant = (sys->stuck[j] ? 1 : -1) * ((law->gap > 0) == sys->stuck[j] ? 0 : law->kn * law->gap);
    for (int d = 0; d < sys->dim; ++d) sys->z[d] -= constant * n[d];
  }
  dense_solve_complex(sys->dim, sys->A, sys->pivot, false, 1, sys->z);
  return HC_OK;
}

/* Normal motion of contact j at rest, q_0 being in sys->z. */
static double rest_motion(const hbm_system *sys, int j)
{
  const double *n = condensation_normal(sys->linear, j);
  double v = 0;
  for (int d = 0; d < sys->dim; ++d) v += n[d] * creal(sys->z[d]);
  return v;
}

/* Which contacts are stuck in the static state, and its q_0 into X. */
static hc_status find_static_state(const hbm_system *sys, double *X)
{
  enum { TRIES = 50 };
  const bool loaded = load_of(sys, 0) && sys->first == 0;
  for (int j = 0; j < sys->model->n_contacts; ++j) {
    const contact *law = &sys->model->contacts[j].law;
    sys->stuck[j] = loaded || law->gap > 0 || law->load > 0;
  }
  add_stuck_stiffness(sys);
  bool changed = loaded;
  for (int k = 0; k < TRIES && changed; ++k) {
    hc_status st = solve_static(sys);
    if (st != HC_OK) return st;
    put_amplitude(sys, 0, sys->z, X);
    changed = false;
    for (int j = 0; j < sys->model->n_contacts; ++j) {
      const contact *law = &sys->model->contacts[j].law;
      const bool closed = law->load > 0 || rest_motion(sys, j) + law->gap > 0;
      changed |= closed != sys->stuck[j];
      sys->stuck[j] = closed;
    }
  }
  add_stuck_stiffness(sys);
  return HC_OK;
}

hc_status hbm_linear_rest(hbm_system *sys, double *N)
{
  const double any = 1; /* at rest omega matters nowhere */
  hc_status st = condensation_at(sys->linear, any, 0);
  memset(sys->z, 0, (size_t)sys->dim * sizeof *sys->z);
  if (st == HC_OK) st = find_static_state(sys, sys->rows);
  for (int j = 0; j < sys->model->n_contacts && st == HC_OK; ++j)
    N[j] = contact_normal(&sys->model->contacts[j].law, rest_motion(sys, j));
  return st;
}

static hc_status respond(const hbm_system *sys, double omega, double *X)
{
  hc_status st = condensation_at(sys->linear, omega, sys->more_damping);
  memset(X, 0, (size_t)sys->n_coef * sizeof(double));
  if (st == HC_OK) st = find_static_state(sys, X);
  for (int l = 0; l < sys->model->n_loads && st == HC_OK; ++l) {
    const int h = sys->model->loads[l].harmonic;
    if (h == 0) continue;
    st = factor(sys, h);
    for (int d = 0; d < sys->dim; ++d) sys->z[d] = sys->force_factor * condensation_load(sys->linear, l)[d];
    if (st == HC_OK) dense_solve_complex(sys->dim, sys->A, sys->pivot, false, 1, sys->z);
    if (st == HC_OK) put_amplitude(sys, h, sys->z, X);
  }
  return st;
}

void hbm_linear_response(hbm_system *sys, double omega, double *X)
{
  /* an undamped resonance: only the order of magnitude matters */
  if (respond(sys, omega, X) != HC_OK) respond(sys, omega * (1 + 1e-3), X);
}

bool hbm_linear_point(hbm_solver *s, double omega, double near, double *X, double *dX, hbm_point *point)
{
  hbm_system *sys = &s->sys;
  double *linear = s->anchor, *R = s->z;
  hbm_linear_response(sys, omega, linear);
  const metric_at at = hbm_metric_at(s, linear);
  if (is_zero(sys->n_coef, linear) || !(metric_distance(&at, X, linear) <= near)) return false;
  if (hbm_system_residual(sys, omega, linear, R) != HC_OK) return false;
  if (sys->report.regime > CONTACT_STUCK) return false;
  hbm_system_weights(sys, omega, hbm_least_share(s), s->r_scale);
  const double residual = norm_weighted_max(sys->n, s->r_scale, R);
  if (!(residual <= sys->how.tolerance)) return false;
  memcpy(X, linear, (size_t)sys->n_coef * sizeof(double));
  /* dq_h = -(S + K')^-1 (dS q_h - dp), harmonic by harmonic: the rows of the equations' derivative. */
  const int dim = sys->dim;
  memset(dX, 0, (size_t)sys->n_coef * sizeof(double));
  hbm_system_domega(sys, omega, X, R);
  for (int l = 0; l < sys->model->n_loads; ++l) {
    const int h = sys->model->loads[l].harmonic;
    if (h == 0 || factor(sys, h) != HC_OK) continue;
    const double *a = R + (2 * h - 1) * dim - sys->first;
    for (int d = 0; d < dim; ++d) sys->z[d] = -(a[d] - I * a[dim + d]);
    dense_solve_complex(dim, sys->A, sys->pivot, false, 1, sys->z);
    put_amplitude(sys, h, sys->z, dX);
  }
  *point = (hbm_point){.omega = omega, .residual = residual, .harmonics = sys->n_harm, .error = NAN};
  return true;
}
