/* contact_forces.h - the harmonics of all contact forces on the coordinates q of a condensed structure. Each contact
 * is evaluated in its own u and v, by located transitions or by samples, and its force is scattered back; those of an
 * oscillator share its one coordinate, and are evaluated together.
 *
 *     u = t . q, v = n . q      F = sum_j t_j T_j + n_j (N_j - N0_j)      dF/dq = sum_j [t n] d(T, N)/d(u, v) [t n]^T
 *
 * A pair under the law of the circle (model.h) is evaluated in its u_1, u_2 and v, which both of its contacts share.
 *
 * Harmonics are ordered by coefficient, then by coordinate: X[c dim + d] is coefficient c (numerics/series.h) of
 * coordinate d. */
#ifndef HC_HBM_CONTACT_FORCES_H
#define HC_HBM_CONTACT_FORCES_H

#include "hbm/aft.h"
#include "hbm/circle_cycle.h"
#include "hbm/condensation.h"
#include "hbm/exact_force.h"

typedef struct contact_forces contact_forces;

/* Of the contacts of m in the coordinates of c; n_time samples a period where forces are sampled. HC_BAD_INPUT,
 * HC_NO_MEMORY: *out is NULL. */
hc_status contact_forces_new(const model *m, const condensation *c, hbm_force force, hbm_restart restart, int n_harm,
                             int n_time, contact_forces **out);
void contact_forces_free(contact_forces *f); /* NULL is allowed */

/* F[dim (2H+1)] [force] at X [length]. Errors of exact_force_eval, circle_force_eval, aft_eval
 * and circle_aft_eval. */
hc_status contact_forces_eval(contact_forces *f, const double *X, double *F, contact_report *report);

/* dF/dX, [dim (2H+1)]^2 by columns, at the last evaluation, which ended with HC_OK; valid until the next one. */
const double *contact_forces_jacobian(contact_forces *f);

/* w[n_contacts] [length]: the sliders at th = 0 on the closed orbit of the last evaluation. */
void contact_forces_sliders(const contact_forces *f, double *w);

/* The pieces of contact j, of located forces and not of a circle's only; and what held of one of them depends on: d
 * held = by[0] du + by[1] dv at its origin; of an oscillator by[0] dx. */
const contact_piece *contact_forces_pieces(const contact_forces *f, int j, int *n);
void contact_forces_held_by(const contact_forces *f, int j, const contact_piece *p, double by[2]);

/* Of the circle that contact j is one of the two of (its direction 0 is the first's, 1 the second's): what the last
 * evaluation found, of located forces only; NULL of any other contact. Valid until the next evaluation. */
const circle_cycle *contact_forces_circle(const contact_forces *f, int j);

#endif
