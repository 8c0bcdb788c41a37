/* aft.c - see aft.h.
 *   X -> x(th_i), th_i = 2 pi i/N -> u_i, v_i -> two periods of the contact law, the first only settles w -> F_i -> F
 * The contacts are followed by slider.c: the slider after a separation starts from the interpolated instant of contact,
 * or (the paper's way) from the last separated sample. Jacobian, only when it is asked for: dF_i = k_i dx_i - kt
 * cu dw, k_i by one more FFT, dw constant over a stick interval (force_jacobian.h). With two coordinates the entries of
 * k_i that do not vanish are constant on an interval, and summed in closed form. Not here:
 * the dynamic stiffness (system.c). */
#include "hbm/contact/aft.h"

#include <string.h>

#include "hbm/contact/fft_plan.h"
#include "hbm/contact/force_jacobian.h"
#include "hbm/contact/slider.h"
#include "numerics/base/workspace.h"

struct aft {
  int n_dof, n_contacts;
  moving_contact *contacts; /* [n_contacts] */
  int n_harm, n_time;
  slider_rule slider;
  double *x, *f, *k;        /* [n_time]     displacement [length], force, its stiffness along the orbit */
  double *y;                /* [n_time]     of two coordinates the second */
  period_samples of;        /* its sample:  force of one contact */
  double complex *inv_step; /* [2H+1]       1/(exp(i h 2 pi/N) - 1), for sums over sample ranges */
  double *symbol;           /* [4H+1]       series of k */
  double *left, *right;     /* [2H+1]       one rank-1 term; right: [n_dof][2H+1] */
  sampled_interval
      *intervals;             /* [n_contacts][n_time] of the last evaluation, the first n_intervals[j] of each filled */
  sampled_interval *settling; /* [n_time] */
  int *n_intervals;           /* [n_contacts] */
  workspace memory;           /* of all of these */
};

/* n_dof = 1: all contacts are moved by one coordinate; 2: there is one, and the coordinates are its u and v. */
static hc_status make_aft(const evaluator_settings *how, int n_dof, int n_contacts, const moving_contact *contacts,
                          aft **out)
{
  const int n_harm = how->n_harm, n_time = how->n_time;
  *out = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || n_time < 2 * n_harm + 1) return HC_BAD_INPUT;
  if (n_dof < 1 || n_dof > 2 || n_contacts < 0 || (n_dof == 2 && n_contacts != 1)) return HC_BAD_INPUT;
  aft *a = calloc(1, sizeof *a);
  if (!a) return HC_NO_MEMORY;
  a->n_harm = n_harm;
  a->n_time = n_time;
  a->slider = how->slider;
  a->n_dof = n_dof;
  a->n_contacts = n_contacts;
  a->contacts = workspace_array(&a->memory, (size_t)n_contacts + 1, sizeof *a->contacts);
  hc_status st = a->contacts ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK && n_contacts) memcpy(a->contacts, contacts, (size_t)n_contacts * sizeof *contacts);
  if (st == HC_OK) {
    const size_t n = (size_t)a->n_time, n_coef = (size_t)series_length(a->n_harm);
    workspace *w = &a->memory;
    double **const samples[] = {&a->x, &a->f, &a->k, &a->y};
    for (size_t i = 0; i < sizeof samples / sizeof *samples; ++i) *samples[i] = workspace_doubles(w, n);
    a->inv_step = workspace_array(w, 2 * (size_t)a->n_harm + 1, sizeof *a->inv_step);
    a->symbol = workspace_doubles(w, (size_t)force_jacobian_symbol_length(a->n_harm));
    a->left = workspace_doubles(w, n_coef);
    a->right = workspace_doubles(w, (size_t)a->n_dof * n_coef);
    a->intervals = workspace_array(w, (size_t)a->n_contacts * n + 1, sizeof *a->intervals); /* few are used */
    a->settling = workspace_array(w, n, sizeof *a->settling);
    a->n_intervals = workspace_array(w, (size_t)a->n_contacts + 1, sizeof *a->n_intervals);
    st = period_samples_make(a->n_harm, a->n_time, w, &a->of);
    for (int h = 1; h <= 2 * a->n_harm && st == HC_OK; ++h)
      a->inv_step[h] = 1 / (a->of.root[h % a->n_time] - 1); /* 2 H < N */
  }
  if (st == HC_OK) {
    *out = a;
    return HC_OK;
  }
  aft_free(a);
  return st;
}

hc_status aft_new_of_model(const model *m, hbm_restart restart, int n_harm, int n_time, aft **out)
{
  const evaluator_settings how = {.n_harm = n_harm, .n_time = n_time, .slider = {.restart = restart}};
  moving_contact *contacts;
  *out = NULL;
  hc_status st = moving_contacts_of_model(m, &contacts);
  if (st == HC_OK) st = make_aft(&how, 1, m->n_contacts, contacts, out);
  free(contacts);
  return st;
}

void aft_free(aft *a)
{
  if (!a) return;
  period_samples_clear(&a->of);
  workspace_free(&a->memory);
  free(a);
}

/* ---- the force's Jacobian -------------------------------------------------------------------- */

static int aft_end_of_interval(const aft *a, int j, int m)
{
  const sampled_interval *s = a->intervals + (size_t)j * (size_t)a->n_time;
  return m + 1 < a->n_intervals[j] ? s[m + 1].first : a->n_time;
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
static void aft_subtract_stick(aft *a, const moving_contact *c, const slider_origin *o, int first, int end, double *jac)
{
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
  for (int m = 0; m < a->n_intervals[0]; ++m)
    if (stiffness[s[m].state] != 0)
      aft_add_interval(a, 2 * a->n_harm, stiffness[s[m].state], s[m].first, aft_end_of_interval(a, 0, m), a->symbol);
  force_jacobian_add(a->n_harm, a->symbol, 2 * series_length(a->n_harm), block);
}

/* dF/dX, at the last evaluation, which ended with HC_OK. */
static void aft_jacobian(void *self, double *jac)
{
  aft *a = self;
  const size_t rows = (size_t)a->n_dof * (size_t)series_length(a->n_harm);
  memset(jac, 0, rows * rows * sizeof(double));
  if (a->n_dof > 1) {
    const contact *law = &a->contacts[0].law;
    const size_t n_coef = (size_t)series_length(a->n_harm), block = 2 * n_coef;
    const double friction = law->mu * law->kn;
    add_block(a, (double[4]){[CONTACT_STICK] = law->kt}, jac); /* dT/du */
    add_block(a, (double[4]){[CONTACT_SLIP_PLUS] = friction, [CONTACT_SLIP_MINUS] = -friction}, jac + block * n_coef);
    add_block(a, (double[4]){0, law->kn, law->kn, law->kn}, jac + block * n_coef + n_coef); /* d(N - N0)/dv */
  } else {
    if (a->n_contacts == 0) memset(a->k, 0, (size_t)a->n_time * sizeof(double));
    for (int j = 0; j < a->n_contacts; ++j)
      for (int m = 0; m < a->n_intervals[j]; ++m) {
        const sampled_interval *s = a->intervals + (size_t)j * (size_t)a->n_time + m;
        const int end = aft_end_of_interval(a, j, m);
        const double stiffness = stiffness_in(&a->contacts[j], s->state);
        for (int i = s->first; i < end; ++i) a->k[i] = j ? a->k[i] + stiffness : stiffness;
      }
    period_samples_series(&a->of, a->k, 2 * a->n_harm, a->symbol);
    force_jacobian_add(a->n_harm, a->symbol, series_length(a->n_harm), jac);
  }
  for (int j = 0; j < a->n_contacts; ++j) {
    const sampled_interval *s = a->intervals + (size_t)j * (size_t)a->n_time;
    for (int m = 0; m < a->n_intervals[j]; ++m)
      if (s[m].state == CONTACT_STICK)
        aft_subtract_stick(a, &a->contacts[j], &s[m].origin, s[m].first, aft_end_of_interval(a, j, m), jac);
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

hc_status aft_eval(aft *a, const double *X, double *F, double *jac, contact_report *report)
{
  contact_report local;
  const int n_coef = series_length(a->n_harm);
  if (!report) report = &local;
  *report = (contact_report){.regime = CONTACT_LINEAR};
  double size = 0; /* bounds |x| */
  for (int i = 0; i < a->n_dof * n_coef; ++i) size += fabs(X[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  period_samples_of(&a->of, X, a->x);
  if (a->n_dof > 1) period_samples_of(&a->of, X + n_coef, a->y);
  if (a->n_contacts == 0) memset(a->f, 0, (size_t)a->n_time * sizeof(double));
  hc_status st = HC_OK;
  /* One step of the law maps w to the nearest point of an interval, and so does a whole period: applied once more it
   * changes nothing, so the slider is periodic in the second. That it is not can only be rounding or a defect. */
  for (int j = 0; j < a->n_contacts && st == HC_OK; ++j) {
    const moving_contact *c = &a->contacts[j];
    sampled_interval *s = a->intervals + (size_t)j * (size_t)a->n_time;
    double *f = j == 0 ? a->f : a->of.sample, *again = a->k; /* k is made afterwards, if at all */
    slider_motion motion = {a->x, a->x, c->cu[0], c->cv[0], c->cu[0], c->cv[0]};
    if (a->n_dof > 1)
      motion = (slider_motion){a->x, a->y, 1, 1, 1, 0}; /* the force on u, where v is another coordinate */
    slider_report found = slider_follow(&c->law, &a->slider, a->n_time, &motion, f, again, s, a->settling);
    a->n_intervals[j] = found.n_intervals;
    for (int i = 0; i < a->n_time && j > 0; ++i) a->f[i] += a->of.sample[i];
    contact_regime regime = regime_of(found.n_intervals, s);
    if (regime > report->regime) report->regime = regime;
    report->transitions += found.transitions;
    report->free_sliders += regime == CONTACT_STUCK && moving_contact_has_slider(c, a->n_dof);
    st = fabs(found.w - found.settled) <= 1e-12 * (fabs(found.settled) + size) ? HC_OK : HC_NOT_CLOSED;
  }
  if (st != HC_OK) return st;
  period_samples_series(&a->of, a->f, a->n_harm, F);
  if (a->n_dof > 1) { /* N - N0: its contact's T is in the first coordinate */
    for (int i = 0; i < a->n_time; ++i) a->f[i] = contact_normal_change(&a->contacts->law, a->y[i]);
    period_samples_series(&a->of, a->f, a->n_harm, F + n_coef);
  }
  if (jac) aft_jacobian(a, jac);
  return HC_OK;
}

void aft_sliders(const aft *a, double *w)
{
  for (int j = 0; j < a->n_contacts; ++j) w[j] = a->intervals[(size_t)j * (size_t)a->n_time].w;
}

/* ---- as one of contact_evaluator.h -------------------------------------------------------------------- */

static hc_status aft_make(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  aft *a;
  const hc_status st = make_aft(how, c->n_dof, 1, &c->moved, &a);
  *self = a;
  return st;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): the signature is contact_evaluator.h's */
static hc_status aft_evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  (void)jac; /* `jacobian` makes it */
  return aft_eval(self, X, F, NULL, report);
}

static void aft_let_go(void *self) { aft_free(self); }
static void aft_ask_sliders(const void *self, double *w) { aft_sliders(self, w); }
static void aft_start(void *self, const double *w) { ((aft *)self)->slider.start = *w; }

const contact_evaluator aft_evaluator = {.make = aft_make,
                                         .free = aft_let_go,
                                         .evaluate = aft_evaluate,
                                         .jacobian = aft_jacobian,
                                         .sliders = aft_ask_sliders,
                                         .start = aft_start};
