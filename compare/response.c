/* response.c - see response.h. */
#include "compare/response.h"

#include <stdlib.h>

#include "compare/first_guess.h"
#include "numerics/base/thread_clock.h"

hc_status response_trace(const compare_setup *setup, const number_list *asked, const hc_monitor *monitor,
                         response_curve *out)
{
  const double began = thread_seconds();
  const number_list none = {.n = 0};
  double from, to;
  *out = (response_curve){.hbm = NULL};
  comparison_sweep(setup->omega_from, setup->omega_to, asked ? asked : &none, &from, &to);
  out->status = guided_hbm_solver_new(setup->model, &setup->hbm, &out->hbm);
  if (out->status == HC_OK) out->status = hbm_trace_all(out->hbm, from, to, monitor, &out->curve);
  out->seconds = thread_seconds() - began;
  return out->status == HC_INTERRUPTED || out->status == HC_NO_MEMORY ? out->status : HC_OK;
}

void response_curve_free(response_curve *c)
{
  hbm_curve_free(&c->curve);
  hbm_solver_free(c->hbm);
  *c = (response_curve){.hbm = NULL};
}

hc_status response_row_of(hbm_solver *s, const hbm_curve *c, int k, response_row *out)
{
  const double *X = c->X + (size_t)k * c->n_coef;
  *out = (response_row){.point = c->points[k]};
  hc_status st = hbm_measure(s, X, &out->measures);
  const bool wanted = c->asked || !hbm_stability_is_costly(s);
  hc_status known =
      st == HC_OK && wanted ? hbm_stability_with_error(s, out->point.omega, X, !c->asked, &out->stability) : st;
  out->stability_known = wanted && known == HC_OK;
  return known == HC_NO_MEMORY ? known : st;
}

hc_status response_row_turn(hbm_solver *s, const hbm_curve *c, int k, int r, response_row *row)
{
  return hbm_measure_response(s, row->point.omega, c->X + (size_t)k * (size_t)c->n_coef, r, &row->measures);
}

hc_status response_at(hbm_solver *s, const hbm_curve *curve, const number_list *at, hbm_curve *found, double *failed_at)
{
  hc_status worst = HC_OK;
  for (int i = 0; i < at->n; ++i) {
    int before = found->n;
    hc_status st = hbm_curve_at(s, curve, at->v[i], found);
    const hc_status taken = hbm_curve_settle(found, found->n);
    if (taken != HC_OK) return taken;
    if (st == HC_OK && found->n == before) st = curve->end != HC_OK ? curve->end : HC_NOT_CONVERGED;
    if (st != HC_OK && worst == HC_OK) {
      worst = st;
      *failed_at = at->v[i];
    }
  }
  return worst;
}

hc_status response_summarise(hbm_solver *s, const hbm_curve *c, response_summary *out)
{
  hbm_curve peak = {0};
  hbm_measures m;
  *out = (response_summary){.harmonics = hbm_n_harmonics(s),
                            .samples = hbm_n_samples(s),
                            .points = c->n,
                            .rejected = c->rejected,
                            .turning_points = c->turning_points,
                            .iterations = c->iterations,
                            .evaluations = c->evaluations,
                            .reached_end = c->n > 0 && c->end == HC_OK && !c->left_at_start,
                            .arclength = c->arclength,
                            .left_at_start = c->left_at_start,
                            .inaccurate = c->inaccurate};
  out->peak_amplitude = out->peak_omega = out->peak_harmonic_1 = NAN;
  const hc_status st = c->n > 0 ? hbm_curve_peak(s, c, &peak) : HC_OK;
  if (st == HC_OK && peak.n > 0 && hbm_measure(s, peak.X, &m) == HC_OK) {
    out->peak_amplitude = m.amplitude;
    out->peak_omega = peak.points[0].omega;
    out->peak_harmonic_1 = m.harmonic_1;
  }
  hbm_curve_free(&peak);
  return st == HC_NO_MEMORY ? st : HC_OK;
}

/* ---- where to compare ---- */

void comparison_sweep(double omega_from, double omega_to, const number_list *asked, double *from, double *to)
{
  double low = fmin(omega_from, omega_to), high = fmax(omega_from, omega_to);
  for (int i = 0; i < asked->n; ++i) {
    low = fmin(low, asked->v[i]);
    high = fmax(high, asked->v[i]);
  }
  bool up = omega_from <= omega_to;
  *from = up ? low : high;
  *to = up ? high : low;
}

/* length[k]: arc length of the plotted curve from its start to point k, without what lies between its parts. */
static hc_status drawn_lengths(hbm_solver *hbm, const hbm_curve *c, double *amplitude, double *length)
{
  double top = 0, span = fabs(c->points[c->n - 1].omega - c->points[0].omega);
  for (int k = 0; k < c->n; ++k) {
    hbm_measures m;
    hc_status st = hbm_measure(hbm, c->X + (size_t)k * c->n_coef, &m);
    if (st != HC_OK) return st;
    amplitude[k] = m.amplitude;
    top = fmax(top, m.amplitude);
  }
  length[0] = 0;
  for (int k = 1; k < c->n; ++k) {
    double across = span > 0 ? (c->points[k].omega - c->points[k - 1].omega) / span : 0;
    double upward = top > 0 ? (amplitude[k] - amplitude[k - 1]) / top : 0;
    length[k] = length[k - 1] + (hbm_curve_has_segment(c, k - 1) ? hypot(across, upward) : 0);
  }
  return HC_OK;
}

static void spread_points(const hbm_curve *c, const double *length, int n, number_list *out)
{
  int k = 0;
  if (n > NUMBER_LIST_MAX) n = NUMBER_LIST_MAX;
  for (int i = 0; i < n; ++i) {
    double at = length[c->n - 1] * (i + 0.5) / n;
    while (k + 2 < c->n && length[k + 1] < at) ++k;
    double part = length[k + 1] > length[k] ? (at - length[k]) / (length[k + 1] - length[k]) : 0;
    out->v[out->n++] = c->points[k].omega + part * (c->points[k + 1].omega - c->points[k].omega);
  }
}

hc_status comparison_frequencies(const compare_settings *where, double omega_from, hbm_solver *hbm, const hbm_curve *c,
                                 number_list *out)
{
  *out = where->omega;
  hc_status st = HC_OK;
  if (out->n == 0 && c->n >= 2) {
    double *work = malloc(2 * (size_t)c->n * sizeof *work);
    if (!work) return HC_NO_MEMORY;
    st = drawn_lengths(hbm, c, work, work + c->n);
    if (st == HC_OK) spread_points(c, work + c->n, where->points, out);
    free(work);
  }
  if (out->n == 0) out->v[out->n++] = omega_from; /* no curve at all: one row that says so */
  qsort(out->v, (size_t)out->n, sizeof *out->v, ascending);
  int n = 0;
  for (int i = 0; i < out->n; ++i)
    if (n == 0 || out->v[i] != out->v[n - 1]) out->v[n++] = out->v[i];
  out->n = n;
  return st;
}
