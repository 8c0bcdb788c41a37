/* planar_force.h - contact force harmonics of a contact with two tangents and one limit for both (planar_slip.h),
 * from displacement harmonics without sampling, hence without aliasing:
 *
 *     F = (T_1, T_2, N - N0)      X = (u_1, u_2, v), or without the last ones where N is constant
 *
 * Stick is linear in the motion: its integrals are closed, as in exact_force.h. While it slips T = mu N e(phi), phi by
 * collocation (planar_slip.h), and the integrals are the collocation's own sums on the same panels. Their error goes
 * with the square of what the panels leave of phi's slope, its last Legendre coefficients (PLANAR_RESOLVED): rounding.
 * A motion begun later has other panels, and the same force to less than 1e-12 of it. The Jacobian is that of these
 * sums: phi's variational equation is linear and scalar, and is solved at the same points. Moving the ends of intervals
 * changes nothing to first order, since the force is continuous there. libm only; nothing is allocated after
 * planar_force_new. */
#pragma once

#include "hbm/contact/contact_evaluator.h"
#include "hbm/planar/planar_cycle.h"

typedef struct planar_force planar_force;

/* A workspace for the contact whose half `law` is (model.h: a pair's two have the same), with friction. Its
 * coordinates are u_1, u_2 and, with n_dof = 3, v; with 2 the normal force does not vary. HC_BAD_INPUT, HC_NO_MEMORY:
 * *out is NULL. */
hc_status planar_force_new(int n_harm, int n_dof, const contact *law, planar_force **out);
void planar_force_free(planar_force *f); /* NULL is allowed */

/* F[n_dof (2H+1)] [force], N - N0 of both halves, at X (same layout) [length]. jac[row + ld col], ld = n_dof (2H+1):
 * dF/dX, unless NULL. report may be NULL. HC_NOT_FINITE, and the errors of planar_cycle_find. A slider that slips no
 * more rests where planar_rest.h says; dF/dX follows that place. */
hc_status planar_force_eval(planar_force *f, const double *X, double *F, double *jac, contact_report *report);

/* w [length] at th = 0 on the closed orbit of the last evaluation. */
void planar_force_slider(const planar_force *f, double w[2]);

/* What the last evaluation found, for whoever follows a perturbation along the orbit: intervals, each with the
 * panels of its slip (planar_panel_angle gives phi anywhere on one, planar_slip_slope phi'), and the motion. Valid
 * until the next one. With a Jacobian the ends of intervals are good to some 3e-9 rad (planar_cycle.c), without one to
 * rounding. At what intervals begin with: touch-down d w = d u - (dR/R') u' where it sticks, d phi = (du'.e_perp -
 * phi' dR)/|u'| where it slips; stick to slip d phi = (du - dw).e_perp/R; slip to stick d w = du - dR e - R e_perp d
 * phi; d at fixed th. */
const planar_cycle *planar_force_cycle(const planar_force *f);

extern const contact_evaluator planar_force_evaluator;
