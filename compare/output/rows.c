/* rows.c - see rows.h. Each list is written once and expanded twice: to the columns, and to the function that fills
 * a row.
 *   X(kind, name, is it there, value)   with r the row; C(...): only where the sweep is in cycles per time; R(...):
 *   only where the model is a structure */
#include "compare/output/rows.h"

#include <string.h>

#include "compare/motion.h"
#include "numerics/base/constants.h"

/* Questions about a row, for the lists below. */
static bool settled(const steady_row *r) { return r->status == HC_OK; }
static bool measured(const steady_row *r) { return motion_is_measured(r->status); }
static bool prediction_known(const comparison_row *r)
{
  return !r->family && !isnan(r->hbm_predicted.amplitude) && !isnan(r->transient_predicted.amplitude);
}
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
static const char *stable_text(const response_row *r)
{
  int stable = r->stability_known ? hbm_stability_verdict(&r->stability) : 0;
  return stable > 0 ? "yes" : stable < 0 ? "no" : "unknown";
}

static const char *stability_text(int s) { return s > 0 ? "stable" : s < 0 ? "unstable" : "unproven"; }

/* clang-format off */
/* ---- what several kinds have ---- */
#define AT_OMEGA(X, C, at) \
  X(REAL,    "omega",      true, at) \
  C(REAL,    "frequency",  true, (at) / TWO_PI)

#define MEASURES(X, there, m) \
  X(REAL,    "amplitude",  there, (m).amplitude) \
  X(REAL,    "max",        there, (m).max) \
  X(REAL,    "min",        there, (m).min) \
  X(REAL,    "rms",        there, (m).rms) \
  X(REAL,    "mean",       there, (m).mean) \
  X(REAL,    "harmonic_1", there, (m).harmonic_1)

#define ONE_CONTACT(X, R) \
  X(INTEGER, "contact",    true, r->contact) \
  R(TEXT,    "name",       *r->name, r->name)

/* ---- each kind ---- */
#define FRF_COLUMNS(X, C, R)                                                   \
  AT_OMEGA(X, C, r->point.omega) \
  X(INTEGER, "branch",     true, r->point.branch)                           \
  R(TEXT,    "response",   true, r->response)                               \
  MEASURES(X, true, r->measures) \
  X(TEXT,    "stable",     true, stable_text(r))                            \
  X(REAL,    "multiplier", r->stability_known, r->stability.multiplier)     \
  X(TEXT,    "contact",    true, contact_regime_name(r->measures.contact.regime)) \
  X(INTEGER, "iterations", true, r->point.iterations)                       \
  X(REAL,    "residual",   true, r->point.residual)                         \
  X(TEXT,    "mean_free",  true, yes_no(r->measures.contact.free_sliders > 0))

#define TRANSIENT_COLUMNS(X, C, R)                                             \
  AT_OMEGA(X, C, r->result.omega) \
  R(TEXT,    "response",   true, r->response_name)                          \
  X(TEXT,    "verdict",    true, steady_verdict_text(r, (char[24]){0}))     \
  MEASURES(X, measured(r), r->result) \
  X(INTEGER, "periods",    true, r->result.periods)                         \
  X(REAL,    "closure",    measured(r), r->result.closure)                  \
  X(INTEGER, "period_multiple", true, settled(r) ? r->result.period_multiple : 0) \
  X(INTEGER, "steps",      true, r->result.steps)                           \
  X(TEXT,    "contact",    measured(r), contact_regime_name(r->result.regime)) \
  X(TEXT,    "start",      true, r->start)                                  \
  X(TEXT,    "method",     settled(r), timeint_method_name(r->result.method)) \
  X(REAL,    "multiplier", settled(r), r->result.multiplier)                \
  X(INTEGER, "free_sliders", settled(r), r->result.free_sliders)            \
  X(REAL,    "lyapunov",   measured(r), r->result.lyapunov)                 \
  X(REAL,    "from_regularisation", settled(r), r->from_regularisation)     \
  X(TEXT,    "mean_free",  settled(r), yes_no(motion_mean_is_free(&r->result))) \
  R(REAL,    "second_frequency", measured(r), r->result.second_frequency) \
  X(REAL,    "drift",      r->status == HC_CREEPS, r->result.drift)

#define COMPARE_COLUMNS(X, C, R)                                               \
  AT_OMEGA(X, C, r->omega) \
  X(INTEGER, "branch",              r->branch >= 0, r->branch)              \
  R(TEXT,    "response",            true, r->response_name)                 \
  X(TEXT,    "verdict",             true, comparison_verdict_text(r, (char[24]){0})) \
  X(REAL,    "hbm_amplitude",       has_hbm(r), r->hbm.amplitude)           \
  X(REAL,    "transient_amplitude", has_transient(r), r->transient.amplitude) \
  X(REAL,    "amplitude_error",     true, r->errors.amplitude)              \
  X(REAL,    "harmonic_1_error",    true, r->errors.harmonic_1)             \
  X(REAL,    "mean_error",          true, r->errors.mean)                   \
  X(REAL,    "waveform_error",      true, r->errors.waveform)               \
  X(REAL,    "from_aliasing",       true, r->budget.amplitude.aliasing)     \
  X(REAL,    "from_truncation",     true, r->budget.amplitude.truncation)   \
  X(REAL,    "from_regularisation", true, r->budget.amplitude.regularisation) \
  X(REAL,    "from_integration",    true, r->budget.amplitude.integration)  \
  X(REAL,    "from_settling",       true, r->budget.amplitude.settling)     \
  R(REAL,    "from_reduction",      true, r->budget.reduction)              \
  X(REAL,    "hbm_harmonic_1",      has_hbm(r), r->hbm.harmonic_1)          \
  X(REAL,    "transient_harmonic_1", has_transient(r), r->transient.harmonic_1) \
  X(INTEGER, "periods",             has_transient(r), r->transient.periods) \
  X(REAL,    "orbit_amplitude",     has_orbit(r), r->orbit.amplitude)       \
  X(REAL,    "orbit_multiplier",    has_orbit(r), r->orbit.multiplier)      \
  X(REAL,    "orbit_error",         true, r->orbit_errors.waveform)         \
  X(REAL,    "budget_sum",          r->budget.known, r->budget.amplitude.sum) \
  X(REAL,    "budget_observed",     r->budget.known, r->budget.amplitude.observed) \
  X(TEXT,    "largest_part",        largest_part(r) != NULL, largest_part(r)) \
  X(REAL,    "hbm_predicted",       true, r->hbm_predicted.amplitude)       \
  X(REAL,    "transient_predicted", true, r->transient_predicted.amplitude) \
  X(REAL,    "hbm_predicted_harmonic_1", true, r->hbm_predicted.harmonic_1) \
  X(REAL,    "hbm_predicted_waveform", true, r->hbm_predicted.waveform)     \
  X(REAL,    "transient_predicted_harmonic_1", true, r->transient_predicted.harmonic_1) \
  X(REAL,    "transient_predicted_waveform", true, r->transient_predicted.waveform) \
  X(TEXT,    "unexpected",          prediction_known(r), yes_no(r->unexpected)) \
  X(TEXT,    "mean_free",           has_hbm(r), yes_no(comparison_mean_free(r))) \
  X(REAL,    "drift",               r->transient_status == HC_CREEPS, r->transient.drift)

#define CURVE_COLUMNS(X, C, R)                                                 \
  X(INTEGER, "harmonics",       true, r->harmonics)                         \
  X(INTEGER, "samples",         r->samples > 0, r->samples)                 \
  X(INTEGER, "points",          true, r->points)                            \
  X(INTEGER, "rejected",        true, r->rejected)                          \
  X(INTEGER, "turning_points",  true, r->turning_points)                    \
  X(INTEGER, "iterations",      true, r->iterations)                        \
  X(INTEGER, "evaluations",     true, r->evaluations)                       \
  X(REAL,    "peak_amplitude",  true, r->peak_amplitude)                    \
  X(REAL,    "peak_omega",      true, r->peak_omega)                        \
  C(REAL,    "peak_frequency",  true, r->peak_omega / TWO_PI)               \
  X(REAL,    "peak_harmonic_1", true, r->peak_harmonic_1)                   \
  X(INTEGER, "reached_end",     true, r->reached_end)                       \
  X(INTEGER, "arclength",       true, r->arclength)                         \
  X(INTEGER, "left_at_start",   true, r->left_at_start)

#define ACCURACY_COLUMNS(X, C, R)                                              \
  X(INTEGER, "harmonics",       true, r->harmonics)                         \
  X(TEXT,    "force",           true, r->samples > 0 ? "sampled" : "exact") \
  X(INTEGER, "samples",         r->samples > 0, r->samples)                 \
  X(REAL,    "amplitude_error", true, r->worst)                             \
  X(REAL,    "amplitude_error_median", true, r->median)                     \
  X(REAL,    "aliasing",        true, r->aliasing)                          \
  X(REAL,    "peak_amplitude",  true, r->peak_amplitude)                    \
  X(REAL,    "peak_omega",      true, r->peak_omega)                        \
  C(REAL,    "peak_frequency",  true, r->peak_omega / TWO_PI)               \
  X(REAL,    "peak_amplitude_error", true, r->peak_error)                   \
  X(REAL,    "peak_omega_error", true, r->peak_omega_error)                 \
  X(INTEGER, "turning_points",  r->possible, r->turning_points)             \
  X(INTEGER, "false_turning_points", r->possible, r->false_turning_points)  \
  X(INTEGER, "rejected",        r->possible, r->rejected)                   \
  X(INTEGER, "missing",         r->possible, r->missing)                    \
  X(INTEGER, "iterations",      r->possible, r->iterations)                 \
  X(INTEGER, "evaluations",     r->possible, r->evaluations)                \
  X(REAL,    "seconds",         true, r->seconds)                           \
  X(TEXT,    "curve",           true, curve_text(r))

#define ORDER_COLUMNS(X, C, R)                                                 \
  X(TEXT,    "quantity",        true, r->quantity)                          \
  X(INTEGER, "harmonics",       r->harmonics > 0, r->harmonics)             \
  AT_OMEGA(X, C, r->omega) \
  X(REAL,    "order",           true, r->fit.order)                         \
  X(REAL,    "spread",          true, r->fit.spread)                        \
  X(REAL,    "from",            true, r->fit.from)                          \
  X(REAL,    "to",              true, r->fit.to)                            \
  X(INTEGER, "points",          true, r->fit.points)

#define PERIOD_COLUMNS(X, p)                                                   \
  X(TEXT,    "regime",        true, contact_regime_name((p).regime))        \
  X(REAL,    "normal_min",    true, (p).normal_min)                         \
  X(REAL,    "normal_max",    true, (p).normal_max)                         \
  X(REAL,    "traction_max",  true, (p).traction_max)                       \
  X(REAL,    "slip_distance", true, (p).slip_distance)                      \
  X(REAL,    "work",          true, (p).work)

#define CONTACT_COLUMNS(X, C, R)                                               \
  AT_OMEGA(X, C, r->omega) \
  X(INTEGER, "branch",        true, r->branch)                              \
  ONE_CONTACT(X, R) \
  PERIOD_COLUMNS(X, r->period)

#define STEADY_CONTACT_COLUMNS(X, C, R)                                        \
  AT_OMEGA(X, C, r->omega) \
  X(TEXT,    "start",         true, r->start)                               \
  ONE_CONTACT(X, R) \
  PERIOD_COLUMNS(X, r->period)

#define BOTH_SIDES(X, name, member)                                            \
  X(REAL,    "hbm_" name,       r->hbm_status == HC_OK, r->hbm.member)      \
  X(REAL,    "transient_" name, r->transient_status == HC_OK, r->transient.member)

#define COMPARE_CONTACT_COLUMNS(X, C, R)                                       \
  AT_OMEGA(X, C, r->omega) \
  X(INTEGER, "branch",        true, r->branch)                              \
  ONE_CONTACT(X, R) \
  X(TEXT,    "verdict",       true, r->verdict)                             \
  X(TEXT,    "contact_verdict", contact_comparison_made(r), r->differs ? "differs" : "match") \
  X(TEXT,    "hbm_regime",    r->hbm_status == HC_OK, contact_regime_name(r->hbm.regime)) \
  X(TEXT,    "transient_regime", r->transient_status == HC_OK, contact_regime_name(r->transient.regime)) \
  BOTH_SIDES(X, "work", work)                                               \
  X(REAL,    "work_error",    true, r->work_error)                          \
  BOTH_SIDES(X, "normal_min", normal_min)                                   \
  X(REAL,    "normal_error",  true, r->normal_error)                        \
  BOTH_SIDES(X, "normal_max", normal_max)                                   \
  BOTH_SIDES(X, "traction_max", traction_max)                               \
  BOTH_SIDES(X, "slip_distance", slip_distance)

#define BOUNDS(X, name, b)                                                     \
  X(REAL,    name "_low",       r->proven, (b).low)                         \
  X(REAL,    name "_high",      r->proven, (b).high)

#define PROVE_COLUMNS(X, C, R)                                                 \
  AT_OMEGA(X, C, r->omega) \
  X(INTEGER, "branch",          r->branch >= 0, r->branch)                  \
  X(TEXT,    "verdict",         true, r->proven ? "proven" : "unproven")    \
  X(TEXT,    "reason",          !r->proven, proof_reason_text(r->reason))   \
  X(TEXT,    "states",          *r->states, r->states)                      \
  X(INTEGER, "transitions",     r->multiple > 0, r->transitions)                 \
  X(REAL,    "radius",          r->proven, r->radius)                       \
  X(TEXT,    "stability",       r->proven, stability_text(r->stability))    \
  BOUNDS(X, "amplitude", r->amplitude)                                      \
  BOUNDS(X, "error", r->error)                                              \
  X(TEXT,    "certificate",     *r->certificate, r->certificate)            \
  X(INTEGER, "period_multiple", r->multiple > 0, r->multiple)                    \
  BOUNDS(X, "mean", r->mean)                                                \
  BOUNDS(X, "harmonic_1", r->harmonic_1)                                    \
  BOUNDS(X, "multiplier", r->multiplier)                                    \
  X(REAL,    "hbm_amplitude",   true, r->hbm_amplitude)                     \
  X(REAL,    "error_predicted", true, r->predicted)                         \
  X(INTEGER, "harmonics",       r->harmonics > 0 && r->multiple > 0, r->harmonics) \
  X(REAL,    "seconds",         r->multiple > 0, r->seconds)                \
  X(INTEGER, "free_sliders",    r->proven, r->free_sliders)
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
    "omega", "steps", "multiplier", "free_sliders", "period_multiple", "periods", "rms", "from_regularisation", "min",
    "max", "method", "contact", "lyapunov", "harmonic_1", "closure", "start", "mean", "second_frequency", NULL};

static const char *const of_compare[] = {
    "omega", "hbm_predicted_harmonic_1", "hbm_predicted_waveform", "transient_predicted_harmonic_1",
    "transient_predicted_waveform", "budget_sum", "budget_observed", "orbit_multiplier", "orbit_amplitude",
    "hbm_harmonic_1", "transient_harmonic_1", "periods", "from_reduction", "from_settling", "from_integration",
    "unexpected", "orbit_error", "from_aliasing", "from_truncation", "from_regularisation", "transient_predicted",
    "hbm_predicted", "mean_error", "harmonic_1_error", "largest_part", "waveform_error", NULL};

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

static const char *const of_others[] = {"omega", NULL};
/* clang-format on */

/* ---- every kind ---- */

#define COLUMN(kind, name, there, value) {name, TABLE_##kind},
#define NONE(kind, name, there, value)
#define FILL(kind, name, there, value) fill_##kind(cells++, there, value);
#define FILL_CYCLES(kind, name, there, value)                                                                          \
  if (extra & ROWS_IN_CYCLES) FILL(kind, name, there, value)
#define FILL_RESPONSE(kind, name, there, value)                                                                        \
  if (extra & ROWS_RESPONSES) FILL(kind, name, there, value)

/* Its columns with each sum of extra ones, and what fills a row. */
/* clang-format off */
#define KIND_OF(kind, name, row, LIST, spare) \
  static const table_column name##_plain[] = {LIST(COLUMN, NONE, NONE)}, \
                            name##_in_cycles[] = {LIST(COLUMN, COLUMN, NONE)}, \
                            name##_responses[] = {LIST(COLUMN, NONE, COLUMN)}, \
                            name##_both[] = {LIST(COLUMN, COLUMN, COLUMN)}; \
  _Static_assert(LENGTH(name##_both) <= ROWS_MOST, "callers keep ROWS_MOST cells"); \
  static void name##_cells(const void *of, unsigned extra, row_cell *cells) \
  { \
    const row *r = of; \
    (void)extra; \
    LIST(FILL, FILL_CYCLES, FILL_RESPONSE) \
  }
#define LENGTH(list) (sizeof(list) / sizeof *(list))
/* X(kind of rows_kind, name, type of a row, its columns, those to spare) */
#define KINDS(X) \
  X(ROWS_FRF, frf, response_row, FRF_COLUMNS, of_frf) \
  X(ROWS_TRANSIENT, transient, steady_row, TRANSIENT_COLUMNS, of_transient) \
  X(ROWS_COMPARE, compare, comparison_row, COMPARE_COLUMNS, of_compare) \
  X(ROWS_CURVE, curve, response_summary, CURVE_COLUMNS, of_others) \
  X(ROWS_ACCURACY, accuracy, accuracy_row, ACCURACY_COLUMNS, of_accuracy) \
  X(ROWS_ORDER, order, order_row, ORDER_COLUMNS, of_others) \
  X(ROWS_CONTACT, contact, contact_row, CONTACT_COLUMNS, of_contact) \
  X(ROWS_STEADY_CONTACT, steady_contact, steady_contact, STEADY_CONTACT_COLUMNS, of_contact) \
  X(ROWS_COMPARE_CONTACT, compare_contact, contact_comparison, COMPARE_CONTACT_COLUMNS, of_compare_contact) \
  X(ROWS_PROVE, prove, proof_row, PROVE_COLUMNS, of_prove)
KINDS(KIND_OF)

#define KIND(kind, name, row, LIST, spare) \
  [kind] = {{{name##_plain, LENGTH(name##_plain)}, {name##_in_cycles, LENGTH(name##_in_cycles)}, \
             {name##_responses, LENGTH(name##_responses)}, {name##_both, LENGTH(name##_both)}}, \
            name##_cells, sizeof(row), spare},
static const struct kind {
  struct {
    const table_column *columns;
    int n;
  } with[4]; /* [a sum of extra columns] */
  void (*cells)(const void *row, unsigned extra, row_cell *cells);
  size_t size; /* of a row */
  const char *const *spare;
} kinds[] = {KINDS(KIND)};
/* clang-format on */

const table_column *rows_columns(rows_kind kind, unsigned extra, int *n)
{
  *n = kinds[kind].with[extra].n;
  return kinds[kind].with[extra].columns;
}

void rows_cells(rows_kind kind, const void *row, unsigned extra, row_cell *cells)
{
  kinds[kind].cells(row, extra, cells);
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
