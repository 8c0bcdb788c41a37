/* regularised.c - see regularised.h. Proof: tests/timeint/test_sizes.c. */
#include "timeint/steady/regularised.h"

#include <complex.h>

#include "numerics/norm.h"
#include "timeint/steady/confirm.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/timeint_private.h"

static const double same_width = 0.01; /* [1] of width: a second-order error is 2 % another then */
static const double still = 1e-9;      /* [largest amplitude] a response that moves less does not count */
enum { MOST_HALVINGS = 12 };           /* 1e-4 becomes 2e-8 */

/* True if a corner of contact j's law acts on the orbit measured. */
static bool acts(const timeint *ti, int j)
{
  const scaled_contact *c = &ti->scaled.contact[j];
  const contact_range *v = &ti->measure.range[ti->measure.n_contacts + j];
  const double soft = LAW_SOFT_END * c->law.width;
  if (c->kind->smooth && c->law.kn == 0) return false;
  const bool slips = c->law.has_friction && ti->measure.seen[j] & SEEN_SLIPPING;
  return slips || (c->law.kn > 0 && v->min + c->law.gap <= soft && v->max + c->law.gap >= -soft);
}

static bool any_acts(const timeint *ti)
{
  for (int j = 0; j < ti->scaled.n_contacts; ++j)
    if (acts(ti, j)) return true;
  return false;
}

/* True if the corners' widths are those of the orbit measured. */
static bool widths_fit(const timeint *ti)
{
  for (int j = 0; j < ti->scaled.n_contacts; ++j) {
    const contact_range *v = &ti->measure.range[ti->measure.n_contacts + j];
    const double moves = motion_amplitude(v->max, v->min) * ti->length;
    if (acts(ti, j) && !(fabs(ti->scaled.vibration[j] - moves) <= same_width * moves)) return false;
  }
  return true;
}

/* [length] (max - min)/2 of response i on the orbit measured. */
static double regularised_amplitude(const timeint *ti, int i)
{
  return motion_amplitude(ti->measure.response[i].max, ti->measure.response[i].min) * ti->length;
}

/* The largest relative difference of amplitudes on the orbit measured from those before[responses]. */
static double largest_change(const timeint *ti, const double *before)
{
  double most = 0, error = 0;
  for (int i = 0; i < ti->measure.n_responses; ++i) most = fmax(most, before[i]);
  for (int i = 0; i < ti->measure.n_responses; ++i)
    if (before[i] > still * most) error = larger(error, fabs(regularised_amplitude(ti, i) / before[i] - 1));
  return error;
}

static void note_amplitudes(const timeint *of, double *amplitudes)
{
  for (int i = 0; i < of->measure.n_responses; ++i) amplitudes[i] = regularised_amplitude(of, i);
}

/* The orbit next to ti->y with the equations as they are now, measured into *r. */
static hc_status find_again(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  const int k = r->period_multiple;
  const double contraction = r->contraction;
  shoot_report found = {
      .distance = INFINITY, .multiplier = r->multiplier_re + I * r->multiplier_im, .free_sliders = r->free_sliders};
  hc_status st = HC_NOT_CONVERGED;
  if (ti->how.steady == TRANSIENT_STEADY_MARCH) return settle_by_integration(ti, monitor, r);
  if (ti->closed_form) st = confirm_orbit(ti, k, orbit_goal(ti), 0, monitor, &found, r);
  if (shoot_found_no_orbit(st)) {
    const double reach = ORBIT_NEXT_TO * timeint_scaled_size(ti);
    st = shoot_newton(ti->shoot, k, reach, orbit_goal(ti), monitor, &found);
    if (st == HC_OK) st = orbit_report(ti, k, TIMEINT_BY_SHOOTING, &found, r);
  }
  if (ti->closed_form) r->contraction = contraction;
  return st;
}

/* *known: the closed form is on the exact law's orbit next to ti->y, and has measured it. */
static hc_status find_exact(timeint *ti, int k, const hc_monitor *monitor, bool *known)
{
  timeint *closed = ti->closed_form;
  timeint_result exact;
  double *state = ti->closed_form_state, *there = ti->point[0];
  *known = false;
  if (!closed) return HC_OK;
  for (int tries = 0; tries < 2 && !*known; ++tries) {
    if (tries > 0) {
      timeint_get_state(ti, state);
      const hc_status st = timeint_orbit(closed, ti->omega, k, state, monitor, &exact);
      if (st != HC_OK) return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK;
    }
    if (!closed->measured || closed->omega != ti->omega) continue;
    timeint_get_state(closed, state);
    timeint_take_state(ti, state, there);
    *known = timeint_farthest(ti, there, ti->y) <= ORBIT_NEXT_TO * timeint_scaled_size(ti);
  }
  return HC_OK;
}

/* The regularisation is halved, and the orbit found with that, until amplitudes are within `limit` of exact[responses],
 * or where that is not known (NULL), of what half the regularisation makes of them. */
static hc_status regularised_halve(timeint *ti, const double *exact, double limit, const hc_monitor *monitor,
                                   timeint_result *r)
{
  double *before = ti->amplitudes + ti->measure.n_responses;
  double error = exact ? largest_change(ti, exact) : INFINITY;
  for (int i = 0; i < MOST_HALVINGS && !(error <= limit); ++i) {
    note_amplitudes(ti, before);
    timeint_regularise(ti, 0.5 * ti->how.regularisation);
    hc_status st = find_again(ti, monitor, r);
    if (st != HC_OK) return st;
    error = exact ? largest_change(ti, exact) : largest_change(ti, before);
  }
  return HC_OK;
}

hc_status regularised_begin(timeint *ti, int k, const hc_monitor *monitor)
{
  bool known;
  if (ti->how.law == TRANSIENT_LAW_EXACT) return HC_OK;
  const hc_status st = find_exact(ti, k, monitor, &known);
  if (st == HC_OK && known) timeint_use_measured(ti, ti->closed_form);
  return st;
}

hc_status regularised_check(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  const double limit = ti->how.regularisation_error, resolved = fmax(limit, ti->how.tolerance);
  bool known;
  if (ti->how.law == TRANSIENT_LAW_EXACT || !ti->measured || r->period_multiple < 1 || !any_acts(ti)) return HC_OK;
  hc_status st = find_exact(ti, r->period_multiple, monitor, &known);
  if (st == HC_OK && !widths_fit(ti)) {
    timeint_use_measured(ti, known ? ti->closed_form : ti);
    st = find_again(ti, monitor, r);
  }
  if (st == HC_OK && known) note_amplitudes(ti->closed_form, ti->amplitudes);
  if (st == HC_OK && limit > 0) st = regularised_halve(ti, known ? ti->amplitudes : NULL, resolved, monitor, r);
  return shoot_found_no_orbit(st) ? HC_NOT_SETTLED : st;
}
