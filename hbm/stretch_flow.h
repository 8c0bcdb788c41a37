/* stretch_flow.h - how a perturbation of a structure's orbit moves while no contact changes its state.
 *
 *     d/dt (dx, dx') = A (dx, dx') + (0, M^-1 sum over stuck contacts t_j dheld_j)
 *     A = [ 0  1 ; -M^-1 (K + sum_j K_j)  -M^-1 C ],   K_j = kt t t^T stuck, s mu kn t n^T slipping with sign s;
 *                                                            + kn n n^T in contact
 *
 * linear and constant. An orbit, and a whole curve, visits few combinations of contact states, and A depends on nothing
 * else: each is decomposed once, A = V diag(lambda) V^-1, and moves by exponentials of lambda t. Where A has no
 * eigenvectors to go by (a free body without damping), by the matrix exponential (GSL, scaling and squaring). */
#ifndef HC_HBM_STRETCH_FLOW_H
#define HC_HBM_STRETCH_FLOW_H

#include "hbm/transitions.h"

typedef struct stretch_flow stretch_flow;

/* Of m, which must live as long. HC_NO_MEMORY; HC_SINGULAR if the mass matrix is: *out is NULL. */
hc_status stretch_flow_new(const model *m, stretch_flow **out);
void stretch_flow_free(stretch_flow *f); /* NULL is allowed */

/* phi[2 n + n_contacts][2 n + n_contacts], by rows dx, dx' [1/time], dheld_j: its columns over a stretch of that
 * duration [time] with piece[j] of each contact, NULL while separated. HC_NOT_FINITE, HC_NO_MEMORY. */
hc_status stretch_flow_advance(stretch_flow *f, const contact_piece *const *piece, double duration, double *phi);

#endif
