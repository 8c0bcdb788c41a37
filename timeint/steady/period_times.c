/* period_times.c - see period_times.h. Proof: tests/compare/test_duration.c. */
#include "timeint/steady/period_times.h"

#include "numerics/base/thread_clock.h"
#include "timeint/closed_form/series_columns.h"
#include "timeint/steady/timeint_private.h"

/* [1] What a monodromy matrix takes of a plain period, for each state. In closed form, of structures in
 * cases/structures/: bladed_disk 0.11, plates 0.12, blade_damper 0.23, beam_pairs 0.43, blade_damper_reduced 0.55. By
 * CVODES: beam16. At rest no contact changes its state: blade_damper at 280. In between, by the share that changes. */
static const double matrix_by_closed_form = 0.25, matrix_at_rest = 0.025, matrix_by_cvodes = 0.7;

/* [s] of the last of `count` periods from `state`: the first may keep modes for the others (interval_modes.h). */
static hc_status time_period(timeint *ti, double omega, const double *state, int count, const hc_monitor *monitor,
                             double *seconds)
{
  hc_status st = timeint_begin(ti, omega, state);
  const hc_monitor *before = timeint_hear(ti, monitor);
  for (int i = 0; i < count && st == HC_OK; ++i) {
    const double began = thread_seconds();
    st = integrate_period(ti->in, &ti->scaled, ti->y, NULL, NULL);
    *seconds = thread_seconds() - began;
  }
  timeint_hear(ti, before);
  return st == HC_INTERRUPTED ? HC_OK : st;
}

hc_status timeint_time_periods(timeint *ti, double omega, const double *state, const hc_monitor *monitor,
                               period_times *out)
{
  const bool closed = ti->how.method == TRANSIENT_METHOD_CLOSED_FORM;
  timeint *whole = closed ? ti : ti->closed_form;
  *out = (period_times){.chords = whole && whole->slowed};
  hc_status st = closed ? HC_OK : time_period(ti, omega, state, 1, monitor, &out->by_cvode);
  const bool regularised = ti->how.law != TRANSIENT_LAW_EXACT;
  out->cvodes_matrix = regularised ? matrix_by_cvodes * ti->n * out->by_cvode : 0;
  out->matrix = regularised ? out->cvodes_matrix : out->by_cvode;
  if (!whole || st != HC_OK) return st;
  const long changes = integrate_transitions(whole->in);
  st = time_period(whole, omega, state, out->chords ? 1 : 2, monitor, &out->closed_form);
  const double changed = (double)(integrate_transitions(whole->in) - changes), all = 2.0 * ti->scaled.n_contacts;
  const double moving = out->chords && ti->n <= SERIES_COLUMNS_SQUARED ? fmin(changed / fmax(all, 1), 1) : 1;
  double plain = out->closed_form;
  if (out->chords && st == HC_OK) st = time_period(whole->slowed, omega, state, 1, monitor, &plain);
  out->matrix = (matrix_at_rest + moving * (matrix_by_closed_form - matrix_at_rest)) * ti->n * plain;
  return st;
}
