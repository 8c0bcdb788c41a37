/* aft.c - contact force harmonics from displacement harmonics by sampling (alternating frequency/time).
 *   X -> x(th_i), th_i = 2 pi i/N -> u_i, v_i -> two periods of the contact law, the first only settles w -> F_i -> F
 * N >= 2H + 1, even or odd, else HC_BAD_INPUT. The contact is followed by slider.c: the slider after a separation
 * starts from the interpolated instant of contact, or (the paper's way) from the last separated sample. Jacobian of the
 * sampled F, aliasing included, only when it is asked for: dF_i = k_i dx_i - kt cu dw, k_i by one more FFT, dw constant
 * over a stick interval (force_jacobian.h). With two coordinates the entries of k_i that do not vanish are constant on
 * an interval, and summed in closed form. Evaluating allocates nothing: HC_NOT_FINITE if X is not finite;
 * HC_NOT_CLOSED if the slider did not return to where it was a period before. Not here: the dynamic stiffness
 * (system.c). */
#include <string.h>

#include "hbm/contact/contact_evaluator.h"
#include "hbm/contact/fft_plan.h"
#include "hbm/contact/force_jacobian.h"
#include "hbm/contact/slider.h"
#include "numerics/base/workspace.h"

typedef struct aft {
  int n_dof, n_harm, n_time;
  moving_contact contact;
  slider_rule slider;
  double *x, *f, *k; /* [n_time]     displacement [length], force, its stiffness along the orbit */
  double *y;         /* [n_time]     of two coordinates the second */
  period_samples of;
  double complex *inv_step;    /* [2H+1]       1/(exp(i h 2 pi/N) - 1), for sums over sample ranges */
  double *symbol;              /* [4H+1]       series of k */
  double *left, *right;        /* [2H+1]       one rank-1 term; right: [n_dof][2H+1] */
  sampled_interval *intervals; /* [n_time]    of the last evaluation, the first n_intervals */
  sampled_interval *settling;  /* [n_time] */
  int n_intervals;
  workspace memory; /* of all of these */
} aft;

static void aft_free(void *self)
{
  aft *a = self;
  if (!a) return;
  period_samples_clear(&a->of);
  workspace_free(&a->memory);
  free(a);
}

/* n_dof = 2: the coordinates are u and v. */
static hc_status aft_make(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  const int n_harm = how->n_harm, n_time = how->n_time;
  *self = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || n_time < 2 * n_harm + 1) return HC_BAD_INPUT;
  if (c->n_dof < 1 || c->n_dof > 2) return HC_BAD_INPUT;
  aft *a = calloc(1, sizeof *a);
  if (!a) return HC_NO_MEMORY;
  a->n_harm = n_harm;
  a->n_time = n_time;
  a->slider = how->slider;
  a->n_dof = c->n_dof;
  a->contact = c->moved;
  const size_t n = (size_t)n_time, n_coef = (size_t)series_length(n_harm);
  workspace *w = &a->memory;
  double **const samples[] = {&a->x, &a->f, &a->k, &a->y};
  for (size_t i = 0; i < sizeof samples / sizeof *samples; ++i) *samples[i] = workspace_doubles(w, n);
  a->inv_step = workspace_array(w, 2 * (size_t)n_harm + 1, sizeof *a->inv_step);
  a->symbol = workspace_doubles(w, (size_t)force_jacobian_symbol_length(n_harm));
  a->left = workspace_doubles(w, n_coef);
  a->right = workspace_doubles(w, (size_t)a->n_dof * n_coef);
  a->intervals = workspace_array(w, n, sizeof *a->intervals); /* few are used */
  a->settling = workspace_array(w, n, sizeof *a->settling);
  const hc_status st = period_samples_make(n_harm, n_time, w, &a->of);
  for (int h = 1; h <= 2 * n_harm && st == HC_OK; ++h) a->inv_step[h] = 1 / (a->of.root[h % n_time] - 1); /* 2 H < N */
  if (st == HC_OK) *self = a;
  else aft_free(a);
  return st;
}

/* ---- the force's Jacobian -------------------------------------------------------------------- */

static int aft_end_of_interval(const aft *a, int m)
{
  return m + 1 < a->n_intervals ? a->intervals[m + 1].first : a->n_time;
}

/* to[] += series, n_harm harmonics, of `weight` over the samples first..end-1 and 0 elsewhere: geometric sums. */
static void aft_add_interval(const aft *a, int n_harm, double weight, int first, int end, double *to)
{
  const int n = a->n_time;
  int at_first = 0, at_end = 0; /* h times the sample, modulo n */
  weight /= n;
  to[0] += weight * (end - first);
  for (int h = 1; h <= n_harm; ++h) {
    if ((at_first += first) >= n) at_first -= n;
    if ((at_end += end) >= n) at_end -= n;
    double complex sum = (a->of.root[at_end] - a->of.root[at_first]) * a->inv_step[h];
    to[2 * h - 1] += 2 * weight * creal(sum);
    to[2 * h] += 2 * weight * cimag(sum);
  }
}

/* kt dw over the samples first..end-1 of a stuck slider, taken from the rows of the first coordinate. */
static void aft_subtract_stick(aft *a, const slider_origin *o, int first, int end, double *jac)
{
  const moving_contact *c = &a->contact;
  const int n_coef = series_length(a->n_harm), rows = a->n_dof * n_coef, next = o->i + 1 < a->n_time ? o->i + 1 : 0;
  const double along = a->n_dof > 1 ? 1 : c->cu[0];
  double *of_along = a->right, *of_across = a->right + (a->n_dof - 1) * n_coef;
  double parts = 0;
  for (int k = 0; k < 2; ++k) parts = fmax(parts, fmax(fabs(o->by_along[k]), fabs(o->by_across[k])));
  if (parts == 0) return;
  memset(a->left, 0, (size_t)n_coef * sizeof(double));
  memset(a->right, 0, (size_t)rows * sizeof(double));
  aft_add_interval(a, a->n_harm, c->law.kt * along, first, end, a->left);
  if (a->n_dof == 1) period_samples_add(&a->of, o->by_along[0] + o->by_across[0], o->i, a->right);
  for (int k = 0; k < 2 && a->n_dof > 1; ++k) {
    period_samples_add(&a->of, o->by_along[k], k ? next : o->i, of_along);
    period_samples_add(&a->of, o->by_across[k], k ? next : o->i, of_across);
  }
  for (int q = 0; q < rows; ++q)
    for (int p = 0; p < n_coef; ++p) jac[(size_t)q * (size_t)rows + (size_t)p] -= a->left[p] * a->right[q];
}

/* dF_i/dx_i at fixed w, of one coordinate. */
static double stiffness_in(const moving_contact *c, contact_state state)
{
  const contact *law = &c->law;
  const double tangent = c->cu[0], normal = c->cv[0];
  int slip = contact_slip_sign(state);
  if (state == CONTACT_SEPARATED) return 0;
  return (slip ? slip * law->mu * law->kn * normal : law->kt * tangent) * tangent + law->kn * normal * normal;
}

/* One block of the Jacobian from its stiffness in every contact_state. */
static void add_block(aft *a, const double stiffness[4], double *block)
{
  const sampled_interval *s = a->intervals;
  memset(a->symbol, 0, (size_t)force_jacobian_symbol_length(a->n_harm) * sizeof(double));
  for (int m = 0; m < a->n_intervals; ++m)
    if (stiffness[s[m].state] != 0)
      aft_add_interval(a, 2 * a->n_harm, stiffness[s[m].state], s[m].first, aft_end_of_interval(a, m), a->symbol);
  force_jacobian_add(a->n_harm, a->symbol, 2 * series_length(a->n_harm), block);
}

/* dF/dX, at the last evaluation, which ended with HC_OK. */
static void aft_jacobian(void *self, double *jac)
{
  aft *a = self;
  const size_t rows = (size_t)a->n_dof * (size_t)series_length(a->n_harm);
  memset(jac, 0, rows * rows * sizeof(double));
  if (a->n_dof > 1) {
    const contact *law = &a->contact.law;
    const size_t n_coef = (size_t)series_length(a->n_harm), block = 2 * n_coef;
    const double friction = law->mu * law->kn;
    add_block(a, (double[4]){[CONTACT_STICK] = law->kt}, jac); /* dT/du */
    add_block(a, (double[4]){[CONTACT_SLIP_PLUS] = friction, [CONTACT_SLIP_MINUS] = -friction}, jac + block * n_coef);
    add_block(a, (double[4]){0, law->kn, law->kn, law->kn}, jac + block * n_coef + n_coef); /* d(N - N0)/dv */
  } else {
    for (int m = 0; m < a->n_intervals; ++m) {
      const sampled_interval *s = &a->intervals[m];
      const int end = aft_end_of_interval(a, m);
      const double stiffness = stiffness_in(&a->contact, s->state);
      for (int i = s->first; i < end; ++i) a->k[i] = stiffness;
    }
    period_samples_series(&a->of, a->k, 2 * a->n_harm, a->symbol);
    force_jacobian_add(a->n_harm, a->symbol, series_length(a->n_harm), jac);
  }
  for (int m = 0; m < a->n_intervals; ++m) {
    const sampled_interval *s = &a->intervals[m];
    if (s->state == CONTACT_STICK) aft_subtract_stick(a, &s->origin, s->first, aft_end_of_interval(a, m), jac);
  }
}

/* ---- the force ------------------------------------------------------------------------------- */

static contact_regime regime_of(int n, const sampled_interval *s)
{
  bool separates = false, slips = false, touches = false;
  for (int k = 0; k < n; ++k) {
    separates |= s[k].state == CONTACT_SEPARATED;
    slips |= contact_slip_sign(s[k].state) != 0;
    touches |= s[k].state != CONTACT_SEPARATED;
  }
  if (separates) return touches ? CONTACT_SEPARATES : CONTACT_LINEAR;
  return slips ? CONTACT_SLIPS : CONTACT_STUCK;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): the signature is contact_evaluator.h's */
static hc_status aft_evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  aft *a = self;
  const moving_contact *c = &a->contact;
  const int n_coef = series_length(a->n_harm);
  (void)jac; /* `jacobian` makes it */
  *report = (contact_report){.regime = CONTACT_LINEAR};
  double size = 0; /* bounds |x| */
  for (int i = 0; i < a->n_dof * n_coef; ++i) size += fabs(X[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  period_samples_of(&a->of, X, a->x);
  if (a->n_dof > 1) period_samples_of(&a->of, X + n_coef, a->y);
  slider_motion motion = {a->x, a->x, c->cu[0], c->cv[0], c->cu[0], c->cv[0]};
  if (a->n_dof > 1)
    motion = (slider_motion){a->x, a->y, 1, 1, 1, 0}; /* the force on u, where v is another coordinate */
  double *again = a->k;                               /* k is made afterwards, if at all */
  const slider_report found =
      slider_follow(&c->law, &a->slider, a->n_time, &motion, a->f, again, a->intervals, a->settling);
  a->n_intervals = found.n_intervals;
  report->regime = regime_of(found.n_intervals, a->intervals);
  report->transitions = found.transitions;
  report->free_sliders = report->regime == CONTACT_STUCK && moving_contact_has_slider(c, a->n_dof);
  /* One step of the law maps w to the nearest point of an interval, and so does a whole period: applied once more it
   * changes nothing, so the slider is periodic in the second. That it is not can only be rounding or a defect. */
  if (!(fabs(found.w - found.settled) <= 1e-12 * (fabs(found.settled) + size))) return HC_NOT_CLOSED;
  period_samples_series(&a->of, a->f, a->n_harm, F);
  if (a->n_dof > 1) { /* N - N0: T is in the first coordinate */
    for (int i = 0; i < a->n_time; ++i) a->f[i] = contact_normal_change(&c->law, a->y[i]);
    period_samples_series(&a->of, a->f, a->n_harm, F + n_coef);
  }
  return HC_OK;
}

static void aft_sliders(const void *self, double *w) { *w = ((const aft *)self)->intervals->w; }
static void aft_start(void *self, const double *w) { ((aft *)self)->slider.start = *w; }

const contact_evaluator aft_evaluator = {.make = aft_make,
                                         .free = aft_free,
                                         .evaluate = aft_evaluate,
                                         .jacobian = aft_jacobian,
                                         .sliders = aft_sliders,
                                         .start = aft_start};
