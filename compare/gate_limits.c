/* gate_limits.c - see gate_limits.h. */
#include "compare/gate_limits.h"

#include "numerics/base/constants.h"

discrepancy gate_limits_at(const gate_limits *l, double omega)
{
  const gate_ranges *r = &l->ranges;
  const double unit = r->in_cycles ? TWO_PI : 1;
  discrepancy at = l->most;
  for (int i = 0; 2 * i + 1 < r->ends.n; ++i) {
    if (omega < unit * r->ends.v[2 * i] || omega > unit * r->ends.v[2 * i + 1]) continue;
    at.amplitude = r->amplitude.n ? r->amplitude.v[i] : l->most.amplitude;
    at.harmonic_1 = r->harmonic_1.n ? r->harmonic_1.v[i] : l->most.harmonic_1;
    at.mean = r->mean.n ? r->mean.v[i] : l->most.mean;
    at.waveform = r->waveform.n ? r->waveform.v[i] : l->most.waveform;
  }
  return at;
}

bool gate_limits_hold(const gate_limits *l, double omega, const discrepancy *d, bool mean_free)
{
  const discrepancy most = gate_limits_at(l, omega);
  const bool mean = mean_free || d->mean <= most.mean;
  return d->amplitude <= most.amplitude && d->harmonic_1 <= most.harmonic_1 && mean && d->waveform <= most.waveform;
}
