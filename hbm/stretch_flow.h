/* stretch_flow.h - how a perturbation of a structure's orbit moves while no contact changes its state.
 *
 *     dx'' = -M^-1 [ C dx'/omega + (K + sum_j K_j) dx/omega^2 ] + M^-1 sum over stuck contacts t_j dheld_j/omega^2
 *     K_j = kt t t^T stuck, s mu kn t n^T slipping with sign s; + kn n n^T in contact               ' = d/d(omega t)
 *
 * linear and constant: a matrix exponential (GSL, scaling and squaring). */
#ifndef HC_HBM_STRETCH_FLOW_H
#define HC_HBM_STRETCH_FLOW_H

#include "hbm/transitions.h"

typedef struct stretch_flow stretch_flow;

/* Of m, which must live as long. HC_NO_MEMORY; HC_SINGULAR if the mass matrix is: *out is NULL. */
hc_status stretch_flow_new(const model *m, stretch_flow **out);
void stretch_flow_free(stretch_flow *f); /* NULL is allowed */

/* phi[2 n + n_contacts][2 n + n_contacts], by rows dx, dx', dheld_j: its columns over a stretch of `angle` [rad] with
 * piece[j] of each contact, NULL while separated. HC_NOT_FINITE, HC_NO_MEMORY. */
hc_status stretch_flow_advance(stretch_flow *f, double omega, const contact_piece *const *piece, double angle,
                               double *phi);

#endif
