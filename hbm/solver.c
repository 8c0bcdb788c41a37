/* solver.c - makes and frees hbm_solver, and hands its two systems to KINSOL. */
#include "hbm/solver.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/periodic_motion.h"
#include "numerics/series.h"

double hbm_norm(int n, const double *v)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += v[i] * v[i];
  return sqrt(sum);
}

void hbm_pack(const hbm_solver *s, const double *X, double omega, double *z)
{
  memcpy(z, X + s->sys.first, (size_t)s->sys.n * sizeof(double));
  z[s->sys.n] = omega;
}

void hbm_unpack(const hbm_solver *s, const double *z, double *X, double *omega)
{
  X[0] = 0;
  memcpy(X + s->sys.first, z, (size_t)s->sys.n * sizeof(double));
  *omega = z[s->sys.n];
}

static void take_harmonics(hbm_solver *s, const double *z)
{
  s->Z[0] = 0;
  memcpy(s->Z + s->sys.first, z, (size_t)s->sys.n * sizeof(double));
}

static hc_status fixed_residual(void *self, const double *z, double *r)
{
  hbm_solver *s = self;
  take_harmonics(s, z);
  return hbm_system_residual(&s->sys, s->omega, s->Z, r);
}

static hc_status fixed_jacobian(void *self, const double *z, double *jac)
{
  hbm_solver *s = self;
  (void)z; /* that of the last residual, says newton.h */
  hbm_system_jacobian(&s->sys, s->omega, s->sys.n, jac);
  return HC_OK;
}

static hc_status plane_residual(void *self, const double *z, double *r)
{
  hbm_solver *s = self;
  int n = s->sys.n;
  if (!(z[n] > 0)) return HC_NOT_FINITE; /* omega > 0 always */
  take_harmonics(s, z);
  r[n] = 0;
  for (int i = 0; i <= n; ++i) r[n] += s->normal[i] * (z[i] - s->anchor[i]);
  return hbm_system_residual(&s->sys, z[n], s->Z, r);
}

static hc_status plane_jacobian(void *self, const double *z, double *jac)
{
  hbm_solver *s = self;
  int n = s->sys.n;
  size_t ld = (size_t)n + 1;
  hbm_system_jacobian(&s->sys, z[n], n + 1, jac);
  hbm_system_domega(&s->sys, z[n], s->Z, jac + ld * n);
  for (int i = 0; i <= n; ++i) jac[n + ld * i] = s->normal[i];
  return HC_OK;
}

static hc_status make_workspace(hbm_solver *s)
{
  size_t m = (size_t)s->sys.n_coef + 1;
  double **const arrays[] = {&s->Z, &s->z, &s->z_scale, &s->r_scale, &s->normal, &s->anchor};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i)
    if (!(*arrays[i] = calloc(m, sizeof(double)))) return HC_NO_MEMORY;
  newton_problem fixed = {s->sys.n, s, fixed_residual, fixed_jacobian};
  newton_problem plane = {s->sys.n + 1, s, plane_residual, plane_jacobian};
  hc_status st = newton_new(&fixed, &s->fixed);
  return st == HC_OK ? newton_new(&plane, &s->plane) : st;
}

static hc_status make_pattern(hbm_solver *s)
{
  if (!s->sys.sampled) return HC_OK;
  return exact_force_new_of_model(s->sys.n_harm, s->model, &s->pattern);
}

enum { AUTO_FIRST_HARMONICS = 3, AUTO_FIRST_SAMPLES = 64, AUTO_LEAST_LOOK = 14 };

/* The finer equations that auto is measured by: twice the harmonics, but enough to see a short contact from H = 1;
 * twice the samples. */
static hc_status make_refinements(hbm_solver *s, int n_time)
{
  const hbm_settings *how = &s->how;
  int n_harm = s->sys.n_harm, twice = n_harm > HBM_MAX_HARMONICS / 2 ? HBM_MAX_HARMONICS : 2 * n_harm;
  if (twice < AUTO_LEAST_LOOK) twice = AUTO_LEAST_LOOK;
  hc_status st = HC_OK;
  if (how->harmonics == HBM_AUTO)
    st = refinement_new(s->model, how, twice, n_time < 4 * twice ? 4 * twice : n_time, &s->finer_harmonics);
  if (st == HC_OK && how->samples == HBM_AUTO && s->sys.sampled)
    st = refinement_new(s->model, how, n_harm, 2 * n_time, &s->finer_samples);
  return st;
}

static hc_status make_equations(hbm_solver *s, int n_harm, int n_time)
{
  hc_status st = hbm_system_init(&s->sys, s->model, &s->how, n_harm, n_time);
  s->n_time = n_time;
  if (st == HC_OK) st = make_workspace(s);
  if (st == HC_OK) st = make_pattern(s);
  return st == HC_OK ? make_refinements(s, n_time) : st;
}

static void drop_equations(hbm_solver *s)
{
  newton_free(s->fixed);
  newton_free(s->plane);
  exact_force_free(s->pattern);
  refinement_free(s->finer_harmonics);
  refinement_free(s->finer_samples);
  hbm_system_clear(&s->sys);
  double *const arrays[] = {s->Z, s->z, s->z_scale, s->r_scale, s->normal, s->anchor};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) free(arrays[i]);
  *s = (hbm_solver){.model = s->model, .how = s->how, .stability = s->stability, .step_scale = s->step_scale};
}

hc_status hbm_solver_resize(hbm_solver *s, int n_harm, int n_time)
{
  long evaluations = s->sys.evaluations; /* counted over the solver's life */
  drop_equations(s);
  hc_status st = make_equations(s, n_harm, n_time);
  s->sys.evaluations = evaluations;
  return st;
}

hc_status hbm_solver_new(const model *m, const hbm_settings *how, hbm_solver **out)
{
  *out = NULL;
  hbm_solver *s = calloc(1, sizeof *s);
  if (!s) return HC_NO_MEMORY;
  int n_harm = how->harmonics == HBM_AUTO ? AUTO_FIRST_HARMONICS : how->harmonics, n_time = how->samples;
  if (n_time == HBM_AUTO)
    for (n_time = AUTO_FIRST_SAMPLES; n_time < 4 * n_harm; n_time *= 2) {}
  s->how = *how;
  s->step_scale = 1;
  hc_status st = model_copy(m, &s->model);
  if (st == HC_OK) st = stability_new(m->n_contacts, &s->stability);
  if (st == HC_OK) st = make_equations(s, n_harm, n_time);
  if (st == HC_OK) {
    *out = s;
    return HC_OK;
  }
  hbm_solver_free(s);
  return st;
}

void hbm_solver_free(hbm_solver *s)
{
  if (!s) return;
  drop_equations(s);
  stability_free(s->stability);
  model_free(s->model);
  free(s);
}

int hbm_n_harmonics(const hbm_solver *s) { return s->sys.n_harm; }

void hbm_scale_steps(hbm_solver *s, double scale) { s->step_scale = scale > 0 && scale <= 1 ? scale : 1; }

int hbm_n_samples(const hbm_solver *s) { return s->sys.sampled ? s->n_time : 0; }

/* Weights for KINSOL: X by its size, R by the forces it is made of at the guess. */
static hc_status set_scales(hbm_solver *s, double omega, double x_scale, const double *X)
{
  hc_status st = hbm_system_contact(&s->sys, X);
  if (st != HC_OK) return st;
  double force = hbm_system_scale(&s->sys, omega);
  if (!(force > 0)) force = 1; /* no forcing, no motion: 0 = 0 at any scale */
  if (!(x_scale > 0)) x_scale = 1;
  for (int i = 0; i < s->sys.n; ++i) {
    s->z_scale[i] = 1 / x_scale;
    s->r_scale[i] = 1 / force;
  }
  return HC_OK;
}

/* The residual again, against the forces at the answer rather than at the guess. */
static hc_status recheck(hbm_solver *s, double omega, const newton_report *report, hbm_point *point)
{
  double force = hbm_system_scale(&s->sys, omega);
  point->omega = omega;
  point->iterations = report->iterations;
  point->harmonics = s->sys.n_harm;
  point->error = NAN;
  point->residual = force > 0 ? report->residual / (s->r_scale[0] * force) : report->residual;
  return point->residual <= 10 * s->how.tolerance ? HC_OK : HC_NOT_CONVERGED;
}

enum { MAX_NEWTON = 25 };

hc_status hbm_solve_fixed(hbm_solver *s, double omega, double x_scale, double *X, hbm_point *point)
{
  hc_status st = set_scales(s, omega, x_scale, X);
  if (st != HC_OK) return st;
  s->omega = omega;
  newton_options opt = {s->z_scale, s->r_scale, s->how.tolerance, 3.0, MAX_NEWTON};
  newton_report report;
  hbm_pack(s, X, omega, s->z);
  st = newton_solve(s->fixed, s->z, &opt, &report);
  if (st != HC_OK) {
    point->iterations = report.iterations;
    return st;
  }
  if ((st = recheck(s, omega, &report, point)) == HC_OK) hbm_unpack(s, s->z, X, &omega);
  return st;
}

hc_status hbm_solve_plane(hbm_solver *s, const double *normal, double x_scale, double omega_scale, double *X,
                          double *omega, hbm_point *point)
{
  hc_status st = set_scales(s, *omega, x_scale, X);
  if (st != HC_OK) return st;
  int n = s->sys.n;
  s->z_scale[n] = 1 / omega_scale;
  s->r_scale[n] = 1; /* normal . (z - anchor) is a length in the metric */
  memcpy(s->normal, normal, (size_t)(n + 1) * sizeof(double));
  hbm_pack(s, X, *omega, s->anchor);
  memcpy(s->z, s->anchor, (size_t)(n + 1) * sizeof(double));
  newton_options opt = {s->z_scale, s->r_scale, s->how.tolerance, 1.0, MAX_NEWTON};
  newton_report report;
  st = newton_solve(s->plane, s->z, &opt, &report);
  if (st != HC_OK) {
    point->iterations = report.iterations;
    return st;
  }
  if ((st = recheck(s, s->z[n], &report, point)) == HC_OK) hbm_unpack(s, s->z, X, omega);
  return st;
}

hc_status hbm_tangent_fixed(hbm_solver *s, const double *X, double *dX)
{
  hbm_system_domega(&s->sys, s->omega, X, s->z);
  hc_status st = newton_backsolve(s->fixed, s->z);
  dX[0] = 0;
  for (int i = 0; i < s->sys.n; ++i) dX[i + s->sys.first] = -s->z[i];
  return st;
}

hc_status hbm_tangent_plane(hbm_solver *s, double *dX, double *d_omega)
{
  memset(s->z, 0, (size_t)s->sys.n * sizeof(double));
  s->z[s->sys.n] = 1;
  hc_status st = newton_backsolve(s->plane, s->z);
  hbm_unpack(s, s->z, dX, d_omega);
  return st;
}

hc_status hbm_kernel_at(hbm_solver *s, const double *normal, const double *X, double omega, double *dX, double *d_omega,
                        int *sign)
{
  memcpy(s->normal, normal, (size_t)(s->sys.n + 1) * sizeof(double));
  hbm_pack(s, X, omega, s->anchor);
  hc_status st = newton_factor_at(s->plane, s->anchor);
  if (st == HC_OK) st = hbm_tangent_plane(s, dX, d_omega);
  *sign = newton_sign(s->plane);
  return st;
}

hc_status hbm_measure(hbm_solver *s, const double *X, hbm_measures *out)
{
  hc_status st = hbm_system_contact(&s->sys, X);
  if (st != HC_OK) return st;
  int n_harm = s->sys.n_harm;
  series_extrema(n_harm, X, &out->max, &out->min);
  out->amplitude = motion_amplitude(out->max, out->min);
  out->rms = series_rms(n_harm, X);
  out->mean = X[0];
  out->harmonic_1 = series_harmonic_1(n_harm, X);
  out->contact = s->sys.report;
  return HC_OK;
}

hc_status hbm_sliders(hbm_solver *s, const double *X, double *w)
{
  hc_status st = hbm_system_contact(&s->sys, X);
  if (st != HC_OK) return st;
  if (s->sys.sampled) aft_sliders(s->sys.sampled, w);
  else exact_force_sliders(s->sys.located, w);
  return HC_OK;
}

hc_status hbm_pattern_at(hbm_solver *s, const double *X, const exact_force **e, contact_report *report)
{
  *e = s->pattern ? s->pattern : s->sys.located;
  hc_status st = s->pattern ? exact_force_eval(s->pattern, X, s->Z, NULL, report) : hbm_system_contact(&s->sys, X);
  if (st == HC_OK && !s->pattern) *report = s->sys.report;
  return st;
}

hc_status hbm_stability_at(hbm_solver *s, double omega, const double *X, hbm_stability *out)
{
  const exact_force *e;
  contact_report report;
  hc_status st = hbm_pattern_at(s, X, &e, &report);
  if (st == HC_OK) st = stability_of(s->stability, s->model, e, omega, out);
  if (st != HC_OK) return st;
  s->omega = omega;
  hbm_pack(s, X, omega, s->z);
  hc_status factored = newton_factor_at(s->fixed, s->z);
  out->agrees = factored == HC_OK && (newton_sign(s->fixed) > 0) == (out->fold > 0);
  return HC_OK;
}

int hbm_stability_verdict(const hbm_stability *st)
{
  if (!(fabs(st->multiplier - 1) > 1e-9) || !st->agrees) return 0; /* NaN too */
  return st->multiplier < 1 ? 1 : -1;
}
