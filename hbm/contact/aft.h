/* aft.h - contact force harmonics from displacement harmonics by sampling (alternating frequency/time). */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "numerics/base/status.h"

typedef struct aft aft;

/* A workspace for the contacts of an oscillator (copied), moved by its x; n_harm >= 1 harmonics and n_time >=
 * 2 n_harm + 1 samples a period, even or odd. HC_BAD_INPUT, HC_NO_MEMORY: *out is NULL. */
hc_status aft_new_of_model(const model *m, hbm_restart restart, int n_harm, int n_time, aft **out);
void aft_free(aft *a);

/* F[n_dof (2H+1)] [force]: for each coordinate d the harmonics of sum_j cu_jd T_j + cv_jd (N_j - N0_j), at X (same
 * layout) [length]. jac[row + ld col], ld = n_dof (2H+1): dF/dX of the sampled F, aliasing included, unless NULL.
 * HC_NOT_FINITE if X is not finite; HC_NOT_CLOSED if a slider did not return to where it was a period before.
 * Allocates nothing. report may be NULL. */
hc_status aft_eval(aft *a, const double *X, double *F, double *jac, contact_report *report);

/* w[n_contacts] [length]: each contact's slider at th = 0 in the last evaluation, which ended with HC_OK. */
void aft_sliders(const aft *a, double *w);

extern const contact_evaluator aft_evaluator; /* of one contact with one tangent */
