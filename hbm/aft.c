/* aft.c - see aft.h.
 *   X -> x(th_i), th_i = 2 pi i/N -> u_i, v_i -> two periods of contact_step, the first only settles w -> F_i -> F
 * The slider after a separation starts from the interpolated instant of contact, or (the paper's way) from the last
 * separated sample. Jacobian: dF_i = k_i dx_i - kt cos(alpha) dw, k_i by one more FFT, dw constant over a stick
 * interval (force_jacobian.h). FFTW does not normalise and uses exp(-i): the 2/N and the sign of the sine are in
 * to_series() and to_samples(), nowhere else. Not here: the dynamic stiffness (system.c). */
#include "hbm/aft.h"

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/fft_plan.h"
#include "hbm/force_jacobian.h"

/* What the slider's position depends on: dw = by_x dx(th_i), with by_x = 0 where the motion does not move it. */
typedef struct slider_origin {
  int i;
  double by_x;
} slider_origin;

struct aft {
  model *model;
  int n_harm, n_time;
  hbm_restart restart;
  double *w;          /* [n_contacts] sliders at th = 0 */
  double *x, *f, *k;  /* [n_time]     displacement [length], force, its stiffness along the orbit */
  fftw_complex *spec; /* [n_time/2+1] consumed by to_time (c2r overwrites its input) */
  fftw_plan to_time, to_freq_f, to_freq_k;
  double complex *root;     /* [n_time]     exp(i th_i) */
  double complex *inv_step; /* [n_harm+1]   1/(exp(i h 2 pi/N) - 1), for sums over sample ranges */
  double *symbol;           /* [4H+1]       series of k */
  double *left, *right;     /* [2H+1]       one rank-1 term */
};

/* One contact while its slider is followed over the samples. */
typedef struct track {
  const model_contact *contact;
  double c, s;          /* u = c x, v = s x */
  double w;             /* slider */
  contact_state state;  /* at the sample before */
  slider_origin origin; /* of w */
} track;

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
  a->w = calloc((size_t)a->model->n_contacts + 1, sizeof(double));
  a->x = fftw_alloc_real((size_t)n);
  a->f = fftw_alloc_real((size_t)n);
  a->k = fftw_alloc_real((size_t)n);
  a->spec = fftw_alloc_complex((size_t)n / 2 + 1);
  a->root = malloc((size_t)n * sizeof *a->root);
  a->inv_step = malloc(((size_t)a->n_harm + 1) * sizeof *a->inv_step);
  a->symbol = calloc((size_t)force_jacobian_symbol_length(a->n_harm), sizeof(double));
  a->left = calloc((size_t)n_coef, sizeof(double));
  a->right = calloc((size_t)n_coef, sizeof(double));
  bool samples = a->x && a->f && a->k && a->spec && a->root, harmonics = a->inv_step && a->symbol;
  if (!a->w || !samples || !harmonics || !a->left || !a->right) return HC_NO_MEMORY;
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
  fftw_free(a->spec);
  free(a->w);
  free(a->root);
  free(a->inv_step);
  free(a->symbol);
  free(a->left);
  free(a->right);
  free(a);
}

static void to_samples(aft *a, const double *X)
{
  memset(a->spec, 0, ((size_t)a->n_time / 2 + 1) * sizeof *a->spec);
  a->spec[0] = X[0];
  for (int h = 1; h <= a->n_harm; ++h) a->spec[h] = 0.5 * (X[2 * h - 1] - I * X[2 * h]);
  fftw_execute(a->to_time);
}

/* The first n_harm harmonics of the samples behind plan. Above N/2 a harmonic reads its alias, as the sampled sums
 * themselves do. */
static void to_series(aft *a, fftw_plan plan, int n_harm, double *out)
{
  int n = a->n_time;
  fftw_execute(plan);
  out[0] = creal(a->spec[0]) / n;
  for (int h = 1; h <= n_harm; ++h) {
    int m = h % n;
    double complex z = m <= n / 2 ? a->spec[m] : conj(a->spec[n - m]);
    out[2 * h - 1] = 2 * creal(z) / n;
    out[2 * h] = -2 * cimag(z) / n;
  }
}

/* On entering contact at sample i after a separated one. Interpolated: w = u on the straight line between the
 * samples where v + gap = 0, which for u = c x and v = s x is -gap c/s, whatever the samples. Else w stays the last
 * separated sample's u. */
static void restart_slider(const aft *a, track *t, int i)
{
  int before = i ? i - 1 : a->n_time - 1;
  bool interpolated = a->restart == HBM_RESTART_INTERPOLATED;
  t->w = interpolated ? -t->contact->law.gap * t->c / t->s : t->c * a->x[before];
  t->origin = (slider_origin){before, interpolated ? 0 : t->c};
}

/* Advance to sample i: the force of this contact there, and the stiffness dF_i/dx_i at fixed w. */
static contact_state advance(const aft *a, track *t, int i, double *force, double *stiffness)
{
  const contact *law = &t->contact->law;
  double u = t->c * a->x[i], v = t->s * a->x[i], traction;
  if (t->state == CONTACT_SEPARATED && contact_normal(law, v) > 0) restart_slider(a, t, i);
  t->state = contact_step(law, u, v, &t->w, &traction);
  int slip = contact_slip_sign(t->state);
  if (slip) t->origin = (slider_origin){i, t->c - slip * law->mu * law->kn * t->s / law->kt};
  *force = traction * t->c + contact_normal_change(law, v) * t->s;
  if (t->state == CONTACT_SEPARATED) *stiffness = 0;
  else *stiffness = (slip ? slip * law->mu * law->kn * t->s : law->kt * t->c) * t->c + law->kn * t->s * t->s;
  return t->state;
}

/* Series of kt cos(alpha) over the samples first..last: geometric sums, minus their rank-1 effect on jac. */
static void subtract_stick_interval(aft *a, const track *t, int first, int last, double *jac)
{
  const slider_origin *o = &t->origin;
  if (o->by_x == 0) return;
  int n = a->n_time;
  double weight = t->contact->law.kt * t->c / n;
  a->left[0] = weight * (last - first + 1);
  a->right[0] = o->by_x;
  for (int h = 1; h <= a->n_harm; ++h) {
    double complex sum = (a->root[(long)h * (last + 1) % n] - a->root[(long)h * first % n]) * a->inv_step[h];
    double complex right = o->by_x * a->root[(long)h * o->i % n];
    a->left[2 * h - 1] = 2 * weight * creal(sum);
    a->left[2 * h] = 2 * weight * cimag(sum);
    a->right[2 * h - 1] = creal(right);
    a->right[2 * h] = cimag(right);
  }
  force_jacobian_subtract(a->n_harm, a->left, a->right, jac);
}

/* The first pass over the period: it only moves the slider. */
static void settle(const aft *a, track *t)
{
  double force, stiffness;
  for (int i = 0; i < a->n_time; ++i) advance(a, t, i, &force, &stiffness);
}

/* The second pass: adds force and stiffness to f and k, and subtracts each stick interval's rank-1 term from jac. */
static void record(aft *a, track *t, double *jac, contact_report *report)
{
  int first = -1; /* of the stick interval under way */
  bool separates = false, slips = false, touches = false;
  for (int i = 0; i < a->n_time; ++i) {
    contact_state before = t->state;
    double force, stiffness;
    track ended = *t; /* the stick interval that this sample may end */
    contact_state now = advance(a, t, i, &force, &stiffness);
    if (i == 0) a->w[t->contact - a->model->contacts] = t->w;
    if (first >= 0 && now != CONTACT_STICK) {
      if (jac) subtract_stick_interval(a, &ended, first, i - 1, jac);
      first = -1;
    }
    if (now == CONTACT_STICK && first < 0) first = i;
    a->f[i] += force;
    a->k[i] += stiffness;
    separates |= now == CONTACT_SEPARATED;
    slips |= contact_slip_sign(now) != 0;
    touches |= now != CONTACT_SEPARATED;
    report->transitions += now != before;
  }
  if (first >= 0 && jac) subtract_stick_interval(a, t, first, a->n_time - 1, jac);
  contact_regime regime = separates ? (touches ? CONTACT_SEPARATES : CONTACT_LINEAR)
                          : slips   ? CONTACT_SLIPS
                                    : CONTACT_STUCK;
  if (regime > report->regime) report->regime = regime;
}

/* One step of the law maps w to the nearest point of an interval, and so does a whole period: applied once more it
 * changes nothing, so the slider is periodic in the second pass. That it is not can only be rounding or a defect. */
static hc_status evaluate_contact(aft *a, int j, double size, double *jac, contact_report *report)
{
  const model_contact *c = &a->model->contacts[j];
  track t = {.contact = c, .c = c->tangent, .s = c->normal, .state = CONTACT_STICK};
  if (!(contact_normal(&t.contact->law, t.s * a->x[a->n_time - 1]) > 0)) t.state = CONTACT_SEPARATED;
  settle(a, &t);
  double w = t.w;
  record(a, &t, jac, report);
  return fabs(t.w - w) <= 1e-12 * (fabs(w) + size) ? HC_OK : HC_NOT_CLOSED;
}

hc_status aft_eval(aft *a, const double *X, double *F, double *jac, contact_report *report)
{
  contact_report local;
  if (!report) report = &local;
  *report = (contact_report){.regime = CONTACT_LINEAR};
  int n_coef = series_length(a->n_harm);
  double size = 0; /* bounds |x| */
  for (int i = 0; i < n_coef; ++i) size += fabs(X[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  to_samples(a, X);
  memset(a->f, 0, (size_t)a->n_time * sizeof(double));
  memset(a->k, 0, (size_t)a->n_time * sizeof(double));
  if (jac) memset(jac, 0, (size_t)n_coef * n_coef * sizeof(double));
  hc_status st = HC_OK;
  for (int j = 0; j < a->model->n_contacts && st == HC_OK; ++j) st = evaluate_contact(a, j, size, jac, report);
  if (st != HC_OK) return st;
  to_series(a, a->to_freq_f, a->n_harm, F);
  if (!jac) return HC_OK;
  to_series(a, a->to_freq_k, 2 * a->n_harm, a->symbol);
  force_jacobian_add(a->n_harm, a->symbol, n_coef, jac);
  return HC_OK;
}

void aft_sliders(const aft *a, double *w)
{
  if (a->model->n_contacts) memcpy(w, a->w, (size_t)a->model->n_contacts * sizeof *w);
}
