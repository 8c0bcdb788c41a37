/* scene_forces.h - the contact forces of an oscillator with their Jacobian, in one call. */
#pragma once

#include <string.h>

#include "compare/study/scene_solvers.h"

/* F[2 n_harm + 1], and jac[2 n_harm + 1]^2 by columns; jac and report may be NULL. */
static inline hc_status forces_eval(contact_forces *f, int n_harm, const double *X, double *F, double *jac,
                                    contact_report *report)
{
  const size_t n = (size_t)series_length(n_harm);
  contact_report local;
  const hc_status st = contact_forces_eval(f, X, F, jac != NULL, report ? report : &local);
  if (st == HC_OK && jac) memcpy(jac, contact_forces_jacobian(f), n * n * sizeof *jac);
  return st;
}
