/* rests.h - the family of solutions at one omega by where free sliders rest: those that never slip, T = kt (u - w) with
 * w anywhere in {w : |kt (u - w)| <= mu N all the time}. Each w has a solution of its own; a slider that is asked to
 * begin where it cannot stay is put into the limit, and dragged to the nearest place where it can. So the members at a
 * limit are those that were asked beyond it. */
#pragma once

#include "hbm/solver/hbm_solver.h"

/* Solutions to come have their sliders begin at w[n_contacts] [length]; NULL: where the model has
 * them begin, as at first. */
void hbm_start_sliders(hbm_solver *s, const double *w);

/* w[n_contacts] as hbm_sliders, and which of them are free in the solution X; two tangents under one limit both or
 * none. Errors of the contact force. */
hc_status hbm_free_sliders(hbm_solver *s, const double *X, double *w, bool *free);

/* dX[n_coef]: how the solution that hbm_solve found last moves with free slider j. By dR/dw = -kt t_j in the means, and
 * Newton's last factors: a back-substitution. HC_SINGULAR. */
hc_status hbm_rest_tangent(hbm_solver *s, int j, double *dX);

/* [1] How far Y is from X in the metric at X (metric.h). */
double hbm_distance(const hbm_solver *s, const double *X, const double *Y);
