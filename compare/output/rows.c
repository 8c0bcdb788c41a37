/* rows.c - see rows.h. The one place where a result has columns: each is a line of a list,
 *   X(where, kind, name, unit, meaning, is it there, value)   with r the row
 * where: ALL tables; IN_CYCLES, RESPONSES, IN_MEMORY, WITH_BANDS: those asked for (rows.h). A value is worked out when
 * a table that has the column takes the row. */
#include "compare/output/rows.h"

#include <string.h>

#include "compare/motion.h"
#include "numerics/base/constants.h"

/* Questions about a row, for the lists below. */
static bool settled(const steady_row *r) { return r->status == HC_OK; }
static double period_of(const steady_row *r) { return TWO_PI * r->result.period_multiple / r->result.omega; }
static bool measured(const steady_row *r) { return motion_is_measured(r->status); }
static bool prediction_known(const comparison_row *r)
{
  return !r->family && !isnan(r->hbm_predicted.amplitude) && !isnan(r->transient_predicted.amplitude);
}
static bool on_hbm(const survey_row *r) { return r->hbm_branch >= 0; }
static const char *yes_no(bool yes) { return yes ? "yes" : "no"; }
static bool has_hbm(const comparison_row *r) { return r->branch >= 0 && r->hbm_status == HC_OK; }
static bool has_orbit(const comparison_row *r) { return r->orbit_status == HC_OK; }
static bool has_transient(const comparison_row *r) { return motion_is_measured(r->transient_status); }
static const char *largest_part(const comparison_row *r)
{
  double fraction;
  return budget_largest(&r->budget, &fraction);
}
static const char *curve_text(const accuracy_row *r)
{
  return !r->possible ? "impossible: samples < 2 H + 2" : r->status == HC_OK ? "whole" : "stopped";
}
static const char *verdict_in_words(int stable) { return stable > 0 ? "yes" : stable < 0 ? "no" : "unknown"; }
static const char *stable_text(bool known, const hbm_stability *s)
{
  return verdict_in_words(known ? hbm_stability_verdict(s) : 0);
}
static const char *special_name(hbm_special_kind kind)
{
  static const char *const names[] = {[HBM_TURNING_POINT] = "turning point",
                                      [HBM_PERIOD_DOUBLING] = "period doubling",
                                      [HBM_CONTACT_CHANGE] = "contact change",
                                      [HBM_NEIMARK_SACKER] = "Neimark-Sacker",
                                      [HBM_SYMMETRY_BREAKING] = "symmetry breaking"};
  return names[kind];
}

static const char *stability_text(int s) { return s > 0 ? "stable" : s < 0 ? "unstable" : "unproven"; }

/* clang-format off */
/* ---- what several kinds have ---- */
#define AT_OMEGA(X, at) \
  X(ALL, REAL, omega, "rad/time", "of the load", true, at) \
  X(IN_CYCLES, REAL, frequency, "1/time", "omega in cycles", true, (at) / TWO_PI)

#define RESPONSE(X, of) X(RESPONSES, TEXT, response, "", "its name", true, of)
#define BRANCH(X, there, of) X(ALL, INTEGER, branch, "", "turning points passed, counted on in all parts", there, of)

#define MEASURES(X, there, m) \
  X(ALL, REAL, amplitude, "length", "(max - min)/2 of x over a period", there, (m).amplitude) \
  X(ALL, REAL, max, "length", "of x over a period", there, (m).max) \
  X(ALL, REAL, min, "length", "of x over a period", there, (m).min) \
  X(ALL, REAL, rms, "length", "of x over a period, the mean included", there, (m).rms) \
  X(ALL, REAL, mean, "length", "of x over a period", there, (m).mean) \
  X(ALL, REAL, harmonic_1, "length", "|a1 + i b1|", there, (m).harmonic_1)

#define MULTIPLIER(X, there, of) X(ALL, REAL, multiplier, "1", "size of the largest Floquet multiplier", there, of)
#define STRONGEST_STATE(X, there, of) \
  X(ALL, TEXT, contact, "", "strongest contact state of the motion: linear, stick, smooth, slip, separation", there, \
    contact_regime_name(of))
#define MEAN_FREE(X, there, of) \
  X(ALL, TEXT, mean_free, "", "yes where a free slider leaves the mean, and the amplitude perhaps, to history", there, \
    yes_no(of))
#define DRIFT(X, status, of) X(ALL, REAL, drift, "length", "of what creeps, per period", (status) == HC_CREEPS, of)
#define BAND(X, where, of) \
  X(where, REAL, band_low, "length", "least amplitude of the steady states that differ by where sliders rest", \
    (of).kind >= BAND_EXACT, (of).low) \
  X(where, REAL, band_high, "length", "and the largest", (of).kind >= BAND_EXACT, (of).high) \
  X(where, REAL, band_width, "1", "(high - low)/(high + low)", (of).kind >= BAND_EXACT, band_width(&(of))) \
  X(where, TEXT, band_kind, "", "exact: all were seen; at least: more may be wider; none: no slider is free", \
    (of).kind != BAND_NOT_ASKED, band_kind_name((of).kind))
#define PEAK_FREQUENCY(X) \
  X(IN_CYCLES, REAL, peak_frequency, "1/time", "of the largest amplitude", true, r->peak_omega / TWO_PI)

#define ONE_CONTACT(X) \
  X(ALL, INTEGER, contact, "", "its number, from 0", true, r->contact) \
  X(RESPONSES, TEXT, name, "", "of the contact", *r->name, r->name)

/* ---- each kind ---- */
#define FRF_COLUMNS(X) \
  AT_OMEGA(X, r->point.omega) \
  BRANCH(X, true, r->point.branch) \
  RESPONSE(X, r->response) \
  MEASURES(X, true, r->measures) \
  X(ALL, TEXT, stable, "", "yes, no or unknown", true, stable_text(r->stability_known, &r->stability)) \
  MULTIPLIER(X, r->stability_known, r->stability.multiplier) \
  STRONGEST_STATE(X, true, r->measures.contact.regime) \
  X(ALL, INTEGER, iterations, "", "of Newton", true, r->point.iterations) \
  X(ALL, REAL, residual, "1", "relative to the forces it is made of", true, r->point.residual) \
  MEAN_FREE(X, true, r->measures.contact.free_sliders > 0) \
  BAND(X, WITH_BANDS, r->band) \
  X(IN_MEMORY, INTEGER, harmonics, "", "H kept at this point", true, r->point.harmonics) \
  X(IN_MEMORY, SERIES, coefficients, "length", "X0, a1, b1, a2, b2, ... of the response", r->series, \
    ((row_series){2 * r->point.harmonics + 1, r->series}))

#define TRANSIENT_COLUMNS(X) \
  AT_OMEGA(X, r->result.omega) \
  RESPONSE(X, r->response_name) \
  X(ALL, TEXT, verdict, "", \
    "settled, unstable, period_2, ..., aperiodic, not_settled, unbounded, creeps, solver_failed", true, \
    steady_verdict_text(r, (char[24]){0})) \
  MEASURES(X, measured(r), r->result) \
  X(ALL, INTEGER, periods, "", "integrated", true, r->result.periods) \
  X(ALL, REAL, closure, "1", "estimated distance to the orbit, relative to the amplitude", measured(r), \
    r->result.closure) \
  X(ALL, INTEGER, period_multiple, "", "periods of the load in one of the motion; 0: it does not repeat", true, \
    settled(r) ? r->result.period_multiple : 0) \
  X(ALL, REAL, period, "time", "of the motion: period_multiple of those of the load", settled(r), period_of(r)) \
  X(ALL, INTEGER, steps, "", "of the integrator", true, r->result.steps) \
  STRONGEST_STATE(X, measured(r), r->result.regime) \
  X(ALL, TEXT, start, "", "where the motion began: rest, up, down, hbm branch 2", true, r->start) \
  X(ALL, TEXT, method, "", "how the steady state was reached", settled(r), timeint_method_name(r->result.method)) \
  MULTIPLIER(X, settled(r), r->result.multiplier) \
  X(ALL, INTEGER, free_sliders, "", "how many sliders never slip", settled(r), r->result.free_sliders) \
  X(ALL, REAL, lyapunov, "1/period", "rate at which neighbours part", measured(r), r->result.lyapunov) \
  X(ALL, REAL, from_regularisation, "1", "error of the amplitude by the regularised law", settled(r), \
    r->from_regularisation) \
  MEAN_FREE(X, settled(r), motion_mean_is_free(&r->result)) \
  X(RESPONSES, REAL, second_frequency, "rad/time", "of a torus, up to sign and multiples of omega", measured(r), \
    r->result.second_frequency) \
  X(ALL, REAL, window_low, "length", "of what does not repeat: the least amplitude of one period", measured(r), \
    r->result.window_low) \
  X(ALL, REAL, window_high, "length", "and the largest", measured(r), r->result.window_high) \
  X(ALL, INTEGER, window, "", "of so many periods, from the row's own on", measured(r) && r->result.window > 0, \
    r->result.window) \
  DRIFT(X, r->status, r->result.drift) \
  X(IN_MEMORY, TEXT, stable, "", "yes, no or unknown", true, \
    settled(r) ? verdict_in_words(timeint_stability(&r->result)) : "unknown") \
  X(IN_MEMORY, TEXT, status, "", "why there is no steady state, or ok", true, hc_status_text(r->status)) \
  X(IN_MEMORY, TEXT, without_hbm, "", "why a start on an HBM orbit became one at rest, or ok", true, \
    hc_status_text(r->without_hbm)) \
  X(IN_MEMORY, TEXT, left_orbit, "", "yes where the orbit next to the start is unstable and the motion left it", true, \
    yes_no(r->result.left_orbit)) \
  X(IN_MEMORY, SERIES, wave, "length", "x at i/n of the last period, from the forcing's maximum on", measured(r), \
    ((row_series){TIMEINT_WAVE, r->result.wave}))

#define BOTH_SIDES(X, name, unit, meaning, member) \
  X(ALL, REAL, hbm_##name, unit, meaning ", HBM", r->hbm_status == HC_OK, r->hbm.member) \
  X(ALL, REAL, transient_##name, unit, meaning ", time integration", r->transient_status == HC_OK, r->transient.member)

#define ERROR_OF "|hbm - transient| / the transient's amplitude"
#define BUDGET_OF "part of the error that removing this cause alone takes away"
#define PREDICTED "error that this side expects of itself"
#define COMPARE_COLUMNS(X) \
  AT_OMEGA(X, r->omega) \
  BRANCH(X, r->branch >= 0, r->branch) \
  RESPONSE(X, r->response_name) \
  X(ALL, TEXT, verdict, "", "match, differs, other_branch, unstable, ...: docs/interface.md, 4", true, \
    comparison_verdict_text(r, (char[24]){0})) \
  X(ALL, REAL, hbm_amplitude, "length", "(max - min)/2", has_hbm(r), r->hbm.amplitude) \
  X(ALL, REAL, transient_amplitude, "length", "(max - min)/2", has_transient(r), r->transient.amplitude) \
  X(ALL, REAL, amplitude_error, "1", ERROR_OF, true, r->errors.amplitude) \
  X(ALL, REAL, harmonic_1_error, "1", ERROR_OF, true, r->errors.harmonic_1) \
  X(ALL, REAL, mean_error, "1", ERROR_OF, true, r->errors.mean) \
  X(ALL, REAL, waveform_error, "1", "largest |hbm - transient| over a period / the transient's amplitude", true, \
    r->errors.waveform) \
  X(ALL, REAL, from_aliasing, "1", BUDGET_OF, true, r->budget.amplitude.aliasing) \
  X(ALL, REAL, from_truncation, "1", BUDGET_OF, true, r->budget.amplitude.truncation) \
  X(ALL, REAL, from_regularisation, "1", BUDGET_OF, true, r->budget.amplitude.regularisation) \
  X(ALL, REAL, from_integration, "1", BUDGET_OF, true, r->budget.amplitude.integration) \
  X(ALL, REAL, from_settling, "1", BUDGET_OF, true, r->budget.amplitude.settling) \
  X(RESPONSES, REAL, from_reduction, "1", \
    "how far the stated error of the reduction moves the amplitude at most; both sides share it", true, \
    r->budget.reduction) \
  X(ALL, REAL, hbm_harmonic_1, "length", "|a1 + i b1|", has_hbm(r), r->hbm.harmonic_1) \
  X(ALL, REAL, transient_harmonic_1, "length", "|a1 + i b1|", has_transient(r), r->transient.harmonic_1) \
  X(ALL, INTEGER, periods, "", "integrated", has_transient(r), r->transient.periods) \
  X(ALL, REAL, orbit_amplitude, "length", "of the exact law's orbit next to the HBM solution", has_orbit(r), \
    r->orbit.amplitude) \
  X(ALL, REAL, orbit_multiplier, "1", "size of its largest Floquet multiplier", has_orbit(r), r->orbit.multiplier) \
  X(ALL, REAL, orbit_error, "1", "distance of its waveform", true, r->orbit_errors.waveform) \
  X(ALL, REAL, budget_sum, "1", "of the budget's parts", r->budget.known, r->budget.amplitude.sum) \
  X(ALL, REAL, budget_observed, "1", "the error that the budget explains", r->budget.known, \
    r->budget.amplitude.observed) \
  X(ALL, TEXT, largest_part, "", "of the budget, if more than rounding; family: two members of one apart", \
    largest_part(r) != NULL, largest_part(r)) \
  X(ALL, REAL, hbm_predicted, "1", PREDICTED, true, r->hbm_predicted.amplitude) \
  X(ALL, REAL, transient_predicted, "1", PREDICTED, true, r->transient_predicted.amplitude) \
  X(ALL, REAL, hbm_predicted_harmonic_1, "1", PREDICTED, true, r->hbm_predicted.harmonic_1) \
  X(ALL, REAL, hbm_predicted_waveform, "1", PREDICTED, true, r->hbm_predicted.waveform) \
  X(ALL, REAL, transient_predicted_harmonic_1, "1", PREDICTED, true, r->transient_predicted.harmonic_1) \
  X(ALL, REAL, transient_predicted_waveform, "1", PREDICTED, true, r->transient_predicted.waveform) \
  X(ALL, TEXT, unexpected, "", "yes where both differ by more than three times both predictions", prediction_known(r), \
    yes_no(r->unexpected)) \
  MEAN_FREE(X, has_hbm(r), comparison_mean_free(r)) \
  BAND(X, ALL, r->band) \
  X(ALL, REAL, from_history, "1", \
    "how far the amplitude is off at most where sliders that never slip rest elsewhere", true, \
    band_from_history(&r->band, r->hbm.amplitude)) \
  X(ALL, INTEGER, others, "", "with --survey: motions at this omega that drawn starts come to, elsewhere", \
    r->others >= 0, r->others) \
  DRIFT(X, r->transient_status, r->transient.drift) \
  X(IN_MEMORY, TEXT, stable, "", "of the HBM solution: yes, no or unknown", has_hbm(r), \
    stable_text(true, &r->stability)) \
  X(IN_MEMORY, REAL, multiplier, "1", "size of the HBM solution's largest Floquet multiplier", has_hbm(r), \
    r->stability.multiplier) \
  X(IN_MEMORY, INTEGER, period_multiple, "", "periods of the load in one of the transient; 0: it does not repeat", \
    true, r->transient_status == HC_OK ? r->transient.period_multiple : 0) \
  X(IN_MEMORY, TEXT, accounted, "", "yes where the transient is within the gate of this or another HBM solution", \
    true, yes_no(r->accounted)) \
  X(IN_MEMORY, TEXT, still, "", "yes where it moves less than 1e-9 of the largest, and is not compared", true, \
    yes_no(r->still)) \
  X(IN_MEMORY, TEXT, family, "", "yes for one of many steady states, as a free slider rests", true, yes_no(r->family)) \
  X(IN_MEMORY, TEXT, hbm_status, "", "why there is no HBM solution, or ok", true, hc_status_text(r->hbm_status)) \
  X(IN_MEMORY, TEXT, transient_status, "", "why there is no transient, or ok", true, \
    hc_status_text(r->transient_status)) \
  X(IN_MEMORY, TEXT, orbit_status, "", "why there is no orbit, or ok", true, hc_status_text(r->orbit_status))

#define CURVE_COLUMNS(X) \
  X(ALL, INTEGER, harmonics, "", "H in use; for auto, the most the curve needed", true, r->harmonics) \
  X(ALL, INTEGER, samples, "", "N in use", r->samples > 0, r->samples) \
  X(ALL, INTEGER, points, "", "of the curve", true, r->points) \
  X(ALL, INTEGER, rejected, "", "steps given up", true, r->rejected) \
  X(ALL, INTEGER, turning_points, "", "of the curve", true, r->turning_points) \
  X(ALL, INTEGER, iterations, "", "of Newton, rejected steps included", true, r->iterations) \
  X(ALL, INTEGER, evaluations, "", "of the contact force", true, r->evaluations) \
  X(ALL, REAL, peak_amplitude, "length", "largest amplitude of the curve", true, r->peak_amplitude) \
  X(ALL, REAL, peak_omega, "rad/time", "where it is", true, r->peak_omega) \
  PEAK_FREQUENCY(X) \
  X(ALL, REAL, peak_harmonic_1, "length", "|a1 + i b1| there", true, r->peak_harmonic_1) \
  X(ALL, INTEGER, reached_end, "", "1: the curve comes to the end of its sweep", true, r->reached_end) \
  X(ALL, INTEGER, arclength, "", "1: followed by arc length", true, r->arclength) \
  X(ALL, INTEGER, left_at_start, "", "1: the branch turned back and left the sweep where it began", true, \
    r->left_at_start) \
  X(IN_MEMORY, INTEGER, inaccurate, "", "1: hbm.accuracy was not met everywhere", true, r->inaccurate)

#define SPECIAL_COLUMNS(X) \
  AT_OMEGA(X, r->omega) \
  X(ALL, REAL, omega_error, "rad/time", "half width of where it is", true, r->omega_error) \
  X(ALL, REAL, amplitude, "length", "(max - min)/2 of the first response", true, r->amplitude) \
  BRANCH(X, true, r->branch) \
  X(ALL, TEXT, kind, "", "turning point, period doubling, contact change, Neimark-Sacker, symmetry breaking", true, \
    special_name(r->kind)) \
  X(ALL, TEXT, before, "", "strongest contact state before it", true, contact_regime_name(r->before)) \
  X(ALL, TEXT, after, "", "and after it", true, contact_regime_name(r->after))

#define ACCURACY_COLUMNS(X) \
  X(ALL, INTEGER, harmonics, "", "H", true, r->harmonics) \
  X(ALL, TEXT, force, "", "exact or sampled", true, r->samples > 0 ? "sampled" : "exact") \
  X(ALL, INTEGER, samples, "", "N", r->samples > 0, r->samples) \
  X(ALL, REAL, amplitude_error, "1", "largest over the orbits of the exact transient", true, r->worst) \
  X(ALL, REAL, amplitude_error_median, "1", "over the frequencies", true, r->median) \
  X(ALL, REAL, aliasing, "1", "largest difference to exact forces and the same H", true, r->aliasing) \
  X(ALL, REAL, peak_amplitude, "length", "of the curve", true, r->peak_amplitude) \
  X(ALL, REAL, peak_omega, "rad/time", "where it is", true, r->peak_omega) \
  PEAK_FREQUENCY(X) \
  X(ALL, REAL, peak_amplitude_error, "1", "of the curve's peak", true, r->peak_error) \
  X(ALL, REAL, peak_omega_error, "1", "of where it is", true, r->peak_omega_error) \
  X(ALL, INTEGER, turning_points, "", "of the curve", r->possible, r->turning_points) \
  X(ALL, INTEGER, false_turning_points, "", "that the exact curve does not have", r->possible, \
    r->false_turning_points) \
  X(ALL, INTEGER, rejected, "", "steps given up", r->possible, r->rejected) \
  X(ALL, INTEGER, missing, "", "orbits no solution is next to", r->possible, r->missing) \
  X(ALL, INTEGER, iterations, "", "of Newton", r->possible, r->iterations) \
  X(ALL, INTEGER, evaluations, "", "of the contact force", r->possible, r->evaluations) \
  X(ALL, REAL, seconds, "s", "processor time", true, r->seconds) \
  X(ALL, TEXT, curve, "", "whole, stopped or impossible", true, curve_text(r))

#define ORDER_COLUMNS(X) \
  X(ALL, TEXT, quantity, "", "what the error falls with", true, r->quantity) \
  X(ALL, INTEGER, harmonics, "", "H", r->harmonics > 0, r->harmonics) \
  AT_OMEGA(X, r->omega) \
  X(ALL, REAL, order, "1", "observed: error ~ quantity^-order", true, r->fit.order) \
  X(ALL, REAL, spread, "1", "its standard error", true, r->fit.spread) \
  X(ALL, REAL, from, "", "first of the quantity's values", true, r->fit.from) \
  X(ALL, REAL, to, "", "last of them", true, r->fit.to) \
  X(ALL, INTEGER, points, "", "of the fit", true, r->fit.points)

#define PERIOD_COLUMNS(X, p) \
  X(ALL, TEXT, regime, "", "the state of the contact: linear (never closed), stick, smooth, slip, separation", true, \
    contact_regime_name((p).regime)) \
  X(ALL, REAL, normal_min, "force", "least N, preload included", true, (p).normal_min) \
  X(ALL, REAL, normal_max, "force", "largest N", true, (p).normal_max) \
  X(ALL, REAL, traction_max, "force", "largest |T|", true, (p).traction_max) \
  X(ALL, REAL, slip_distance, "length", "path of the slider over the surface in a period", true, (p).slip_distance) \
  X(ALL, REAL, work, "force length", "what friction dissipates in a period", true, (p).work)

#define CONTACT_COLUMNS(X) \
  AT_OMEGA(X, r->omega) \
  BRANCH(X, true, r->branch) \
  ONE_CONTACT(X) \
  PERIOD_COLUMNS(X, r->period)

#define STEADY_CONTACT_COLUMNS(X) \
  AT_OMEGA(X, r->omega) \
  X(ALL, TEXT, start, "", "where the motion began", true, r->start) \
  ONE_CONTACT(X) \
  PERIOD_COLUMNS(X, r->period)

#define COMPARE_CONTACT_COLUMNS(X) \
  AT_OMEGA(X, r->omega) \
  BRANCH(X, true, r->branch) \
  ONE_CONTACT(X) \
  X(ALL, TEXT, verdict, "", "of the row", true, r->verdict) \
  X(ALL, TEXT, contact_verdict, "", \
    "differs where an error here is beyond the gate's waveform, or only one side touches; else match", \
    contact_comparison_made(r), r->differs ? "differs" : "match") \
  X(ALL, TEXT, hbm_regime, "", "the state of the contact", r->hbm_status == HC_OK, contact_regime_name(r->hbm.regime)) \
  X(ALL, TEXT, transient_regime, "", "the same, time integration", r->transient_status == HC_OK, \
    contact_regime_name(r->transient.regime)) \
  BOTH_SIDES(X, work, "force length", "what friction dissipates in a period", work) \
  X(ALL, REAL, work_error, "1", "relative to the largest work of any contact", true, r->work_error) \
  BOTH_SIDES(X, normal_min, "force", "least N, preload included", normal_min) \
  X(ALL, REAL, normal_error, "1", "relative to the largest N of this contact", true, r->normal_error) \
  BOTH_SIDES(X, normal_max, "force", "largest N", normal_max) \
  BOTH_SIDES(X, traction_max, "force", "largest |T|", traction_max) \
  BOTH_SIDES(X, slip_distance, "length", "path of the slider over the surface in a period", slip_distance) \
  X(IN_MEMORY, TEXT, hbm_status, "", "why this side is not known, or ok", true, hc_status_text(r->hbm_status)) \
  X(IN_MEMORY, TEXT, transient_status, "", "the same of time integration", true, hc_status_text(r->transient_status))

#define BOUNDS(X, name, unit, meaning, b) \
  X(ALL, REAL, name##_low, unit, "bound of " meaning ", rounded down", r->proven, (b).low) \
  X(ALL, REAL, name##_high, unit, "bound of " meaning ", rounded up", r->proven, (b).high)

#define PROVE_COLUMNS(X) \
  AT_OMEGA(X, r->omega) \
  X(ALL, INTEGER, branch, "", "turning points passed; empty: a steady state of time integration", r->branch >= 0, \
    r->branch) \
  X(ALL, TEXT, verdict, "", "proven or unproven", true, r->proven ? "proven" : "unproven") \
  X(ALL, TEXT, reason, "", "why it is unproven: docs/interface.md, 4", !r->proven, proof_reasons[r->reason].words) \
  X(ALL, TEXT, states, "", "letters of the contacts after each transition: O open, N closed, S stick, +, - slip", \
    *r->states, r->states) \
  X(ALL, INTEGER, transitions, "", "of the contacts in a period", r->multiple > 0, r->transitions) \
  X(ALL, REAL, radius, "1", "how far the orbit may be from the certificate's numbers, of its scales", r->proven, \
    r->radius) \
  X(ALL, TEXT, stability, "", "stable, unstable (both proven) or unproven", r->proven, stability_text(r->stability)) \
  BOUNDS(X, amplitude, "length", "(max - min)/2", r->amplitude) \
  BOUNDS(X, error, "length", "HBM's amplitude minus the orbit's", r->error) \
  X(ALL, TEXT, certificate, "", "its file", *r->certificate, r->certificate) \
  X(ALL, INTEGER, period_multiple, "", "periods of the load in one of the motion", r->multiple > 0, r->multiple) \
  BOUNDS(X, mean, "length", "the mean", r->mean) \
  BOUNDS(X, harmonic_1, "length", "|a1 + i b1|", r->harmonic_1) \
  BOUNDS(X, multiplier, "1", "the largest multiplier", r->multiplier) \
  X(ALL, REAL, hbm_amplitude, "length", "(max - min)/2", true, r->hbm_amplitude) \
  X(ALL, REAL, error_predicted, "length", "what HBM expected", true, r->predicted) \
  X(ALL, INTEGER, harmonics, "", "H with which HBM came to the orbit", r->harmonics > 0 && r->multiple > 0, \
    r->harmonics) \
  X(ALL, REAL, seconds, "s", "processor time", r->multiple > 0, r->seconds) \
  X(ALL, INTEGER, free_sliders, "", "how many never slip; above 0: one of a family", r->proven, r->free_sliders)

#define SURVEY_COLUMNS(X) \
  AT_OMEGA(X, r->steady.result.omega) \
  X(ALL, INTEGER, motion, "", "from 0, by falling share", true, r->motion) \
  RESPONSE(X, r->steady.response_name) \
  X(ALL, TEXT, verdict, "", \
    "settled, unstable, period_2, ..., aperiodic, not_settled, unbounded, creeps, solver_failed", true, \
    steady_verdict_text(&r->steady, (char[24]){0})) \
  X(ALL, INTEGER, period_multiple, "", "periods of the load in one of the motion; 0: it does not repeat", true, \
    settled(&r->steady) ? r->steady.result.period_multiple : 0) \
  MEASURES(X, measured(&r->steady), r->steady.result) \
  X(ALL, REAL, amplitude_low, "length", "least over its starts: of a family, or of what does not repeat", \
    measured(&r->steady), r->amplitude_low) \
  X(ALL, REAL, amplitude_high, "length", "largest over its starts", measured(&r->steady), r->amplitude_high) \
  MULTIPLIER(X, settled(&r->steady), r->steady.result.multiplier) \
  X(ALL, TEXT, stable, "", "yes, no or unknown", settled(&r->steady), \
    verdict_in_words(timeint_stability(&r->steady.result))) \
  STRONGEST_STATE(X, measured(&r->steady), r->steady.result.regime) \
  X(ALL, INTEGER, free_sliders, "", "how many sliders never slip; above 0: a family, by where they rest", \
    settled(&r->steady), r->steady.result.free_sliders) \
  DRIFT(X, r->steady.status, r->steady.result.drift) \
  X(ALL, REAL, share, "1", "of the starts that came to it", true, r->share) \
  X(ALL, INTEGER, starts, "", "that came to it", true, r->starts) \
  X(ALL, INTEGER, hbm_branch, "", \
    "of the HBM solution that it runs on; above all of the curve: one that the curve does not come to; empty: none", \
    on_hbm(r), r->hbm_branch) \
  X(ALL, REAL, hbm_error, "1", "largest |hbm - motion| over a period / the motion's amplitude", on_hbm(r), \
    r->hbm_error) \
  X(IN_MEMORY, TEXT, status, "", "why there is no steady state, or ok", true, hc_status_text(r->steady.status)) \
  X(IN_MEMORY, SERIES, wave, "length", "x at i/n of the last period, from the forcing's maximum on", \
    measured(&r->steady), ((row_series){TIMEINT_WAVE, r->steady.result.wave}))
/* clang-format on */

static void fill_REAL(row_cell *c, bool there, double value)
{
  *c = (row_cell){.kind = TABLE_REAL, .there = there && !isnan(value)};
  if (c->there) c->as.real = value;
}

static void fill_INTEGER(row_cell *c, bool there, long value)
{
  *c = (row_cell){.kind = TABLE_INTEGER, .there = there};
  if (there) c->as.integer = value;
}

static void fill_SERIES(row_cell *c, bool there, row_series value)
{
  *c = (row_cell){.kind = TABLE_SERIES, .there = there, .as.series = value};
}

static void fill_TEXT(row_cell *c, bool there, const char *value)
{
  *c = (row_cell){.kind = TABLE_TEXT, .there = there};
  if (there) snprintf(c->as.text, sizeof c->as.text, "%s", value);
}

/* ---- what a narrow screen does without: what says least comes first; a column in no list is never left out ---- */

/* The first name of each list is there for frequencies in cycles, where the same in rad says nothing more. */
/* clang-format off */
static const char *const of_frf[] = {
    "omega", "residual", "iterations", "multiplier", "rms", "min", "max", "mean", "harmonic_1", "contact", NULL};

static const char *const of_transient[] = {
    "omega", "steps", "period", "multiplier", "free_sliders", "period_multiple", "periods", "rms",
    "from_regularisation", "min", "max", "method", "contact", "lyapunov", "harmonic_1", "closure", "start",
    "mean", "window", "second_frequency", NULL};

static const char *const of_compare[] = {
    "omega", "hbm_predicted_harmonic_1", "hbm_predicted_waveform", "transient_predicted_harmonic_1",
    "transient_predicted_waveform", "budget_sum", "budget_observed", "orbit_multiplier", "orbit_amplitude",
    "hbm_harmonic_1", "transient_harmonic_1", "periods", "from_reduction", "from_settling", "from_integration",
    "unexpected", "band_low", "band_high", "from_history", "orbit_error", "from_aliasing",
    "from_truncation", "from_regularisation", "transient_predicted",
    "hbm_predicted", "mean_error", "band_kind", "harmonic_1_error", "largest_part", "waveform_error", NULL};

static const char *const of_accuracy[] = {
    "peak_omega", "amplitude_error_median", "peak_omega_error", "peak_amplitude_error", "iterations", "rejected",
    "turning_points", "peak_omega", "peak_frequency", "seconds", "evaluations", "missing", "peak_amplitude", "curve",
    NULL};

static const char *const of_contact[] = {"omega", "slip_distance", "normal_max", NULL};

static const char *const of_compare_contact[] = {
    "omega", "hbm_slip_distance", "transient_slip_distance", "hbm_normal_max", "transient_normal_max",
    "hbm_traction_max", "transient_traction_max", "hbm_normal_min", "transient_normal_min",
    "normal_error", "verdict", NULL};

static const char *const of_prove[] = {
    "omega", "seconds", "free_sliders", "harmonics", "mean_low", "mean_high", "harmonic_1_low", "harmonic_1_high",
    "multiplier_low", "multiplier_high", "hbm_amplitude", "period_multiple", "radius", "transitions", "error_predicted",
    "certificate", "states", "amplitude_high", "reason", NULL};

static const char *const of_survey[] = {
    "omega", "multiplier", "free_sliders", "period_multiple", "rms", "hbm_error", "drift", "min", "max", "harmonic_1",
    "contact", "mean", "amplitude_low", "amplitude_high", NULL};

static const char *const of_others[] = {"omega", NULL};
/* clang-format on */

/* ---- every kind ---- */

enum {
  ALL,
  IN_CYCLES = ROWS_IN_CYCLES,
  RESPONSES = ROWS_RESPONSES,
  IN_MEMORY = ROWS_IN_MEMORY,
  WITH_BANDS = ROWS_BANDS
};

typedef struct row_column {
  table_column column;
  unsigned where; /* ALL, or what has to be asked for */
} row_column;

/* Its columns, and the function of each value: at: its place among all. */
/* clang-format off */
#define COLUMN(where, kind, name, unit, meaning, there, value) {{#name, TABLE_##kind, unit, meaning}, where},
#define PLACE(where, kind, name, unit, meaning, there, value) at_##name,
#define VALUE(where, kind, name, unit, meaning, there, value) case at_##name: fill_##kind(c, there, value); break;
#define KIND_OF(kind, name, row, LIST, spare) \
  static const row_column name##_columns[] = {LIST(COLUMN)}; \
  _Static_assert(LENGTH(name##_columns) <= ROWS_MOST, "callers keep ROWS_MOST cells"); \
  static void name##_value(const void *of, int at, row_cell *c) \
  { \
    enum { LIST(PLACE) }; \
    const row *r = of; \
    switch (at) { LIST(VALUE) } \
  }
#define LENGTH(list) (int)(sizeof(list) / sizeof *(list))
/* X(kind of rows_kind, name, type of a row, its columns, those to spare) */
#define KINDS(X) \
  X(ROWS_FRF, frf, response_row, FRF_COLUMNS, of_frf) \
  X(ROWS_TRANSIENT, transient, steady_row, TRANSIENT_COLUMNS, of_transient) \
  X(ROWS_COMPARE, compare, comparison_row, COMPARE_COLUMNS, of_compare) \
  X(ROWS_CURVE, curve, response_summary, CURVE_COLUMNS, of_others) \
  X(ROWS_SPECIALS, special, hbm_special, SPECIAL_COLUMNS, of_others) \
  X(ROWS_ACCURACY, accuracy, accuracy_row, ACCURACY_COLUMNS, of_accuracy) \
  X(ROWS_ORDER, order, order_row, ORDER_COLUMNS, of_others) \
  X(ROWS_CONTACT, contact, contact_row, CONTACT_COLUMNS, of_contact) \
  X(ROWS_STEADY_CONTACT, steady_contact, steady_contact, STEADY_CONTACT_COLUMNS, of_contact) \
  X(ROWS_COMPARE_CONTACT, compare_contact, contact_comparison, COMPARE_CONTACT_COLUMNS, of_compare_contact) \
  X(ROWS_PROVE, prove, proof_row, PROVE_COLUMNS, of_prove) \
  X(ROWS_SURVEY, survey, survey_row, SURVEY_COLUMNS, of_survey)
KINDS(KIND_OF)

#define KIND(kind, name, row, LIST, spare) \
  [kind] = {#name, name##_columns, LENGTH(name##_columns), name##_value, sizeof(row), spare},
static const struct kind {
  const char *name;
  const row_column *columns;
  int n;
  void (*value)(const void *row, int at, row_cell *c);
  size_t size; /* of a row */
  const char *const *spare;
} kinds[] = {KINDS(KIND)};
/* clang-format on */

static bool is_in(const row_column *c, unsigned extra) { return (c->where & ~extra) == 0; }

const char *rows_name(rows_kind kind) { return kinds[kind].name; }

int rows_columns(rows_kind kind, unsigned extra, table_column columns[ROWS_MOST])
{
  const struct kind *k = &kinds[kind];
  int n = 0;
  for (int i = 0; i < k->n; ++i)
    if (is_in(&k->columns[i], extra)) columns[n++] = k->columns[i].column;
  return n;
}

int rows_cells(rows_kind kind, const void *row, unsigned extra, row_cell *cells)
{
  const struct kind *k = &kinds[kind];
  int n = 0;
  for (int i = 0; i < k->n; ++i)
    if (is_in(&k->columns[i], extra)) k->value(row, i, &cells[n++]);
  return n;
}

const void *rows_at(rows_kind kind, const void *rows, int i)
{
  return (const char *)rows + (size_t)i * kinds[kind].size;
}

const char *const *rows_spare(rows_kind kind, bool in_cycles) { return kinds[kind].spare + !in_cycles; }

const char *rows_special_text(const hbm_special *p, char text[ROWS_SPECIAL])
{
  const char *from = contact_regime_name(p->before), *to = contact_regime_name(p->after);
  if (p->kind == HBM_TURNING_POINT) snprintf(text, ROWS_SPECIAL, "turning point");
  else if (p->kind == HBM_PERIOD_DOUBLING) snprintf(text, ROWS_SPECIAL, "period doubling");
  else if (p->kind == HBM_NEIMARK_SACKER) snprintf(text, ROWS_SPECIAL, "Neimark-Sacker point");
  else if (p->kind == HBM_SYMMETRY_BREAKING) snprintf(text, ROWS_SPECIAL, "symmetry breaking");
  else if (p->before != p->after) snprintf(text, ROWS_SPECIAL, "contact goes from %s to %s", from, to);
  else snprintf(text, ROWS_SPECIAL, "contact pattern changes (%s)", to);
  return text;
}

const char *rows_with_error(double value, double error, char text[ROWS_WITH_ERROR])
{
  const int most = 10;
  const double decimals = error > 0 ? fmax(1 - floor(log10(error)), 0) : most; /* two digits of the error */
  if (isinf(error)) snprintf(text, ROWS_WITH_ERROR, "%.*f (error not known)", most, value);
  else if (!(decimals < most)) snprintf(text, ROWS_WITH_ERROR, "%.*f", most, value);
  else snprintf(text, ROWS_WITH_ERROR, "%.*f +- %.*f", (int)decimals, value, (int)decimals, error);
  return text;
}
