/* solution.c - one HBM solution against the transient that starts from it: what both expect of themselves, the orbit
 * beside them, the verdict, and what the difference is made of; see comparison.h. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "compare/comparison_private.h"
#include "compare/discrepancy.h"
#include "compare/first_guess.h"
#include "compare/gate_limits.h"
#include "compare/motion.h"
#include "timeint/steady/contact_watch.h"
#include "timeint/steady/sweep.h"

/* Response r of the solution X against the transient; into *m, if not NULL, the solution's measures. */
static hc_status errors_of(const comparison_work *w, int r, double omega, const double *X, const timeint_result *tr,
                           hbm_measures *m, discrepancy *out)
{
  periodic_motion a;
  hc_status st = motion_of_response(w->hbm, omega, X, r, m, &a);
  if (st != HC_OK) return st;
  const periodic_motion b = motion_of_transient(tr);
  *out = motion_discrepancy(&a, &b);
  return HC_OK;
}

/* The mean is not compared where a slider never slips. */
static bool within_limits(const compare_setup *setup, const discrepancy *e, const timeint_result *tr)
{
  return gate_limits_hold(setup->limits, tr->omega, e, motion_mean_is_free(tr));
}

/* *within: response r of the transient runs within the limits of the solution X, or of a symmetric model of its mirror
 * image. Errors of motion_of_response. */
static hc_status runs_on(const comparison_work *w, int r, double omega, double *X, const timeint_result *tr,
                         bool *within)
{
  discrepancy e;
  hc_status st = errors_of(w, r, omega, X, tr, NULL, &e);
  *within = st == HC_OK && within_limits(w->setup, &e, tr);
  if (st != HC_OK || *within || !hbm_mirror(w->hbm, X)) return st;
  st = errors_of(w, r, omega, X, tr, NULL, &e);
  *within = st == HC_OK && within_limits(w->setup, &e, tr);
  hbm_mirror(w->hbm, X); /* as it was */
  return st;
}

/* *within: it runs so on a solution of *at, but for number `without`, which may be -1. */
static hc_status runs_on_any(const comparison_work *w, int r, const hbm_curve *at, int without,
                             const timeint_result *tr, bool *within)
{
  hc_status st = HC_OK;
  *within = false;
  for (int i = 0; i < at->n && st == HC_OK && !*within; ++i)
    if (i != without) st = runs_on(w, r, at->points[i].omega, at->X + (size_t)i * at->n_coef, tr, within);
  return st;
}

/* A solution that the curve has not come to may be there all the same: Newton from the harmonics of the transient, once
 * for all responses. HC_NO_MEMORY, HC_INTERRUPTED; else w->has_beside says whether w->beside is one. */
static hc_status look_beside(comparison_work *w, double omega)
{
  hbm_point point;
  if (w->looked_beside) return HC_OK;
  w->looked_beside = true;
  const hc_status st =
      solution_of_motion(w->hbm, w->setup->model, &w->setup->transient, omega, w->state, w->monitor, w->beside, &point);
  w->has_beside = st == HC_OK;
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK;
}

/* row->beside of response r, once the verdict is known: where the transient is next to the row's own solution, Newton
 * would only come back to that. */
static hc_status account_beside(comparison_work *w, int r, comparison_row *row)
{
  const bool periodic = row->transient_status == HC_OK && row->transient.period_multiple == 1;
  if (row->accounted || comparison_one_orbit(row) || !periodic || row->hbm_status != HC_OK) return HC_OK;
  hc_status st = look_beside(w, row->omega);
  if (st == HC_OK && w->has_beside) st = runs_on(w, r, row->omega, w->beside, &row->transient, &row->beside);
  row->accounted = row->beside;
  return st;
}

/* w->state at the start of a row. HC_OK, or why the sweep up to here failed. */
static hc_status start_state(comparison_work *w, const comparison_row *row, const double *X)
{
  switch (w->setup->transient.start) {
  case TRANSIENT_START_HBM: return comparison_orbit_start(w->hbm, X, row->omega, w->state);
  case TRANSIENT_START_REST: timeint_rest(w->ti, w->state); return HC_OK;
  default: break;
  }
  hc_status st = timeint_sweep(w->ti, w->swept_omega, row->omega, w->swept, w->monitor);
  w->swept_omega = row->omega;
  memcpy(w->state, w->swept, (size_t)w->out->n_states * sizeof *w->state);
  return st;
}

/* Is an orbit that was found from the HBM solution, e apart from it, next to it? Not if one is ten times the other, or
 * they are more than half the larger amplitude apart and contacts do not do the same: shooting has gone elsewhere. */
static bool is_next_to(const comparison_row *row, const discrepancy *e, const timeint_result *orbit)
{
  const double a = row->hbm.amplitude, b = orbit->amplitude, larger = fmax(a, b);
  if (!(larger <= 10 * fmin(a, b))) return false;
  return e->waveform * b <= 0.5 * larger || orbit->regime == row->hbm.contact.regime;
}

/* *next: 1: the transient runs on the orbit next to the HBM solution, -1: on another one, 0: not known. Shooting from
 * the solution has found it, or left it. Of a transient that has come from elsewhere, or was marched, that orbit is
 * computed from the HBM solution, with the transient's own law, and the two are held together: same law, same orbit, so
 * that the difference is of the order of transient.tolerance, and anything beyond `same` is another orbit. What was
 * found may be an orbit far away, or none: whether there is one next to the solution is not known then. */
static hc_status runs_next_to(comparison_work *w, const comparison_row *row, const double *X, int *next)
{
  const double same = fmax(1e-6, 100 * w->setup->transient.tolerance);
  const bool near = is_next_to(row, &row->errors, &row->transient);
  if (w->setup->transient.start == TRANSIENT_START_HBM && row->transient.method != TIMEINT_BY_MARCHING)
    return *next = row->transient.left_orbit ? -1 : near, HC_OK;
  *next = row->errors.waveform <= BUDGET_SAME_ORBIT;
  timeint_result restarted;
  hc_status st = comparison_orbit_start(w->hbm, X, row->omega, w->scratch);
  if (st == HC_OK) st = timeint_orbit(w->ti, row->omega, 1, w->scratch, w->monitor, &restarted);
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st; /* nothing is known */
  if (st != HC_OK) return HC_OK;
  const periodic_motion there = motion_of_transient(&restarted), here = motion_of_transient(&row->transient);
  *next = motion_discrepancy(&there, &here).waveform <= same ? near : -1;
  return HC_OK;
}

/* 1: the HBM solution is stable, -1: unstable, 0: unknown. The multipliers of the exact orbit next to it decide; its
 * own are used where there is no such orbit or it is marginal. */
static int stability_of(const comparison_row *row)
{
  const int of_orbit = row->orbit_status == HC_OK ? timeint_stability(&row->orbit) : 0;
  return of_orbit != 0 ? of_orbit : hbm_stability_verdict(&row->stability);
}

/* ---- is a motion stable where linear theory cannot tell? ----
 *
 * A slider that never slips, and whose traction just reaches the limit, sticks on one side of the orbit and slips on
 * the other: the period map has a corner there. Its multipliers are those of the side that sticks, and a motion pushed
 * to the other one may be carried off for good. So it is perturbed to both sides, and followed period after period. */
static const double perturbation = 1e-5; /* of the motion's size */
enum { PERTURBED_PERIODS = 5000 };

static hc_status march_perturbed(comparison_work *w, timeint *ti, double omega, double by, timeint_result *r)
{
  const int n = w->setup->model->n;
  double size = 0, *y = w->scratch;
  memcpy(y, w->state, (size_t)w->out->n_states * sizeof *y);
  for (int i = 0; i < n; ++i) size = fmax(size, hypot(y[i], y[n + i] / omega));
  for (int i = 0; i < n; ++i) y[i] += (i % 2 ? -by : by) * size;
  return timeint_steady(ti, omega, y, w->monitor, r);
}

/* Where the motion goes from w->state, pushed to that side (+1, -1), by the exact law in closed form. */
static hc_status perturbed_motion(comparison_work *w, double omega, int direction, timeint_result *r)
{
  transient_settings how = w->setup->transient;
  timeint *ti;
  how.law = TRANSIENT_LAW_EXACT;
  how.method = model_is_smooth(w->setup->model) ? TRANSIENT_METHOD_CVODE : TRANSIENT_METHOD_CLOSED_FORM;
  how.steady = TRANSIENT_STEADY_MARCH;
  how.scout = false;
  if (how.max_periods > PERTURBED_PERIODS) how.max_periods = PERTURBED_PERIODS;
  hc_status st = timeint_new(w->setup->model, &how, &ti);
  if (st == HC_OK) st = march_perturbed(w, ti, omega, direction * perturbation, r);
  timeint_free(ti);
  return st;
}

/* *stays: 1: motions perturbed to either side are within the limits of the solution in the end, or after
 * PERTURBED_PERIODS; -1: one has left; 0: not known. */
static hc_status perturbations_decay(comparison_work *w, const comparison_row *row, const double *X, int *stays)
{
  *stays = 1;
  for (int to = -1; to <= 1 && *stays >= 0; to += 2) {
    timeint_result there = {.period_multiple = 0};
    discrepancy e = {NAN, NAN, NAN, NAN};
    hc_status st = perturbed_motion(w, row->omega, to, &there);
    if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
    const bool escapes = st == HC_UNBOUNDED || st == HC_CREEPS;
    if (!escapes && motion_is_measured(st)) st = errors_of(w, 0, row->omega, X, &there, NULL, &e);
    else if (!escapes) st = HC_NOT_CONVERGED;
    if (escapes || (st == HC_OK && !(there.period_multiple == 1 && within_limits(w->setup, &e, &there)))) *stays = -1;
    else if (st != HC_OK) *stays = 0;
  }
  return HC_OK;
}

/* The verdict where the transient is within the limits of X. */
static hc_status judge_near(comparison_work *w, const comparison_row *row, const double *X, verdict *out)
{
  int stays = 1;
  const bool doubted = hbm_stability_verdict(&row->stability) == 0 && !hbm_stability_is_unknown(w->hbm);
  const bool at_corner = row->transient.free_sliders > 0 && doubted; /* where the structure is not too large to ask */
  const hc_status st = at_corner ? perturbations_decay(w, row, X, &stays) : HC_OK;
  *out = stays > 0 ? VERDICT_MATCH : stays < 0 ? VERDICT_UNSTABLE : VERDICT_UNDECIDED;
  return st;
}

/* The verdict where it is not: does it run on the orbit next to solution k? */
static hc_status judge_far(comparison_work *w, const comparison_row *row, const hbm_curve *at, int k, verdict *out)
{
  bool elsewhere;
  int next = 0;
  hc_status st = runs_on_any(w, 0, at, k, &row->transient, &elsewhere);
  if (st == HC_OK && !elsewhere) st = runs_next_to(w, row, at->X + (size_t)k * at->n_coef, &next);
  *out = elsewhere || next < 0 ? VERDICT_OTHER_BRANCH : next > 0 ? VERDICT_DIFFERS : VERDICT_UNDECIDED;
  return st;
}

/* HC_NO_MEMORY, HC_INTERRUPTED: *out is not known. */
static hc_status judge(comparison_work *w, const comparison_row *row, const hbm_curve *at, int k, verdict *out)
{
  const bool unstable = row->hbm_status == HC_OK && stability_of(row) < 0;
  if (row->transient_status == HC_CREEPS) return *out = VERDICT_CREEPS, HC_OK;
  if (row->transient_status == HC_NOT_SETTLED) return *out = VERDICT_NOT_SETTLED, HC_OK;
  if (row->transient_status == HC_APERIODIC && row->hbm_status == HC_OK) return *out = VERDICT_APERIODIC, HC_OK;
  if (row->transient_status != HC_OK && unstable) return *out = VERDICT_UNSTABLE, HC_OK; /* also if it escapes */
  if (row->transient_status == HC_UNBOUNDED) return *out = VERDICT_UNBOUNDED, HC_OK;
  if (row->transient_status != HC_OK || row->hbm_status != HC_OK) return *out = VERDICT_SOLVER_FAILED, HC_OK;
  if (row->transient.period_multiple > 1) return *out = VERDICT_PERIOD_K, HC_OK;
  if (within_limits(w->setup, &row->errors, &row->transient))
    return judge_near(w, row, at->X + (size_t)k * at->n_coef, out);
  return unstable ? *out = VERDICT_UNSTABLE, HC_OK : judge_far(w, row, at, k, out);
}

/* HC_NOT_CONVERGED where shooting from solution k has come to the orbit of another solution, or far away. */
static hc_status is_own(const comparison_work *w, const comparison_row *row, const hbm_curve *at, int k)
{
  discrepancy e;
  bool other = false;
  hc_status st = errors_of(w, 0, row->omega, at->X + (size_t)k * at->n_coef, &row->orbit, NULL, &e);
  if (st == HC_OK && !within_limits(w->setup, &e, &row->orbit)) st = runs_on_any(w, 0, at, k, &row->orbit, &other);
  return st == HC_OK && (other || !is_next_to(row, &e, &row->orbit)) ? HC_NOT_CONVERGED : st;
}

/* The orbit of the exact law next to solution k; not computed again where the transient is just that. */
static void referee(comparison_work *w, comparison_row *row, const hbm_curve *at, int k)
{
  const transient_settings *t = &w->setup->transient;
  const timeint_result *tr = &row->transient;
  const double *X = at->X + (size_t)k * at->n_coef;
  bool same = t->law == TRANSIENT_LAW_EXACT && t->start == TRANSIENT_START_HBM && row->transient_status == HC_OK &&
              !tr->left_orbit && tr->period_multiple == 1 && tr->method == TIMEINT_BY_SHOOTING;
  if (same) row->orbit = *tr, row->orbit_status = HC_OK;
  else if ((row->orbit_status = comparison_orbit_start(w->hbm, X, row->omega, w->scratch)) == HC_OK)
    row->orbit_status = timeint_orbit(w->exact, row->omega, 1, w->scratch, w->monitor, &row->orbit);
  if (row->orbit_status == HC_OK) row->orbit_status = is_own(w, row, at, k);
  w->orbits[0] = row->orbit;
  for (int r = 1; r < w->setup->model->n_responses && row->orbit_status == HC_OK; ++r) {
    w->orbits[r] = same ? w->responses[r] : row->orbit;
    if (!same) row->orbit_status = timeint_response(w->exact, r, &w->orbits[r]);
  }
}

/* How far the reduction's stated error moves the amplitude of every response. Of the first, which is one of the
 * coordinates, that is all; of another the structure's own answer to its loads comes on top. */
static hc_status find_from_reduction(comparison_work *w, const double *X, double omega)
{
  const double error = w->setup->reduction;
  const hc_status st = error > 0 ? hbm_predict_reduction(w->hbm, omega, X, error, w->moved) : HC_OK;
  if (st != HC_OK || error <= 0) return st == HC_NO_MEMORY ? st : HC_OK; /* not known */
  for (int r = 0; r < w->setup->model->n_responses; ++r) {
    double square = 0;
    for (int k = 0; k < 2; ++k) {
      periodic_motion moved;
      if (motion_of_response(w->hbm, omega, w->moved + k * hbm_n_coefficients(w->hbm), r, NULL, &moved) != HC_OK)
        return HC_OK;
      const double d = motion_between(&w->motions[r], &moved).amplitude;
      square += d * d;
    }
    w->budgets[r].reduction = discrepancy_relative(sqrt(square), w->motions[r].amplitude) + (r > 0 ? error : 0);
  }
  return HC_OK;
}

/* What the discrepancy is made of, in every response. */
static hc_status account(comparison_work *w, const hbm_curve *at, int k, comparison_row *row)
{
  const double *X = at->X + (size_t)k * at->n_coef;
  hc_status st = row->hbm_status;
  for (int r = 0; r < w->setup->model->n_responses; ++r) w->budgets[r] = budget_nothing();
  for (int r = 0; r < w->setup->model->n_responses && st == HC_OK; ++r)
    st = motion_of_response(w->hbm, row->omega, X, r, NULL, &w->motions[r]);
  const budget_case from = {.omega = row->omega,
                            .n_harm = at->points[k].harmonics,
                            .X = X,
                            .motion = w->motions,
                            .transient_status = comparison_one_orbit(row) || row->orbit_status == HC_OK
                                                    ? row->transient_status
                                                    : HC_UNSUPPORTED,
                            .transient = w->responses,
                            .orbit_status = row->orbit_status,
                            .orbit = w->orbits,
                            .state = w->state,
                            .family = row->family,
                            .by = w->ti};
  if (st != HC_OK) return HC_OK;
  st = budgeter_run(w->budgeter, &from, w->monitor, w->budgets);
  if (st == HC_OK) st = find_from_reduction(w, X, row->omega);
  row->budget = w->budgets[0];
  return st;
}

/* Relative to the amplitude of the motion it is about. */
static discrepancy relative_prediction(const motion_error *e, double amplitude)
{
  return (discrepancy){.amplitude = discrepancy_relative(e->amplitude, amplitude),
                       .harmonic_1 = discrepancy_relative(e->harmonic_1, amplitude),
                       .mean = NAN,
                       .waveform = discrepancy_relative(e->waveform, amplitude)};
}

/* What HBM expects of X in every response: known before the transient is. */
static hc_status predict_solution(comparison_work *w, const double *X, const comparison_row *row)
{
  hc_status st = row->hbm_status;
  for (int r = 0; r < w->setup->model->n_responses; ++r) {
    w->expected[r] = (motion_error){NAN, NAN, NAN};
    if (st == HC_OK && r == 0) st = hbm_predict(w->hbm, row->omega, X, w->expected);
    else if (st == HC_OK) st = hbm_predict_response(w->hbm, row->omega, X, r, &w->expected[r]);
  }
  return st == HC_NO_MEMORY ? st : HC_OK;
}

/* What the transient, w->state on its orbit, expects of itself: HBM does not enter. */
static hc_status predict_transient(comparison_work *w, comparison_row *row)
{
  if (row->transient_status != HC_OK) return HC_OK;
  hc_status st = timeint_predict(w->ti, w->state, w->monitor, w->setup->model->n_responses, w->responses);
  row->transient = w->responses[0];
  return st;
}

/* The transient's contacts, while the handle has their periods. HC_NO_MEMORY: no going on. */
static hc_status keep_contacts(comparison_work *w, const comparison_row *row)
{
  w->acted = HC_UNSUPPORTED;
  if (w->setup->contacts && motion_is_measured(row->transient_status))
    w->acted = timeint_contacts(w->ti, &row->transient, w->acting);
  if (w->acted == HC_OK) contact_periods_merge(w->setup->model, w->acting);
  return w->acted == HC_NO_MEMORY ? w->acted : HC_OK;
}

/* The transient's measures of all responses, while the handle has their periods. */
static hc_status keep_responses(comparison_work *w, const comparison_row *row)
{
  hc_status st = HC_OK;
  w->responses[0] = row->transient;
  const int n = motion_is_measured(row->transient_status) ? w->setup->model->n_responses : 1;
  for (int r = 1; r < n && st == HC_OK; ++r) {
    w->responses[r] = row->transient;
    st = timeint_response(w->ti, r, &w->responses[r]);
  }
  return st;
}

/* A response that moves less than this of the largest is not compared: rounding of the others. */
static const double still = 1e-9;

static double largest_amplitude(const comparison_work *w)
{
  double most = 0;
  for (int r = 0; r < w->setup->model->n_responses; ++r) most = fmax(most, w->responses[r].amplitude);
  return most;
}

/* Response r in *row: the measures of HBM, transient and orbit, their errors, and what was expected of them. */
static hc_status measure_response(comparison_work *w, const hbm_curve *at, int k, int r, comparison_row *row)
{
  const double *X = at->X + (size_t)k * at->n_coef;
  const discrepancy nothing = {NAN, NAN, NAN, NAN};
  const bool comparable = row->hbm_status == HC_OK && row->transient_status == HC_OK;
  row->response = r;
  row->errors = row->orbit_errors = row->hbm_predicted = row->transient_predicted = nothing;
  row->accounted = row->beside = false;
  if (row->hbm_status == HC_OK) row->hbm_status = hbm_measure_response(w->hbm, row->omega, X, r, &row->hbm);
  if (row->hbm_status == HC_OK) row->hbm_predicted = relative_prediction(&w->expected[r], row->hbm.amplitude);
  if (row->orbit_status == HC_OK && row->hbm_status == HC_OK) {
    row->orbit = w->orbits[r];
    row->hbm_status = errors_of(w, r, row->omega, X, &row->orbit, &row->hbm, &row->orbit_errors);
  }
  if (!motion_is_measured(row->transient_status)) return HC_OK;
  row->transient = w->responses[r];
  row->transient_predicted = relative_prediction(&row->transient.predicted, row->transient.amplitude);
  if (comparable) row->hbm_status = errors_of(w, r, row->omega, X, &row->transient, &row->hbm, &row->errors);
  if (!comparable || row->transient.period_multiple != 1) return HC_OK;
  row->accounted = row->still = r > 0 && !(row->transient.amplitude > still * largest_amplitude(w));
  if (row->still) row->errors = row->hbm_predicted = row->transient_predicted = nothing;
  const hc_status st = row->still ? HC_OK : runs_on_any(w, r, at, -1, &row->transient, &row->accounted);
  if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
  if (st != HC_OK) row->hbm_status = st;
  return HC_OK;
}

/* Is the band wider than what is said to agree? */
static bool is_wide(const comparison_work *w, const comparison_row *row)
{
  return !row->still && band_width(&row->band) > gate_limits_at(w->setup->limits, row->omega).amplitude;
}

/* w->bands, and the verdict of a solution that agrees while its neighbours in the family do not. */
static hc_status find_bands(comparison_work *w, const double *X, comparison_row *row)
{
  const int n = w->setup->model->n_responses;
  const bool asked = w->setup->compare.band == COMPARE_BAND_AUTO && row->hbm_status == HC_OK;
  hc_status st = HC_OK;
  for (int r = 0; r < n; ++r) w->bands[r] = (band){asked ? BAND_NONE : BAND_NOT_ASKED, NAN, NAN, false};
  if (asked && row->hbm.contact.free_sliders > 0) {
    if (!w->band_search) st = band_search_new(w->setup->model, w->hbm, w->exact, &w->band_search);
    if (st == HC_OK) st = band_find(w->band_search, row->omega, X, w->monitor, w->bands);
  }
  row->band = w->bands[0];
  if (row->verdict == VERDICT_MATCH && is_wide(w, row)) row->verdict = VERDICT_FAMILY;
  return st;
}

hc_status solution_compare(comparison_work *w, const hbm_curve *at, int k, comparison_row *row)
{
  const double *X = at->X + (size_t)k * at->n_coef;
  row->branch = at->points[k].branch;
  row->hbm_status = hbm_measure(w->hbm, X, &row->hbm);
  hc_status known = predict_solution(w, X, row);
  if (known != HC_OK) return known;
  row->transient_status = start_state(w, row, X);
  if (row->transient_status == HC_OK)
    row->transient_status = timeint_steady(w->ti, row->omega, w->state, w->monitor, &row->transient);
  if (row->transient_status == HC_INTERRUPTED || row->transient_status == HC_NO_MEMORY) return row->transient_status;
  if ((known = keep_responses(w, row)) != HC_OK) return known;
  if ((known = keep_contacts(w, row)) != HC_OK) return known;
  if ((known = predict_transient(w, row)) != HC_OK) return known;
  referee(w, row, at, k);
  if (row->orbit_status == HC_INTERRUPTED || row->orbit_status == HC_NO_MEMORY) return row->orbit_status;
  row->stability.multiplier = NAN;
  if (w->setup->multipliers || stability_of(row) == 0 || row->transient.free_sliders > 0) {
    known = hbm_stability_at(w->hbm, row->omega, X, &row->stability);
    if (known == HC_NO_MEMORY) return known;
    if (known != HC_OK) row->stability.multiplier = NAN;
  }
  row->family = w->setup->model->n_contacts > 1 && comparison_mean_free(row) && row->transient.regime > CONTACT_STUCK;
  w->looked_beside = w->has_beside = false;
  known = measure_response(w, at, k, 0, row);
  if (known == HC_OK) known = judge(w, row, at, k, &row->verdict);
  if (known == HC_OK) known = account_beside(w, 0, row);
  if (known != HC_OK) return known;
  row->unexpected = comparison_unexpected(row);
  known = find_bands(w, X, row);
  return known == HC_OK ? account(w, at, k, row) : known;
}

hc_status solution_turn(comparison_work *w, const hbm_curve *at, int k, int r, const comparison_row *first,
                        comparison_row *row)
{
  *row = *first;
  row->band = w->bands[r];
  hc_status st = measure_response(w, at, k, r, row);
  row->budget = row->still ? budget_nothing() : w->budgets[r];
  if (comparison_one_orbit(first)) {
    const bool within = row->still || within_limits(w->setup, &row->errors, &row->transient);
    row->verdict = within ? VERDICT_MATCH : stability_of(first) < 0 ? VERDICT_UNSTABLE : VERDICT_DIFFERS;
    if (row->verdict == VERDICT_MATCH && is_wide(w, row)) row->verdict = VERDICT_FAMILY;
  }
  row->unexpected = comparison_unexpected(row);
  return st == HC_OK ? account_beside(w, r, row) : st;
}

hc_status solution_contacts(comparison_work *w, const double *X, const comparison_row *row, contact_comparison *c)
{
  const model *m = w->setup->model;
  const int n = model_whole_contacts(m);
  const hc_status measured = hbm_measure_contacts(w->hbm, row->omega, X, w->balanced);
  for (int j = 0; j < n; ++j) {
    c[j] = (contact_comparison){.omega = row->omega,
                                .branch = row->branch,
                                .contact = j,
                                .one_orbit = comparison_one_orbit(row),
                                .hbm_status = measured,
                                .transient_status = w->acted,
                                .hbm = w->balanced[j],
                                .transient = w->acting[j]};
    comparison_verdict_text(row, c[j].verdict);
  }
  contact_comparison_judge(n, m->contacts, gate_limits_at(w->setup->limits, row->omega).waveform,
                           comparison_mean_free(row), c);
  return measured == HC_NO_MEMORY ? measured : HC_OK;
}

/* ---- what a comparison came to, from its rows alone; the verdict of a row: judge() ---- */

static const struct {
  const char *name, *meaning;
} verdicts[] = {
#define VERDICT_WORDS(code, name, meaning) {name, meaning},
    VERDICT_LIST(VERDICT_WORDS)
#undef VERDICT_WORDS
};

const char *verdict_name(verdict v) { return verdicts[v].name; }

const char *verdict_meaning(verdict v) { return verdicts[v].meaning; }

const char *comparison_verdict_text(const comparison_row *row, char text[24])
{
  if (row->verdict == VERDICT_PERIOD_K) snprintf(text, 24, "period_%d", row->transient.period_multiple);
  else snprintf(text, 24, "%s", verdict_name(row->verdict));
  return text;
}

bool comparison_agrees(const comparison_row *row)
{
  return row->verdict == VERDICT_MATCH || row->verdict == VERDICT_FAMILY;
}

bool comparison_one_orbit(const comparison_row *row)
{
  return comparison_agrees(row) || row->verdict == VERDICT_DIFFERS;
}

bool comparison_mean_free(const comparison_row *row)
{
  if (row->transient_status == HC_OK) return motion_mean_is_free(&row->transient);
  if (row->orbit_status == HC_OK) return motion_mean_is_free(&row->orbit);
  return row->hbm_status == HC_OK && row->hbm.contact.free_sliders > 0;
}

/* What is farthest beyond its limit; of a transient that left the orbit by the row's errors, with no parts. */
static budget_worst worst_of(const comparison_row *row, const gate_limits *limits)
{
  const discrepancy at = gate_limits_at(limits, row->omega), *e = &row->errors;
  if (row->verdict != VERDICT_DIFFERS || row->budget.against_transient) return budget_find_worst(&row->budget, &at);
  const budget_worst of[] = {{"amplitude", NULL, e->amplitude / at.amplitude},
                             {"harmonic_1", NULL, e->harmonic_1 / at.harmonic_1},
                             {"waveform", NULL, e->waveform / at.waveform},
                             {"mean", NULL, comparison_mean_free(row) ? NAN : e->mean / at.mean}};
  budget_worst top = {.ratio = -1};
  for (int i = 0; i < 4; ++i)
    if (of[i].ratio > top.ratio) top = of[i];
  return top;
}

bool comparison_row_is_beyond(const comparison_row *row, const gate_limits *limits)
{
  return worst_of(row, limits).ratio > 1;
}

const comparison_row *comparison_worst(const comparison *c, const gate_limits *limits)
{
  const comparison_row *worst = NULL;
  double most = -1;
  bool differs = false; /* the worst so far */
  for (int i = 0; i < c->n_rows; ++i) {
    const bool also = c->rows[i].verdict == VERDICT_DIFFERS;
    const double ratio = worst_of(&c->rows[i], limits).ratio;
    if (also == differs ? ratio > most : also && ratio >= 0) most = ratio, worst = &c->rows[i], differs = also;
  }
  return worst;
}

const char *comparison_worst_text(const comparison *c, const comparison_row *worst, const gate_limits *limits,
                                  char text[COMPARISON_WORST_TEXT])
{
  const discrepancy at = gate_limits_at(limits, worst->omega);
  const budget_worst of = worst_of(worst, limits);
  const bool left = of.quantity && !of.parts;
  char budget[BUDGET_TEXT];
  if (left) snprintf(budget, BUDGET_TEXT, "%s: the transient left the orbit next to the solution", of.quantity);
  else budget_text(&worst->budget, &at, budget);
  snprintf(text, COMPARISON_WORST_TEXT, "%s%s%s", budget, *c->advice ? "; " : "", c->advice);
  return text;
}

bool comparison_nonlinear(const comparison *c)
{
  bool compared = false;
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    if (r->hbm_status == HC_OK && r->hbm.contact.regime > CONTACT_STUCK) return true;
    if (motion_is_measured(r->transient_status) && r->transient.regime > CONTACT_STUCK) return true;
    compared |=
        r->hbm_status == HC_OK && motion_is_measured(r->transient_status) && r->transient_status != HC_NOT_SETTLED;
  }
  return !compared;
}

bool comparison_unaccounted(const comparison_row *row)
{
  bool known = row->transient_status == HC_OK || row->transient_status == HC_APERIODIC;
  return known && row->hbm_status == HC_OK && !row->accounted;
}

/* False where one of the three is NaN. */
static bool beyond(double observed, double hbm, double transient)
{
  return observed > COMPARISON_SLACK * (hbm + transient);
}

bool comparison_unexpected(const comparison_row *row)
{
  const discrepancy *h = &row->hbm_predicted, *t = &row->transient_predicted;
  return comparison_one_orbit(row) && !row->family && row->transient.period_multiple == 1 &&
         (beyond(row->errors.amplitude, h->amplitude, t->amplitude) ||
          beyond(row->errors.waveform, h->waveform, t->waveform));
}

const char *comparison_unexpected_text(const comparison_row *row, char text[COMPARISON_UNEXPECTED_TEXT])
{
  const discrepancy *h = &row->hbm_predicted, *t = &row->transient_predicted, *e = &row->errors;
  const bool amplitude = beyond(e->amplitude, h->amplitude, t->amplitude);
  snprintf(text, COMPARISON_UNEXPECTED_TEXT,
           "observed %s error %.2g is above what both predicted (HBM %.2g, transient %.2g): something is wrong that "
           "neither expected",
           amplitude ? "amplitude" : "waveform", amplitude ? e->amplitude : e->waveform,
           amplitude ? h->amplitude : h->waveform, amplitude ? t->amplitude : t->waveform);
  return text;
}

int comparison_exit_code(const comparison *c)
{
  for (int i = 0; i < c->n_rows; ++i)
    if (comparison_unaccounted(&c->rows[i])) return 1;
  if (c->curve.end != HC_OK) return 3; /* what lies beyond was not compared, and the curve might have come back */
  if (c->count[VERDICT_SOLVER_FAILED] > 0 || c->count[VERDICT_NOT_SETTLED] > 0 || c->count[VERDICT_UNBOUNDED] > 0 ||
      c->count[VERDICT_CREEPS] > 0 || c->count[VERDICT_UNDECIDED] > 0 ||
      c->count[VERDICT_MATCH] + c->count[VERDICT_FAMILY] == 0)
    return 3;
  return 0;
}

/* ---- contacts, from both sides. Proof: tests/compare/test_contacts.c ---- */

static const double negligible_work = 1e-6; /* [1] work, of T^2/kt */

static double spring_energy(const contact *law, const contact_period *p)
{
  return law->kt > 0 ? p->traction_max * p->traction_max / law->kt : 0;
}

/* [force length] What work is measured by: the largest of any contact on either side. */
static double work_unit(int n, const model_contact *contacts, const contact_comparison *c)
{
  double most = 0;
  const model_contact *of = contacts;
  for (int j = 0; j < n; ++j) {
    most = fmax(most, fmax(c[j].hbm.work, c[j].transient.work));
    most = fmax(most, negligible_work * spring_energy(&of->law, &c[j].hbm));
    most = fmax(most, negligible_work * spring_energy(&of->law, &c[j].transient));
    do ++of;
    while (contact_goes_on(of->pair)); /* the list ends with an empty one */
  }
  return most;
}

static void judge_contact(double unit, double allowed, bool mean_free, contact_comparison *c)
{
  const contact_period *h = &c->hbm, *t = &c->transient;
  c->work_error = discrepancy_relative(h->work - t->work, unit);
  c->normal_error =
      mean_free ? NAN : discrepancy_relative(h->normal_min - t->normal_min, fmax(h->normal_max, t->normal_max));
  const bool both_touch = (h->regime == CONTACT_LINEAR) == (t->regime == CONTACT_LINEAR);
  const bool same = both_touch && c->work_error <= allowed && (mean_free || c->normal_error <= allowed);
  c->differs = c->one_orbit && !same;
}

void contact_comparison_judge(int n, const model_contact *contacts, double allowed, bool mean_free,
                              contact_comparison *c)
{
  bool known = true;
  for (int j = 0; j < n; ++j) known = known && c[j].hbm_status == HC_OK && c[j].transient_status == HC_OK;
  const double unit = known ? work_unit(n, contacts, c) : NAN;
  for (int j = 0; j < n; ++j) {
    c[j].work_error = c[j].normal_error = NAN;
    c[j].differs = false;
    if (known) judge_contact(unit, allowed, mean_free, &c[j]);
  }
}

bool contact_comparison_made(const contact_comparison *c) { return c->one_orbit && !isnan(c->work_error); }

const char *contact_comparison_text(const contact_comparison *c, char text[CONTACT_COMPARISON_TEXT])
{
  const contact_period *h = &c->hbm, *t = &c->transient;
  char who[RESPONSE_NAME];
  if (*c->name) snprintf(who, sizeof who, "%s", c->name);
  else snprintf(who, sizeof who, "%d", c->contact);
  if (h->regime != t->regime)
    snprintf(text, CONTACT_COMPARISON_TEXT, "contact %s: %s by HBM, %s by the transient; work %.4g and %.4g", who,
             contact_regime_name(h->regime), contact_regime_name(t->regime), h->work, t->work);
  else if (c->work_error > c->normal_error || isnan(c->normal_error))
    snprintf(text, CONTACT_COMPARISON_TEXT,
             "contact %s: work %.4g by HBM, %.4g by the transient, %.2g %% of the largest apart: so is the damping",
             who, h->work, t->work, 100 * c->work_error);
  else
    snprintf(text, CONTACT_COMPARISON_TEXT, "contact %s: least normal force %.4g by HBM, %.4g by the transient", who,
             h->normal_min, t->normal_min);
  return text;
}
