/* curve.c - see hbmcheck.h: HBM solutions, and the response curve they lie on. */
#include <math.h>
#include <stdlib.h>

#include "compare/first_guess.h"
#include "compare/response.h"
#include "interfaces/library/inside.h"

struct hbmcheck_solutions {
  const hbmcheck_curve *of; /* they lie on */
  hbm_curve curve;          /* points and coefficients */
  int n, n_responses;       /* solutions that have been measured: the first n of the curve's */
  hbmcheck_solution *list;  /* [n][n_responses] */
  int length;               /* of a series */
  double *series;           /* [n][n_responses][length] */
};

struct hbmcheck_curve {
  hbm_solver *solver; /* as the trace left it: with the harmonics and samples that the curve needs */
  hbmcheck_solutions points;
  int n_contacts; /* of the case */
};

/* ---- HBM solutions ---- */

static double *solution_series(const hbmcheck_solutions *s, int k, int r)
{
  return s->series + ((size_t)k * (size_t)s->n_responses + (size_t)r) * (size_t)s->length;
}

/* Every point of s->curve. On failure those before it are kept. */
static hc_status measure_solutions(hbm_solver *solver, int n_responses, hbmcheck_solutions *s)
{
  const size_t n = (size_t)s->curve.n * (size_t)n_responses;
  s->n_responses = n_responses;
  s->length = 2 * hbm_n_harmonics(solver) + 1;
  if (n == 0) return HC_OK;
  s->list = malloc(n * sizeof *s->list);
  if (!s->list) return HC_NO_MEMORY;
  s->series = malloc(n * (size_t)s->length * sizeof *s->series);
  if (!s->series) return HC_NO_MEMORY;
  for (; s->n < s->curve.n; ++s->n) {
    /* Point k of s->curve, every response. */
    response_row row;
    hc_status st = response_row_of(solver, &s->curve, s->n, &row);
    for (int r = 0; r < s->n_responses && st == HC_OK; ++r) {
      if (r > 0) st = response_row_turn(solver, &s->curve, s->n, r, &row);
      const hbm_measures *m = &row.measures;
      s->list[s->n * s->n_responses + r] =
          (hbmcheck_solution){.omega = row.point.omega,
                              .amplitude = m->amplitude,
                              .max = m->max,
                              .min = m->min,
                              .rms = m->rms,
                              .mean = m->mean,
                              .harmonic_1 = m->harmonic_1,
                              .multiplier = row.stability_known ? row.stability.multiplier : NAN,
                              .residual = row.point.residual,
                              .stable = row.stability_known ? hbm_stability_verdict(&row.stability) : 0,
                              .branch = row.point.branch,
                              .harmonics = row.point.harmonics,
                              .iterations = row.point.iterations,
                              .contact = (hbmcheck_contact)m->contact.regime,
                              .mean_free = m->contact.free_sliders > 0};
      if (st == HC_OK)
        st = hbm_response(solver, row.point.omega, hbm_curve_X(&s->curve, s->n), r, solution_series(s, s->n, r));
    }
    if (st != HC_OK) return st;
  }
  return HC_OK;
}

/* Measure what a search that ended with `st` has found, and say how it ended as a whole. */
static hc_status finish_search(hbm_solver *solver, hc_status st, int n_responses, hbmcheck_solutions *s)
{
  if (!has_result(st)) return st;
  hc_status measured = measure_solutions(solver, n_responses, s);
  return st == HC_OK || measured == HC_NO_MEMORY ? measured : st;
}

static bool has_solution(const hbmcheck_solutions *s, int k, int r)
{
  return s && k >= 0 && k < s->n && r >= 0 && r < s->n_responses;
}

int hbmcheck_solutions_count(const hbmcheck_solutions *s) { return s ? s->n : 0; }

hbmcheck_status hbmcheck_solutions_get(const hbmcheck_solutions *s, int k, hbmcheck_solution *out)
{
  return hbmcheck_solutions_get_response(s, k, 0, out);
}

hbmcheck_status hbmcheck_solutions_get_response(const hbmcheck_solutions *s, int k, int r, hbmcheck_solution *out)
{
  if (!out || !has_solution(s, k, r)) return HBMCHECK_BAD_INPUT;
  *out = s->list[k * s->n_responses + r];
  return HBMCHECK_OK;
}

hbmcheck_status hbmcheck_solutions_coefficients(const hbmcheck_solutions *s, int k, int cap, double *X, int *n)
{
  return hbmcheck_solutions_response_coefficients(s, k, 0, cap, X, n);
}

hbmcheck_status hbmcheck_solutions_response_coefficients(const hbmcheck_solutions *s, int k, int r, int cap, double *X,
                                                         int *n)
{
  if (!n || !has_solution(s, k, r) || cap < 0 || (cap > 0 && !X)) return HBMCHECK_BAD_INPUT;
  *n = 2 * s->curve.points[k].harmonics + 1;
  library_copy(*n, solution_series(s, k, r), cap, X);
  return HBMCHECK_OK;
}

static void clear_solutions(hbmcheck_solutions *s)
{
  hbm_curve_free(&s->curve);
  free(s->list);
  free(s->series);
}

void hbmcheck_solutions_free(hbmcheck_solutions *s)
{
  if (!s) return;
  clear_solutions(s);
  free(s);
}

/* ---- HBM response curve ---- */

hbmcheck_status hbmcheck_curve_trace(const hbmcheck_case *c, const hbmcheck_monitor *monitor, hbmcheck_curve **out)
{
  if (out) *out = NULL;
  if (!c || !out) return HBMCHECK_BAD_INPUT;
  hbmcheck_curve *curve = calloc(1, sizeof *curve);
  if (!curve) return HBMCHECK_NO_MEMORY;
  const hc_monitor inner = library_monitor(monitor);
  compare_setup setup;
  hc_status st = scene_setup(&c->sc, &setup);
  curve->points.of = curve;
  curve->n_contacts = scene_contact_count(&c->sc);
  if (st == HC_OK) st = guided_hbm_solver_new(setup.model, &setup.hbm, &curve->solver);
  if (st == HC_OK) {
    st = hbm_trace_all(curve->solver, setup.omega_from, setup.omega_to, &inner, &curve->points.curve);
    st = finish_search(curve->solver, st, setup.model->n_responses, &curve->points);
  }
  scene_setup_clear(&setup);
  if (has_result(st)) *out = curve;
  else hbmcheck_curve_free(curve);
  return public_status(st);
}

const hbmcheck_solutions *hbmcheck_curve_points(const hbmcheck_curve *curve) { return curve ? &curve->points : NULL; }

hbmcheck_status hbmcheck_curve_at(hbmcheck_curve *curve, double omega, hbmcheck_solutions **out)
{
  if (out) *out = NULL;
  if (!curve || !out || !is_omega(omega)) return HBMCHECK_BAD_INPUT;
  hbmcheck_solutions *s = calloc(1, sizeof *s);
  if (!s) return HBMCHECK_NO_MEMORY;
  s->of = curve;
  hc_status st = hbm_curve_at(curve->solver, &curve->points.curve, omega, &s->curve);
  st = finish_search(curve->solver, st, curve->points.n_responses, s);
  if (st == HC_OK) st = curve->points.curve.end; /* beyond where it stops there may be more */
  if (has_result(st)) *out = s;
  else hbmcheck_solutions_free(s);
  return public_status(st);
}

hbmcheck_status hbmcheck_curve_contacts(hbmcheck_curve *curve, const hbmcheck_solutions *s, int k, int cap,
                                        hbmcheck_contact_period *out, int *n)
{
  if (!curve || !n || !has_solution(s, k, 0) || s->of != curve || cap < 0 || (cap > 0 && !out))
    return HBMCHECK_BAD_INPUT;
  contact_period *periods = calloc((size_t)hbm_n_contacts(curve->solver) + 1, sizeof *periods);
  hc_status st = periods ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK && cap > 0)
    st = hbm_measure_contacts(curve->solver, s->curve.points[k].omega, hbm_curve_X(&s->curve, k), periods);
  if (st == HC_OK) *n = curve->n_contacts;
  for (int j = 0; st == HC_OK && j < cap && j < curve->n_contacts; ++j) out[j] = library_period(&periods[j]);
  free(periods);
  return public_status(st);
}

hbmcheck_status hbmcheck_curve_specials(hbmcheck_curve *curve, int cap, hbmcheck_special *out, int *n)
{
  if (!curve || !n || cap < 0 || (cap > 0 && !out)) return HBMCHECK_BAD_INPUT;
  int found;
  hbm_special *list;
  hc_status st = hbm_specials(curve->solver, &curve->points.curve, &list, &found);
  for (int i = 0; has_result(st) && i < cap && i < found; ++i)
    out[i] = (hbmcheck_special){.omega = list[i].omega,
                                .amplitude = list[i].amplitude,
                                .branch = list[i].branch,
                                .kind = (hbmcheck_special_kind)list[i].kind,
                                .before = (hbmcheck_contact)list[i].before,
                                .after = (hbmcheck_contact)list[i].after};
  if (has_result(st)) *n = found;
  free(list);
  return public_status(st);
}

hbmcheck_status hbmcheck_curve_summary(hbmcheck_curve *curve, hbmcheck_summary *out)
{
  if (!curve || !out) return HBMCHECK_BAD_INPUT;
  response_summary r;
  hc_status st = response_summarise(curve->solver, &curve->points.curve, &r);
  if (st == HC_OK)
    *out = (hbmcheck_summary){.peak_omega = r.peak_omega,
                              .peak_amplitude = r.peak_amplitude,
                              .peak_harmonic_1 = r.peak_harmonic_1,
                              .points = r.points,
                              .turning_points = r.turning_points,
                              .harmonics = r.harmonics,
                              .samples = r.samples,
                              .rejected = r.rejected,
                              .iterations = r.iterations,
                              .evaluations = r.evaluations,
                              .reached_end = r.reached_end,
                              .left_at_start = r.left_at_start,
                              .inaccurate = curve->points.curve.inaccurate};
  return public_status(st);
}

void hbmcheck_curve_free(hbmcheck_curve *curve)
{
  if (!curve) return;
  clear_solutions(&curve->points);
  hbm_solver_free(curve->solver);
  free(curve);
}
