/* mass_scaling.c - see mass_scaling.h. */
#include "timeint/steady/mass_scaling.h"

static const double pays = 2; /* fewer steps by less than that are not worth an error */

bool mass_scaling_may_pay(const modal_base *whole) { return whole->n > MASS_SCALING_MODES && whole->diagonal_K; }

double mass_scaling_fastest(const modal_base *whole, double omega)
{
  if (!mass_scaling_may_pay(whole)) return INFINITY;
  const double per_octave = 4, fastest = exp2(round(log2(MASS_SCALING_FASTEST * omega) * per_octave) / per_octave);
  return sqrt(whole->K[whole->n - 1]) > pays * fastest ? fastest : INFINITY;
}
