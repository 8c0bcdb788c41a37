/* smooth_force.c - contact force harmonics of polynomials (contact_evaluator.h), by samples of a period.
 *   X -> v(th_i) -> f_i -> F      f'(v_i) -> its 2H harmonics -> Jacobian (force_jacobian.h)
 * One of degree p of a motion with H harmonics has p H of them, and its products with one of the first H have
 * (p + 1) H: N >= (p + 1) H + 1 samples give the first H, and the Jacobian, without aliasing, to rounding. That many
 * are `exact`. Proof: tests/hbm/test_smooth_force.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/contact/contact_evaluator.h"
#include "hbm/contact/fft_plan.h"
#include "hbm/contact/force_jacobian.h"
#include "numerics/base/workspace.h"

typedef struct spring {
  contact law;
  double normal; /* v of X = 1 */
  int n_harm;
  period_samples of;
  double *v, *f, *k; /* [n_time] motion; force; stiffness, of what X = 1 moves */
  double *symbol;    /* [4H+1] series of k */
  double *X;         /* [2H+1] of the last evaluation */
  workspace memory;
} spring;

/* Where all coefficients are 0, too. */
static int degree_of(const contact *law) { return contact_degree(law) > 2 ? contact_degree(law) : 2; }

static void free_spring(void *self)
{
  spring *s = self;
  if (!s) return;
  period_samples_clear(&s->of);
  workspace_free(&s->memory);
  free(s);
}

static hc_status make_with(const contact_coordinates *c, int n_harm, int n_time, void **self)
{
  *self = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || n_time < 2 * n_harm + 1) return HC_BAD_INPUT;
  spring *s = calloc(1, sizeof *s);
  if (!s) return HC_NO_MEMORY;
  s->law = c->moved.law;
  s->normal = c->moved.cv[0];
  s->n_harm = n_harm;
  double **const samples[] = {&s->v, &s->f, &s->k};
  for (size_t i = 0; i < sizeof samples / sizeof *samples; ++i)
    *samples[i] = workspace_doubles(&s->memory, (size_t)n_time);
  s->symbol = workspace_doubles(&s->memory, (size_t)force_jacobian_symbol_length(n_harm));
  s->X = workspace_doubles(&s->memory, (size_t)series_length(n_harm));
  const hc_status st = period_samples_make(n_harm, n_time, &s->memory, &s->of);
  if (st == HC_OK) *self = s;
  else free_spring(s);
  return st;
}

static hc_status make_exact(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  return make_with(c, how->n_harm, (degree_of(&c->moved.law) + 1) * how->n_harm + 1, self);
}

static hc_status make_sampled(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  return make_with(c, how->n_harm, how->n_time, self);
}

static void jacobian(void *self, double *jac)
{
  spring *s = self;
  const size_t n = (size_t)series_length(s->n_harm);
  period_samples_series(&s->of, s->k, 2 * s->n_harm, s->symbol);
  memset(jac, 0, n * n * sizeof *jac);
  force_jacobian_add(s->n_harm, s->symbol, (int)n, jac);
}

static hc_status evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  spring *s = self;
  double sum = 0;
  period_samples_of(&s->of, X, s->v);
  memcpy(s->X, X, (size_t)series_length(s->n_harm) * sizeof *X);
  for (int i = 0; i < s->of.n_time; ++i) {
    s->f[i] = s->normal * contact_polynomial(&s->law, s->normal * s->v[i], &s->k[i]);
    s->k[i] *= s->normal * s->normal;
    sum += fabs(s->f[i]) + fabs(s->k[i]);
  }
  *report = (contact_report){.regime = CONTACT_BENDS};
  if (!isfinite(sum)) return HC_NOT_FINITE;
  period_samples_series(&s->of, s->f, s->n_harm, F);
  if (jac) jacobian(self, jac);
  return HC_OK;
}

static void sliders(const void *self, double *w) { (void)self, *w = 0; }

static const contact_interval *intervals(const void *self, int *n) { return (void)self, *n = 0, NULL; }

static contact_slopes slopes(const void *self, double th, double omega)
{
  (void)omega;
  const spring *s = self;
  contact_slopes at = {0};
  const double v = s->normal * series_at(s->n_harm, s->X, cos(th), sin(th)).x;
  contact_polynomial(&s->law, v, &at.n_v);
  at.step = 6.0 / ((degree_of(&s->law) - 1) * s->n_harm);
  return at;
}

const contact_evaluator polynomial_evaluator = {.make = make_exact,
                                                .free = free_spring,
                                                .evaluate = evaluate,
                                                .jacobian = jacobian,
                                                .sliders = sliders,
                                                .intervals = intervals,
                                                .slopes = slopes};
const contact_evaluator polynomial_sampled_evaluator = {
    .make = make_sampled, .free = free_spring, .evaluate = evaluate, .jacobian = jacobian, .sliders = sliders};

hc_status polynomial_measures_of(const contact *law, int n_harm, const double *u, const double *u_2, const double *v,
                                 contact_period *out)
{
  const int all = degree_of(law) * n_harm, n = series_length(n_harm);
  const contact_coordinates along = {.n_dof = 1, .moved = {.law = *law, .cv = {1}}};
  contact_report report;
  void *self;
  (void)u, (void)u_2;
  *out = (contact_period){.regime = CONTACT_BENDS};
  hc_status st = make_with(&along, n_harm, 2 * all + 1, &self);
  double *F = calloc((size_t)series_length(all) + (size_t)n, sizeof *F);
  if (st == HC_OK) st = F ? evaluate(self, v, F, NULL, &report) : HC_NO_MEMORY;
  if (st == HC_OK) {
    const spring *s = self;
    period_samples_series(&s->of, s->f, all, F); /* the whole force: the two have room for it */
    series_extrema(all, F, &out->normal_max, &out->normal_min);
  }
  free_spring(self);
  free(F);
  return st;
}
