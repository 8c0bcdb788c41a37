/* planar_aft.h - force harmonics of one contact with two tangents under the law of the circle (model/planar_slip.h), by
 * sampling: aft.h for motions in a plane. */
#ifndef HC_HBM_PLANAR_AFT_H
#define HC_HBM_PLANAR_AFT_H

#include "base/status.h"
#include "hbm/contact/contact_evaluator.h"
#include "hbm/hbm_settings.h"
#include "model/contact_law.h"

typedef struct planar_aft planar_aft;

/* A workspace for the contact whose half `law` is (model.h: a pair's two have the same), with friction; n_harm >= 1
 * harmonics, n_time >= 2 n_harm + 1 samples a period, even or odd. Its coordinates are u_1, u_2 and, with n_dof = 3, v;
 * with 2 the normal force does not vary. HC_BAD_INPUT, HC_NO_MEMORY: *out is NULL. */
hc_status planar_aft_new(int n_harm, int n_time, hbm_restart restart, int n_dof, const contact *law, planar_aft **out);
void planar_aft_free(planar_aft *a); /* NULL is allowed */

/* F[n_dof (2H+1)] [force]: harmonics of T_1, T_2 and N - N0 (of both halves) at X (same layout) [length]. The slider
 * begins with w = 0 at th = 0, is put into the circle there at once, and dragged until it comes back to where it was a
 * period before; with one of the ONE_PASS restarts, for one period. HC_NOT_FINITE; HC_NOT_CLOSED if it does not come
 * back within PLANAR_AFT_PASSES periods. Allocates nothing. report may be NULL. */
hc_status planar_aft_eval(planar_aft *a, const double *X, double *F, contact_report *report);

enum { PLANAR_AFT_PASSES = 400 };

/* jac[row + ld col], ld = n_dof (2H+1): dF/dX of the sampled F, aliasing included, at the last evaluation, which ended
 * with HC_OK. Where it slips, the slider's closed orbit moves with X. Where it never does, it stays where the
 * first periods, from w = 0, have dragged it. */
void planar_aft_jacobian(planar_aft *a, double *jac);

/* w[2] [length]: the slider at th = 0 in the last evaluation, which ended with HC_OK. */
void planar_aft_slider(const planar_aft *a, double w[2]);

extern const contact_evaluator planar_aft_evaluator;

#endif
