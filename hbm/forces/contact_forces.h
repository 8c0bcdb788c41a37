/* contact_forces.h - the harmonics of all contact forces on the coordinates q of a condensed structure. Each contact
 * is evaluated in coordinates of its own, by located transitions or by samples (contact_kind.h), and its force is
 * scattered back:
 *
 *     x = B q      F = sum over contacts B^T f(x)      dF/dq = sum B^T (df/dx) B
 *
 * Harmonics are ordered by coefficient, then by coordinate: X[c dim + d] is coefficient c (numerics/series.h) of
 * coordinate d. */
#pragma once

#include "hbm/forces/contact_kind.h"
#include "hbm/planar/planar_cycle.h"
#include "hbm/structure/condensation.h"

typedef struct contact_forces contact_forces;

/* n contacts in q[dim], whose directions are copied. A planar contact stands for itself and the next entry, its second
 * half, which is not read. HC_BAD_INPUT, HC_NO_MEMORY: *out is NULL. */
hc_status contact_forces_new_of(int dim, int n, const placed_contact *contacts, hbm_force force,
                                const evaluator_settings *how, contact_forces **out);

/* The contacts of m in the coordinates of c, NULL: in m's own; their sliders begin where m says. */
hc_status contact_forces_new(const model *m, const condensation *c, hbm_force force, const evaluator_settings *how,
                             contact_forces **out);
void contact_forces_free(contact_forces *f); /* NULL is allowed */

/* F[dim (2H+1)] [force] at X [length]. derive: contact_forces_jacobian will be called for this X. Errors of the
 * evaluators: exact_force_eval, planar_force_eval, aft_evaluator, planar_aft_evaluator. */
hc_status contact_forces_eval(contact_forces *f, const double *X, double *F, bool derive, contact_report *report);

/* dF/dX, [dim (2H+1)]^2 by columns, at the last evaluation, which derived and ended with HC_OK; valid until the next
 * one. */
const double *contact_forces_jacobian(contact_forces *f);

/* w[n_contacts] [length]: the sliders at th = 0 on the closed orbit of the last evaluation. */
void contact_forces_sliders(const contact_forces *f, double *w);

/* Where those of evaluations to come begin that are never lifted off: at 0 at first. A slider that cannot stay there is
 * put into the limit at th = 0, and goes where the motion drags it. */
void contact_forces_start(contact_forces *f, const double *w);

/* Regime of contact j in the last evaluation. */
contact_regime contact_forces_regime(const contact_forces *f, int j);

/* The intervals of contact j (exact forces only); two tangents under one limit have theirs at the first half, none at
 * the second. contact_forces_held_by: the derivative of an interval's `held`, d held = by[0] du + by[1] dv at its
 * origin. */
const contact_interval *contact_forces_intervals(const contact_forces *f, int j, int *n);
void contact_forces_held_by(const contact_forces *f, int j, const contact_interval *p, double by[2]);

/* True if contact j follows a smooth law with exact forces; its derivatives at th [rad] along the last evaluation's
 * motion. */
bool contact_forces_bends(const contact_forces *f, int j);
contact_slopes contact_forces_slopes(const contact_forces *f, int j, double th, double omega);

/* Sets the frequency [rad/time] of the next evaluations; true if any force depends on it. dF[dim (2H+1)] += dF/domega
 * at the last evaluation, which derived. */
bool contact_forces_at(contact_forces *f, double omega);
void contact_forces_add_by_omega(const contact_forces *f, double *dF);

/* The period of a planar contact whose first half is j, from the last evaluation with exact forces; NULL for other
 * contacts. Valid until the next evaluation. */
const planar_cycle *contact_forces_planar(const contact_forces *f, int j);
