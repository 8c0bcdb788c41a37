/* referee.c - see referee.h. */
#include "compare/referee.h"

#include <math.h>

hc_status comparison_orbit_start(hbm_solver *hbm, const double *X, double omega, double *state)
{
  const int n = hbm_n_dof(hbm);
  const hc_status st = hbm_state(hbm, omega, X, state, state + n);
  return st == HC_OK ? hbm_sliders(hbm, X, state + 2 * n) : st;
}

hc_status comparison_referee(const compare_setup *setup, timeint *beside, timeint **out)
{
  transient_settings how = setup->transient;
  how.law = TRANSIENT_LAW_EXACT;
  how.tolerance = fmin(how.tolerance, 1e-9);
  if (beside) return timeint_new_beside(beside, &how, out);
  hc_status st = timeint_new(setup->model, &how, out);
  timeint *closed_form = st == HC_OK ? timeint_closed_form_of(*out) : NULL;
  if (!closed_form) return st;
  timeint_free(*out);
  *out = closed_form;
  return HC_OK;
}
