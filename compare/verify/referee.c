/* referee.c - the truth at some of the points against the exact law's periodic orbits next to it. */
#include <math.h>
#include <string.h>

#include "compare/first_guess.h"
#include "compare/motion.h"
#include "compare/verify/acceleration.h"
#include "compare/verify/truth_impl.h"

enum { MOST_CHECKS = 20 };

/* The file's quantity, of the orbit next to the row's solution, by as many harmonics as its samples tell apart. */
static double orbit_quantity(const truth *t, const timeint_result *orbit)
{
  enum { HARMONICS = 200 };
  double X[2 * HARMONICS + 1];
  const periodic_motion wave = motion_of_transient(orbit);
  const verify_quantity *q = &t->data->quantity;
  motion_harmonics(&wave, HARMONICS, X);
  X[0] = orbit->mean;
  X[1] = orbit->a1;
  X[2] = orbit->b1;
  const verify_motion motion = {
      .omega = orbit->omega, .max = orbit->max, .min = orbit->min, .n_harm = HARMONICS, .X = X};
  if (q->kind == KIND_ACCELERATION) {
    memset(t->room, 0, (size_t)t->setup->model->n_contacts * sizeof *t->room);
    return acceleration_amplitude(t->setup->model, &motion, t->room);
  }
  return q->kind == KIND_RMS ? orbit->rms : verify_quantity_of(q, &motion);
}

static hc_status check_row(truth *t, const verify_row *row)
{
  hbm_curve at = {0};
  measured m = {0};
  timeint_result orbit;
  hc_status st = truth_at(t, row->omega, &at), found = HC_NOT_CONVERGED;
  int k = st == HC_OK ? truth_nearest(t, &at, row, &m) : -1;
  if (k >= 0) {
    found = comparison_orbit_start(t->hbm, at.X + (size_t)k * at.n_coef, row->omega, t->state);
    if (found == HC_OK) found = timeint_orbit(t->referee, row->omega, 1, t->state, t->monitor, &orbit);
    if (found == HC_INTERRUPTED || found == HC_NO_MEMORY) st = found;
  }
  hbm_curve_free(&at);
  if (found != HC_OK || (verify_quantity_of_mean(&t->data->quantity) && motion_mean_is_free(&orbit))) {
    ++t->out->unchecked;
    return st;
  }
  double error = fabs(orbit_quantity(t, &orbit) - m.value);
  if (isnan(error)) return ++t->out->unchecked, st;
  ++t->out->checked;
  if (error > 0) t->out->checked_error = fmax(t->out->checked_error, error / m.scale);
  return st;
}

hc_status truth_check(truth *t)
{
  verify_report *out = t->out;
  hc_status st = HC_OK;
  int n = out->n_rows < MOST_CHECKS ? out->n_rows : MOST_CHECKS;
  out->checked = out->unchecked = 0;
  out->checked_error = 0;
  for (int i = 0; i < n && st == HC_OK; ++i) {
    const verify_row *row = &out->rows[n > 1 ? (int)((long)i * (out->n_rows - 1) / (n - 1)) : 0];
    if (row->branch >= 0 && !row->skipped) st = check_row(t, row);
    if (!hc_monitor_tick(t->monitor, -1)) st = HC_INTERRUPTED;
  }
  return st;
}
