/* interval_flow.h - how a perturbation of a structure's orbit moves while no contact changes its state.
 *
 *     d/dt (dx, dx') = A (dx, dx') + (0, M^-1 sum over stuck contacts t_j dheld_j)
 *     A = [ 0  1 ; -M^-1 (K + sum_j K_j)  -M^-1 C ],   K_j = kt t t^T stuck, s mu kn t n^T slipping with sign s;
 *                                                            + kn n n^T in contact
 *
 * linear and constant. An orbit, and a whole curve, visits few combinations of contact states, and A depends on nothing
 * else: each is decomposed once, A = V diag(lambda) V^-1, and moves by exponentials of lambda t. Where A has no
 * eigenvectors to go by (a free body without damping), by the matrix exponential (GSL, scaling and squaring). */
#pragma once

#include "hbm/contact/transitions.h"

typedef struct interval_flow interval_flow;

/* For m, which must live as long. HC_NO_MEMORY; HC_SINGULAR if the mass matrix is: *out is NULL. */
hc_status interval_flow_new(const model *m, interval_flow **out);
void interval_flow_free(interval_flow *f); /* NULL is allowed */

/* phi[2 n + n_contacts][2 n + n_contacts], by rows dx, dx' [1/time], dheld_j: its first `columns` columns over an
 * interval of that duration [time] with interval[j] of each contact, NULL while separated. HC_NOT_FINITE,
 * HC_NO_MEMORY. */
hc_status interval_flow_advance(interval_flow *f, const contact_interval *const *interval, double duration, int columns,
                                double *phi);

/* A basis of the perturbations that outlast an interval. A motion of which e^(lambda t) leaves less than 1e-24 is lost
 * in rounding, but for the offset at which a slider that sticks all the interval holds it. The map of a period that
 * ends with the interval has the multipliers of this basis, and else only 0.
 *   survivors     the basis, into the first *columns columns of phi: the motions that last, then one column a slider,
 *                 moved by 1 (dheld = kt, which keeps entries of one size). slider[n_sliders]: contacts whose dheld
 *                 counts over the interval; sticks_on[]: true if it counts behind it, too. On return slider[] has those
 *                 with a column, in order
 *   coordinates   out[columns][n_states] by rows: phi at the interval's end in coordinates of that basis
 * HC_NO_MEMORY. */
hc_status interval_flow_survivors(interval_flow *f, const contact_interval *const *interval, double duration,
                                  int n_sliders, int *slider, const bool *sticks_on, double *phi, int *columns);
hc_status interval_flow_coordinates(interval_flow *f, const contact_interval *const *interval, const int *slider,
                                    int columns, const double *phi, double *out);
