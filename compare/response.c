/* response.c - see response.h. */
#include "compare/response.h"

#include <math.h>
#include <stddef.h>

#include "compare/first_guess.h"
#include "compare/frequencies.h"

hc_status response_trace(const compare_setup *setup, const number_list *asked, const hc_monitor *monitor,
                         hbm_solver **hbm, hbm_curve *curve)
{
  double from, to;
  comparison_sweep(setup->omega_from, setup->omega_to, asked, &from, &to);
  const hc_status st = guided_hbm_solver_new(setup->model, &setup->hbm, hbm);
  return st == HC_OK ? hbm_trace(*hbm, from, to, monitor, curve) : st;
}

hc_status response_row_of(hbm_solver *s, const hbm_curve *c, int k, response_row *out)
{
  const double *X = c->X + (size_t)k * c->n_coef;
  *out = (response_row){.point = c->points[k]};
  hc_status st = hbm_measure(s, X, &out->measures);
  const bool wanted = c->asked || !hbm_stability_is_costly(s);
  hc_status known = st == HC_OK && wanted ? hbm_stability_at(s, out->point.omega, X, &out->stability) : st;
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
    if (st == HC_OK && found->n == before) st = curve->end != HC_OK ? curve->end : HC_NOT_CONVERGED;
    if (st != HC_OK && worst == HC_OK) {
      worst = st;
      *failed_at = at->v[i];
    }
  }
  return worst;
}

/* HC_OK, or HC_NO_MEMORY: there may be one. */
static hc_status find_peak(hbm_solver *s, const hbm_curve *c, response_summary *out)
{
  hbm_curve peak = {0};
  hbm_measures m;
  out->peak_amplitude = out->peak_omega = out->peak_harmonic_1 = NAN;
  hc_status st = c->n > 0 ? hbm_curve_peak(s, c, &peak) : HC_OK;
  if (st == HC_OK && peak.n > 0 && hbm_measure(s, peak.X, &m) == HC_OK) {
    out->peak_amplitude = m.amplitude;
    out->peak_omega = peak.points[0].omega;
    out->peak_harmonic_1 = m.harmonic_1;
  }
  hbm_curve_free(&peak);
  return st == HC_NO_MEMORY ? st : HC_OK;
}

hc_status response_summarise(hbm_solver *s, const hbm_curve *c, response_summary *out)
{
  *out = (response_summary){.harmonics = hbm_n_harmonics(s),
                            .samples = hbm_n_samples(s),
                            .points = c->n,
                            .rejected = c->rejected,
                            .turning_points = c->turning_points,
                            .iterations = c->iterations,
                            .evaluations = c->evaluations,
                            .reached_end = c->n > 0 && c->end == HC_OK && !c->left_at_start,
                            .arclength = c->arclength,
                            .left_at_start = c->left_at_start};
  return find_peak(s, c, out);
}
