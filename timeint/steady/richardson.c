/* richardson.c - see richardson.h. Measures q at regularisations rho, rho/2, rho/4:
 *
 *     q(rho) = q0 + a rho + b rho^2 + ...
 *     A = 2 q(rho/2) - q(rho),  B = 2 q(rho/4) - q(rho/2),  q0 ~ (4 B - A)/3
 *
 * Both orders are eliminated, since which of the two leads depends on whether contact returns in stick (a) or in
 * slip (a = 0, b); README.md has the figures. The change by the second step, |q0 - B|, is the error of the first, and
 * serves as an upper estimate of the error left. */
#include "timeint/steady/richardson.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/periodic_motion.h"
#include "timeint/steady/confirm.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/timeint_private.h"

enum { LEVELS = 3 };

static double extrapolate(double q1, double q2, double q3)
{
  const double a = 2 * q2 - q1, b = 2 * q3 - q2;
  return (4 * b - a) / 3;
}

/* The same orbit at another regularisation, from where it was; *r: of the orbit so far, then of this one. */
static hc_status solve_at(timeint *ti, double regularisation, int k, const hc_monitor *monitor, timeint_result *r)
{
  shoot_report found;
  const double size = timeint_size(ti) / ti->length;
  timeint_regularise(ti, regularisation);
  if (ti->scout) {
    found = (shoot_report){.multiplier = r->multiplier_re + I * r->multiplier_im, .free_sliders = r->free_sliders};
    const hc_status confirmed = confirm_orbit(ti->confirm, k, orbit_goal(ti), monitor, &found, r);
    if (!shoot_found_no_orbit(confirmed)) return confirmed;
  }
  hc_status st = shoot_newton(ti->shoot, k, size, orbit_goal(ti), monitor, &found);
  /* another orbit: nothing to extrapolate from */
  if (st == HC_OK && !(found.moved <= ORBIT_REGULARISED_WITHIN * size)) st = HC_NOT_CONVERGED;
  return st == HC_OK ? orbit_report(ti, k, TIMEINT_BY_SHOOTING, &found, r) : st;
}

static void combine(timeint_result *r, const timeint_result *half, const timeint_result *quarter)
{
  const double first = 2 * quarter->amplitude - half->amplitude;
#define EXTRAPOLATED(field) r->field = extrapolate(r->field, half->field, quarter->field)
  EXTRAPOLATED(max);
  EXTRAPOLATED(min);
  EXTRAPOLATED(rms);
  EXTRAPOLATED(mean);
  EXTRAPOLATED(a1);
  EXTRAPOLATED(b1);
  for (int i = 0; i < TIMEINT_WAVE; ++i) EXTRAPOLATED(wave[i]);
#undef EXTRAPOLATED
  r->amplitude = motion_amplitude(r->max, r->min);
  r->harmonic_1 = hypot(r->a1, r->b1);
  r->regularisation_error = r->amplitude > 0 ? fabs(r->amplitude - first) / r->amplitude : 0;
}

hc_status richardson_new(timeint *ti)
{
  if (!ti->how.richardson || ti->how.law == TRANSIENT_LAW_EXACT) return HC_OK;
  ti->extrapolated = calloc(LEVELS * (size_t)ti->measure.n_responses, sizeof *ti->extrapolated);
  return ti->extrapolated ? HC_OK : HC_NO_MEMORY;
}

/* The measures of every response of the orbit through ti->y, *r of the first, into out[responses]. */
static hc_status keep_responses(timeint *ti, const timeint_result *r, timeint_result *out)
{
  hc_status st = HC_OK;
  for (int i = 0; i < ti->measure.n_responses && st == HC_OK; ++i) {
    out[i] = *r;
    if (i > 0) st = timeint_response(ti, i, &out[i]);
  }
  return st;
}

/* ti->extrapolated becomes what it is called. */
static hc_status extrapolate_all(timeint *ti, const hc_monitor *monitor, const timeint_result *r)
{
  const double rho = ti->how.regularisation;
  const int n = ti->measure.n_responses;
  timeint_result *level = ti->extrapolated;
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  if (st == HC_OK) st = keep_responses(ti, r, level);
  for (int i = 1; i < LEVELS && st == HC_OK; ++i) {
    timeint_result at = *r;
    st = solve_at(ti, rho / (1 << i), r->period_multiple, monitor, &at);
    if (st == HC_OK) st = keep_responses(ti, &at, level + i * n);
  }
  timeint_regularise(ti, rho);
  for (int i = 0; i < n && st == HC_OK; ++i) combine(&level[i], &level[n + i], &level[2 * n + i]);
  return st;
}

hc_status richardson_extrapolate(timeint *ti, const hc_monitor *monitor, timeint_result *r)
{
  if (!ti->how.richardson || ti->how.law == TRANSIENT_LAW_EXACT) return HC_OK;
  if (r->method == TIMEINT_BY_CLOSED_FORM) {
    r->regularisation_error = 0;
    return HC_OK;
  }
  hc_status st = extrapolate_all(ti, monitor, r);
  if (st != HC_OK) return st;
  *r = *ti->extrapolated;
  ti->is_extrapolated = true;
  return HC_OK;
}

void richardson_response(const timeint *ti, int i, timeint_result *r)
{
  const timeint_result *of = &ti->extrapolated[i];
  r->max = of->max;
  r->min = of->min;
  r->amplitude = of->amplitude;
  r->rms = of->rms;
  r->mean = of->mean;
  r->a1 = of->a1;
  r->b1 = of->b1;
  r->harmonic_1 = of->harmonic_1;
  r->regularisation_error = of->regularisation_error;
  memcpy(r->wave, of->wave, sizeof r->wave);
}
