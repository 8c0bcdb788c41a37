/* rate_force.c - contact force harmonics (contact_evaluator.h) of friction as a smooth function of the velocity,
 *
 *     T = mu N tanh(omega u'/epsilon),      N - N0 by located transitions (exact_force.h)
 *
 * Without aliasing: T's integrals by Gauss's rule on panels of each time in contact, no longer than 0.65 of the
 * distance to the nearest pole of tanh, i pi epsilon/2 beside where u' = 0: to rounding, however small epsilon is. The
 * other evaluator samples T and N - N0 at n_time instants. The Jacobian is that of u and v, and of u' by harmonics.
 * The path of slip is that of u in contact, the work is T's. Proof: tests/hbm/test_smooth_force.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/contact/contact_evaluator.h"
#include "hbm/contact/contact_measures.h"
#include "hbm/contact/exact_force.h"
#include "hbm/contact/force_jacobian.h"
#include "numerics/base/constants.h"
#include "numerics/base/workspace.h"
#include "numerics/gauss.h"

typedef struct rubbing {
  moving_contact moved;
  int n_dof, n_harm, n_coef, n_time; /* n_time: 0 where forces are exact */
  double omega;
  double bend;                   /* [length/time] >= |omega u''| */
  exact_force *normal;           /* N - N0, and when it touches */
  double *X, *inner;             /* [n_dof][2H+1] of the last evaluation; [n_dof (2H+1)]^2 room */
  double *by_du, *by_v, *by_n;   /* [4H+1] series of dT/d(omega u'), dT/dv, where sampled d(N - N0)/dv */
  double *t, *turned, *by_omega; /* [2H+1] series of T; room; [n_dof][2H+1] dF/domega */
  double *n;                     /* [2H+1] where sampled: series of N - N0 */
  workspace memory;
} rubbing;

/* The contact at th, touching: T and its derivatives. */
typedef struct rubbing_at {
  double rate, v, t, by_du, by_v; /* omega u', ... */
} rubbing_at;

static rubbing_at look(const rubbing *r, double cosine, double sine, double omega)
{
  const contact *law = &r->moved.law;
  rubbing_at at = {0};
  for (int d = 0; d < r->n_dof; ++d) {
    const series_jet x = series_at(r->n_harm, r->X + (size_t)d * (size_t)r->n_coef, cosine, sine);
    at.rate += r->moved.cu[d] * omega * x.d1;
    at.v += r->moved.cv[d] * x.x;
  }
  const double limit = law->mu * (law->kn * (at.v + law->gap) + law->load), tangent = tanh(at.rate / law->epsilon),
               cosh_1 = 1 / cosh(fmin(fabs(at.rate / law->epsilon), 700));
  at.t = limit * tangent;
  at.by_v = law->mu * law->kn * tangent;
  at.by_du = limit / law->epsilon * cosh_1 * cosh_1;
  return at;
}

/* How far u' may be followed from there: a part of the way to the next pole of tanh. */
static double panel(const rubbing *r, double rate, double omega, double part, double degree)
{
  const double away = hypot(rate, r->moved.law.epsilon * (PI / 2)), most = 16 / (degree * r->n_harm);
  return r->bend > 0 ? fmin(part * away / (omega * r->bend), most) : most;
}

static void free_rubbing(void *self)
{
  rubbing *r = self;
  if (!r) return;
  exact_force_free(r->normal);
  workspace_free(&r->memory);
  free(r);
}

static hc_status make_with(const contact_coordinates *c, int n_harm, int n_time, void **self)
{
  *self = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || (n_time && n_time < 2 * n_harm + 1)) return HC_BAD_INPUT;
  rubbing *r = calloc(1, sizeof *r);
  if (!r) return HC_NO_MEMORY;
  r->moved = c->moved;
  r->n_dof = c->n_dof;
  r->n_harm = n_harm;
  r->n_coef = series_length(n_harm);
  r->n_time = n_time;
  r->omega = 1;
  const size_t all = (size_t)r->n_dof * (size_t)r->n_coef, symbol = (size_t)force_jacobian_symbol_length(n_harm);
  r->X = workspace_doubles(&r->memory, all);
  r->inner = workspace_doubles(&r->memory, all * all);
  double **const symbols[] = {&r->by_du, &r->by_v, &r->by_n};
  for (size_t i = 0; i < 3; ++i) *symbols[i] = workspace_doubles(&r->memory, symbol);
  r->t = workspace_doubles(&r->memory, (size_t)r->n_coef);
  r->n = workspace_doubles(&r->memory, (size_t)r->n_coef);
  r->turned = workspace_doubles(&r->memory, (size_t)r->n_coef);
  r->by_omega = workspace_doubles(&r->memory, all);
  hc_status st = r->memory.failed ? HC_NO_MEMORY : exact_force_new(n_harm, r->n_dof, 1, &c->moved, &r->normal);
  if (st == HC_OK) *self = r;
  else free_rubbing(r);
  return st;
}

static hc_status make_exact(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  return make_with(c, how->n_harm, 0, self);
}

static hc_status make_sampled(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  return make_with(c, how->n_harm, how->n_time, self);
}

/* to[2 n_harm + 1] += what a value at an angle is worth in the series, `share` its part of the period. */
static void add_value(int n_harm, double value, double share, double cosine, double sine, double *to)
{
  double ch = 1, sh = 0;
  value *= share;
  to[0] += value;
  for (int h = 1; h <= n_harm && value != 0; ++h) {
    series_turn(cosine, sine, &ch, &sh);
    to[2 * h - 1] += 2 * value * ch;
    to[2 * h] += 2 * value * sh;
  }
}

static void add_instant(rubbing *r, double th, double share)
{
  const double cosine = cos(th), sine = sin(th);
  const contact *law = &r->moved.law;
  rubbing_at at = look(r, cosine, sine, r->omega);
  if (r->n_time > 0) {
    const bool touches = law->load > 0 || at.v + law->gap > 0;
    add_value(r->n_harm, contact_normal_change(law, at.v), share, cosine, sine, r->n);
    if (!touches) return;
    add_value(2 * r->n_harm, law->kn, share, cosine, sine, r->by_n);
  }
  add_value(r->n_harm, at.t, share, cosine, sine, r->t);
  add_value(r->n_harm, at.by_du * at.rate / r->omega, share, cosine, sine, r->turned);
  add_value(2 * r->n_harm, at.by_du, share, cosine, sine, r->by_du);
  add_value(2 * r->n_harm, at.by_v, share, cosine, sine, r->by_v);
}

static void add_contact(rubbing *r, double from, double to)
{
  const double degree = 3; /* of u and v, and of 2H harmonics more */
  for (double th = from; th < to;) {
    const double rate = look(r, cos(th), sin(th), r->omega).rate;
    const double half = 0.5 * fmin(panel(r, rate, r->omega, 0.65, degree), to - th);
    for (int i = 0; i < GAUSS_POINTS; ++i)
      add_instant(r, th + half * (1 + gauss_node(GAUSS_POINTS, i)), half * gauss_weight(GAUSS_POINTS, i) / TWO_PI);
    if (!(th + 2 * half > th)) return;
    th = to - th > 2 * half ? th + 2 * half : to;
  }
}

/* jac += the blocks of dT/dX and, where sampled, d(N - N0)/dX. */
static void add_jacobian(rubbing *r, double *jac)
{
  const size_t n = (size_t)r->n_coef, rows = n * (size_t)r->n_dof;
  for (int part = 0; part < 2 + (r->n_time > 0); ++part) {
    const double *symbol = part == 0 ? r->by_v : part == 1 ? r->by_du : r->by_n;
    double *block = r->inner;
    memset(block, 0, n * n * sizeof *block);
    force_jacobian_add(r->n_harm, symbol, (int)n, block);
    for (int d = 0; d < r->n_dof; ++d)
      for (int e = 0; e < r->n_dof; ++e) {
        const double weight =
            (part == 2 ? r->moved.cv[d] : r->moved.cu[d]) * (part == 1 ? r->omega * r->moved.cu[e] : r->moved.cv[e]);
        double *to = jac + (size_t)e * n * rows + (size_t)d * n;
        for (size_t q = 0; q < n && weight != 0; ++q) {
          /* u' of a cosine is -h times the sine, of a sine h times the cosine. */
          const size_t h = (q + 1) / 2, from = part != 1 || q == 0 ? q : q % 2 ? q + 1 : q - 1;
          const double by = part != 1 ? weight : q % 2 ? -(double)h * weight : (double)h * weight;
          for (size_t p = 0; p < n; ++p) to[q * rows + p] += by * block[from * n + p];
        }
      }
  }
}

static hc_status evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  rubbing *r = self;
  const size_t n = (size_t)r->n_coef, symbol = (size_t)force_jacobian_symbol_length(r->n_harm);
  const contact_interval *p;
  int intervals;
  memcpy(r->X, X, n * (size_t)r->n_dof * sizeof *X);
  /* N - N0, and the times of contact. */
  hc_status st = exact_force_eval(r->normal, X, F, r->n_time > 0 ? NULL : jac, report);
  if (st != HC_OK) return st;
  p = exact_force_intervals(r->normal, 0, &intervals);
  if (report->regime == CONTACT_STUCK || report->regime == CONTACT_SLIPS) report->regime = CONTACT_BENDS;
  report->free_sliders = 0;
  /* T. */
  r->bend = 0;
  for (int d = 0; d < r->n_dof; ++d)
    for (size_t q = 1; q < n; ++q) {
      const size_t h = (q + 1) / 2;
      r->bend += fabs(r->moved.cu[d] * X[(size_t)d * n + q]) * (double)(h * h);
    }
  double *const series[] = {r->t, r->turned, r->n}, *const symbols[] = {r->by_du, r->by_v, r->by_n};
  for (int i = 0; i < 3; ++i) {
    memset(series[i], 0, n * sizeof *X);
    memset(symbols[i], 0, symbol * sizeof *X);
  }
  for (int i = 0; i < r->n_time; ++i) add_instant(r, TWO_PI * i / r->n_time, 1.0 / r->n_time);
  for (int i = 0; i < intervals && r->n_time == 0; ++i) add_contact(r, p[i].from, p[i].to);
  if (r->n_time > 0) memset(F, 0, n * (size_t)r->n_dof * sizeof *F);
  double sum = 0;
  for (int d = 0; d < r->n_dof; ++d)
    for (size_t q = 0; q < n; ++q) {
      F[(size_t)d * n + q] += r->moved.cu[d] * r->t[q] + r->moved.cv[d] * r->n[q];
      r->by_omega[(size_t)d * n + q] = r->moved.cu[d] * r->turned[q];
      sum += fabs(F[(size_t)d * n + q]);
    }
  if (jac && r->n_time > 0) memset(jac, 0, n * n * (size_t)(r->n_dof * r->n_dof) * sizeof *jac);
  if (jac) add_jacobian(r, jac);
  return isfinite(sum) ? HC_OK : HC_NOT_FINITE;
}

static void sliders(const void *self, double *w) { (void)self, *w = 0; }

static const contact_interval *intervals(const void *self, int *n)
{
  return exact_force_intervals(((const rubbing *)self)->normal, 0, n);
}

static contact_slopes slopes(const void *self, double th, double omega)
{
  const rubbing *r = self;
  const rubbing_at at = look(r, cos(th), sin(th), omega);
  return (contact_slopes){.t_du = at.by_du, .t_v = at.by_v, .step = panel(r, at.rate, omega, 0.4, 4)};
}

static void at_omega(void *self, double omega) { ((rubbing *)self)->omega = omega; }
static const double *by_omega(const void *self) { return ((const rubbing *)self)->by_omega; }

#define RUBBING                                                                                                        \
  .free = free_rubbing, .evaluate = evaluate, .sliders = sliders, .at_omega = at_omega, .by_omega = by_omega

const contact_evaluator tanh_evaluator = {.make = make_exact, .intervals = intervals, .slopes = slopes, RUBBING};
const contact_evaluator tanh_sampled_evaluator = {.make = make_sampled, RUBBING};

hc_status tanh_measures_of(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,
                           contact_period *out)
{
  const contact_coordinates all = {.n_dof = 2, .moved = {.law = *law, .cu = {1, 0}, .cv = {0, 1}}};
  const size_t n = (size_t)series_length(n_harm);
  contact_report report = {.regime = CONTACT_LINEAR};
  void *self;
  (void)u_2;
  hc_status st = contact_measures_of(law, n_harm, u, v, out);
  if (st == HC_OK) st = make_with(&all, n_harm, 0, &self);
  if (st != HC_OK) return st;
  double *X = calloc(4 * n, sizeof *X);
  if (X) memcpy(X, u, n * sizeof *X), memcpy(X + n, v, n * sizeof *X);
  st = X ? evaluate(self, X, X + 2 * n, NULL, &report) : HC_NO_MEMORY;
  const rubbing *r = self;
  int count = 0;
  const contact_interval *p = st == HC_OK ? intervals(self, &count) : NULL;
  for (int k = 0; k < count; ++k)
    for (double th = p[k].from; th < p[k].to;) {
      const double half = 0.5 * fmin(panel(r, look(r, cos(th), sin(th), 1).rate, 1, 0.65, 3), p[k].to - th);
      for (int i = 0; i < GAUSS_POINTS; ++i) {
        const double at_th = th + half * (1 + gauss_node(GAUSS_POINTS, i)),
                     weight = half * gauss_weight(GAUSS_POINTS, i);
        const rubbing_at at = look(r, cos(at_th), sin(at_th), 1);
        out->traction_max = fmax(out->traction_max, fabs(at.t));
        out->slip_distance += weight * fabs(at.rate);
        out->work += weight * at.t * at.rate;
      }
      th = p[k].to - th > 2 * half && half > 0 ? th + 2 * half : p[k].to;
    }
  out->regime = report.regime;
  free_rubbing(self);
  free(X);
  return st;
}
