/* mass_scaling.c - see mass_scaling.h. */
#include "timeint/steady/mass_scaling.h"

#include <math.h>
#include <string.h>

#include "timeint/steady/shoot.h"
#include "timeint/steady/timeint_private.h"

static const double pays = 2; /* fewer steps by less than that are not worth an error */

bool mass_scaling_may_pay(const modal_base *whole) { return whole->n > MASS_SCALING_MODES && whole->diagonal_K; }

double mass_scaling_fastest(const modal_base *whole, double omega)
{
  if (!mass_scaling_may_pay(whole)) return INFINITY;
  const double per_octave = 4, fastest = exp2(round(log2(MASS_SCALING_FASTEST * omega) * per_octave) / per_octave);
  return sqrt(whole->K[whole->n - 1]) > pays * fastest ? fastest : INFINITY;
}

hc_status mass_scaling_error(timeint *closed, int k, const hc_monitor *monitor, int n, const timeint_result *r,
                             motion_error *out)
{
  timeint *slowed = closed->slowed;
  timeint_result here, there;
  timeint_get_state(closed, closed->point[0]);
  hc_status st = orbit_measure(closed, k, &here);
  if (st == HC_OK) st = timeint_begin(slowed, closed->omega, closed->point[0]);
  if (st == HC_OK) st = shoot_slowed(closed->shoot, k, monitor);
  if (st == HC_OK) st = orbit_measure(slowed, k, &there);
  for (int i = 0; i < n && st == HC_OK; ++i) {
    st = timeint_response(closed, i, &here);
    if (st == HC_OK) st = timeint_response(slowed, i, &there);
    if (st != HC_OK) break;
    const motion_error slowed_by = timeint_change(&here, &there), rest = timeint_change(&there, &r[i]);
    out[i] = (motion_error){slowed_by.amplitude + rest.amplitude, slowed_by.harmonic_1 + rest.harmonic_1,
                            slowed_by.waveform + rest.waveform};
  }
  return st;
}
