/* planar_force.h - contact force harmonics of a contact with two tangents and one limit for both (planar_slip.h), from
 * displacement harmonics without sampling, hence without aliasing:
 *
 *     F = (T_1, T_2, N - N0)      X = (u_1, u_2, v), or without the last ones where N is constant
 *
 * Stick is linear in the motion: its integrals are closed, as in exact_force.h. While it slips T = mu N e(phi), phi by
 * collocation (planar_slip.h), and the integrals are the collocation's own sums on the same panels. Their error is the
 * square of the truncation of phi's slope, its last Legendre coefficients (PLANAR_RESOLVED): rounding. A shift of the
 * motion in time changes the panels, and the force by less than 1e-12 of it. The Jacobian is that of these sums: phi's
 * variational equation is linear and scalar, and is solved at the same points. Moving the ends of intervals changes
 * nothing to first order, since the force is continuous there. libm only; nothing is allocated after
 * planar_force_new. */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "hbm/planar/planar_cycle.h"

typedef struct planar_force planar_force;

/* A workspace for the contact whose half `law` is (model.h: a pair's two have the same), with friction. Its coordinates
 * are u_1, u_2 and, with n_dof = 3, v; with 2 the normal force is constant. HC_BAD_INPUT, HC_NO_MEMORY: *out is
 * NULL. */
hc_status planar_force_new(int n_harm, int n_dof, const contact *law, planar_force **out);
void planar_force_free(planar_force *f); /* NULL is allowed */

/* F[n_dof (2H+1)] [force], N - N0 of both halves, at X (same layout) [length]. jac[row + ld col], ld = n_dof (2H+1):
 * dF/dX, unless NULL. report may be NULL. HC_NOT_FINITE, and the errors of planar_cycle_find. A slider that can rest
 * all period is at the place of planar_rest.h, whose derivative dF/dX contains. */
hc_status planar_force_eval(planar_force *f, const double *X, double *F, double *jac, contact_report *report);

/* w [length] at th = 0 on the closed orbit of the last evaluation. */
void planar_force_slider(const planar_force *f, double w[2]);

/* The orbit of the last evaluation, for following perturbations: intervals, each with its panels of slip
 * (planar_panel_angle gives phi on a panel, planar_slip_slope phi'), and the motion. Valid until the next one. Ends of
 * intervals are accurate to some 3e-9 rad if a Jacobian was asked for (planar_cycle.c), else to rounding. Derivatives
 * at the start of an interval: touch-down d w = d u - (dR/R') u' where it sticks, d phi = (du'.e_perp - phi' dR)/|u'|
 * where it slips; stick to slip d phi = (du - dw).e_perp/R; slip to stick d w = du - dR e - R e_perp d phi; d at fixed
 * th. */
const planar_cycle *planar_force_cycle(const planar_force *f);

extern const contact_evaluator planar_force_evaluator;
