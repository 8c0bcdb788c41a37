/* corrector.c - see corrector.h: the callbacks of both forms, KINSOL's weights, and the check of its answer. */
#include "hbm/solver/corrector.h"

#include <float.h>
#include <string.h>

#include "hbm/solver/hbm_solver_impl.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

/* On a quick ramp a step that needs more iterations than QUICK_ITERATIONS is halved instead. */
enum { MAX_NEWTON_ITERATIONS = 25, QUICK_ITERATIONS = 8 };

/* What a step on a curve may leave of the residual for its Jacobian of many unknowns to serve on (newton.h: keeps). */
static const double jacobian_keeps = 0.1;

/* z[n+1] <-> X[n_coef] and omega. */
static void pack(const hbm_solver *s, const double *X, double omega, double *z)
{
  memcpy(z, X + s->sys.first, (size_t)s->sys.n * sizeof(double));
  z[s->sys.n] = omega;
}

static void unpack_harmonics(const hbm_solver *s, const double *z, double *X)
{
  for (int i = 0; i < s->sys.first; ++i) X[i] = 0;
  memcpy(X + s->sys.first, z, (size_t)s->sys.n * sizeof(double));
}

static void unpack(const hbm_solver *s, const double *z, double *X, double *omega)
{
  unpack_harmonics(s, z, X);
  *omega = z[s->sys.n];
}

/* omega at a place of the curve: the place itself, or, on a ramp, the ramp's; the equations become those there. */
static double omega_at(hbm_solver *s, double place)
{
  if (!s->ramp) return place;
  hbm_ramp_set(s->ramp, place, &s->sys);
  return s->ramp->omega;
}

/* dR/dplace [n] at X. */
static void by_place(hbm_solver *s, double place, const double *X, double *dR)
{
  if (s->ramp) hbm_ramp_derivative(s->ramp, place, &s->sys, X, dR);
  else hbm_system_domega(&s->sys, place, X, dR);
}

/* Is the solve to go on? Asked where evaluations take so long that nobody would wait for the end of a step. */
static bool goes_on(hbm_solver *s)
{
  if (hbm_has_many_unknowns(s) && !hc_monitor_tick(s->monitor, s->done)) s->stopped = true;
  return !s->stopped;
}

/* ---- symmetry ----
 *
 * A symmetric solution of a symmetric model stays one: where its symmetry breaks the equations are singular, and the
 * rounding of even harmonics would grow into a step to the other branch, or many that are too short. */

static bool is_even(const hbm_solver *s, int coefficient) { return (coefficient / s->sys.dim + 1) / 2 % 2 == 0; }

/* s->even_part[n_coef] := what even harmonics have of X. */
static void take_even(const hbm_solver *s, int n_coef, const double *X)
{
  for (int i = 0; i < n_coef; ++i) s->even_part[i] = is_even(s, i) ? X[i] : 0;
}

/* Every contact is symmetric by its own size: a small one beside a large one, too. */
static bool nearly_symmetric(const hbm_solver *s, const double *X)
{
  const double rounding = 1e-6;
  const metric_at at = hbm_metric_at(s, X);
  if (!s->symmetric || s->started) return false;
  take_even(s, s->sys.n_coef, X);
  return metric_length(&at, s->even_part) <= rounding;
}

/* v[n] := 0 where it is of an even harmonic; v is of the coefficients from `first` on. */
static void clear_even(const hbm_solver *s, int first, int n, double *v)
{
  for (int i = 0; i < n; ++i)
    if (is_even(s, i + first)) v[i] = 0;
}

/* R at s->X. */
static hc_status residual_at(hbm_solver *s, double omega, double *r)
{
  const hc_status st = hbm_system_residual(&s->sys, omega_at(s, omega), s->X, r);
  if (nearly_symmetric(s, s->X)) clear_even(s, s->sys.first, s->sys.n, r);
  return st;
}

static hc_status fixed_residual(void *self, const double *z, double *r)
{
  hbm_solver *s = self;
  if (!goes_on(s)) return HC_INTERRUPTED;
  unpack_harmonics(s, z, s->X);
  return residual_at(s, s->omega, r);
}

static hc_status fixed_jacobian(void *self, const double *z, double *jac)
{
  hbm_solver *s = self;
  (void)z; /* the z of the last residual: newton.h promises it */
  hbm_system_jacobian(&s->sys, omega_at(s, s->omega), s->sys.n, jac);
  return HC_OK;
}

static hc_status plane_residual(void *self, const double *z, double *r)
{
  hbm_solver *s = self;
  int n = s->sys.n;
  if (!goes_on(s)) return HC_INTERRUPTED;
  if (!(z[n] > 0)) return HC_NOT_FINITE; /* Newton left omega > 0: the step is refused */
  unpack_harmonics(s, z, s->X);
  r[n] = 0;
  for (int i = 0; i <= n; ++i) r[n] += s->normal[i] * (z[i] - s->anchor[i]);
  return residual_at(s, z[n], r);
}

static hc_status plane_jacobian(void *self, const double *z, double *jac)
{
  hbm_solver *s = self;
  int n = s->sys.n;
  size_t ld = (size_t)n + 1;
  hbm_system_jacobian(&s->sys, omega_at(s, z[n]), n + 1, jac);
  by_place(s, z[n], s->X, jac + ld * n);
  for (int i = 0; i <= n; ++i) jac[n + ld * i] = s->normal[i];
  return HC_OK;
}

hc_status hbm_corrector_new(hbm_solver *s)
{
  const int mean = s->sys.first ? 0 : s->sys.dim, harmonic = 2 * s->sys.dim;
  newton_problem fixed = {s->sys.n, s, fixed_residual, fixed_jacobian, mean, harmonic};
  newton_problem plane = {s->sys.n + 1, s, plane_residual, plane_jacobian, mean, harmonic};
  hc_status st = newton_new(&fixed, &s->fixed);
  return st == HC_OK ? newton_new(&plane, &s->plane) : st;
}

/* Weights of the residual's rows at the X of the last one, into s->r_scale. */
static void weigh_rows(hbm_solver *s, double omega)
{
  hbm_system_weights(&s->sys, omega_at(s, omega), hbm_least_share(s), s->r_scale);
}

/* Weights for KINSOL: X by metric_reach, R by the forces it is made of at the guess. */
static hc_status set_scales(hbm_solver *s, double omega, const double *X)
{
  hbm_system_at(&s->sys, omega_at(s, omega));
  hc_status st = hbm_system_contact(&s->sys, X, true);
  if (st != HC_OK) return st;
  weigh_rows(s, omega);
  const metric_at at = hbm_metric_at(s, X);
  metric_reach(&at, s->sys.moved);
  for (int i = 0; i < s->sys.n; ++i) s->z_scale[i] = s->sys.moved[i % s->sys.dim];
  return HC_OK;
}

/* Newton from s->z, whose last entry is omega, by either form. KINSOL weighted the residual by the forces at the guess;
 * here it is weighed against those at the answer, which then becomes X and *omega. */
static hc_status solve(hbm_solver *s, newton *form, const newton_options *opt, double *X, double *omega,
                       hbm_point *point)
{
  newton_report report;
  hc_status st = newton_solve(form, s->z, opt, &report);
  point->iterations = report.iterations;
  if (st != HC_OK) return st;
  weigh_rows(s, s->z[s->sys.n]);
  point->omega = s->z[s->sys.n];
  point->harmonics = s->sys.n_harm;
  point->error = NAN;
  point->residual = norm_weighted_max(s->sys.n, s->r_scale, newton_residual(form));
  if (!(point->residual <= 10 * s->how.tolerance)) return HC_NOT_CONVERGED;
  if (!hbm_system_knows_means(&s->sys)) return HC_SINGULAR;
  unpack(s, s->z, X, omega);
  s->on_symmetric = nearly_symmetric(s, X);
  if (s->on_symmetric) clear_even(s, 0, s->sys.n_coef, X);
  return HC_OK;
}

static newton_options corrector_options(const hbm_solver *s, double max_step, int max_iterations, bool plain)
{
  const bool quick = s->ramp && s->ramp->quick;
  return (newton_options){.z_scale = s->z_scale,
                          .r_scale = s->r_scale,
                          .tolerance = s->how.tolerance,
                          .max_step = max_step,
                          .max_iterations = quick ? QUICK_ITERATIONS : max_iterations,
                          .plain = plain || quick,
                          .unpolished = quick,
                          .keeps = s->predicted && !s->ramp && hbm_has_many_unknowns(s) ? jacobian_keeps : 0,
                          .ends_fresh = true};
}

static hc_status solve_fixed(hbm_solver *s, double omega, bool polish, bool plain, double *X, hbm_point *point)
{
  newton_options opt = corrector_options(s, 3.0, MAX_NEWTON_ITERATIONS, plain);
  if (!polish) opt.unpolished = true;
  ++s->solves;
  hc_status st = set_scales(s, omega, X);
  if (st != HC_OK) return st;
  s->omega = omega;
  pack(s, X, omega, s->z);
  return solve(s, s->fixed, &opt, X, &omega, point);
}

hc_status hbm_solve_fixed(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  return solve_fixed(s, omega, true, false, X, point);
}

hc_status hbm_solve_plainly(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  return solve_fixed(s, omega, true, true, X, point);
}

hc_status hbm_solve_roughly(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  return solve_fixed(s, omega, false, false, X, point);
}

static hc_status solve_plane(hbm_solver *s, const double *normal, double omega_scale, int max_iterations, bool plain,
                             double *X, double *omega, hbm_point *point)
{
  const newton_options opt = corrector_options(s, 1.0, max_iterations, plain);
  const int n = s->sys.n;
  ++s->solves;
  hc_status st = set_scales(s, *omega, X);
  if (st != HC_OK) return st;
  s->z_scale[n] = 1 / omega_scale;
  s->r_scale[n] = 1; /* normal . (z - anchor) is a length in the metric */
  memcpy(s->normal, normal, (size_t)(n + 1) * sizeof(double));
  pack(s, X, *omega, s->anchor);
  memcpy(s->z, s->anchor, (size_t)(n + 1) * sizeof(double));
  return solve(s, s->plane, &opt, X, omega, point);
}

hc_status hbm_solve_plane(hbm_solver *s, const double *normal, double omega_scale, double *X, double *omega,
                          hbm_point *point)
{
  return solve_plane(s, normal, omega_scale, MAX_NEWTON_ITERATIONS, false, X, omega, point);
}

hc_status hbm_solve_plane_plainly(hbm_solver *s, const double *normal, double omega_scale, double *X, double *omega,
                                  hbm_point *point)
{
  return solve_plane(s, normal, omega_scale, s->how.iterations, true, X, omega, point);
}

hc_status hbm_tangent_fixed(hbm_solver *s, const double *X, double *dX)
{
  by_place(s, s->omega, X, s->z);
  hc_status st = newton_backsolve(s->fixed, s->z);
  for (int i = 0; i < s->sys.first; ++i) dX[i] = 0;
  for (int i = 0; i < s->sys.n; ++i) dX[i + s->sys.first] = -s->z[i];
  if (s->on_symmetric) clear_even(s, 0, s->sys.n_coef, dX);
  return st;
}

hc_status hbm_tangent_plane(hbm_solver *s, double *dX, double *d_omega)
{
  memset(s->z, 0, (size_t)s->sys.n * sizeof(double));
  s->z[s->sys.n] = 1;
  hc_status st = newton_backsolve(s->plane, s->z);
  unpack(s, s->z, dX, d_omega);
  if (s->on_symmetric) clear_even(s, 0, s->sys.n_coef, dX);
  return st;
}

hc_status hbm_kernel_at(hbm_solver *s, const double *normal, const double *X, double omega, double *dX, double *d_omega,
                        int *det_sign)
{
  memcpy(s->normal, normal, (size_t)(s->sys.n + 1) * sizeof(double));
  pack(s, X, omega, s->anchor);
  hc_status st = newton_factor_at(s->plane, s->anchor);
  if (st == HC_OK) st = hbm_tangent_plane(s, dX, d_omega);
  *det_sign = newton_sign(s->plane);
  return st;
}

/* s->even_block: dR/dX of even harmonics at X, factored. */
static hc_status factor_even(hbm_solver *s, double omega, const double *X)
{
  const hbm_system *sys = &s->sys;
  int n = 0;
  hc_status st = hbm_system_residual(&s->sys, omega_at(s, omega), X, s->z);
  if (st != HC_OK) return st;
  hbm_system_jacobian(&s->sys, omega_at(s, omega), sys->n, s->whole_block);
  for (int i = 0; i < sys->n; ++i)
    if (is_even(s, i + sys->first)) s->even_index[n++] = i;
  s->n_even = n;
  for (int q = 0; q < n; ++q)
    for (int i = 0; i < n; ++i)
      s->even_block[i + (size_t)n * (size_t)q] =
          s->whole_block[s->even_index[i] + (size_t)sys->n * (size_t)s->even_index[q]];
  return dense_factor(n, s->even_block, s->even_pivot);
}

int hbm_even_sign(hbm_solver *s, double omega, const double *X)
{
  return factor_even(s, omega, X) == HC_OK ? dense_sign(s->n_even, s->even_block, s->even_pivot) : 0;
}

hc_status hbm_even_kernel(hbm_solver *s, double omega, const double *X, double *phi)
{
  enum { STEPS = 4 }; /* of inverse iteration: each leaves the ratio of the two least eigenvalues, which is tiny here */
  const metric_at at = hbm_metric_at(s, X);
  hc_status st = factor_even(s, omega, X);
  for (int i = 0; i < s->n_even; ++i) s->z[i] = 1 + 0.1 * (i % 7); /* any vector with a part of every kernel */
  for (int k = 0; k < STEPS && st == HC_OK; ++k) {
    memset(phi, 0, (size_t)s->sys.n_coef * sizeof *phi);
    dense_solve(s->n_even, s->even_block, s->even_pivot, 1, s->z);
    for (int i = 0; i < s->n_even; ++i) phi[s->sys.first + s->even_index[i]] = s->z[i];
    const double length = metric_length(&at, phi);
    if (!(length > 0 && isfinite(length))) st = HC_SINGULAR;
    for (int i = 0; i < s->n_even && st == HC_OK; ++i) s->z[i] /= length;
    for (int i = 0; i < s->sys.n_coef && st == HC_OK; ++i) phi[i] /= length;
  }
  return st;
}

bool hbm_on_either_side(const hbm_solver *s, int n_coef, const double *X, const double *Y)
{
  const int n = n_coef < s->sys.n_coef ? n_coef : s->sys.n_coef;
  const metric_at at = {s->sys.metric, n, X, Y};
  if (!s->symmetric) return false;
  take_even(s, n, X);
  return metric_inner(&at, s->even_part, Y) < 0; /* coefficients meet only themselves: of Y's the even ones */
}

bool hbm_mirror(const hbm_solver *s, double *X)
{
  for (int i = 0; i < s->sys.n_coef && s->symmetric; ++i)
    if (is_even(s, i)) X[i] = -X[i];
  return s->symmetric;
}

hc_status hbm_det_sign_at(hbm_solver *s, double omega, const double *X, int *det_sign)
{
  s->omega = omega;
  pack(s, X, omega, s->z);
  hc_status st = newton_factor_at(s->fixed, s->z);
  *det_sign = newton_sign(s->fixed);
  return st;
}

hc_status hbm_residual_at(hbm_solver *s, double omega, const double *X, double *residual)
{
  const double at = omega_at(s, omega);
  const hc_status st = hbm_system_residual(&s->sys, at, X, s->z);
  if (st != HC_OK) return st;
  hbm_system_weights(&s->sys, at, hbm_least_share(s), s->r_scale);
  *residual = norm_weighted_max(s->sys.n, s->r_scale, s->z);
  return HC_OK;
}
