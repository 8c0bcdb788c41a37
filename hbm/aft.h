/* aft.h - contact force harmonics from displacement harmonics by sampling (alternating frequency/time). */
#ifndef HC_AFT_H
#define HC_AFT_H

#include "base/status.h"
#include "hbm/contact_report.h"
#include "hbm/hbm_settings.h"
#include "model/model.h"

typedef struct aft aft;

/* A workspace for the contacts of m (copied), n_harm >= 1 harmonics and n_time >= 2 n_harm + 1 samples a period, even
 * or odd. HC_BAD_INPUT, HC_NO_MEMORY: *out is NULL. */
hc_status aft_new(const model *m, hbm_restart restart, int n_harm, int n_time, aft **out);
void aft_free(aft *a);

/* F[2H+1] [force]: harmonics of sum_j T_j cos(alpha_j) + (N_j - N0_j) sin(alpha_j) for the displacement X[2H+1]
 * [length]. jac[row + (2H+1) col] = dF/dX [force/length] of the sampled F, aliasing included, unless NULL.
 * HC_NOT_FINITE if X is not finite; HC_NOT_CLOSED if a slider did not return to where it was a period before.
 * Allocates nothing. report may be NULL. */
hc_status aft_eval(aft *a, const double *X, double *F, double *jac, contact_report *report);

/* dF/dX as above, at the last evaluation, which ended with HC_OK. */
void aft_jacobian(aft *a, double *jac);

/* w[n_contacts] [length]: each contact's slider at th = 0 in the last evaluation, which ended with HC_OK. */
void aft_sliders(const aft *a, double *w);

#endif
