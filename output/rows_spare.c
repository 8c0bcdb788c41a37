/* rows_spare.c - what each kind of result shows on a screen too narrow for all its columns. What says least comes
 * first; a column that stands in no list is never left out. */
#include <stddef.h>

#include "output/rows.h"

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
    "hbm_harmonic_1", "transient_harmonic_1", "periods", "from_settling", "from_integration", "unexpected",
    "orbit_error", "from_aliasing", "from_truncation", "from_regularisation", "transient_predicted", "hbm_predicted",
    "mean_error", "harmonic_1_error", "largest_part", "waveform_error", NULL};

static const char *const of_accuracy[] = {
    "peak_omega", "amplitude_error_median", "peak_omega_error", "peak_amplitude_error", "iterations", "rejected",
    "turning_points", "peak_omega", "peak_frequency", "seconds", "evaluations", "missing", "peak_amplitude", "curve",
    NULL};

static const char *const of_contact[] = {"omega", "slip_distance", "normal_max", NULL};

static const char *const of_compare_contact[] = {
    "omega", "hbm_slip_distance", "transient_slip_distance", "hbm_normal_max", "transient_normal_max",
    "hbm_traction_max", "transient_traction_max", "hbm_normal_min", "transient_normal_min",
    "normal_error", "verdict", NULL};

static const char *const of_others[] = {"omega", NULL};
/* clang-format on */

const char *const *rows_spare(rows_kind kind, bool in_cycles)
{
  static const char *const *const lists[] = {
      [ROWS_FRF] = of_frf,         [ROWS_TRANSIENT] = of_transient,    [ROWS_COMPARE] = of_compare,
      [ROWS_CURVE] = of_others,    [ROWS_ACCURACY] = of_accuracy,      [ROWS_ORDER] = of_others,
      [ROWS_CONTACT] = of_contact, [ROWS_STEADY_CONTACT] = of_contact, [ROWS_COMPARE_CONTACT] = of_compare_contact};
  return lists[kind] + !in_cycles;
}
