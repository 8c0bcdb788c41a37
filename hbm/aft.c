/* aft.c - see aft.h.
 *   X -> x(th_i), th_i = 2 pi i/N -> u_i, v_i -> two periods of the contact law, the first only settles w -> F_i -> F
 * The contacts are followed by slider.c: the slider after a separation starts from the interpolated instant of contact,
 * or (the paper's way) from the last separated sample. Jacobian, only when it is asked for: dF_i = k_i dx_i - kt
 * cos(alpha) dw, k_i by one more FFT, dw constant over a stick interval (force_jacobian.h). FFTW does not normalise and
 * uses exp(-i): the 2/N and the sign of the sine are in to_series() and to_samples(), nowhere else. Not here: the
 * dynamic stiffness (system.c). */
#include "hbm/aft.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/fft_plan.h"
#include "hbm/force_jacobian.h"
#include "hbm/slider.h"

struct aft {
  model *model;
  int n_harm, n_time;
  hbm_restart restart;
  double *x, *f, *k;  /* [n_time]     displacement [length], force, its stiffness along the orbit */
  double *part;       /* [n_time]     force of one contact */
  fftw_complex *spec; /* [n_time/2+1] consumed by to_time (c2r overwrites its input) */
  fftw_plan to_time, to_freq_f, to_freq_k;
  double complex *root;     /* [n_time]     exp(i th_i) */
  double complex *inv_step; /* [n_harm+1]   1/(exp(i h 2 pi/N) - 1), for sums over sample ranges */
  double *symbol;           /* [4H+1]       series of k */
  double *left, *right;     /* [2H+1]       one rank-1 term */
  stretch *stretches;       /* [n_contacts][n_time] of the last evaluation, the first n_stretches[j] of each filled */
  stretch *settling;        /* [n_time] */
  int *n_stretches;         /* [n_contacts] */
};

static hc_status make_plans(aft *a)
{
  hc_status st = fft_plan_to_samples(a->n_time, a->spec, a->x, &a->to_time);
  if (st == HC_OK) st = fft_plan_to_spectrum(a->n_time, a->f, a->spec, &a->to_freq_f);
  if (st == HC_OK) st = fft_plan_to_spectrum(a->n_time, a->k, a->spec, &a->to_freq_k);
  return st;
}

static hc_status make_tables(aft *a)
{
  int n = a->n_time, n_coef = series_length(a->n_harm);
  a->x = fftw_alloc_real((size_t)n);
  a->f = fftw_alloc_real((size_t)n);
  a->k = fftw_alloc_real((size_t)n);
  a->part = fftw_alloc_real((size_t)n);
  a->spec = fftw_alloc_complex((size_t)n / 2 + 1);
  a->root = malloc((size_t)n * sizeof *a->root);
  a->inv_step = malloc(((size_t)a->n_harm + 1) * sizeof *a->inv_step);
  a->symbol = calloc((size_t)force_jacobian_symbol_length(a->n_harm), sizeof(double));
  a->left = calloc((size_t)n_coef, sizeof(double));
  a->right = calloc((size_t)n_coef, sizeof(double));
  a->stretches = malloc(((size_t)a->model->n_contacts * (size_t)n + 1) * sizeof *a->stretches); /* few are used */
  a->settling = malloc((size_t)n * sizeof *a->settling);
  a->n_stretches = calloc((size_t)a->model->n_contacts + 1, sizeof *a->n_stretches);
  bool samples = a->x && a->f && a->k && a->part && a->spec && a->root, harmonics = a->inv_step && a->symbol;
  bool tracks = a->stretches && a->settling && a->n_stretches;
  if (!tracks || !samples || !harmonics || !a->left || !a->right) return HC_NO_MEMORY;
  const double step = TWO_PI / n;
  for (int i = 0; i < n; ++i) a->root[i] = cos(i * step) + I * sin(i * step);
  for (int h = 1; h <= a->n_harm; ++h) a->inv_step[h] = 1 / (a->root[h % n] - 1);
  return HC_OK;
}

hc_status aft_new(const model *m, hbm_restart restart, int n_harm, int n_time, aft **out)
{
  *out = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || n_time < 2 * n_harm + 1) return HC_BAD_INPUT;
  aft *a = calloc(1, sizeof *a);
  if (!a) return HC_NO_MEMORY;
  a->n_harm = n_harm;
  a->n_time = n_time;
  a->restart = restart;
  hc_status st = model_copy(m, &a->model);
  if (st == HC_OK) st = make_tables(a);
  if (st == HC_OK) st = make_plans(a);
  if (st == HC_OK) {
    *out = a;
    return HC_OK;
  }
  aft_free(a);
  return st;
}

void aft_free(aft *a)
{
  if (!a) return;
  model_free(a->model);
  fft_plan_free(a->to_time);
  fft_plan_free(a->to_freq_f);
  fft_plan_free(a->to_freq_k);
  fftw_free(a->x);
  fftw_free(a->f);
  fftw_free(a->k);
  fftw_free(a->part);
  fftw_free(a->spec);
  free(a->root);
  free(a->inv_step);
  free(a->symbol);
  free(a->left);
  free(a->right);
  free(a->stretches);
  free(a->settling);
  free(a->n_stretches);
  free(a);
}

static void to_samples(aft *a, const double *X)
{
  memset(a->spec, 0, ((size_t)a->n_time / 2 + 1) * sizeof *a->spec);
  a->spec[0] = X[0];
  for (int h = 1; h <= a->n_harm; ++h) a->spec[h] = 0.5 * (X[2 * h - 1] - I * X[2 * h]);
  fftw_execute(a->to_time);
}

/* The first n_harm <= 2 H < N harmonics of the samples behind plan. Above N/2 a harmonic reads its alias, as the
 * sampled sums themselves do. */
static void to_series(aft *a, fftw_plan plan, int n_harm, double *out)
{
  int n = a->n_time;
  fftw_execute(plan);
  out[0] = creal(a->spec[0]) / n;
  for (int h = 1; h <= n_harm; ++h) {
    double complex z = h <= n / 2 ? a->spec[h] : conj(a->spec[n - h]);
    out[2 * h - 1] = 2 * creal(z) / n;
    out[2 * h] = -2 * cimag(z) / n;
  }
}

/* ---- the force ------------------------------------------------------------------------------- */

static contact_regime regime_of(int n, const stretch *s)
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

/* One step of the law maps w to the nearest point of an interval, and so does a whole period: applied once more it
 * changes nothing, so the slider is periodic in the second. That it is not can only be rounding or a defect. */
static hc_status evaluate_contact(aft *a, int j, double size, contact_report *report)
{
  stretch *s = a->stretches + (size_t)j * (size_t)a->n_time;
  double *f = j == 0 ? a->f : a->part, *again = a->k; /* k is made afterwards, if at all */
  slider_report found = slider_follow(&a->model->contacts[j], a->restart, a->n_time, a->x, f, again, s, a->settling);
  a->n_stretches[j] = found.n_stretches;
  for (int i = 0; i < a->n_time && j > 0; ++i) a->f[i] += a->part[i];
  contact_regime regime = regime_of(found.n_stretches, s);
  if (regime > report->regime) report->regime = regime;
  report->transitions += found.transitions;
  const model_contact *c = &a->model->contacts[j];
  report->free_sliders += regime == CONTACT_STUCK && contact_has_friction(&c->law) && c->tangent != 0;
  return fabs(found.w - found.settled) <= 1e-12 * (fabs(found.settled) + size) ? HC_OK : HC_NOT_CLOSED;
}

hc_status aft_eval(aft *a, const double *X, double *F, double *jac, contact_report *report)
{
  contact_report local;
  if (!report) report = &local;
  *report = (contact_report){.regime = CONTACT_LINEAR};
  double size = 0; /* bounds |x| */
  for (int i = 0; i < series_length(a->n_harm); ++i) size += fabs(X[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  to_samples(a, X);
  if (a->model->n_contacts == 0) memset(a->f, 0, (size_t)a->n_time * sizeof(double));
  hc_status st = HC_OK;
  for (int j = 0; j < a->model->n_contacts && st == HC_OK; ++j) st = evaluate_contact(a, j, size, report);
  if (st != HC_OK) return st;
  to_series(a, a->to_freq_f, a->n_harm, F);
  if (jac) aft_jacobian(a, jac);
  return HC_OK;
}

void aft_sliders(const aft *a, double *w)
{
  for (int j = 0; j < a->model->n_contacts; ++j) w[j] = a->stretches[(size_t)j * (size_t)a->n_time].w;
}

/* ---- its Jacobian ---------------------------------------------------------------------------- */

/* Series of kt cos(alpha) over the samples first..last: geometric sums, minus their rank-1 effect on jac. */
static void subtract_stick_interval(aft *a, const model_contact *c, const slider_origin *o, int first, int last,
                                    double *jac)
{
  if (o->by_x == 0) return;
  int n = a->n_time, at_first = 0, at_end = 0, at_origin = 0; /* h times the sample, modulo n */
  double weight = c->law.kt * c->tangent / n;
  a->left[0] = weight * (last - first + 1);
  a->right[0] = o->by_x;
  for (int h = 1; h <= a->n_harm; ++h) {
    if ((at_first += first) >= n) at_first -= n;
    if ((at_end += last + 1) >= n) at_end -= n;
    if ((at_origin += o->i) >= n) at_origin -= n;
    double complex sum = (a->root[at_end] - a->root[at_first]) * a->inv_step[h];
    double complex right = o->by_x * a->root[at_origin];
    a->left[2 * h - 1] = 2 * weight * creal(sum);
    a->left[2 * h] = 2 * weight * cimag(sum);
    a->right[2 * h - 1] = creal(right);
    a->right[2 * h] = cimag(right);
  }
  force_jacobian_subtract(a->n_harm, a->left, a->right, jac);
}

/* dF_i/dx_i at fixed w. */
static double stiffness_in(const model_contact *c, contact_state state)
{
  const contact *law = &c->law;
  int slip = contact_slip_sign(state);
  if (state == CONTACT_SEPARATED) return 0;
  return (slip ? slip * law->mu * law->kn * c->normal : law->kt * c->tangent) * c->tangent +
         law->kn * c->normal * c->normal;
}

/* Adds the stiffness of contact j to k, and subtracts each stick interval's rank-1 term from jac. */
static void differentiate_contact(aft *a, int j, double *jac)
{
  const model_contact *c = &a->model->contacts[j];
  const stretch *s = a->stretches + (size_t)j * (size_t)a->n_time;
  for (int m = 0; m < a->n_stretches[j]; ++m) {
    int end = m + 1 < a->n_stretches[j] ? s[m + 1].first : a->n_time;
    double stiffness = stiffness_in(c, s[m].state);
    for (int i = s[m].first; i < end; ++i) a->k[i] += stiffness;
    if (s[m].state == CONTACT_STICK) subtract_stick_interval(a, c, &s[m].origin, s[m].first, end - 1, jac);
  }
}

void aft_jacobian(aft *a, double *jac)
{
  int n_coef = series_length(a->n_harm);
  memset(a->k, 0, (size_t)a->n_time * sizeof(double));
  memset(jac, 0, (size_t)n_coef * n_coef * sizeof(double));
  for (int j = 0; j < a->model->n_contacts; ++j) differentiate_contact(a, j, jac);
  to_series(a, a->to_freq_k, 2 * a->n_harm, a->symbol);
  force_jacobian_add(a->n_harm, a->symbol, n_coef, jac);
}
